// SPDX-License-Identifier: GPL-3.0-or-later
//
// The tables of answers about a run: names and values of their columns, for the program's files and
// the Python package.
#ifndef KINETRI_IMPL_OBSERVERS_ANSWER_COLUMNS_H
#define KINETRI_IMPL_OBSERVERS_ANSWER_COLUMNS_H

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "kinetri/impl/observers/connections.h"
#include "kinetri/impl/observers/spanning_tree_rows.h"
#include "kinetri/observers/closest_approaches.h"
#include "kinetri/observers/connected_components.h"
#include "kinetri/observers/encounters.h"
#include "kinetri/observers/mean_cell_areas.h"
#include "kinetri/observers/mean_pressure.h"
#include "kinetri/observers/nearest_neighbors.h"
#include "kinetri/observers/neighbor_lives.h"

namespace kinetri::detail {

/// The offset of an image of a point; none if there is no point.
inline std::optional<Lattice_offset_2> offset_of_end(Point_id id, const Lattice_offset_2& offset) {
  return id == no_point ? std::nullopt : std::optional(offset);
}

/// The columns of a table. `Row` is the type of a row; rows(observer) returns all rows.
///
/// visit(column) calls column(name, value) for each column, in their order. `value` is a member of
/// Row, or a function of one; std::invoke(value, row) is the value in the row:
/// - Algebraic_number: an exact time, which files give as its tight_interval() in two columns,
///   name_lo and name_hi;
/// - Point_id: a point, or no_point;
/// - std::optional<Lattice_offset_2>: of an image, against the point in a column before; files give
///   it as two integers with a blank between, or nothing, in a column whose name ends in "offset";
/// - std::size_t: a count; bool; a text;
/// - double: a number, or NaN.
///
/// A third argument, false, means that the column has no values, because they were not requested.
struct Approach_columns {
  using Row = Approach;
  bool has_gaps = false;     ///< whether the points are discs
  bool has_offsets = false;  ///< whether there is a periodic box

  static auto rows(auto& observer) { return observer.approaches(); }
  void visit(const auto& column) const {
    column("a", [](const Row& row) { return row.points[0]; });
    column("b", [](const Row& row) { return row.points[1]; });
    if (has_offsets) column("offset", [](const Row& row) { return std::optional(row.offset); });
    column("time", &Row::time);
    column("distance", &Row::distance);
    if (has_gaps) column("gap", &Row::gap);
  }
};

struct Encounter_columns {
  using Row = Encounter;
  bool has_gaps = false;     ///< whether the points are discs
  bool has_offsets = false;  ///< whether there is a periodic box

  static auto rows(auto& observer) { return observer.encounters(); }
  void visit(const auto& column) const {
    column("a", [](const Row& row) { return row.points[0]; });
    column("b", [](const Row& row) { return row.points[1]; });
    if (has_offsets) column("offset", [](const Row& row) { return std::optional(row.offset); });
    column("begin", &Row::begin);
    column("end", &Row::end);
    column("closest", &Row::closest);
    column("distance", &Row::distance);
    if (has_gaps) column("gap", &Row::gap);
  }
};

struct Component_columns {
  using Row = Component_event;
  bool has_offsets = false;  ///< whether there is a periodic box

  static const std::vector<Row>& rows(auto& observer) { return observer.events(); }
  void visit(const auto& column) const {
    column("time", &Row::time);
    column("kind", [](const Row& row) { return name(row.kind); });
    column("a", [](const Row& row) { return row.points[0]; });
    column("b", [](const Row& row) { return row.points[1]; });
    if (has_offsets) {
      column("offset", [](const Row& row) { return offset_of_end(row.points[1], row.offset); });
    }
    column("components", &Row::components);
    column("largest", &Row::largest);
    if (has_offsets) column("wrapping", &Row::wrapping);
  }
};

/// `Name` is the type of a and b: Point_id, or a text.
template <class Name>
struct Connection_columns {
  using Row = Connection;
  std::vector<std::array<Name, 2>> names;  ///< of each pair

