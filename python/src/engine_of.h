// SPDX-License-Identifier: GPL-3.0-or-later
//
// The Engine of a class of the library.
#ifndef KINETRI_PYTHON_ENGINE_OF_H
#define KINETRI_PYTHON_ENGINE_OF_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine.h"
#include "kinetri/impl/base/check.h"
#include "kinetri/impl/triangulation/incident.h"
#include "kinetri/impl/triangulation/torus_triangulation.h"
#include "kinetri/kinetic/image_motion_2.h"
#include "kinetri/kinetic/kinetic_traits_2.h"
#include "kinetri/observers/proximity_graphs.h"
#include "kinetri/simulation/simulation_2.h"
#include "kinetri/triangulation/periodic_queries_2.h"

namespace kinetri::python {

/// The kind of motion of `Motion`.
template <class Motion>
inline constexpr Motion_kind kind_of = {
    std::is_same_v<Center_motion_of<Motion>, Polynomial_motion_2>, HasWeight<Motion>};

/// The motion as one of the type `Motion`. Precondition: members that the type does not have are
/// zero.
template <class Motion>
Motion motion_as(const Polynomial_disc_motion_2& motion) {
  Motion result = {};
  result.position = motion.position;
  result.velocity = motion.velocity;
  result.epoch = motion.epoch;
  if constexpr (kind_of<Motion>.is_polynomial) {
    result.acceleration = motion.acceleration;
    result.jerk = motion.jerk;
  } else {
    KINETRI_PRECONDITION(motion.acceleration == Vector_2() && motion.jerk == Vector_2(),
                         "the points move along straight lines; expected no acceleration and no "
                         "jerk: give them at the construction to have points that accelerate");
  }
  if constexpr (kind_of<Motion>.has_weight) {
    result.radius = motion.radius;
    result.growth = motion.growth;
    result.weight = motion.weight;
  } else {
    KINETRI_PRECONDITION(motion.radius == 0 && motion.growth == 0 && motion.weight == 0,
                         "the points have no radii of their own; expected no radius, growth and "
                         "weight: give them at the construction to have discs of any size");
  }
  return result;
}

template <class Motion>
std::vector<Motion> motions_of(const Motion_columns& columns) {
  std::vector<Motion> result;
  result.reserve(columns.size);
  for (std::size_t i = 0; i < columns.size; ++i) result.push_back(motion_as<Motion>(columns[i]));
  return result;
}

/// `Core` is Kinetic_triangulation_2 or Simulation_2, with `Traits`.
template <template <class> class Core, class Traits>
class Engine_of final : public Engine {
 public:
  using Motion = typename Traits::Motion;
  using Kinetic = Kinetic_triangulation_2<Traits>;

  static constexpr bool is_simulation = !std::is_same_v<Core<Traits>, Kinetic>;
  static constexpr bool is_periodic = PeriodicKineticTraits_2<Traits>;

  explicit Engine_of(std::unique_ptr<Core<Traits>> core) : core_(std::move(core)) {
    core_->set_threads(threads_);
  }

  // ---- the present ----

  Motion_kind motion_kind() const override { return kind_of<Motion>; }
  Time current_time() const override { return core_->current_time(); }
  std::size_t number_of_points() const override { return kinetic().number_of_points(); }
  Point_id next_id() const override { return kinetic().next_id(); }
  bool contains(Point_id id) const override { return kinetic().contains(id); }
  Polynomial_disc_motion_2 motion(Point_id id) const override {
    Polynomial_disc_motion_2 result = general_motion(kinetic().motion(id));
    if constexpr (is_simulation && !HasWeight<Motion>) result.radius = core_->options().radius;
    return result;
  }
  double mass(Point_id id) const override {
    if constexpr (is_simulation) return core_->mass(id);
    return 1;
  }
  std::vector<Edge_ids> edges() const override { return kinetic().finite_edge_ids(); }
  std::vector<Triangle_ids> triangles() const override;
  std::vector<Point_id> hull() const override;
  std::vector<Point_id> hidden_points() const override;
  std::vector<Point_id> coincident_points(Point_id id) const override {
    return kinetic().coincident_points(id);
  }

