// SPDX-License-Identifier: GPL-3.0-or-later
//
// Included before every source by cmake/platforms/wasm.cmake: what the library uses of C++20's
// standard library and libc++ 13, that of Debian's Emscripten, does not have. Parameters and
// results are those of the standard; iterators have no sentinels.
#ifndef KINETRI_CMAKE_PLATFORMS_WASM_STANDARD_LIBRARY_H
#define KINETRI_CMAKE_PLATFORMS_WASM_STANDARD_LIBRARY_H

#include <version>

#if defined(_LIBCPP_VERSION) && _LIBCPP_VERSION < 14000

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <compare>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <iterator>
#include <limits>
#include <string>
#include <system_error>
#include <type_traits>
#include <utility>

// From JavaScript (live/kinetri.mjs), which is much faster at it than musl: the text d.ddde+x,
// without zeros at its end and in the exponent, with the least number of digits that is read back
// as x, and of these the nearest. Returns its length, at most 25.
extern "C" __attribute__((import_module("env"), import_name("kinetri_digits"))) size_t
kinetri_digits(double x, char* text);

namespace std {

template <class To, class From>
To bit_cast(const From& from) noexcept {
  static_assert(sizeof(To) == sizeof(From) && is_trivially_copyable_v<To> &&
                is_trivially_copyable_v<From>);
  To result;
  memcpy(&result, &from, sizeof(To));
  return result;
}

template <class T, size_t n>
constexpr auto operator<=>(const array<T, n>& a, const array<T, n>& b) -> decltype(a[0] <=> b[0]) {
  for (size_t i = 0; i < n; ++i) {
    if (const auto order = a[i] <=> b[i]; order != 0) return order;
  }
  return strong_ordering::equal;
}

namespace ranges {

template <class R>
concept kinetri_range = requires(R&& r) {
  std::begin(r);
  std::end(r);
};
template <class R>
using kinetri_iterator = decltype(std::begin(std::declval<R&>()));

// The order, and the condition, of the projections of two elements.
template <class Order, class Projection>
auto kinetri_projected(Order& order, Projection& projection) {
  return [&order, &projection](const auto& a, const auto& b) -> bool {
    return std::invoke(order, std::invoke(projection, a), std::invoke(projection, b));
  };
}
template <class Condition, class Projection>
auto kinetri_projected_one(Condition& condition, Projection& projection) {
  return [&condition, &projection](auto&& x) -> bool {
    return std::invoke(condition, std::invoke(projection, std::forward<decltype(x)>(x)));
  };
}

// ---- conditions ----

#define KINETRI_BY_CONDITION(name)                                                              \
  template <kinetri_range R, class Condition, class Projection = identity>                      \
  auto name(R&& r, Condition condition, Projection projection = {}) {                           \
    return std::name(std::begin(r), std::end(r), kinetri_projected_one(condition, projection)); \
  }
KINETRI_BY_CONDITION(all_of)
KINETRI_BY_CONDITION(any_of)
KINETRI_BY_CONDITION(none_of)
KINETRI_BY_CONDITION(find_if)
KINETRI_BY_CONDITION(count_if)
KINETRI_BY_CONDITION(partition_point)
#undef KINETRI_BY_CONDITION

template <kinetri_range R, class Condition, class Value>
void replace_if(R&& r, Condition condition, const Value& value) {
  identity same;
  std::replace_if(std::begin(r), std::end(r), kinetri_projected_one(condition, same), value);
}
template <kinetri_range R, class Output, class Condition>
void copy_if(R&& r, Output output, Condition condition) {
  identity same;
  std::copy_if(std::begin(r), std::end(r), output, kinetri_projected_one(condition, same));
}

// ---- orders ----

#define KINETRI_BY_ORDER(name)                                                          \
  template <kinetri_range R, class Order = std::less<>, class Projection = identity>    \
  auto name(R&& r, Order order = {}, Projection projection = {}) {                      \
    return std::name(std::begin(r), std::end(r), kinetri_projected(order, projection)); \
  }
KINETRI_BY_ORDER(sort)
KINETRI_BY_ORDER(stable_sort)
KINETRI_BY_ORDER(is_sorted)
KINETRI_BY_ORDER(min_element)
KINETRI_BY_ORDER(max_element)
KINETRI_BY_ORDER(push_heap)
KINETRI_BY_ORDER(pop_heap)
#undef KINETRI_BY_ORDER

#define KINETRI_AT_PLACE(name)                                                                \
  template <kinetri_range R, class Order = std::less<>, class Projection = identity>          \
  void name(R&& r, kinetri_iterator<R> place, Order order = {}, Projection projection = {}) { \
    std::name(std::begin(r), place, std::end(r), kinetri_projected(order, projection));       \
  }
KINETRI_AT_PLACE(nth_element)
KINETRI_AT_PLACE(partial_sort)
#undef KINETRI_AT_PLACE

template <kinetri_range R, class Projection = identity>
auto adjacent_find(R&& r, std::equal_to<> = {}, Projection projection = {}) {
  std::equal_to<> equal;
  return std::adjacent_find(std::begin(r), std::end(r), kinetri_projected(equal, projection));
}

template <class T>
struct kinetri_minmax_result {
  T min;
  T max;
};
template <kinetri_range R, class Order = std::less<>, class Projection = identity>
auto minmax(R&& r, Order order = {}, Projection projection = {}) {
  const auto found =
      std::minmax_element(std::begin(r), std::end(r), kinetri_projected(order, projection));
  using Value = typename iterator_traits<kinetri_iterator<R>>::value_type;
  return kinetri_minmax_result<Value>{*found.first, *found.second};
}
template <kinetri_range R, class Order = std::less<>, class Projection = identity>
auto min(R&& r, Order order = {}, Projection projection = {}) {
  return typename iterator_traits<kinetri_iterator<R>>::value_type(
      *ranges::min_element(r, order, projection));
}

template <class I, class Value, class Order = std::less<>, class Projection = identity>
requires(!kinetri_range<I>) I
    lower_bound(I first, I last, const Value& value, Order order = {}, Projection projection = {}) {
  return std::lower_bound(first, last, value, [&](const auto& x, const auto& v) -> bool {
    return std::invoke(order, std::invoke(projection, x), v);
  });
}
template <kinetri_range R, class Value, class Order = std::less<>, class Projection = identity>
auto lower_bound(R&& r, const Value& value, Order order = {}, Projection projection = {}) {
  return ranges::lower_bound(std::begin(r), std::end(r), value, order, projection);
}
template <kinetri_range R, class Value>
auto upper_bound(R&& r, const Value& value) {
  return std::upper_bound(std::begin(r), std::end(r), value);
}
template <kinetri_range R, class Value>
bool binary_search(R&& r, const Value& value) {
  return std::binary_search(std::begin(r), std::end(r), value);
}
template <kinetri_range R, kinetri_range Q, class Output>
void set_difference(R&& r, Q&& q, Output output) {
  std::set_difference(std::begin(r), std::end(r), std::begin(q), std::end(q), output);
}
template <kinetri_range R, kinetri_range Q, class Output>
void set_symmetric_difference(R&& r, Q&& q, Output output) {
  std::set_symmetric_difference(std::begin(r), std::end(r), std::begin(q), std::end(q), output);
}

// ---- values ----

template <kinetri_range R, class Value, class Projection = identity>
auto find(R&& r, const Value& value, Projection projection = {}) {
  return std::find_if(std::begin(r), std::end(r),
                      [&](const auto& x) -> bool { return std::invoke(projection, x) == value; });
}
template <class I, class Value>
requires(!kinetri_range<I>) I find(I first, I last, const Value& value) {
  return std::find(first, last, value);
}
template <kinetri_range R, class Value, class Projection = identity>
auto count(R&& r, const Value& value, Projection projection = {}) {
  return std::count_if(std::begin(r), std::end(r),
                       [&](const auto& x) -> bool { return std::invoke(projection, x) == value; });
}
template <kinetri_range R, class Value>
void fill(R&& r, const Value& value) {
  std::fill(std::begin(r), std::end(r), value);
}

// ---- other orders of the elements, and copies ----

template <class I>
struct kinetri_subrange {
  I first, last;
  I begin() const { return first; }
  I end() const { return last; }
  bool empty() const { return first == last; }
  size_t size() const { return static_cast<size_t>(last - first); }
};
template <kinetri_range R>
auto unique(R&& r) {
  return kinetri_subrange<kinetri_iterator<R>>{std::unique(std::begin(r), std::end(r)),
                                               std::end(r)};
}
template <kinetri_range R, class Condition>
auto stable_partition(R&& r, Condition condition) {
  identity same;
  return kinetri_subrange<kinetri_iterator<R>>{
      std::stable_partition(std::begin(r), std::end(r), kinetri_projected_one(condition, same)),
      std::end(r)};
}
template <kinetri_range R>
void reverse(R&& r) {
  std::reverse(std::begin(r), std::end(r));
}
template <kinetri_range R>
void rotate(R&& r, kinetri_iterator<R> middle) {
  std::rotate(std::begin(r), middle, std::end(r));
}
template <kinetri_range R, class Output>
void copy(R&& r, Output output) {
  std::copy(std::begin(r), std::end(r), output);
}
template <kinetri_range R, class Output>
void move(R&& r, Output output) {
  std::move(std::begin(r), std::end(r), output);
}
template <kinetri_range R, class Output, class Function>
void transform(R&& r, Output output, Function function) {
  std::transform(std::begin(r), std::end(r), output,
                 [&](auto&& x) { return std::invoke(function, x); });
}

}  // namespace ranges

// ---- texts of binary64 numbers (for the other direction there is impl/base/from_chars.h) ----

inline to_chars_result kinetri_copied(char* first, char* last, const string& text) {
  if (text.size() > static_cast<size_t>(last - first)) return {last, errc::value_too_large};
  return {std::copy(text.begin(), text.end(), first), errc()};
}

inline string kinetri_printed(const char* format, int precision, double x) {
  char buffer[512];
  return string(buffer, static_cast<size_t>(snprintf(buffer, sizeof buffer, format, precision, x)));
}

inline to_chars_result to_chars(char* first, char* last, double x, chars_format format) {
  if (x != x || x - x != 0) return kinetri_copied(first, last, kinetri_printed("%.*f", 0, x));
  char digits[25];
  string text(digits, kinetri_digits(x, digits));
  if (x == 0 && signbit(x)) text.insert(0, 1, '-');
  // At least two digits of the exponent.
  const size_t sign = text.find('e') + 1;
  if (text.size() == sign + 2) text.insert(sign + 1, 1, '0');
  const size_t point = text.find('.');
  const int precision = point == string::npos ? 0 : static_cast<int>(text.find('e') - point - 1);
  if (format == chars_format::scientific) return kinetri_copied(first, last, text);
  // All digits before the point, and of those after it as many as there are.
  const int exponent = atoi(text.c_str() + text.find('e') + 1);
  const string fixed = kinetri_printed("%.*f", max(precision - exponent, 0), x);
  if (format == chars_format::fixed) return kinetri_copied(first, last, fixed);
  return kinetri_copied(first, last, fixed.size() <= text.size() ? fixed : text);
}
inline to_chars_result to_chars(char* first, char* last, double x) {
  return to_chars(first, last, x, chars_format::general);
}
inline to_chars_result to_chars(char* first, char* last, double x, chars_format format,
                                int precision) {
  return kinetri_copied(first, last,
                        kinetri_printed(format == chars_format::scientific ? "%.*e"
                                        : format == chars_format::fixed    ? "%.*f"
                                                                           : "%.*g",
                                        precision, x));
}

}  // namespace std

#endif

#endif  // KINETRI_CMAKE_PLATFORMS_WASM_STANDARD_LIBRARY_H
