// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tracks as text dumps of LAMMPS: sections ITEM: UNITS once and ITEM: TIME, if asked for, before
// ITEM: TIMESTEP (write_header in src/dump_custom.cpp of LAMMPS) or after it, ITEM: NUMBER OF
// ATOMS, ITEM: BOX BOUNDS and ITEM: ATOMS with the names of columns, of which id and x y, xu yu, xs
// ys or xsu ysu are read; ix iy iz are numbers of images.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "atom_boxes.h"
#include "frames_of_atoms.h"
#include "kinetri/base/error.h"
#include "kinetri/impl/io/text.h"

namespace kinetri {
namespace {

constexpr std::string_view item = "ITEM:";
constexpr std::string_view expected_columns =
    "; expected id, and x y, xu yu, xs ys or xsu ysu, in ITEM: ATOMS";
constexpr std::size_t none = static_cast<std::size_t>(-1);

// The columns of a section.
struct Columns {
  std::size_t id = none;
  // x, y and z, which is needed if the box is tilted toward z.
  std::array<std::size_t, 3> place = {none, none, none};
  std::array<std::size_t, 3> image = {none, none, none};
  bool is_scaled = false;
  bool is_unwrapped = false;
  std::size_t least_fields = 0;

  // Whether images convert wrapped positions to unwrapped ones.
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
        lines_.fail(joined("the line is ", in_quotes(*line), "; expected ITEM: and a section"));
      }
      read_section(std::string(trimmed(line->substr(item.size()))));
    }
    if (timestep_ || time_) {
      lines_.fail("the file ends in the middle of a frame; expected its atoms");
    }
    Tracks_file result = builder_.finish();
    boxes_.settle_jumps(result, input_,
                        "expected a dump with xu yu, or with x y ix iy iz, and enough frames");
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
      lines_.fail(joined("the section is ", in_quotes(section),
                         "; expected TIMESTEP, TIME, UNITS, NUMBER OF ATOMS, BOX BOUNDS or ATOMS"));
    }
  }

  // A frame begins after the atoms of the previous one, with its time or its timestep.
  void expect_first(bool is_there, const std::string& section) const {
    if (!is_there) return;
    lines_.fail(joined("the frame has ITEM: ", section, " twice; expected its atoms between"));
  }

  // By the bounds of the rectangle around a box, which is tilted by xy, xz and yz
  // (https://docs.lammps.org/Howto_triclinic.html), or by its three edges and its corner (abc
  // origin, https://docs.lammps.org/dump.html).
  void read_box(const std::string& section) {
    std::vector<std::string_view> flags;
    for_each_field_between_blanks(std::string_view(section).substr(10),
                                  [&](std::string_view flag) { flags.push_back(flag); });
    const bool has_edges = !flags.empty() && flags.front() == "abc";
    const bool is_tilted = !flags.empty() && flags.front() == "xy";
    const std::size_t first = flags.size() < 3 ? flags.size() : flags.size() - 3;
    std::array<std::vector<double>, 3> numbers;
    for (std::vector<double>& of_line : numbers) {
      for_each_field_between_blanks(
          lines_.expect("the bounds of the box"),
          [&](std::string_view field) { of_line.push_back(lines_.number(field, "BOX BOUNDS")); });
      if (has_edges ? of_line.size() == 4
                    : of_line.size() >= (is_tilted ? 3 : 2) && of_line[0] <= of_line[1]) {
        continue;
      }
      lines_.fail(has_edges
                      ? "an edge of the box is no three numbers, with one of the corner behind "
                        "them; expected four numbers"
                      : "the bounds of the box are no two numbers of which the second is the "
                        "greater; expected the lower and the upper bound");
    }
    box_ = Atom_box{};
    for (std::size_t i = 0; i < 3; ++i) {
      box_->is_periodic[i] = first + i < flags.size() && flags[first + i] == "pp";
      if (has_edges) box_->edges[i] = {numbers[i][0], numbers[i][1]};
    }
    if (has_edges) {
      box_->corner = {numbers[0][3], numbers[1][3]};
      return;
    }
    const double xy = is_tilted ? numbers[0][2] : 0;
    const double xz = is_tilted ? numbers[1][2] : 0;
    const double yz = is_tilted ? numbers[2][2] : 0;
    const double left = numbers[0][0] - std::min({0., xy, xz, xy + xz});
    const double right = numbers[0][1] - std::max({0., xy, xz, xy + xz});
    const double bottom = numbers[1][0] - std::min(0., yz);
    const double top = numbers[1][1] - std::max(0., yz);
    box_->corner = {left, bottom};
    box_->edges = {{{right - left, 0}, {xy, top - bottom}, {xz, yz}}};
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
      std::string_view x, y, z;
      bool is_scaled, is_unwrapped;
    };
    constexpr std::array<Kind, 4> kinds = {{{"xu", "yu", "zu", false, true},
                                            {"x", "y", "z", false, false},
                                            {"xsu", "ysu", "zsu", true, true},
                                            {"xs", "ys", "zs", true, false}}};
    const auto kind = std::find_if(kinds.begin(), kinds.end(), [&](const Kind& candidate) {
      return index(candidate.x) != none && index(candidate.y) != none;
    });
    if (result.id == none || kind == kinds.end()) {
      lines_.fail(
          joined("the atoms have no ", result.id == none ? "id" : "places", expected_columns));
    }
    result.place = {index(kind->x), index(kind->y), index(kind->z)};
    result.image = {index("ix"), index("iy"), index("iz")};
    result.is_scaled = kind->is_scaled;
    result.is_unwrapped = kind->is_unwrapped;
    constexpr std::array<std::string_view, 4> third = {"z", "zu", "zs", "zsu"};
    const auto is_among = [](std::size_t i, const std::array<std::size_t, 3>& fields) {
      return i == fields[0] || i == fields[1];
    };
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const bool is_third = std::find(third.begin(), third.end(), columns[i]) != third.end();
      has_third_ = has_third_ || is_third;
      const bool is_image = result.adds_images() && (is_among(i, result.image) ||
                                                     (i == result.image[2] && leads_toward_z()));
      if (i != result.id && !is_among(i, result.place) && !is_image && !is_third) {
        unused_.add(columns[i]);
      }
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
    expect_box(columns);
    if (box_) boxes_.add(lines_.line(), *box_, !columns.is_unwrapped && !has_images);
    const double time = time_of_section();
    for (std::size_t i = 0; i < *atoms_; ++i) {
      const auto& fields = lines_.atom(i, *atoms_, columns.least_fields);
      builder_.add({fields[columns.id], {time}, place_of(fields, columns), lines_.line()});
    }
    timestep_.reset();
    time_.reset();
    atoms_.reset();
  }

  // Whether the third edge of the box is tilted.
  bool leads_toward_z() const { return box_ && !(box_->edges[2] == Vector_2{}); }

  // Positions may need the box, and third coordinates.
  void expect_box(const Columns& columns) const {
    if (!columns.is_scaled && !columns.adds_images()) return;
    if (!box_) {
      lines_.fail(
          "scaled places and images need the box; expected ITEM: BOX BOUNDS above, or xu yu");
    }
    if (!leads_toward_z()) return;
    const bool has_all = (!columns.is_scaled || columns.place[2] != none) &&
                         (!columns.adds_images() || columns.image[2] != none);
    if (has_all) return;
    lines_.fail(joined("the box is tilted toward z; expected ",
                       columns.is_scaled ? (columns.is_unwrapped ? "zsu" : "zs") : "",
                       columns.is_scaled && columns.adds_images() ? " and " : "",
                       columns.adds_images() ? "iz" : "", " as well, or xu yu"));
  }

  Vector_2 place_of(const std::vector<std::string_view>& fields, const Columns& columns) const {
    Vector_2 result;
    const auto add_edges = [&](const std::array<std::size_t, 3>& of_edges, std::string_view names) {
      for (std::size_t i = 0; i < (leads_toward_z() ? 3 : 2); ++i) {
        const double times = lines_.number(fields[of_edges[i]], names);
        result.x += times * box_->edges[i].x;
        result.y += times * box_->edges[i].y;
      }
    };
    if (columns.is_scaled) {
      result = box_->corner;
      add_edges(columns.place, "of a scaled place");
    } else {
      result = {lines_.number(fields[columns.place[0]], "x"),
                lines_.number(fields[columns.place[1]], "y")};
    }
    if (columns.adds_images()) add_edges(columns.image, "ix, iy or iz");
    if (!std::isfinite(result.x) || !std::isfinite(result.y)) {
      lines_.fail("the place is out of the range of binary64; expected smaller numbers");
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
  Atom_boxes boxes_;
  std::optional<double> timestep_;  // of the frame
  std::optional<double> time_;      // of the frame
  std::optional<std::size_t> atoms_;
  std::optional<bool> has_times_;  // of all frames so far
  std::optional<Atom_box> box_;
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
