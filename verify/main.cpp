// SPDX-License-Identifier: GPL-3.0-or-later
// kinetri-verify: decides from the points and the event log alone whether a run of kinetri was
// right.
#include "checker.h"

namespace {

constexpr const char* usage =
    "Usage: kinetri-verify POINTS EVENTS --until T [--from T0] [--initial-edges FILE]\n"
    "                      [--edges FILE] [--motions FILE] [--box XMIN,YMIN,XMAX,YMAX]\n"
    "                      [--rim] [--collisions RESPONSE] [--threads N]\n"
    "\n"
    "Decides whether the edges are a Delaunay triangulation of the points just after T0,\n"
    "and whether the events keep them one at all times until T, in exact arithmetic.\n"
    "One of the files of edges is needed: those just after T0, or those just after T.\n"
    "A file of motions may stand for POINTS. --box, --rim and --collisions are those of\n"
    "the run; without --collisions, the log tells whether contacts change motions.\n"
    "--threads 2 checks certificates beside the rows.\n"
    "\n"
    "Exit code: 0 verified, 1 refuted, 2 bad usage or bad input.\n"
    "\n"
    "Examples:\n"
    "  kinetri simulate points.csv --until 10 --events events.csv --initial-edges start.csv\n"
    "  kinetri-verify points.csv events.csv --until 10 --initial-edges start.csv\n"
    "\n"
    "  kinetri tracks tracks.csv --events events.csv --motions motions.csv --edges end.csv\n"
    "  kinetri-verify motions.csv events.csv --until 60 --edges end.csv\n";

[[noreturn]] void fail_usage(const std::string& message) {
  throw verify::Bad_input(message + "\nRun 'kinetri-verify --help' for what is possible.");
}

std::vector<double> numbers_of(const std::string& option, const std::string& text,
                               std::size_t count) {
  std::vector<double> result;
  std::istringstream in(text);
  for (std::string field; std::getline(in, field, ',');) {
    if (!verify::read_number(field, result.emplace_back())) break;
  }
  if (result.size() == count && std::ranges::count(text, ',') + 1 == std::ssize(result))
    return result;
  fail_usage(option + " is '" + text + "'; expected " + std::to_string(count) + " numbers");
}

// The edges before the first row, from those after the last one.
std::vector<verify::Edge> undone(const std::vector<verify::Edge>& final_edges,
                                 const std::vector<verify::Row>& rows) {
  std::set<verify::Edge> edges(final_edges.begin(), final_edges.end());
  for (std::size_t i = rows.size(); i-- > 0;) {
    for (const verify::Edge& edge : rows[i].added) edges.erase(edge);
    for (const verify::Edge& edge : rows[i].removed) edges.insert(edge);
  }
  return {edges.begin(), edges.end()};
}

int run(const std::vector<std::string>& arguments, std::vector<verify::Row>& rows) {
  std::vector<std::string> files;
  std::map<std::string, std::string> given;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string name = arguments[i].substr(0, arguments[i].find('='));
    if (name == "--help" || name == "-h") return (std::cout << usage).good() ? 0 : 2;
    if (!name.starts_with("--")) {
      files.push_back(arguments[i]);
      continue;
    }
    static const std::set<std::string> names = {"--until",      "--from",    "--initial-edges",
                                                "--edges",      "--motions", "--box",
                                                "--collisions", "--threads"};
    if (name != "--rim" && !names.contains(name)) fail_usage("unknown option " + name);
    std::string value;
    if (name != arguments[i]) {
      value = arguments[i].substr(name.size() + 1);
    } else if (name != "--rim") {
      if (++i == arguments.size()) fail_usage(name + " needs a value");
      value = arguments[i];
    }
    if (!given.emplace(name, value).second) fail_usage(name + " is given twice");
  }
  if (files.size() != 2) fail_usage("expected two files, of points and of events");
  if (!given.contains("--until")) fail_usage("--until is missing");
  const bool has_initial = given.contains("--initial-edges");
  const bool has_final = given.contains("--edges");
  if (!has_initial && !has_final) fail_usage("expected --initial-edges or --edges");

  verify::Options options;
  const auto number = [&](const std::string& name, double otherwise) {
    return given.contains(name) ? numbers_of(name, given[name], 1)[0] : otherwise;
  };
  options.from = verify::dyadic(number("--from", 0));
  options.until = verify::dyadic(number("--until", 0));
  if (compare(options.until, options.from) < 0) fail_usage("--until is before the start");
  if (given.contains("--box")) options.box = numbers_of("--box", given["--box"], 4);
  const double threads = number("--threads", 1);
  if (!(threads >= 1 && threads <= 1024)) fail_usage("expected 1 to 1024 --threads");
  options.threads = static_cast<std::size_t>(threads);
  const std::set<std::string> responses = {"", "none", "log", "swap", "elastic", "stop", "remove"};
  const std::string response = given["--collisions"];
  if (!responses.contains(response)) fail_usage("--collisions is '" + response + "'");
  options.has_rim = given.contains("--rim");
  options.is_log = response == "log";
  options.has_contacts = !response.empty() && response != "none";

  verify::read_events(files[1], rows);
  std::vector<verify::Change> points = verify::read_motions(files[0], &rows);
  if (given.contains("--motions")) {
    for (verify::Row& row : rows) row.changes.clear();
    std::vector<verify::Change> start = verify::read_motions(given["--motions"], &rows);
    const auto is_same = [](const verify::Change& a, const verify::Change& b) {
      return a.id == b.id &&
             std::equal(&(*a.motion)[verify::x], &(*a.motion)[verify::radius], b.motion->begin()) &&
             (*b.motion)[verify::epoch] == (*a.motion)[verify::epoch];
    };
    if (!std::ranges::equal(points, start, is_same)) {
      throw verify::Refuted{-1, "the motions at the start are not those of the points"};
    }
    points = std::move(start);
  }
  for (const verify::Row& row : rows) {
    if (row.kind == "wall" && options.box.empty()) fail_usage("there are walls; expected --box");
    if (row.kind == "collision" && !given.contains("--collisions")) {  // it is to be inferred
      options.has_contacts = true;
      options.is_log |= row.changes.empty();
    }
  }
  std::vector<verify::Edge> final_edges;
  if (has_final) final_edges = verify::read_edges(given["--edges"]);
  const std::vector<verify::Edge> initial_edges =
      has_initial ? verify::read_edges(given["--initial-edges"]) : undone(final_edges, rows);

  verify::Checker checker(options, points, rows);
  const std::size_t count = checker.check(initial_edges, has_final ? &final_edges : nullptr);
  std::cout << "verified: " << points.size() << " points, " << rows.size() << " events, " << count
            << " certificates\n";
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<verify::Row> rows;
  try {
    return run({argv + 1, argv + argc}, rows);
  } catch (const verify::Refuted& refuted) {
    std::cout << "refuted: " << row_name(refuted.row, rows) << ": " << refuted.message << "\n";
    return 1;
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 2;
  }
}
