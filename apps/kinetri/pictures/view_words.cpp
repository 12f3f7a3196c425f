// SPDX-License-Identifier: GPL-3.0-or-later
#include "pictures/view_words.h"

#include <algorithm>
#include <charconv>
#include <functional>

#include "cli/arguments.h"
#include "cli/text.h"
#include "kinetri/impl/io/input_text.h"
#include "kinetri/impl/io/parse_number.h"
#include "kinetri/impl/io/text.h"
#include "kinetri/io/viewer_page.h"

namespace kinetri::app {
namespace {

// A value, or none if the text is not valid.
template <class Value>
using Possible = std::optional<Value>;

// Decodes %41 and +, as in addresses.
std::string decoded(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    unsigned code = 0;
    if (text[i] == '+') {
      result += ' ';
    } else if (text[i] == '%' && i + 2 < text.size() &&
               std::from_chars(&text[i + 1], &text[i + 1] + 2, code, 16).ptr == &text[i + 1] + 2) {
      result += static_cast<char>(code);
      i += 2;
    } else {
      result += text[i];
    }
  }
  return result;
}

// A finite decimal number, as pages read it.
Possible<double> finite_number(std::string_view text) {
  const auto [value, problem] = parse_number(text);
  const bool is_decimal = problem.empty() && text.find_first_of("xX") == std::string_view::npos;
  return is_decimal ? Possible<double>(value) : std::nullopt;
}

template <class Whole>
Possible<Whole> whole_number(std::string_view text) {
  Whole result = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), result);
  const bool is_number = error == std::errc() && end == text.data() + text.size();
  return is_number ? Possible<Whole>(result) : std::nullopt;
}

Possible<bool> one_of_two(std::string_view text, std::string_view on, std::string_view off) {
  if (text != on && text != off) return std::nullopt;
  return text == on;
}

// The index of the name in `names`.
template <std::size_t n>
Possible<std::size_t> index_of(std::string_view text,
                               const std::array<std::string_view, n>& names) {
  const auto found = std::ranges::find(names, text);
  if (found == names.end()) return std::nullopt;
  return static_cast<std::size_t>(found - names.begin());
}

template <std::size_t n>
std::string list(const std::array<std::string_view, n>& names) {
  return separated(std::vector<std::string>(names.begin(), names.end()), ", ");
}

std::array<std::string_view, event_kinds> kind_names() {
  std::array<std::string_view, event_kinds> result;
  for (std::size_t i = 0; i < event_kinds; ++i) result[i] = name(static_cast<Event_kind>(i));
  return result;
}

// Calls `function` for the fields between commas until it returns false; returns whether it never
// did.
template <class Function>
bool each_field(std::string_view text, Function function) {
  bool result = true;
  for_each_field_between_commas(text, [&](std::string_view field) {
    if (result) result = function(field);
  });
  return result;
}

bool set_switches(View_words& words, std::string_view text, bool is_on) {
  return each_field(text, [&](std::string_view field) {
    const auto layer = index_of(field, layer_names);
    if (layer) words.switches.emplace_back(static_cast<Layer>(*layer), is_on);
    return layer.has_value();
  });
}

// "4-17", or in a periodic box "4-17,1,-2" with an offset.
bool set_edge(View_words& words, std::string_view text) {
  const std::size_t comma = std::min(text.find(','), text.size());
  const std::string_view ids = text.substr(0, comma);
  const std::size_t dash = ids.find('-');
  if (dash == std::string_view::npos) return false;
  const auto a = whole_number<Point_id>(ids.substr(0, dash));
  const auto b = whole_number<Point_id>(ids.substr(dash + 1));
  if (!a || !b || (*a == *b && comma == text.size())) return false;
  words.edge = edge_ids(*a, *b);
  words.edge_offset.reset();
  if (comma == text.size()) return true;
  std::vector<std::int32_t> offset;
  const bool are_numbers = each_field(text.substr(comma + 1), [&](std::string_view field) {
    const auto number = whole_number<std::int32_t>(field);
    if (number) offset.push_back(*number);
    return number.has_value();
  });
  if (!are_numbers || offset.size() != 2) return false;
  words.edge_offset = Lattice_offset_2{offset[0], offset[1]};
  return true;
}

Possible<std::array<double, 3>> place_and_width(std::string_view text) {
  std::vector<double> numbers;
  const bool are_numbers = each_field(text, [&](std::string_view field) {
    const auto number = finite_number(field);
    if (number) numbers.push_back(*number);
    return number.has_value();
  });
  if (!are_numbers || numbers.size() != 3 || !(numbers[2] > 0)) return std::nullopt;
  return std::array<double, 3>{numbers[0], numbers[1], numbers[2]};
}

