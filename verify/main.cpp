// SPDX-License-Identifier: GPL-3.0-or-later
// kinetri-verify: decides from the points and the event log alone whether a run of kinetri was
// right.
#include <exception>
#include <iostream>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "checker.h"

namespace {

constexpr const char* usage =
    "Usage: kinetri-verify POINTS.csv EVENTS.csv --until T [--from T0]\n"
    "                      [--initial-edges FILE] [--edges FILE]\n"
    "\n"
    "Decides whether the edges are a Delaunay triangulation of the points just after T0,\n"
    "and whether the events keep them one at all times until T, in exact arithmetic.\n"
    "One of the files of edges is needed: those just after T0, or those just after T.\n"
    "\n"
    "Exit code: 0 verified, 1 refuted, 2 bad usage or bad input.\n"
    "\n"
    "Example:\n"
    "  kinetri simulate points.csv --until 10 --events events.csv --initial-edges start.csv\n"
    "  kinetri-verify points.csv events.csv --until 10 --initial-edges start.csv\n";

[[noreturn]] void fail_usage(const std::string& message) {
  throw verify::Bad_input(message + "\n\n" + usage);
}

double number_of(const std::string& option, const std::string& text) {
  double value = 0;
  if (!verify::read_number(text, value)) {
    fail_usage(option + " is " + verify::quoted(text) + "; expected a number");
  }
  return value;
}

// The edges before the first row, from those after the last one.
std::vector<verify::Edge> undone(const std::vector<verify::Edge>& final_edges,
                                 const std::vector<verify::Row>& rows) {
  std::set<verify::Edge> edges(final_edges.begin(), final_edges.end());
  for (std::size_t i = rows.size(); i-- > 0;) {
    for (const verify::Edge& edge : rows[i].added) {
      if (edges.erase(edge) == 0)
        verify::refute_row(i, "an edge that it adds is not there after it");
    }
    for (const verify::Edge& edge : rows[i].removed) {
      if (!edges.insert(edge).second)
        verify::refute_row(i, "an edge that it removes is there after it");
    }
  }
  return {edges.begin(), edges.end()};
}

int run(const std::vector<std::string>& arguments) {
  std::vector<std::string> files;
  std::map<std::string, std::string> options;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& argument = arguments[i];
    if (argument == "--help" || argument == "-h") {
      std::cout << usage;
      return 0;
    }
    if (!argument.starts_with("--")) {
      files.push_back(argument);
      continue;
    }
    const std::string name = argument.substr(0, argument.find('='));
    if (name != "--until" && name != "--from" && name != "--initial-edges" && name != "--edges") {
      fail_usage("unknown option " + verify::quoted(name));
    }
    if (name == argument && i + 1 == arguments.size()) fail_usage(name + " needs a value");
    if (!options.emplace(name, name == argument ? arguments[++i] : argument.substr(name.size() + 1))
             .second) {
      fail_usage(name + " is given twice");
    }
  }
  if (files.size() != 2) fail_usage("expected two files, of points and of events");
  if (!options.contains("--until")) fail_usage("--until is missing");
  const double until = number_of("--until", options["--until"]);
  const double from = options.contains("--from") ? number_of("--from", options["--from"]) : 0;
  if (until < from) fail_usage("--until is before the start");
  const bool has_initial = options.contains("--initial-edges");
  const bool has_final = options.contains("--edges");
  if (!has_initial && !has_final) fail_usage("expected --initial-edges or --edges");

  const std::vector<verify::Motion> points = verify::read_points(files[0]);
  const std::vector<verify::Row> rows = verify::read_events(files[1], points.size());
  std::vector<verify::Edge> initial_edges;
  std::vector<verify::Edge> final_edges;
  if (has_final) final_edges = verify::read_edges(options["--edges"], points.size());
  initial_edges = has_initial ? verify::read_edges(options["--initial-edges"], points.size())
                              : undone(final_edges, rows);

  verify::Checker checker(points, verify::dyadic(from), verify::dyadic(until));
  std::size_t shown = 0;
  checker.check(initial_edges, rows, has_final ? &final_edges : nullptr, [&](std::size_t row) {
    if (row < shown + 100000) return;
    shown = row;
    std::cerr << row << " of " << rows.size() << " events" << std::endl;
  });
  std::cout << "verified: " << points.size() << " points, " << rows.size() << " events, "
            << checker.certificates() << " certificates\n";
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run({argv + 1, argv + argc});
  } catch (const verify::Refuted& refuted) {
    std::cout << "refuted: " << refuted.where << ": " << refuted.message << "\n";
    return 1;
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 2;
  }
}
