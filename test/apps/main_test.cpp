// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the program does around its commands: help, version, exit codes of failures, interruption.
#include <sys/stat.h>

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/program_test.h"
#include "kinetri/version.h"

namespace kinetri {
namespace {

using test::Arguments;
using test::Entries;
using test::one_flip;
using test::Outcome;
using test::Process;

class Program : public test::Program_test {};

TEST_F(Program, PrintsItsVersion) {
  const Outcome outcome = run({"--version"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.out, std::string("kinetri ") + version + "\n");
}

TEST_F(Program, EveryHelpHasAnExample) {
  std::vector<Arguments> commands = {{},         {"simulate"}, {"resume"},     {"generate"},
                                     {"tracks"}, {"wave"},     {"experiment"}, {"completion"},
                                     {"manual"}};
  for (const char* scenario :
       {"uniform", "gaussian", "constant-speed", "one-mover", "lattice", "lattice-jitter"}) {
    commands.push_back({"generate", scenario});
  }
  for (Arguments command : commands) {
    std::string name = "kinetri";
    for (const std::string& word : command) name += " " + word;
    command.emplace_back("--help");
    const Outcome outcome = run(command);
    EXPECT_EQ(outcome.exit_code, 0) << name;
    EXPECT_EQ(outcome.err, "") << name;
    EXPECT_NE(outcome.out.find("Example:\n  " + name), std::string::npos) << outcome.out;
    EXPECT_EQ(outcome.out.find("\n\n\n"), std::string::npos) << outcome.out;
  }
}

// ---- failures inside, which a right library does not have: faults.cpp makes them ----

class FaultyProgram : public test::Program_test {
 protected:
  // A run whose audit does what `fault` says, on top of an old file of edges.
  Outcome run_with(const std::string& fault) const {
    write("p.csv", one_flip);
    write("edges.csv", "before");
    return Process(KINETRI_FAULTY_PROGRAM,
                   {"simulate", "p.csv", "--until", "3", "--audit", "events", "--edges",
                    "edges.csv", "--stats", "stats.json"},
                   {.directory = directory(), .environment = {"KINETRI_TEST_FAULT=" + fault}})
        .wait();
  }
};

TEST_F(FaultyProgram, FailedAuditIsReportedWithItsFindingsAndOutputsAreWritten) {
  const Outcome outcome = run_with("audit");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.err.find("kinetri: audit just after t = 0: the edge 1-2 is wrong\n"),
            std::string::npos)
      << outcome.err;
  EXPECT_NE(outcome.err.find("kinetri: audit just after t = 3: the edge 1-2 is wrong\n"),
            std::string::npos);
  EXPECT_NE(outcome.err.find("3 run, 3 failed"), std::string::npos);
  EXPECT_NE(read("edges.csv"), "before");
  EXPECT_EQ(nlohmann::json::parse(read("stats.json"))["audits"]["failed"], 3);
}

// ---- interruption ----

class Interruption : public test::Program_test {
 protected:
  // A run that takes far longer than the test.
  const Arguments long_run = {"simulate", "p.csv",      "--until",    "1000",
                              "--events", "events.csv", "--edges",    "edges.csv",
                              "--stats",  "stats.json", "--progress", "always"};

  void write_many_points() const {
    write("p.csv", run({"generate", "uniform", "--points", "1000", "--seed", "1"}).out);
  }

  static bool is_running(const Process& process) {
    return process.errors_so_far().find(" events/s") != std::string::npos;
  }
};

TEST_F(Interruption, StopsAtTheNextEventAndWritesWhatItHas) {
  write_many_points();
  for (const int signal : {SIGINT, SIGTERM}) {
    Process process(KINETRI_PROGRAM, long_run, {.directory = directory()});
    process.wait_until([&] { return is_running(process); });
    process.send(signal);
    const Outcome outcome = process.wait();
    EXPECT_EQ(outcome.exit_code, 130);
    EXPECT_NE(outcome.err.find(", interrupted\n"), std::string::npos) << outcome.err;
    EXPECT_EQ(entries(), (Entries{"edges.csv", "events.csv", "p.csv", "stats.json"}));
    const auto stats = nlohmann::json::parse(read("stats.json"));
    EXPECT_EQ(stats["interrupted"], true);
    EXPECT_LT(stats["reached"], 1000);
    const std::string events = read("events.csv");
    const auto rows = static_cast<std::size_t>(std::count(events.begin(), events.end(), '\n')) - 1;
    EXPECT_EQ(stats["events_total"], rows);
    EXPECT_GT(rows, 0U);
  }
}

TEST_F(Interruption, BeforeTheRunEndsAtOnceAndLeavesNothing) {
  ASSERT_EQ(::mkfifo(file("p.csv").c_str(), 0600), 0);
  write("edges.csv", "before");
  Process process(KINETRI_PROGRAM, long_run, {.directory = directory()});
  // It has opened its outputs and waits for points.
  process.wait_until([&] { return entries().size() == 5; });
  process.send(SIGINT);
  const Outcome outcome = process.wait();
  EXPECT_EQ(outcome.exit_code, 130);
  EXPECT_NE(outcome.err.find("kinetri: interrupted, nothing written\n"), std::string::npos);
  EXPECT_EQ(entries(), (Entries{"edges.csv", "p.csv"}));
  EXPECT_EQ(read("edges.csv"), "before");
}

// An audit of so many points takes longer than the test.
TEST_F(Interruption, SecondSignalEndsAtOnceAndLeavesNothing) {
  write_many_points();
  Arguments arguments = long_run;
  arguments.insert(arguments.end(), {"--audit", "events"});
  Process process(KINETRI_PROGRAM, arguments, {.directory = directory()});
  process.wait_until(
      [&] { return process.errors_so_far().find("running ...") != std::string::npos; });
  process.send(SIGINT);
  process.send(SIGTERM);
  const Outcome outcome = process.wait();
  EXPECT_EQ(outcome.exit_code, 130);
  EXPECT_EQ(entries(), Entries{"p.csv"});
}

}  // namespace
}  // namespace kinetri
