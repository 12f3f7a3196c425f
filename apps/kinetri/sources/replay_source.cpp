// SPDX-License-Identifier: GPL-3.0-or-later
#include "sources/replay_source.h"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <iostream>
#include <limits>
#include <map>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "kinetri/impl/io/input_text.h"
#include "kinetri/impl/io/text.h"
#include "kinetri/io/event_log.h"
#include "kinetri/io/motion_log.h"
#include "sources/any_simulation.h"

namespace kinetri::app {
namespace {

// A change that was made from outside at one time, possibly of several points: events that follow
// one another.
struct Change {
  double time = 0;
  std::vector<Logged_event> events;  // of one kind; several only of the kind trajectory
};

template <class Motion>
Motion motion_as(const Polynomial_disc_motion_2& disc) {
  const Polynomial_motion_2& center = disc;
  Motion result;
  if constexpr (std::is_base_of_v<Polynomial_motion_2, Motion>) {
    static_cast<Polynomial_motion_2&>(result) = center;
  } else {
    static_cast<Linear_motion_2&>(result) = {center.position, center.velocity, center.epoch};
  }
  if constexpr (HasWeight<Motion>) {
    result.radius = disc.radius;
    result.growth = disc.growth;
  }
  return result;
}

// "event 17 is trajectory".
std::string described(const Logged_event& event) {
  return joined("event ", event.number, " is ", name(event.kind));
}

class Replay_source final : public Run_source {
 public:
  Replay_source(Points_settings settings, std::string events)
      : settings_(std::move(settings)), events_path_(std::move(events)) {}

  std::string path() const override { return settings_.points; }
  std::vector<std::string> other_paths() const override { return {events_path_}; }
  void read() override;
  std::size_t number_of_points() const override { return start_.size(); }
  double from() const override { return settings_.from; }
  std::optional<double> until() const override { return settings_.until; }
  std::string response() const override { return std::string(settings_.collisions.name); }
  Any_simulation make_simulation(Arithmetic arithmetic) const override;
  std::optional<double> next_change() const override;
  void make_change(const Any_simulation& simulation) override;

 private:
  void read_motions();
  void read_events();
  void add_change(const Logged_event& event);
  const Logged_motion* row(const Logged_event& event, Point_id point) const;
  Input_error error(const Logged_event& event, const std::string& message) const;
  Input_error unexpected(const Logged_event& event) const;
  Contact_response_2 response_to(const Contact_2& contact) const;
  Vector_2 velocity_of_image(const Logged_event& event, const Vector_2& velocity,
                             const Vector_2& before) const;
  template <class Simulation>
  void make(Simulation& simulation, const Change& change) const;

