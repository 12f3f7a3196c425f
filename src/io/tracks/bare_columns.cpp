// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tracks of pedestrians as lines without a header: frame id x y, or id frame x y and perhaps z.
// Both orders are read in parallel until one is excluded.
#include <algorithm>
#include <list>

#include "degrees.h"
#include "io/frame_columns.h"
#include "kinetri/base/error.h"
#include "kinetri/impl/io/parse_number.h"
#include "kinetri/impl/io/text.h"
#include "tracks_readers.h"

namespace kinetri {
namespace {

constexpr Frame_columns of_frames = {0, 1, 2, 3};
constexpr Frame_columns of_ids = {1, 0, 2, 3};
constexpr std::size_t least_fields = 4;

constexpr std::string_view expect_frame_first =
    "; expected frame, id, x and y in this order, or --format ids for id, frame, x and y";
constexpr std::string_view or_confirm_frame_first =
    ", or, if this is their order, add the line '# frame id x y' above the rows";
constexpr std::string_view expect_id_first =
    "; expected id, frame, x and y in this order: read the file with --format frames, or, if this "
    "is their order, add the line '# id frame x y' above the rows";
constexpr std::string_view expect_id_first_of_many =
    "; expected id, frame, x and y in this order: read the file with --format table --columns "
    "t=N,id=N,x=N,y=N, with the number of each column, or, if this is their order, add the line "
    "'# id frame x y' above the rows";
constexpr std::string_view with_numbers_of_columns =
    "--format table --columns t=N,id=N,x=N,y=N, with the number of each column, from 1 on";
constexpr std::string_view expect_four = "4, frame, id, x and y, separated by tabs or blanks";
constexpr std::string_view as_if_exchanged = ", as if the first two columns were exchanged";

double units_in_meter(Length_unit unit) {
  switch (unit) {
    case Length_unit::centimeter:
      return 100;
    case Length_unit::millimeter:
      return 1000;
    default:
      return 1;
  }
}

std::string_view name_of(Length_unit unit) {
  switch (unit) {
    case Length_unit::centimeter:
      return "centimeters";
    case Length_unit::millimeter:
      return "millimeters";
    default:
      return "meters";
  }
}

// The rows in one order of the columns.
struct Reading {
  Reading(const Frame_columns& order, const Tracks_input& input)
      : columns(order), builder(input.name, input.options.duplicates) {}

  Frame_columns columns;
  Tracks_builder builder;
  Signs_of_degrees signs;
  std::size_t rows_without_place = 0;
  std::string problem;  // the reason if it is impossible
};

class Bare_columns_reader {
 public:
  // `wanted` is frames, ids, or automatic.
  Bare_columns_reader(const Tracks_input& input, Tracks_format wanted)
      : input_(input), wanted_(wanted), table_(input.in, input.name, tracks_kind) {}

  Tracks_file read() {
    table_.watch_comments([this](std::string_view comment) { heed(comment); });
    table_.watch_rows([this](std::string_view line) { return is_row_of_ids(line); });
    while (const auto line = table_.next()) {
      split(*line);
      check_number_of_fields();
      if (readings_.empty()) begin();
      if (wanted_ == Tracks_format::frames && !is_order_confirmed() && frame_rate_line_ > 0) {
        fail_for_frame_rate();
      }
      is_row_of_ids_ = line->starts_with('#');
      rows_of_ids_ += is_row_of_ids_ ? 1 : 0;
      if (first_rows_.size() < 2 && !is_row_of_ids_) {
        first_rows_.emplace_back(fields_.begin(), fields_.end());
      }
      add_to_readings();
    }
    if (readings_.empty()) begin();
    return finished(chosen());
  }

 private:
  // ---- comments ----

  // Comments must agree with the order that is read.
  void heed(std::string_view comment) {
    const Comment_signs signs = signs_in_comment(comment);
    // Degrees may occur beside x and y.
    if (signs.column_names.empty() && says_degrees(comment)) {
      expect_projection(input_.name, table_.line(), input_.options.projection,
                        "the comment says that places are");
    }
    if (!signs.column_names.empty() || signs.frame_rate || signs.unit) ++used_comments_;
    if (!signs.column_names.empty()) heed_names(signs);
    if (signs.frame_rate) heed_frame_rate(*signs.frame_rate);
    if (signs.unit) heed_unit(signs);
  }