  static auto rows(auto& observer) { return observer.connections(); }
  void visit(const auto& column) const {
    column("a", [this](const Row& row) { return names[row.pair][0]; });
    column("b", [this](const Row& row) { return names[row.pair][1]; });
    column("begin", &Row::begin);
    column("end", &Row::end);
  }
};

struct Spanning_tree_columns {
  using Row = Spanning_tree_row;
  bool has_offsets = false;  ///< whether there is a periodic box

  static auto rows(auto& observer) { return observer.rows(); }
  void visit(const auto& column) const {
    column("time", &Row::time);
    column("kind", [](const Row& row) { return name(row.kind); });
    column("a", [](const Row& row) { return row.edge[0]; });
    column("b", [](const Row& row) { return row.edge[1]; });
    if (has_offsets) column("offset", [](const Row& row) { return std::optional(row.offset); });
    column("length", &Row::length);
  }
};

struct Neighbor_life_columns {
  using Row = Neighbor_life;
  bool has_ridge = false;    ///< whether there is a threshold
  bool has_offsets = false;  ///< whether there is a periodic box

  static auto rows(auto& observer) { return observer.lives(); }
  void visit(const auto& column) const {
    column("a", [](const Row& row) { return row.points[0]; });
    column("b", [](const Row& row) { return row.points[1]; });
    if (has_offsets) column("offset", [](const Row& row) { return std::optional(row.offset); });
    column("begin", &Row::begin);
    column("end", &Row::end);
    column("begins_by", [](const Row& row) { return name(row.begins_by); });
    column("ends_by", [](const Row& row) { return name(row.ends_by); });
    column("short", &Row::is_short, has_ridge);
  }
};

struct Exchange_columns {
  using Row = Point_exchanges;
  bool has_ridge = false;  ///< whether there is a threshold

  static auto rows(auto& observer) { return observer.exchanges(); }
  void visit(const auto& column) const {
    column("id", &Row::id);
    column("from", &Row::from);
    column("until", &Row::until);
    column("gained", &Row::gained);
    column("lost", &Row::lost);
    column("short", &Row::short_ones, has_ridge);
    column("rate", &rate);
  }

  /// The exchanges that are not short per unit of time; NaN if the duration is 0.
  static double rate(const Row& row) {
    const double duration = row.until.to_double() - row.from.to_double();
    const std::size_t counted = row.gained + row.lost - row.short_ones;
    return duration > 0 ? static_cast<double>(counted) / duration
                        : std::numeric_limits<double>::quiet_NaN();
  }
};

struct Nearest_neighbor_columns {
  using Row = Nearest_neighbor_change;
  bool has_offsets = false;  ///< whether there is a periodic box

  static const std::vector<Row>& rows(auto& observer) { return observer.changes(); }
  void visit(const auto& column) const {
    column("time", &Row::time);
    column("id", &Row::id);
    column("before", &Row::before);
    if (has_offsets) {
      column("before_offset",
             [](const Row& row) { return offset_of_end(row.before, row.before_offset); });
    }
    column("after", &Row::after);
    if (has_offsets) {
      column("after_offset",
             [](const Row& row) { return offset_of_end(row.after, row.after_offset); });
    }
  }
};

struct Mean_area_columns {
  using Row = Mean_cell_area;

  static auto rows(auto& observer) { return observer.means(); }
  static void visit(const auto& column) {
    column("id", &Row::id);
    column("from", &Row::from);
    column("until", &Row::until);
    column("area", &Row::area);
    column("error", &Row::error);
  }
};

struct Pressure_columns {
  using Row = Pressure_2;

  /// The mean since the last call, in one row.
  static std::vector<Row> rows(auto& observer) { return {observer.next()}; }
  static void visit(const auto& column) {
    column("from", &Row::from);
    column("until", &Row::until);
    column("collisions", [](const Row& row) { return static_cast<std::size_t>(row.collisions); });
    column("energy", &Row::energy);
    column("pressure", &Row::pressure);
    column("xx", &Row::xx);
    column("xy", &Row::xy);
    column("yy", &Row::yy);
  }
};

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_OBSERVERS_ANSWER_COLUMNS_H
