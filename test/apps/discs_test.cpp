// SPDX-License-Identifier: GPL-3.0-or-later
//
// The program on discs of any size, and on discs that grow: contacts, masses, hidden points, and
// what the outputs hold of them.
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "apps/program_test.h"
#include "support/text.h"

namespace kinetri::discs_test {
namespace {

using test::Arguments;
using test::between;
using test::count;
using test::Outcome;

constexpr const char* header =
    "event,kind,time,time_lo,time_hi,removed_a,removed_b,added_a,added_b,point_a,point_b,"
    "instant\n";

class Discs : public test::Program_test {
 protected:
  // Runs on the file p.csv with this text, and gives the event log.
  std::string log(const std::string& text, Arguments more, const char* audit = "events") const {
    write("p.csv", text);
    more.insert(more.begin(), {"simulate", "p.csv"});
    more.insert(more.end(), {"--events", "-", "--quiet", "--audit", audit});
    const Outcome outcome = run(more);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.out;
  }

  // Its rows of walls and collisions: "collision 3 0 1\n...", or those of other kinds.
  static std::string rows(const std::string& events,
                          const std::vector<std::string>& kinds = {"wall", "collision"}) {
    std::istringstream in(events);
    std::string result;
    for (std::string line; std::getline(in, line);) {
      std::vector<std::string> fields;
      std::istringstream row(line);
      for (std::string field; std::getline(row, field, ',');) fields.push_back(field);
      if (std::find(kinds.begin(), kinds.end(), fields[1]) == kinds.end()) continue;
      fields.resize(11);
      result += fields[1] + ' ' + fields[2] + ' ' + fields[9];
      result += (fields[10].empty() ? "" : " " + fields[10]) + '\n';
    }
    return result;
  }

