// SPDX-License-Identifier: GPL-3.0-or-later
#include "degrees.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "kinetri/base/error.h"
#include "kinetri/impl/io/input_text.h"
#include "kinetri/impl/io/text.h"

namespace kinetri {
namespace {

bool is_lower(char c) {
  return c >= 'a' && c <= 'z';
}
bool is_upper(char c) {
  return c >= 'A' && c <= 'Z';
}
// Bytes beyond ASCII belong to letters, except the sign of degrees.
bool is_letter(char c) {
  return is_lower(c) || is_upper(c) || static_cast<unsigned char>(c) >= 0x80;
}

// "GPSLongitude", "x_lon (deg)" as gps, longitude and x, lon, deg.
std::vector<std::string> words_of(std::string_view name) {
  std::vector<std::string> words;
  bool is_in_word = false;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const char c = name[i];
    if (!is_letter(c)) {
      is_in_word = false;
      continue;
    }
    const bool ends_lower = i > 0 && is_lower(name[i - 1]);
    const bool begins_lower = i + 1 < name.size() && is_lower(name[i + 1]);
    const bool follows_upper = i > 0 && is_upper(name[i - 1]);
    if (is_upper(c) && (ends_lower || (follows_upper && begins_lower))) is_in_word = false;
    if (!is_in_word) words.emplace_back();
    is_in_word = true;
    words.back() += in_lower_case(std::string_view(&c, 1));
  }
  return words;
}

bool is_among(std::string_view word, std::span<const std::string_view> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

constexpr std::array<std::string_view, 4> degree_words = {"deg", "degs", "degree", "degrees"};

// Words that occur before or after lon and lat without a sign between.
constexpr std::array<std::string_view, 51> companions = {
    "",       "gps",   "gnss",  "pos",     "position", "geo",    "dec",    "decimal", "loc",
    "wgs",    "x",     "y",     "dd",      "start",    "end",    "stop",   "ref",     "mean",
    "med",    "avg",   "raw",   "fix",     "ship",     "node",   "vessel", "center",  "centre",
    "my",     "cur",   "obs",   "true",    "base",     "from",   "to",     "origin",  "dest",
    "pickup", "first", "last",  "shape",   "ais",      "veh",    "bus",    "deg",     "degs",
    "degree", "wp",    "point", "degrees", "d",        "dropoff"};

// Whether the word is one of `names`, joined with one of the companions.
bool is_short_name(std::string_view word, std::span<const std::string_view> names) {
  return std::any_of(names.begin(), names.end(), [&](std::string_view name) {
    return (word.starts_with(name) && is_among(word.substr(name.size()), companions)) ||
           (word.ends_with(name) &&
            is_among(word.substr(0, word.size() - name.size()), companions));
  });
}

// The sign of degrees in UTF-8 or Latin-1, or the similar ordinal indicator.
bool has_sign_of_degrees(std::string_view name) {
  if (name.find("\xC2\xBA") != std::string_view::npos) return true;
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (name[i] != '\xB0') continue;
    if (i == 0 || name[i - 1] == '\xC2' || static_cast<unsigned char>(name[i - 1]) < 0x80)
      return true;
  }
  return false;
}

bool contains_one(std::string_view text, std::span<const std::string_view> pieces) {
  return std::any_of(pieces.begin(), pieces.end(), [&](std::string_view piece) {
    return text.find(piece) != std::string_view::npos;
  });
}

bool is_longitude(std::string_view word) {
  constexpr std::array<std::string_view, 7> names = {"lon",  "lng",    "long",        "longi",
                                                     "lons", "laenge", "l\xC3\xA4nge"};
  // Also in German, Danish, Dutch and Finnish; in Chinese, Japanese, Korean and Russian (without
  // the first letter).
  constexpr std::array<std::string_view, 10> pieces = {"longitud",
                                                       "l\xC3\xA4ngengrad",
                                                       "laengengrad",
                                                       "\xE7\xBB\x8F\xE5\xBA\xA6",
                                                       "\xE7\xB5\x8C\xE5\xBA\xA6",
                                                       "\xD0\xBE\xD0\xBB\xD0\xB3\xD0\xBE\xD1\x82",
                                                       "lengdegrad",
                                                       "lengtegraad",
                                                       "pituusaste",
                                                       "\xEA\xB2\xBD\xEB\x8F\x84"};
  if (word.find("longitudinal") != std::string_view::npos) return false;
  return is_short_name(word, names) || contains_one(word, pieces);
}

bool is_latitude(std::string_view word) {
  constexpr std::array<std::string_view, 4> names = {"lat", "lats", "lati", "breite"};
  constexpr std::array<std::string_view, 9> pieces = {"latitud",
                                                      "breitengrad",
                                                      "\xE7\xBA\xAC\xE5\xBA\xA6",
                                                      "\xE7\xB7\xAF\xE5\xBA\xA6",
                                                      "\xD0\xB8\xD1\x80\xD0\xBE\xD1\x82",
                                                      "breddegrad",
                                                      "breedtegraad",
                                                      "leveysaste",
                                                      "\xEC\x9C\x84\xEB\x8F\x84"};
  if (word.find("latitudinal") != std::string_view::npos) return false;
  return is_short_name(word, names) || contains_one(word, pieces);
}

// Whether the name contains that of the reference system WGS 84, or its number.
bool names_wgs84(std::string_view name) {
  constexpr std::array<std::string_view, 3> systems = {"wgs", "crs84", "4326"};
  const std::string lower = in_lower_case(name);
  return contains_one(lower, systems) && lower.find("utm") == std::string::npos;
}

// Whether columns with such names often have degrees, but also meters.
bool is_often_of_degrees(std::string_view name) {
  constexpr std::array<std::string_view, 5> pieces = {"gps", "gnss", "geo", "coord", "point"};
  constexpr std::array<std::string_view, 2> short_names = {"lo", "la"};
  const std::vector<std::string> words = words_of(name);
  return contains_one(in_lower_case(name), pieces) ||
         std::any_of(words.begin(), words.end(),
                     [&](const std::string& word) { return is_among(word, short_names); });
}

// The unit of length that is the last of several words, normalized; else empty.
std::string_view unit_of_length(const std::vector<std::string>& words) {
  using Spelling = std::pair<std::string_view, std::string_view>;
  constexpr std::array<Spelling, 13> spellings = {{{"m", "m"},
                                                   {"meter", "m"},
                                                   {"meters", "m"},
                                                   {"metre", "m"},
                                                   {"metres", "m"},
                                                   {"km", "km"},
                                                   {"cm", "cm"},
                                                   {"mm", "mm"},
                                                   {"ft", "ft"},
                                                   {"feet", "ft"},
                                                   {"px", "px"},
                                                   {"pixel", "px"},
                                                   {"pixels", "px"}}};
  if (words.size() < 2) return {};
  const auto found = std::find_if(spellings.begin(), spellings.end(),
                                  [&](const Spelling& unit) { return unit.first == words.back(); });
  return found == spellings.end() ? std::string_view() : found->second;
}

}  // namespace

