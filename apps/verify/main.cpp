// SPDX-License-Identifier: GPL-3.0-or-later
// kinetri-verify: decides from the points, the event log and the motions alone whether a run of
// kinetri was correct.
#include "checker.h"

namespace {

constexpr const char* usage =
    "Usage: kinetri-verify POINTS EVENTS --until T [--from T0] [--initial-edges FILE]\n"
    "                      [--edges FILE] [--motions FILE] [--box XMIN,YMIN,XMAX,YMAX]\n"
    "                      [--rim] [--collisions RESPONSE] [--threads N]\n"
    "                      [--periodic LX,LY[,XY]] [--shear RATE]\n"
    "                      [--rates AX,AY,BX,BY] [--epochs TA,TB]\n"
    "\n"
    "Decides whether the edges are a Delaunay triangulation of the points just after T0,\n"
    "and whether the events keep them one at all times until T, in exact arithmetic.\n"
    "One of the files of edges is needed: those just after T0, or those just after T.\n"
    "A file of motions may replace POINTS. --box, --rim and --collisions are those of\n"
    "the run; without them, the log tells where its walls are, and whether discs\n"
    "collide.\n"
    "--threads 2 checks certificates on a second thread.\n"
    "--periodic and --shear are those of the run, whose logs have offsets. Four numbers\n"
    "AX,AY,BX,BY are the two vectors of a box, at the times --epochs (0,0 without it);\n"
    "--rates is how much they change in a unit of time (nothing without it).\n"
    "\n"
    "Exit code: 0 verified, 1 refuted, 2 bad usage or bad input, 3 internal error.\n"
    "\n"
    "Examples:\n"
    "  kinetri simulate points.csv --until 10 --events events.csv --initial-edges start.csv\n"
    "  kinetri-verify points.csv events.csv --until 10 --initial-edges start.csv\n"
    "\n"
    "  kinetri tracks tracks.csv --events events.csv --motions motions.csv --edges end.csv\n"
    "  kinetri-verify motions.csv events.csv --until 60 --edges end.csv\n"
    "\n"
    "  kinetri simulate points.csv --until 10 --periodic 100,100 --shear 0.1 \\\n"
    "      --events events.csv --edges end.csv\n"
    "  kinetri-verify points.csv events.csv --until 10 --periodic 100,100 --shear 0.1 \\\n"
    "      --edges end.csv\n";

[[noreturn]] void fail_usage(const std::string& message) {
  throw verify::Bad_input(message + "\nRun 'kinetri-verify --help' for what is possible.");
}

// From `least` to `most` numbers.
std::vector<double> numbers_of(const std::string& option, const std::string& text,
                               std::size_t least, std::size_t most) {
  std::vector<double> result;
  bool are_numbers = true;
  std::istringstream in(text);
  for (std::string field; std::getline(in, field, ',');) {
    are_numbers = verify::read_number(field, result.emplace_back()) && are_numbers;
  }
  const auto fields = static_cast<std::size_t>(std::ranges::count(text, ',')) + 1;
  const std::size_t count = result.size();
  if (are_numbers && fields == count && least <= count && count <= most) return result;
  const std::string range = (least == most ? "" : std::to_string(least) + " to ");
  fail_usage(option + " is '" + text + "'; expected " +
             (most == 1 ? "a finite number" : range + std::to_string(most) + " finite numbers"));
}

// The edges before the first row, computed backward from those after the last row.
std::vector<verify::Edge> undone(const std::vector<verify::Edge>& final_edges,
                                 const std::vector<verify::Row>& rows) {
  std::set<verify::Edge> edges(final_edges.begin(), final_edges.end());
  for (std::size_t i = rows.size(); i-- > 0;) {
    for (const auto& edge : rows[i].added) edges.erase(edge);
    edges.insert(rows[i].removed.begin(), rows[i].removed.end());
  }
  return {edges.begin(), edges.end()};
}

// The vectors of a periodic box, from the numbers of the options.
std::vector<verify::Motion> lattice(std::map<std::string, std::string>& given) {
  std::vector<double> vectors = numbers_of("--periodic", given["--periodic"], 2, 4);
  std::vector<double> rates(4), epochs(2);
  if (vectors.size() == 4) {
    if (given.contains("--shear")) fail_usage("--shear needs --periodic LX,LY or LX,LY,XY");
    if (given.contains("--rates")) rates = numbers_of("--rates", given["--rates"], 4, 4);
    if (given.contains("--epochs")) epochs = numbers_of("--epochs", given["--epochs"], 2, 2);
  } else {
    for (const char* name : {"--rates", "--epochs"}) {
      if (given.contains(name)) fail_usage(std::string(name) + " needs --periodic AX,AY,BX,BY");
    }
    vectors = {vectors[0], 0, vectors.size() > 2 ? vectors[2] : 0, vectors[1]};
    // The product is rounded, as that of the run is.
    if (given.contains("--shear"))
      rates[2] = numbers_of("--shear", given["--shear"], 1, 1)[0] * vectors[3];
    if (!std::isfinite(rates[2])) fail_usage("the --shear is too fast");
  }
  std::vector<verify::Motion> result(2, verify::Motion());
  for (std::size_t i = 0; i < 2; ++i) {
    result[i][verify::x] = vectors[2 * i];
    result[i][verify::y] = vectors[2 * i + 1];
    result[i][verify::vx] = rates[2 * i];
    result[i][verify::vy] = rates[2 * i + 1];
    result[i][verify::epoch] = epochs[i];
  }
  return result;
}

// Checks that the discs at the start have the radii and growths of the columns of the points, or
// equal ones without such a column. If discs touch nothing, all may be points.
void check_discs(const std::vector<verify::Change>& points, const std::set<std::size_t>& columns,
                 const std::vector<verify::Change>& start, bool may_be_points) {
  const auto is_point = [](const verify::Change& change) {
    return (*change.motion)[verify::radius] == 0 && (*change.motion)[verify::growth] == 0;
  };
  if (may_be_points && std::ranges::all_of(start, is_point)) return;
  for (std::size_t k = 0; k < start.size(); ++k) {
    for (const std::size_t i : {verify::radius, verify::growth}) {
      const verify::Change& expected = columns.contains(i) ? points[k] : start.front();
      if ((*start[k].motion)[i] == (*expected.motion)[i]) continue;
      throw verify::Refuted{-1, "the disc of point " + std::to_string(start[k].id) + " is not " +
                                    (columns.contains(i) ? "that of the points" : "as the others")};
    }
  }
}

// The value of x, y or the radius at a time.
mpq_class value(const verify::Motion& m, std::size_t what, const verify::Dyadic& time) {
  mpq_class t(time.m, verify::Integer(1) << time.e);
  t.canonicalize();
  const mpq_class s = t - mpq_class(m[verify::epoch]);
  if (what == verify::radius) return m[verify::radius] + m[verify::growth] * s;
  return m[what] + s * (m[what + 2] + s / 2 * (m[what + 4] + s / 3 * m[what + 6]));
}

// The number of points, those included that come later.
std::size_t number_of_ids(const std::vector<verify::Change>& points,
                          const std::vector<verify::Row>& rows) {
  std::set<verify::Id> ids;
  for (const verify::Change& change : points) ids.insert(change.id);
  for (const verify::Row& row : rows) {
    for (const verify::Change& change : row.changes) ids.insert(change.id);
  }
  return ids.size();
}

// The sides of a box, as shortest decimal numbers, on which the points of all rows of walls are at
// the times of these rows; none if there are no such sides. The change of velocity determines the
// side.
std::optional<verify::Options> with_box(verify::Options options, bool has_rim,
                                        const std::vector<verify::Change>& points,
                                        const std::vector<verify::Row>& rows) {
  std::map<verify::Id, std::optional<verify::Motion>> motions;
  for (const verify::Change& change : points) motions[change.id] = change.motion;
  std::map<std::size_t, std::vector<std::pair<const verify::Row*, verify::Motion>>> hits;
  for (const verify::Row& row : rows) {
    for (const verify::Change& change : row.changes) {
      auto& motion = motions[change.id];
      if (row.kind == "wall" && motion && change.motion) {
        std::array<mpq_class, 2> turn;  // the change of velocity, inward
        for (std::size_t i = 0; i < 2; ++i) {
          verify::Motion velocity = {};
          for (std::size_t k = i; k < verify::jx; k += 2) velocity[k] = (*motion)[k + 2];
          velocity[verify::epoch] = (*motion)[verify::epoch];
          turn[i] = (*change.motion)[i + 2] - value(velocity, i, verify::dyadic(row.time));
        }
        const std::size_t i = abs(turn[0]) < abs(turn[1]) ? 1 : 0;
        hits[turn[i] > 0 ? i : i + 2].emplace_back(&row, *motion);
      }
      motion = change.motion;
    }
  }
  options.has_rim = has_rim;
  for (const auto& hits_of_side : hits) {
    const std::size_t side = hits_of_side.first;
    const auto rim = [&](const verify::Motion& m, const verify::Dyadic& time) {
      const mpq_class r = has_rim ? value(m, verify::radius, time) : mpq_class();
      return mpq_class(value(m, side % 2, time) + (side > 1 ? r : mpq_class(-r)));
    };
    const auto is_side = [&](double place) {
      return std::ranges::all_of(hits_of_side.second, [&](const auto& hit) {
        const int before = cmp(rim(hit.second, hit.first->lo), mpq_class(place));
        return before * cmp(rim(hit.second, hit.first->hi), mpq_class(place)) <= 0;
      });
    };
    const auto& [row, motion] = hits_of_side.second.front();
    const double about = rim(motion, verify::dyadic(row->time)).get_d();
    for (int digits = 0; digits <= 17 && !options.box.contains(side); ++digits) {
      std::ostringstream text;
      text << std::setprecision(digits) << about;
      const double place = digits == 0 ? 0 : std::strtod(text.str().c_str(), nullptr);
      if (std::isfinite(place) && is_side(place)) options.box[side] = place;
    }
    if (!options.box.contains(side)) return std::nullopt;
  }
  return options;
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
    static const std::set<std::string> names = {
        "--until",      "--from",    "--initial-edges", "--edges", "--motions", "--box",
        "--collisions", "--threads", "--periodic",      "--shear", "--rates",   "--epochs"};
    if (name != "--rim" && !names.contains(name)) fail_usage("unknown option " + name);
    std::string value;
    if (name == "--rim" && name != arguments[i]) fail_usage("--rim takes no value");
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
    return given.contains(name) ? numbers_of(name, given[name], 1, 1)[0] : otherwise;
  };
  options.from = verify::dyadic(number("--from", 0));
  options.until = verify::dyadic(number("--until", 0));
  if (compare(options.until, options.from) < 0) fail_usage("--until is before the start");
  if (given.contains("--box")) {
    const std::vector<double> sides = numbers_of("--box", given["--box"], 4, 4);
    if (sides[0] >= sides[2] || sides[1] >= sides[3]) fail_usage("the --box is empty");
    for (std::size_t i = 0; i < sides.size(); ++i) options.box[i] = sides[i];
  }
  const double threads = number("--threads", 1);
  if (!(threads >= 1 && threads <= 1024 && threads == std::floor(threads)))
    fail_usage("expected 1 to 1024 --threads");
  options.threads = static_cast<std::size_t>(threads);
  const std::set<std::string> responses = {"", "none", "log", "swap", "elastic", "stop", "remove"};
  const std::string response =
      given.contains("--collisions") ? given["--collisions"] : std::string();
  if (!responses.contains(response)) fail_usage("--collisions is '" + response + "'");
  options.has_rim = given.contains("--rim");
  options.may_collide = response != "none";
  using Passing = verify::Options::Passing;
  if (response == "stop") options.passing = Passing::at_rest;
  if (response == "remove") options.passing = Passing::none;
  options.has_contacts = !response.empty() && response != "none";