  Points_settings settings_;
  std::string events_path_;
  std::vector<Logged_motion> start_;
  std::map<std::uint64_t, std::vector<Logged_motion>> rows_;  // by event
  bool is_polynomial_ = false;
  bool has_different_radii_ = false;
  std::vector<Change> changes_;
  std::size_t next_change_ = 0;
  std::vector<Logged_event> collisions_;
  mutable std::size_t next_collision_ = 0;  // a response is a copy: it changes this through `this`
};

void Replay_source::read() {
  read_motions();
  read_events();
}

void Replay_source::read_motions() {
  std::vector<Logged_motion> rows;
  if (settings_.points == "-") {
    rows = read_motion_log(std::cin, input_name("-"));
  } else {
    std::ifstream in = open_input(settings_.points, "motions");
    rows = read_motion_log(in, settings_.points);
  }
  std::optional<double> radius;
  for (Logged_motion& row : rows) {
    if (row.motion) {
      const auto& motion = *row.motion;
      if (!radius) radius = motion.radius;
      has_different_radii_ = has_different_radii_ || motion.radius != *radius || motion.growth != 0;
      is_polynomial_ =
          is_polynomial_ || motion.acceleration != Vector_2{} || motion.jerk != Vector_2{};
    }
    if (row.event) {
      rows_[*row.event].push_back(row);
      continue;
    }
    if (row.id != start_.size() || !row.motion) {
      throw Input_error(
          input_name(path()), row.line,
          joined("the row without an event is of point ", row.id, "; expected the motion of point ",
                 start_.size(), " at the start of a run"));
    }
    start_.push_back(row);
  }
  if (!settings_.periodic_box || !is_polynomial_) return;
  throw Input_error(input_name(path()), 0,
                    "the points accelerate, but those in a periodic box move on straight lines; "
                    "expected zeros in the columns ax, ay, jx and jy, or no --periodic");
}

void Replay_source::read_events() {
  std::ifstream in = open_input(events_path_, "events");
  for (const Logged_event& event : read_event_log(in, events_path_)) {
    if (!settings_.periodic_box &&
        (event.removed_offset != Lattice_offset_2() || event.added_offset != Lattice_offset_2())) {
      throw error(event,
                  joined(described(event),
                         " of images of points; expected the option --periodic of that run"));
    }
    switch (event.kind) {
      case Event_kind::insert:
      case Event_kind::erase:
      case Event_kind::trajectory:
        add_change(event);
        break;
      case Event_kind::collision:
        collisions_.push_back(event);
        break;
      default:
        break;
    }
  }
}

void Replay_source::add_change(const Logged_event& event) {
  const Logged_motion* const changed = event.point_a ? row(event, *event.point_a) : nullptr;
  if (changed == nullptr || changed->motion.has_value() == (event.kind == Event_kind::erase)) {
    throw error(event, joined(described(event), ", for which ", input_name(path()),
                              " has no row; expected the two logs of one run"));
  }
  const auto [time, upper] = event.time;
  if (time != upper || time < from()) {
    throw error(event,
                joined(described(event), " at a time from ", time, " to ", upper,
                       "; expected a change at one binary64 number, not before --from, ", from()));
  }
  if (event.kind == Event_kind::trajectory && !changes_.empty()) {
    // New motions of several points are one change.
    Change& last = changes_.back();
    const Logged_event& before = last.events.back();
    if (before.kind == event.kind && last.time == time && before.number + 1 == event.number &&
        *before.point_a < *event.point_a) {
      last.events.push_back(event);
      return;
    }
  }
  changes_.push_back({time, {event}});
}

// The row of the point, or null.
const Logged_motion* Replay_source::row(const Logged_event& event, Point_id point) const {
  const auto rows = rows_.find(event.number);
  if (rows == rows_.end()) return nullptr;
  const auto found = std::ranges::find(rows->second, point, &Logged_motion::id);
  return found == rows->second.end() ? nullptr : &*found;
}

Input_error Replay_source::error(const Logged_event& event, const std::string& message) const {
  return Input_error(events_path_, event.line, message);
}

Input_error Replay_source::unexpected(const Logged_event& event) const {
  return error(event, joined(described(event),
                             ", but the run is another one until then; expected both logs of one "
                             "run, and its options"));
}

Any_simulation Replay_source::make_simulation(Arithmetic arithmetic) const {
  Simulation_options options;
  options.box = settings_.box;
  options.rim_touches = settings_.rim_touches;
  options.response = settings_.collisions.response;
  options.coincident = settings_.coincident;
  if (settings_.collisions.response == collide_elastically) {
    options.response = [this](const Contact_2& contact) { return response_to(contact); };
  }
  const bool has_discs = has_different_radii_ || settings_.is_regular;
  if (!has_discs) {
    options.radius = start_.empty() ? 0 : start_.front().motion->radius;
    // Nothing touches points.
    options.rim_touches = options.rim_touches && options.radius > 0;
  }
  const auto of = [&]<class Motion>(Motion) -> Any_simulation {
    std::vector<Motion> motions;
    for (const Logged_motion& row : start_) motions.push_back(motion_as<Motion>(*row.motion));
    const auto make_with = [&]<class Traits>(const Traits& traits) -> Any_simulation {
      return std::make_unique<Simulation_2<Traits>>(motions, options, from(), traits);
    };
#ifndef KINETRI_WITHOUT_PERIODIC_BOXES
    if constexpr (std::same_as<Center_motion_of<Motion>, Linear_motion_2>) {
      if (settings_.periodic_box) {
        return make_with(
            Basic_periodic_kinetic_traits_2<Motion>(*settings_.periodic_box, arithmetic));
      }
    }
#endif
    return make_with(Basic_kinetic_traits_2<Motion>(arithmetic));
  };
  try {
    if (has_discs) {
      return is_polynomial_ ? of(Polynomial_disc_motion_2()) : of(Disc_motion_2());
    }
    return is_polynomial_ ? of(Polynomial_motion_2()) : of(Linear_motion_2());
  } catch (const Outside_box_error& outside) {
    throw Input_error(input_name(path()), start_[outside.point()].line, outside.what());
  } catch (const Periodic_box_error& too_far) {
    throw Input_error(input_name(path()), 0, too_far.what());
  }
}

// As the log says: the velocities after the collision, if it changes them.
Contact_response_2 Replay_source::response_to(const Contact_2& contact) const {
  if (next_collision_ == collisions_.size()) {
    throw Input_error(events_path_, 0,
                      joined("the discs ", contact.point_a, " and ", contact.point_b,
                             " touch at t = ", contact.time,
                             ", after the last collision of the log; expected an --until within "
                             "the run, and its options"));
  }
  const Logged_event& event = collisions_[next_collision_++];
  if (event.point_a != contact.point_a || event.point_b != contact.point_b ||
      contact.time < event.time.lower || contact.time > event.time.upper) {
    throw unexpected(event);
  }
  const auto velocity = [&](Point_id point) -> std::optional<Vector_2> {
    const Logged_motion* const changed = row(event, point);
    if (changed == nullptr || !changed->motion) return std::nullopt;
    return changed->motion->velocity;
  };
  Contact_response_2 result;
  result.velocity_a = velocity(contact.point_a);
  result.velocity_b = velocity(contact.point_b);
  if (settings_.periodic_box && result.velocity_b) {
    result.velocity_b = velocity_of_image(event, *result.velocity_b, contact.velocity_b);
  }
  return result;
}

// A velocity of the image that the first disc touches with which the point gets the velocity of the
// log: that is the velocity of the image less its rate against the point, rounded (Simulation_2).
// It is not `before`, which would be no change.
Vector_2 Replay_source::velocity_of_image(const Logged_event& event, const Vector_2& velocity,
                                          const Vector_2& before) const {
  const Vector_2& first = settings_.periodic_box->first().velocity;
  const Vector_2& second = settings_.periodic_box->second().velocity;
  const auto& [k, l] = event.added_offset;
  const Vector_2 rate = {k * first.x + l * second.x, k * first.y + l * second.y};
  // The numbers near the sum that give the coordinate; the other coordinate may decide.
  const auto candidates = [&](double coordinate, double change) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    std::vector<double> result;
    const double sum = coordinate + change;
    for (const double number :
         {sum, std::nextafter(sum, infinity), std::nextafter(sum, -infinity)}) {
      if (number - change == coordinate) result.push_back(number);
    }
    return result;
  };
  for (const double x : candidates(velocity.x, rate.x)) {
    for (const double y : candidates(velocity.y, rate.y)) {
      if (Vector_2{x, y} != before) return {x, y};
    }
  }
  throw unexpected(event);
}

std::optional<double> Replay_source::next_change() const {
  if (next_change_ == changes_.size()) return std::nullopt;
  const double time = changes_[next_change_].time;
  if (time > *until()) return std::nullopt;
  return time;
}

void Replay_source::make_change(const Any_simulation& simulation) {
  const Change& change = changes_[next_change_++];
  simulation.visit([&](auto& s) { make(s, change); });
}

template <class Simulation>
void Replay_source::make(Simulation& simulation, const Change& change) const {
  using Motion = typename Simulation::Motion;
  const auto& triangulation = simulation.triangulation();
  const Logged_event& first = change.events.front();
  if (triangulation.counters().number_of_events() != first.number) throw unexpected(first);
  std::vector<Point_id> ids;
  std::vector<Motion> motions;
  for (const Logged_event& event : change.events) {
    const Point_id id = *event.point_a;
    const bool is_there = triangulation.contains(id);
    if (event.kind == Event_kind::insert ? id != triangulation.next_id() : !is_there) {
      throw unexpected(event);
    }
    ids.push_back(id);
    if (event.kind != Event_kind::erase) {
      motions.push_back(motion_as<Motion>(*row(event, id)->motion));
    }
  }
  try {
    switch (first.kind) {
      case Event_kind::insert:
        simulation.insert(motions.front());
        break;
      case Event_kind::erase:
        simulation.erase(ids.front());
        break;
      default:
        simulation.set_motions(ids, motions);
    }
  } catch (const Outside_box_error& outside) {
    const auto at = std::ranges::find(ids, outside.point()) - ids.begin();
    throw error(change.events[static_cast<std::size_t>(at)], outside.what());
  }
}

}  // namespace

std::unique_ptr<Run_source> replay_source(const Points_settings& settings,
                                          const std::string& events) {
  return std::make_unique<Replay_source>(settings, events);
}

}  // namespace kinetri::app
