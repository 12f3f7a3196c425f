// SPDX-License-Identifier: GPL-3.0-or-later
//
// The module for JavaScript: plain functions over a simulation of points that are read as
// `kinetri simulate` reads them. live/kinetri.mjs is its only caller.
//
// Results that are no number are in one of three buffers, `text`, `ids` and `numbers`, until the
// next call. A function that fails returns null or -1, and the message is in `text`.
#include <emscripten/emscripten.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "kinetri/impl/io/json_writer.h"
#include "kinetri/impl/io/text.h"
#include "kinetri/io/event_log.h"
#include "kinetri/io/motion_log.h"
#include "kinetri/io/viewer_page.h"
#include "kinetri/simulation/recording.h"
#include "sources/any_simulation.h"
#include "sources/points_source.h"

#define KINETRI_EXPORT extern "C" EMSCRIPTEN_KEEPALIVE

namespace {

using namespace kinetri;

std::string text;
std::vector<std::uint32_t> ids;
std::vector<double> numbers;

constexpr std::size_t steps_for_clock = 16;  // after which it is looked at
constexpr double not_there = std::numeric_limits<double>::quiet_NaN();

template <class Motion>
constexpr bool has_acceleration = requires(Motion motion) {
  motion.acceleration;
};

// Gives the motion this acceleration, which does not change in time.
template <class Motion>
void accelerate(Motion& motion, const Vector_2& acceleration) {
  if constexpr (has_acceleration<Motion>) {
    motion.acceleration = acceleration;
    motion.jerk = {};
  } else if (acceleration != Vector_2{}) {
    throw Precondition_error(
        "the points have no accelerations; expected 0, or points that are made with accelerations");
  }
}

// The point with the numbers, with as many of them as the kind of motion has.
template <class Motion>
Motion motion_of(const Vector_2& position, const Vector_2& velocity, double radius,
                 const Vector_2& acceleration, double epoch) {
  Motion motion;
  motion.position = position;
  motion.velocity = velocity;
  motion.epoch = epoch;
  accelerate(motion, acceleration);
  if constexpr (HasWeight<Motion>) motion.radius = radius;
  return motion;
}

struct Engine {
  app::Any_simulation simulation;
  std::ostringstream event_text;
  std::ostringstream motion_text;
  std::vector<std::unique_ptr<Event_observer>> logs;
  std::unique_ptr<Event_observer> recorder;
  std::function<Recording()> take_recording;  // empty: it is not recorded
  std::size_t capacity = 0;                   // of point ids, while it is recorded
};

template <class Result, class Function>
Result guarded(Result failure, Function function) {
  try {
    return function();
  } catch (const std::exception& error) {
    text = error.what();
    return failure;
  }
}

template <class Function>
int change(Engine& engine, Function function) {
  return guarded(-1, [&] {
    return engine.simulation.visit([&](auto& simulation) {
      function(simulation);
      return 0;
    });
  });
}

void take(std::ostringstream& stream) {
  text = stream.str();
  stream.str("");
}

// The first event that is observed.
class First_event : public Event_observer {
 public:
  bool looks_at_triangulation() const override { return false; }
  void after_event(const Event& event) override {
    if (!event_) event_ = event;
  }
  const std::optional<Event>& event() const { return event_; }

 private:
  std::optional<Event> event_;
};

void write(Json_writer& json, std::string_view key, const std::optional<Edge_ids>& edge) {
  json.key(key);
  if (!edge) return json.null();
  json.begin_list();
  for (const Point_id id : *edge) json.value(id);
  json.end_list();
}

// The coefficients of the polynomial of which the time is a root: [c0, c1, ...]; of a rational
// time, of one of degree 1.
void write_polynomial(Json_writer& json, const Algebraic_number& time) {
  json.key("polynomial");
  json.begin_list();
  if (time.is_known_rational()) {
    const Rational value = time.rational();
    json.value(Integer(-numerator(value)).str());
    json.value(Integer(denominator(value)).str());
  } else {
    const Polynomial polynomial = time.polynomial();
    for (const Integer& coefficient : polynomial.coefficients()) {
      json.value(coefficient.str());
    }
  }
  json.end_list();
}

void write(const Event& event) {
  text.clear();
  Json_writer json(text);
  const Double_interval bounds = event.time.tight_interval();
  json.begin_object();
  json.member("kind", name(event.kind));
  json.member("time", event.time.to_double());
  json.member("lower", bounds.lower);
  json.member("upper", bounds.upper);
  write_polynomial(json, event.time);
  write(json, "removed", event.removed);
  write(json, "added", event.added);
  json.key("points");
  json.begin_list();
  for (const auto& point : {event.point_a, event.point_b}) {
    if (point) json.value(*point);
  }
  json.end_list();
  json.end_object();
}

template <class Simulation, class Function>
void for_each_id(const Simulation& simulation, Function function) {
  const auto& triangulation = simulation.triangulation();
  const double time = simulation.current_time().to_double();
  numbers.clear();
  for (Point_id id = 0; id < triangulation.next_id(); ++id) {
    function(triangulation, id, time);
  }
}

}  // namespace

