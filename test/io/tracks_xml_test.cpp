// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tracks as XML of GPS receivers and TrackMate, degrees in XML of SUMO, and formats that are not
// read.
#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "kinetri/io/tracks_file.h"
#include "support/tracks_text.h"

namespace kinetri::tracks_xml_test {
namespace {

using test::read_options;
using test::read_options_error;
using test::shown;

bool contains(const std::string& text, const std::string& piece) {
  return text.find(piece) != std::string::npos;
}
[[maybe_unused]] bool has_remark(const Tracks_file& file, const std::string& piece) {
  for (const std::string& remark : file.remarks) {
    if (contains(remark, piece)) return true;
  }
  return false;
}

// ---- formats that are named ----

TEST(Recognized_tracks_formats, that_nothing_here_reads_say_what_to_do) {
  for (const auto& [text, piece] :
       {std::pair{"!AIVDM,1,1,,B,177KQJ5000G?tO`K>RA1wUbN0TKH,0*5C\n", "encoded messages of AIS"},
        {"$GPGGA,123519,4807.038,N,01131.000,E,1,08,0.9,545.4,M,46.9,M,,*47\n", "gpsbabel -i nmea"},
        {"Geolife trajectory\nWGS 84\n", "tail -n +7"},
        {"ARROW1", "is a file of Arrow; expected Tracks.read of the Python package, or a table"},
        {"FEA1", "pandas.read_feather('FILE').to_csv"},
        {"PAR1", "pandas.read_parquet('FILE').to_csv"},
        {"<?xml version=\"1.0\"?>\n<TrackMate version=\"7\">\n", "Export tracks to XML file"},
        {"<kml xmlns=\"x\"></kml>", "gpsbabel -i kml"}}) {
    EXPECT_TRUE(contains(read_options_error(text, {}), piece)) << read_options_error(text, {});
  }
}

#ifdef KINETRI_WITH_EXPAT

TEST(Read_tracks_gpx, reads_tracks_with_names) {
  const std::string text =
      "<?xml version=\"1.0\"?>\n<gpx version=\"1.1\">\n<wpt lat=\"1\" lon=\"2\"/>\n"
      "<trk><name>Ada</name><trkseg>\n"
      "<trkpt lat=\"55.0\" lon=\"12.0\"><ele>3</ele><time>2023-03-05T00:00:00Z</time></trkpt>\n"
      "<trkpt lat=\"55.5\" lon=\"12.0\"><time>2023-03-05T00:00:10Z</time></trkpt>\n"
      "</trkseg></trk>\n<trk><trkseg>\n"
      "<trkpt lat=\"56\" lon=\"13\"><time> 2023-03-05T00:00:05Z </time></trkpt>\n"
      "</trkseg></trk></gpx>\n";
  EXPECT_TRUE(contains(read_options_error(text, {}), "places in GPX are in degrees"));
  const Tracks_file file = read_options(text, {.projection = Tracks_projection::none});
  EXPECT_EQ(shown(file), "Ada: 0 (12, 55) line 5 10 (12, 55.5) line 6; track 2: 5 (13, 56) line 9");
  EXPECT_EQ(file.format, Tracks_format::gpx);
  EXPECT_EQ(file.origin, "2023-03-05T00:00:00Z");
  EXPECT_TRUE(contains(read_options_error("<gpx><trk><trkseg><trkpt lat=\"1\" "
                                          "lon=\"2\"/></trkseg></trk></gpx>",
                                          {.projection = Tracks_projection::none}),
                       "has no time"));
}

TEST(Read_tracks_gpx, refuses_tracks_of_one_name_at_one_time) {
  const auto ride = [](const std::string& first, const std::string& second) {
    return "<trk><name>Ride</name><trkseg>\n<trkpt lat=\"55\" lon=\"12\"><time>2023-03-05T00:00:" +
           first +
           "Z</time></trkpt>\n<trkpt lat=\"55\" lon=\"12.1\"><time>2023-03-05T00:00:" + second +
           "Z</time></trkpt></trkseg></trk>\n";
  };
  const Tracks_file_options options = {.projection = Tracks_projection::none};
  EXPECT_EQ(
      read_options_error("<gpx>\n" + ride("00", "20") + ride("10", "30") + "</gpx>", options),
      "t.csv:5: the track 'Ride' is at times of that of line 2, which has the same name; expected "
      "another name for one of the two, if they are of two things");
  // One after the other, in any order, they are one thing.
  EXPECT_EQ(read_options("<gpx>\n" + ride("20", "30") + ride("00", "10") + "</gpx>", options)
                .tracks.size(),
            1U);
}

TEST(Read_tracks_gpx, in_utf16_is_read) {
  const std::string text =
      "<?xml version=\"1.0\" encoding=\"UTF-16\"?>\n<gpx><trk><name>Ada</name><trkseg>\n"
      "<trkpt lat=\"55\" lon=\"12\"><time>2023-03-05T00:00:00Z</time></trkpt>\n"
      "</trkseg></trk></gpx>\n";
  std::string wide = "\xFF\xFE";
  for (const char c : text) wide += {c, '\0'};
  EXPECT_EQ(read_options(wide, {.projection = Tracks_projection::none}).observations, 1U);
}

TEST(Read_tracks_trackmate, reads_particles) {
  const std::string text =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<Tracks nTracks=\"2\" spaceUnits=\"micron\" frameInterval=\"0.5\" timeUnits=\"sec\">\n"
      "<particle nSpots=\"2\">\n<detection t=\"0\" x=\"1\" y=\"2\" z=\"0\" />\n"
      "<detection t=\"3\" x=\"2\" y=\"2\" z=\"0\" />\n</particle>\n"
      "<particle nSpots=\"1\">\n<detection t=\"1\" x=\"5\" y=\"2\" z=\"0\" "
      "/>\n</particle>\n</Tracks>\n";
  const Tracks_file file = read_options(text, {});
  EXPECT_EQ(shown(file), "0: 0 (1, 2) line 4 1.5 (2, 2) line 5; 1: 0.5 (5, 2) line 8");
  EXPECT_EQ(file.format, Tracks_format::trackmate);
  EXPECT_TRUE(has_remark(file, "frames are 0.5 sec apart"));
  EXPECT_EQ(shown(read_options(text, {.fps = 1.0})),
            "0: 0 (1, 2) line 4 3 (2, 2) line 5; 1: 1 (5, 2) line 8");
}

TEST(Read_tracks_sumo_degrees, are_known_by_the_comment) {
  const auto file = [](const std::string& option) {
    return "<?xml version=\"1.0\"?>\n<!-- generated by SUMO\n<sumoConfiguration>\n<output>\n" +
           option +
           "\n</output>\n</sumoConfiguration>\n-->\n<fcd-export>\n<timestep time=\"0\">\n"
           "<vehicle id=\"a\" x=\"12.5\" y=\"55.5\"/></timestep></fcd-export>\n";
  };
  for (const char* const option :
       {"<fcd-output.geo value=\"true\"/>", "<fcd-output.geo value=\"1\"/>",
        "<fcd-output.geo value=\"yes\"/>", "<fcd-output.geo value=\"on\"/>"}) {
    EXPECT_TRUE(contains(read_options_error(file(option), {}),
                         "the comment of SUMO has fcd-output.geo: places are in degrees"))
        << option;
    EXPECT_TRUE(has_remark(read_options(file(option), {.projection = Tracks_projection::utm}),
                           "places are degrees, as the comment of SUMO says"));
  }
  for (const char* const option :
       {"", "<fcd-output.geo value=\"false\"/>", "<fcd-output value=\"fcd.xml\"/>",
        "<fcd-output.geo value=\"0\"/>"}) {
    EXPECT_EQ(read_options_error(file(option), {}), "") << option;
  }
}

TEST(Read_tracks_sumo_degrees, are_suspected_by_speeds) {
  const auto file = [](const char* first, const char* second) {
    const auto vehicle = [](const char* place) {
      return "<vehicle id=\"a\" " + std::string(place) + " speed=\"10\"/></timestep>";
    };
    return "<fcd-export><timestep time=\"0\">" + vehicle(first) + "<timestep time=\"1\">" +
           vehicle(second) + "</fcd-export>";
  };
  const std::string degrees = file("x=\"12.5\" y=\"55.5\"", "x=\"12.50015\" y=\"55.5\"");
  EXPECT_TRUE(contains(read_options_error(degrees, {}), "the places look like degrees"));
  EXPECT_EQ(read_options(degrees, {.projection = Tracks_projection::none}).observations, 2U);
  EXPECT_EQ(read_options(file("x=\"12.5\" y=\"55.5\"", "x=\"22.5\" y=\"55.5\""), {}).observations,
            2U);
}

#endif

}  // namespace
}  // namespace kinetri::tracks_xml_test
