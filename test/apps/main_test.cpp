// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the program does around its commands: help, version, exit codes of failures, interruption.
#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "apps/program_test.h"
#include "kinetri/version.h"

namespace kinetri::main_test {
namespace {

using test::Arguments;
using test::Entries;
using test::one_flip;
using test::Outcome;
using test::Process;

class Program : public test::Program_test {};

TEST_F(Program, prints_its_version) {
  const Outcome outcome = run({"--version"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.out, std::string("kinetri ") + version + "\n");
}

TEST_F(Program, help_is_shown_in_three_ways) {
  const std::string help = run({"generate", "uniform", "--help"}).out;
  EXPECT_NE(help.find("Usage: kinetri generate uniform --points N [OPTIONS]\n"), std::string::npos)
      << help;
  EXPECT_EQ(run({"generate", "uniform", "-h"}).out, help);
  EXPECT_EQ(run({"help", "generate", "uniform"}).out, help);
  EXPECT_EQ(run({"help"}).out, run({"--help"}).out);
  EXPECT_NE(run({"help"}).out.find("\n  tracks "), std::string::npos);
  EXPECT_NE(run({"help", "--help"}).out.find("Usage: kinetri help [COMMAND]"), std::string::npos);
}

TEST_F(Program, lines_of_help_fit_a_terminal) {
  for (const char* command : {"simulate", "tracks", "wave", "experiment", "completion"}) {
    std::istringstream help(run({command, "--help"}).out);
    for (std::string line; std::getline(help, line);) {
      // Examples and names of types are not broken.
      if (line.starts_with("  kinetri") || line.starts_with("  -")) continue;
      EXPECT_LE(line.size(), 80U) << line;
    }
  }
}

TEST_F(Program, unknown_word_is_named_before_what_is_missing) {
  const auto problem = [&](const Arguments& arguments) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.out, "");
    return outcome.err.substr(0, outcome.err.find('\n'));
  };
  EXPECT_EQ(problem({"simulate", "p.csv", "--util", "5"}),
            "kinetri simulate: '--util' is unknown; did you mean --until?");
  EXPECT_EQ(problem({"simulate", "--util", "5", "p.csv"}),
            "kinetri simulate: '--util' is unknown; did you mean --until?");
  EXPECT_EQ(problem({"simulate", "p.csv", "--until", "5", "--even", "e.csv"}),
            "kinetri simulate: '--even' is unknown; did you mean --events?");
  EXPECT_EQ(problem({"simulate", "p.csv", "--nonsense"}),
            "kinetri simulate: '--nonsense' is unknown; expected only what --help lists");
  EXPECT_EQ(problem({"simulte", "p.csv"}), "kinetri: 'simulte' is unknown; did you mean simulate?");
  EXPECT_EQ(problem({"help", "simulte"}),
            "kinetri help: 'simulte' is unknown; did you mean simulate?");
}

TEST_F(Program, short_options_are_those_of_the_long_ones) {
  EXPECT_EQ(run({"generate", "uniform", "--points", "20", "-o", "p.csv"}).exit_code, 0);
  const Outcome outcome = run({"simulate", "p.csv", "--until", "2", "-q", "-o", "events.csv"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(read("events.csv"),
            run({"simulate", "p.csv", "--until", "2", "--quiet", "--events", "-"}).out);
}

TEST_F(Program, summary_counts_in_the_singular_and_in_the_plural) {
  write("one.csv", "x,y,vx,vy\n0,0,0,0\n");
  EXPECT_EQ(run({"simulate", "one.csv", "--until", "1"}).err.rfind("kinetri: 1 point from t", 0),
            0U);
  write("p.csv", one_flip);
  const std::string none = run({"simulate", "p.csv", "--until", "0.5"}).err;
  EXPECT_NE(none.find("\n  events       none\n"), std::string::npos) << none;
  const std::string one = run({"simulate", "p.csv", "--until", "3"}).err;
  EXPECT_NE(one.find("\n  events       1 at 1 instant (1 flip)\n"), std::string::npos) << one;
}

TEST_F(Program, every_help_has_an_example) {
  std::vector<Arguments> commands = {{},         {"simulate"}, {"resume"},     {"generate"},
                                     {"tracks"}, {"wave"},     {"experiment"}, {"completion"},
                                     {"manual"}, {"help"}};
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

class Faulty_program : public test::Program_test {
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

TEST_F(Faulty_program, failed_audit_is_reported_with_its_findings_and_outputs_are_written) {
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
    write("p.csv", run({"generate", "uniform", "--points", "10000", "--seed", "1"}).out);
  }

  static bool is_running(const Process& process) {
    return process.errors_so_far().find(" events/s") != std::string::npos;
  }
};

TEST_F(Interruption, stops_at_the_next_event_and_writes_what_it_has) {
  write_many_points();
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
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

// What `kinetri resume` needs is there, and no temporary.
TEST_F(Interruption, by_a_closed_terminal_leaves_a_checkpoint) {
  write_many_points();
  Arguments arguments = long_run;
  arguments.insert(arguments.end(), {"--checkpoint", "run.kinetri"});
  Process process(KINETRI_PROGRAM, arguments, {.directory = directory()});
  process.wait_until([&] { return is_running(process); });
  process.send(SIGHUP);
  EXPECT_EQ(process.wait().exit_code, 130);
  EXPECT_EQ(entries(), (Entries{"edges.csv", "events.csv", "p.csv", "run.kinetri", "stats.json"}));
  const double reached = nlohmann::json::parse(read("stats.json"))["reached"];
  const Outcome resumed = run({"resume", "run.kinetri", "--until", std::to_string(reached + 0.01),
                               "--stats", "resumed.json"});
  EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_GT(nlohmann::json::parse(read("resumed.json"))["events_total"],
            nlohmann::json::parse(read("stats.json"))["events_total"]);
}

TEST_F(Interruption, ignores_a_closed_terminal_if_it_is_started_so) {
  write_many_points();
  Process process(KINETRI_PROGRAM, long_run, {.directory = directory(), .ignores_hangup = true});
  process.wait_until([&] { return is_running(process); });
  const std::string before = process.errors_so_far();
  process.send(SIGHUP);
  process.wait_until([&] { return process.errors_so_far() != before; });
  process.send(SIGINT);
  const Outcome outcome = process.wait();
  EXPECT_EQ(outcome.exit_code, 130);
  EXPECT_NE(outcome.err.find(", interrupted\n"), std::string::npos) << outcome.err;
}

TEST_F(Interruption, by_the_greatest_number_of_events_writes_what_there_is) {
  // Back and forth between two walls, twice in a unit of time.
  write("p.csv", "x,y,vx,vy\n1,1,2,0\n");
  const Arguments arguments = {"simulate", "p.csv",    "--until", "1e9",     "--box",
                               "0,0,1,2",  "--events", "e.csv",   "--stats", "stats.json"};
  Arguments limited = arguments;
  limited.insert(limited.end(), {"--max-events", "6"});
  const Outcome outcome = run(limited);
  EXPECT_EQ(outcome.exit_code, 130);
  EXPECT_NE(
      outcome.err.find("kinetri: more than 6 events, and the run ends at t = 3 instead of "
                       "1000000000; results up to then are written; expected fewer events, or a "
                       "greater --max-events\n"),
      std::string::npos)
      << outcome.err;
  EXPECT_EQ(nlohmann::json::parse(read("stats.json"))["events_total"], 7);
}

TEST_F(Interruption, before_the_run_ends_at_once_and_leaves_nothing) {
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

TEST_F(Interruption, within_a_step_that_does_not_end_ends_the_run_and_leaves_nothing) {
  write("p.csv", one_flip);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    Arguments arguments = long_run;
    arguments.insert(arguments.end(), {"--audit", "events"});
    Process process(KINETRI_FAULTY_PROGRAM, arguments,
                    {.directory = directory(), .environment = {"KINETRI_TEST_FAULT=endless"}});
    process.wait_until(
        [&] { return process.errors_so_far().find("running ...") != std::string::npos; });
    process.send(signal);
    const Outcome outcome = process.wait();
    EXPECT_EQ(outcome.exit_code, 130);
    EXPECT_NE(outcome.err.find("kinetri: interrupted within an instant, or another step that is "
                               "long; nothing written\n"),
              std::string::npos)
        << outcome.err;
    EXPECT_EQ(entries(), Entries{"p.csv"});
  }
}

TEST_F(Interruption, what_a_killed_run_leaves_is_removed_by_the_next_one) {
  write_many_points();
  Arguments arguments = long_run;
  arguments.insert(arguments.end(),
                   {"--frames", "frames", "--fps", "0.1", "--checkpoint", "run.kinetri"});
  const auto left = [this] {
    const Entries all = entries();
    return std::count_if(all.begin(), all.end(),
                         [](const std::string& name) { return name.starts_with(".kinetri-"); });
  };
  for (int i = 0; i < 2; ++i) {
    Process process(KINETRI_PROGRAM, arguments, {.directory = directory()});
    process.wait_until([&] { return is_running(process); });
    process.send(SIGKILL);
    EXPECT_EQ(process.wait().exit_code, -SIGKILL);
    EXPECT_EQ(left(), 5);
  }
  // A living run beside it keeps its own.
  Process living(KINETRI_PROGRAM, arguments, {.directory = directory()});
  living.wait_until([&] { return is_running(living); });
  arguments[3] = "0.01";
  EXPECT_EQ(run(arguments).exit_code, 0);
  EXPECT_EQ(left(), 5);
  std::filesystem::remove_all(file("frames"));
  living.send(SIGINT);
  EXPECT_EQ(living.wait().exit_code, 130);
  EXPECT_EQ(entries(),
            (Entries{"edges.csv", "events.csv", "frames", "p.csv", "run.kinetri", "stats.json"}));
}

// The process is in an audit, which takes longer than to go on and notice both signals.
TEST_F(Interruption, second_signal_ends_at_once_and_leaves_nothing) {
  write_many_points();
  Arguments arguments = long_run;
  arguments.insert(arguments.end(), {"--audit", "events"});
  Process process(KINETRI_PROGRAM, arguments, {.directory = directory()});
  process.wait_until(
      [&] { return process.errors_so_far().find("running ...") != std::string::npos; });
  process.send_both(SIGINT, SIGTERM);
  const Outcome outcome = process.wait();
  EXPECT_EQ(outcome.exit_code, 130);
  EXPECT_EQ(entries(), Entries{"p.csv"});
}

// ---- outputs that belong together ----

class Commit : public Interruption {
 protected:
  // A gnuplot that draws when there is a file named go.
  void write_slow_gnuplot() const {
    std::filesystem::create_directory(file("bin"));
    write("bin/gnuplot",
          "#!/bin/sh\n[ \"$1\" = --version ] && exit\ntouch drawing\n"
          "while [ ! -e go ]; do sleep 0.01; done\necho '<svg/>'\n");
    std::filesystem::permissions(file("bin/gnuplot"), std::filesystem::perms::owner_all);
  }

  Process drawing_run() const {
    return Process(
        KINETRI_PROGRAM,
        {"simulate", "p.csv", "--until", "3", "--plot", "plot.svg", "--edges", "edges.csv"},
        {.directory = directory(), .environment = {"PATH=bin:/bin:/usr/bin"}});
  }
};

TEST_F(Commit, signal_while_outputs_are_written_lets_them_be_completed) {
  write("p.csv", one_flip);
  write_slow_gnuplot();
  Process process = drawing_run();
  process.wait_until([&] { return exists("drawing"); });
  process.send(SIGINT);
  // Longer than a run that does not stop is waited for.
  std::this_thread::sleep_for(std::chrono::milliseconds(700));
  write("go", "");
  const Outcome outcome = process.wait();
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(read("plot.svg"), "<svg/>\n");
  EXPECT_EQ(read("edges.csv"), "a,b\n0,1\n0,2\n1,2\n1,3\n2,3\n");
}

TEST_F(Commit, second_signal_while_outputs_are_written_ends_at_once_and_leaves_nothing) {
  write("p.csv", one_flip);
  write_slow_gnuplot();
  Process process = drawing_run();
  process.wait_until([&] { return exists("drawing"); });
  process.send(SIGINT);
  process.send(SIGTERM);
  const Outcome outcome = process.wait();
  write("go", "");
  EXPECT_EQ(outcome.exit_code, 130);
  EXPECT_EQ(entries(), (Entries{"bin", "drawing", "go", "p.csv"}));
}

// A shell passes SIGHUP on when its terminal closes, and the system sends it when the shell ends.
TEST_F(Commit, repeated_hangup_while_outputs_are_written_lets_them_be_completed) {
  write("p.csv", one_flip);
  write_slow_gnuplot();
  Process process = drawing_run();
  process.wait_until([&] { return exists("drawing"); });
  for (int i = 0; i < 2; ++i) {
    process.send(SIGHUP);
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  write("go", "");
  EXPECT_EQ(process.wait().exit_code, 0);
  EXPECT_EQ(read("edges.csv"), "a,b\n0,1\n0,2\n1,2\n1,3\n2,3\n");
}

// An output that cannot take its place any more leaves the checkpoint that was there, and no newer
// one stands beside older outputs.
TEST_F(Commit, checkpoint_takes_its_place_last) {
  for (const std::string option : {"--events", "--edges", "--html", "--stats", "--frames"}) {
    SCOPED_TRACE(option);
    ASSERT_EQ(::mkfifo(file("p.csv").c_str(), 0600), 0);
    write("run.kinetri", "before");
    Process process(
        KINETRI_PROGRAM,
        {"simulate", "p.csv", "--until", "3", option, "out", "--checkpoint", "run.kinetri"},
        {.directory = directory()});
    // Its outputs are open, and it waits for points.
    const std::size_t temporaries = option == "--frames" ? 1 : 2;
    process.wait_until([&] { return entries().size() == 2 + temporaries; });
    std::filesystem::create_directories(file("out/in the way"));
    write("p.csv", one_flip);
    const Outcome outcome = process.wait();
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.err.rfind("out: cannot be replaced by the ", 0), 0U) << outcome.err;
    EXPECT_EQ(entries(), (Entries{"out", "p.csv", "run.kinetri"}));
    EXPECT_EQ(read("run.kinetri"), "before");
    std::filesystem::remove_all(file("out"));
    std::filesystem::remove(file("p.csv"));
  }
}

}  // namespace
}  // namespace kinetri::main_test