  const bool is_periodic = given.contains("--periodic");
  if (is_periodic) {
    for (const char* name : {"--box", "--rim"}) {
      if (given.contains(name)) fail_usage(std::string(name) + " is not for periodic boxes");
    }
    options.lattice = lattice(given);
  }
  for (const char* name : {"--shear", "--rates", "--epochs"}) {
    if (!is_periodic && given.contains(name)) fail_usage(std::string(name) + " needs --periodic");
  }

  verify::read_events(files[1], is_periodic, rows);
  const bool has_motions = given.contains("--motions");
  std::set<std::size_t> columns;
  std::vector<verify::Change> points = verify::read_motions(files[0], has_motions ? nullptr : &rows,
                                                            has_motions ? &columns : nullptr);
  if (has_motions) {
    std::vector<verify::Change> start = verify::read_motions(given["--motions"], &rows);
    const auto is_same = [](const verify::Change& a, const verify::Change& b) {
      return a.id == b.id &&
             std::equal(&(*a.motion)[verify::x], &(*a.motion)[verify::radius], b.motion->begin()) &&
             (*b.motion)[verify::epoch] == (*a.motion)[verify::epoch];
    };
    if (!std::ranges::equal(points, start, is_same)) {
      throw verify::Refuted{-1, "the motions at the start are not those of the points"};
    }
    const auto is_collision = [](const verify::Row& row) { return row.kind == "collision"; };
    const bool may_touch =
        options.has_contacts || options.has_rim || std::ranges::any_of(rows, is_collision);
    check_discs(points, columns, start, !may_touch);
    points = std::move(start);
  }
  for (const verify::Row& row : rows) {
    if (row.kind == "collision" && !given.contains("--collisions")) {  // must be inferred
      options.has_contacts = true;
    }
  }
  std::vector<verify::Edge> final_edges;
  if (has_final) final_edges = verify::read_edges(given["--edges"], is_periodic);
  const std::vector<verify::Edge> initial_edges =
      has_initial ? verify::read_edges(given["--initial-edges"], is_periodic)
                  : undone(final_edges, rows);

