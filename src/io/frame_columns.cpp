// SPDX-License-Identifier: GPL-3.0-or-later
#include "frame_columns.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "io/text_table.h"
#include "kinetri/impl/io/parse_number.h"
#include "kinetri/impl/io/text.h"

namespace kinetri {
namespace {

// ---- comments ----

enum class Name { frame, id, x, y, other };

Name name_of(std::string_view word) {
  constexpr std::array<std::string_view, 7> frames = {"frame",   "fr",      "frames",     "frameid",
                                                      "framenr", "frameno", "framenumber"};
  constexpr std::array<std::string_view, 12> ids = {
      "id",         "ids",          "ped",   "pedid",   "pers",  "persid",
      "pedestrian", "pedestrianid", "agent", "agentid", "track", "trackid"};
  constexpr std::array<std::string_view, 2> persons = {"person", "personid"};
  const auto is_among = [&](const auto& names) {
    return std::find(names.begin(), names.end(), word) != names.end();
  };
  if (is_among(frames)) return Name::frame;
  if (is_among(ids) || is_among(persons)) return Name::id;
  if (word == "x") return Name::x;
  return word == "y" ? Name::y : Name::other;
}

// In lower case, without text in brackets, units after a slash, and underscores; separated by
// blanks.
std::string simplified(std::string_view comment) {
  std::string result;
  int brackets = 0;
  bool is_in_unit = false;
  for (const char c : in_lower_case(comment)) {
    if (c == '(' || c == '[') ++brackets;
    const bool is_in_brackets = brackets > 0;
    if ((c == ')' || c == ']') && brackets > 0) --brackets;
    if (is_in_brackets || c == '_' || c == '-') continue;
    const bool is_separator = is_blank(c) || c == ',' || c == ';' || c == '"';
    is_in_unit = !is_separator && (is_in_unit || c == '/');
    if (!is_in_unit) result += is_separator ? ' ' : c;
  }
  return result;
}

std::vector<std::string_view> words_of(std::string_view text) {
  std::vector<std::string_view> words;
  for_each_field_between_blanks(text, [&](std::string_view word) { words.push_back(word); });
  return words;
}

void find_columns(std::string_view comment, Comment_signs& signs) {
  const std::string text = simplified(comment);
  std::vector<std::string_view> words = words_of(text);
  const auto label = std::find_if(words.rbegin(), words.rend(),
                                  [](std::string_view word) { return word.ends_with(':'); });
  words.erase(words.begin(), label.base());
  for (std::size_t i = 0; i + 4 <= words.size(); ++i) {
    std::array<Name, 4> names;
    for (std::size_t k = 0; k < 4; ++k) names[k] = name_of(words[i + k]);
    constexpr std::array<Name, 4> expected = {Name::frame, Name::id, Name::x, Name::y};
    if (!std::is_permutation(names.begin(), names.end(), expected.begin())) continue;
    signs.has_expected_order = names == expected;
    const auto index = [&names](Name name) {
      return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
    };
    signs.columns = {index(Name::frame), index(Name::id), index(Name::x), index(Name::y)};
    signs.words_before = i;
    signs.words = words.size();
    signs.column_names = joined(words[i], ' ', words[i + 1], ' ', words[i + 2], ' ', words[i + 3]);
    return;
  }
}

// The number after `framerate`, `frame rate`, `frame_rate` or `fps`, and a colon or an equals sign.
void find_frame_rate(std::string_view comment, Comment_signs& signs) {
  std::string text = in_lower_case(comment);
  std::erase(text, '_');
  std::ranges::replace_if(
      text, [](char c) { return c == ':' || c == '='; }, ' ');
  const std::vector<std::string_view> words = words_of(text);
  for (std::size_t i = 0; i + 1 < words.size(); ++i) {
    const bool is_two_words = words[i] == "frame" && words[i + 1] == "rate";
    if (!is_two_words && words[i] != "framerate" && words[i] != "fps") continue;
    const std::size_t number = i + (is_two_words ? 2 : 1);
    if (number == words.size()) return;
    const Parsed_number parsed = parse_number(words[number]);
    if (parsed.problem.empty()) signs.frame_rate = parsed.value;
    return;
  }
}

std::optional<Length_unit> unit_of(std::string_view word) {
  struct Unit_name {
    std::string_view name;
    Length_unit unit;
  };
  constexpr std::array<Unit_name, 15> names = {{{"m", Length_unit::meter},
                                                {"meter", Length_unit::meter},
                                                {"meters", Length_unit::meter},
                                                {"metre", Length_unit::meter},
                                                {"metres", Length_unit::meter},
                                                {"cm", Length_unit::centimeter},
                                                {"centimeter", Length_unit::centimeter},
                                                {"centimeters", Length_unit::centimeter},
                                                {"centimetre", Length_unit::centimeter},
                                                {"centimetres", Length_unit::centimeter},
                                                {"mm", Length_unit::millimeter},
                                                {"millimeter", Length_unit::millimeter},
                                                {"millimeters", Length_unit::millimeter},
                                                {"millimetre", Length_unit::millimeter},
                                                {"millimetres", Length_unit::millimeter}}};
  const auto found = std::find_if(names.begin(), names.end(),
                                  [word](const Unit_name& unit) { return unit.name == word; });
  return found == names.end() ? std::nullopt : std::optional(found->unit);
}

// The unit after x or y, with or without `in` between; or else one after `in` or `unit`, or after z
// if that follows y: "x y z (cm)".
void find_unit(std::string_view comment, Comment_signs& signs) {
  std::string text = in_lower_case(comment);
  std::ranges::replace_if(
      text, [](char c) { return (c < 'a' || c > 'z') && (c < '0' || c > '9'); }, ' ');
  const std::vector<std::string_view> words = words_of(text);
  std::vector<Length_unit> of_places;
  std::vector<Length_unit> others;
  for (std::size_t i = 0; i + 1 < words.size(); ++i) {
    const bool is_place = words[i] == "x" || words[i] == "y";
    const std::size_t next = is_place && words[i + 1] == "in" ? i + 2 : i + 1;
    const auto unit = next < words.size() ? unit_of(words[next]) : std::nullopt;
    if (!unit) continue;
    const auto is_list_to = [&](std::size_t z) {
      return words[z] == "z" && z > 0 && words[z - 1] == "y";
    };
    const bool is_of_z = i > 0 && words[i - 1] == "z" && !is_list_to(i - 1);
    if (is_place) {
      of_places.push_back(*unit);
    } else if ((words[i] == "in" && !is_of_z) || words[i] == "unit" || words[i] == "units" ||
               is_list_to(i)) {
      others.push_back(*unit);
    }
  }
  const std::vector<Length_unit>& units = of_places.empty() ? others : of_places;
  if (units.empty()) return;
  signs.unit = units.front();
  signs.has_two_units = std::count(units.begin(), units.end(), units.front()) !=
                        static_cast<std::ptrdiff_t>(units.size());
}

// ---- rows ----

struct Row {
  double frame;
  double id;
  Vector_2 place;
};

bool is_whole(double number) {
  return std::trunc(number) == number;
}

// The average distance of successive rows with one key, and their number.
struct Steps {
  double average = 0;
  std::size_t number = 0;
};

template <class Key, class Other>
Steps steps(std::vector<Row>& rows, Key key, Other other) {
  std::sort(rows.begin(), rows.end(), [&](const Row& a, const Row& b) {
    return std::tuple(key(a), other(a)) < std::tuple(key(b), other(b));
  });
  Steps result;
  double sum = 0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    if (key(rows[i - 1]) != key(rows[i])) continue;
    sum += std::hypot(rows[i].place.x - rows[i - 1].place.x, rows[i].place.y - rows[i - 1].place.y);
    ++result.number;
  }
  if (result.number > 0) result.average = sum / static_cast<double>(result.number);
  return result;
}

}  // namespace