Angle angle_in_name(std::string_view name) {
  constexpr std::array<std::string_view, 3> radians = {"rad", "radian", "radians"};
  const std::vector<std::string> words = words_of(name);
  if (words.empty()) return Angle::none;
  const auto has = [&](auto test) { return std::any_of(words.begin(), words.end(), test); };
  const bool has_degrees = has([&](const std::string& w) { return is_among(w, degree_words); }) ||
                           has_sign_of_degrees(name);
  if (!unit_of_length(words).empty() && !has_degrees) return Angle::none;
  if (has([&](const std::string& w) { return is_among(w, radians); })) return Angle::radians;
  if (has(is_longitude)) return Angle::longitude;
  if (has(is_latitude)) return Angle::latitude;
  return has_degrees || names_wgs84(name) ? Angle::degrees : Angle::none;
}

bool says_degrees(std::string_view comment) {
  const std::string lower = in_lower_case(comment);
  const auto has = [&](std::string_view text) { return lower.find(text) != std::string::npos; };
  constexpr std::array<std::string_view, 4> projections = {"utm", "mercator", "easting",
                                                           "northing"};
  if (contains_one(lower, projections)) return false;
  if (has("epsg:4326") || has("wgs84") || has("wgs 84") || has("crs84")) return true;
  const std::vector<std::string> words = words_of(comment);
  for (std::size_t i = 0; i + 1 < words.size(); ++i) {
    if ((words[i] == "x" || words[i] == "y") && is_among(words[i + 1], degree_words)) return true;
  }
  if (lower.find_first_of("0123456789") != std::string::npos) return false;
  bool has_longitude = false;
  bool has_latitude = false;
  for (const std::string& word : words) {
    has_longitude = has_longitude || is_longitude(word);
    has_latitude = has_latitude || is_latitude(word);
  }
  return has_longitude && has_latitude;
}

void expect_projection(const std::string& name, std::size_t line, Tracks_projection projection,
                       std::string_view what) {
  if (projection != Tracks_projection::refused) return;
  throw Input_error(
      name, line,
      joined(what,
             " in degrees of longitude and latitude, between which distances mean nothing; "
             "expected --projection local, which makes them meters about the middle of the data, "
             "--projection utm, which makes them those of a zone of UTM, --projection none, which "
             "takes degrees as they are, or projected places"));
}

