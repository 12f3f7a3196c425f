// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tracks as text dumps of LAMMPS: sections ITEM: UNITS once and ITEM: TIME, if asked for, before
// ITEM: TIMESTEP (write_header in src/dump_custom.cpp of LAMMPS) or behind it, ITEM: NUMBER OF
// ATOMS, ITEM: BOX BOUNDS and ITEM: ATOMS with the names of columns, of which id and x y, xu yu, xs
// ys or xsu ysu are read; ix iy say how often an atom has gone around the box.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "frames_of_atoms.h"
#include "kinetri/base/error.h"
#include "kinetri/impl/io/text.h"

namespace kinetri {
namespace {

constexpr std::string_view item = "ITEM:";
constexpr std::string_view expected_columns =
    "; expected id, and x y, xu yu, xs ys or xsu ysu, in ITEM: ATOMS";
constexpr std::size_t none = static_cast<std::size_t>(-1);

// One direction of the box.
struct Bounds {
  double low = 0;
  double high = 0;
  bool is_periodic = false;

  double width() const { return high - low; }
};

// How the columns of a section give places.
struct Columns {
  std::size_t id = none;
  std::array<std::size_t, 2> place = {none, none};
  std::array<std::size_t, 2> image = {none, none};
  bool is_scaled = false;
  bool is_unwrapped = false;
  std::size_t least_fields = 0;

  // Whether images lead from wrapped places to the path.
  bool adds_images() const { return image[0] != none && image[1] != none && !is_unwrapped; }
};

class Lammps_reader {
 public:
  explicit Lammps_reader(const Tracks_input& input)
      : input_(input), lines_(input), builder_(input.name, input.options.duplicates) {}

  Tracks_file read() {
    while (const auto line = lines_.next()) {
      if (line->empty()) continue;
      if (!line->starts_with(item)) {
        lines_.fail(joined("the line is ", quoted(*line), "; expected ITEM: and a section"));
      }
      read_section(std::string(trimmed(line->substr(item.size()))));
    }
    if (timestep_ || time_) {
      lines_.fail("the file ends in the middle of a frame; expected its atoms");
    }
    Tracks_file result = builder_.finish();
    widths_.settle_jumps(result, input_,
                         "expected a dump with xu yu, or with x y ix iy, and enough frames");
    result.format = Tracks_format::lammps;
    if (has_times_.value_or(false)) {
      result.remarks.push_back("times are those of ITEM: TIME");
    } else {
      note_frame_rate(result, input_, std::nullopt, "timesteps");
    }
    if (has_third_) result.remarks.push_back("the third coordinate of the atoms is left out");
    unused_.add_remarks(result);
    return result;
  }

 private:
  void read_section(const std::string& section) {
    if (section == "TIMESTEP") {
      expect_first(timestep_.has_value(), section);
      timestep_ = lines_.number(lines_.expect("a timestep"), "TIMESTEP");
    } else if (section == "TIME") {
      expect_first(time_.has_value(), section);
      time_ = lines_.number(lines_.expect("a time"), "TIME");
    } else if (section == "UNITS") {
      lines_.expect("the style of units");
    } else if (section == "NUMBER OF ATOMS") {
      atoms_ = lines_.count(lines_.expect("the number of atoms"));
    } else if (section.starts_with("BOX BOUNDS")) {
      read_box(section);
    } else if (section.starts_with("ATOMS")) {
      read_atoms(section.substr(5));
    } else {
      lines_.fail(joined("the section is ", quoted(section),
                         "; expected TIMESTEP, TIME, UNITS, NUMBER OF ATOMS, BOX BOUNDS or ATOMS"));
    }
  }

  // A frame begins behind the atoms of the one before, with its time or its timestep.
  void expect_first(bool is_there, const std::string& section) const {
    if (!is_there) return;
    lines_.fail(joined("the frame has ITEM: ", section, " twice; expected its atoms between"));
  }

  void read_box(const std::string& section) {
    std::vector<std::string_view> flags;
    for_each_field_between_blanks(std::string_view(section).substr(10),
                                  [&](std::string_view flag) { flags.push_back(flag); });
    is_tilted_ = !flags.empty() && flags.front() == "xy";
    // A box in any direction, by its three edges.
    has_box_ = flags.empty() || flags.front() != "abc";
    const std::size_t first = flags.size() < 3 ? flags.size() : flags.size() - 3;
    std::array<double, 3> tilts = {};  // xy, xz, yz
    for (std::size_t i = 0; i < 3; ++i) {
      std::vector<double> numbers;
      for_each_field_between_blanks(
          lines_.expect("the bounds of the box"),
          [&](std::string_view field) { numbers.push_back(lines_.number(field, "BOX BOUNDS")); });
      if (!has_box_) continue;
      if (numbers.size() < (is_tilted_ ? 3 : 2) || numbers[0] > numbers[1]) {
        lines_.fail(
            "the bounds of the box are no two numbers of which the second is the greater; "
            "expected the lower and the upper bound");
      }
      if (is_tilted_) tilts[i] = numbers[2];
      if (i > 1) continue;
      bounds_[i] = {numbers[0], numbers[1], first + i < flags.size() && flags[first + i] == "pp"};
    }
    // The bounds of a tilted box are those of the rectangle around it
    // (https://docs.lammps.org/Howto_triclinic.html).
    const auto [xy, xz, yz] = tilts;
    if (xy != 0) widths_.add_tilt();
    bounds_[0].low -= std::min({0., xy, xz, xy + xz});
    bounds_[0].high -= std::max({0., xy, xz, xy + xz});
    bounds_[1].low -= std::min(0., yz);
    bounds_[1].high -= std::max(0., yz);
  }

