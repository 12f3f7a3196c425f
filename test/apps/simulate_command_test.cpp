// SPDX-License-Identifier: GPL-3.0-or-later
//
// `kinetri simulate` from outside: outputs, exit codes, messages, and what happens to files.
#include <sys/stat.h>

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "apps/program_test.h"

namespace kinetri {
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

TEST_F(Simulate, WritesEventsEdgesAndStatistics) {
  const Outcome outcome = simulate(
      one_flip, {"--until", "3", "--events", "events.csv", "--initial-edges", "initial.csv",
                 "--edges", "edges.csv", "--stats", "stats.json", "--audit", "events"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(read("events.csv"),
            "event,kind,time,time_lo,time_hi,removed_a,removed_b,added_a,added_b,point_a,point_b\n"
            "0,flip,1,1,1,0,3,1,2,,\n");
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

TEST_F(Simulate, SummaryGoesToStandardErrorUnlessQuiet) {
  const Outcome outcome =
      simulate(one_flip, {"--until", "3", "--audit", "end", "--edges", "e.csv"});
  EXPECT_EQ(outcome.out, "");
  for (const char* part : {"4 points from t = 0 to 3", "1 at 1 instants (1 flip)", "certificates",
                           "queue", "1 run, 0 failed", "e.csv"}) {
    EXPECT_NE(outcome.err.find(part), std::string::npos) << part << " in " << outcome.err;
  }
  EXPECT_EQ(simulate(one_flip, {"--until", "3", "--quiet"}).err, "");
}

TEST_F(Simulate, EveryEventAtOrBeforeTheEndHappens) {
  const auto events = [&](const char* until) {
    return lines(simulate(one_flip, {"--until", until, "--events", "-", "--quiet"}).out) - 1;
  };
  EXPECT_EQ(events("0x1.fffffffffffffp-1"), 0U);
  EXPECT_EQ(events("1"), 1U);
}

TEST_F(Simulate, StartsJustAfterFrom) {
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

TEST_F(Simulate, FromEqualToUntilIsAnEmptyRun) {
  const Outcome outcome = simulate(one_flip, {"--from", "2", "--until", "2", "--edges", "-"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.out, "a,b\n0,1\n0,2\n1,2\n1,3\n2,3\n");
}

TEST_F(Simulate, AuditsAtTheEndOrAfterEveryInstant) {
  const auto audits = [&](const char* mode) {
    simulate(one_flip, {"--until", "3", "--audit", mode, "--stats", "s.json"});
    return nlohmann::json::parse(read("s.json"))["audits"]["run"].get<int>();
  };
  EXPECT_EQ(audits("none"), 0);
  EXPECT_EQ(audits("end"), 1);
  EXPECT_EQ(audits("events"), 3);
}

TEST_F(Simulate, FewPointsWork) {
  for (const char* rows : {"", "1,2,3,4\n", "1,2,3,4\n5,6,7,8\n", "0,0,0,0\n1,1,0,0\n2,2,0,0\n"}) {
    const Outcome outcome = simulate(std::string("x,y,vx,vy\n") + rows,
                                     {"--until", "10", "--edges", "-", "--audit", "events"});
    EXPECT_EQ(outcome.exit_code, 0) << rows << outcome.err;
    EXPECT_EQ(lines(outcome.out), std::max<std::size_t>(1, lines(rows))) << rows;
  }
}

TEST_F(Simulate, SpellingOfTheInputDoesNotMatter) {
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

TEST_F(Simulate, ReadsStandardInputAndWritesStandardOutput) {
  write("p.csv", one_flip);
  const Outcome outcome =
      run({"simulate", "-", "--until", "3", "--edges", "-"}, {.standard_input = file("p.csv")});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.out, "a,b\n0,1\n0,2\n1,2\n1,3\n2,3\n");
  EXPECT_EQ(entries(), Entries{"p.csv"});
}

TEST_F(Simulate, SameRunGivesTheSameBytes) {
  const std::string points = generated({"uniform", "--points", "60", "--seed", "3"});
  const Arguments arguments = {"--until", "5", "--events", "-", "--quiet"};
  const std::string first = simulate(points, arguments).out;
  EXPECT_GT(lines(first), 50U);
  EXPECT_EQ(simulate(points, arguments).out, first);
}

TEST_F(Simulate, ProgressIsShownWhenAskedForAndClearedAtTheEnd) {
  const std::string points = generated({"uniform", "--points", "20", "--seed", "3"});
  const Outcome shown = simulate(points, {"--until", "5", "--progress", "always"});
  EXPECT_NE(shown.err.find("triangulating 20 points ..."), std::string::npos);
  EXPECT_NE(shown.err.find("\r\x1b[Kkinetri: 20 points"), std::string::npos) << shown.err;
  EXPECT_EQ(simulate(points, {"--until", "5"}).err.find('\r'), std::string::npos);
  EXPECT_EQ(simulate(points, {"--until", "5", "--progress", "never"}).err.find('\r'),
            std::string::npos);
}

// ---- bad input ----

struct Bad_input {
  const char* text;
  const char* message;  // the beginning
};

class SimulateBadInput : public Simulate, public testing::WithParamInterface<Bad_input> {};

TEST_P(SimulateBadInput, NamesTheLineAndChangesNoFile) {
  write("events.csv", "before");
  const Outcome outcome = simulate(GetParam().text, {"--until", "1", "--events", "events.csv",
                                                     "--edges", "edges.csv", "--stats", "-"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err.rfind(GetParam().message, 0), 0U) << outcome.err;
  EXPECT_NE(outcome.err.find("expected"), std::string::npos) << outcome.err;
  EXPECT_EQ(lines(outcome.err), 1U) << outcome.err;
  EXPECT_EQ(read("events.csv"), "before");
  EXPECT_EQ(entries(), (Entries{"events.csv", "p.csv"}));
}

INSTANTIATE_TEST_SUITE_P(
    All, SimulateBadInput,
    testing::Values(
        Bad_input{"", "p.csv:1: the file is empty;"},
        Bad_input{"x,y,vx\n1,2,3\n", "p.csv:1: the column vy is missing;"},
        Bad_input{"x,y,x,vx,vy\n", "p.csv:1: the column x is named twice;"},
        Bad_input{"x,y,vx,vy,z\n", "p.csv:1: unknown column 'z';"},
        Bad_input{"x,y,vx,vy,ax\n1,2,3,4,5\n", "p.csv:1: the column ay is missing;"},
        Bad_input{"x,y,vx,vy,jx,jy\n1,2,3,4,5,6\n1,2,3,4,5,6\n",
                  "p.csv:3: the point has the same place and derivatives as the one in line 2;"},
        Bad_input{"x,y,vx,vy\n1,2,3,4\n1,2,3\n", "p.csv:3: the row has 3 fields;"},
        Bad_input{"x,y,vx,vy\n1,2,3,4,5\n", "p.csv:2: the row has 5 fields;"},
        Bad_input{"x,y,vx,vy\n1,two,3,4\n", "p.csv:2: the column y is 'two', which is not a"},
        Bad_input{"x,y,vx,vy\n1,2,nan,4\n", "p.csv:2: the column vx is 'nan', which is not finite"},
        Bad_input{"x,y,vx,vy\n1,2,3,-inf\n", "p.csv:2: the column vy is '-inf', which is not fin"},
        Bad_input{"x,y,vx,vy\n1e400,2,3,4\n", "p.csv:2: the column x is '1e400', which is out of"},
        Bad_input{"x,y,vx,vy\n1,2,3,4\n5,6,7,8\n1,2,3,4\n",
                  "p.csv:4: the point has the same place and velocity as the one in line 2;"}));

TEST_F(Simulate, BadInputPathsAreNamed) {
  const Outcome missing = run({"simulate", "missing.csv", "--until", "1"});
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_EQ(missing.err.rfind("missing.csv: cannot be opened: No such file or directory;", 0), 0U);
  const Outcome folder = run({"simulate", ".", "--until", "1"});
  EXPECT_EQ(folder.exit_code, 2);
  EXPECT_EQ(folder.err.rfind(".: is a directory;", 0), 0U);
}

TEST_F(Simulate, StandardInputIsNamedInMessages) {
  const Outcome outcome = run({"simulate", "-", "--until", "1"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.err.rfind("standard input:1: the file is empty;", 0), 0U) << outcome.err;
}

// ---- bad usage ----

struct Bad_usage {
  Arguments arguments;  // after: simulate p.csv
  const char* message;
};

class SimulateBadUsage : public Simulate, public testing::WithParamInterface<Bad_usage> {};

TEST_P(SimulateBadUsage, SaysWhatWasExpected) {
  write("edges.csv", "before");
  const Outcome outcome = simulate(one_flip, GetParam().arguments);
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err, std::string("kinetri simulate: ") + GetParam().message +
                             "\nRun 'kinetri simulate --help' for what is possible.\n");
  EXPECT_EQ(read("edges.csv"), "before");
  EXPECT_EQ(entries(), (Entries{"edges.csv", "p.csv"}));
}

INSTANTIATE_TEST_SUITE_P(
    All, SimulateBadUsage,
    testing::Values(
        Bad_usage{{}, "--until is required"},
        Bad_usage{{"--until"},
                  "--until: 1 required T missing; expected each option once, with one value"},
        Bad_usage{{"--until", "soon"},
                  "--until: 'soon' is not a number; expected a decimal or hexadecimal floating "
                  "point number such as -1.5, 2e-3 or 0x1.8p3"},
        Bad_usage{{"--until", "inf"}, "--until: 'inf' is not finite; expected a finite number"},
        Bad_usage{{"--until", "1e999"},
                  "--until: '1e999' is out of the range of binary64; expected 0, or a magnitude "
                  "from 4.9e-324 to 1.8e308"},
        Bad_usage{{"--until", "1", "--from", "nan"},
                  "--from: 'nan' is not finite; expected a finite number"},
        Bad_usage{{"--until", "1", "--from", "1.5"},
                  "--until: 1 is before the start; expected at least 1.5, which is --from"},
        Bad_usage{{"--until", "-1"},
                  "--until: -1 is before the start; expected at least 0, which is --from"},
        Bad_usage{{"--until", "1", "--audit", "all"},
                  "--audit: 'all' is unknown; expected none, end or events"},
        Bad_usage{{"--until", "1", "--progress", "loud"},
                  "--progress: 'loud' is unknown; expected auto, always or never"},
        Bad_usage{{"--until", "1", "--box", "0,0,1"},
                  "--box: '0,0,1' has 3 numbers; expected four, XMIN,YMIN,XMAX,YMAX"},
        Bad_usage{{"--until", "1", "--box", "0,0,1,2,"},
                  "--box: '0,0,1,2,' has 5 numbers; expected four, XMIN,YMIN,XMAX,YMAX"},
        Bad_usage{{"--until", "1", "--box", "0,0,1,inf"},
                  "--box: 'inf' is not finite; expected a finite number"},
        Bad_usage{{"--until", "1", "--box", "5,0,5,9"},
                  "--box: '5,0,5,9' has no area; expected XMIN,YMIN,XMAX,YMAX with XMIN < XMAX and "
                  "YMIN < YMAX"},
        Bad_usage{{"--until", "1", "--rim"},
                  "--rim: there is no box to touch; expected --box as well"},
        Bad_usage{{"--until", "1", "--box", "-5,-5,5,5", "--rim"},
                  "--rim: discs have a radius; expected a column radius in p.csv, or --radius R"},
        Bad_usage{{"--until", "1", "--box", "-5,-5,15,5", "--rim", "--radius", "5"},
                  "--rim: a disc of radius 5 does not fit the box; expected a box wider and higher "
                  "than its diameter"},
        Bad_usage{{"--until", "1", "--radius", "1"},
                  "--radius: nothing touches a disc; expected --collisions or --rim as well, or no "
                  "radius"},
        Bad_usage{{"--until", "1", "--collisions", "log", "--radius", "-0.5"},
                  "--radius: -0.5 cannot be used; expected a number greater than 0"},
        Bad_usage{{"--until", "1", "--collisions", "swap"},
                  "--collisions: discs have a radius; expected a column radius in p.csv, or "
                  "--radius R"},
        Bad_usage{{"--until", "1", "--collisions", "bump"},
                  "--collisions: 'bump' is unknown; expected none, log, swap, elastic, stop or "
                  "remove"},
        Bad_usage{{"--until", "1", "--wrong"},
                  "'--wrong' is unknown; expected only what --help lists"},
        Bad_usage{{"--until", "1", "q.csv"}, "'q.csv' is unknown; expected only what --help lists"},
        Bad_usage{{"--until", "1", "--edges", "edges.csv", "--events", "./edges.csv"},
                  "--events and --edges name the same file, edges.csv; expected different files"},
        Bad_usage{{"--until", "1", "--edges", "-", "--stats", "-"},
                  "--edges and --stats name the same file, -; expected different files"},
        Bad_usage{{"--until", "1", "--edges", "p.csv"},
                  "--edges: p.csv is the input; expected another file"}));

TEST_F(Simulate, MissingPointsIsAUsageError) {
  const Outcome outcome = run({"simulate", "--until", "1"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("POINTS is required"), std::string::npos) << outcome.err;
}

// ---- walls and discs ----

constexpr const char* two_discs =
    "x,y,vx,vy,radius\n"
    "0,0,1,0,1\n"
    "5,0,0,0,1\n"
    "0,9,0,0,1\n";

TEST_F(Simulate, LogsWallsAndCollisions) {
  const Outcome outcome =
      simulate(two_discs, {"--until", "9", "--box", "-2,-2,9,10", "--collisions", "swap",
                           "--events", "-", "--stats", "stats.json", "--audit", "events"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out,
            "event,kind,time,time_lo,time_hi,removed_a,removed_b,added_a,added_b,point_a,point_b\n"
            "0,collision,3,3,3,,,,,0,1\n"
            "1,wall,7,7,7,,,,,1,\n");
  const auto stats = nlohmann::json::parse(read("stats.json"));
  EXPECT_EQ(stats["events"]["collision"], 1);
  EXPECT_EQ(stats["events"]["wall"], 1);
  EXPECT_EQ(stats["instants"], 2);
  EXPECT_EQ(stats["contacts"]["most_at_one_time"], 1);
  EXPECT_EQ(stats["audits"]["failed"], 0);
}

TEST_F(Simulate, FollowsPointsThatAccelerate) {
  // y = 4 - t^2, and a point that rests.
  const Outcome outcome =
      simulate("x,y,vx,vy,ax,ay\n1,4,0,0,0,-2\n3,1,0,0,0,0\n",
               {"--until", "7", "--box", "0,0,4,4", "--events", "-", "--audit", "events"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out,
            "event,kind,time,time_lo,time_hi,removed_a,removed_b,added_a,added_b,point_a,point_b\n"
            "0,wall,2,2,2,,,,,0,\n"
            "1,wall,6,6,6,,,,,0,\n");
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

TEST_F(Simulate, TakesTheRadiusOfAllDiscsFromAnOption) {
  const Outcome outcome = simulate(
      "x,y,vx,vy\n0,0,1,0\n5,0,0,0\n",
      {"--until", "9", "--collisions", "log", "--radius", "0.5", "--events", "-", "--quiet"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("0,collision,4,4,4,,,,,0,1\n"), std::string::npos) << outcome.out;
}

TEST_F(Simulate, RefusesDiscsAndPlacesThatDoNotFit) {
  struct Case {
    const char* text;
    Arguments options;
    const char* message;
  };
  const std::vector<Case> cases = {
      {"x,y,vx,vy\n0,0,1,0\n5,12,0,0\n",
       {"--until", "9", "--box", "0,0,10,10"},
       "p.csv:3: the point is outside of the box at t = 0: at 5, 12 beyond the "
       "upper side at 10; expected every point inside of the box or on its sides\n"},
      {"x,y,vx,vy,radius\n1,1,1,0,1\n5,5,0,0,2\n",
       {"--until", "9", "--collisions", "elastic"},
       "p.csv:3: the radius is 2, but 1 in line 2; expected equal radii, since unequal discs can "
       "touch without being neighbors in the Delaunay triangulation, and weighted ones are not "
       "supported yet\n"},
      {"x,y,vx,vy,radius\n1,1,1,0,0\n",
       {"--until", "9", "--collisions", "elastic"},
       "p.csv:2: the radius is 0, and discs without one never touch; expected a radius greater "
       "than 0\n"},
      {"x,y,vx,vy\n0,5,1,0\n0,5,-1,0\n",
       {"--until", "1", "--box", "0,0,10,10"},
       "p.csv: at t = 0 a contact leaves points 0 and 1 in one place with one velocity; expected "
       "trajectories that stay distinct\n"}};
  for (const Case& c : cases) {
    Arguments options = c.options;
    options.insert(options.end(), {"--edges", "edges.csv"});
    const Outcome outcome = simulate(c.text, options);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.err, c.message);
    EXPECT_EQ(entries(), (Entries{"p.csv"}));
  }
}

TEST_F(Simulate, IgnoresUnequalRadiiWhereNothingTouches) {
  const Outcome outcome =
      simulate("x,y,vx,vy,radius\n1,1,1,0,1\n5,5,0,0,2\n", {"--until", "9", "--box", "0,0,10,10"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
}

// ---- outputs ----

TEST_F(Simulate, OutputsThatCannotBeWrittenAreErrorsBeforeTheRun) {
  write("edges.csv", "before");
  for (const char* bad : {"missing/events.csv", "p.csv/events.csv", ".", ""}) {
    const Outcome outcome =
        simulate(one_flip, {"--until", "1", "--edges", "edges.csv", "--events", bad});
    EXPECT_EQ(outcome.exit_code, 2) << bad;
    EXPECT_EQ(outcome.err.rfind(*bad == '\0' ? "'': " : std::string(bad) + ": ", 0), 0U)
        << outcome.err;
    EXPECT_EQ(read("edges.csv"), "before");
    EXPECT_EQ(entries(), (Entries{"edges.csv", "p.csv"}));
  }
}

// Whichever output is the one that fails: the others are not replaced before all are complete.
TEST_F(Simulate, FullDiskIsReportedAndNoFileChanges) {
  for (const char* full : {"--events", "--edges", "--stats"}) {
    Arguments arguments = {"--until", "3"};
    for (const char* option : {"--events", "--edges", "--stats"}) {
      write(option, "before");
      arguments.insert(
          arguments.end(),
          {option, option == std::string_view(full) ? "/dev/full" : "./" + std::string(option)});
    }
    const Outcome outcome = simulate(one_flip, arguments);
    EXPECT_EQ(outcome.exit_code, 2) << full;
    EXPECT_EQ(outcome.err, "/dev/full: writing failed: No space left on device\n");
    for (const char* option : {"--events", "--edges", "--stats"}) {
      EXPECT_EQ(read(option), "before") << full;
    }
    EXPECT_EQ(entries(), (Entries{"--edges", "--events", "--stats", "p.csv"}));
  }
}

TEST_F(Simulate, FullStandardOutputIsReported) {
  write("p.csv", one_flip);
  const Outcome outcome =
      run({"simulate", "p.csv", "--until", "3", "--edges", "-"}, {.standard_output = "/dev/full"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.err, "standard output: writing failed: No space left on device\n");
}

// The run stops early: the whole log would be several times as long as the stream's buffer.
TEST_F(Simulate, ClosedPipeEndsTheRun) {
  ASSERT_EQ(::mkfifo(file("pipe").c_str(), 0600), 0);
  write("p.csv", generated({"uniform", "--points", "400", "--seed", "1"}));
  std::thread reader([this] {
    std::ifstream in(file("pipe"));
    in.get();
  });
  const Outcome outcome =
      run({"simulate", "p.csv", "--until", "1000", "--events", "pipe", "--edges", "edges.csv"});
  reader.join();
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.err, "pipe: writing failed: Broken pipe\n");
  EXPECT_FALSE(exists("edges.csv"));
}

TEST_F(Simulate, ExistingOutputsAreReplaced) {
  write("edges.csv", "before, and longer than what comes after it: " + std::string(500, 'x'));
  EXPECT_EQ(simulate(one_flip, {"--until", "3", "--edges", "edges.csv"}).exit_code, 0);
  EXPECT_EQ(read("edges.csv"), "a,b\n0,1\n0,2\n1,2\n1,3\n2,3\n");
  EXPECT_EQ(entries(), (Entries{"edges.csv", "p.csv"}));
}

TEST_F(Simulate, DevNullMayBeNamedTwice) {
  EXPECT_EQ(simulate(one_flip, {"--until", "3", "--edges", "/dev/null", "--events", "/dev/null"})
                .exit_code,
            0);
}

}  // namespace
}  // namespace kinetri
