// SPDX-License-Identifier: GPL-3.0-or-later
//
// What kinetri_bench measures. Each function runs one measurement in this process and returns it as
// JSON: seconds of wall-clock time, counts, and ratios of numbers measured side by side.
#ifndef KINETRI_BENCH_MEASUREMENTS_H
#define KINETRI_BENCH_MEASUREMENTS_H

#include <CGAL/Delaunay_triangulation_2.h>

#include <chrono>
#include <cstddef>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "kinetri/simulation/scenarios.h"
#include "uncertified_kinetic_delaunay.h"

namespace kinetri::bench {

/// The triangulation that a user without a kinetic one has.
using Static_triangulation = CGAL::Delaunay_triangulation_2<Static_kernel>;

struct Setup {
  Scenario scenario = Scenario::uniform;
  Scenario_options options;
  double until = 10;
  double area_fraction = 0.3;  ///< of discs: the share of the plane that they cover
  /// Of discs: the greatest radius over the least. If empty, all have one radius, and the
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

/// Repeats `round` until two seconds have passed, and takes of each number that it returns the
/// median. `rounds` says how many there were.
nlohmann::json median_round(const std::function<nlohmann::json()>& round);

/// Where the points are at `time`, rounded.
std::vector<Static_kernel::Point_2> positions(const std::vector<Linear_motion_2>& motions,
                                              double time);

/// Seconds of building a static triangulation of `points`: the mean over as many builds as take
/// 0.2 seconds. Its destruction is not counted.
double rebuild_seconds(const std::vector<Static_kernel::Point_2>& points);

/// The exact triangulation, the uncertified one (eager and lazy), and the static rebuild at half
/// time, in turn, until two seconds have passed.
nlohmann::json measure_events(const Setup& setup);

/// The two parts of the start, beside a static triangulation of the same points.
nlohmann::json measure_start(const Setup& setup);

/// Seconds of an event of points with accelerations of up to 1, beside one of the same points
/// without.
nlohmann::json measure_accelerated(const Setup& setup);

/// The run with the components of points that have 4.5 others in range on average, and, for up to
/// 10 000 points, with the minimum spanning tree, each beside the run alone.
nlohmann::json measure_components(const Setup& setup);

/// The peak of the resident memory after construction and run of the exact triangulation alone.
nlohmann::json measure_memory(const Setup& setup);

/// Scheduled, executed and discarded events and root solves: eager, and as the exact triangulation
/// does it.
nlohmann::json measure_paper_table(const Setup& setup);

/// An exact square lattice of about as many points, in which one row moves by one place: all its
/// events are simultaneous. And the setup's own scenario, run to time 1, to compare with.
nlohmann::json measure_lattice_row(const Setup& setup);

/// From how many frames per unit of time on the exact triangulation takes less time than a static
/// rebuild for each frame, and than moving each vertex of a static triangulation.
nlohmann::json measure_frames(const Setup& setup);

/// Seconds of other motions of every tenth point at once, five times on the way to `until`, with
/// one thread and with two, in turn. Throws std::runtime_error if the results differ, or if there
/// are too few points and events for two threads to share that.
nlohmann::json measure_batches(const Setup& setup);

/// Nanoseconds for each insertion, erasure and turn of a point at one time, and for CGAL's
/// insertion and removal in a static triangulation of the same points, in turn.
nlohmann::json measure_changes(const Setup& setup);

/// Nanoseconds for each certificate of a contact and of distances, of the neighbors at the start:
/// those that fail and those that do not, with the filters and without.
nlohmann::json measure_certificates(const Setup& setup);

/// Encounters at a range with 5 points in it on average: seconds of the run beside those of the run
/// alone, and of the answer; of up to 10 000 points beside all pairs in doubles.
nlohmann::json measure_encounters(const Setup& setup);

/// Steps at which a share of the points turns, and after which one looks at the triangulation:
/// seconds per step of `set_motions` and `advance_to`, and of a static triangulation built anew, in
/// turn. For several shares and lengths of a step; a length is the mean way of a point divided by
/// the distance of neighbors.
nlohmann::json measure_steps(const Setup& setup);

/// One run to `until`: seconds by the plain loop and by regions, on one thread and on all, and what
/// the regions did.
nlohmann::json measure_regions(const Setup& setup);

/// The same with equal discs in a box, which collide.
nlohmann::json measure_contacts(const Setup& setup);

/// Runs of points and of discs, uniform, of a lattice, in rows, in clusters, of equal velocities:
/// wall time and time of the processor with the threads that there are, over those with one thread.
nlohmann::json measure_threads(const Setup& setup);

/// Nanoseconds a point of the start of points on a line, on two lines, on a circle, on a lattice,
/// for 4096 points, 16 384 and so on, up to those of the setup.
nlohmann::json measure_lines(const Setup& setup);

/// Seconds of a construction, of one change of the velocities of 1000 points, and of a run that
/// keeps a row for each event.
nlohmann::json measure_arrays(const Setup& setup);

/// Nanoseconds for each point of answers about all points at one time: Voronoi cells and their
/// areas, nearest neighbors, positions; and milliseconds for the closest pair. Beside the exact
/// cell, CGAL's static circumcenters, a look at all points, and positions that are not rounded
/// correctly. Throws std::runtime_error if the areas do not sum to that of the box, or a nearest
/// neighbor is not the nearest point.
nlohmann::json measure_answers(const Setup& setup);

/// Seconds of an event of the regular triangulation of discs, beside those of the Delaunay
/// triangulation of their centres: of one size; of sizes that differ; and with weights that hide
/// about half of the points. Throws std::runtime_error if discs of one size have other events than
/// their centres.
nlohmann::json measure_weights(const Setup& setup);

/// Elastic collisions of discs in a box: the exact simulation, the part of it that is the
/// triangulation's, and a cell list in doubles, in turn. Throws std::runtime_error if the two
/// programs disagree where rounding cannot yet have separated them, or if discs overlap at the end.
nlohmann::json measure_discs(const Setup& setup);

}  // namespace kinetri::bench

#endif  // KINETRI_BENCH_MEASUREMENTS_H
