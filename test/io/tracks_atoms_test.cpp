// SPDX-License-Identifier: GPL-3.0-or-later
//
// Dumps of LAMMPS, and XYZ.
#include <gtest/gtest.h>

#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "kinetri/io/tracks_file.h"
#include "support/tracks_text.h"

namespace kinetri::tracks_atoms_test {
namespace {

using test::has_piece;
using test::read_options;
using test::read_options_error;
using test::shown;

std::string error_of(const std::string& text) {
  return read_options_error(text, {});
}

// ---- LAMMPS ----

// A frame in a box from 0 to 10 and from -4 to 4, with periodic boundaries in x.
std::string frame(int timestep, const std::string& columns, const std::vector<std::string>& atoms,
                  const std::string& flags = "pp ff pp") {
  std::string result = "ITEM: TIMESTEP\n" + std::to_string(timestep) + "\nITEM: NUMBER OF ATOMS\n" +
                       std::to_string(atoms.size()) + "\nITEM: BOX BOUNDS " + flags +
                       "\n0 1e1\n-4 4\n-0.5 0.5\nITEM: ATOMS " + columns + "\n";
  for (const std::string& atom : atoms) result += atom + "\n";
  return result;
}

TEST(Read_tracks_lammps, reads_places_of_every_kind) {
  const std::string expected =
      "7: 0 (1.5, -2) line 10 100 (2, -2) line 21; 3: 0 (9.5, 0.5) line 11 100 (12.5, 1) line 22";
  for (const auto& [columns, atoms] : std::vector<std::pair<std::string, std::vector<std::string>>>{
           {"id type xu yu zu", {"7 1 1.5 -2 0", "3 1 9.5 .5 0", "7 1 2 -2 0", "3 1 12.5 1 0"}},
           {"y vx x id iy ix",
            {"-2 0 1.5 7 0 0", "0.5 0 9.5 3 0 0", "-2 0 2 7 0 0", "1 0 2.5 3 0 1"}},
           {"id xsu ysu", {"7 0.15 0.25", "3 0.95 0.5625", "7 0.2 0.25", "3 1.25 0.625"}},
           {"id xs ys ix iy",
            {"7 0.15 0.25 0 0", "3 0.95 0.5625 0 0", "7 0.2 0.25 0 0", "3 0.25 0.625 1 0"}},
           // What is unwrapped counts if both are there.
           {"id x y xu yu", {"7 0 0 1.5 -2", "3 0 0 9.5 0.5", "7 0 0 2 -2", "3 2.5 1 12.5 1"}}}) {
    SCOPED_TRACE(columns);
    const Tracks_file file = read_options(
        frame(0, columns, {atoms[0], atoms[1]}) + frame(100, columns, {atoms[2], atoms[3]}), {});
    EXPECT_EQ(shown(file), expected);
    EXPECT_EQ(file.format, Tracks_format::lammps);
  }
}

TEST(Read_tracks_lammps, timesteps_are_divided_by_the_rate) {
  const std::string text = frame(0, "id x y", {"7 1.5 -2"}) + frame(10, "id x y", {"7 2 -2"});
  const Tracks_file file = read_options(text, {.fps = 25});
  EXPECT_EQ(shown(file), "7: 0 (1.5, -2) line 10 0.4 (2, -2) line 20");
  EXPECT_EQ(file.frame_rate, 25);
  EXPECT_EQ(
      read_options(text, {}).remarks,
      std::vector<std::string>{"times are numbers of timesteps, since the file has no rate of "
                               "them and --fps gives none"});
  const auto timed = [](const std::string& time) {
    return "ITEM: UNITS\nlj\nITEM: TIMESTEP\n100\n" + time +
           "ITEM: NUMBER OF ATOMS\n1\nITEM: ATOMS id x y\n7 1 2\n";
  };
  EXPECT_EQ(shown(read_options(timed("ITEM: TIME\n0.25\n"), {})), "7: 0.25 (1, 2) line 10");
  EXPECT_FALSE(read_options(timed("ITEM: TIME\n0.25\n"), {}).frame_rate);
  EXPECT_EQ(error_of(timed("ITEM: TIME\n0.25\n") + timed("")),
            "t.csv:17: some frames have ITEM: TIME, and others have not; expected it in all or in "
            "none");
}

TEST(Read_tracks_lammps, jumps_through_the_boundary_are_refused) {
  const auto two = [](const std::string& a, const std::string& b, const std::string& flags) {
    return error_of(frame(0, "id x y", {a}, flags) + frame(1, "id x y", {b}, flags));
  };
  EXPECT_EQ(two("7 9.5 0", "7 0.25 0", "pp ff pp"),
            "t.csv:20: atom '7' goes 9.25 since line 10, more than half of the periodic box, which "
            "is 10 wide: it left on one side and came in on the other; expected a dump with xu yu, "
            "or with x y ix iy iz, and enough frames, or --unwrap nearest, which lets atoms go the "
            "shortest way");
  EXPECT_NE(two("7 5 3.5", "7 5 -1", "ff pp pp"), "");
  EXPECT_EQ(two("7 5 3.5", "7 5 -1", "pp ff pp"), "");
  EXPECT_EQ(two("7 9.5 0", "7 0.25 0", "ff pp pp"), "");
  EXPECT_EQ(two("7 9.5 0", "7 4.5 0", "pp pp pp"), "");
}

TEST(Read_tracks_lammps, errors_name_the_line) {
  for (const auto& [text, message] : {
           std::pair{std::string("ITEM: TIMESTEP\nzero\n"),
                     "2: the column TIMESTEP is 'zero', which is not a number; expected a decimal "
                     "or hexadecimal floating point number such as -1.5, 2e-3 or 0x1.8p3"},
           {"ITEM: TIMESTEP\n", "2: the file ends in the middle of a frame; expected a timestep"},
           {"ITEM: TIMESTEP\n0\n", "3: the file ends in the middle of a frame; expected its atoms"},
           {"ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n-1\n",
            "4: the number of atoms is '-1'; expected a whole number"},
           {"ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1000000000\nITEM: ATOMS id x y\n1 2 3\n",
            "7: the file ends after 1 of the 1000000000 atoms of a frame; expected all of them"},
           {"ITEM: ATOMS id x y\n",
            "1: the atoms come before their timestep or number; expected ITEM: TIMESTEP and ITEM: "
            "NUMBER OF ATOMS above"},
           {frame(0, "type x y", {"1 2 3"}),
            "9: the atoms have no id; expected id, and x y, xu yu, xs ys or xsu ysu, in ITEM: "
            "ATOMS"},
           {frame(0, "id xu y", {"1 2 3"}),
            "9: the atoms have no places; expected id, and x y, xu yu, xs ys or xsu ysu, in ITEM: "
            "ATOMS"},
           {frame(0, "id x y", {"1 2"}), "10: the atom has 2 fields; expected at least 3"},
           {frame(0, "id x y", {"1 2 nan"}),
            "10: the column y is 'nan', which is not finite; expected a finite number"},
           {frame(0, "id x y", {"1 2 3", "1 2 4"}),
            "11: id '1' is at two places at t = 0: at (2, 4), and at (2, 3) in line 10; expected "
            "one, or --duplicates first, last or mean, which says what to take"},
           {"ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: ATOMS id xs ys\n1 2 3\n",
            "5: scaled places and images need the box; expected ITEM: BOX BOUNDS above, or xu yu"},
           {"ITEM: TIMESTEP\n0\nITEM: BOX BOUNDS abc origin pp pp pp\n4 3 0\n",
            "4: an edge of the box is no three numbers, with one of the corner behind them; "
            "expected four numbers"},
           {"ITEM: TIMESTEP\n0\nITEM: BOX BOUNDS pp pp pp\n4 3\n",
            "4: the bounds of the box are no two numbers of which the second is the greater; "
            "expected the lower and the upper bound"},
           {"ITEM: NOTHING\n",
            "1: the section is 'NOTHING'; expected TIMESTEP, TIME, UNITS, NUMBER OF ATOMS, BOX "
            "BOUNDS or ATOMS"},
           {frame(0, "id x y", {"1 2 3"}) + "1 2 3\n",
            "11: the line is '1 2 3'; expected ITEM: and a section"},
       }) {
    EXPECT_EQ(error_of(text), "t.csv:" + std::string(message));
  }
}

// One atom in a box that is tilted by xy = 5, with the edges (10, 0) and (5, 10), in two forms.
std::string tilted_frame(int timestep, const std::string& columns, const std::string& atom,
                         bool has_edges = false, const std::string& toward_z = "0") {
  return "ITEM: TIMESTEP\n" + std::to_string(timestep) +
         "\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS " +
         (has_edges ? "abc origin pp pp pp\n10 0 0 0\n5 10 0 0\n" + toward_z + " 0 10 0\n"
                    : "xy xz yz pp pp pp\n0 " + std::string(toward_z == "0" ? "15" : "18") +
                          " 5\n0 10 " + toward_z + "\n0 10 0\n") +
         "ITEM: ATOMS " + columns + "\n" + atom + "\n";
}

TEST(Read_tracks_lammps, places_in_a_tilted_box_are_those_of_its_edges) {
  const std::string expected = "7: 0 (7, 9.5) line 10 1 (7, 10.5) line 20";
  for (const bool has_edges : {false, true}) {
    for (const auto& [columns, first, second] :
         {std::tuple{"id xu yu", "7 7 9.5", "7 7 10.5"},
          {"id x y ix iy iz", "7 7 9.5 0 0 0", "7 2 0.5 0 1 0"},
          {"id xs ys zs ix iy iz", "7 0.225 0.95 0.5 0 0 0", "7 0.175 0.05 0.5 0 1 0"},
          {"id xsu ysu", "7 0.225 0.95", "7 0.175 1.05"}}) {
      SCOPED_TRACE(columns);
      const Tracks_file file = read_options(
          tilted_frame(0, columns, first, has_edges) + tilted_frame(1, columns, second, has_edges),
          {});
      EXPECT_EQ(shown(file), expected);
    }
    // Toward z by 3 as well.
    const auto toward_z = [&](const std::string& columns, const std::string& atom) {
      return tilted_frame(0, columns, atom, has_edges, "3");
    };
    EXPECT_EQ(shown(read_options(toward_z("id xs ys zs", "7 0.25 0.5 0.5"), {})),
              "7: 0 (6.5, 5) line 10");
    EXPECT_EQ(shown(read_options(toward_z("id x y ix iy iz", "7 1 2 0 0 -1"), {})),
              "7: 0 (-2, 2) line 10");
    // What the message advises.
    EXPECT_EQ(error_of(toward_z("id xs ys", "7 0.25 0.5")),
              "t.csv:9: the box is tilted toward z; expected zs as well, or xu yu");
    EXPECT_EQ(error_of(toward_z("id xs ys ix iy", "7 0.25 0.5 0 0")),
              "t.csv:9: the box is tilted toward z; expected zs and iz as well, or xu yu");
    EXPECT_EQ(error_of(toward_z("id xs ys zs ix iy iz", "7 0.25 0.5 0.5 0 0 0")), "");
    EXPECT_EQ(error_of(toward_z("id xu yu", "7 0.25 0.5")), "");
  }
}

TEST(Read_tracks_lammps, who_leaves_a_tilted_box_is_unwrapped_or_refused) {
  for (const bool has_edges : {false, true}) {
    const auto two = [&](const std::string& a, const std::string& b,
                         const std::string& toward_z = "0") {
      return tilted_frame(0, "id x y", a, has_edges, toward_z) +
             tilted_frame(1, "id x y", b, has_edges, toward_z);
    };
    const Tracks_file_options nearest = {.unwrap = Tracks_unwrap::nearest};
    // Through the top, and the right side.
    for (const auto& [from, to, place] : {std::tuple{"7 7 9.5", "7 2 0.5", "(7, 10.5)"},
                                          {"7 9.5 1", "7 0.5 1", "(10.5, 1)"},
                                          {"7 2 0.5", "7 6.5 9.5", "(1.5, -0.5)"}}) {
      const std::string error = error_of(two(from, to));
      EXPECT_TRUE(has_piece(error, "it left on one side and came in on the other")) << error;
      EXPECT_TRUE(has_piece(error, "or --unwrap nearest")) << error;
      const Tracks_file file = read_options(two(from, to), nearest);
      EXPECT_TRUE(has_piece(shown(file), place)) << shown(file);
    }
    EXPECT_EQ(error_of(two("7 1 1", "7 5.5 1")), "");
    EXPECT_EQ(error_of(two("7 6 2", "7 8 6")), "");
    // Where z tells through which side an atom left, nothing is guessed.
    const std::string error = error_of(two("7 2 5", "7 4.9 5", "3"));
    EXPECT_TRUE(has_piece(error, "expected a dump with xu yu, or with x y ix iy iz")) << error;
    EXPECT_FALSE(has_piece(error, "--unwrap")) << error;
    EXPECT_TRUE(has_piece(read_options_error(two("7 2 5", "7 4.9 5", "3"), nearest),
                          "the box is tilted so that places in the plane do not tell through which "
                          "side an atom left; expected a dump with xu yu"));
    EXPECT_EQ(error_of(two("7 2 5", "7 3.4 5", "3")), "");
  }
}

TEST(Read_tracks_lammps, columns_that_are_not_used_are_named_once) {
  const auto unused = [](const std::string& columns, const std::string& atom) {
    return read_options(frame(0, columns, {atom}) + frame(1, columns, {atom}), {.fps = 1}).remarks;
  };
  const std::string third = "the third coordinate of the atoms is left out";
  EXPECT_EQ(unused("id x y", "7 1 2"), std::vector<std::string>());
  EXPECT_EQ(unused("id type x y z vx vy", "7 1 2 3 4 5 6"),
            (std::vector<std::string>{third, "columns that are not used: 'type', 'vx', 'vy'"}));
  // Images lead from wrapped places to the path, and are nothing beside unwrapped ones.
  EXPECT_EQ(unused("id x y ix iy iz", "7 1 2 0 0 0"),
            std::vector<std::string>{"columns that are not used: 'iz'"});
  EXPECT_EQ(unused("id x y xu yu ix iy", "7 1 2 1 2 0 0"),
            std::vector<std::string>{"columns that are not used: 'x', 'y', 'ix', 'iy'"});
}

// ---- XYZ ----

TEST(Read_tracks_xyz, atoms_are_known_by_their_order) {
  const Tracks_file file = read_options(
      "2\n# any comment\nAr 1.5 -2 0\nNe\t0.1 1e-300 0\n\n 2 \n\nAr 2 -2 0 9\nNe 3 4 "
      "0 9\n",
      {.fps = 25});
  EXPECT_EQ(shown(file),
            "0: 0 (1.5, -2) line 3 0.04 (2, -2) line 8; 1: 0 (0.1, 1e-300) line 4 0.04 (3, 4) line "
            "9");
  EXPECT_EQ(file.format, Tracks_format::xyz);
  EXPECT_EQ(file.frame_rate, 25);
  EXPECT_EQ(file.remarks,
            (std::vector<std::string>{"ids are the numbers of atoms in a frame, from 0 on",
                                      "the third coordinate of the atoms is left out",
                                      "1 column not used"}));
}

TEST(Read_tracks_xyz, extended_files_say_where_fields_are) {
  const std::string properties = "Properties=id:I:1:velo:R:2:pos:R:3:species:S:1 ";
  const Tracks_file file =
      read_options("2\n" + properties + "Time=0.5\n7 0 0 1 2 3 Ar\n8 0 0 4 5 6 Ar\n1\n" +
                       properties + "time=\"1.5\" note='a b'\n8 0 0 4 6 6 Ar\n",
                   {});
  EXPECT_EQ(shown(file), "7: 0.5 (1, 2) line 3; 8: 0.5 (4, 5) line 4 1.5 (4, 6) line 7");
  EXPECT_EQ(file.remarks,
            (std::vector<std::string>{"the third coordinate of the atoms is left out",
                                      "columns that are not used: 'velo', 'species'"}));
  EXPECT_FALSE(file.frame_rate);
}

TEST(Read_tracks_xyz, timesteps_in_comments_are_times) {
  const Tracks_file file = read_options(
      "1\nAtoms. Timestep: 100\nAr 1 2 0\n1\nAtoms. Timestep: 300\nAr 3 4 0\n", {.fps = 100});
  EXPECT_EQ(shown(file), "0: 1 (1, 2) line 3 3 (3, 4) line 6");
}

std::string lattice_frame(const std::string& lattice, const std::string& atom) {
  return "1\nLattice=\"" + lattice + "\" pbc=\"T T T\"\nAr " + atom + "\n";
}

TEST(Read_tracks_xyz, who_leaves_a_tilted_box_is_unwrapped_or_refused) {
  const Tracks_file_options nearest = {.unwrap = Tracks_unwrap::nearest};
  // The first two boxes have the same images, though the second one is far longer.
  for (const std::string lattice : {"10 0 0 5 10 0 0 0 10", "10 0 0 95 10 0 0 0 10",
                                    "10 0 0 0 0 10 5 10 0", "5 10 0 -10 0 0 0 0 10"}) {
    SCOPED_TRACE(lattice);
    const std::string text = lattice_frame(lattice, "7 9.5 0") + lattice_frame(lattice, "2 0.5 0");
    const std::string error = error_of(text);
    EXPECT_TRUE(has_piece(error, "t.csv:6: atom '0' goes ")) << error;
    EXPECT_TRUE(has_piece(error, "or --unwrap nearest")) << error;
    EXPECT_EQ(shown(read_options(text, nearest)), "0: 0 (7, 9.5) line 3 1 (7, 10.5) line 6");
  }
  // A cubic crystal, by the edges of its primitive cell.
  const std::string cell = "0 2 2 2 0 2 2 2 0";
  const std::string text = lattice_frame(cell, "0.1 1 1") + lattice_frame(cell, "1.9 1 1");
  EXPECT_TRUE(has_piece(error_of(text),
                        "; expected places that go on beyond the box, or pbc=\"F F F\" "
                        "in the comments if these do"));
  EXPECT_FALSE(has_piece(error_of(text), "--unwrap"));
  EXPECT_TRUE(has_piece(read_options_error(text, nearest), ", and no --unwrap"));
  EXPECT_EQ(error_of(lattice_frame(cell, "0.1 1 1") + lattice_frame(cell, "0.9 1 1")), "");
}

TEST(Read_tracks_xyz, the_cell_of_ipi_is_a_box) {
  const auto cell = [](const std::string& numbers, const std::string& units, const std::string& a,
                       const std::string& b) {
    const std::string comment = "1\n# CELL(abcABC): " + numbers + " Step: ";
    return comment + "0 Bead: 0 " + units + "\nO " + a + "\n" + comment + "100 Bead: 0 " + units +
           "\nO " + b + "\n";
  };
  const Tracks_file_options nearest = {.unwrap = Tracks_unwrap::nearest};
  const std::string in_angstroms = "positions{angstrom} cell{angstrom}";
  const std::string square = "10.0 10.0 10.0 90 90 90";
  const std::string left = cell(square, in_angstroms, "9.5 2 0", "0.5 2 0");
  EXPECT_TRUE(has_piece(error_of(left),
                        "atom '0' goes 9 since line 3, more than half of the "
                        "periodic box, which is 10 wide"));
  EXPECT_EQ(shown(read_options(left, nearest)), "0: 0 (9.5, 2) line 3 100 (10.5, 2) line 6");
  EXPECT_EQ(error_of(cell(square, in_angstroms, "1 2 0", "5 2 0")), "");
  // As the message advises where places go on.
  EXPECT_EQ(error_of(cell(square, in_angstroms + " pbc=\"F F F\"", "9.5 2 0", "0.5 2 0")), "");
  // 18.9 bohr are 10 angstroms; without words both are in bohr.
  EXPECT_TRUE(
      has_piece(error_of(cell("18.9 18.9 18.9 90 90 90", "positions{angstrom} cell{atomic_unit}",
                              "9.5 2 0", "0.5 2 0")),
                "which is 10.001"));
  EXPECT_EQ(error_of(cell("18.9 18.9 18.9 90 90 90", "", "9.4 2 0", "0.5 2 0")), "");
  EXPECT_TRUE(
      has_piece(error_of(cell(square, "positions{picometer} cell{angstrom}", "9 2 0", "1 2 0")),
                "the cell has another unit than the positions"));
  EXPECT_EQ(error_of("1\n# CELL(abcABC): 1 2\nO 1 2 3\n"),
            "t.csv:2: the cell has 2 numbers; expected 6");
  // A hexagonal box: up and to the right.
  const Tracks_file file =
      read_options(cell("10 10 20 90 90 60", in_angstroms, "7 8 0", "2.5 0.5 0"), nearest);
  EXPECT_NEAR(file.tracks[0].observations[1].place.x, 7.5, 1e-12);
  EXPECT_NEAR(file.tracks[0].observations[1].place.y, 0.5 + 8.66025403784438646, 1e-12);
}

// A box that changes has no single one to go on in.
TEST(Read_tracks_xyz, boxes_that_change_are_not_unwrapped) {
  const std::string text = lattice_frame("10 0 0 0 10 0 0 0 10", "1 1 0") +
                           lattice_frame("11 0 0 0 10 0 0 0 10", "10 1 0");
  EXPECT_TRUE(has_piece(error_of(text), "atom '0' goes 9"));
  EXPECT_FALSE(has_piece(error_of(text), "--unwrap"));
  EXPECT_TRUE(
      has_piece(read_options_error(text, {.unwrap = Tracks_unwrap::nearest}),
                "t.csv:5: the box differs from that of the frame before; expected places that "
                "go on beyond the box"));
}

TEST(Read_tracks_xyz, errors_name_the_line) {
  for (const auto& [text, message] : {
           std::pair{std::string("1\n"),
                     "2: the file ends in the middle of a frame; expected a comment"},
           {"1000000000\n\nAr 1 2 3\n",
            "4: the file ends after 1 of the 1000000000 atoms of a frame; expected all of them"},
           {"99999999999999999999999\n\n",
            "1: the number of atoms is '99999999999999999999999'; expected a whole number"},
           {"1\n\nAr 1 2\n", "3: the atom has 3 fields; expected at least 4"},
           {"1\n\nAr 1 two 3\n",
            "3: the column y is 'two', which is not a number; expected a decimal or hexadecimal "
            "floating point number such as -1.5, 2e-3 or 0x1.8p3"},
           {"1\n\nAr 1 2 3\nAr 1 2 3\n",
            "4: the number of atoms is 'Ar 1 2 3'; expected a whole number"},
           {"1\n\nAr 1 2 3\n2\n\nAr 1 2 3\nAr 4 5 6\n",
            "5: the frame has 2 atoms, but the first one 1, and atoms have no ids; expected the "
            "same atoms in all frames, or extended XYZ with id:I:1 in its properties"},
           {"2\n\nAr 1 2 3\nNe 4 5 6\n2\n\nNe 1 2 3\nAr 4 5 6\n",
            "7: atom 0 of the frame is 'Ne', but 'Ar' in the first one; expected atoms in the same "
            "order in all frames"},
           {"1\nTime=1\nAr 1 2 3\n1\n\nAr 1 2 3\n",
            "5: the comments of some frames give times or timesteps, and those of others do not; "
            "expected the same in all"},
           {"1\nProperties=species:S:1\nAr\n",
            "2: the properties are 'species:S:1'; expected names, types and numbers of fields with "
            "pos:R:3 among them, such as species:S:1:pos:R:3"},
           {"1\nProperties=pos:R:1e9\nAr\n",
            "2: the properties are 'pos:R:1e9'; expected names, types and numbers of fields with "
            "pos:R:3 among them, such as species:S:1:pos:R:3"},
           {"1\nProperties=pos:R:3\n1 2 3\n1\nProperties=id:I:1:pos:R:3\n0 1 2 3\n",
            "5: the atoms of some frames have ids, and those of others have not; expected ids in "
            "all or in none"},
           {"1\nLattice=\"1 2 3\"\nAr 1 2 3\n", "2: the lattice has 3 numbers; expected 9"},
           {"1\nLattice=\"10 0 0 0 10 0 0 0 10\"\nAr 1 2 3\n1\n\nAr 8 2 3\n",
            "6: atom '0' goes 7 since line 3, more than half of the periodic box, which is 10 "
            "wide: "
            "it left on one side and came in on the other; expected places that go on beyond the "
            "box, or pbc=\"F F F\" in the comments if these do, or --unwrap nearest, which "
            "lets atoms go the shortest way"},
       }) {
    EXPECT_EQ(error_of(text), "t.csv:" + std::string(message));
  }
  EXPECT_EQ(
      error_of("1\nLattice=\"10 0 0 0 10 0 0 0 10\" pbc=\"F T T\"\nAr 1 2 3\n1\n\nAr 8 2 3\n"), "");
}

// ---- tracks in a periodic box ----

std::string in_box(const std::string& text) {
  const Tracks_file file = read_options(text, {.unwrap = Tracks_unwrap::periodic});
  std::string result = shown(file);
  for (const auto& [x, y] : file.periodic_box.value()) {
    result += " (" + std::to_string(x) + ", " + std::to_string(y) + ")";
  }
  return result;
}

TEST(Read_tracks_in_box, wrapped_places_go_on_to_the_nearest_image) {
  const std::string box = " (10.000000, 0.000000) (0.000000, 8.000000)";
  const auto two = [](const std::string& columns, const std::string& from, const std::string& to) {
    return frame(0, columns, {from}, "pp pp pp") + frame(10, columns, {to}, "pp pp pp");
  };
  EXPECT_EQ(in_box(two("id x y", "7 9 -3", "7 1 3")),
            "7: 0 (9, -3) line 10 10 (11, -5) line 20" + box);
  // The file says which image is meant, however far it is.
  EXPECT_EQ(in_box(two("id xu yu", "7 9 -3", "7 31 3")),
            "7: 0 (9, -3) line 10 10 (31, 3) line 20" + box);
  EXPECT_EQ(in_box(two("id x y ix iy", "7 9 -3 0 0", "7 1 3 3 1")),
            "7: 0 (9, -3) line 10 10 (31, 11) line 20" + box);
  const Tracks_file_options periodic = {.unwrap = Tracks_unwrap::periodic};
  EXPECT_TRUE(has_piece(read_options_error(two("id x y", "7 9 -3", "7 4 -3"), periodic),
                        ":20: atom '7' goes half of the periodic box, which is 10 wide"));
  // The box is known without the option too, but places must be unwrapped then.
  EXPECT_TRUE(read_options(two("id xu yu", "7 9 -3", "7 31 3"), {}).periodic_box);
}

TEST(Read_tracks_in_box, tilted_boxes_turn_left) {
  const auto text = [](const std::string& lattice) {
    return "1\nLattice=\"" + lattice + "\" pbc=\"T T F\"\nH 1 1 0\n1\nLattice=\"" + lattice +
           "\" pbc=\"T T F\"\nH 2 1 0\n";
  };
  const std::string tracks = "0: 0 (1, 1) line 3 1 (2, 1) line 6";
  EXPECT_EQ(in_box(text("10 0 0 3 8 0 0 0 5")),
            tracks + " (10.000000, 0.000000) (3.000000, 8.000000)");
  EXPECT_EQ(in_box(text("3 8 0 10 0 0 0 0 5")),
            tracks + " (10.000000, 0.000000) (3.000000, 8.000000)");
}

TEST(Read_tracks_in_box, refuses_what_has_not_one_such_box) {
  const Tracks_file_options periodic = {.unwrap = Tracks_unwrap::periodic};
  const auto error = [&](const std::string& text) { return read_options_error(text, periodic); };
  EXPECT_TRUE(has_piece(error(frame(0, "id x y", {"7 1 1"}) + frame(1, "id x y", {"7 2 1"})),
                        "has no box that is periodic in two directions of the plane"));
  std::string other = frame(1, "id xu yu", {"7 2 1"}, "pp pp pp");
  other.replace(other.find("0 1e1"), 5, "0 2e1");
  EXPECT_TRUE(has_piece(error(frame(0, "id xu yu", {"7 1 1"}, "pp pp pp") + other),
                        ":19: the box differs from that of the frames before"));
  EXPECT_FALSE(read_options(frame(0, "id xu yu", {"7 1 1"}, "pp pp pp") + other, {}).periodic_box);
}

}  // namespace
}  // namespace kinetri::tracks_atoms_test
