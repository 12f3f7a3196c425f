// SPDX-License-Identifier: GPL-3.0-or-later
//
// Answers that are tables, written as CSV.
#ifndef KINETRI_APPS_TABLE_ANSWER_H
#define KINETRI_APPS_TABLE_ANSWER_H

#include <cmath>
#include <concepts>
#include <functional>
#include <memory>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "answers/answer.h"
#include "cli/text.h"
#include "kinetri/impl/io/text.h"
#include "kinetri/impl/observers/answer_columns.h"
#include "kinetri/io/event_log.h"

namespace kinetri::app {

/// The name of the column with the labels for the points in the column `name`.
inline std::string label_column(std::string_view name) {
  return name == "id" ? "label" : joined("label_", name);
}

/// Writes the header of a table. The columns are defined in impl/observers/answer_columns.h. If
/// `labels`, by id, is not empty, the last columns are the labels for each column of points.
template <class Columns>
void write_header(std::ostream& out, const Columns& columns,
                  const std::vector<std::string>& labels = {}) {
  using Row = typename Columns::Row;
  std::string text;
  std::string last_columns;
  columns.visit([&](std::string_view name, const auto& value, bool /*is_known*/ = true) {
    using Value = std::decay_t<std::invoke_result_t<decltype(value), const Row&>>;
    const char* const comma = text.empty() ? "" : ",";
    if constexpr (std::same_as<Value, Algebraic_number>) {
      append(text, comma, name, "_lo,", name, "_hi");
    } else {
      append(text, comma, name);
      if (std::same_as<Value, Point_id> && !labels.empty()) {
        append(last_columns, ",", label_column(name));
      }
    }
  });
  out << text << last_columns << '\n';
}

/// Writes rows of the table with such a header. Unknown values are empty fields.
template <class Columns, class Rows>
void write_rows(std::ostream& out, const Columns& columns, const Rows& rows,
                const std::vector<std::string>& labels = {}) {
  for (const typename Columns::Row& row : rows) {
    std::string text;
    std::string last_columns;
    bool is_first = true;
    columns.visit([&](std::string_view /*name*/, const auto& get, bool is_known = true) {
      if (!std::exchange(is_first, false)) text += ',';
      if (!is_known) return;
      const auto& value = std::invoke(get, row);
      using Value = std::decay_t<decltype(value)>;
      if constexpr (std::same_as<Value, Algebraic_number>) {
        text += time_bounds(value);
      } else if constexpr (std::same_as<Value, Point_id>) {
        if (value != no_point) append(text, value);
        if (!labels.empty()) {
          append(last_columns, ",", value != no_point ? csv_field(labels[value]) : std::string());
        }
      } else if constexpr (std::same_as<Value, std::optional<Lattice_offset_2>>) {
        if (value) text += offset_field(*value);
      } else if constexpr (std::same_as<Value, double>) {
        if (!std::isnan(value)) append(text, value);
      } else if constexpr (std::same_as<Value, bool>) {
        text += value ? '1' : '0';
      } else if constexpr (std::integral<Value>) {
        append(text, value);
      } else {
        text += csv_field(value);
      }
    });
    out << text << last_columns << '\n';
  }
}

/// The table of an observer.
template <class Observer, class Columns>
class Table_answer final : public Answer {
 public:
  template <class... Arguments>
  Table_answer(const Run_source& source, Columns columns, Arguments&&... arguments)
      : source_(source),
        columns_(std::move(columns)),
        observer_(std::forward<Arguments>(arguments)...) {}

  void write(std::ostream& out) override {
    const std::vector<std::string> labels = source_.labels();
    const auto& rows = Columns::rows(observer_);
    write_header(out, columns_, labels);
    write_rows(out, columns_, rows, labels);
  }

 private:
  const Run_source& source_;
  Columns columns_;
  Observer observer_;
};

/// The table of an observer that is constructed from the arguments. `source`, which has the labels,
/// must outlive it.
template <class Observer, class Columns, class... Arguments>
std::unique_ptr<Answer> table_answer(const Run_source& source, Columns columns,
                                     Arguments&&... arguments) {
  return std::make_unique<Table_answer<Observer, Columns>>(source, std::move(columns),
                                                           std::forward<Arguments>(arguments)...);
}

}  // namespace kinetri::app

#endif  // KINETRI_APPS_TABLE_ANSWER_H