// ---- memory ----

KINETRI_EXPORT void* kinetri_allocate(std::size_t bytes) {
  return std::malloc(bytes);
}
KINETRI_EXPORT void kinetri_release(void* memory) {
  std::free(memory);
}
KINETRI_EXPORT const char* kinetri_text() {
  return text.data();
}
KINETRI_EXPORT std::size_t kinetri_text_size() {
  return text.size();
}
KINETRI_EXPORT const std::uint32_t* kinetri_ids() {
  return ids.data();
}
KINETRI_EXPORT std::size_t kinetri_ids_size() {
  return ids.size();
}
KINETRI_EXPORT const double* kinetri_numbers() {
  return numbers.data();
}
KINETRI_EXPORT std::size_t kinetri_numbers_size() {
  return numbers.size();
}

// ---- the start ----

// `points` is the text of a file of points. `box` is null or has four numbers; `radius` is negative
// if there is none; `collisions` is an index in `named_responses`.
KINETRI_EXPORT Engine* kinetri_open(const char* points, std::size_t size, const double* box,
                                    double radius, int collisions, bool rim_touches,
                                    bool is_regular, bool exact_only) {
  return guarded<Engine*>(nullptr, [&] {
    app::Points_settings settings;
    settings.points = "points";
    settings.text.emplace(points, size);
    settings.until = 0;  // the end is not known
    if (box != nullptr) settings.box = Box_2{box[0], box[1], box[2], box[3]};
    if (radius >= 0) settings.radius = radius;
    settings.collisions = named_responses[static_cast<std::size_t>(collisions)];
    settings.rim_touches = rim_touches;
    settings.is_regular = is_regular;
    const auto source = app::points_source(settings);
    source->read();
    auto engine = std::make_unique<Engine>();
    engine->simulation =
        source->make_simulation(exact_only ? Arithmetic::exact_only : Arithmetic::filtered);
    return engine.release();
  });
}
KINETRI_EXPORT void kinetri_close(Engine* engine) {
  delete engine;
}
// The index of a response to contacts; -1 if there is none of that name.
KINETRI_EXPORT int kinetri_response(const char* name) {
  const auto found = std::ranges::find(named_responses, name, &Named_response::name);
  return found == named_responses.end() ? -1 : static_cast<int>(found - named_responses.begin());
}

// ---- time ----

KINETRI_EXPORT double kinetri_time(const Engine* engine) {
  return engine->simulation.visit([](auto& s) { return s.current_time().to_double(); });
}
// Returns 1 if it has arrived, 0 if the milliseconds were not enough.
KINETRI_EXPORT int kinetri_advance(Engine* engine, double time, double milliseconds) {
  return guarded(-1, [&] {
    using Clock = std::chrono::steady_clock;
    const auto end = Clock::now() + std::chrono::duration<double, std::milli>(milliseconds);
    bool arrives = true;
    std::size_t asked = 0;  // the clock, which is that of JavaScript, is slow
    engine->simulation.visit([&](auto& s) {
      if (!(milliseconds < std::numeric_limits<double>::infinity())) return s.advance_to(time);
      return s.advance_to(
          time, [&] { return arrives = asked++ % steps_for_clock != 0 || Clock::now() < end; });
    });
    return arrives ? 1 : 0;
  });
}
KINETRI_EXPORT int kinetri_step(Engine* engine) {
  return guarded(-1, [&] {
    return engine->simulation.visit([](auto& s) { return static_cast<int>(s.step()); });
  });
}
// Returns 1 with the event as JSON, or 0 if there is none. Found by a copy of the simulation.
KINETRI_EXPORT int kinetri_next_event(const Engine* engine) {
  return guarded(-1, [&] {
    return engine->simulation.visit([]<class Traits>(const Simulation_2<Traits>& s) {
      auto copy = Simulation_2<Traits>::restore(s.snapshot(), s.options().response,
                                                s.triangulation().traits());
      First_event first;
      copy.add_observer(first);
      copy.step();
      if (!first.event()) return 0;
      write(*first.event());
      return 1;
    });
  });
}

// ---- the present ----

