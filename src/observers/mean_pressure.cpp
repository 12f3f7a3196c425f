// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/observers/mean_pressure.h"

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "kinetri/impl/base/check.h"
#include "simulation/shortest_text.h"

namespace kinetri {

namespace detail {
namespace {

// The velocity of the center at time t, relative to the flow of a periodic box; rounded.
template <class Traits, class Motion>
Vector_2 velocity_in_flow(const Traits& traits, const Motion& motion, double t) {
  Vector_2 velocity = rounded_velocity(motion, t);
  if constexpr (PeriodicKineticTraits_2<Traits>) {
    const Vector_2 flow = traits.box().flow_at(rounded_place(motion, t), t);
    velocity = {velocity.x - flow.x, velocity.y - flow.y};
  }
  return velocity;
}

}  // namespace

template <PeriodicKineticTraits_2 Traits>
class Pressure_tracker final : private Event_observer {
 public:
  explicit Pressure_tracker(Simulation_2<Traits>& simulation);
  ~Pressure_tracker() override;
  Pressure_tracker(const Pressure_tracker&) = delete;
  Pressure_tracker& operator=(const Pressure_tracker&) = delete;

  Pressure_2 next();

 private:
  using Center_motion = Center_motion_of<typename Traits::Motion>;

  struct Flight {  // of a disc, since its last change or the start of the interval
    bool is_there = false;
    double mass = 1;
    double since = 0;
    Center_motion motion = {};
  };

  void after_event(const Event& event) override;
  void restart(Point_id id, double time);
  void add_flight(const Flight& flight, double until);
  double area_at(double time) const;

