// SPDX-License-Identifier: GPL-3.0-or-later
//
// Questions about a run that an observer answers: what is asked, and the answer as a table.
#ifndef KINETRI_PYTHON_WATCH_H
#define KINETRI_PYTHON_WATCH_H

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "kinetri/algebra/algebraic_number.h"
#include "kinetri/events/basic_event.h"
#include "kinetri/observers/cell_areas.h"

namespace kinetri::python {

/// What is asked.
struct Question {
  std::string about;                              ///< the name of the observer, as in `watch`
  std::size_t number = 0;                         ///< how many answers, where that is to be said
  std::optional<double> distance = std::nullopt;  ///< what is near, or short, where that is said
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

  /// @{
  /// A column of what `value` gives for each of the rows.
  template <class Rows, class Value>
  void add(const std::string& name, const Rows& rows, const Value& value) {
    std::vector<std::decay_t<decltype(value(*rows.begin()))>> column;
    column.reserve(rows.size());
    for (const auto& row : rows) column.push_back(value(row));
    columns_.emplace_back(name, std::move(column));
  }
  /// The ends of a pair: columns a and b.
  template <class Rows, class Value>
  void add_pair(const Rows& rows, const Value& value) {
    add("a", rows, [&](const auto& row) { return value(row)[0]; });
    add("b", rows, [&](const auto& row) { return value(row)[1]; });
  }
  /// An exact time: rounded, and the tightest bounds, in columns that end in _lo and _hi.
  template <class Rows, class Value>
  void add_times(const std::string& name, const Rows& rows, const Value& value) {
    add(name, rows, [&](const auto& row) { return value(row).to_double(); });
    add(name + "_lo", rows, [&](const auto& row) { return value(row).tight_interval().lower; });
    add(name + "_hi", rows, [&](const auto& row) { return value(row).tight_interval().upper; });
  }
  /// @}

  /// All columns, in the order in which they were added.
  std::vector<std::pair<std::string, Column>>& columns() { return columns_; }

 private:
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