Named_degrees degrees_in_names(const std::string& name, std::size_t line,
                               Tracks_projection projection, std::string_view what,
                               const std::string& of_x, const std::string& of_y) {
  const Angle x_angle = angle_in_name(of_x);
  const Angle y_angle = angle_in_name(of_y);
  const std::string names = joined("the ", what, ' ', in_quotes(of_x), " and ", in_quotes(of_y));
  const std::string_view x_unit = unit_of_length(words_of(of_x));
  const std::string_view y_unit = unit_of_length(words_of(of_y));
  if (!x_unit.empty() && !y_unit.empty() && x_unit != y_unit) {
    throw Input_error(name, line,
                      joined(names, " have the units ", x_unit, " and ", y_unit,
                             "; expected both coordinates in one unit"));
  }
  if (x_angle == Angle::none && y_angle == Angle::none) return {};
  if (projection == Tracks_projection::none) {
    return {.are_degrees = false,
            .remark = joined("places are taken as they are, though ", names, " are of angles")};
  }
  if (x_angle == Angle::radians || y_angle == Angle::radians) {
    throw Input_error(name, line,
                      joined(names,
                             " are in radians; expected degrees, or --projection none, which takes "
                             "them as they are"));
  }
  if (x_angle == Angle::latitude || y_angle == Angle::longitude) {
    throw Input_error(name, line,
                      joined("x is the column ", in_quotes(of_x), ", and y ", in_quotes(of_y),
                             "; expected the longitude as x, and the latitude as y"));
  }
  expect_projection(name, line, projection,
                    joined(names, what == "columns" ? " are places" : " say that places are"));
  return {.are_degrees = true, .remark = joined("places are degrees, as ", names, " say")};
}

bool is_on_earth(const Vector_2& degrees) {
  return std::abs(degrees.x) <= 180 && std::abs(degrees.y) <= 90;
}

bool is_no_place(const Vector_2& degrees) {
  return degrees.x == 181 || degrees.y == 91;
}

void Signs_of_degrees::note(const Vector_2& place, std::string_view x, std::string_view y) {
  if (is_null_island(place)) return;
  ++rows_;
  if (!is_on_earth(place)) return;
  ++rows_in_range_;
  const auto has_many_digits = [](std::string_view field) {
    constexpr std::size_t many = 4;
    const std::size_t point = field.find('.');
    return point != std::string_view::npos && field.size() - point > many;
  };
  if (has_many_digits(x) && has_many_digits(y)) ++rows_of_many_digits_;
}

namespace {

// The unit of times in seconds, if they are dates, or numbers of units since 1970 in the years from
// 1989 to 2039.
std::optional<double> known_unit(const Tracks_file& file) {
  if (!file.origin.empty()) return 1;
  constexpr double first = 6e8;
  constexpr double last = 2.2e9;
  for (const double unit : {1., 1e-3, 1e-6, 1e-9}) {
    const bool are_all =
        std::all_of(file.tracks.begin(), file.tracks.end(), [&](const Track& track) {
          return track.observations.front().time * unit >= first &&
                 track.observations.back().time * unit <= last;
        });
    if (are_all) return unit;
  }
  return std::nullopt;
}

}  // namespace

void Signs_of_degrees::expect_none(const Tracks_file& file, const std::string& name,
                                   Tracks_projection projection, const std::string& of_x,
                                   const std::string& of_y) const {
  if (projection != Tracks_projection::refused) return;
  // Others stand for unknown positions, as 181 and 91, or -999.
  constexpr std::size_t in_ten = 9;
  if (rows_ == 0 || 10 * rows_in_range_ < in_ten * rows_) return;
  if (2 * rows_of_many_digits_ < rows_in_range_) return;
  const std::optional<double> unit = known_unit(file);
  const bool has_length =
      !unit_of_length(words_of(of_x)).empty() || !unit_of_length(words_of(of_y)).empty();
  const bool is_often = !has_length && (is_often_of_degrees(of_x) || is_often_of_degrees(of_y));
  if (!unit && !is_often) return;
  const auto is_place = [](const Vector_2& place) {
    return is_on_earth(place) && !is_null_island(place);
  };
  double way = 0;
  double duration = 0;
  for (const Track& track : file.tracks) {
    const auto& seen = track.observations;
    for (std::size_t i = 1; i < seen.size(); ++i) {
      if (!is_place(seen[i].place) || !is_place(seen[i - 1].place)) continue;
      way +=
          std::hypot(seen[i].place.x - seen[i - 1].place.x, seen[i].place.y - seen[i - 1].place.y);
    }
    duration += unit.value_or(1) * (seen.back().time - seen.front().time);
  }
  // 3 mm a second if in meters, 330 m a second if in degrees.
  constexpr double greatest_speed = 0.003;
  if (!(way < greatest_speed * duration)) return;
  throw Input_error(
      name, 0,
      joined("nothing says what the places are, and they look like degrees: ",
             !file.origin.empty() ? "times are dates"
             : unit               ? "times are those since 1970"
                    : joined("the columns are ", in_quotes(of_x), " and ", in_quotes(of_y)),
             ", and numbers within 180 and 90, most with four decimals or more, change by ",
             way / duration,
             " a second; expected --projection local or --projection utm if they are longitude and "
             "latitude, or --projection none, which takes them as they are"));
}

}  // namespace kinetri