  // Discs of many sizes in a box of side 40, that do not overlap: on a lattice.
  static std::string many(unsigned seed, const std::string& more_columns = "",
                          const std::string& more = "") {
    std::mt19937 random(seed);
    const auto number = [&](unsigned steps) {
      return static_cast<double>(random() % (2 * steps + 1)) - steps;
    };
    std::ostringstream text;
    text << "x,y,vx,vy,radius" << more_columns << '\n';
    for (int i = 0; i < 36; ++i) {
      text << 5 + 6 * (i % 6) << ',' << 5 + 6 * (i / 6) << ',' << number(16) / 4.0 << ','
           << number(16) / 4.0 << ',' << std::pow(2, number(3)) / 4 << more << '\n';
    }
    return text.str();
  }
};

// ---- contacts ----

TEST_F(Discs, of_two_sizes_touch_where_their_rims_meet) {
  EXPECT_EQ(rows(log("x,y,vx,vy,radius\n0,0,1,0,1\n9,0,0,0,3\n0,20,0,0,0.5\n",
                     {"--until", "20", "--collisions", "swap", "--box", "-10,-10,30,30"})),
            "collision 5 0 1\n");
}

// The center of the small disc between the two large ones keeps these from being neighbors in the
// Delaunay triangulation when they touch.
TEST_F(Discs, that_are_no_delaunay_neighbors_touch) {
  EXPECT_EQ(rows(log("x,y,vx,vy,radius\n-3,0,1,0,1\n3,0,-1,0,1\n0,0.5,0,0,0.05\n0,-0.5,0,0,0.05\n",
                     {"--until", "2", "--collisions", "swap"})),
            "collision 2 0 1\n");
}

TEST_F(Discs, that_grow_touch_while_they_rest) {
  const std::string grown = rows(log("x,y,vx,vy,radius,growth\n0,0,0,0,1,0.5\n9,0,0,0,3,0.25\n",
                                     {"--until", "10", "--collisions", "log"}));
  // 9 = 4 + 0.75 t at t = 6.66...
  EXPECT_TRUE(grown.starts_with("collision 6.66666666666666")) << grown;
  EXPECT_EQ(rows(log("x,y,vx,vy\n0,0,0,0\n8,0,0,0\n",
                     {"--until", "10", "--collisions", "log", "--growth", "0.5"})),
            "collision 8 0 1\n");
}

TEST_F(Discs, with_acceleration_touch) {
  // Their centers are 16 - t^2 apart, the radii 3 in all.
  EXPECT_EQ(rows(log("x,y,vx,vy,ax,ay,radius\n0,0,0,0,1,0,1\n12,0,0,0,-1,0,2\n",
                     {"--until", "4", "--collisions", "stop"})),
            "collision 3 0 1\n");
}

TEST_F(Discs, touch_walls_with_their_own_rims) {
  const std::string text = "x,y,vx,vy,radius,growth\n5,5,1,0,1,0\n5,15,1,0,3,0\n5,12,0,0,0,0.5\n";
  const Arguments box = {"--until", "4.5", "--box", "0,0,10,20", "--rim"};
  EXPECT_EQ(rows(log(text, box)), "wall 2 1\nwall 4 0\n");
  EXPECT_EQ(rows(log(text, {"--until", "4.5", "--box", "0,0,9,20"})), "wall 4 0\nwall 4 1\n");
}

TEST_F(Discs, have_the_log_of_points_where_all_radii_are_equal) {
  const std::string points =
      run({"generate", "lattice-jitter", "--points", "49", "--speed", "5", "--seed", "2"}).out;
  for (const char* response : {"log", "elastic", "remove"}) {
    const Arguments common = {"--until",      "4",      "--box",    "-5,-5,65,65",
                              "--collisions", response, "--radius", "3"};
    const std::string expected = log(points, common, "end");
    EXPECT_GT(count(expected, "collision"), 5U);
    Arguments regular = common;
    regular.push_back("--regular");
    EXPECT_TRUE(log(points, regular, "end") == expected);
    regular.push_back("--rim");
    Arguments rims = common;
    rims.push_back("--rim");
    EXPECT_TRUE(log(points, regular, "none") == log(points, rims, "none"));
  }
}

TEST_F(Discs, may_be_none) {
  for (const char* more : {"--rim", "--regular", "--mass=area"}) {
    write("p.csv", "x,y,vx,vy,radius,growth,mass\n");
    const Outcome outcome = run({"simulate", "p.csv", "--until", "2", "--box", "0,0,1,1",
                                 "--collisions", "elastic", more, "--checkpoint", "c"});
    EXPECT_EQ(outcome.exit_code, 0) << more << outcome.err;
    const Outcome later = run({"resume", "c", "--until", "3", "--edges", "-", "--quiet"});
    EXPECT_EQ(later.out, "a,b\n") << more << later.err;
  }
}

// ---- masses ----

TEST_F(Discs, collide_by_their_masses) {
  // 3 at the speed 1 against 1 at rest: 1/2 and 3/2 from t = 3 on.
  const std::string text = "x,y,vx,vy,radius,mass\n0,0,1,0,1,3\n5,0,0,0,1,1\n";
  const Arguments arguments = {"--until", "9.5", "--box", "-9,-9,14,9", "--collisions"};
  const auto with = [&](const char* response, const std::string& points) {
    Arguments all = arguments;
    all.emplace_back(response);
    return rows(log(points, all));
  };
  EXPECT_EQ(with("elastic", text), "collision 3 0 1\nwall 9 1\n");
  EXPECT_EQ(with("swap", text), "collision 3 0 1\n");
  EXPECT_EQ(with("elastic", "x,y,vx,vy,radius\n0,0,1,0,1\n5,0,0,0,1\n"), "collision 3 0 1\n");
}

TEST_F(Discs, have_the_squares_of_their_radii_as_masses_if_asked_for) {
  const Arguments box = {"--until", "5",     "--box",  "0,0,40,40", "--collisions",
                         "elastic", "--rim", "--mass", "area"};
  const std::string by_area = log(many(1), box, "end");
  std::istringstream in(many(1));
  std::string line;
  std::getline(in, line);
  std::string with_column = line + ",mass\n";
  while (std::getline(in, line)) {
    const double radius = std::stod(line.substr(line.rfind(',') + 1));
    std::ostringstream mass;
    mass << std::setprecision(17) << radius * radius;
    with_column += line + ',' + mass.str() + '\n';
  }
  Arguments column = box;
  column.back() = "column";
  EXPECT_TRUE(log(with_column, column, "none") == by_area);
  EXPECT_FALSE(log(many(1), column, "none") == by_area);
  EXPECT_GT(count(by_area, "collision"), 20U);
}

// ---- many ----

TEST_F(Discs, of_many_sizes_stay_apart) {
  for (const bool grow : {false, true}) {
    const std::string text = grow ? many(3, ",growth", ",0.0625") : many(3);
    const Outcome outcome = [&] {
      write("p.csv", text);
      return run({"simulate", "p.csv", "--until", "6", "--box", "0,0,40,40", "--rim",
                  "--collisions", "elastic", "--audit", "end", "--stats", "s.json", "--events",
                  "filtered.csv"});
    }();
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto stats = nlohmann::json::parse(read("s.json"));
    EXPECT_GT(stats["events"]["collision"], 20);
    EXPECT_EQ(stats["events"]["hide"], 0);
    EXPECT_EQ(stats["audits"]["failed"], 0);
    run({"simulate", "p.csv", "--until", "6", "--box", "0,0,40,40", "--rim", "--collisions",
         "elastic", "--exact-only", "--events", "exact.csv"});
    EXPECT_EQ(read("exact.csv"), read("filtered.csv"));
  }
}

TEST_F(Discs, may_differ_about_one_center) {
  EXPECT_EQ(log("x,y,vx,vy,radius\n0,0,1,0,1\n0,0,1,0,2\n9,0,1,0,1\n0,9,1,0,1\n",
                {"--until", "3", "--regular"}),
            header);
}

// ---- hidden points ----

// A large disc passes over a point at (0, 1), which is within a triangle of three others.
constexpr const char* passing =
    "x,y,vx,vy,radius\n-20,-10,0,0,0\n20,-10,0,0,0\n0,30,0,0,0\n0,1,0,0,0\n-8,0.5,1,0,4\n";

TEST_F(Discs, hide_points_and_show_them_again) {
  const std::string events =
      rows(log(passing, {"--until", "16", "--regular", "--edges", "e.csv"}), {"hide", "reveal"});
  std::istringstream in(events);
  std::string kind;
  double hidden = 0;
  double shown = 0;
  int point = 0;
  in >> kind >> hidden >> point;
  EXPECT_EQ(kind, "hide");
  EXPECT_EQ(point, 3);
  in >> kind >> shown >> point;
  EXPECT_EQ(kind, "reveal");
  EXPECT_EQ(point, 3);
  EXPECT_FALSE(in >> kind) << events;
  EXPECT_GT(hidden, 0);
  EXPECT_LT(hidden, 8);
  EXPECT_GT(shown, 8);
  EXPECT_EQ(rows(log(passing, {"--until", "16"}), {"hide", "reveal"}), "");
}

TEST_F(Discs, are_in_pictures_and_frames_in_their_sizes) {
  write("p.csv", passing);
  const Outcome outcome = run({"simulate", "p.csv", "--until", "16", "--regular", "--frames", "f",
                               "--vtu", "v", "--fps", "0.125", "--html", "run.html"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::string before = read("f/frame_000000.svg");
  const std::string during = read("f/frame_000001.svg");
  EXPECT_EQ(count(before, "class=\"hidden"), 0U);
  EXPECT_EQ(count(between(before, "<g class=\"discs\"", "</g>"), "<circle "), 5U);
  EXPECT_EQ(count(between(during, "<g class=\"points\"", "</g>"), "<circle "), 4U);
  EXPECT_EQ(count(between(during, "<g class=\"hidden-points\"", "</g>"), "<circle "), 1U);
  EXPECT_NE(read("v/frame_000001.vtu").find("Name=\"hidden\""), std::string::npos);
  EXPECT_NE(read("run.html").find("\"sizes\":"), std::string::npos);
}

// ---- tracks ----

TEST_F(Discs, of_tracks_have_radii_of_their_own) {
  write("t.csv",
        "t,id,x,y,radius\n0,ada,0,0,1\n8,ada,8,0,1\n0,bea,9,0,2\n8,bea,9,0,2\n0,cid,0,9,0.5\n"
        "8,cid,8,9,0.5\n");
  const Outcome outcome =
      run({"tracks", "t.csv", "--collisions", "log", "--events", "-", "--quiet", "--audit", "end"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(rows(outcome.out), "collision 6 0 1\n");
  const Outcome none = run({"tracks", "t.csv", "--events", "-", "--quiet"});
  EXPECT_EQ(rows(none.out), "");
}

}  // namespace
}  // namespace kinetri::discs_test
