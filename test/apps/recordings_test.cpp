// SPDX-License-Identifier: GPL-3.0-or-later
//
// `kinetri tracks` with files as people write them: the answers, what the summary says, and that
// the options that messages advise do help.
#include <string>
#include <vector>

#include "apps/program_test.h"

namespace kinetri::recordings_test {
namespace {

using test::Arguments;
using test::Outcome;

class Recordings : public test::Program_test {
 protected:
  Outcome tracks(const std::string& text, Arguments more = {}) const {
    write("t.csv", text);
    more.insert(more.begin(), {"tracks", "t.csv"});
    return run(more);
  }
  // That the file is refused with a message that has the text, and read with the options.
  void expect_advice(const std::string& text, const Arguments& before, const std::string& advice,
                     const Arguments& after) const {
    const Outcome refused = tracks(text, before);
    EXPECT_EQ(refused.exit_code, 2) << text;
    EXPECT_NE(refused.err.find(advice), std::string::npos) << refused.err;
    const Outcome done = tracks(text, after);
    EXPECT_EQ(done.exit_code, 0) << done.err;
  }
};

bool says(const Outcome& outcome, const std::string& text) {
  return outcome.err.find(text) != std::string::npos;
}

// ---- things that share a path ----

constexpr const char* bench =
    "t,id,x,y\n0,A,-5,0\n5,A,0,0\n10,A,0,0\n15,A,5,0\n0,B,0,-5\n5,B,0,0\n10,B,0,0\n15,B,0,5\n"
    "0,C,3,3\n15,C,3,4\n";

TEST_F(Recordings, of_two_on_one_bench_are_refused_if_asked_for) {
  const Outcome refused = tracks(bench, {"--coincident", "refuse"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_TRUE(says(refused, "from t = 5 on ids 'A' and 'B' go the same way (see line 3)"))
      << refused.err;
}

TEST_F(Recordings, of_many_that_share_paths_name_ten_pairs) {
  std::string text = "t,id,x,y\n";
  for (int pair = 0; pair < 12; ++pair) {
    for (const char* const name : {"a", "b"}) {
      const std::string id = name + std::to_string(pair);
      // From the time pair + 1 on they are together.
      const std::string start = name[0] == 'a' ? "0" : "1";
      text += "0," + id + "," + std::to_string(9 * pair) + "," + start + "\n" +
              std::to_string(pair + 1) + "," + id + "," + std::to_string(9 * pair) + ",3\n50," +
              id + "," + std::to_string(9 * pair) + ",7\n";
    }
  }
  const Outcome refused = tracks(text, {"--coincident", "refuse"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_TRUE(says(refused, "from t = 1 on ids 'a0' and 'b0' go the same way")) << refused.err;
  for (int pair = 1; pair < 10; ++pair) {
    const std::string number = std::to_string(pair);
    EXPECT_TRUE(says(refused, "'a" + number + "' and 'b" + number +
                                  "' from t = " + std::to_string(pair + 1) + " on"))
        << refused.err;
  }
  EXPECT_FALSE(says(refused, "'a10'"));
  EXPECT_TRUE(says(refused, ", and more pairs; expected")) << refused.err;
}

TEST_F(Recordings, of_things_at_one_place_have_their_encounters) {
  // Two who walk together from 2 to 10; a rider in a bus, and a guest in it from 4 to 8; two at
  // rest on one bench from 5 to 9. They approach along one line, and part along one, or at right
  // angles.
  const Outcome done = tracks(
      "t,id,x,y\n0,walker,0,0\n16,walker,16,0\n"
      "0,friend,0,4\n2,friend,2,0\n7,friend,7,0\n10,friend,10,0\n14,friend,10,4\n"
      "0,bus,100,0\n8,bus,116,0\n20,bus,140,0\n0,rider,100,0\n20,rider,140,0\n"
      "1,guest,102,3\n4,guest,108,0\n8,guest,116,0\n12,guest,116,8\n"
      "0,left,50,60\n3,left,50,50\n9,left,50,50\n19,left,40,50\n"
      "0,right,60,50\n5,right,50,50\n9,right,50,50\n19,right,60,50\n",
      {"--encounters", "-", "--range", "2", "--audit", "events"});
  EXPECT_EQ(done.exit_code, 0) << done.err;
  // 10 + sqrt(2), and 8 + 1 / sqrt(2).
  EXPECT_EQ(done.out,
            "a,b,begin_lo,begin_hi,end_lo,end_hi,closest_lo,closest_hi,distance,label_a,label_b\n"
            "2,3,0,0,20,20,0,0,0,bus,rider\n"
            "0,1,1,1,11.414213562373094,11.414213562373096,2,2,0,walker,friend\n"
            "2,6,2,2,8.707106781186546,8.707106781186548,4,4,0,bus,guest\n"
            "3,6,2,2,8.707106781186546,8.707106781186548,4,4,0,rider,guest\n"
            "4,5,4,4,10,10,5,5,0,left,right\n");
  EXPECT_TRUE(says(done, "coincident   1 point at the start, the first is rider, with bus"))
      << done.err;
}

TEST_F(Recordings, of_things_at_one_place_have_events_of_who_hides_whom) {
  const Outcome done = tracks(bench, {"--events", "-"});
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_NE(done.out.find(",hide,5,5,5,,,,,1,0,"), std::string::npos) << done.out;
  EXPECT_NE(done.out.find(",reveal,10,10,10,,,,,1,0,"), std::string::npos) << done.out;
}

// ---- advice ----

TEST_F(Recordings, are_read_as_the_messages_advise) {
  const Arguments by_number = {"--format", "table", "--columns", "t=1,id=2,x=3,y=4"};
  const std::string many = "780 1 8 0 3 1\n786 1 9 0 3 1\n780 2 8 5 3 1\n786 2 9 5 3 1\n";
  const char* const numbers = "--columns t=N,id=N,x=N,y=N";
  expect_advice(many, {}, "--format table --columns t=N,id=N,x=N,y=N", by_number);
  expect_advice(many, {"--format", "frames"}, "expected 4", by_number);
  expect_advice("1 7 0 0 9\n2 7 0 0 9\n3 7 0 0 9\n", {"--format", "ids"}, numbers, by_number);
  expect_advice("1,1,10,20,5\n2,1,11,20,5\n", {}, numbers, {"--columns", "t=1,id=2,x=3,y=4"});
  expect_advice("1,1,10,20,5\n2,1,11,20,5\n", {"--format", "frames"}, numbers, by_number);
  expect_advice("1,1,10,20\n2,1,11,20\n", {"--columns", "t=t,id=id,x=x,y=y"}, numbers, by_number);
  // As it stands the advice names no columns, so that nobody exchanges two by it.
  EXPECT_EQ(tracks(many, {"--format", "table", "--columns", "t=N,id=N,x=N,y=N"}).exit_code, 2);
  expect_advice("1 7 0 0\n2 7 1 0\n", {}, "with --format frames", {"--format", "frames"});
  expect_advice("7 1 0 0\n8 1 1 0\n9 1 2 0\n", {"--format", "ids"},
                "read the file with --format frames", {"--format", "frames"});
  expect_advice("t,id,x,y\n05/03/2023 00:00:00,a,1,2\n05/03/2023 00:00:10,a,3,2\n", {},
                "--date-format '%d/%m/%Y %H:%M:%S'", {"--date-format", "%d/%m/%Y %H:%M:%S"});
  expect_advice("t,id,x,y\n0,a,1,2\n0,a,1,3\n1,a,4,4\n", {}, "--duplicates first, last or mean",
                {"--duplicates", "mean"});
  expect_advice(bench, {"--coincident", "refuse"}, "--coincident hide", {"--coincident", "hide"});
  const Arguments lon = {"--columns", "t=t,id=id,x=lon,y=lat"};
  const std::string ships = "t,id,lon,lat\n0,a,10,60\n9,a,10.01,60\n0,b,10,0\n9,b,10.01,0\n";
  const auto with = [&](const char* projection) {
    Arguments result = lon;
    result.insert(result.end(), {"--projection", projection});
    return result;
  };
  expect_advice(ships, lon, "--projection none", with("none"));
  expect_advice(ships, lon, "--projection utm", with("utm"));
  expect_advice(ships, with("local"), "expected --projection utm, by which", with("utm"));
  const std::string commented = "# longitude latitude\ntime,name,E,N\n0,a,10,60\n9,a,10.01,60\n";
  expect_advice(commented, {}, "--columns t=NAME,id=NAME,x=NAME,y=NAME",
                {"--columns", "t=time,id=name,x=E,y=N", "--projection", "utm"});
  const std::string near = "t,id,lon,lat\n0,a,10,60\n9,a,10.01,60\n";
  expect_advice(near, lon, "--projection local", with("local"));
  const auto box = [](int timestep, const char* x) {
    return "ITEM: TIMESTEP\n" + std::to_string(timestep) +
           "\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp pp\n0 10\n0 10\n0 1\nITEM: ATOMS id "
           "x "
           "y\n1 " +
           x + " 5\n";
  };
  expect_advice(box(0, "9") + box(1, "1"), {}, "--unwrap nearest", {"--unwrap", "nearest"});
  const std::string track =
      "<particle><detection t=\"0\" x=\"1\" y=\"2\"/><detection t=\"1\" "
      "x=\"2\" y=\"2\"/></particle></Tracks>";
  expect_advice("<Tracks nTracks=\"1\">" + track, {}, "expected one, or --fps", {"--fps", "25"});
  expect_advice("<Tracks frameInterval=\"0\">" + track, {}, "or --fps", {"--fps", "25"});
  const std::string of_day = "t,id,x,y\n9:59:50,a,1,2\n10:00:00,a,3,2\n";
  expect_advice(of_day, {}, "or --date-format '%H:%M:%S', which makes it seconds since midnight",
                {"--date-format", "%H:%M:%S"});
  expect_advice("t,id,x,y\n20200131,a,1,2\n20200201,a,3,2\n", {}, "expected --date-format '%Y%m%d'",
                {"--date-format", "%Y%m%d"});
  expect_advice("t,id,x,y\n0,a,\"1\",2\n1,a,\"3\",2\n", {}, "--columns t=t,id=id,x=x,y=y",
                {"--columns", "t=t,id=id,x=x,y=y"});
}

// ---- the summary ----

TEST_F(Recordings, say_in_the_summary_what_was_left_out) {
  const Outcome done = tracks(
      "# made by hand\nt,id,x,y,z\ns,,m,m,m\n0,a,0,0,1\n1,a,1,0,1\n1,a,2,0,1\n2,a,2,0,1\n3,a,,,\n"
      "4,a,4,0,1\n");
  EXPECT_EQ(done.exit_code, 0) << done.err;
  for (const char* const text :
       {"1 line left out, beginning with #", "1 row without numbers below the header left out",
        "1 row left out, having no place", "the column z, is left out",
        "1 row left out for an earlier one with another place of the same id at the same time "
        "(--duplicates first, last, mean or refuse)"}) {
    EXPECT_TRUE(says(done, text)) << text << done.err;
  }
  write("p.csv", "# c\nid,x,y,z,vx,vy,vz\n#1,0,0,5,1,1,0\n#2,9,0,5,1,1,0\n");
  const Outcome points = run({"simulate", "p.csv", "--until", "1"});
  EXPECT_TRUE(says(points, "kinetri: 2 points")) << points.err;
  EXPECT_TRUE(says(points, "1 line left out, beginning with #")) << points.err;
  EXPECT_TRUE(says(points, "columns that are ignored: 'z', 'vz'")) << points.err;
}

TEST_F(Recordings, in_utf16_are_read_and_verified) {
  const std::string text = "x,y,vx,vy\n0,0,1,0\n5,5,-1,0\n0,9,0,0\n";
  std::string wide = "\xFF\xFE";
  for (const char c : text) wide += {c, '\0'};
  write("p.csv", wide);
  const Outcome points = run({"simulate", "p.csv", "--until", "3"});
  EXPECT_EQ(points.exit_code, 0) << points.err;
  EXPECT_TRUE(says(points, "kinetri: 3 points")) << points.err;
  EXPECT_TRUE(says(points, "the file is in UTF-16, read as UTF-8")) << points.err;
}

// ---- a ball at rest ----

TEST_F(Recordings, a_ball_that_rests_at_a_wall_is_advised_what_helps) {
  write("p.csv", "x,y,vx,vy,ax,ay\n5,0,0,0,0,-1\n2,5,0,0,0,0\n");
  const Outcome refused = run({"simulate", "p.csv", "--until", "1", "--box", "0,0,10,10"});
  EXPECT_EQ(refused.exit_code, 130);
  EXPECT_TRUE(says(refused,
                   "expected contacts with a speed: change the acceleration or the box, or "
                   "end before that time"))
      << refused.err;
  EXPECT_FALSE(says(refused, "stop"));
  EXPECT_EQ(run({"simulate", "p.csv", "--until", "1", "--box", "0,-10,10,10"}).exit_code, 0);
  write("p.csv", "x,y,vx,vy,ax,ay\n5,0,0,0,0,0\n2,5,0,0,0,0\n");
  EXPECT_EQ(run({"simulate", "p.csv", "--until", "1", "--box", "0,0,10,10"}).exit_code, 0);
}

}  // namespace
}  // namespace kinetri::recordings_test