Possible<std::vector<Event_kind>> kinds(std::string_view text) {
  std::vector<Event_kind> result;
  const bool are_kinds = each_field(text, [&](std::string_view field) {
    const auto kind = index_of(field, kind_names());
    if (kind) result.push_back(static_cast<Event_kind>(*kind));
    return kind.has_value();
  });
  return are_kinds ? Possible<std::vector<Event_kind>>(result) : std::nullopt;
}

// Sets the field if there is a value, and returns whether there is one.
template <class Field, class Value>
bool set(std::optional<Field>& field, const Possible<Value>& value) {
  if (value) field = static_cast<Field>(*value);
  return value.has_value();
}

struct Word {
  std::string_view name;
  std::string expected;
  std::function<bool(View_words&, std::string_view)> follow;
};

// In the order of viewer_words.
std::vector<Word> all_words() {
  using Words = View_words;
  using Text = std::string_view;
  const std::string on_or_off = "on or off";
  const auto is_switch = [](Words&, Text text) {
    return one_of_two(text, "on", "off").has_value();
  };
  const std::string layers = "of " + list(layer_names);
  return {
      {"t", "a number", [](Words& w, Text text) { return set(w.time, finite_number(text)); }},
      {"event", "a whole number",
       [](Words& w, Text text) { return set(w.event, whole_number<std::uint64_t>(text)); }},
      {"show", layers, [](Words& w, Text text) { return set_switches(w, text, true); }},
      {"hide", layers, [](Words& w, Text text) { return set_switches(w, text, false); }},
      {"edge",
       "the ids of two points, as in 4-17, in a periodic box also with an offset, as in 4-17,1,-2",
       [](Words& w, Text text) { return set_edge(w, text); }},
      {"point", "the id or the name of a point",
       [](Words& w, Text text) {
         w.point = text;
         return !text.empty();
       }},
      {"follow", on_or_off,
       [](Words& w, Text text) { return set(w.follows_point, one_of_two(text, "on", "off")); }},
      {"color", "one of " + list(quantity_names),
       [](Words& w, Text text) { return set(w.color, index_of(text, quantity_names)); }},
      {"at", "two coordinates and a width, as in 10,20,5",
       [](Words& w, Text text) { return set(w.at, place_and_width(text)); }},
      {"kinds", "of " + list(kind_names()),
       [](Words& w, Text text) { return set(w.kinds, kinds(text)); }},
      {"unit", "a text",
       [](Words& w, Text text) {
         w.unit = text;
         return true;
       }},
      {"legend", on_or_off,
       [](Words& w, Text text) { return set(w.has_legend, one_of_two(text, "on", "off")); }},
      {"play", on_or_off, is_switch},
      {"theme", "light or dark",
       [](Words& w, Text text) { return set(w.is_dark, one_of_two(text, "dark", "light")); }},
      {"list", on_or_off, is_switch},
      {"draw", "webgl or canvas",
       [](Words&, Text text) { return one_of_two(text, "webgl", "canvas").has_value(); }},
  };
}

}  // namespace

View_words view_words(std::string_view source, std::string_view text) {
  static const std::vector<Word> known = all_words();
  View_words result;
  while (!text.empty()) {
    const std::size_t end = text.find('&');
    const std::string_view word = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (word.empty()) continue;
    const std::size_t sign = word.find('=');
    if (sign == std::string_view::npos) {
      throw Usage_error(joined(source, ": ", kinetri::in_quotes(word),
                               " has no value; expected words such as t=2&color=area"));
    }
    const std::string_view name = word.substr(0, sign);
    const auto found = std::ranges::find(known, name, &Word::name);
    if (found == known.end()) {
      throw Usage_error(joined(source, ": ", kinetri::in_quotes(name), " is unknown; expected ",
                               list(viewer_words)));
    }
    const std::string value = decoded(word.substr(sign + 1));
    if (found->follow(result, value)) continue;
    refuse_view_word(source, name, value, found->expected);
  }
  return result;
}

void refuse_view_word(std::string_view source, std::string_view name, std::string_view value,
                      std::string_view expected) {
  throw Usage_error(joined(source, ": ", name, ": ", kinetri::in_quotes(value),
                           " is not possible; expected ", expected));
}

}  // namespace kinetri::app