  Columns columns_of(std::string_view names) {
    std::vector<std::string_view> columns;
    for_each_field_between_blanks(names, [&](std::string_view name) { columns.push_back(name); });
    const auto index = [&](std::string_view name) {
      const auto found = std::find(columns.begin(), columns.end(), name);
      return found == columns.end() ? none : static_cast<std::size_t>(found - columns.begin());
    };
    Columns result;
    result.id = index("id");
    result.least_fields = columns.size();
    struct Kind {
      std::string_view x, y;
      bool is_scaled, is_unwrapped;
    };
    constexpr std::array<Kind, 4> kinds = {{{"xu", "yu", false, true},
                                            {"x", "y", false, false},
                                            {"xsu", "ysu", true, true},
                                            {"xs", "ys", true, false}}};
    const auto kind = std::find_if(kinds.begin(), kinds.end(), [&](const Kind& candidate) {
      return index(candidate.x) != none && index(candidate.y) != none;
    });
    if (result.id == none || kind == kinds.end()) {
      lines_.fail(
          joined("the atoms have no ", result.id == none ? "id" : "places", expected_columns));
    }
    result.place = {index(kind->x), index(kind->y)};
    result.image = {index("ix"), index("iy")};
    result.is_scaled = kind->is_scaled;
    result.is_unwrapped = kind->is_unwrapped;
    constexpr std::array<std::string_view, 4> third = {"z", "zu", "zs", "zsu"};
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const bool is_third = std::find(third.begin(), third.end(), columns[i]) != third.end();
      has_third_ = has_third_ || is_third;
      const bool is_place = i == result.place[0] || i == result.place[1];
      const bool is_image = result.adds_images() && (i == result.image[0] || i == result.image[1]);
      if (i != result.id && !is_place && !is_image && !is_third) unused_.add(columns[i]);
    }
    return result;
  }

  void read_atoms(std::string_view names) {
    if (!timestep_ || !atoms_) {
      lines_.fail(
          "the atoms come before their timestep or number; expected ITEM: TIMESTEP and "
          "ITEM: NUMBER OF ATOMS above");
    }
    const Columns columns = columns_of(names);
    const bool has_images = columns.image[0] != none && columns.image[1] != none;
    if ((columns.is_scaled || columns.adds_images()) && (!has_box_ || is_tilted_)) {
      lines_.fail(
          "scaled places and images need a box that is a rectangle; expected xu yu, or x y "
          "without ix iy, or such a box");
    }
    for (std::size_t i = 0; has_box_ && i < 2; ++i) {
      const bool may_jump = !columns.is_unwrapped && !has_images;
      if (may_jump && bounds_[i].is_periodic) widths_.add(i, bounds_[i].width());
    }
    const double time = time_of_section();
    for (std::size_t i = 0; i < *atoms_; ++i) {
      const auto& fields = lines_.atom(i, *atoms_, columns.least_fields);
      const auto coordinate = [&](std::size_t direction) {
        return coordinate_of(fields, columns, direction);
      };
      builder_.add({fields[columns.id], {time}, {coordinate(0), coordinate(1)}, lines_.line()});
    }
    timestep_.reset();
    time_.reset();
    atoms_.reset();
  }

  double coordinate_of(const std::vector<std::string_view>& fields, const Columns& columns,
                       std::size_t direction) const {
    const std::string_view name = direction == 0 ? "x" : "y";
    const Bounds& bounds = bounds_[direction];
    double result = lines_.number(fields[columns.place[direction]], name);
    if (columns.is_scaled) result = bounds.low + result * bounds.width();
    if (columns.adds_images()) {
      result += lines_.number(fields[columns.image[direction]], "ix or iy") * bounds.width();
    }
    if (!std::isfinite(result)) {
      lines_.fail(joined("the place ", name,
                         " is out of the range of binary64; expected smaller "
                         "numbers"));
    }
    return result;
  }

  double time_of_section() {
    if (has_times_.value_or(time_.has_value()) != time_.has_value()) {
      lines_.fail(
          "some frames have ITEM: TIME, and others have not; expected it in all or in none");
    }
    has_times_ = time_.has_value();
    if (time_) return *time_;
    const Parsed_time time = time_of_frame(*timestep_, frame_rate(input_.options, std::nullopt));
    if (!time.problem.empty()) lines_.fail(time.problem);
    return time.value.number;
  }

  const Tracks_input& input_;
  Atom_lines lines_;
  Tracks_builder builder_;
  Periodic_widths widths_;
  std::optional<double> timestep_;  // of the frame
  std::optional<double> time_;      // of the frame
  std::optional<std::size_t> atoms_;
  std::optional<bool> has_times_;  // of all frames so far
  std::array<Bounds, 2> bounds_;
  bool has_box_ = false;
  bool is_tilted_ = false;
  bool has_third_ = false;
  Unused_names unused_;
};

}  // namespace

bool is_lammps(std::string_view head) {
  return head.starts_with(item);
}

Tracks_file read_lammps(const Tracks_input& input) {
  return Lammps_reader(input).read();
}

}  // namespace kinetri