  void heed_names(const Comment_signs& signs) {
    if (wanted_ == Tracks_format::frames && !signs.has_expected_order) {
      fail_for_names(signs, std::string(expect_frame_first));
    }
    if (wanted_ == Tracks_format::ids && signs.columns.frame < signs.columns.id) {
      fail_for_names(signs, "; expected the id before the frame, or --format frames");
    }
    names_ = signs;
    if (first_rows_.empty()) return;
    const Frame_columns columns = columns_of(signs);
    readings_.remove_if([&](const Reading& reading) { return !(reading.columns == columns); });
    if (readings_.empty()) {
      fail_for_names(signs,
                     ", but the rows above are read in another order; expected it above all "
                     "rows");
    }
  }

  [[noreturn]] void fail_for_names(const Comment_signs& signs, const std::string& end) const {
    table_.fail(joined("the comment names the columns '", signs.column_names, "'", end));
  }

  void heed_frame_rate(double rate) {
    if (!(rate > 0)) {
      table_.fail(
          joined("the comment gives ", rate, " frames a second; expected a number greater than 0"));
    }
    const double known = frame_rate(input_.options, file_rate_);
    const bool is_known = input_.options.fps || file_rate_ || !first_rows_.empty();
    if (is_known && rate != known) {
      table_.fail(joined("the comment gives ", rate, " frames a second, but the file is read with ",
                         known, "; expected the same rate"));
    }
    file_rate_ = rate;
    frame_rate_line_ = table_.line();
  }

  void heed_unit(const Comment_signs& signs) {
    const bool is_known = unit_ || !first_rows_.empty();
    const Length_unit known = unit_.value_or(Length_unit::meter);
    if (signs.has_two_units || (is_known && *signs.unit != known)) {
      table_.fail(joined("the comment gives places in ", name_of(*signs.unit),
                         signs.has_two_units ? " and in another unit"
                                             : joined(", but the file is read in ", name_of(known)),
                         "; expected one unit, above the rows"));
    }
    unit_ = signs.unit;
  }

  bool is_order_confirmed() const { return names_.has_value(); }

  [[noreturn]] void fail_for_frame_rate() const {
    throw Input_error(input_.name, frame_rate_line_,
                      joined("the comment gives a frame rate, as in files whose columns are id, "
                             "frame, x and y",
                             expect_frame_first, or_confirm_frame_first));
  }

  // ---- rows ----

  void split(std::string_view line) {
    fields_.clear();
    for_each_field_between_blanks(line,
                                  [this](std::string_view field) { fields_.push_back(field); });
  }

  // Whether a line that begins with # is a row, whose id begins with #.
  bool is_row_of_ids(std::string_view line) {
    if (wanted_ == Tracks_format::frames || (names_ && columns_of(*names_).id != 0)) return false;
    split(line);
    const bool has_fields = number_of_fields_ == 0 ? fields_.size() == least_fields
                                                   : fields_.size() == number_of_fields_;
    if (!has_fields || fields_.front().size() < 2) return false;
    return std::all_of(fields_.begin() + 1, fields_.begin() + least_fields,
                       [](std::string_view field) {
                         return is_missing(field) || parse_number(field).problem.empty();
                       });
  }

  void check_number_of_fields() {
    if (fields_.size() < least_fields && number_of_fields_ == 0) {
      if (fields_.front().find_first_of(",;") != std::string_view::npos) {
        table_.fail(
            joined("the row has commas or semicolons; expected fields that are separated "
                   "by tabs or blanks, or ",
                   with_numbers_of_columns));
      }
      // An invalid number gives the better message.
      if (wanted_ == Tracks_format::frames) table_.number(fields_.front(), "frame");
      fail_for_fields(wanted_ == Tracks_format::frames
                          ? expect_four
                          : "at least 4, id, frame, x and y, separated by tabs or blanks");
    }
    if (number_of_fields_ == 0) {
      number_of_fields_ = fields_.size();
      if (wanted_ == Tracks_format::automatic && !names_ && number_of_fields_ > least_fields) {
        table_.fail(joined("the row has ", number_of_fields_,
                           " fields, and nothing says what they are; expected ",
                           with_numbers_of_columns,
                           ", or a comment above the rows that names "
                           "them, such as '# id frame x y z'"));
      }
    }
    if (fields_.size() == number_of_fields_) return;
    fail_for_fields(wanted_ == Tracks_format::frames
                        ? expect_four
                        : joined(number_of_fields_, ", as in the rows above"));
  }

