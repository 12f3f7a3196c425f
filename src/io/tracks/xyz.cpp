// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tracks as XYZ: frames of a number of atoms, a line of comment, and a line `element x y z` for
// each atom. Extended XYZ says in its comment which fields are what
// (Properties=species:S:1:pos:R:3), the box (Lattice="..", pbc="T T F"), and often a time. i-PI
// writes the box as CELL(abcABC).
#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "atom_boxes.h"
#include "frames_of_atoms.h"
#include "kinetri/base/error.h"
#include "kinetri/impl/io/parse_number.h"
#include "kinetri/impl/io/text.h"

namespace kinetri {
namespace {

// The value of `key=value` or of `key="value"` in a comment; keys are case-insensitive.
std::optional<std::string_view> value_of(std::string_view comment, std::string_view key) {
  const std::string lower = in_lower_case(comment);
  for (std::size_t at = lower.find(key); at != std::string::npos; at = lower.find(key, at + 1)) {
    const std::size_t behind = at + key.size();
    const bool is_word = at == 0 || is_blank(lower[at - 1]);
    if (!is_word || behind >= lower.size() || lower[behind] != '=') continue;
    std::string_view rest = comment.substr(behind + 1);
    if (!rest.empty() && (rest.front() == '"' || rest.front() == '\'')) {
      const std::size_t end = rest.find(rest.front(), 1);
      return rest.substr(1, end == std::string_view::npos ? end : end - 1);
    }
    return rest.substr(0, rest.find_first_of(" \t"));
  }
  return std::nullopt;
}

// The number after one of the words, which end with a colon or an equals sign, with or without
// blanks between: `Timestep: 5` and `Time: 0.5` of LAMMPS, `step=5`, `time = 0.5,` of CP2K, `Step:
// 10` of i-PI.
std::optional<double> number_behind(std::string_view comment,
                                    std::initializer_list<std::string_view> names) {
  std::string text;
  // A comma or semicolon ends a word; a colon and an equals sign are words.
  for (const char c : comment) {
    const bool is_word = c == ':' || c == '=';
    const bool is_end = c == ',' || c == ';';
    if (is_word || is_end) text += ' ';
    if (!is_end) text += c;
    if (is_word) text += ' ';
  }
  std::vector<std::string_view> words;
  for_each_field_between_blanks(text, [&](std::string_view word) { words.push_back(word); });
  for (std::size_t i = 0; i + 2 < words.size(); ++i) {
    const std::string word = in_lower_case(words[i]);
    if (std::find(names.begin(), names.end(), word) == names.end()) continue;
    if (words[i + 1] != ":" && words[i + 1] != "=") continue;
    const Parsed_number parsed = parse_number(words[i + 2]);
    if (parsed.problem.empty()) return parsed.value;
  }
  return std::nullopt;
}

// The kind of times of a file.
enum class Times { times, steps, frames };

// The indices of the fields of an atom.
struct Columns {
  std::size_t place = 1;
  std::optional<std::size_t> id;
  std::optional<std::size_t> species = 0;
  std::size_t least_fields = 4;
};

class Xyz_reader {
 public:
  explicit Xyz_reader(const Tracks_input& input)
      : input_(input), lines_(input), builder_(input.name, input.options.duplicates) {}

  Tracks_file read() {
    while (const auto line = lines_.next()) {
      if (line->empty()) continue;
      read_frame(lines_.count(*line));
    }
    Tracks_file result = builder_.finish();
    boxes_.settle_jumps(result, input_,
                        "expected places that go on beyond the box, or pbc=\"F F F\" in the "
                        "comments if these do");
    result.format = Tracks_format::xyz;
    if (times_ != Times::times) {
      note_frame_rate(result, input_, std::nullopt,
                      times_ == Times::steps ? "timesteps" : "frames");
    }
    if (!has_ids_) result.remarks.push_back("ids are the numbers of atoms in a frame, from 0 on");
    result.remarks.push_back("the third coordinate of the atoms is left out");
    unused_.add_remarks(result);
    return result;
  }

