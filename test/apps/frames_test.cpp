// SPDX-License-Identifier: GPL-3.0-or-later
//
// The options --frames, --vtu and --plot from outside, of all commands that have them.
#include <signal.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "apps/program_test.h"
#include "support/text.h"

namespace kinetri::frames_test {
namespace {

namespace fs = std::filesystem;
using test::Arguments;
using test::between;
using test::count;
using test::Entries;
using test::one_flip;
using test::Outcome;
using test::Process;

bool gnuplot_is_there() {
  return std::system("gnuplot --version >/dev/null 2>&1") == 0;  // NOLINT(cert-env33-c)
}

class Frames : public test::Program_test {
 protected:
  Outcome simulate(const std::string& text, Arguments more) const {
    write("p.csv", text);
    more.insert(more.begin(), {"simulate", "p.csv"});
    return run(more);
  }

  Entries entries_of(const std::string& name) const {
    Entries result;
    for (const auto& entry : fs::directory_iterator(file(name))) {
      result.push_back(entry.path().filename().string());
    }
    std::ranges::sort(result);
    return result;
  }

  // The captions of the pictures in a directory, in order.
  std::vector<std::string> times(const std::string& name) const {
    std::vector<std::string> result;
    for (const std::string& entry : entries_of(name)) {
      result.push_back(between(read(name + "/" + entry), "<title>t = ", "</title>"));
    }
    return result;
  }

