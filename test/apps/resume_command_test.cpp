// SPDX-License-Identifier: GPL-3.0-or-later
//
// `kinetri resume` from outside: a run in two parts is the run in one, and what belongs to the
// first part must be as that has left it.
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/program_test.h"

namespace kinetri::resume_command_test {
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

// On a lattice, apart from each other, in a box of side 40.
std::string discs_of_many_sizes() {
  std::string result = "x,y,vx,vy,radius\n";
  for (int i = 0; i < 36; ++i) {
    for (const int number : {5 + 6 * (i % 6), 5 + 6 * (i / 6), (i * 7) % 9 - 4, (i * 5) % 9 - 4}) {
      result += std::to_string(number) + ',';
    }
    result += (i % 5 == 0 ? "2" : i % 3 == 0 ? "0.125" : "1") + std::string("\n");
  }
  return result;
}

Arguments operator+(Arguments one, const Arguments& more) {
  one.insert(one.end(), more.begin(), more.end());
  return one;
}

TEST_F(Resume, a_run_in_two_parts_is_the_run_in_one) {
  write("discs.csv",
        run({"generate", "lattice-jitter", "--points", "49", "--speed", "5", "--seed", "2"}).out);
  write("free.csv", run({"generate", "uniform", "--points", "60", "--seed", "3"}).out);
  write("grid.csv", run({"generate", "lattice", "--points", "25", "--seed", "4"}).out);
  write("twice.csv", read("free.csv") + rows("free.csv"));  // each hides another, until they turn
  write("falling.csv", falling_balls);
  write("sizes.csv", discs_of_many_sizes());
  const std::vector<Arguments> runs = {
      {"simulate", "falling.csv", "--box", "0,0,9,9", "--collisions", "elastic", "--radius", "0.5"},
      {"simulate", "discs.csv", "--box", "-5,-5,65,65", "--collisions", "elastic", "--radius", "3"},
      {"simulate", "discs.csv", "--box", "-5,-5,65,65", "--collisions", "log", "--radius", "3",
       "--rim"},
      {"simulate", "sizes.csv", "--box", "0,0,40,40", "--collisions", "elastic", "--rim", "--mass",
       "area", "--growth", "0.0625"},
      {"simulate", "sizes.csv", "--regular", "--growth", "1.5"},
      {"simulate", "free.csv"},
      {"simulate", "twice.csv", "--box", "-1,-1,101,101", "--collisions", "elastic", "--radius",
       "0.5"},
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

// ---- the files that belong to a checkpoint ----

class Resume_logs : public Resume {
 protected:
  // A run of one flip in two parts: this is the first one, with all outputs that a checkpoint
  // notes.
  void run_first_part(const std::string& points = one_flip) const {
    write("p.csv", points);
    done({"simulate", "p.csv", "--until", "2", "--events", "first.csv", "--initial-edges", "i.csv",
          "--edges", "d.csv", "--motions", "m.csv", "--checkpoint", "run.kinetri", "--stats",
          "s.json", "--html", "h.html", "--quiet"});
  }

  Outcome resume(Arguments more) const {
    more.insert(more.begin(), {"resume", "run.kinetri", "--until", "3"});
    return run(more);
  }
};

TEST_F(Resume_logs, continued_as_they_were_are_accepted) {
  run_first_part();
  write("s.json", "others do not matter");
  write("h.html", "others do not matter");
  const Outcome outcome = resume({"--events", "second.csv", "--quiet"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
}

TEST_F(Resume_logs, of_another_run_are_refused) {
  for (const std::string name : {"first.csv", "i.csv", "d.csv", "m.csv"}) {
    SCOPED_TRACE(name);
    run_first_part();
    // As where a second run was killed after its events had taken their place.
    const std::string before = read(name);
    write(name, before.substr(0, before.size() - 2) + "9\n");
    const Outcome outcome =
        resume({name == "m.csv" ? "--motions" : "--events", "second.csv", "--stats", "new.json"});
    EXPECT_EQ(outcome.exit_code, 2);
    const std::string option = name == "first.csv" ? "events"
                               : name == "i.csv"   ? "initial-edges"
                               : name == "m.csv"   ? "motions"
                                                   : "edges";
    EXPECT_EQ(
        outcome.err.rfind(name + ": is not what --" + option + " wrote for run.kinetri: it has " +
                              std::to_string(before.size()) + " bytes and the checksum ",
                          0),
        0U)
        << outcome.err;
    EXPECT_FALSE(exists("second.csv"));
    EXPECT_FALSE(exists("new.json"));
  }
}

TEST_F(Resume_logs, that_are_not_continued_are_not_read) {
  run_first_part();
  write("first.csv", "of another run");
  EXPECT_EQ(resume({"--edges", "end.csv", "--quiet"}).err, "");
  // The run replaces them.
  write("d.csv", "of another run");
  EXPECT_EQ(resume({"--events", "./first.csv", "--edges", "d.csv", "--quiet"}).err, "");
  EXPECT_EQ(rows("first.csv"), "");
}

TEST_F(Resume_logs, that_are_gone_are_named_in_the_summary) {
  run_first_part();
  std::filesystem::remove(file("first.csv"));
  const Outcome outcome = resume({"--events", "second.csv"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.err.find("  input        first.csv, which --events wrote, is not there to be "
                             "compared\n"),
            std::string::npos)
      << outcome.err;
  EXPECT_EQ(outcome.err.find("d.csv, which"), std::string::npos);
}

TEST_F(Resume_logs, are_found_from_another_directory) {
  run_first_part();
  std::filesystem::create_directory(file("moved"));
  for (const char* name : {"first.csv", "run.kinetri", "i.csv", "d.csv", "m.csv"}) {
    std::filesystem::rename(file(name), file(std::string("moved/") + name));
  }
  const Arguments resume = {"resume", "moved/run.kinetri", "--until", "3", "--events", "-"};
  const Outcome good = run(resume);
  EXPECT_EQ(good.exit_code, 0);
  EXPECT_EQ(good.err.find("is not there"), std::string::npos) << good.err;
  write("moved/first.csv", "of another run");
  const Outcome bad = run(resume);
  EXPECT_EQ(bad.exit_code, 2);
  EXPECT_EQ(bad.err.rfind("moved/first.csv: is not what --events wrote for moved/run.kinetri", 0),
            0U);
}

TEST_F(Resume_logs, of_standard_output_are_not_noted) {
  write("p.csv", one_flip);
  done({"simulate", "p.csv", "--until", "2", "--events", "-", "--edges", "/dev/null",
        "--checkpoint", "run.kinetri"});
  EXPECT_NE(read("run.kinetri").find("\"logs\":[],\n"), std::string::npos);
}

// A checkpoint notes the files of its own part.
TEST_F(Resume_logs, of_each_part_belong_to_its_checkpoint) {
  run_first_part();
  EXPECT_EQ(resume({"--events", "second.csv", "--checkpoint", "second.kinetri"}).exit_code, 0);
  write("first.csv", "of another run");
  done({"resume", "second.kinetri", "--until", "4", "--events", "third.csv"});
  write("second.csv", "of another run");
  EXPECT_EQ(run({"resume", "second.kinetri", "--until", "4", "--events", "third.csv"}).exit_code,
            2);
}

}  // namespace
}  // namespace kinetri::resume_command_test
