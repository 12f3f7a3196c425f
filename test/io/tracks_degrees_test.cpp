// SPDX-License-Identifier: GPL-3.0-or-later
//
// Places in degrees: what tells them, that they are refused without a projection, and what the
// projections make of them.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "io/tracks/degrees.h"
#include "io/tracks/projection.h"
#include "io/tracks/transverse_mercator.h"
#include "kinetri/io/tracks_file.h"
#include "support/precondition_error.h"
#include "support/tracks_text.h"

namespace kinetri::tracks_degrees_test {
namespace {

using test::read_options;
using test::read_options_error;
using test::shown;

bool contains(const std::string& text, const std::string& piece) {
  return text.find(piece) != std::string::npos;
}

// ---- names ----

TEST(Angle_in_name, knows_the_names_that_others_write) {
  for (const char* const name : {"lon",
                                 "Lon",
                                 "LON",
                                 "lng",
                                 "long",
                                 "longitude",
                                 "Longitude",
                                 "location-long",
                                 "location.long",
                                 "location_long",
                                 "lon_deg",
                                 "decimalLongitude",
                                 "GPSLongitude",
                                 "gps_lon",
                                 "stop_lon",
                                 "Lon (deg)",
                                 "Longitude_degrees",
                                 "GPSLon",
                                 "gpslon",
                                 "LONDD",
                                 "longitud",
                                 "longitudine",
                                 "L\xC3\xA4ngengrad",
                                 "start_lng",
                                 "pickup_longitude",
                                 "vessel.lon",
                                 "lon1",
                                 "Long.",
                                 "LonDec",
                                 "x_lon",
                                 "wgs84_lon",
                                 "longitude(deg)",
                                 "\xE7\xBB\x8F\xE5\xBA\xA6",
                                 "\xD0\x94\xD0\xBE\xD0\xBB\xD0\xB3\xD0\xBE\xD1\x82\xD0\xB0",
                                 "position.coords.longitude"}) {
    EXPECT_EQ(angle_in_name(name), Angle::longitude) << name;
  }
  for (const char* const name :
       {"lat", "LAT", "latitude", "location-lat", "location.lat", "lat_deg", "decimalLatitude",
        "GPSLatitude", "gps_lat", "stop_lat", "Lat (deg)", "Latitude_degrees", "latdeg", "LATDD",
        "Breitengrad", "y_lat", "\xE7\xBA\xAC\xE5\xBA\xA6", "poslat", "latitud"}) {
    EXPECT_EQ(angle_in_name(name), Angle::latitude) << name;
  }
  for (const char* const name : {"x (deg)", "X [degrees]", "x_deg", "X (\xC2\xB0)", "X (\xB0)"}) {
    EXPECT_EQ(angle_in_name(name), Angle::degrees) << name;
  }
  for (const char* const name : {"lon_rad", "longitude (radians)", "x_rad"}) {
    EXPECT_EQ(angle_in_name(name), Angle::radians) << name;
  }
  for (const char* const name : {"x",
                                 "X (m)",
                                 "lateral",
                                 "lateral_position",
                                 "longitudinal",
                                 "Longitudinal velocity",
                                 "flat",
                                 "plate",
                                 "relative",
                                 "translation_x",
                                 "latest",
                                 "along",
                                 "belongs",
                                 "utm-easting",
                                 "northing",
                                 "easting",
                                 "X_px",
                                 "lat_m",
                                 "lon (m)",
                                 "platform",
                                 "latency",
                                 "oblong",
                                 "",
                                 "12",
                                 "\xD0\xB0\xD0\xB0"}) {
    EXPECT_EQ(angle_in_name(name), Angle::none) << name;
  }
}

// ---- tables ----

std::string table_of(const std::string& x, const std::string& y) {
  return "t,id," + x + "," + y + "\n0,1,12.0,55.0\n10,1,12.01,55.0\n";
}

Tracks_file_options named(const std::string& x, const std::string& y) {
  return {.columns = {.t = "t", .id = "id", .x = x, .y = y}};
}

TEST(Read_tracks_degrees, are_refused_by_the_names_of_columns) {
  for (const auto& [x, y] : {std::pair{"location-long", "location-lat"},
                             {"decimalLongitude", "decimalLatitude"},
                             {"GPSLongitude", "GPSLatitude"},
                             {"Lon (deg)", "Lat (deg)"},
                             {"x_deg", "y_deg"},
                             {"E", "lat"},
                             {"long", "N"}}) {
    SCOPED_TRACE(x);
    const std::string error = read_options_error(table_of(x, y), named(x, y));
    EXPECT_TRUE(contains(error, "are places in degrees")) << error;
    Tracks_file_options options = named(x, y);
    options.projection = Tracks_projection::none;
    const Tracks_file as_they_are = read_options(table_of(x, y), options);
    EXPECT_EQ(as_they_are.tracks[0].observations[1].place, (Vector_2{12.01, 55}));
    ASSERT_EQ(as_they_are.remarks.size(), 1U);
    EXPECT_TRUE(contains(as_they_are.remarks[0], "places are taken as they are, though"));
    options.projection = Tracks_projection::utm;
    EXPECT_TRUE(
        contains(read_options(table_of(x, y), options).remarks[0], "places are degrees, as"));
  }
  EXPECT_TRUE(contains(read_options_error(table_of("lat", "lon"), named("lat", "lon")),
                       "expected the longitude as x, and the latitude as y"));
  Tracks_file_options radians = named("lon_rad", "lat_rad");
  radians.projection = Tracks_projection::local;
  EXPECT_TRUE(contains(read_options_error(table_of("lon_rad", "lat_rad"), radians),
                       "are in radians; expected degrees"));
}

TEST(Read_tracks_table, refuses_coordinates_in_two_units) {
  EXPECT_TRUE(contains(read_options_error(table_of("x [mm]", "y [cm]"), named("x [mm]", "y [cm]")),
                       "the columns 'x [mm]' and 'y [cm]' have the units mm and cm; expected both "
                       "coordinates in one unit"));
  EXPECT_EQ(read_options(table_of("x (m)", "y_metres"), named("x (m)", "y_metres")).observations,
            read_options(table_of("x", "y"), named("x", "y")).observations);
}

TEST(Read_tracks_degrees, are_refused_by_units_below_the_header) {
  const std::string text = "t,id,x,y\ns,,deg,deg\n0,1,12.0,55.0\n10,1,12.1,55.0\n";
  const std::string error = read_options_error(text, named("x", "y"));
  EXPECT_TRUE(contains(error, "t.csv:2: the units 'deg' and 'deg' say that places are in degrees"))
      << error;
}

TEST(Read_tracks_degrees, are_refused_by_names_in_a_header_that_numbers_skip) {
  const Tracks_file_options numbers = {.columns = {.t = "1", .id = "2", .x = "3", .y = "4"}};
  const std::string error = read_options_error(table_of("lon", "lat"), numbers);
  EXPECT_TRUE(contains(error, "degrees")) << error;
}

TEST(Read_tracks_degrees, are_suspected_where_nothing_says_what_places_are) {
  // Taxis of T-Drive: id, date, longitude, latitude, without a header.
  const std::string taxi =
      "1,2008-02-02 15:36:08,116.51172,39.92123\n1,2008-02-02 15:46:08,116.51135,39.93883\n";
  Tracks_file_options options = {.columns = {.t = "2", .id = "1", .x = "3", .y = "4"}};
  EXPECT_TRUE(contains(read_options_error(taxi, options), "they look like degrees"));
  options.projection = Tracks_projection::none;
  EXPECT_EQ(read_options(taxi, options).observations, 2U);
  options.projection = Tracks_projection::utm;
  // 1957.4 m to the north-west (zone 50).
  const auto seen = read_options(taxi, options).tracks[0].observations;
  EXPECT_NEAR(std::hypot(seen[1].place.x - seen[0].place.x, seen[1].place.y - seen[0].place.y),
              1954.6, 2);
  EXPECT_TRUE(contains(read_options_error("t,id,x,y\n2024-05-01T00:00:00Z,a,8.12345,50.12345\n"
                                          "2024-05-01T01:00:00Z,a,8.12445,50.12345\n",
                                          {}),
                       "they look like degrees"));
  // A row without a position does not hide that the others look like degrees.
  std::string ships;
  for (int day = 10; day < 20; ++day) {
    ships +=
        "2024-01-" + std::to_string(day) + ",7,12.0" + std::to_string(1000 + day) + ",55.12345\n";
  }
  for (const char* const no_place : {"181.0,91.0", "-999,-999"}) {
    const std::string text = ships + "2024-01-20,7," + no_place + "\n";
    Tracks_file_options numbers = {.columns = {.t = "1", .id = "2", .x = "3", .y = "4"}};
    EXPECT_TRUE(contains(read_options_error(text, numbers), "they look like degrees")) << no_place;
    if (no_place[0] == '-') continue;
    numbers.projection = Tracks_projection::utm;
    EXPECT_EQ(read_options(text, numbers).observations, 10U);
    EXPECT_EQ(read_options(text, numbers).rows_without_place, 1U);
  }
  // People walk too fast for degrees; round numbers and plain times show nothing.
  for (const char* const text :
       {"t,id,x,y\n2024-05-01T00:00:00Z,a,8.12345,5.12345\n2024-05-01T00:00:01Z,a,9.12345,5."
        "12345\n",
        "t,id,x,y\n2024-05-01T00:00:00Z,a,8,5\n2024-05-01T01:00:00Z,a,9,5\n",
        "t,id,x,y\n0,a,8.12345,5.12345\n3600,a,8.12346,5.12345\n"}) {
    EXPECT_EQ(read_options(text, {}).observations, 2U) << text;
  }
}

TEST(Read_tracks_degrees, of_ships_without_a_place_are_no_observations) {
  Tracks_file_options options = named("Longitude", "Latitude");
  options.projection = Tracks_projection::utm;
  const std::string text = "t,id,Longitude,Latitude\n0,1,12,55\n1,1,181,91\n2,1,0,91\n3,1,12,55\n";
  const Tracks_file file = read_options(text, options);
  EXPECT_EQ(file.observations, 2U);
  EXPECT_EQ(file.rows_without_place, 2U);
}

TEST(Read_tracks_degrees, are_known_by_comments) {
  for (const char* const comment :
       {"# id frame lon lat", "# x: longitude, y: latitude", "# coordinates in WGS84",
        "# EPSG:4326", "# Longitude Latitude", "# x/deg y/deg", "# X [degrees], Y [degrees]"}) {
    SCOPED_TRACE(comment);
    const std::string above = std::string(comment) + "\n";
    for (const auto& [text, options] :
         {std::pair{above + "1 0 12 55\n1 1 12 56\n", Tracks_file_options{}},
          {above + "t,id,x,y\n0,a,12,55\n", Tracks_file_options{}},
          {above + "t;id;x;y\n0;a;12;55\n", named("x", "y")}}) {
      EXPECT_TRUE(contains(read_options_error(text, options),
                           "t.csv:1: the comment says that places are in degrees"))
          << text;
      Tracks_file_options as_they_are = options;
      as_they_are.projection = Tracks_projection::none;
      as_they_are.fps = std::nullopt;
      if (!contains(text, "1 0 12")) {
        EXPECT_EQ(read_options(text, as_they_are).observations, 1U);
      }
    }
  }
  for (const char* const comment :
       {"# site: lat 50.9, lon 6.4", "# WGS 84 / UTM zone 32N", "# the lateral position", "# id"}) {
    const std::string above = std::string(comment) + "\n";
    EXPECT_EQ(read_options(above + "# id frame x y\n1 0 12 55\n", {}).observations, 1U);
    EXPECT_EQ(read_options(above + "t,id,x,y\n0,a,12,55\n", {}).observations, 1U);
  }
  // Degrees beside places in the plane.
  EXPECT_EQ(read_options("# t id x y lon lat\n0 a 1 2 12 55\n", named("x", "y")).observations, 1U);
}

// ---- projections ----

// The values are those of the Krueger series in PROJ's documentation and of NGA's tools.
TEST(Transverse_mercator, is_that_of_utm) {
  const auto expect = [](double longitude, double latitude, double east, double north,
                         double scale) {
    const auto [place, k] = transverse_mercator(longitude, latitude);
    EXPECT_NEAR(place.x, east, 1e-5);
    EXPECT_NEAR(place.y, north, 1e-5);
    EXPECT_NEAR(k, scale, 1e-9);
  };
  expect(0, 0, 0, 0, 0.9996);
  expect(0, 45, 0, 4982950.400227, 0.9996);
  expect(3, 0, 333978.556919, 0, 1.0009810615);
  expect(-3, 55, -191875.632138, 6098907.825129, 1.0000516810);
  // The north pole is a quarter of a meridian away: 10001965.729 m.
  EXPECT_NEAR(transverse_mercator(0, 90).place.y, 0.9996 * 10001965.7293, 1e-3);
}

TEST(Transverse_mercator, keeps_angles_and_has_the_scale_that_it_says) {
  constexpr double a = 6378137;
  constexpr double e2 = (2 - 1 / 298.257223563) / 298.257223563;
  constexpr double radians = 3.14159265358979323846 / 180;
  for (const double longitude : {-4., -1.5, 0.25, 3.}) {
    for (const double latitude : {-75., -30., 0.5, 52., 80.}) {
      constexpr double step = 1e-4;
      const double sine = std::sin(latitude * radians);
      const double w = std::sqrt(1 - e2 * sine * sine);
      // Lengths of a degree on the ellipsoid.
      const double along_parallel = radians * a / w * std::cos(latitude * radians);
      const double along_meridian = radians * a * (1 - e2) / (w * w * w);
      const auto at = [&](double dx, double dy) {
        return transverse_mercator(longitude + dx, latitude + dy).place;
      };
      const Vector_2 east = {at(step, 0).x - at(-step, 0).x, at(step, 0).y - at(-step, 0).y};
      const Vector_2 north = {at(0, step).x - at(0, -step).x, at(0, step).y - at(0, -step).y};
      const double scale = transverse_mercator(longitude, latitude).scale;
      EXPECT_NEAR(std::hypot(east.x, east.y) / (2 * step * along_parallel), scale, 2e-8);
      EXPECT_NEAR(std::hypot(north.x, north.y) / (2 * step * along_meridian), scale, 2e-8);
      EXPECT_NEAR(east.x * north.x + east.y * north.y, 0, 1e-4);
    }
  }
}

std::string places(const std::vector<Vector_2>& degrees) {
  std::string result = "time,id,lon,lat\n";
  for (std::size_t i = 0; i < degrees.size(); ++i) {
    result += "0," + std::to_string(i) + "," + std::to_string(degrees[i].x) + "," +
              std::to_string(degrees[i].y) + "\n";
  }
  return result;
}

Tracks_file_options projected(Tracks_projection projection) {
  return {.columns = {.t = "time", .id = "id", .x = "lon", .y = "lat"}, .projection = projection};
}

double distance(const Tracks_file& file) {
  const Vector_2& a = file.tracks[0].observations[0].place;
  const Vector_2& b = file.tracks[1].observations[0].place;
  return std::hypot(b.x - a.x, b.y - a.y);
}

TEST(Read_tracks_projection, utm_of_wide_data_is_right) {
  // Two at 60 degrees north, and one on the equator: 557.8 m on the ellipsoid, times 0.9996.
  const Tracks_file file =
      read_options(places({{10, 60}, {10.01, 60}, {10, 0}}), projected(Tracks_projection::utm));
  EXPECT_NEAR(distance(file), 557.8, 557.8 * 0.001);
  EXPECT_TRUE(contains(file.remarks.back(), "UTM, zone 32 north (EPSG:32632)"));
  EXPECT_TRUE(contains(file.remarks.back(), "distances are off by at most 0.036 %"));
  EXPECT_NEAR(file.tracks[0].observations[0].place.x, 555776.27, 0.01);
}

TEST(Read_tracks_projection, local_of_wide_data_is_refused_with_figures) {
  const std::string error = read_options_error(places({{10, 60}, {10.01, 60}, {10, 0}}),
                                               projected(Tracks_projection::local));
  EXPECT_TRUE(contains(error, "by --projection local distances would be wrong by up to 73 %"))
      << error;
  EXPECT_TRUE(
      contains(error, "expected --projection utm, by which they are wrong by at most 0.036 %"))
      << error;
  // The advice works.
  EXPECT_EQ(read_options_error(places({{10, 60}, {10.01, 60}, {10, 0}}),
                               projected(Tracks_projection::utm)),
            "");
}

TEST(Read_tracks_projection, what_no_projection_keeps_is_refused_by_each) {
  const std::string world = places({{-70, 40}, {0, 50}, {10, 0}});
  for (const auto projection : {Tracks_projection::local, Tracks_projection::utm}) {
    const std::string error = read_options_error(world, projected(projection));
    EXPECT_TRUE(contains(error, "; expected a file for each region, or --projection none"))
        << error;
  }
  // One parallel, on which the projection is right, though great circles leave it.
  EXPECT_TRUE(
      contains(read_options_error(places({{0, 60}, {20, 60}}), projected(Tracks_projection::local)),
               "would be wrong by up to"));
}

TEST(Read_tracks_projection, local_says_how_far_distances_are_off) {
  const Tracks_file file =
      read_options(places({{36.95, -1.45}, {36.95, -1.451}}), projected(Tracks_projection::local));
  EXPECT_NEAR(distance(file), 110.575, 0.001);
  EXPECT_TRUE(contains(file.remarks.back(), "distances are off by at most")) << file.remarks.back();
}

TEST(Read_tracks_projection, local_is_right_on_the_ellipsoid) {
  // Lengths in meters of a degree of longitude, and of one of latitude, on WGS 84.
  const std::array<std::array<double, 3>, 4> degrees = {{{0, 111319.49, 110574.28},
                                                         {30, 96486.28, 110852.44},
                                                         {60, 55800.00, 111412.29},
                                                         {75, 28902.01, 111618.38}}};
  for (const auto& [latitude, along_parallel, along_meridian] : degrees) {
    const Tracks_file east = read_options(places({{10, latitude}, {10.001, latitude}}),
                                          projected(Tracks_projection::local));
    EXPECT_NEAR(distance(east), along_parallel / 1000, 0.0001) << latitude;
    const Tracks_file north =
        read_options(places({{10, latitude - 0.0005}, {10, latitude + 0.0005}}),
                     projected(Tracks_projection::local));
    EXPECT_NEAR(distance(north), along_meridian / 1000, 0.0001) << latitude;
  }
}

// On the ellipsoid and not on the sphere: 0.08 degrees of latitude at 60 degrees north change the
// length of a parallel by 0.12 %.
TEST(Read_tracks_projection, local_keeps_a_tenth_of_a_percent) {
  const auto places_of = [](double half) { return places({{10, 60 - half}, {10.1, 60 + half}}); };
  const Tracks_file file = read_options(places_of(0.03), projected(Tracks_projection::local));
  EXPECT_TRUE(contains(file.remarks.back(),
                       "(equirectangular projection of the ellipsoid of WGS 84); distances are off "
                       "by at most 0.091 %"))
      << file.remarks.back();
  EXPECT_TRUE(
      contains(read_options_error(places_of(0.04), projected(Tracks_projection::local)),
               "by --projection local distances would be wrong by up to 0.12 %, and 0.1 % is"));
}

TEST(Read_tracks_projection, what_is_too_wide_for_figures_is_refused_without) {
  const std::string error =
      read_options_error(places({{-100, 10}, {75, 20}, {0, 0}}), projected(Tracks_projection::utm));
  EXPECT_TRUE(contains(error,
                       ": too far apart for --projection utm to keep distances, and 0.1 % "
                       "is allowed; expected a file for each region"))
      << error;
}

TEST(Read_tracks_projection, goes_on_over_the_antimeridian) {
  for (const auto projection : {Tracks_projection::local, Tracks_projection::utm}) {
    const Tracks_file file =
        read_options(places({{179.999, -17}, {-179.999, -17}}), projected(projection));
    // 0.002 degrees of longitude at 17 degrees south.
    EXPECT_NEAR(distance(file), 212.8, 0.6);
  }
  const Tracks_file south =
      read_options(places({{178, -18}, {178.01, -18}}), projected(Tracks_projection::utm));
  EXPECT_TRUE(contains(south.remarks.back(), "UTM, zone 60 south (EPSG:32760)"));
  EXPECT_NEAR(south.tracks[0].observations[0].place.y, 8009000, 2000);
}

TEST(Read_tracks_projection, preconditions_are_checked) {
  Tracks_file file;
  EXPECT_PRECONDITION_ERROR(project(file, "t.csv", Tracks_projection::none),
                            "the projection makes no meters of degrees");
  EXPECT_PRECONDITION_ERROR(transverse_mercator(90, 0),
                            "a place is too far from the central meridian, or not on earth");
  EXPECT_PRECONDITION_ERROR(read_options("", {.date_format = "%m"}),
                            "the format of dates is wrong");
}

// ---- tracks that a program has got by itself ----

// Two things, of which the second comes later.
Tracks_file made(Vector_2 a, Vector_2 b, const std::string& origin = {}) {
  Tracks_file result;
  result.tracks = {{.id = "a", .observations = {{0, a, 1}, {3600, b, 3}}},
                   {.id = "b", .observations = {{5, b, 2}, {3600, a, 4}}}};
  result.observations = 4;
  result.origin = origin;
  result.place_name = "observation";
  return result;
}

std::string made_error(const Tracks_file& file, const std::string& x, const std::string& y,
                       Tracks_projection projection = Tracks_projection::refused) {
  return test::message_of<Input_error>(
      [&] { project_tracks(file, "made", {.x = x, .y = y}, projection); });
}

TEST(Project_tracks, refuses_degrees_by_names) {
  const Tracks_file file = made({12, 55}, {12.01, 55});
  EXPECT_TRUE(contains(made_error(file, "location-long", "location-lat"),
                       "made: the columns 'location-long' and 'location-lat' are places in degrees "
                       "of longitude and latitude, between which distances mean nothing; expected "
                       "--projection local"));
  EXPECT_TRUE(contains(made_error(file, "", "lat"), "are places in degrees"));
  EXPECT_TRUE(contains(made_error(file, "lat", "lon", Tracks_projection::utm),
                       "expected the longitude as x, and the latitude as y"));
  EXPECT_TRUE(contains(made_error(file, "x_rad", "y_rad", Tracks_projection::utm), "in radians"));
  for (const auto& [x, y] : {std::pair{"x", "y"}, {"", ""}, {"lon_m", "lat_m"}}) {
    const Tracks_file same =
        project_tracks(file, "made", {.x = x, .y = y}, Tracks_projection::refused);
    EXPECT_EQ(shown(same), shown(file));
    EXPECT_TRUE(same.remarks.empty());
  }
  const Tracks_file none =
      project_tracks(file, "made", {.x = "lon", .y = "lat"}, Tracks_projection::none);
  EXPECT_EQ(shown(none), shown(file));
  EXPECT_EQ(none.remarks, std::vector<std::string>{"places are taken as they are, though the "
                                                   "columns 'lon' and 'lat' are of angles"});
}

TEST(Project_tracks, refuses_what_looks_like_degrees_where_names_say_nothing) {
  const Tracks_file dated = made({12.12345, 55.12345}, {12.12346, 55.12346}, "2024-05-01");
  EXPECT_TRUE(contains(made_error(dated, "x", "y"), "made: nothing says what the places are"));
  EXPECT_EQ(made_error(dated, "x", "y", Tracks_projection::none), "");
  EXPECT_EQ(made_error(made({12.12345, 55.12345}, {12.12346, 55.12346}), "x", "y"), "");
  EXPECT_EQ(made_error(made({12.12345, 55.12345}, {50.12346, 55.12346}, "2024-05-01"), "x", "y"),
            "");
}

TEST(Project_tracks, projects_and_says_how_far_distances_are_off) {
  const Tracks_file file = project_tracks(made({12, 55}, {12.01, 55}), "made",
                                          {.x = "lon", .y = "lat"}, Tracks_projection::utm);
  // As a table of the same places is.
  const Tracks_file table = read_options("t,id,lon,lat\n0,a,12,55\n3600,a,12.01,55\n",
                                         {.columns = {.t = "t", .id = "id", .x = "lon", .y = "lat"},
                                          .projection = Tracks_projection::utm});
  ASSERT_EQ(table.remarks.size(), 2U);
  EXPECT_EQ(file.remarks, table.remarks);
  EXPECT_EQ(file.tracks[0].observations[1].place, table.tracks[0].observations[1].place);
  EXPECT_EQ(file.tracks[0].observations[1].time, 3600);
  EXPECT_EQ(made_error(made({12, 55}, {200, 55}), "", "", Tracks_projection::local),
            "made: observation 3: the longitude is 200, and the latitude 55; expected degrees from "
            "-180 to 180, and from -90 to 90");
}

TEST(Project_tracks, leaves_out_what_is_no_place_of_ais) {
  Tracks_file file = made({181, 91}, {12, 55});
  file.tracks.push_back({.id = "c", .observations = {{9, {0, 91}, 5}}});
  file.observations = 5;
  const Tracks_file left =
      project_tracks(file, "made", {.x = "lon", .y = "lat"}, Tracks_projection::local);
  EXPECT_EQ(left.observations, 2U);
  EXPECT_EQ(left.rows_without_place, 3U);
  EXPECT_EQ(shown(left), "b: 5 (0, 0) line 2; a: 3600 (0, 0) line 3");
}

TEST(Project_tracks, preconditions_are_checked) {
  const auto project_made = [](const Tracks_file& file) {
    project_tracks(file, "made", {}, Tracks_projection::refused);
  };
  Tracks_file empty = made({}, {});
  empty.tracks[0].observations.clear();
  EXPECT_PRECONDITION_ERROR(project_made(empty), "a track has no observation");
  Tracks_file unsorted = made({}, {});
  unsorted.tracks[1].observations[0].time = 3600;
  EXPECT_PRECONDITION_ERROR(project_made(unsorted), "the times of a track do not ascend");
  EXPECT_PRECONDITION_ERROR(project_made(made({INFINITY, 0}, {})), "a place is not finite");
}

}  // namespace
}  // namespace kinetri::tracks_degrees_test