  // How many files the hidden directory of an output has so far.
  std::size_t files_so_far() const {
    for (const std::string& entry : entries()) {
      std::error_code error;
      const fs::directory_iterator files(file(entry), error);
      if (error || entry.front() != '.') continue;
      return static_cast<std::size_t>(std::distance(begin(files), end(files)));
    }
    return 0;
  }
};

// ---- what a run gives ----

TEST_F(Frames, are_the_triangulation_just_after_each_time) {
  const Outcome outcome = simulate(one_flip, {"--until", "3", "--frames", "f", "--fps", "2"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_NE(outcome.err.find("  written      f\n"), std::string::npos) << outcome.err;
  EXPECT_EQ(entries_of("f"),
            (Entries{"frame_000000.svg", "frame_000001.svg", "frame_000002.svg", "frame_000003.svg",
                     "frame_000004.svg", "frame_000005.svg", "frame_000006.svg"}));
  EXPECT_EQ(times("f"), (Entries{"0", "0.5", "1", "1.5", "2", "2.5", "3"}));
  EXPECT_EQ(entries(), (Entries{"f", "p.csv"}));
  std::size_t frame = 0;
  for (const std::string& name : entries_of("f")) {
    const std::string svg = read("f/" + name);
    EXPECT_EQ(svg.rfind("<svg ", 0), 0U);
    EXPECT_EQ(svg.substr(svg.size() - 7), "</svg>\n");
    EXPECT_EQ(count(svg, "<circle "), 4U);
    EXPECT_EQ(count(between(svg, "class=\"edges\"", "/>"), "M"), 1U);
    EXPECT_EQ(count(between(svg, "class=\"hull\"", "/>"), "M"), 4U);
    // At t = 1 four points are cocircular; the flip of that time has happened.
    EXPECT_NE(svg.find(frame < 2 ? "0 events" : "1 event<"), std::string::npos) << svg;
    ++frame;
  }
  // The view is that of all places, from 0 to 6: a square of 672 pixels. The flipped edge is that
  // from 4, 0 to 0, 4.
  EXPECT_NE(read("f/frame_000001.svg").find("d=\"M24 696L416 304\""), std::string::npos);
  EXPECT_NE(read("f/frame_000002.svg").find("d=\"M472 696L24 248\""), std::string::npos);
}

TEST_F(Frames, are_a_hundred_and_one_without_a_rate) {
  EXPECT_EQ(simulate(one_flip, {"--from", "-1", "--until", "9", "--frames", "f"}).exit_code, 0);
  const std::vector<std::string> all = times("f");
  ASSERT_EQ(all.size(), 101U);
  EXPECT_EQ(all[0], "-1");
  EXPECT_EQ(all[13], "0.3");
  EXPECT_EQ(all[100], "9");
}

TEST_F(Frames, of_a_run_of_no_length_are_one) {
  EXPECT_EQ(
      simulate(one_flip, {"--from", "2", "--until", "2", "--frames", "f", "--vtu", "v"}).exit_code,
      0);
  EXPECT_EQ(times("f"), Entries{"2"});
  EXPECT_EQ(entries_of("v"), (Entries{"frame_000000.vtu", "frames.pvd"}));
}

TEST_F(Frames, of_few_points_work) {
  for (const char* rows : {"", "1,2,3,4\n", "1,2,3,4\n5,6,7,8\n", "0,0,0,0\n1,1,0,0\n2,2,0,0\n"}) {
    const Outcome outcome = simulate(std::string("x,y,vx,vy\n") + rows,
                                     {"--until", "1", "--fps", "1", "--frames", "f", "--vtu", "v"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(count(read("f/frame_000001.svg"), "<circle "), count(rows, "\n"));
    EXPECT_NE(read("v/frame_000001.vtu").find("NumberOfCells=\"0\""), std::string::npos);
    fs::remove_all(file("f"));
    fs::remove_all(file("v"));
  }
}

TEST_F(Frames, show_box_and_discs) {
  const Outcome outcome =
      simulate("x,y,vx,vy\n0,0,1,0\n5,0,0,0\n0,9,0,0\n",
               {"--until", "9", "--box", "-2,-2,9,10", "--collisions", "remove", "--radius", "1",
                "--frames-per-time", "0.5", "--frames", "f", "--vtu", "v"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(times("f"), (Entries{"0", "2", "4", "6", "8"}));
  const std::string before = read("f/frame_000001.svg");
  EXPECT_EQ(count(before, "class=\"box\""), 1U);
  EXPECT_EQ(count(between(before, "class=\"discs\"", "</g>"), "<circle "), 3U);
  // Two have met at t = 3 and are gone.
  EXPECT_EQ(count(between(read("f/frame_000002.svg"), "class=\"discs\"", "</g>"), "<circle "), 1U);
  EXPECT_NE(read("v/frame_000002.vtu").find("NumberOfPoints=\"1\""), std::string::npos);
  EXPECT_NE(read("v/frame_000002.vtu").find("Name=\"radius\""), std::string::npos);
}

TEST_F(Frames, have_a_series_for_para_view) {
  EXPECT_EQ(simulate(one_flip, {"--until", "0.3", "--vtu", "v/", "--fps", "10"}).exit_code, 0);
  EXPECT_EQ(entries_of("v"), (Entries{"frame_000000.vtu", "frame_000001.vtu", "frame_000002.vtu",
                                      "frame_000003.vtu", "frames.pvd"}));
  const std::string series = read("v/frames.pvd");
  EXPECT_EQ(count(series, "<DataSet "), 4U);
  EXPECT_NE(series.find("timestep=\"0.3\" group=\"\" part=\"0\" file=\"frame_000003.vtu\""),
            std::string::npos)
      << series;
}

// Stops at frames and samples are no events.
TEST_F(Frames, change_nothing_of_the_run) {
  const std::string discs = run({"generate", "lattice-jitter", "--points", "36"}).out;
  const Arguments options = {"--until",  "5", "--box",   "-5,-5,55,55", "--collisions", "elastic",
                             "--radius", "2", "--stats", "s.json",      "--audit",      "events"};
  Arguments plain = options;
  plain.insert(plain.end(), {"--events", "plain.csv", "--checkpoint", "plain.kinetri"});
  Arguments drawn = options;
  drawn.insert(drawn.end(), {"--events", "drawn.csv", "--checkpoint", "drawn.kinetri", "--vtu", "v",
                             "--fps", "7.3"});
  if (gnuplot_is_there()) drawn.insert(drawn.end(), {"--plot", "plot.svg"});
  EXPECT_EQ(simulate(discs, plain).exit_code, 0);
  const auto plain_stats = nlohmann::json::parse(read("s.json"));
  EXPECT_EQ(simulate(discs, drawn).exit_code, 0);
  const auto drawn_stats = nlohmann::json::parse(read("s.json"));
  EXPECT_EQ(read("drawn.csv"), read("plain.csv"));
  EXPECT_GT(count(read("plain.csv"), "\n"), 150U);
  for (const char* key : {"events", "instants", "largest_instant", "audits", "reached"}) {
    EXPECT_EQ(drawn_stats[key], plain_stats[key]) << key;
  }
  EXPECT_EQ(entries_of("v").size(), 38U);
}

TEST_F(Frames, go_on_with_a_resumed_run) {
  EXPECT_EQ(simulate(one_flip, {"--until", "1.25", "--checkpoint", "run.kinetri"}).exit_code, 0);
  EXPECT_EQ(simulate(one_flip, {"--from", "1.25", "--until", "2", "--frames", "f", "--fps", "4"})
                .exit_code,
            0);
  const Outcome outcome =
      run({"resume", "run.kinetri", "--until", "2", "--frames", "g", "--fps", "4"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(times("g"), (Entries{"1.25", "1.5", "1.75", "2"}));
  // But for the events, which are counted on.
  const std::string resumed = read("g/frame_000002.svg");
  EXPECT_EQ(between(resumed, "<path", "<text"),
            between(read("f/frame_000002.svg"), "<path", "<text"));
  EXPECT_NE(resumed.find("1 event<"), std::string::npos);
}

TEST_F(Frames, of_tracks_show_all_observations) {
  write("t.txt", "0 1 0 0\n10 1 8 0\n0 2 0 3\n10 2 0 7\n5 3 2 2\n10 3 -2 2\n");
  const Outcome outcome = run({"tracks", "t.txt", "--format", "frames", "--fps", "5", "--frames",
                               "f", "--frames-per-time", "2", "--until", "1.5"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(times("f"), (Entries{"0", "0.5", "1", "1.5"}));
  EXPECT_EQ(count(read("f/frame_000001.svg"), "<circle "), 2U);
  EXPECT_EQ(count(read("f/frame_000002.svg"), "<circle "), 3U);  // the third comes at t = 1
  // From -2, 0 to 8, 7 in a width of 912: it stands at 2, 2.
  EXPECT_NE(read("f/frame_000002.svg").find("cx=\"388.8\" cy=\"480\""), std::string::npos)
      << read("f/frame_000002.svg");
}

TEST_F(Frames, may_take_the_place_of_an_empty_directory) {
  fs::create_directory(file("f"));
  EXPECT_EQ(simulate(one_flip, {"--until", "1", "--frames", "f", "--fps", "1"}).exit_code, 0);
  EXPECT_EQ(entries_of("f").size(), 2U);
}

TEST_F(Frames, have_discs_that_coincide_with_others_as_hidden) {
  const std::string points = "x,y,vx,vy\n0,0,1,0\n5,0,0,0\n0,5,0,0\n0,0,1,0\n";
  EXPECT_EQ(simulate(points, {"--until", "1", "--collisions", "log", "--radius", "0.5", "--frames",
                              "f", "--fps", "1"})
                .exit_code,
            0);
  const std::string svg = read("f/frame_000001.svg");
  // A disc and a dot of each point, in four groups.
  EXPECT_EQ(count(svg, "<circle "), 8U);
  EXPECT_EQ(count(svg, "class=\"hidden-points\""), 1U);
  EXPECT_EQ(count(svg, "class=\"hidden-discs\""), 1U);
}

// ---- what is refused ----

TEST_F(Frames, of_a_run_that_fails_are_not_there) {
  // From t = 1 on both go the same way.
  write("t.csv", "t,id,x,y\n0,a,0,0\n1,a,1,0\n2,a,2,0\n0,b,0,5\n1,b,1,0\n2,b,2,0\n");
  fs::create_directory(file("v"));
  const Outcome outcome =
      run({"tracks", "t.csv", "--coincident", "refuse", "--frames", "f", "--vtu", "v"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.err.rfind("t.csv:6: from t = 1 on ids 'a' and 'b' go the same way", 0), 0U);
  EXPECT_EQ(entries(), (Entries{"t.csv", "v"}));
  EXPECT_EQ(entries_of("v"), Entries{});
}

// ---- interruption ----

class Frames_interruption : public Frames {
 protected:
  // A run that takes far longer than the test.
  Arguments long_run() const {
    write("p.csv", run({"generate", "uniform", "--points", "10000", "--seed", "1"}).out);
    return {"simulate", "p.csv", "--until", "1000", "--vtu", "v", "--fps", "100"};
  }
};

TEST_F(Frames_interruption, leaves_the_frames_so_far) {
  Arguments arguments = long_run();
  if (gnuplot_is_there()) arguments.insert(arguments.end(), {"--plot", "plot.svg"});
  Process process(KINETRI_PROGRAM, arguments, {.directory = directory()});
  process.wait_until([&] { return files_so_far() >= 3; });
  process.send(SIGINT);
  const Outcome outcome = process.wait();
  EXPECT_EQ(outcome.exit_code, 130);
  EXPECT_NE(outcome.err.find(", interrupted\n"), std::string::npos) << outcome.err;
  const Entries files = entries_of("v");
  ASSERT_GE(files.size(), 4U);
  EXPECT_LT(files.size(), 100'000U);
  const std::string series = read("v/frames.pvd");
  EXPECT_EQ(count(series, "<DataSet "), files.size() - 1);
  for (const std::string& name : files) {
    if (name == "frames.pvd") continue;
    EXPECT_NE(series.find("file=\"" + name + "\""), std::string::npos) << name;
    EXPECT_EQ(count(read("v/" + name), "</VTKFile>"), 1U) << name;
  }
  if (gnuplot_is_there()) {
    EXPECT_NE(read("plot.svg").find(", interrupted"), std::string::npos);
    fs::remove(file("plot.svg"));
  }
  EXPECT_EQ(entries(), (Entries{"p.csv", "v"}));
}

// Such a run stands at the time of an event, which most likely is no binary64 number: the first
// frame is at the next one.
TEST_F(Frames_interruption, may_be_followed_by_frames) {
  long_run();
  Process process(KINETRI_PROGRAM,
                  {"simulate", "p.csv", "--until", "1000", "--progress", "always", "--checkpoint",
                   "run.kinetri", "--events", "events.csv"},
                  {.directory = directory()});
  process.wait_until(
      [&] { return process.errors_so_far().find(" events/s") != std::string::npos; });
  process.send(SIGINT);
  EXPECT_EQ(process.wait().exit_code, 130);
  const std::string events = read("events.csv");
  std::istringstream last(events.substr(events.rfind('\n', events.size() - 2) + 1));
  std::string time_hi;
  for (int field = 0; field < 5; ++field) std::getline(last, time_hi, ',');
  const Outcome resumed =
      run({"resume", "run.kinetri", "--until", std::to_string(std::stod(time_hi) + 0.01),
           "--frames", "f", "--fps", "1000"});
  EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
  const std::vector<std::string> frames = times("f");
  ASSERT_GE(frames.size(), 10U);
  EXPECT_EQ(frames[0], time_hi);
}

// The process is in an audit, which takes longer than to go on and notice both signals.
TEST_F(Frames_interruption, by_second_signal_leaves_nothing) {
  Arguments arguments = long_run();
  arguments.insert(arguments.end(), {"--audit", "events"});
  Process process(KINETRI_PROGRAM, arguments, {.directory = directory()});
  process.wait_until([&] { return files_so_far() > 0; });
  process.send_both(SIGINT, SIGTERM);
  const Outcome outcome = process.wait();
  EXPECT_EQ(outcome.exit_code, 130);
  EXPECT_NE(outcome.err.find("kinetri: interrupted, nothing written\n"), std::string::npos);
  EXPECT_EQ(entries(), Entries{"p.csv"});
}

// ---- the plot ----

class Plot : public Frames {
 protected:
  void SetUp() override {
    if (!gnuplot_is_there()) GTEST_SKIP() << "gnuplot is not installed";
  }

  std::string plot(const std::string& text, Arguments more) const {
    more.insert(more.end(), {"--plot", "plot.svg", "--quiet"});
    const Outcome outcome = simulate(text, more);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    const std::string svg = read("plot.svg");
    EXPECT_EQ(svg.rfind("<?xml", 0), 0U);
    EXPECT_NE(svg.find("</svg>"), std::string::npos);
    for (const char* label : {"events so far", "entries in the queues", "triangulation", "read, ",
                              "build, ", "initialize, ", "run, ", "audit, ", "write, "}) {
      EXPECT_NE(svg.find(label), std::string::npos) << label;
    }
    return svg;
  }
};

TEST_F(Plot, shows_the_kinds_of_event_that_there_were) {
  const std::string free = plot(one_flip, {"--until", "3"});
  EXPECT_NE(free.find("4 points from t = 0 to 3: 1 event<"), std::string::npos);
  EXPECT_NE(free.find(">flip<"), std::string::npos);
  EXPECT_EQ(free.find(">wall<"), std::string::npos);
  EXPECT_EQ(free.find("contacts and changes"), std::string::npos);
  const std::string discs =
      plot("x,y,vx,vy\n0,0,1,0\n5,0,0,0\n0,9,0,0\n",
           {"--until", "9", "--box", "-2,-2,9,10", "--collisions", "swap", "--radius", "1"});
  EXPECT_EQ(discs.find(">flip<"), std::string::npos);
  EXPECT_NE(discs.find(">wall<"), std::string::npos);
  EXPECT_NE(discs.find(">collision<"), std::string::npos);
  EXPECT_NE(discs.find("contacts and changes"), std::string::npos);
}

TEST_F(Plot, of_a_run_without_events_says_so) {
  EXPECT_NE(plot("x,y,vx,vy\n", {"--until", "3"}).find("no events"), std::string::npos);
}

// Times that gnuplot could not tell apart, or does not know.
TEST_F(Plot, of_every_time_works) {
  const std::vector<std::array<const char*, 2>> runs = {
      {"2", "2"}, {"0", "5e-324"}, {"-1e308", "1e308"}, {"1e17", "1.00000000000001e17"}};
  for (const auto& [from, until] : runs) {
    EXPECT_NE(plot(one_flip, {"--from", from, "--until", until}).find("% of the time"),
              std::string::npos);
  }
}

TEST_F(Plot, of_other_commands_works) {
  EXPECT_EQ(simulate(one_flip, {"--until", "0.5", "--checkpoint", "run.kinetri"}).exit_code, 0);
  const Outcome resumed = run({"resume", "run.kinetri", "--until", "2", "--plot", "resumed.svg"});
  EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_NE(resumed.err.find("  written      resumed.svg\n"), std::string::npos);
  EXPECT_NE(read("resumed.svg").find(">flip<"), std::string::npos);
  write("t.csv", "t,id,x,y\n0,a,0,0\n1,a,1,0\n");
  EXPECT_EQ(run({"tracks", "t.csv", "--plot", "-", "--quiet"}).out.rfind("<?xml", 0), 0U);
}

}  // namespace
}  // namespace kinetri::frames_test