  [[noreturn]] void fail_for_fields(std::string_view expected) const {
    table_.fail(joined("the row has ", fields_.size(), fields_.size() == 1 ? " field" : " fields",
                       "; expected ", expected));
  }

  // The readings that are possible before the first row.
  void begin() {
    if (names_) {
      readings_.emplace_back(columns_of(*names_), input_);
      return;
    }
    // Files of frames have no other columns.
    const bool may_be_frames =
        wanted_ == Tracks_format::frames ||
        (wanted_ == Tracks_format::automatic && number_of_fields_ == least_fields);
    if (may_be_frames) readings_.emplace_back(of_frames, input_);
    if (wanted_ != Tracks_format::frames) readings_.emplace_back(of_ids, input_);
  }

  // Words before the names are names of columns, too, if there are enough fields.
  Frame_columns columns_of(const Comment_signs& signs) const {
    if (wanted_ == Tracks_format::frames || fields_.size() != signs.words) return signs.columns;
    const std::size_t before = signs.words_before;
    const auto& [frame, id, x, y] = signs.columns;
    return {frame + before, id + before, x + before, y + before};
  }

  // A reading ends if its frame is not a number.
  void add_to_readings() {
    for (Reading& reading : readings_) add(reading);
    const auto is_impossible = [](const Reading& reading) { return !reading.problem.empty(); };
    if (std::all_of(readings_.begin(), readings_.end(), is_impossible)) {
      table_.fail(readings_.front().problem);
    }
    readings_.remove_if(is_impossible);
    if (wanted_ == Tracks_format::frames && fields_.size() != least_fields) {
      fail_for_fields(expect_four);
    }
  }

  void add(Reading& reading) {
    const Frame_columns& columns = reading.columns;
    if (is_row_of_ids_ && columns.id != 0) return;
    if (is_without_place(fields_[columns.x], fields_[columns.y])) {
      ++reading.rows_without_place;
      return;
    }
    const Parsed_number frame = parse_number(fields_[columns.frame]);
    if (!frame.problem.empty()) {
      reading.problem = joined("the column frame is ", in_quotes(fields_[columns.frame]),
                               ", which ", frame.problem);
      return;
    }
    Tracks_row row;
    row.id = fields_[columns.id];
    row.place = {table_.number(fields_[columns.x], "x"), table_.number(fields_[columns.y], "y")};
    if (unit_) {
      const double units = units_in_meter(*unit_);
      row.place = {row.place.x / units, row.place.y / units};
    }
    Parsed_time time = time_of_frame(frame.value, frame_rate(input_.options, file_rate_));
    if (!time.problem.empty()) table_.fail(time.problem);
    row.time = time.value;
    row.line = table_.line();
    reading.signs.note(row.place, fields_[columns.x], fields_[columns.y]);
    reading.builder.add(row);
  }

  // ---- which reading ----

  Reading& chosen() {
    if (is_order_confirmed() || wanted_ == Tracks_format::frames) return readings_.front();
    for (Reading& reading : readings_) reading.builder.settle();
    if (readings_.size() == 1) {
      Reading& only = readings_.front();
      if (const auto sign = sign_in_rows(only.builder.tracks())) {
        fail_for_sign(*sign, only.columns == of_ids);
      }
      return only;
    }
    if (readings_.front().builder.tracks().empty() && rows_of_ids_ > 0) {
      remark_ = "the columns are taken as id frame x y, since the first one begins with #";
      return readings_.back();
    }
    const auto against_frames = sign_in_rows(readings_.front().builder.tracks());
    const auto against_ids = sign_in_rows(readings_.back().builder.tracks());
    const bool has_sign_of_ids = against_frames || frame_rate_line_ > 0;
    if (has_sign_of_ids == against_ids.has_value()) fail_as_ambiguous();
    Reading& result = has_sign_of_ids ? readings_.back() : readings_.front();
    if (against_frames || against_ids) {
      remark_ =
          joined("the columns are taken as ", has_sign_of_ids ? "id frame x y" : "frame id x y",
                 ", since in the other order ", has_sign_of_ids ? *against_frames : *against_ids);
    } else {
      remark_ = "the columns are taken as id frame x y, since a comment gives a frame rate";
    }
    return result;
  }

  [[noreturn]] void fail_for_sign(const std::string& sign, bool is_of_ids) const {
    throw Input_error(
        input_.name, 0,
        is_of_ids
            ? joined(sign, as_if_exchanged,
                     number_of_fields_ == least_fields ? expect_id_first : expect_id_first_of_many)
            : joined(sign, as_if_exchanged, expect_frame_first, or_confirm_frame_first));
  }