 private:
  void read_frame(std::size_t atoms) {
    // A copy, since reading the next line overwrites it.
    const std::string comment(lines_.expect("a comment"));
    const Columns columns = columns_of(comment);
    const double time = time_of(comment);
    add_box(comment);
    if (frame_ > 0 && columns.id.has_value() != has_ids_) {
      lines_.fail(
          "the atoms of some frames have ids, and those of others have not; expected ids in "
          "all or in none");
    }
    if (!columns.id) expect_number_of_atoms(atoms);
    for (std::size_t i = 0; i < atoms; ++i) {
      const auto& fields = lines_.atom(i, atoms, columns.least_fields);
      unused_.add_without_names(fields.size() - columns.least_fields);
      const std::string index = joined(i);
      if (!columns.id && columns.species) expect_species(i, fields[*columns.species]);
      builder_.add({columns.id ? fields[*columns.id] : std::string_view(index),
                    {time},
                    {lines_.number(fields[columns.place], "x"),
                     lines_.number(fields[columns.place + 1], "y")},
                    lines_.line()});
    }
    ++frame_;
    has_ids_ = columns.id.has_value();
  }

  Columns columns_of(std::string_view comment) {
    Columns result;
    const auto properties = value_of(comment, "properties");
    if (!properties) return result;
    std::vector<std::string_view> parts;
    for (std::string_view rest = *properties;;) {
      const std::size_t colon = rest.find(':');
      parts.push_back(rest.substr(0, colon));
      if (colon == std::string_view::npos) break;
      rest.remove_prefix(colon + 1);
    }
    std::optional<std::size_t> place;
    std::size_t field = 0;
    result.species.reset();
    for (std::size_t i = 0; i + 3 <= parts.size(); i += 3) {
      const std::string name = in_lower_case(parts[i]);
      const Parsed_number number = parse_number(parts[i + 2]);
      constexpr double most_fields = 1000;
      if (!number.problem.empty() || !(number.value >= 1 && number.value <= most_fields)) {
        fail_for_properties(*properties);
      }
      const auto fields = static_cast<std::size_t>(number.value);
      if (name == "pos" && parts[i + 1] == "R" && fields >= 2) place = field;
      if (name == "id" && fields == 1) result.id = field;
      if (name == "species" && fields == 1) result.species = field;
      field += fields;
    }
    note_unused(parts, result);
    if (!place || parts.size() % 3 != 0) fail_for_properties(*properties);
    result.place = *place;
    result.least_fields = field;
    return result;
  }

  // Records unused properties of `parts`. The species distinguish atoms without ids.
  void note_unused(const std::vector<std::string_view>& parts, const Columns& columns) {
    for (std::size_t i = 0; i + 3 <= parts.size(); i += 3) {
      const std::string name = in_lower_case(parts[i]);
      const bool is_species = name == "species" && columns.species && !columns.id;
      if (name != "pos" && !(name == "id" && columns.id) && !is_species) unused_.add(parts[i]);
    }
  }

  [[noreturn]] void fail_for_properties(std::string_view properties) const {
    lines_.fail(
        joined("the properties are ", in_quotes(properties),
               "; expected names, types and numbers of fields with pos:R:3 among them, such "
               "as species:S:1:pos:R:3"));
  }

  double time_of(std::string_view comment) {
    double result = static_cast<double>(frame_);
    Times times = Times::frames;
    if (const auto time = value_of(comment, "time")) {
      result = lines_.number(*time, "Time");
      times = Times::times;
    } else if (const auto number = number_behind(comment, {"time", "t"})) {
      result = *number;
      times = Times::times;
    } else if (const auto step = number_behind(comment, {"timestep", "step"})) {
      result = *step;
      times = Times::steps;
    }
    if (frame_ > 0 && times != times_) {
      lines_.fail(
          "the comments of some frames give times or timesteps, and those of others do not; "
          "expected the same in all");
    }
    times_ = times;
    if (times == Times::times) return result;
    const Parsed_time time = time_of_frame(result, frame_rate(input_.options, std::nullopt));
    if (!time.problem.empty()) lines_.fail(time.problem);
    return time.value.number;
  }

  void add_box(std::string_view comment) {
    const auto lattice = value_of(comment, "lattice");
    if (!lattice) {
      add_cell(comment);
      return;
    }
    std::vector<double> numbers;
    for_each_field_between_blanks(*lattice, [&](std::string_view field) {
      numbers.push_back(lines_.number(field, "Lattice"));
    });
    if (numbers.size() != 9) {
      lines_.fail(joined("the lattice has ", numbers.size(), " numbers; expected 9"));
    }
    Atom_box box;
    box.is_periodic = periodic_directions(comment);
    for (std::size_t i = 0; i < 3; ++i) box.edges[i] = {numbers[3 * i], numbers[3 * i + 1]};
    boxes_.add(lines_.line(), box);
  }

  static std::array<bool, 3> periodic_directions(std::string_view comment) {
    std::vector<std::string_view> flags;
    for_each_field_between_blanks(value_of(comment, "pbc").value_or("T T T"),
                                  [&](std::string_view flag) { flags.push_back(flag); });
    std::array<bool, 3> result = {};
    for (std::size_t i = 0; i < 3; ++i) {
      result[i] = i < flags.size() && (flags[i] == "T" || flags[i] == "1");
    }
    return result;
  }