  // ---- the present in a periodic box ----

  std::optional<Periodic_box_2> box() const override {
    if constexpr (is_periodic) {
      return kinetic().traits().box();
    } else {
      return std::nullopt;
    }
  }
  std::vector<Periodic_edge> periodic_edges() const override {
    if constexpr (is_periodic) return kinetic().periodic_edges();
    refuse_without_box();
  }
  std::vector<Periodic_triangle> periodic_triangles() const override;
  std::vector<double> wrapped_positions() const override {
    if constexpr (is_periodic) {
      return positions_by_id([this](Point_id id) {
        return wrapped(center(kinetic().motion(id)), kinetic().traits().box(), current_time());
      });
    }
    refuse_without_box();
  }
  std::vector<double> positions_of(std::span<const Point_id> ids,
                                   std::span<const Lattice_offset_2> offsets) const override;

  // ---- time ----

  std::optional<Time> next_event_time() override;
  std::size_t step(const Time* until) override {
    return until != nullptr ? core_->step(*until) : core_->step();
  }
  std::size_t advance_to(const Time& time, const std::function<bool()>& may_go_on) override {
    return core_->advance_to(time, may_go_on);
  }
  void check_can_advance_to(const Time& time) const override {
    KINETRI_PRECONDITION(time >= current_time(),
                         "the time to advance to is in the past; take the present one or a later "
                         "one");
    if constexpr (is_periodic) kinetic().traits().box().require_area(current_time(), time);
  }
  std::size_t threads() const override { return threads_; }
  void set_threads(std::size_t most) override {
    threads_ = most;
    core_->set_threads(most);
  }
  std::size_t reverse() override {
    if constexpr (!is_simulation) return core_->reverse();
    refuse(
        "a simulation cannot run backwards, since contacts forget what was before them; "
        "expected a KineticDelaunay or KineticRegular");
  }

  // ---- changes ----

  Point_id insert(const Motion_columns& motions, std::span<const double> masses) override;
  void erase(std::span<const Point_id> ids) override;
  void set_motions(std::span<const Point_id> ids, const Motion_columns& motions) override {
    check_motions(motions);
    core_->set_motions(ids, motions_of<Motion>(motions));
  }
  void set_velocities(std::span<const Point_id> ids, std::span<const double> velocities) override;
  void set_positions(std::span<const Point_id> ids, std::span<const double> positions) override;
  void set_masses(std::span<const Point_id> ids, std::span<const double> masses) override;
  Point_id schedule_insert(const Time& time, const Motion_columns& motion, double mass) override {
    if constexpr (is_simulation) {
      return core_->schedule_insert(time, motion_as<Motion>(motion[0]), mass);
    }
    refuse_schedule();
  }
  void schedule_motion(const Time& time, Point_id id, const Motion_columns& motion) override {
    if constexpr (is_simulation) {
      return core_->schedule_motion(time, id, motion_as<Motion>(motion[0]));
    }
    refuse_schedule();
  }
  void schedule_erase(const Time& time, Point_id id) override {
    if constexpr (is_simulation) return core_->schedule_erase(time, id);
    refuse_schedule();
  }

  // ---- watching ----

  void add_observer(Event_observer& observer) override { core_->add_observer(observer); }
  void remove_observer(Event_observer& observer) override { core_->remove_observer(observer); }
  std::unique_ptr<Event_observer> recorder(double until, std::size_t most_rows) override {
    if constexpr (!is_periodic) {
      return std::make_unique<Recorder<Traits>>(kinetic(), until, most_rows);
    }
    refuse_in_box("the pages of runs");
  }
  Recording recording(const Event_observer& recorder) const override {
    if constexpr (!is_periodic) return dynamic_cast<const Recorder<Traits>&>(recorder).recording();
    refuse_in_box("the pages of runs");
  }

  std::unique_ptr<Watch> watch(const Question& question) override {
    return python::watch(*core_, question);
  }

  // ---- answers ----