KINETRI_EXPORT std::size_t kinetri_points(const Engine* engine) {
  return engine->simulation.visit([](auto& s) { return s.triangulation().number_of_points(); });
}
// x and y of each point by id.
KINETRI_EXPORT void kinetri_positions(const Engine* engine) {
  engine->simulation.visit([](auto& s) {
    for_each_id(s, [](const auto& triangulation, Point_id id, double time) {
      Vector_2 place = {not_there, not_there};
      if (triangulation.contains(id)) place = rounded_place(triangulation.motion(id), time);
      numbers.insert(numbers.end(), {place.x, place.y});
    });
    return 0;
  });
}
KINETRI_EXPORT void kinetri_velocities(const Engine* engine) {
  engine->simulation.visit([](auto& s) {
    for_each_id(s, [](const auto& triangulation, Point_id id, double time) {
      Vector_2 velocity = {not_there, not_there};
      if (triangulation.contains(id)) velocity = rounded_velocity(triangulation.motion(id), time);
      numbers.insert(numbers.end(), {velocity.x, velocity.y});
    });
    return 0;
  });
}
KINETRI_EXPORT void kinetri_accelerations(const Engine* engine) {
  engine->simulation.visit([](auto& s) {
    for_each_id(s, [](const auto& triangulation, Point_id id, double time) {
      Vector_2 acceleration = {not_there, not_there};
      if (triangulation.contains(id)) {
        const auto& motion = triangulation.motion(id);
        acceleration = {};
        if constexpr (has_acceleration<std::remove_cvref_t<decltype(motion)>>) {
          const double elapsed = time - motion.epoch;
          acceleration = {motion.acceleration.x + elapsed * motion.jerk.x,
                          motion.acceleration.y + elapsed * motion.jerk.y};
        }
      }
      numbers.insert(numbers.end(), {acceleration.x, acceleration.y});
    });
    return 0;
  });
}
KINETRI_EXPORT void kinetri_radii(const Engine* engine) {
  engine->simulation.visit([]<class Traits>(const Simulation_2<Traits>& s) {
    for_each_id(s, [&](const auto& triangulation, Point_id id, double time) {
      double radius = not_there;
      if (triangulation.contains(id)) {
        radius = s.options().radius;
        if constexpr (HasWeight<typename Traits::Motion>) {
          radius = rounded_radius(triangulation.motion(id), time);
        }
      }
      numbers.push_back(radius);
    });
    return 0;
  });
}
KINETRI_EXPORT void kinetri_masses(const Engine* engine) {
  engine->simulation.visit([](auto& s) {
    for_each_id(s, [&](const auto& triangulation, Point_id id, double) {
      numbers.push_back(triangulation.contains(id) ? s.mass(id) : not_there);
    });
    return 0;
  });
}
// The ends of the edges, sorted.
KINETRI_EXPORT void kinetri_edges(const Engine* engine) {
  engine->simulation.visit([](auto& s) {
    ids.clear();
    for (const auto& [a, b] : s.triangulation().finite_edge_ids()) ids.insert(ids.end(), {a, b});
    return 0;
  });
}
// The corners of the triangles, counterclockwise, the least id first, sorted.
KINETRI_EXPORT void kinetri_triangles(const Engine* engine) {
  engine->simulation.visit([](auto& s) {
    std::vector<Triangle_ids> triangles;
    for (const auto face : s.triangulation().triangulation().finite_face_handles()) {
      const auto id = [face](int i) { return face->vertex(i)->point().id(); };
      triangles.push_back(triangle_ids(id(0), id(1), id(2)));
    }
    std::ranges::sort(triangles);
    ids.clear();
    for (const Triangle_ids& corners : triangles) {
      ids.insert(ids.end(), corners.begin(), corners.end());
    }
    return 0;
  });
}
// Counts so far: events; certificates decided by the filter, and exactly.
KINETRI_EXPORT void kinetri_counters(const Engine* engine) {
  engine->simulation.visit([](auto& s) {
    const Certificate_counters certificates = s.certificate_counters();
    numbers = {static_cast<double>(s.triangulation().counters().number_of_events()),
               static_cast<double>(certificates.filter_decided),
               static_cast<double>(certificates.exact_decided)};
    return 0;
  });
}
// The failures of an audit, a line each; empty if it passes.
KINETRI_EXPORT int kinetri_audit(const Engine* engine) {
  return guarded(-1, [&] {
    return engine->simulation.visit([](auto& s) {
      std::string failures;
      for (const std::string& failure : s.audit(Audit_level::certificates).failures) {
        append(failures, failure, "\n");
      }
      text = failures;
      return text.empty() ? 1 : 0;
    });
  });
}

// ---- changes ----

