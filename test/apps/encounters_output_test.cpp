// SPDX-License-Identifier: GPL-3.0-or-later
//
// --encounters and --contact-plan.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "apps/program_test.h"

namespace kinetri::encounters_output_test {
namespace {

using test::Arguments;
using test::Outcome;

class Encounters_output : public test::Program_test {
 protected:
  Outcome simulate(const std::string& points, Arguments arguments) const {
    write("points.csv", points);
    arguments.insert(arguments.begin(), {"simulate", "points.csv", "--quiet"});
    return run(arguments);
  }
};

// 0 and 1 come to the distance 5 at t = 3, are nearest at t = 5 and part at t = 7. The run ends
// before 0 and 2 part. Of 1 and 2 the times are irrational.
constexpr const char* three_points = "x,y,vx,vy\n0,0,1,0\n10,3,-1,0\n0,6,1,-1\n";

TEST_F(Encounters_output, has_the_exact_times) {
  const Outcome outcome = simulate(
      three_points, {"--until", "8", "--encounters", "-", "--range", "5", "--events", "e.csv"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  std::istringstream lines(outcome.out);
  std::vector<std::string> rows;
  for (std::string line; std::getline(lines, line);) rows.push_back(line);
  ASSERT_EQ(rows.size(), 4U) << outcome.out;
  EXPECT_EQ(rows[0], "a,b,begin_lo,begin_hi,end_lo,end_hi,closest_lo,closest_hi,distance");
  EXPECT_EQ(rows[1], "0,2,1,1,8,8,6,6,0");
  EXPECT_EQ(rows[2].substr(0, 6), "1,2,2.");
  EXPECT_EQ(rows[3], "0,1,3,3,7,7,5,5,3");
}

TEST_F(Encounters_output, has_gaps_where_discs_touch) {
  const Outcome outcome =
      simulate("x,y,vx,vy,radius\n0,0,1,0,1\n10,0,0,0,2\n0,40,0,0,1\n",
               {"--until", "8", "--collisions", "log", "--encounters", "-", "--range", "1"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out,
            "a,b,begin_lo,begin_hi,end_lo,end_hi,closest_lo,closest_hi,distance,gap\n"
            "0,1,6,6,8,8,8,8,2,-1\n");
}

// The points of a table with labels have them in the last columns; ids are numbers as ever.
TEST_F(Encounters_output, have_the_labels_that_the_input_has) {
  const Outcome outcome =
      simulate("id,x,y,vx,vy\nAda,0,0,1,0\n\"Ben, jr.\",10,3,-1,0\n\"a \"\"C\"\"\",0,6,1,-1\n",
               {"--until", "8", "--encounters", "-", "--range", "5"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  std::istringstream lines(outcome.out);
  std::vector<std::string> rows;
  for (std::string line; std::getline(lines, line);) rows.push_back(line);
  ASSERT_EQ(rows.size(), 4U) << outcome.out;
  EXPECT_EQ(rows[0],
            "a,b,begin_lo,begin_hi,end_lo,end_hi,closest_lo,closest_hi,distance,label_a,label_b");
  EXPECT_EQ(rows[1], "0,2,1,1,8,8,6,6,0,Ada,\"a \"\"C\"\"\"");
  EXPECT_EQ(rows[3], "0,1,3,3,7,7,5,5,3,Ada,\"Ben, jr.\"");
}

// `b` is there twice, as the points 1 and 2.
TEST_F(Encounters_output, of_tracks_have_the_ids_of_the_tracks) {
  write("t.csv",
        "t,id,x,y,radius\n0,a,0,0,1\n1,a,0,0,1\n2,a,0,0,1\n3,a,0,0,1\n4,a,0,0,1\n"
        "0,b,4,0,1\n1,b,4,0,1\n3,b,3,0,1\n4,b,3,0,1\n");
  const Outcome outcome = run({"tracks", "t.csv", "--max-gap", "1.5", "--collisions", "log",
                               "--encounters", "-", "--range", "3", "--quiet"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out,
            "a,b,begin_lo,begin_hi,end_lo,end_hi,closest_lo,closest_hi,distance,gap,label_a,"
            "label_b\n0,1,0,0,1,1,0,0,4,2,a,b\n0,2,3,3,4,4,3,3,3,1,a,b\n");
}

TEST_F(Encounters_output, is_a_contact_plan_too) {
  const Outcome outcome =
      simulate(three_points, {"--until", "8", "--contact-plan", "plan.json", "--range", "3"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto plan = nlohmann::json::parse(read("plan.json"));
  // 0 and 1 are in range for one moment only, which is no contact.
  ASSERT_EQ(plan["contacts"].size(), 4U) << plan;
  EXPECT_EQ(
      plan["contacts"][0],
      nlohmann::json(
          {{"contact", 0}, {"source", 0}, {"dest", 2}, {"startTime", 3.0}, {"endTime", 8.0}}));
  EXPECT_EQ(plan["contacts"][1]["source"], 2);
  EXPECT_EQ(plan["contacts"][1]["dest"], 0);
  EXPECT_EQ(plan["contacts"][3]["contact"], 3);
}

// In a periodic box: with a range of 2 one image of 1 follows another one without a break.
TEST_F(Encounters_output, of_images_are_one_contact_of_a_plan) {
  const Outcome outcome = simulate("x,y,vx,vy\n0,0,1,0\n5,0,0,0\n",
                                   {"--until", "6", "--periodic", "3.5,20", "--contact-plan",
                                    "plan.json", "--range", "1", "--encounters", "-"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out,
            "a,b,offset,begin_lo,begin_hi,end_lo,end_hi,closest_lo,closest_hi,distance\n"
            "0,1,-1 0,0.5,0.5,2.5,2.5,1.5,1.5,0\n0,1,0 0,4,4,6,6,5,5,0\n");
  EXPECT_EQ(nlohmann::json::parse(read("plan.json"))["contacts"].size(), 4U);
  const Outcome wider = simulate(
      "x,y,vx,vy\n0,0,1,0\n5,0,0,0\n",
      {"--until", "6", "--periodic", "3.5,20", "--contact-plan", "plan.json", "--range", "2"});
  EXPECT_EQ(wider.exit_code, 0) << wider.err;
  const auto plan = nlohmann::json::parse(read("plan.json"));
  ASSERT_EQ(plan["contacts"].size(), 2U) << plan;
  EXPECT_EQ(plan["contacts"][0]["startTime"], 0.0);
  EXPECT_EQ(plan["contacts"][1]["endTime"], 6.0);
}

TEST_F(Encounters_output, have_the_gaps_of_images_of_discs) {
  const Outcome outcome = simulate("x,y,vx,vy,radius\n9,5,1,0,0.5\n4,5,0,0,1\n",
                                   {"--until", "3", "--periodic", "10,10", "--collisions", "log",
                                    "--encounters", "-", "--range", "1"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out,
            "a,b,offset,begin_lo,begin_hi,end_lo,end_hi,closest_lo,closest_hi,distance,gap\n"
            "0,1,1 0,2.5,2.5,3,3,3,3,2,0.5\n");
}

TEST_F(Encounters_output, needs_a_range) {
  const Outcome without = simulate(three_points, {"--until", "8", "--encounters", "-"});
  EXPECT_EQ(without.exit_code, 2);
  EXPECT_NE(without.err.find("--encounters: needs --range R; expected both"), std::string::npos)
      << without.err;
  const Outcome alone = simulate(three_points, {"--until", "8", "--range", "3"});
  EXPECT_EQ(alone.exit_code, 2);
  EXPECT_NE(alone.err.find("--range: no option uses it"), std::string::npos) << alone.err;
  const Outcome negative =
      simulate(three_points, {"--until", "8", "--encounters", "-", "--range", "-1"});
  EXPECT_EQ(negative.exit_code, 2);
  EXPECT_NE(negative.err.find("-1 is negative; expected 0 or more"), std::string::npos)
      << negative.err;
}

TEST_F(Encounters_output, stand_in_the_page) {
  const Outcome outcome =
      simulate(three_points, {"--until", "8", "--html", "run.html", "--range", "5"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(read("run.html").find("\"encounters\":{\"range\":5.0,\"in_all\":3,\"count\":3,"),
            std::string::npos);
  EXPECT_EQ(simulate(three_points, {"--until", "8", "--html", "run.html"}).exit_code, 0);
  EXPECT_EQ(read("run.html").find("\"encounters\":"), std::string::npos);
}

TEST_F(Encounters_output, of_a_run_that_is_continued_begin_anew) {
  EXPECT_EQ(simulate(three_points, {"--until", "4", "--checkpoint", "half.kinetri"}).exit_code, 0);
  const Outcome outcome = run(
      {"resume", "half.kinetri", "--until", "8", "--quiet", "--encounters", "-", "--range", "5"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("\n0,1,4,4,7,7,5,5,3\n"), std::string::npos) << outcome.out;
}

// ---- real tracks ----

class Encounters_of_crowd : public Encounters_output,
                            public testing::WithParamInterface<const char*> {};

// What a program that goes frame by frame finds is within an encounter.
TEST_P(Encounters_of_crowd, have_what_each_frame_shows) {
  const std::filesystem::path data =
      std::filesystem::path(KINETRI_SHARED_DATA) / "crowd" / GetParam();
  if (!std::filesystem::exists(data)) GTEST_SKIP() << data << " is not there";
  const Outcome outcome =
      run({"tracks", data.string(), "--format", "frames", "--fps", "25", "--quiet", "--encounters",
           "encounters.csv", "--range", "2", "--ids", "ids.csv"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  struct Person {
    std::string id;
    double first, last;
  };
  struct Meeting {
    std::size_t a, b;
    double begin, end;
  };
  std::vector<Person> people;
  std::istringstream ids(read("ids.csv"));
  std::string line;
  for (std::getline(ids, line); std::getline(ids, line);) {
    std::istringstream fields(line);
    std::string point, id, first, last;
    std::getline(std::getline(std::getline(std::getline(fields, point, ','), id, ','), first, ','),
                 last, ',');
    people.push_back({id, std::stod(first), std::stod(last)});
  }
  std::vector<std::vector<Meeting>> meetings(people.size());
  std::istringstream rows(read("encounters.csv"));
  for (std::getline(rows, line); std::getline(rows, line);) {
    for (char& c : line) c = c == ',' ? ' ' : c;
    std::istringstream fields(line);
    Meeting meeting = {};
    double begin_upper = 0;
    double end_lower = 0;
    fields >> meeting.a >> meeting.b >> meeting.begin >> begin_upper >> end_lower >> meeting.end;
    ASSERT_LT(meeting.a, meeting.b);
    ASSERT_LE(meeting.begin, begin_upper);
    ASSERT_LE(begin_upper, meeting.end);
    meetings[meeting.a].push_back(meeting);
  }
  // The people of each frame.
  struct Place {
    std::size_t point;
    double x, y;
  };
  std::map<double, std::vector<Place>> frames;
  std::ifstream in(data);
  std::string id;
  for (double frame = 0, x = 0, y = 0; in >> frame >> id >> x >> y;) {
    const double time = frame / 25;
    for (std::size_t point = 0; point < people.size(); ++point) {
      const Person& person = people[point];
      const bool is_same = std::stod(person.id) == std::stod(id);
      if (is_same && person.first <= time && time <= person.last) {
        frames[time].push_back({point, x, y});
      }
    }
  }
  std::size_t near = 0;
  for (const auto& [time, places] : frames) {
    for (const Place& p : places) {
      for (const Place& q : places) {
        if (p.point >= q.point || std::hypot(p.x - q.x, p.y - q.y) > 2) continue;
        ++near;
        bool is_found = false;
        for (const Meeting& meeting : meetings[p.point]) {
          is_found =
              is_found || (meeting.b == q.point && meeting.begin <= time && time <= meeting.end);
        }
        ASSERT_TRUE(is_found) << people[p.point].id << " and " << people[q.point].id << " at "
                              << time;
      }
    }
  }
  EXPECT_GT(near, 1000U);
}

INSTANTIATE_TEST_SUITE_P(Recorded, Encounters_of_crowd,
                         testing::Values("biwi_eth.txt", "students003.txt"));

}  // namespace
}  // namespace kinetri::encounters_output_test
