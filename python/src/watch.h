// SPDX-License-Identifier: GPL-3.0-or-later
//
// Questions about a run, which an observer answers with a table.
#ifndef KINETRI_PYTHON_WATCH_H
#define KINETRI_PYTHON_WATCH_H

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "kinetri/algebra/algebraic_number.h"
#include "kinetri/impl/events/basic_event.h"
#include "kinetri/observers/cell_areas.h"

namespace kinetri::python {

/// A question.
struct Question {
  std::string about;                              ///< the name of the observer, as in `watch`
  std::size_t number = 0;                         ///< number of answers, if the question has one
  std::optional<double> distance = std::nullopt;  ///< the range, or the length of short ridges
  std::vector<Edge_ids> pairs = {};               ///< pairs of points, for 'connected'
  std::shared_ptr<const Cell_limits> limits = nullptr;  ///< of cells, for questions about areas
  double tolerance = 0;                                 ///< of integrals
};

/// Columns of one length, each with a name.
class Answer_table {
 public:
  using Column = std::variant<std::vector<Point_id>, std::vector<std::int64_t>,
                              std::vector<std::uint8_t>, std::vector<double>,
                              std::vector<std::string>>;  ///< what one holds

  /// What stands for a missing integer.
  static constexpr std::int64_t missing = std::numeric_limits<std::int64_t>::min();

  /// Adds a column of `value`, a member or a function, for each of the rows. An exact time gives
  /// three columns: rounded, and the tightest bounds, with names that end in _lo and _hi. An offset
  /// gives two, with k and l in place of "offset" at the end of the name. Adds nothing unless
  /// `is_known`.
  template <class Row, class Value>
  void add(const std::string& name, const std::vector<Row>& rows, const Value& value,
           bool is_known = true) {
    using Result = std::decay_t<std::invoke_result_t<Value, const Row&>>;
    if (!is_known) return;
    if constexpr (std::same_as<Result, Algebraic_number>) {
      const auto bounds = [&](const Row& row) { return std::invoke(value, row).tight_interval(); };
      add(name, rows, [&](const Row& row) { return std::invoke(value, row).to_double(); });
      add(name + "_lo", rows, [&](const Row& row) { return bounds(row).lower; });
      add(name + "_hi", rows, [&](const Row& row) { return bounds(row).upper; });
    } else if constexpr (std::same_as<Result, std::optional<Lattice_offset_2>>) {
      const std::string begin = name.substr(0, name.size() - std::string("offset").size());
      const auto part = [&](std::int32_t Lattice_offset_2::*axis) {
        return [&value, axis](const Row& row) {
          const auto offset = std::invoke(value, row);
          return offset ? std::int64_t{(*offset).*axis} : missing;
        };
      };
      add(begin + "k", rows, part(&Lattice_offset_2::x));
      add(begin + "l", rows, part(&Lattice_offset_2::y));
    } else {
      std::vector<Element<Result>> column;
      column.reserve(rows.size());
      for (const Row& row : rows) {
        column.push_back(static_cast<Element<Result>>(std::invoke(value, row)));
      }
      columns_.emplace_back(name, std::move(column));
    }
  }

  /// All columns, in the order in which they were added.
  std::vector<std::pair<std::string, Column>>& columns() { return columns_; }

 private:
  // The type of elements of a column for values of a type.
  template <class Value>
  using Element = std::conditional_t<
      std::same_as<Value, Point_id> || std::same_as<Value, double>, Value,
      std::conditional_t<std::same_as<Value, bool>, std::uint8_t,
                         std::conditional_t<std::integral<Value>, std::int64_t, std::string>>>;

  std::vector<std::pair<std::string, Column>> columns_;
};

/// Observes a run while it exists. The engine must outlive it.
class Watch {
 public:
  Watch() = default;
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;
  virtual ~Watch() = default;
  /// The answer up to the current time.
  virtual Answer_table table() = 0;
};

/// Observes a triangulation or a simulation from its current time on. Throws Precondition_error if
/// the question is unknown or has no answer for it.
template <class Core>
std::unique_ptr<Watch> watch(Core& core, const Question& question);

}  // namespace kinetri::python

#endif  // KINETRI_PYTHON_WATCH_H