  std::optional<Periodic_image> nearest_vertex(const Vector_2& place) const override;
  Location locate(const Vector_2& place) const override {
    auto [kind, points] = queries().locate(place);
    return {kind, images_of(std::move(points))};
  }
  Images neighbors(Point_id id) const override { return images_of(queries().neighbors(id)); }
  Cell voronoi_cell(Point_id id) const override;
  std::vector<double> voronoi_areas(std::span<const Vector_2> polygon) const override {
    if constexpr (is_periodic) {
      if (!polygon.empty()) refuse_in_box("areas within a polygon");
      return queries().rounded_voronoi_areas();
    } else {
      return queries().rounded_voronoi_areas(polygon);
    }
  }
  std::vector<Cell_area> cell_areas(const Cell_limits& limits) const override {
    return kinetri::cell_areas(kinetic(), limits);
  }
  std::vector<Edge_ids> gabriel_edges() const override {
    if constexpr (has_proximity_graphs) return kinetri::gabriel_edges(kinetic());
    refuse_graphs();
  }
  std::vector<Edge_ids> relative_neighbor_edges() const override {
    if constexpr (has_proximity_graphs) return kinetri::relative_neighbor_edges(kinetic());
    refuse_graphs();
  }
  Images nearest_neighbors(std::optional<std::size_t> k) const override {
    if constexpr (HasNearestNeighbors<Traits>) {
      return images_of(k ? queries().nearest_neighbors(*k) : queries().nearest_neighbors());
    }
    refuse_distances();
  }
  std::optional<Periodic_edge> closest_pair() const override;
  std::vector<double> positions() const override {
    if constexpr (is_periodic) {
      return positions_by_id(
          [this](Point_id id) { return Image_motion_2{center(kinetic().motion(id))}; });
    } else {
      return queries().rounded_positions();
    }
  }
  std::vector<double> velocities() const override;
  std::vector<double> radii() const override;

  // ---- state ----

  Audit_report audit(Audit_level level) const override { return core_->audit(level); }
  Statistics statistics() const override;
  Simulation_options options() const override {
    if constexpr (is_simulation) {
      return core_->options();
    } else {
      return {};
    }
  }
  Checkpoint snapshot() const override;

 private:
  const Kinetic& kinetic() const {
    if constexpr (is_simulation) {
      return core_->triangulation();
    } else {
      return *core_;
    }
  }
  template <class Triangulation>
  static std::vector<Point_id> hull_of(const Triangulation& triangulation);
  auto queries() const {
    if constexpr (is_periodic) {
      return Periodic_queries_2(kinetic());
    } else {
      return Kinetic_queries_2<Traits>(kinetic());
    }
  }
  static Images images_of(std::vector<Point_id> points) { return {std::move(points)}; }
  static Images images_of(const std::vector<Periodic_image>& images);
  /// By id, NaN if there is no point: x and y of the image that `image` gives.
  template <class Image_of_point>
  std::vector<double> positions_by_id(const Image_of_point& image) const;
  static void check_motions(const Motion_columns& motions) {
    if (is_periodic && (motions.accelerations != nullptr || motions.jerks != nullptr)) {
      refuse_in_box("acceleration and jerk");
    }
  }

  [[noreturn]] static void refuse(const char* message) { throw Precondition_error(message); }
  [[noreturn]] static void refuse_in_box(const std::string& what) {
    throw Precondition_error(what + (what.back() == 's' ? " are" : " is") +
                             " not possible in a periodic box");
  }
  [[noreturn]] static void refuse_without_box() {
    refuse("offsets are of images; expected an object in a periodic box");
  }
  [[noreturn]] static void refuse_schedule() {
    refuse("a triangulation has no scheduled changes; expected a Simulation");
  }
  static constexpr bool has_proximity_graphs = HasNearestNeighbors<Traits> && !is_periodic;
  [[noreturn]] static void refuse_graphs() {
    if (is_periodic) refuse_in_box("proximity graphs");
    refuse_distances();
  }
  [[noreturn]] static void refuse_distances() {
    refuse(
        "the edges of a regular triangulation do not know which points are nearest to each "
        "other; expected points without radii of their own");
  }

