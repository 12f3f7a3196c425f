// SPDX-License-Identifier: GPL-3.0-or-later
//
// The same tracks in every format: each number comes back as it was, bit by bit.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <map>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include "kinetri/io/tracks_file.h"
#include "support/temporary_directory.h"
#include "support/tracks_text.h"

#ifdef KINETRI_WITH_SQLITE
#include <sqlite3.h>
#endif

namespace kinetri::tracks_same_in_all_formats_test {
namespace {

constexpr double fps = 25;

struct Seen {
  int frame;
  int id;
  double x;
  double y;
};

// By id and time.
using Places = std::map<std::tuple<std::string, double>, Vector_2>;

Places places_of(const Tracks_file& file) {
  Places result;
  for (const Track& track : file.tracks) {
    for (const Track_observation& seen : track.observations) {
      result[{track.id, seen.time}] = seen.place;
    }
  }
  return result;
}

std::string digits(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", number);
  return text;
}

// In the order of frames, as dumps need it.
std::vector<Seen> random_rows(std::uint32_t seed) {
  std::mt19937_64 random(seed);
  const auto number = [&random] {
    const auto mantissa = static_cast<double>(static_cast<std::int64_t>(random()));
    return std::ldexp(mantissa, -static_cast<int>(random() % 90));
  };
  std::vector<Seen> result;
  for (int frame = 0; frame < 40; frame += 1 + static_cast<int>(random() % 3)) {
    for (int id = 1; id < 12; ++id) {
      if (random() % 4 != 0) result.push_back({frame, id, number(), number()});
    }
  }
  return result;
}

// ---- the formats ----

std::string lines(const std::vector<Seen>& rows, const std::string& header,
                  std::string (*line)(const Seen&)) {
  std::string result = header;
  for (const Seen& row : rows) result += line(row) + "\n";
  return result;
}

std::string as_rows(const std::vector<Seen>& rows) {
  return lines(rows, "t,id,x,y\n", [](const Seen& row) {
    return digits(row.frame / fps) + "," + std::to_string(row.id) + "," + digits(row.x) + "," +
           digits(row.y);
  });
}

std::string as_frames(const std::vector<Seen>& rows) {
  return lines(rows, "# frame id x y\n", [](const Seen& row) {
    return std::to_string(row.frame) + "\t" + std::to_string(row.id) + "\t" + digits(row.x) + "\t" +
           digits(row.y);
  });
}

std::string as_ids(const std::vector<Seen>& rows) {
  return lines(rows, "# framerate: 25.00 fps\n# PersID Frame X/m Y/m Z/m\n", [](const Seen& row) {
    return std::to_string(row.id) + " " + std::to_string(row.frame) + " " + digits(row.x) + " " +
           digits(row.y) + " 1.7";
  });
}

std::string as_table(const std::vector<Seen>& rows) {
  return lines(rows, "N;\"what\";E;when\n", [](const Seen& row) {
    return digits(row.y) + ";\"" + std::to_string(row.id) + "\";" + digits(row.x) + ";" +
           std::to_string(row.frame);
  });
}

std::string as_sumo(const std::vector<Seen>& rows) {
  return lines(rows, "<fcd-export>\n",
               [](const Seen& row) {
                 return "<timestep time=\"" + digits(row.frame / fps) + "\"><vehicle id=\"" +
                        std::to_string(row.id) + "\" x=\"" + digits(row.x) + "\" y=\"" +
                        digits(row.y) + "\"/></timestep>";
               }) +
         "</fcd-export>\n";
}

std::string as_lammps(const std::vector<Seen>& rows) {
  return lines(rows, "", [](const Seen& row) {
    return "ITEM: TIMESTEP\n" + std::to_string(row.frame) +
           "\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\nITEM: ATOMS id "
           "xu "
           "yu zu\n" +
           std::to_string(row.id) + " " + digits(row.x) + " " + digits(row.y) + " 0";
  });
}

std::string as_xyz(const std::vector<Seen>& rows) {
  return lines(rows, "", [](const Seen& row) {
    return "1\nProperties=id:I:1:pos:R:3 Time=" + digits(row.frame / fps) + "\n" +
           std::to_string(row.id) + " " + digits(row.x) + " " + digits(row.y) + " 0";
  });
}

std::string as_geojson(const std::vector<Seen>& rows) {
  std::string result = "{\"type\": \"FeatureCollection\", \"features\": [";
  for (const Seen& row : rows) {
    result += std::string(&row == rows.data() ? "" : ",\n") +
              "{\"type\": \"Feature\", \"geometry\": {\"type\": \"Point\", \"coordinates\": [" +
              digits(row.x) + ", " + digits(row.y) +
              "]}, \"properties\": {\"t\": " + digits(row.frame / fps) +
              ", \"id\": " + std::to_string(row.id) + "}}";
  }
  return result + "]}";
}

#ifdef KINETRI_WITH_SQLITE
std::string as_sqlite(const std::vector<Seen>& rows) {
  const test::Temporary_directory directory;
  const std::string path = directory.file("tracks.sqlite");
  sqlite3* database = nullptr;
  EXPECT_EQ(sqlite3_open(path.c_str(), &database), SQLITE_OK);
  const auto execute = [&](const char* statements) {
    EXPECT_EQ(sqlite3_exec(database, statements, nullptr, nullptr, nullptr), SQLITE_OK);
  };
  execute(
      "CREATE TABLE trajectory_data (frame INTEGER NOT NULL, id INTEGER NOT NULL, pos_x REAL NOT "
      "NULL, pos_y REAL NOT NULL); CREATE TABLE metadata(key TEXT NOT NULL, value TEXT NOT NULL);"
      "INSERT INTO metadata VALUES ('version', '3'), ('fps', '25.0'); BEGIN");
  sqlite3_stmt* insert = nullptr;
  EXPECT_EQ(sqlite3_prepare_v2(database, "INSERT INTO trajectory_data VALUES (?, ?, ?, ?)", -1,
                               &insert, nullptr),
            SQLITE_OK);
  for (const Seen& row : rows) {
    sqlite3_bind_int(insert, 1, row.frame);
    sqlite3_bind_int(insert, 2, row.id);
    sqlite3_bind_double(insert, 3, row.x);
    sqlite3_bind_double(insert, 4, row.y);
    EXPECT_EQ(sqlite3_step(insert), SQLITE_DONE);
    sqlite3_reset(insert);
  }
  sqlite3_finalize(insert);
  execute("COMMIT");
  sqlite3_close(database);
  return test::read_file(path);
}
#endif

void expect_the_same(const std::vector<Seen>& rows) {
  const Tracks_file of_rows = test::read_options(as_rows(rows), {});
  const Places expected = places_of(of_rows);
  ASSERT_EQ(expected.size(), rows.size());
  for (const Seen& row : rows) {
    ASSERT_EQ(expected.at({std::to_string(row.id), row.frame / fps}), (Vector_2{row.x, row.y}));
  }
  const auto expect = [&](const std::string& text, const Tracks_file_options& options,
                          Tracks_format format) {
    SCOPED_TRACE(tracks_formats()[static_cast<std::size_t>(format)].name);
    const Tracks_file file = test::read_options(text, options);
    EXPECT_EQ(file.format, format);
    EXPECT_EQ(file.observations, rows.size());
    EXPECT_TRUE(places_of(file) == expected);
  };
  expect(as_frames(rows), {.fps = fps}, Tracks_format::frames);
  expect(as_ids(rows), {}, Tracks_format::ids);
  expect(as_table(rows), {.fps = fps, .columns = {.t = "when", .id = "what", .x = "E", .y = "N"}},
         Tracks_format::table);
  expect(as_lammps(rows), {.fps = fps}, Tracks_format::lammps);
  expect(as_xyz(rows), {}, Tracks_format::xyz);
  expect(as_geojson(rows), {.projection = Tracks_projection::none}, Tracks_format::geojson);
#ifdef KINETRI_WITH_EXPAT
  expect(as_sumo(rows), {}, Tracks_format::sumo);
#endif
#ifdef KINETRI_WITH_SQLITE
  expect(as_sqlite(rows), {}, Tracks_format::jupedsim);
#endif
}

TEST(Tracks_in_all_formats, are_the_same) {
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    expect_the_same(random_rows(seed));
  }
}

TEST(Tracks_in_all_formats, of_recorded_crowds_are_the_same) {
  const auto path = std::filesystem::path(KINETRI_SHARED_DATA) / "crowd" / "biwi_eth.txt";
  if (!std::filesystem::exists(path)) {
    GTEST_SKIP() << "no recorded tracks: " << path << " does not exist";
  }
  std::vector<Seen> rows;
  for (const Track& track : read_tracks_file(path, Tracks_format::frames, 1).tracks) {
    for (const Track_observation& seen : track.observations) {
      rows.push_back({static_cast<int>(seen.time), static_cast<int>(std::stod(track.id)),
                      seen.place.x, seen.place.y});
    }
  }
  expect_the_same(rows);
}

}  // namespace
}  // namespace kinetri::tracks_same_in_all_formats_test
