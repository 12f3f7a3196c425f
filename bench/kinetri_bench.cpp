// SPDX-License-Identifier: GPL-3.0-or-later
//
// Runs one measurement and prints it as one JSON object. bench/run.py makes tables of several runs.
#include <CLI/CLI.hpp>
#include <cmath>
#include <exception>
#include <iostream>
#include <map>
#include <string>

#include "measurements.h"

namespace {

using namespace kinetri;
using namespace kinetri::bench;

// The largest allowed discs do not overlap at the start, on a lattice with coordinates shifted by
// up to the jitter: 2 * 10 sqrt(0.71 / pi) < 10 - 2 * 0.2.
constexpr double discs_jitter = 0.2;
constexpr double most_area_fraction = 0.71;

struct Mode {
  nlohmann::json (*measure)(const Setup&);
  const char* description;
  double until = 10;  // the default
};

const std::string batches_mode = "batches";
const std::string discs_mode = "discs";
const std::string contacts_mode = "contacts";
const std::string periodic_contacts_mode = "periodic-contacts";
const std::string lines_mode = "lines";
const std::string threads_mode = "threads";

const std::map<std::string, Mode> modes = {
    {"events",
     {measure_events, "time per event, against a static rebuild and an uncertified program"}},
    {"start",
     {measure_start, "time to build the triangulation and its queue, beside CGAL's build"}},
    {"accelerated",
     {measure_accelerated, "time per event of accelerated points, beside straight ones"}},
    {"certificates",
     {measure_certificates, "certificates of contacts and distances, with filters and without"}},
    {batches_mode,
     {measure_batches, "new motions of many points at once, with two threads beside one", 5}},
    {"changes", {measure_changes, "time to insert, erase and turn a point, beside CGAL"}},
    {"encounters", {measure_encounters, "all pairs in range of each other, against the run alone"}},
    {lines_mode, {measure_lines, "starts of points on a line, on a circle, on a lattice"}},
    {threads_mode, {measure_threads, "runs with all threads beside runs with one", 5}},
    {"regions", {measure_regions, "one run by the sequential loop and in time windows"}},
    {contacts_mode,
     {measure_contacts, "one run of colliding discs by the sequential loop and in time windows",
      4}},
    {"steps", {measure_steps, "velocity changes at each step, against a rebuild at each step"}},
    {"answers",
     {measure_answers, "Voronoi cells, areas, nearest neighbors, positions, the closest pair"}},
    {"arrays", {measure_arrays, "construction, turns and a recorded run, as Python has them", 1}},
    {"components",
     {measure_components,
      "what the components of points in range, and the spanning tree, cost beside the run", 1}},
    {"memory", {measure_memory, "peak memory of construction and run"}},
    {"frames", {measure_frames, "frame rates above which the kinetic triangulation is faster"}},
    {"lattice-row",
     {measure_lattice_row, "time per event of a lattice in which one row moves, against uniform"}},
    {"periodic-regions", {measure_periodic_regions, "as regions, in a periodic box"}},
    {periodic_contacts_mode, {measure_periodic_contacts, "as contacts, in a periodic box", 4}},
    {"periodic", {measure_periodic, "time per event in a periodic box, against the plane", 1}},
#ifdef KINETRI_WITH_VORO
    {"periodic-steps",
     {measure_periodic_steps, "neighbors after each step in a periodic box, beside voro++", 1}},
#endif
    {"paper-table", {measure_paper_table, "events scheduled, executed, discarded: eager and lazy"}},
    {"weights",
     {measure_weights, "time per event of the regular triangulation, beside the Delaunay one", 1}},
    {discs_mode,
     {measure_discs, "collisions of discs in a box per second, against a cell list in doubles",
      100}},
};

std::map<std::string, Scenario> scenarios() {
  std::map<std::string, Scenario> result;
  for (const Scenario scenario : all_scenarios) result.emplace(name(scenario), scenario);
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App program("Runs one measurement and prints it as one JSON object.", "kinetri_bench");
  program.footer("Example:\n  kinetri_bench events --scenario uniform --points 1000 --until 10");
  program.require_subcommand(1);
  Setup setup;
  setup.options.points = 1000;
  std::string mode;
  for (const auto& [mode_name, m] : modes) {
    CLI::App& command = *program.add_subcommand(mode_name, m.description);
    const bool may_differ = mode_name == discs_mode || mode_name == contacts_mode;
    const bool are_discs = may_differ || mode_name == periodic_contacts_mode;
    if (are_discs) {
      command
          .add_option("--area-fraction", setup.area_fraction,
                      "share of the plane that the discs cover (0.3)")
          ->check(CLI::Range(1e-6, most_area_fraction));
    }
    if (may_differ) {
      command
          .add_option("--sizes", setup.size_ratio,
                      "greatest radius over the least, of discs at random places (equal discs on a "
                      "jittered lattice)")
          ->check(CLI::Range(1.0, 1000.0));
    }
    if (!are_discs) {
      command.add_option("--scenario", setup.scenario, "what moves, and how (uniform)")
          ->transform(CLI::CheckedTransformer(scenarios()));
    }
    const std::string usual_points = mode_name == batches_mode   ? "100000"
                                     : mode_name == lines_mode   ? "262144"
                                     : mode_name == threads_mode ? "52900"
                                                                 : "1000";
    const CLI::Option* points =
        command
            .add_option("--points", setup.options.points, "number of points (" + usual_points + ")")
            ->check(CLI::Range(3, 100'000'000));
    const CLI::Option* until =
        command
            .add_option("--until", setup.until,
                        "time to advance to (" + std::to_string(std::lround(m.until)) + ")")
            ->check(CLI::PositiveNumber);
    command.add_option("--seed", setup.options.seed, "seed of the random numbers (1)");
    command.callback(
        [&, until, points, usual_points, are_discs, chosen = mode_name, usual = m.until] {
          mode = chosen;
          if (points->count() == 0) setup.options.points = std::stoul(usual_points);
          if (until->count() == 0) setup.until = usual;
          if (are_discs) {
            setup.scenario = Scenario::lattice_jitter;
            setup.options.jitter = discs_jitter;
          }
        });
  }
  CLI11_PARSE(program, argc, argv);
  try {
    nlohmann::json result = {{"mode", mode},
                             {"scenario", name(setup.scenario)},
                             {"points", setup.options.points},
                             {"until", setup.until},
                             {"seed", setup.options.seed}};
    result.update(modes.at(mode).measure(setup));
    std::cout << result.dump() << std::endl;
  } catch (const std::exception& error) {
    std::cerr << "kinetri_bench: " << error.what() << '\n';
    return 3;
  }
  return 0;
}
