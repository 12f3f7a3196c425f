// SPDX-License-Identifier: GPL-3.0-or-later
//
// Questions about a run that an observer answers: what is asked, and the answer as a table.
#ifndef KINETRI_PYTHON_WATCH_H
#define KINETRI_PYTHON_WATCH_H

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
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

/// What is asked.
struct Question {
  std::string about;                              ///< the name of the observer, as in `watch`
  std::size_t number = 0;                         ///< how many answers, where that is to be said
  std::optional<double> distance = std::nullopt;  ///< what is near, or short, where that is said
  std::vector<Edge_ids> pairs = {};               ///< of points, of which one is to be connected
  std::shared_ptr<const Cell_limits> limits =
      nullptr;           ///< of cells, where these are to be measured
  double tolerance = 0;  ///< of integrals, where there are any
};

/// Columns of one length, each with a name.
class Answer_table {
 public:
  using Column = std::variant<std::vector<Point_id>, std::vector<std::int64_t>,
                              std::vector<std::uint8_t>, std::vector<double>,
                              std::vector<std::string>>;  ///< what one holds

  /// Adds a column of what `value` gives for each of the rows, as a member of one or a function. An
  /// exact time becomes three: rounded, and the tightest bounds, in columns that end in _lo and
  /// _hi. One about which nothing `is_known` is left out.
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
  // What a column has for values of a type.
  template <class Value>
  using Element =
      std::conditional_t<std::same_as<Value, Point_id> || std::same_as<Value, double>, Value,
                         std::conditional_t<std::same_as<Value, bool>, std::uint8_t,
                                            std::conditional_t<std::same_as<Value, std::size_t>,
                                                               std::int64_t, std::string>>>;

  std::vector<std::pair<std::string, Column>> columns_;
};

/// Follows a run as long as it exists. It must end before the engine does.
class Watch {
 public:
  Watch() = default;
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;
  virtual ~Watch() = default;
  /// The answer up to the current time.
  virtual Answer_table table() = 0;
};

/// Follows a triangulation or a simulation, from its current time on. Throws Precondition_error if
/// the question has no answer for it, or nobody knows what it is about.
template <class Core>
std::unique_ptr<Watch> watch(Core& core, const Question& question);

}  // namespace kinetri::python

#endif  // KINETRI_PYTHON_WATCH_H
