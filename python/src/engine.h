// SPDX-License-Identifier: GPL-3.0-or-later
//
// The engine of the Python classes: a kinetic triangulation or a simulation of any kind of motion,
// behind one interface without templates. Motions are passed as columns of numbers; answers are
// vectors that become NumPy arrays without a copy. Independent of Python.
#ifndef KINETRI_PYTHON_ENGINE_H
#define KINETRI_PYTHON_ENGINE_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "kinetri/algebra/algebraic_number.h"
#include "kinetri/events/event.h"
#include "kinetri/io/checkpoint_file.h"
#include "kinetri/kinetic/certificate.h"
#include "kinetri/kinetic/disc_motion_2.h"
#include "kinetri/kinetic/periodic_box_2.h"
#include "kinetri/observers/cell_areas.h"
#include "kinetri/simulation/recording.h"
#include "kinetri/simulation/simulation_options.h"
#include "kinetri/simulation/tracks.h"
#include "kinetri/triangulation/audit.h"
#include "kinetri/triangulation/coincident_points.h"
#include "kinetri/triangulation/queries_2.h"
#include "kinetri/triangulation/triangulation_counters.h"
#include "watch.h"

namespace kinetri::python {

/// The motions of `size` points with one epoch, as columns. A null column is zero everywhere.
struct Motion_columns {
  std::size_t size = 0;
  const double* positions = nullptr;      ///< x and y of each point, at the epoch; never null
  const double* velocities = nullptr;     ///< two numbers for each point
  const double* accelerations = nullptr;  ///< two numbers for each point
  const double* jerks = nullptr;          ///< two numbers for each point
  const double* radii = nullptr;          ///< one number for each point
  const double* growths = nullptr;        ///< one number for each point
  const double* weights = nullptr;        ///< one number for each point
  double epoch = 0;

  /// The motion of point i.
  Polynomial_disc_motion_2 operator[](std::size_t i) const;
};

/// A kind of motion.
struct Motion_kind {
  bool is_polynomial = false;  ///< whether points may accelerate
  bool has_weight = false;     ///< whether the points are discs

  friend bool operator==(const Motion_kind&, const Motion_kind&) = default;
};

/// Points; in a periodic box images of points, with as many offsets as ids.
struct Images {
  std::vector<Point_id> ids;
  std::optional<std::vector<Lattice_offset_2>> offsets = std::nullopt;
};

/// As Location_2 and Periodic_location_2.
struct Location {
  Location_2::Kind kind;
  Images points;
};

/// As Voronoi_cell_2; in a periodic box with the offsets of its neighbors.
struct Cell {
  Voronoi_cell_2<Vector_2> cell;
  std::optional<std::vector<Lattice_offset_2>> offsets = std::nullopt;
};

/// The corners of a triangle in a periodic box, counterclockwise; offsets are against the first
/// one. It is the corner that makes the triangle the least; so it has the least id.
using Periodic_triangle = std::array<Periodic_image, 3>;

/// Counters since the start.
struct Statistics {
  std::array<std::uint64_t, event_kinds> events = {};  ///< by Event_kind
  Certificate_counters certificates;                   ///< of topology and of contacts
  std::uint64_t instants = 0;                          ///< distinct times of failures
  std::uint64_t reconstructions = 0;                   ///< of the whole triangulation
};

/// The triangulation or simulation. Functions throw what those of Kinetic_triangulation_2 and
/// Simulation_2 throw; what a triangulation, this kind of motion, or points in a periodic box
/// cannot do throws Precondition_error.
class Engine {
 public:
  using Time = Algebraic_number;

  Engine() = default;
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;
  virtual ~Engine() = default;

  // ---- the present ----
  virtual Motion_kind motion_kind() const = 0;
  virtual Time current_time() const = 0;
  virtual std::size_t number_of_points() const = 0;
  virtual Point_id next_id() const = 0;
  virtual bool contains(Point_id id) const = 0;
  virtual Polynomial_disc_motion_2 motion(Point_id id) const = 0;
  virtual double mass(Point_id id) const = 0;
  virtual std::vector<Edge_ids> edges() const = 0;
  /// Counterclockwise, the least id first; sorted.
  virtual std::vector<Triangle_ids> triangles() const = 0;
  /// Counterclockwise, from the least id on; if all points are collinear, along their line.
  virtual std::vector<Point_id> hull() const = 0;
  virtual std::vector<Point_id> hidden_points() const = 0;
  virtual std::vector<Point_id> coincident_points(Point_id id) const = 0;

  // ---- the present in a periodic box ----
  virtual std::optional<Periodic_box_2> box() const = 0;
  /// In the order of edges().
  virtual std::vector<Periodic_edge> periodic_edges() const = 0;
  /// In the order of triangles().
  virtual std::vector<Periodic_triangle> periodic_triangles() const = 0;
  /// As positions(), but of the images in the box.
  virtual std::vector<double> wrapped_positions() const = 0;
  /// The positions of images (x, y, x, y, ...). Precondition: there are these points.
  virtual std::vector<double> positions_of(std::span<const Point_id> ids,
                                           std::span<const Lattice_offset_2> offsets) const = 0;