KINETRI_EXPORT int kinetri_set_velocities(Engine* engine, const std::uint32_t* points,
                                          std::size_t count, const double* velocities) {
  return change(*engine, [&](auto& s) {
    std::vector<Vector_2> vectors;
    for (std::size_t i = 0; i < count; ++i) {
      vectors.push_back({velocities[2 * i], velocities[2 * i + 1]});
    }
    s.set_velocities(std::span(points, count), vectors);
  });
}
// From these positions on, with these velocities; and with these accelerations, if not null.
KINETRI_EXPORT int kinetri_set_motions(Engine* engine, const std::uint32_t* points,
                                       std::size_t count, const double* positions,
                                       const double* velocities, const double* accelerations) {
  return change(*engine, [&]<class Traits>(Simulation_2<Traits>& s) {
    const double now = s.current_time().to_double();
    std::vector<typename Traits::Motion> motions;
    for (std::size_t i = 0; i < count; ++i) {
      if (!s.triangulation().contains(points[i])) {
        throw Precondition_error(joined("there is no point ", points[i]));
      }
      const Vector_2 place = {positions[2 * i], positions[2 * i + 1]};
      const Vector_2 velocity = {velocities[2 * i], velocities[2 * i + 1]};
      auto motion = with_velocity_at(s.triangulation().motion(points[i]), velocity, now);
      motion.position = place;
      if (accelerations != nullptr) {
        accelerate(motion, {accelerations[2 * i], accelerations[2 * i + 1]});
      }
      motions.push_back(motion);
    }
    s.set_motions(std::span(points, count), motions);
  });
}
KINETRI_EXPORT int kinetri_set_mass(Engine* engine, std::uint32_t point, double mass) {
  return change(*engine, [&](auto& s) { s.set_mass(point, mass); });
}
// The id of the point.
KINETRI_EXPORT double kinetri_insert(Engine* engine, double x, double y, double vx, double vy,
                                     double radius, double ax, double ay) {
  return guarded(-1.0, [&] {
    return engine->simulation.visit([&]<class Traits>(Simulation_2<Traits>& s) {
      const double now = s.current_time().to_double();
      return static_cast<double>(
          s.insert(motion_of<typename Traits::Motion>({x, y}, {vx, vy}, radius, {ax, ay}, now)));
    });
  });
}
KINETRI_EXPORT int kinetri_erase(Engine* engine, std::uint32_t point) {
  return change(*engine, [&](auto& s) { s.erase(point); });
}

// ---- what is written down ----

// From now on the lines of the event log.
KINETRI_EXPORT void kinetri_log_events(Engine* engine) {
  engine->simulation.visit([&](auto& s) {
    engine->logs.push_back(std::make_unique<Event_log_writer>(engine->event_text));
    s.add_observer(*engine->logs.back());
    return 0;
  });
}
// From now on the lines of the motion log, the present motions first.
KINETRI_EXPORT void kinetri_log_motions(Engine* engine) {
  engine->simulation.visit([&]<class Traits>(Simulation_2<Traits>& s) {
    engine->logs.push_back(std::make_unique<Motion_log_writer<Traits>>(
        engine->motion_text, s.triangulation(), s.options().radius));
    s.add_observer(*engine->logs.back());
    return 0;
  });
}
// What has been logged since the last call.
KINETRI_EXPORT void kinetri_take_events(Engine* engine) {
  take(engine->event_text);
}
KINETRI_EXPORT void kinetri_take_motions(Engine* engine) {
  take(engine->motion_text);
}
// Begins the recording for the viewer, anew if there is one; there may be up to `capacity` ids.
KINETRI_EXPORT void kinetri_record(Engine* engine, std::size_t capacity) {
  engine->capacity = capacity;
  engine->simulation.visit([&]<class Traits>(Simulation_2<Traits>& s) {
    if (engine->recorder) s.remove_observer(*engine->recorder);
    auto recorder = std::make_unique<Recorder<Traits>>(
        s.triangulation(), s.current_time().to_double(), std::numeric_limits<std::size_t>::max());
    s.add_observer(*recorder);
    engine->take_recording = [recorder = recorder.get()] { return recorder->take(); };
    engine->recorder = std::move(recorder);
    return 0;
  });
}
// What has been recorded since the last call, as JSON.
KINETRI_EXPORT int kinetri_take_recording(Engine* engine) {
  return guarded(-1, [&] {
    Viewer_settings settings;
    settings.points = engine->capacity;
    engine->simulation.visit([&](auto& s) {
      settings.box = s.options().box;
      settings.radius = s.options().radius;
      return 0;
    });
    text = viewer_recording(engine->take_recording(), settings);
    return 1;
  });
}
