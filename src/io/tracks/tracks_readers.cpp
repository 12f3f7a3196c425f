// SPDX-License-Identifier: GPL-3.0-or-later
#include "tracks_readers.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kinetri/base/error.h"
#include "kinetri/impl/io/parse_number.h"
#include "kinetri/impl/io/text.h"

namespace kinetri {
namespace {

bool recognizes_nothing(std::string_view /*head*/) {
  return false;
}

constexpr std::array<Tracks_reader, 12> readers = {{
    {{Tracks_format::automatic, "auto", "the format that the content shows"},
     has_bare_columns,
     read_frames_or_ids},
    {{Tracks_format::rows, "rows", "CSV with the columns t,id,x,y and optionally radius"},
     has_columns_of_rows,
     read_rows},
    {{Tracks_format::frames, "frames", "lines of frame id x y, without a header"},
     recognizes_nothing,
     read_frames},
    {{Tracks_format::ids, "ids", "lines of id frame x y, and z, without a header"},
     recognizes_nothing,
     read_ids},
    {{Tracks_format::table, "table", "a table whose columns --columns names, or gives by number"},
     recognizes_nothing,
     read_table},
    {{Tracks_format::jupedsim, "jupedsim", "a database of SQLite that JuPedSim wrote"},
     is_sqlite,
     read_jupedsim},
    {{Tracks_format::sumo, "sumo", "XML with floating-car data of SUMO"}, is_xml, read_sumo},
    {{Tracks_format::lammps, "lammps", "a text dump of LAMMPS"}, is_lammps, read_lammps},
    {{Tracks_format::xyz, "xyz", "frames of atoms as XYZ"}, is_xyz, read_xyz},
    {{Tracks_format::geojson, "geojson", "points or lines with times as GeoJSON"},
     is_json,
     read_geojson},
    {{Tracks_format::gpx, "gpx", "tracks of GPS receivers as GPX"}, is_gpx, read_gpx},
    {{Tracks_format::trackmate, "trackmate", "tracks that TrackMate exports as XML"},
     is_trackmate,
     read_trackmate},
}};

// Archives, and tables without a reader.
struct Foreign_format {
  std::string_view magic;
  std::string_view is;
  std::string_view expected;
};
constexpr std::string_view decoded_ais =
    "a table of the decoded positions, read with --columns t=TIME,id=MMSI,x=LON,y=LAT and "
    "--projection";
constexpr std::string_view of_arrow =
    "Tracks.read of the Python package, or a table exported as CSV: python3 -c \"import pandas; "
    "pandas.read_feather('FILE').to_csv('FILE.csv')\"";
constexpr std::array<Foreign_format, 14> foreign_formats = {{
    {"\x1f\x8b", "is compressed by gzip", "the file that gunzip makes of it"},
    {"\xFD"
     "7zXZ",
     "is compressed by xz", "the file that unxz makes of it"},
    {"\x28\xB5\x2F\xFD", "is compressed by zstd", "the file that unzstd makes of it"},
    {"BZh", "is compressed by bzip2", "the file that bunzip2 makes of it"},
    {"PK\x03\x04", "is an archive of zip, or a workbook of a spreadsheet",
     "a table exported as CSV"},
    {"\x89HDF", "is a file of HDF5", "a table exported as text"},
    {"PAR1", "is a file of Parquet",
     "Tracks.read of the Python package, or a table exported as CSV: python3 -c \"import pandas; "
     "pandas.read_parquet('FILE').to_csv('FILE.csv')\""},
    {"ARROW1", "is a file of Arrow", of_arrow},
    {"FEA1", "is a file of Feather", of_arrow},
    {"!AIVDM", "has sentences of NMEA with encoded messages of AIS", decoded_ais},
    {"\\s:", "has sentences of NMEA with encoded messages of AIS", decoded_ais},
    {"$GP", "has sentences of NMEA of one receiver",
     "GPX, which gpsbabel -i nmea -o gpx makes of it"},
    {"$GN", "has sentences of NMEA of one receiver",
     "GPX, which gpsbabel -i nmea -o gpx makes of it"},
    {"Geolife trajectory", "has the track of one person of GeoLife, without an id",
     "a table of all persons with a column of ids: for each file, tail -n +7 FILE, with the id "
     "before each row; then --columns with numbers of columns"},
}};

}  // namespace

std::span<const Tracks_reader> tracks_readers() {
  return readers;
}

std::string foreign_format(std::string_view head) {
  for (const auto& [magic, is, expected] : foreign_formats) {
    if (head.starts_with(magic)) return joined(is, "; expected ", expected);
  }
  return foreign_xml(head);
}

bool is_missing(std::string_view field) {
  constexpr std::array<std::string_view, 7> words = {"", "nan", "na", "n/a", "null", "none", "\\n"};
  return std::find(words.begin(), words.end(), in_lower_case(field)) != words.end();
}

bool is_without_place(std::string_view x, std::string_view y) {
  const auto is_missing_by_word = [](std::string_view field) {
    return !field.empty() && is_missing(field);
  };
  return (is_missing(x) && is_missing(y)) || is_missing_by_word(x) || is_missing_by_word(y);
}

bool is_word(std::string_view field) {
  if (field.empty()) return true;
  constexpr std::string_view begins_numbers = "0123456789+-.";
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; };
  return begins_numbers.find(field.front()) == std::string_view::npos && !is_missing(field) &&
         std::none_of(field.begin(), field.end(), is_control);
}

