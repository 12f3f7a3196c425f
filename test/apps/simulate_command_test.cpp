// SPDX-License-Identifier: GPL-3.0-or-later
//
// `kinetri simulate` from outside: outputs, exit codes, messages, and what happens to files.
#include <sys/stat.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "apps/program_test.h"

namespace kinetri::simulate_command_test {
namespace {

using test::Arguments;
using test::Entries;
using test::one_flip;
using test::Outcome;

class Simulate : public test::Program_test {
 protected:
  // Runs on the file p.csv with this text.
  Outcome simulate(const std::string& text, Arguments more = {"--until", "10"}) const {
    write("p.csv", text);
    more.insert(more.begin(), {"simulate", "p.csv"});
    return run(more);
  }

  std::string generated(const Arguments& more) const {
    Arguments arguments = {"generate"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments).out;
  }
};

std::size_t lines(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

// ---- what a run gives ----

TEST_F(Simulate, writes_events_edges_and_statistics) {
  const Outcome outcome = simulate(
      one_flip, {"--until", "3", "--events", "events.csv", "--initial-edges", "initial.csv",
                 "--edges", "edges.csv", "--stats", "stats.json", "--audit", "events"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(read("events.csv"),
            "event,kind,time,time_lo,time_hi,removed_a,removed_b,added_a,added_b,point_a,point_b,"
            "instant\n"
            "0,flip,1,1,1,0,3,1,2,,,0\n");
  EXPECT_EQ(read("initial.csv"), "a,b\n0,1\n0,2\n0,3\n1,3\n2,3\n");
  EXPECT_EQ(read("edges.csv"), "a,b\n0,1\n0,2\n1,2\n1,3\n2,3\n");
  const auto stats = nlohmann::json::parse(read("stats.json"));
  EXPECT_EQ(stats["points"], 4);
  EXPECT_EQ(stats["from"], 0);
  EXPECT_EQ(stats["until"], 3);
  EXPECT_EQ(stats["reached"], 3);
  EXPECT_EQ(stats["interrupted"], false);
  EXPECT_EQ(stats["events"]["flip"], 1);
  EXPECT_EQ(stats["events_total"], 1);
  EXPECT_EQ(stats["audits"]["run"], 3);
  EXPECT_EQ(stats["audits"]["failed"], 0);
  EXPECT_GT(stats["certificates"]["created"], 0);
  EXPECT_GT(stats["queue"]["pushed"], 0);
  EXPECT_GT(stats["peak_rss_bytes"], 1'000'000);
  for (const char* stage : {"read", "build", "initialize", "run", "audit"}) {
    EXPECT_GT(stats["seconds"][stage], 0) << stage;
  }
}

TEST_F(Simulate, summary_goes_to_standard_error_unless_quiet) {
  const Outcome outcome =
      simulate(one_flip, {"--until", "3", "--audit", "end", "--edges", "e.csv"});
  EXPECT_EQ(outcome.out, "");
  for (const char* part : {"4 points from t = 0 to 3", "1 at 1 instant (1 flip)", "certificates",
                           "queue", "1 run, 0 failed", "e.csv"}) {
    EXPECT_NE(outcome.err.find(part), std::string::npos) << part << " in " << outcome.err;
  }
  EXPECT_EQ(simulate(one_flip, {"--until", "3", "--quiet"}).err, "");
}

TEST_F(Simulate, points_that_coincide_are_hidden_or_refused) {
  const std::string twice = std::string(one_flip) + "4,0,0,0\n3,3,1,1\n";
  const Outcome done =
      simulate(twice, {"--until", "3", "--events", "e.csv", "--edges", "-", "--audit", "events"});
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_EQ(done.out, simulate(one_flip, {"--until", "3", "--edges", "-"}).out);
  EXPECT_NE(done.err.find("coincident   2 points at the start, the first is 4, with 1\n"),
            std::string::npos)
      << done.err;
  // At the corner of the box the points 3 and 5 turn one after the other.
  const Outcome turned = simulate(
      twice, {"--until", "3", "--box", "0,0,5,5", "--events", "-", "--quiet", "--audit", "events"});
  EXPECT_EQ(turned.exit_code, 0) << turned.err;
  EXPECT_NE(turned.out.find(",reveal,2,2,2,,,,,5,3,"), std::string::npos) << turned.out;
  EXPECT_NE(turned.out.find(",hide,2,2,2,,,,,5,3,"), std::string::npos) << turned.out;
  const Outcome refused = simulate(twice, {"--until", "3", "--coincident", "refuse"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find(":6: the point has the same place and velocity as the one in line 3"),
            std::string::npos)
      << refused.err;
}

TEST_F(Simulate, every_event_at_or_before_the_end_happens) {
  const auto events = [&](const char* until) {
    return lines(simulate(one_flip, {"--until", until, "--events", "-", "--quiet"}).out) - 1;
  };
  EXPECT_EQ(events("0x1.fffffffffffffp-1"), 0U);
  EXPECT_EQ(events("1"), 1U);
}

TEST_F(Simulate, starts_just_after_from) {
  const Outcome after = simulate(one_flip, {"--from", "1", "--until", "2", "--events", "events.csv",
                                            "--initial-edges", "initial.csv", "--audit", "events"});
  EXPECT_EQ(after.exit_code, 0);
  EXPECT_EQ(lines(read("events.csv")), 1U);
  EXPECT_NE(read("initial.csv").find("1,2"), std::string::npos);
  const Outcome before =
      simulate(one_flip, {"--from", "-8", "--until", "-0x1p-3", "--initial-edges", "-", "--quiet"});
  EXPECT_EQ(before.exit_code, 0);
  EXPECT_NE(before.out.find("1,2"), std::string::npos);
}

TEST_F(Simulate, from_equal_to_until_is_an_empty_run) {
  const Outcome outcome = simulate(one_flip, {"--from", "2", "--until", "2", "--edges", "-"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.out, "a,b\n0,1\n0,2\n1,2\n1,3\n2,3\n");
}

TEST_F(Simulate, audits_at_the_end_or_after_every_instant) {
  const auto audits = [&](const char* mode) {
    simulate(one_flip, {"--until", "3", "--audit", mode, "--stats", "s.json"});
    return nlohmann::json::parse(read("s.json"))["audits"]["run"].get<int>();
  };
  EXPECT_EQ(audits("none"), 0);
  EXPECT_EQ(audits("end"), 1);
  EXPECT_EQ(audits("events"), 3);
}

TEST_F(Simulate, few_points_work) {
  for (const char* rows : {"", "1,2,3,4\n", "1,2,3,4\n5,6,7,8\n", "0,0,0,0\n1,1,0,0\n2,2,0,0\n"}) {
    const Outcome outcome = simulate(std::string("x,y,vx,vy\n") + rows,
                                     {"--until", "10", "--edges", "-", "--audit", "events"});
    EXPECT_EQ(outcome.exit_code, 0) << rows << outcome.err;
    EXPECT_EQ(lines(outcome.out), std::max<std::size_t>(1, lines(rows))) << rows;
  }
}

TEST_F(Simulate, spelling_of_the_input_does_not_matter) {
  const auto events = [&](const std::string& text) {
    return simulate(text, {"--until", "10", "--events", "-", "--quiet"}).out;
  };
  const std::string expected = events(one_flip);
  EXPECT_EQ(lines(expected), 2U);
  EXPECT_EQ(events("vy,vx,y,x\n0,0,0,0\n0,0,0,4\n0,0,4,0\n1,1,3,3\n"), expected);
  EXPECT_EQ(events("\xEF\xBB\xBFx,y,vx,vy\r\n0,0,0,0\r\n4,0,0,0\r\n0,4,0,0\r\n3,3,1,1"), expected);
  EXPECT_EQ(events("# c\nx, y, vx, vy\n0x0,0,0,0\n\n0x1p2,0,0,0\n0,+4.0,-0,0\n 3 , 3e0 ,1,0x.8p1"),
            expected);
  EXPECT_EQ(events("x,y,vx,vy,radius\n0,0,0,0,1\n4,0,0,0,1\n0,4,0,0,1\n3,3,1,1,1\n"), expected);
}

TEST_F(Simulate, reads_standard_input_and_writes_standard_output) {
  write("p.csv", one_flip);
  const Outcome outcome =
      run({"simulate", "-", "--until", "3", "--edges", "-"}, {.standard_input = file("p.csv")});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.out, "a,b\n0,1\n0,2\n1,2\n1,3\n2,3\n");
  EXPECT_EQ(entries(), Entries{"p.csv"});
}

TEST_F(Simulate, same_run_gives_the_same_bytes) {
  const std::string points = generated({"uniform", "--points", "60", "--seed", "3"});
  const Arguments arguments = {"--until", "5", "--events", "-", "--quiet"};
  const std::string first = simulate(points, arguments).out;
  EXPECT_GT(lines(first), 50U);
  EXPECT_EQ(simulate(points, arguments).out, first);
}

TEST_F(Simulate, progress_is_shown_when_asked_for_and_cleared_at_the_end) {
  const std::string points = generated({"uniform", "--points", "20", "--seed", "3"});
  const Outcome shown = simulate(points, {"--until", "5", "--progress", "always"});
  EXPECT_NE(shown.err.find("triangulating 20 points ..."), std::string::npos);
  EXPECT_NE(shown.err.find("\r\x1b[Kkinetri: 20 points"), std::string::npos) << shown.err;
  EXPECT_EQ(simulate(points, {"--until", "5"}).err.find('\r'), std::string::npos);
  EXPECT_EQ(simulate(points, {"--until", "5", "--progress", "never"}).err.find('\r'),
            std::string::npos);
}

// ---- walls and discs ----

constexpr const char* two_discs =
    "x,y,vx,vy,radius\n"
    "0,0,1,0,1\n"
    "5,0,0,0,1\n"
    "0,9,0,0,1\n";

TEST_F(Simulate, logs_walls_and_collisions) {
  const Outcome outcome =
      simulate(two_discs, {"--until", "9", "--box", "-2,-2,9,10", "--collisions", "swap",
                           "--events", "-", "--stats", "stats.json", "--audit", "events"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out,
            "event,kind,time,time_lo,time_hi,removed_a,removed_b,added_a,added_b,point_a,point_b,"
            "instant\n"
            "0,collision,3,3,3,,,,,0,1,0\n"
            "1,wall,7,7,7,,,,,1,,1\n");
  const auto stats = nlohmann::json::parse(read("stats.json"));
  EXPECT_EQ(stats["events"]["collision"], 1);
  EXPECT_EQ(stats["events"]["wall"], 1);
  EXPECT_EQ(stats["instants"], 2);
  EXPECT_EQ(stats["contacts"]["most_at_one_time"], 1);
  EXPECT_EQ(stats["audits"]["failed"], 0);
}

TEST_F(Simulate, follows_points_that_accelerate) {
  // y = 4 - t^2, and a point that rests.
  const Outcome outcome =
      simulate("x,y,vx,vy,ax,ay\n1,4,0,0,0,-2\n3,1,0,0,0,0\n",
               {"--until", "7", "--box", "0,0,4,4", "--events", "-", "--audit", "events"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out,
            "event,kind,time,time_lo,time_hi,removed_a,removed_b,added_a,added_b,point_a,point_b,"
            "instant\n"
            "0,wall,2,2,2,,,,,0,,0\n"
            "1,wall,6,6,6,,,,,0,,1\n");
  const Outcome balls =
      simulate(test::falling_balls,
               {"--until", "5", "--box", "0,0,9,9", "--collisions", "elastic", "--radius", "0.5",
                "--stats", "stats.json", "--audit", "events", "--edges", "filtered.csv"});
  EXPECT_EQ(balls.exit_code, 0) << balls.err;
  const auto stats = nlohmann::json::parse(read("stats.json"));
  EXPECT_EQ(stats["audits"]["failed"], 0);
  EXPECT_GT(stats["events"]["collision"], 5);
  simulate(test::falling_balls, {"--until", "5", "--box", "0,0,9,9", "--collisions", "elastic",
                                 "--radius", "0.5", "--exact-only", "--edges", "exact.csv"});
  EXPECT_EQ(read("filtered.csv"), read("exact.csv"));
}

TEST_F(Simulate, takes_the_radius_of_all_discs_from_an_option) {
  const Outcome outcome = simulate(
      "x,y,vx,vy\n0,0,1,0\n5,0,0,0\n",
      {"--until", "9", "--collisions", "log", "--radius", "0.5", "--events", "-", "--quiet"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("0,collision,4,4,4,,,,,0,1,0\n"), std::string::npos) << outcome.out;
}

TEST_F(Simulate, ignores_unequal_radii_where_nothing_touches) {
  const Outcome outcome =
      simulate("x,y,vx,vy,radius\n1,1,1,0,1\n5,5,0,0,2\n", {"--until", "9", "--box", "0,0,10,10"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
}

// ---- outputs ----

// The run stops early: the whole log would be several times as long as the stream's buffer.
TEST_F(Simulate, closed_pipe_ends_the_run) {
  ASSERT_EQ(::mkfifo(file("pipe").c_str(), 0600), 0);
  write("p.csv", generated({"uniform", "--points", "400", "--seed", "1"}));
  std::thread reader([this] {
    std::ifstream in(file("pipe"));
    in.get();
  });
  // Not by `run`, which runs a command again without --verify: the pipe is read once.
  const Arguments arguments = {"simulate", "p.csv", "--until", "1000",
                               "--events", "pipe",  "--edges", "edges.csv"};
  const Outcome outcome =
      test::Process(KINETRI_PROGRAM, arguments, {.directory = directory()}).wait();
  reader.join();
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.err,
            "pipe: writing failed: Broken pipe; expected a place that takes all of it\n");
  EXPECT_FALSE(exists("edges.csv"));
}

TEST_F(Simulate, existing_outputs_are_replaced) {
  write("edges.csv", "before, and longer than what comes after it: " + std::string(500, 'x'));
  EXPECT_EQ(simulate(one_flip, {"--until", "3", "--edges", "edges.csv"}).exit_code, 0);
  EXPECT_EQ(read("edges.csv"), "a,b\n0,1\n0,2\n1,2\n1,3\n2,3\n");
  EXPECT_EQ(entries(), (Entries{"edges.csv", "p.csv"}));
}

TEST_F(Simulate, dev_null_may_be_named_twice) {
  EXPECT_EQ(simulate(one_flip, {"--until", "3", "--edges", "/dev/null", "--events", "/dev/null"})
                .exit_code,
            0);
}

}  // namespace
}  // namespace kinetri::simulate_command_test