  // ---- time ----
  virtual std::optional<Time> next_event_time() = 0;
  virtual std::size_t step(const Time* until) = 0;
  virtual std::size_t advance_to(const Time& time, const std::function<bool()>& may_go_on) = 0;
  /// Throws what advance_to would throw before the first event.
  virtual void check_can_advance_to(const Time& time) const = 0;
  /// The number of threads of advance_to; 0 by default.
  virtual std::size_t threads() const = 0;
  virtual void set_threads(std::size_t most) = 0;
  virtual std::size_t reverse() = 0;

  // ---- changes ----
  virtual Point_id insert(const Motion_columns& motions, std::span<const double> masses) = 0;
  virtual void erase(std::span<const Point_id> ids) = 0;
  virtual void set_motions(std::span<const Point_id> ids, const Motion_columns& motions) = 0;
  /// Two numbers for each id. Each point continues from its present position as by
  /// `with_velocity_at`.
  virtual void set_velocities(std::span<const Point_id> ids,
                              std::span<const double> velocities) = 0;
  /// Two numbers for each id. Each point stays there at rest, as by `at_rest_in`.
  virtual void set_positions(std::span<const Point_id> ids, std::span<const double> positions) = 0;
  virtual void set_masses(std::span<const Point_id> ids, std::span<const double> masses) = 0;
  virtual Point_id schedule_insert(const Time& time, const Motion_columns& motion, double mass) = 0;
  virtual void schedule_motion(const Time& time, Point_id id, const Motion_columns& motion) = 0;
  virtual void schedule_erase(const Time& time, Point_id id) = 0;

  // ---- watching ----
  virtual void add_observer(Event_observer& observer) = 0;
  virtual void remove_observer(Event_observer& observer) = 0;
  virtual std::unique_ptr<Event_observer> recorder(double until, std::size_t most_rows) = 0;
  /// Precondition: the observer is a recorder() of this engine.
  virtual Recording recording(const Event_observer& recorder) const = 0;

  /// See watch.h.
  virtual std::unique_ptr<Watch> watch(const Question& question) = 0;

  // ---- answers, at the current time ----
  virtual std::optional<Periodic_image> nearest_vertex(const Vector_2& place) const = 0;
  virtual Location locate(const Vector_2& place) const = 0;
  virtual Images neighbors(Point_id id) const = 0;
  virtual Cell voronoi_cell(Point_id id) const = 0;
  /// In a periodic box the polygon is empty: the areas are those of whole cells.
  virtual std::vector<double> voronoi_areas(std::span<const Vector_2> polygon) const = 0;
  virtual std::vector<Cell_area> cell_areas(const Cell_limits& limits) const = 0;
  virtual std::vector<Edge_ids> gabriel_edges() const = 0;
  virtual std::vector<Edge_ids> relative_neighbor_edges() const = 0;
  /// One for each id or, if k is given, k.
  virtual Images nearest_neighbors(std::optional<std::size_t> k) const = 0;
  virtual std::optional<Periodic_edge> closest_pair() const = 0;
  /// By id, NaN if there is no point: positions (x, y, x, y, ...), velocities, radii.
  virtual std::vector<double> positions() const = 0;
  virtual std::vector<double> velocities() const = 0;
  virtual std::vector<double> radii() const = 0;

  // ---- state ----
  virtual Audit_report audit(Audit_level level) const = 0;
  virtual Statistics statistics() const = 0;
  /// The default ones for a triangulation.
  virtual Simulation_options options() const = 0;
  /// Without the name of a response.
  virtual Checkpoint snapshot() const = 0;
};

/// The class to restore from a checkpoint.
enum class Engine_kind {
  triangulation,  ///< Kinetic_triangulation_2
  simulation,     ///< Simulation_2
};

/// A triangulation of motions of that kind. Columns that the kind does not have must be zero. In a
/// periodic box points neither accelerate nor have weights.
std::unique_ptr<Engine> make_triangulation(const Motion_columns& motions, const Motion_kind& kind,
                                           const Algebraic_number& start,
                                           Coincident_points coincident,
                                           const std::optional<Periodic_box_2>& box);

/// A simulation of motions of that kind. In a periodic box points do not accelerate.
std::unique_ptr<Engine> make_simulation(const Motion_columns& motions, const Motion_kind& kind,
                                        const Algebraic_number& start,
                                        const Simulation_options& options,
                                        const std::optional<Periodic_box_2>& box);

/// The triangulation or simulation of a checkpoint. Throws Snapshot_error if `kind` is a
/// triangulation, but the state has a box with walls, a response, scheduled changes, or discs in a
/// periodic box.
std::unique_ptr<Engine> restore(const Checkpoint& checkpoint, Engine_kind kind,
                                Collision_response response);

/// A simulation of tracks; discs if there are radii.
std::unique_ptr<Engine> make_tracks_simulation(std::span<const std::vector<Observation_2>> tracks,
                                               std::span<const double> radii,
                                               std::span<const Stay> stays, double start,
                                               const Simulation_options& options);

}  // namespace kinetri::python

#endif  // KINETRI_PYTHON_ENGINE_H
