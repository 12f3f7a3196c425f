// SPDX-License-Identifier: GPL-3.0-or-later
//
// Answers that are tables, written as CSV.
#ifndef KINETRI_APPS_TABLE_ANSWER_H
#define KINETRI_APPS_TABLE_ANSWER_H

#include <cmath>
#include <concepts>
#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "answers/answer.h"
#include "cli/text.h"
#include "io/text.h"
#include "kinetri/observers/detail/answer_columns.h"

namespace kinetri::app {

/// Writes a table: its header, and a row for each of `rows`. Columns are as
/// observers/detail/answer_columns.h has them. A field about which nothing is known is empty.
template <class Columns, class Rows>
void write_table(std::ostream& out, const Columns& columns, const Rows& rows) {
  using Row = typename Columns::Row;
  std::string text;
  columns.visit([&](std::string_view name, const auto& value, bool /*is_known*/ = true) {
    using Value = std::decay_t<std::invoke_result_t<decltype(value), const Row&>>;
    const char* const comma = text.empty() ? "" : ",";
    if constexpr (std::same_as<Value, Algebraic_number>) {
      append(text, comma, name, "_lo,", name, "_hi");
    } else {
      append(text, comma, name);
    }
  });
  out << text << '\n';
  for (const Row& row : rows) {
    text.clear();
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
    out << text << '\n';
  }
}

/// The answer of an observer, as a table.
template <class Observer, class Columns>
class Table_answer final : public Answer {
 public:
  template <class... Arguments>
  explicit Table_answer(Columns columns, Arguments&&... arguments)
      : columns_(std::move(columns)), observer_(std::forward<Arguments>(arguments)...) {}

  void write(std::ostream& out) override { write_table(out, columns_, Columns::rows(observer_)); }

 private:
  Columns columns_;
  Observer observer_;
};

/// The answer of the observer that is made of the arguments.
template <class Observer, class Columns, class... Arguments>
std::unique_ptr<Answer> table_answer(Columns columns, Arguments&&... arguments) {
  return std::make_unique<Table_answer<Observer, Columns>>(std::move(columns),
                                                           std::forward<Arguments>(arguments)...);
}

}  // namespace kinetri::app

#endif  // KINETRI_APPS_TABLE_ANSWER_H