Comment_signs signs_in_comment(std::string_view comment) {
  Comment_signs signs;
  find_columns(comment, signs);
  find_frame_rate(comment, signs);
  find_unit(comment, signs);
  return signs;
}

std::optional<std::string> sign_in_rows(const std::vector<Track>& tracks) {
  // With fewer steps it may be chance.
  constexpr std::size_t least_steps_of_one = 2;
  constexpr std::size_t least_steps = 8;
  std::vector<Row> rows;
  for (const Track& track : tracks) {
    const Parsed_number id = parse_number(track.id);
    if (!id.problem.empty() || !is_whole(id.value)) return std::nullopt;
    for (const Track_observation& seen : track.observations) {
      rows.push_back({seen.time, id.value, seen.place});
    }
  }
  const auto frame = [](const Row& row) { return row.frame; };
  const auto id = [](const Row& row) { return row.id; };
  const Steps of_ids = steps(rows, id, frame);
  const Steps in_frames = steps(rows, frame, id);
  if (of_ids.number == 0 && in_frames.number >= least_steps_of_one) {
    return joined("none of the ", rows.size(), " ids is in two frames");
  }
  if (std::min(of_ids.number, in_frames.number) >= least_steps &&
      2 * in_frames.average < of_ids.average) {
    return joined("successive rows of one id are ", rounded(of_ids.average, 3),
                  " apart on average, but those of one frame only ", rounded(in_frames.average, 3));
  }
  return std::nullopt;
}

}  // namespace kinetri
