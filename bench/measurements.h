// SPDX-License-Identifier: GPL-3.0-or-later
//
// The measurements of kinetri_bench. Each function runs one and returns JSON: seconds of wall-clock
// time, counts, and ratios of numbers measured side by side.
#ifndef KINETRI_BENCH_MEASUREMENTS_H
#define KINETRI_BENCH_MEASUREMENTS_H

#include <CGAL/Delaunay_triangulation_2.h>

#include <chrono>
#include <cstddef>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "kinetri/kinetic/periodic_box_2.h"
#include "kinetri/simulation/scenarios.h"
#include "uncertified_kinetic_delaunay.h"

namespace kinetri::bench {

/// The static triangulation for comparisons.
using Static_triangulation = CGAL::Delaunay_triangulation_2<Static_kernel>;

/// The time of queries, and of changes of points.
inline constexpr double present = 0.1;

/// About the distance of neighbors: the scenario uniform has 100 points in 100 x 100.
inline constexpr double neighbor_distance = 10;

struct Setup {
  Scenario scenario = Scenario::uniform;
  Scenario_options options;
  double until = 10;
  double area_fraction = 0.3;  ///< of discs: the share of the plane that they cover
  /// Of discs: the greatest radius over the least. If empty, all radii are equal, and the
  /// simulation is that of points.
  std::optional<double> size_ratio = std::nullopt;

  std::vector<Linear_motion_2> motions() const { return make_scenario(scenario, options); }
};

class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// 0 if the denominator is not positive.
double ratio(double numerator, double denominator);

double median(std::vector<double> values);

/// Repeats `round` for two seconds, at most 25 times, and returns the median of each number, and
/// the number of rounds as `rounds`.
nlohmann::json median_round(const std::function<nlohmann::json()>& round);

/// The rounded positions at `time`.
std::vector<Static_kernel::Point_2> positions(const std::vector<Linear_motion_2>& motions,
                                              double time);

/// Seconds of building a static triangulation of `points`: the mean over as many builds as take
/// 0.2 seconds. Its destruction is not counted.
double rebuild_seconds(const std::vector<Static_kernel::Point_2>& points);

/// The exact triangulation, the uncertified one (eager and lazy), and the static rebuild at half
/// time, in turn, as median_round does it.
nlohmann::json measure_events(const Setup& setup);

/// The two parts of the start, beside a static triangulation of the same points.
nlohmann::json measure_start(const Setup& setup);

/// Seconds of an event of points with accelerations of up to 1, beside one of the same points
/// without.
nlohmann::json measure_accelerated(const Setup& setup);

/// The run with the components of points that have 4.5 others in range on average, and, for up to
/// 10 000 points, with the minimum spanning tree, each beside the run alone.
nlohmann::json measure_components(const Setup& setup);

/// The peak resident memory after construction and run of the exact triangulation, with one thread,
/// and then with all threads.
nlohmann::json measure_memory(const Setup& setup);

/// Scheduled, executed and discarded events and root solves: of the eager uncertified triangulation
/// and of the exact one.
nlohmann::json measure_paper_table(const Setup& setup);

/// A square lattice of about as many points, in which one row moves by one spacing: all its events
/// are simultaneous. And the setup's own scenario, run to time 1, to compare with.
nlohmann::json measure_lattice_row(const Setup& setup);

/// The smallest square with the points, as a periodic box at rest.
Periodic_box_2 periodic_square(const std::vector<Linear_motion_2>& motions);

/// As measure_regions, in a periodic square.
nlohmann::json measure_periodic_regions(const Setup& setup);

/// As measure_contacts, of equal discs in a periodic box.
nlohmann::json measure_periodic_contacts(const Setup& setup);

/// In a periodic box, the smallest square with the points, and in the plane: seconds of an event,
/// and of the start for each point.
nlohmann::json measure_periodic(const Setup& setup);

/// In the same box, steps of all points: seconds until all neighbors are known, by events, by
/// repair, and by voro++, from nothing each time. Only if voro++ is installed.
nlohmann::json measure_periodic_steps(const Setup& setup);

/// The frame rates above which the exact triangulation takes less time than a static rebuild for
/// each frame, and than moving each vertex of a static triangulation for each frame.
nlohmann::json measure_frames(const Setup& setup);

/// Seconds for new motions of every tenth point at once, five times up to `until`, with one thread
/// and with two, in turn; and the sorted ratios, also of the runs between, which show how idle the
/// processors were. Throws std::runtime_error if the results differ, or if there are too few points
/// and events for two threads.
nlohmann::json measure_batches(const Setup& setup);

/// Nanoseconds for each insertion, erasure and velocity change at one time, for CGAL's insertion
/// and removal in a static triangulation of the same points, and for velocity changes of all points
/// and of a tenth at once, relative to a static rebuild.
nlohmann::json measure_changes(const Setup& setup);

/// Nanoseconds for each in-circle certificate, and for each certificate of contacts and distances
/// of neighbors at the start: those that fail and those that do not, with filters and without.
nlohmann::json measure_certificates(const Setup& setup);

/// Encounters at a range with 5 others on average: seconds of the run, of the run alone, and of the
/// answer; for up to 10 000 points also of all pairs in doubles.
nlohmann::json measure_encounters(const Setup& setup);

/// Steps at which a share of the velocities changes: seconds per step of `set_motions` and
/// `advance_to`, and of a static rebuild, in turn. For several shares and lengths of a step, the
/// mean path of a point in distances of neighbors.
nlohmann::json measure_steps(const Setup& setup);

/// One run to `until`: seconds by the sequential loop and in time windows, on one thread and on
/// all, with counts of the windows; and the sorted ratios of three rounds.
nlohmann::json measure_regions(const Setup& setup);

/// The same with equal discs in a box, which collide.
nlohmann::json measure_contacts(const Setup& setup);

/// Runs of points and discs, uniform, on a lattice, in rows, in clusters, with equal velocities:
/// wall time and processor time with all threads, relative to one thread.
nlohmann::json measure_threads(const Setup& setup);

/// Nanoseconds per point of the start of points on a line, on two lines, on a circle, on a lattice,
/// for 4096 points, 16 384 and so on, up to the number of the setup. They should grow at most like
/// the logarithm.
nlohmann::json measure_lines(const Setup& setup);

/// Seconds of a construction, of one change of the velocities of 1000 points, and of a run that
/// keeps a row for each event.
nlohmann::json measure_arrays(const Setup& setup);

/// Nanoseconds per point of queries about all points at one time: Voronoi cells and their areas,
/// nearest neighbors, positions; and milliseconds for the closest pair. Beside the exact cell,
/// CGAL's static circumcenters, a search among all points, and positions that are not rounded
/// correctly. Throws std::runtime_error if the areas do not sum to that of the box, or a nearest
/// neighbor is not the nearest point.
nlohmann::json measure_answers(const Setup& setup);

/// Ratios of seconds per event of the regular triangulation to those of the Delaunay triangulation:
/// for equal discs, for weights that differ, and for weights that hide about half of the points.
/// Throws std::runtime_error if equal discs have other events than their centers.
nlohmann::json measure_weights(const Setup& setup);

/// Elastic collisions of discs in a box: the exact simulation, its triangulation alone, and a cell
/// list in doubles, in turn. Throws std::runtime_error if the two programs disagree before rounding
/// can have separated them, or if discs of the cell list overlap at the end.
nlohmann::json measure_discs(const Setup& setup);

}  // namespace kinetri::bench

#endif  // KINETRI_BENCH_MEASUREMENTS_H