namespace {

// As 20230305235959: differences are not seconds.
bool is_date_of_digits(std::string_view field) {
  constexpr std::size_t digits = 14;
  return field.size() == digits && (field.starts_with("19") || field.starts_with("20")) &&
         parse_timestamp(field, "%Y%m%d%H%M%S").problem.empty();
}

// The form of a date or time of day with so many digits; empty if there is none.
std::string_view form_of_digits(std::size_t digits) {
  switch (digits) {
    case 6:
      return "%H%M%S";
    case 8:
      return "%Y%m%d";
    case 10:
      return "%Y%m%d%H";
    case 12:
      return "%Y%m%d%H%M";
    default:
      return {};
  }
}

// "--date-format F or --date-format G", for the forms that match the field.
std::string formats_of(std::string_view field, std::span<const std::string_view> likely) {
  std::string formats;
  for (const std::string_view format : likely) {
    if (!parse_timestamp(field, format).problem.empty()) continue;
    append(formats, formats.empty() ? "" : " or ", "--date-format '", format, "'");
  }
  return formats;
}

// The message about a time in another form.
std::string problem_of_time(std::string_view field) {
  const std::string of_day = formats_of(field, likely_forms_of_day);
  if (!of_day.empty()) {
    return joined(
        "is a time of day without a date; expected dates with times, also in two columns, as in "
        "--columns t=DATE+TIME, or ",
        of_day, ", which makes it seconds since midnight if all are of one day");
  }
  const std::string formats = formats_of(field, likely_date_formats);
  if (formats.empty() && field.find(':') != std::string_view::npos) {
    return "is neither a number nor a date in ISO 8601, as 2024-05-01T12:00:00Z is; expected one "
           "of the two, or --date-format for dates in another form";
  }
  if (formats.empty()) return {};
  return joined("is a date, but not in ISO 8601, as 2024-05-01T12:00:00Z is; expected that, or ",
                formats);
}

}  // namespace

std::string problem_of_row(std::size_t fields, std::size_t columns, bool has_header) {
  return joined("the row has ", fields, fields == 1 ? " field" : " fields", "; expected ", columns,
                has_header ? ", one for each column of the header" : ", as the first row has",
                has_header && fields == columns + 1
                    ? "; if the first field is the name of a row, as R's write.table writes it, "
                      "expected a name for it in the header, and --columns "
                      "t=NAME,id=NAME,x=NAME,y=NAME"
                    : "");
}

std::string problem_of_comma(std::string_view field, char separator) {
  const std::size_t comma = field.find(',');
  if (comma == std::string_view::npos || field.find(',', comma + 1) != std::string_view::npos ||
      field.find_first_not_of("0123456789+-.,eE") != std::string_view::npos ||
      !parse_number(field.substr(comma + 1)).problem.empty()) {
    return {};
  }
  const bool has_point = field.find('.') != std::string_view::npos;
  if (separator != ',' && !has_point) {
    return "has a decimal comma; expected a decimal point, as sed 's/,/./g' FILE makes of all "
           "commas";
  }
  return joined(
      "has a decimal comma; expected a decimal point, as python3 -c \"import pandas; "
      "pandas.read_csv('FILE', sep='",
      separator == '\t' ? "\\t" : std::string(1, separator), "', decimal=','",
      has_point ? ", thousands='.'" : "", ").to_csv('FILE.csv', index=False)\" makes of it");
}