  Simulation_2<Traits>& simulation_;
  std::vector<Flight> flights_;  // by id
  Pressure_2 sums_;              // of the interval: integrals over time in place of means
};

template <PeriodicKineticTraits_2 Traits>
Pressure_tracker<Traits>::Pressure_tracker(Simulation_2<Traits>& simulation)
    : simulation_(simulation) {
  sums_.from = simulation.current_time().to_double();
  for (Point_id id = 0; id < simulation.triangulation().next_id(); ++id) restart(id, sums_.from);
  simulation.add_observer(*this);
}

template <PeriodicKineticTraits_2 Traits>
Pressure_tracker<Traits>::~Pressure_tracker() {
  simulation_.remove_observer(*this);
}

// A flight of the point as it is now, or none.
template <PeriodicKineticTraits_2 Traits>
void Pressure_tracker<Traits>::restart(Point_id id, double time) {
  if (id >= flights_.size()) flights_.resize(id + 1);
  const auto& triangulation = simulation_.triangulation();
  flights_[id] = {};
  if (!triangulation.contains(id)) return;
  flights_[id] = {true, simulation_.mass(id), time, center(triangulation.motion(id))};
}

template <PeriodicKineticTraits_2 Traits>
Pressure_2 Pressure_tracker<Traits>::next() {
  const double now = simulation_.current_time().to_double();
  KINETRI_PRECONDITION(now > sums_.from, "the interval from t = " + text(sums_.from) +
                                             " on is empty; advance the time before the next call");
  for (Point_id id = 0; id < flights_.size(); ++id) {
    add_flight(flights_[id], now);
    restart(id, now);
  }
  Pressure_2 result = std::exchange(sums_, {.from = now});
  result.until = now;
  result.energy = kinetic_energy(simulation_);
  const double duration = now - result.from;
  for (double* sum : {&result.xx, &result.xy, &result.yy}) *sum /= duration;
  return result;
}

template <PeriodicKineticTraits_2 Traits>
void Pressure_tracker<Traits>::after_event(const Event& event) {
  if (!event.point_a) return;  // a flip
  const double time = event.time.to_double();
  const Point_id a = *event.point_a;
  if (a >= flights_.size()) restart(a, time);  // inserted
  const Flight before_a = flights_[a];
  add_flight(before_a, time);
  restart(a, time);
  if (event.kind != Event_kind::collision) return;
  const Point_id b = *event.point_b;
  const Flight before_b = flights_[b];
  add_flight(before_b, time);
  restart(b, time);
  ++sums_.collisions;
  const Flight& after_a = flights_[a];
  const Flight& after_b = flights_[b];
  if (!after_a.is_there || !after_b.is_there) return;
  const Periodic_box_2& box = simulation_.triangulation().traits().box();
  const Vector_2 place_a = rounded_place(before_a.motion, time);
  const Vector_2 place_b = rounded_place(image_of(before_b.motion, event.added_offset, &box), time);
  const Vector_2 r = {place_b.x - place_a.x, place_b.y - place_a.y};
  const auto momentum = [](const Flight& before, const Flight& after, auto component) {
    return after.mass * (after.motion.velocity.*component - before.motion.velocity.*component);
  };
  const Vector_2 q = {
      (momentum(before_b, after_b, &Vector_2::x) - momentum(before_a, after_a, &Vector_2::x)) / 2,
      (momentum(before_b, after_b, &Vector_2::y) - momentum(before_a, after_a, &Vector_2::y)) / 2};
  const double area = area_at(time);
  sums_.xx += q.x * r.x / area;
  sums_.xy += (q.x * r.y + q.y * r.x) / 2 / area;
  sums_.yy += q.y * r.y / area;
}

// Adds the integral of m u u^T / area over the flight, by Simpson's rule: with a constant area the
// integrand is a polynomial of degree 2 at most.
template <PeriodicKineticTraits_2 Traits>
void Pressure_tracker<Traits>::add_flight(const Flight& flight, double until) {
  const double duration = until - flight.since;
  if (!flight.is_there || duration <= 0) return;
  for (const auto& [time, weight] : {std::pair(flight.since, duration / 6),
                                     {flight.since + duration / 2, duration / 6 * 4},
                                     {until, duration / 6}}) {
    const auto [x, y] = velocity_in_flow(simulation_.triangulation().traits(), flight.motion, time);
    const double factor = weight * flight.mass / area_at(time);
    sums_.xx += factor * x * x;
    sums_.xy += factor * x * y;
    sums_.yy += factor * y * y;
  }
}

// The area of the box, rounded.
template <PeriodicKineticTraits_2 Traits>
double Pressure_tracker<Traits>::area_at(double time) const {
  const Periodic_box_2& box = simulation_.triangulation().traits().box();
  const Vector_2 first = rounded_place(box.first(), time);
  const Vector_2 second = rounded_place(box.second(), time);
  return first.x * second.y - first.y * second.x;
}

}  // namespace detail

template <PeriodicKineticTraits_2 Traits>
Mean_pressure<Traits>::Mean_pressure(Simulation_2<Traits>& simulation)
    : tracker_(std::make_unique<detail::Pressure_tracker<Traits>>(simulation)) {}

template <PeriodicKineticTraits_2 Traits>
Mean_pressure<Traits>::~Mean_pressure() = default;

template <PeriodicKineticTraits_2 Traits>
Pressure_2 Mean_pressure<Traits>::next() {
  return tracker_->next();
}

template class Mean_pressure<Periodic_kinetic_traits_2>;
template class Mean_pressure<Periodic_disc_kinetic_traits_2>;

template <class Traits>
double kinetic_energy(const Simulation_2<Traits>& simulation) {
  const auto& triangulation = simulation.triangulation();
  const double now = simulation.current_time().to_double();
  double sum = 0;
  for (Point_id id = 0; id < triangulation.next_id(); ++id) {
    if (!triangulation.contains(id)) continue;
    const auto [x, y] =
        detail::velocity_in_flow(triangulation.traits(), triangulation.motion(id), now);
    sum += simulation.mass(id) * (x * x + y * y) / 2;
  }
  return sum;
}

template <class Traits>
void set_kinetic_energy(Simulation_2<Traits>& simulation, double energy) {
  const auto& triangulation = simulation.triangulation();
  const double before = kinetic_energy(simulation);
  KINETRI_PRECONDITION(
      std::isfinite(energy) && energy >= 0,
      "the energy is " + detail::text(energy) + "; expected a finite number that is not negative");
  KINETRI_PRECONDITION(std::isfinite(before) && before > 0,
                       "the kinetic energy is " + detail::text(before) +
                           ", so that no factor changes it to another one; expected points that "
                           "move, and numbers near 1, in other units perhaps");
  const double change = std::sqrt(energy / before) - 1;
  if (change == 0) return;
  const double now = simulation.current_time().to_double();
  std::vector<Point_id> ids;
  std::vector<Vector_2> velocities;
  for (Point_id id = 0; id < triangulation.next_id(); ++id) {
    if (!triangulation.contains(id)) continue;
    const auto& motion = triangulation.motion(id);
    const Vector_2 velocity = rounded_velocity(motion, now);
    const auto [x, y] = detail::velocity_in_flow(triangulation.traits(), motion, now);
    ids.push_back(id);
    velocities.push_back({velocity.x + change * x, velocity.y + change * y});
  }
  simulation.set_velocities(ids, velocities);
}

#define KINETRI_INSTANTIATE(Traits)                            \
  template double kinetic_energy(const Simulation_2<Traits>&); \
  template void set_kinetic_energy(Simulation_2<Traits>&, double)
KINETRI_INSTANTIATE(Linear_kinetic_traits_2);
KINETRI_INSTANTIATE(Polynomial_kinetic_traits_2);
KINETRI_INSTANTIATE(Disc_kinetic_traits_2);
KINETRI_INSTANTIATE(Polynomial_disc_kinetic_traits_2);
KINETRI_INSTANTIATE(Periodic_kinetic_traits_2);
KINETRI_INSTANTIATE(Periodic_disc_kinetic_traits_2);
#undef KINETRI_INSTANTIATE

}  // namespace kinetri