  // Of i-PI: `CELL(abcABC): 10.0 10.0 10.0 90.0 90.0 90.0 ... positions{angstrom} cell{angstrom}`,
  // the lengths of the edges and the angles between b and c, a and c, a and b; a is along x, and b
  // in the plane (https://docs.ipi-code.org, class Cell).
  void add_cell(std::string_view comment) {
    constexpr std::string_view key = "cell(abcabc):";
    const std::string lower = in_lower_case(comment);
    const std::size_t at = lower.find(key);
    if (at == std::string::npos) return;
    std::vector<double> numbers;
    for_each_field_between_blanks(comment.substr(at + key.size()), [&](std::string_view field) {
      if (numbers.size() < 6) numbers.push_back(lines_.number(field, "CELL(abcABC)"));
    });
    if (numbers.size() < 6) {
      lines_.fail(joined("the cell has ", numbers.size(), " numbers; expected 6"));
    }
    const std::optional<double> unit = unit_of_cell(lower);
    if (!unit) {
      lines_.fail(
          "the cell has another unit than the positions; expected one unit, or angstrom and "
          "atomic_unit");
    }
    const auto cosine = [](double degrees) {
      return degrees == 90 ? 0 : std::cos(radians(degrees));
    };
    const double a = *unit * numbers[0];
    const double b = *unit * numbers[1];
    const double c = *unit * numbers[2];
    const double sine = std::sin(radians(numbers[5]));
    Atom_box box;
    box.edges = {{{a, 0},
                  {b * cosine(numbers[5]), b * sine},
                  {c * cosine(numbers[4]),
                   c * (cosine(numbers[3]) - cosine(numbers[4]) * cosine(numbers[5])) / sine}}};
    box.is_periodic = periodic_directions(comment);
    boxes_.add(lines_.line(), box);
  }

  static double radians(double degrees) { return degrees * std::numbers::pi / 180; }

  // The unit of the cell in units of the positions; none if unknown.
  static std::optional<double> unit_of_cell(const std::string& comment) {
    constexpr double angstroms_in_bohr = 0.529177210903;  // CODATA 2018
    const auto unit_behind = [&](std::string_view name) -> std::string {
      const std::size_t at = comment.find(name);
      if (at == std::string::npos) return "atomic_unit";
      const std::size_t begin = at + name.size();
      return comment.substr(begin, comment.find('}', begin) - begin);
    };
    const std::string of_positions = unit_behind("positions{");
    const std::string of_cell = unit_behind("cell{");
    if (of_positions == of_cell) return 1;
    if (of_positions == "angstrom" && of_cell == "atomic_unit") return angstroms_in_bohr;
    if (of_positions == "atomic_unit" && of_cell == "angstrom") return 1 / angstroms_in_bohr;
    return std::nullopt;
  }

  // Only their order identifies atoms.
  void expect_number_of_atoms(std::size_t atoms) {
    if (frame_ > 0 && atoms != atoms_) {
      lines_.fail(joined("the frame has ", atoms, " atoms, but the first one ", atoms_,
                         ", and atoms have no ids; expected the same atoms in all frames, or "
                         "extended XYZ with id:I:1 in its properties"));
    }
    atoms_ = atoms;
  }

  void expect_species(std::size_t atom, std::string_view species) {
    if (atom == species_.size()) species_.emplace_back(species);
    if (species_[atom] == species) return;
    lines_.fail(joined("atom ", atom, " of the frame is ", in_quotes(species), ", but ",
                       in_quotes(species_[atom]),
                       " in the first one; expected atoms in the same order in all frames"));
  }

  const Tracks_input& input_;
  Atom_lines lines_;
  Tracks_builder builder_;
  Atom_boxes boxes_;
  std::size_t frame_ = 0;
  std::size_t atoms_ = 0;
  bool has_ids_ = false;
  Times times_ = Times::frames;
  Unused_names unused_;
  std::vector<std::string> species_;  // of the atoms of a frame, if they have no ids
};

}  // namespace

bool is_xyz(std::string_view head) {
  const std::string_view first = trimmed(head.substr(0, head.find_first_of("\r\n")));
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  return !first.empty() && std::all_of(first.begin(), first.end(), is_digit);
}

Tracks_file read_xyz(const Tracks_input& input) {
  return Xyz_reader(input).read();
}

}  // namespace kinetri