void Dates_of_digits::note(std::string_view field) {
  if (!are_all_) return;
  const std::string_view form = form_of_digits(field.size());
  const bool is_of_day = !form.empty() && is_form_of_day(form);
  are_all_ = !form.empty() && (is_of_day || field.starts_with("19") || field.starts_with("20")) &&
             (first_.empty() || first_.size() == field.size()) &&
             parse_timestamp(field, form).problem.empty();
  // The evidence of a time of day; other numbers of six digits may be frames.
  has_zero_ = has_zero_ || (field.starts_with('0') && !field.starts_with("00"));
  if (first_.empty()) first_ = field;
}

void Dates_of_digits::expect_none(const std::string& name,
                                  const Tracks_file_options& options) const {
  if (!are_all_ || first_.empty() || !options.date_format.empty() || options.fps) return;
  const std::string_view form = form_of_digits(first_.size());
  const bool is_of_day = is_form_of_day(form);
  if (is_of_day && !has_zero_) return;
  throw Input_error(
      name, 0,
      joined("all times are numbers that look like ", is_of_day ? "times of day" : "dates",
             ", such as ", first_, "; expected --date-format '", form,
             "' if they are, or, if they are numbers, at least one with a decimal point, as in ",
             first_, ".0"));
}

Parsed_time parse_time(std::string_view field, std::string_view column,
                       const Tracks_file_options& options) {
  Parsed_time result;
  if (field.empty()) {
    result.problem = joined("the column ", column, " is empty; expected a number");
    return result;
  }
  const auto fail = [&](std::string_view problem) {
    result.problem = joined("the column ", column, " is ", in_quotes(field), ", which ", problem);
  };
  if (!options.date_format.empty()) {
    const Parsed_timestamp parsed = parse_timestamp(field, options.date_format);
    if (is_form_of_day(options.date_format)) {
      result.value.number = parsed.problem.empty() ? seconds_between({}, parsed.value) : 0;
    } else {
      result.value.date = parsed.value;
    }
    if (!parsed.problem.empty()) {
      fail(joined(parsed.problem, " in the form '", options.date_format,
                  "'; expected another --date-format, or none for numbers and ISO 8601"));
    }
  } else if (looks_like_timestamp(field)) {
    const Parsed_timestamp parsed = parse_timestamp(field);
    result.value.date = parsed.value;
    if (!parsed.problem.empty()) {
      const bool has_form = !formats_of(field, likely_date_formats).empty();
      fail(has_form ? problem_of_time(field) : std::string(parsed.problem));
    }
  } else {
    const Parsed_number parsed = parse_number(field);
    result.value.number = parsed.value;
    if (!parsed.problem.empty() || is_date_of_digits(field)) {
      const std::string of_date = problem_of_time(field);
      fail(of_date.empty() ? std::string(parsed.problem) : of_date);
    }
  }
  return result;
}

Parsed_time time_of_frame(double frame, double fps) {
  Parsed_time result;
  result.value.number = frame / fps;
  if (!std::isfinite(result.value.number) || (result.value.number == 0 && frame != 0)) {
    result.problem = joined("the time of the frame ", frame, " at ", fps,
                            " frames a second is out of the range of binary64; expected 0, or a "
                            "magnitude from 4.9e-324 to 1.8e308");
  }
  return result;
}

std::string list_of(std::span<const std::string> names) {
  constexpr std::size_t most_shown = 20;
  std::string result;
  for (const std::string& name : names.first(std::min(names.size(), most_shown))) {
    append(result, result.empty() ? "" : ", ", in_quotes(name));
  }
  if (names.size() > most_shown) append(result, " and ", names.size() - most_shown, " others");
  return result;
}

void Unused_names::add(std::string_view name) {
  if (known_.find(name) != known_.end()) return;
  known_.emplace(name);
  names_.emplace_back(name);
}

void Unused_names::add_remarks(Tracks_file& file, std::string_view what) const {
  if (!names_.empty()) file.remarks.push_back(joined(what, ": ", list_of(names_)));
  if (without_names_ == 0) return;
  file.remarks.push_back(
      joined(without_names_, without_names_ == 1 ? " column" : " columns", " not used"));
}

double frame_rate(const Tracks_file_options& options, std::optional<double> of_file) {
  return options.fps.value_or(of_file.value_or(1));
}

void note_frame_rate(Tracks_file& file, const Tracks_input& input, std::optional<double> of_file,
                     std::string_view frames) {
  file.frame_rate = frame_rate(input.options, of_file);
  if (input.options.fps) return;
  file.remarks.push_back(of_file
                             ? joined(*of_file, ' ', frames, " a second, as the file says")
                             : joined("times are numbers of ", frames,
                                      ", since the file has no rate of them and --fps gives none"));
}

}  // namespace kinetri
