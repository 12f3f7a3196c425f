// SPDX-License-Identifier: GPL-3.0-or-later
//
// `kinetri resume` from outside: a run in two parts is the run in one.
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/program_test.h"

namespace kinetri {
namespace {

using test::Arguments;
using test::falling_balls;
using test::one_flip;
using test::Outcome;
using test::Process;

class Resume : public test::Program_test {
 protected:
  // Runs, and expects that to go well.
  void done(const Arguments& arguments) const {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  }

  // The lines of a log, without the header.
  std::string rows(const std::string& name) const {
    const std::string text = read(name);
    return text.substr(text.find('\n') + 1);
  }
};

Arguments operator+(Arguments one, const Arguments& more) {
  one.insert(one.end(), more.begin(), more.end());
  return one;
}

TEST_F(Resume, a_run_in_two_parts_is_the_run_in_one) {
  write("discs.csv",
        run({"generate", "lattice-jitter", "--points", "49", "--speed", "5", "--seed", "2"}).out);
  write("free.csv", run({"generate", "uniform", "--points", "60", "--seed", "3"}).out);
  write("grid.csv", run({"generate", "lattice", "--points", "25", "--seed", "4"}).out);
  write("falling.csv", falling_balls);
  const std::vector<Arguments> runs = {
      {"simulate", "falling.csv", "--box", "0,0,9,9", "--collisions", "elastic", "--radius", "0.5"},
      {"simulate", "discs.csv", "--box", "-5,-5,65,65", "--collisions", "elastic", "--radius", "3"},
      {"simulate", "discs.csv", "--box", "-5,-5,65,65", "--collisions", "log", "--radius", "3",
       "--rim"},
      {"simulate", "free.csv"},
      {"simulate", "grid.csv", "--from", "-2"}};
  for (const Arguments& command : runs) {
    done(command + Arguments{"--until", "6", "--events", "whole.csv", "--edges", "edges.csv"});
    done(command + Arguments{"--until", "2.3", "--events", "one.csv", "--checkpoint", "a"});
    done({"resume", "a", "--until", "2.3", "--events", "two.csv", "--checkpoint", "b"});
    done({"resume", "b", "--until", "4", "--events", "three.csv", "--checkpoint", "c", "--audit",
          "end"});
    done({"resume", "c", "--until", "6", "--events", "four.csv", "--edges", "end.csv",
          "--exact-only"});
    EXPECT_EQ(rows("two.csv"), "");
    EXPECT_NE(rows("one.csv"), "");
    EXPECT_NE(rows("four.csv"), "");
    EXPECT_EQ(rows("one.csv") + rows("three.csv") + rows("four.csv"), rows("whole.csv"));
    EXPECT_EQ(read("end.csv"), read("edges.csv"));
  }
}

TEST_F(Resume, an_interrupted_run_can_be_taken_up) {
  write("p.csv", run({"generate", "uniform", "--points", "10000", "--seed", "1"}).out);
  Process process(KINETRI_PROGRAM,
                  {"simulate", "p.csv", "--until", "1000", "--events", "one.csv", "--checkpoint",
                   "run.kinetri", "--stats", "stats.json", "--progress", "always"},
                  {.directory = directory()});
  process.wait_until(
      [&] { return process.errors_so_far().find(" events/s") != std::string::npos; });
  process.send(SIGINT);
  EXPECT_EQ(process.wait().exit_code, 130);
  const auto stats = nlohmann::json::parse(read("stats.json"));
  const std::string until = std::to_string(stats["reached"].get<double>() + 0.1);
  const Outcome outcome =
      run({"resume", "run.kinetri", "--until", until, "--events", "two.csv", "--edges", "end.csv"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("taken up after " + stats["events_total"].dump() + " events"),
            std::string::npos)
      << outcome.err;
  done({"simulate", "p.csv", "--until", until, "--events", "whole.csv", "--edges", "edges.csv"});
  EXPECT_NE(rows("two.csv"), "");
  EXPECT_EQ(rows("one.csv") + rows("two.csv"), rows("whole.csv"));
  EXPECT_EQ(read("end.csv"), read("edges.csv"));
}

TEST_F(Resume, reads_standard_input_and_counts_on) {
  write("p.csv", one_flip);
  done({"simulate", "p.csv", "--until", "2", "--checkpoint", "run.kinetri"});
  const Outcome outcome = run({"resume", "-", "--until", "3", "--stats", "stats.json"},
                              {.standard_input = file("run.kinetri")});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto stats = nlohmann::json::parse(read("stats.json"));
  EXPECT_EQ(stats["points"], 4);
  EXPECT_EQ(stats["from"], 2);
  EXPECT_EQ(stats["until"], 3);
  EXPECT_EQ(stats["events_total"], 1);
}

}  // namespace
}  // namespace kinetri
