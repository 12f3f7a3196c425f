// SPDX-License-Identifier: GPL-3.0-or-later
//
// Databases of JuPedSim, written through SQLite itself.
#include <gtest/gtest.h>

#include <cstddef>
#include <memory>
#include <random>
#include <string>
#include <utility>

#include "kinetri/io/tracks_file.h"
#include "support/temporary_directory.h"
#include "support/tracks_text.h"

#ifdef KINETRI_WITH_SQLITE
#include <sqlite3.h>
#endif

namespace kinetri::tracks_jupedsim_test {
namespace {

using test::read_options;
using test::read_options_error;
using test::shown;

#ifndef KINETRI_WITH_SQLITE

TEST(Read_tracks_jupedsim, is_refused_without_sqlite) {
  EXPECT_EQ(read_options_error(std::string("SQLite format 3\0", 16), {}),
            "t.csv: databases of SQLite cannot be read, since this kinetri was built without it; "
            "expected a kinetri that was built where SQLite is (Debian: libsqlite3-dev)");
}

#else

// The bytes of a database in which the statements were executed.
std::string database(const std::string& statements) {
  const test::Temporary_directory directory;
  const std::string path = directory.file("tracks.sqlite");
  sqlite3* opened = nullptr;
  EXPECT_EQ(sqlite3_open(path.c_str(), &opened), SQLITE_OK);
  char* message = nullptr;
  EXPECT_EQ(sqlite3_exec(opened, statements.c_str(), nullptr, nullptr, &message), SQLITE_OK)
      << message;
  sqlite3_free(message);
  sqlite3_close(opened);
  return test::read_file(path);
}

const std::string trajectories =
    "CREATE TABLE trajectory_data (frame INTEGER NOT NULL, id INTEGER NOT NULL, pos_x REAL NOT "
    "NULL, pos_y REAL NOT NULL, ori_x REAL NOT NULL, ori_y REAL NOT NULL);"
    "INSERT INTO trajectory_data VALUES (0, 7, 1.5, -2, 0, 1), (0, 8, 0.1, 1e-300, 0, 1), (10, 7, "
    "2, "
    "-2, 0, 1), (10, 8, 3, 4, 0, 1);";
const std::string metadata =
    "CREATE TABLE metadata(key TEXT NOT NULL UNIQUE PRIMARY KEY, value TEXT NOT NULL);"
    "INSERT INTO metadata VALUES ('version', 1), ('fps', 25.0);";
const std::string expected =
    "7: 0 (1.5, -2) line 1 0.4 (2, -2) line 3; 8: 0 (0.1, 1e-300) line 2 0.4 (3, 4) line 4";

TEST(Read_tracks_jupedsim, version_1) {
  const Tracks_file file =
      read_options(database(trajectories + metadata +
                            "CREATE TABLE geometry(wkt TEXT NOT NULL); INSERT INTO geometry VALUES "
                            "('GEOMETRYCOLLECTION (POLYGON ((0 0, 9 0, 9 9, 0 0)))');"),
                   {});
  EXPECT_EQ(shown(file), expected);
  EXPECT_EQ(file.format, Tracks_format::jupedsim);
  EXPECT_EQ(file.frame_rate, 25);
  EXPECT_EQ(file.place_name, "row");
  EXPECT_EQ(file.walkable_area, "GEOMETRYCOLLECTION (POLYGON ((0 0, 9 0, 9 9, 0 0)))");
  EXPECT_EQ(file.remarks,
            (std::vector<std::string>{"25 frames a second, as the file says",
                                      "columns that are not used: 'ori_x', 'ori_y'"}));
}

TEST(Read_tracks_jupedsim, versions_2_and_3) {
  const std::string areas =
      "CREATE TABLE geometry(hash INTEGER NOT NULL, wkt TEXT NOT NULL);"
      "CREATE TABLE frame_data(frame INTEGER NOT NULL, geometry_hash INTEGER NOT NULL);"
      "UPDATE metadata SET value = 2 WHERE key = 'version'; INSERT INTO geometry VALUES (5, 'A');";
  EXPECT_EQ(read_options(database(trajectories + metadata + areas), {}).walkable_area, "A");
  const Tracks_file changing = read_options(
      database(trajectories + metadata + areas + "INSERT INTO geometry VALUES (6, 'B');"), {});
  EXPECT_EQ(changing.walkable_area, "");
  EXPECT_EQ(changing.remarks[1], "the walkable area changes, and is left out");
  const Tracks_file without_orientation = read_options(
      database("CREATE TABLE trajectory_data (frame INTEGER NOT NULL, id INTEGER NOT NULL, pos_x "
               "REAL NOT NULL, pos_y REAL NOT NULL);"
               "INSERT INTO trajectory_data VALUES (0, 7, 1.5, -2), (0, 8, 0.1, 1e-300), (10.0, 7, "
               "2, -2), (10, 8, 3, 4);" +
               metadata + "UPDATE metadata SET value = '3' WHERE key = 'version';"),
      {});
  EXPECT_EQ(shown(without_orientation), expected);
  EXPECT_EQ(without_orientation.remarks,
            std::vector<std::string>{"25 frames a second, as the file says"});
}

TEST(Read_tracks_jupedsim, the_rate_may_be_that_of_the_option) {
  EXPECT_EQ(shown(read_options(database(trajectories), {.fps = 25})), expected);
  EXPECT_EQ(read_options_error(database(trajectories), {}),
            "t.csv: has no frame rate; expected a row with the key fps in metadata, or --fps");
  EXPECT_EQ(read_options_error(database(trajectories + metadata), {.fps = 16}),
            "t.csv: metadata gives 25 frames a second, but the file is read with 16; expected the "
            "same rate");
  EXPECT_EQ(read_options_error(
                database(trajectories + metadata + "UPDATE metadata SET value = 'fast';"), {}),
            "t.csv: is of the version 'fast'; expected 1, 2 or 3");
  EXPECT_EQ(
      read_options_error(
          database(trajectories + metadata + "UPDATE metadata SET value='0' WHERE key='fps'"), {}),
      "t.csv: the fps in metadata is '0'; expected a number greater than 0");
}

TEST(Read_tracks_jupedsim, columns_are_not_named) {
  EXPECT_EQ(read_options_error(database(trajectories + metadata), {.columns = {.t = "frame"}}),
            "t.csv: seems to be of the format jupedsim, whose columns have names already; expected "
            "no --columns");
}

TEST(Read_tracks_jupedsim, errors_name_table_and_row) {
  const std::string loose = metadata + "CREATE TABLE trajectory_data(frame, id, pos_x, pos_y);";
  const auto error = [](const std::string& statements) {
    return read_options_error(database(statements), {});
  };
  const auto row = [&](const std::string& values) {
    return error(loose + "INSERT INTO trajectory_data VALUES (0, 1, 2, 3), (" + values + ");");
  };
  EXPECT_EQ(row("NULL, 1, 2, 3"), "t.csv: row 2: the column frame is empty; expected a number");
  EXPECT_EQ(row("1, 1, '2', 3"), "t.csv: row 2: the column pos_x is no number; expected a number");
  EXPECT_EQ(row("1, 1, 2, 9e999"),
            "t.csv: row 2: the column pos_y is inf, which is not finite; expected a finite number");
  EXPECT_EQ(row("1, NULL, 2, 3"),
            "t.csv: row 2: the column id is empty, or bytes; expected a number or a text");
  EXPECT_EQ(row("0, 1, 2, 4"),
            "t.csv: row 2: id '1' is at two places at t = 0: at (2, 4), and at (2, 3) in row 1; "
            "expected one, or --duplicates first, last or mean, which says what to take");
  EXPECT_EQ(row("0, 'Ada', 2, 4"), "");
  EXPECT_EQ(error(metadata),
            "t.csv: has no table trajectory_data; expected a database as JuPedSim writes it");
  EXPECT_EQ(error(metadata + "CREATE VIEW trajectory_data AS SELECT 0 AS frame, 1 AS id, 2 AS "
                             "pos_x, 3 AS pos_y;"),
            "t.csv: has no table trajectory_data; expected a database as JuPedSim writes it");
  EXPECT_EQ(error(metadata + "CREATE TABLE trajectory_data(frame, id, x, y);"),
            "t.csv: does not have the tables of JuPedSim: SQLite says 'no such column: pos_x'; "
            "expected the columns frame, id, pos_x and pos_y in trajectory_data");
  EXPECT_EQ(error(trajectories + metadata +
                  "CREATE TABLE geometry(wkt); INSERT INTO geometry "
                  "VALUES (NULL);"),
            "t.csv: the wkt in geometry is no text; expected the walkable area as WKT");
}

TEST(Read_tracks_jupedsim, cut_files_are_refused) {
  const std::string whole = database(trajectories + metadata);
  for (const std::size_t size :
       {std::size_t{16}, std::size_t{99}, std::size_t{100}, std::size_t{4096}, whole.size() - 1}) {
    EXPECT_EQ(read_options_error(whole.substr(0, size), {}),
              "t.csv: is cut short: it ends after " + std::to_string(size) +
                  " bytes; expected as many as its header says");
  }
  // What stands behind belongs to nothing.
  EXPECT_EQ(shown(read_options(whole + "more", {})), expected);
  EXPECT_NE(read_options_error(database("PRAGMA journal_mode=WAL;" + trajectories + metadata), {})
                .find("t.csv: is a database with a write-ahead log"),
            std::string::npos);
  EXPECT_EQ(read_options_error("no database", {.format = Tracks_format::jupedsim}),
            "t.csv: is no database of SQLite; expected one that JuPedSim wrote");
}

TEST(Read_tracks_jupedsim, damaged_files_are_read_or_refused) {
  std::mt19937 random(7);
  std::string rows = trajectories + metadata;
  for (int i = 20; i < 500; ++i) {
    rows += "INSERT INTO trajectory_data VALUES (" + std::to_string(i) + ", 1, 2, 3, 4, 5);";
  }
  const std::string whole = database("BEGIN;" + rows + "COMMIT;");
  for (int i = 0; i < 3000; ++i) {
    std::string damaged = whole;
    for (int k = 0; k < 4; ++k) {
      // Mostly in the headers of pages, where the tree is.
      const std::size_t page = random() % (whole.size() / 4096) * 4096;
      damaged[page + random() % (k < 2 ? 120 : 4096)] = static_cast<char>(random());
    }
    const std::string error = read_options_error(damaged, {});
    EXPECT_EQ(error.find('\n'), std::string::npos);
  }
}

#endif

}  // namespace
}  // namespace kinetri::tracks_jupedsim_test