  [[noreturn]] void fail_as_ambiguous() const {
    std::string frames;
    std::string ids;
    for (const auto& fields : first_rows_) {
      const auto append_row = [&](std::string& text, std::size_t id, std::size_t frame) {
        append(text, text.empty() ? "" : ", then ", "id ", in_quotes(fields[id]), " in frame ",
               in_quotes(fields[frame]));
      };
      append_row(frames, 1, 0);
      append_row(ids, 0, 1);
    }
    throw Input_error(
        input_.name, 0,
        joined("the rows have four columns without names, which mean either of two things: with "
               "--format frames, the order frame id x y, the file begins with ",
               frames, "; with --format ids, the order id frame x y, with ", ids,
               "; expected one of the two, or a comment '# frame id x y' or '# id frame x y' above "
               "the rows"));
  }

  Tracks_file finished(Reading& reading) {
    Tracks_file result = reading.builder.finish();
    if (wanted_ == Tracks_format::frames && !is_order_confirmed()) {
      if (const auto sign = sign_in_rows(result.tracks)) fail_for_sign(*sign, false);
    }
    reading.signs.expect_none(result, input_.name, input_.options.projection, "x", "y");
    result.format =
        reading.columns.frame < reading.columns.id ? Tracks_format::frames : Tracks_format::ids;
    result.comment_lines = table_.comments() - used_comments_;
    if (reading.columns.id != 0) result.comment_lines += rows_of_ids_;
    result.rows_without_place = reading.rows_without_place;
    note_frame_rate(result, input_, file_rate_, "frames");
    if (number_of_fields_ > least_fields) {
      const std::size_t others = number_of_fields_ - least_fields;
      result.remarks.push_back(
          joined("columns besides frame, id, x and y, which are not used: ", others));
    }
    if (!remark_.empty()) result.remarks.push_back(remark_);
    if (unit_ && *unit_ != Length_unit::meter) {
      result.remarks.push_back(joined("places are in meters; the file has ", name_of(*unit_)));
    }
    return result;
  }

  const Tracks_input& input_;
  Tracks_format wanted_;
  Table_reader table_;
  std::vector<std::string_view> fields_;  // of the row
  std::size_t number_of_fields_ = 0;      // of each row
  std::vector<std::vector<std::string>> first_rows_;
  std::list<Reading> readings_;         // the possible ones
  std::optional<Comment_signs> names_;  // of a comment that names the columns
  std::optional<double> file_rate_;
  std::size_t frame_rate_line_ = 0;  // of the comment with the rate; 0 if there is none
  std::optional<Length_unit> unit_;
  bool is_row_of_ids_ = false;     // the row begins with #
  std::size_t rows_of_ids_ = 0;    // that begin with #
  std::size_t used_comments_ = 0;  // with evidence about the rows
  std::string remark_;
};

}  // namespace

bool has_bare_columns(std::string_view head) {
  // Numbers in all fields but the id.
  const auto has_numbers = [](std::string_view line) {
    std::size_t fields = 0;
    std::size_t numbers = 0;
    for_each_field_between_blanks(line, [&](std::string_view field) {
      if (fields++ < least_fields && parse_number(field).problem.empty()) ++numbers;
    });
    return fields >= least_fields && numbers + 1 >= least_fields;
  };
  bool has_rows = false;
  bool result = false;
  for_each_line_of_head(head, [&](std::string_view line) {
    has_rows = true;
    result = has_numbers(line);
    return false;
  });
  // If all ids begin with #, the rows look like comments.
  while (!has_rows && !result && !head.empty()) {
    const std::string_view line = head.substr(0, head.find_first_of("\r\n"));
    result = line.size() > 1 && !is_blank(line[1]) && has_numbers(line);
    head.remove_prefix(std::min(line.size() + 1, head.size()));
  }
  return result;
}

Tracks_file read_frames(const Tracks_input& input) {
  return Bare_columns_reader(input, Tracks_format::frames).read();
}

Tracks_file read_ids(const Tracks_input& input) {
  return Bare_columns_reader(input, Tracks_format::ids).read();
}

Tracks_file read_frames_or_ids(const Tracks_input& input) {
  return Bare_columns_reader(input, Tracks_format::automatic).read();
}

}  // namespace kinetri