  const std::unique_ptr<Core<Traits>> core_;
  std::size_t threads_ = 0;
};

// ---- the present ----

template <template <class> class Core, class Traits>
std::vector<Triangle_ids> Engine_of<Core, Traits>::triangles() const {
  std::vector<Triangle_ids> result;
  if constexpr (is_periodic) {
    for (const auto& [a, b, c] : periodic_triangles()) result.push_back({a.id, b.id, c.id});
    return result;
  } else {
    const auto& triangulation = kinetic().triangulation();
    if (triangulation.dimension() < 2) return result;
    result.reserve(2 * kinetic().number_of_points());
    for (const auto& face : triangulation.finite_face_handles()) {
      result.push_back(triangle_ids(face->vertex(0)->point().id(), face->vertex(1)->point().id(),
                                    face->vertex(2)->point().id()));
    }
    std::ranges::sort(result);
    return result;
  }
}

template <template <class> class Core, class Traits>
std::vector<Point_id> Engine_of<Core, Traits>::hull() const {
  if constexpr (!is_periodic) return hull_of(kinetic().triangulation());
  refuse_in_box("a convex hull");
}

template <template <class> class Core, class Traits>
template <class Triangulation>
std::vector<Point_id> Engine_of<Core, Traits>::hull_of(const Triangulation& triangulation) {
  std::vector<Point_id> result;
  if (triangulation.dimension() == 2) {
    // Around the infinite vertex the hull is seen from outside: clockwise.
    const auto first = triangulation.incident_vertices(triangulation.infinite_vertex());
    auto v = first;
    do {
      result.push_back(v->point().id());
    } while (--v != first);
  } else if (triangulation.dimension() == 1) {
    // Along the line, from one of its two ends, which have infinite edges.
    auto face = triangulation.infinite_vertex()->face();
    const auto infinite = triangulation.infinite_vertex();
    auto v = face->vertex(1 - face->index(infinite));
    while (v != infinite) {
      result.push_back(v->point().id());
      face = face->neighbor(1 - face->index(v));
      v = face->vertex(1 - face->index(v));
    }
    if (result.front() > result.back()) std::ranges::reverse(result);
    return result;
  } else {
    for (const auto& v : triangulation.finite_vertex_handles()) {
      result.push_back(v->point().id());
    }
  }
  std::rotate(result.begin(), std::min_element(result.begin(), result.end()), result.end());
  return result;
}

template <template <class> class Core, class Traits>
std::vector<Point_id> Engine_of<Core, Traits>::hidden_points() const {
  std::vector<Point_id> result;
  if (kinetic().number_of_hidden_points() == 0) return result;
  for (Point_id id = 0; id < next_id(); ++id) {
    if (contains(id) && kinetic().is_hidden(id)) result.push_back(id);
  }
  return result;
}

// ---- the present in a periodic box ----

template <template <class> class Core, class Traits>
std::vector<Periodic_triangle> Engine_of<Core, Traits>::periodic_triangles() const {
  std::vector<Periodic_triangle> result;
  if constexpr (is_periodic) {
    const auto& triangulation = kinetic().triangulation();
    result.reserve(2 * kinetic().number_of_points());
    for (const auto& face : triangulation.finite_face_handles()) {
      const auto corners_from = [&](int first) {
        const auto corner = [&](int i) -> Periodic_image {
          return {face->vertex(i)->point().id(), triangulation.offset(face, first, i)};
        };
        return Periodic_triangle{corner(first), corner((first + 1) % 3), corner((first + 2) % 3)};
      };
      result.push_back(std::min({corners_from(0), corners_from(1), corners_from(2)}));
    }
    std::ranges::sort(result);
    return result;
  }
  refuse_without_box();
}

template <template <class> class Core, class Traits>
template <class Image_of_point>
std::vector<double> Engine_of<Core, Traits>::positions_by_id(const Image_of_point& image) const {
  std::vector<double> result(2 * static_cast<std::size_t>(next_id()),
                             std::numeric_limits<double>::quiet_NaN());
  for (Point_id id = 0; id < next_id(); ++id) {
    if (!contains(id)) continue;
    const Vector_2 position = rounded_position(image(id), current_time());
    result[2 * std::size_t{id}] = position.x;
    result[2 * std::size_t{id} + 1] = position.y;
  }
  return result;
}

template <template <class> class Core, class Traits>
std::vector<double> Engine_of<Core, Traits>::positions_of(
    std::span<const Point_id> ids, std::span<const Lattice_offset_2> offsets) const {
  std::vector<double> result;
  if constexpr (is_periodic) {
    for (std::size_t i = 0; i < ids.size(); ++i) {
      const Image_motion_2 image = {center(kinetic().motion(ids[i])), offsets[i],
                                    &kinetic().traits().box()};
      const Vector_2 position = rounded_position(image, current_time());
      result.insert(result.end(), {position.x, position.y});
    }
    return result;
  }
  refuse_without_box();
}

// ---- time ----

template <template <class> class Core, class Traits>
std::optional<Algebraic_number> Engine_of<Core, Traits>::next_event_time() {
  return core_->next_event_time();
}

// ---- changes ----

template <template <class> class Core, class Traits>
Point_id Engine_of<Core, Traits>::insert(const Motion_columns& motions,
                                         std::span<const double> masses) {
  check_motions(motions);
  const std::vector<Motion> inserted = motions_of<Motion>(motions);
  if constexpr (is_simulation) {
    // If an insertion fails, the earlier ones are undone.
    const Point_id first = next_id();
    try {
      for (std::size_t i = 0; i < inserted.size(); ++i) {
        core_->insert(inserted[i], masses.empty() ? 1 : masses[i]);
      }
    } catch (const Error&) {
      for (Point_id id = next_id(); id-- > first;) {
        if (contains(id)) core_->erase(id);
      }
      throw;
    }
    return first;
  } else {
    return core_->insert(std::span<const Motion>(inserted));
  }
}

template <template <class> class Core, class Traits>
void Engine_of<Core, Traits>::erase(std::span<const Point_id> ids) {
  if constexpr (is_simulation) {
    std::vector<Point_id> sorted(ids.begin(), ids.end());
    std::ranges::sort(sorted);
    KINETRI_PRECONDITION(std::ranges::adjacent_find(sorted) == sorted.end(),
                         "a point is named twice; expected each id once");
    for (const Point_id id : sorted) core_->erase(id);
  } else {
    core_->erase(ids);
  }
}

template <template <class> class Core, class Traits>
void Engine_of<Core, Traits>::set_velocities(std::span<const Point_id> ids,
                                             std::span<const double> velocities) {
  std::vector<Vector_2> vectors;
  vectors.reserve(ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    vectors.push_back({velocities[2 * i], velocities[2 * i + 1]});
  }
  core_->set_velocities(ids, vectors);
}

template <template <class> class Core, class Traits>
void Engine_of<Core, Traits>::set_positions(std::span<const Point_id> ids,
                                            std::span<const double> positions) {
  std::vector<Motion> motions;
  motions.reserve(ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    motions.push_back(
        at_rest_in(kinetic().motion(ids[i]), {positions[2 * i], positions[2 * i + 1]}));
  }
  core_->set_motions(ids, motions);
}

template <template <class> class Core, class Traits>
void Engine_of<Core, Traits>::set_masses(std::span<const Point_id> ids,
                                         std::span<const double> masses) {
  if constexpr (is_simulation) {
    // All or nothing.
    for (std::size_t i = 0; i < ids.size(); ++i) {
      KINETRI_PRECONDITION(masses[i] > 0, "the mass of point " + std::to_string(ids[i]) + " is " +
                                              std::to_string(masses[i]) +
                                              "; expected one greater than 0");
    }
    for (std::size_t i = 0; i < ids.size(); ++i) core_->set_mass(ids[i], masses[i]);
  } else {
    refuse("the points of a triangulation have no masses; expected a Simulation");
  }
}

// ---- answers ----

template <template <class> class Core, class Traits>
Images Engine_of<Core, Traits>::images_of(const std::vector<Periodic_image>& images) {
  Images result;
  auto& offsets = result.offsets.emplace();
  result.ids.reserve(images.size());
  offsets.reserve(images.size());
  for (const auto& [id, offset] : images) {
    result.ids.push_back(id);
    offsets.push_back(offset);
  }
  return result;
}

template <template <class> class Core, class Traits>
std::optional<Periodic_image> Engine_of<Core, Traits>::nearest_vertex(const Vector_2& place) const {
  const auto nearest = queries().nearest_vertex(place);
  if constexpr (is_periodic) {
    return nearest;
  } else {
    if (!nearest) return std::nullopt;
    return Periodic_image{*nearest, {}};
  }
}

template <template <class> class Core, class Traits>
Cell Engine_of<Core, Traits>::voronoi_cell(Point_id id) const {
  auto cell = queries().rounded_voronoi_cell(id);
  if constexpr (is_periodic) {
    auto [ids, offsets] = images_of(cell.neighbors);
    return {{std::move(ids), std::move(cell.vertices), std::nullopt, cell.is_empty},
            std::move(offsets)};
  } else {
    return {std::move(cell)};
  }
}

template <template <class> class Core, class Traits>
std::optional<Periodic_edge> Engine_of<Core, Traits>::closest_pair() const {
  if constexpr (HasNearestNeighbors<Traits>) {
    const auto pair = queries().closest_pair();
    if constexpr (is_periodic) {
      return pair;
    } else {
      if (!pair) return std::nullopt;
      return Periodic_edge{*pair, {}};
    }
  }
  refuse_distances();
}

template <template <class> class Core, class Traits>
std::vector<double> Engine_of<Core, Traits>::velocities() const {
  const double now = current_time().to_double();
  std::vector<double> result(2 * static_cast<std::size_t>(next_id()),
                             std::numeric_limits<double>::quiet_NaN());
  for (Point_id id = 0; id < next_id(); ++id) {
    if (!contains(id)) continue;
    const Vector_2 velocity = rounded_velocity(center(kinetic().motion(id)), now);
    result[2 * std::size_t{id}] = velocity.x;
    result[2 * std::size_t{id} + 1] = velocity.y;
  }
  return result;
}

template <template <class> class Core, class Traits>
std::vector<double> Engine_of<Core, Traits>::radii() const {
  [[maybe_unused]] const double now = current_time().to_double();
  std::vector<double> result(next_id(), std::numeric_limits<double>::quiet_NaN());
  for (Point_id id = 0; id < next_id(); ++id) {
    if (!contains(id)) continue;
    if constexpr (HasWeight<Motion>) {
      result[id] = rounded_radius(kinetic().motion(id), now);
      if constexpr (is_simulation) result[id] = std::max(result[id], 0.0);  // it is not negative
    } else if constexpr (is_simulation) {
      result[id] = core_->options().radius;
    } else {
      result[id] = 0;
    }
  }
  return result;
}

// ---- state ----

template <template <class> class Core, class Traits>
Statistics Engine_of<Core, Traits>::statistics() const {
  const Triangulation_counters& counters = kinetic().counters();
  return {counters.events, core_->certificate_counters(), counters.instants,
          counters.reconstructions};
}

template <template <class> class Core, class Traits>
Checkpoint Engine_of<Core, Traits>::snapshot() const {
  Checkpoint result;
  result.periodic_box = box();
  if constexpr (is_simulation) {
    result.simulation = core_->snapshot();
  } else {
    Simulation_snapshot<Traits> snapshot;
    snapshot.triangulation = core_->snapshot();
    snapshot.options.coincident = core_->coincident();
    result.simulation = std::move(snapshot);
  }
  return result;
}

/// @{
/// An engine of the object.
template <class Traits>
std::unique_ptr<Engine> engine_of(std::unique_ptr<Kinetic_triangulation_2<Traits>> triangulation) {
  return std::make_unique<Engine_of<Kinetic_triangulation_2, Traits>>(std::move(triangulation));
}
template <class Traits>
std::unique_ptr<Engine> engine_of(std::unique_ptr<Simulation_2<Traits>> simulation) {
  return std::make_unique<Engine_of<Simulation_2, Traits>>(std::move(simulation));
}
/// @}

}  // namespace kinetri::python

#endif  // KINETRI_PYTHON_ENGINE_OF_H