  // Without --box: infers the walls from the rows, with and without --rim.
  const auto is_wall = [](const verify::Row& row) { return row.kind == "wall"; };
  const auto wall = std::ranges::find_if(rows, is_wall);
  std::vector<verify::Options> possible = {options};
  if (options.box.empty() && wall != rows.end()) {
    possible.clear();
    for (const bool has_rim : {false, true}) {
      if (options.has_rim && !has_rim) continue;
      if (const auto found = with_box(options, has_rim, points, rows)) possible.push_back(*found);
    }
    if (possible.empty()) {
      throw verify::Refuted{wall - rows.begin(), "rows of walls are not on the sides of a box"};
    }
  }
  std::optional<verify::Refuted> first;
  for (const verify::Options& tried : possible) {
    try {
      verify::Checker checker(tried, points, rows);
      const std::size_t certificates =
          checker.check(initial_edges, has_final ? &final_edges : nullptr);
      std::cout << "verified: " << number_of_ids(points, rows) << " points, " << rows.size()
                << " events, " << certificates << " certificates\n";
      return 0;
    } catch (const verify::Refuted& refuted) {
      if (!first) first = refuted;
    }
  }
  throw verify::Refuted(*first);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<verify::Row> rows;
  try {
    return run({argv + 1, argv + argc}, rows);
  } catch (const verify::Refuted& refuted) {
    std::cout << "refuted: " << row_name(refuted.row, rows) << ": " << refuted.message << "\n";
    return 1;
  } catch (const verify::Bad_input& error) {
    std::cerr << error.what() << "\n";
    return 2;
  } catch (const std::exception& error) {
    std::cerr << "kinetri-verify: internal error: " << error.what()
              << "; please report it with the files\n";
    return 3;
  }
}
