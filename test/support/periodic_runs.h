// SPDX-License-Identifier: GPL-3.0-or-later
//
// Runs of triangulations in periodic boxes: random boxes, faces, what the events tell, and the
// comparison with brute force.
#ifndef KINETRI_TEST_SUPPORT_PERIODIC_RUNS_H
#define KINETRI_TEST_SUPPORT_PERIODIC_RUNS_H

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "kinetri/events/event.h"
#include "kinetri/kinetic/periodic_kinetic_traits_2.h"
#include "kinetri/triangulation/kinetic_triangulation_2.h"
#include "support/multiplier.h"
#include "support/torus_reference.h"

namespace kinetri::test {

__extension__ using Wide = __int128;

inline Periodic_box_2 square(double side) {
  return {{{side, 0}, {0, 0}, 0}, {{0, side}, {0, 0}, 0}};
}

/// Sorted; offsets are against the points as they were given.
template <class Kinetic>
std::vector<Face> faces_of(const Kinetic& kinetic) {
  std::vector<Face> result;
  for (const auto face : kinetic.triangulation().finite_face_handles()) {
    const auto image = [&](int i) -> Image {
      return {face->vertex(i)->point().id(), face->offset(i).x, face->offset(i).y};
    };
    result.push_back(normal_form({image(0), image(1), image(2)}));
  }
  std::ranges::sort(result);
  return result;
}

template <class Kinetic>
std::string audit(const Kinetic& kinetic) {
  const Audit_report report = kinetic.audit(Audit_level::certificates);
  return report.passed() ? "" : report.failures.front();
}

class Random {
 public:
  explicit Random(unsigned seed) : generator_(seed) {}
  int operator()(int least, int greatest) {
    return least + static_cast<int>(generator_() % static_cast<unsigned>(greatest - least + 1));
  }

 private:
  std::mt19937 generator_;
};

/// A box with small integers: at rest, sheared, growing, turning, shrinking.
inline Periodic_box_2 random_box(Random& random, int range) {
  const bool rests = random(0, 3) == 0;
  for (;;) {
    const auto vector = [&] {
      const double x = random(-range, range);
      const double y = random(-range, range);
      const double rate = rests ? 0 : random(-1, 1);
      return Linear_motion_2{{x, y}, {rate, rests ? 0.0 : random(-1, 1)}, 0};
    };
    const Linear_motion_2 a = vector();
    const Linear_motion_2 b = vector();
    const auto& [p, q] = std::pair(a.position, b.position);
    if (p.x * q.y - p.y * q.x > 0) return {a, b};
  }
}

inline std::vector<Linear_motion_2> random_motions(Random& random, int number, int range) {
  std::vector<Linear_motion_2> result;
  for (int i = 0; i < number; ++i) {
    const auto coordinate = [&] { return static_cast<double>(random(-range, range)); };
    const double x = coordinate();
    const double y = coordinate();
    const double vx = coordinate();
    result.push_back({{x, y}, {vx, coordinate()}, 0});
  }
  return result;
}

/// The edges and the hidden points of a triangulation by its events alone.
class Periodic_log : public Event_observer {
 public:
  template <class Kinetic>
  explicit Periodic_log(const Kinetic& kinetic) {
    for (const Periodic_edge& edge : kinetic.periodic_edges()) edges_.insert(edge);
    for (const Point_id id : hidden_points(kinetic)) hidden_.insert(id);
  }

  void after_event(const Event& event) override {
    if (event.removed) {
      EXPECT_EQ(edges_.erase({*event.removed, event.removed_offset}), 1u) << event.number;
    }
    if (event.added) {
      EXPECT_TRUE(edges_.insert({*event.added, event.added_offset}).second) << event.number;
    }
    if (event.kind == Event_kind::hide) {
      EXPECT_TRUE(hidden_.insert(*event.point_a).second) << event.number;
    }
    if (event.kind == Event_kind::reveal) {
      EXPECT_EQ(hidden_.erase(*event.point_a), 1u) << event.number;
    }
    if (event.kind == Event_kind::erase) hidden_.erase(*event.point_a);
  }

  template <class Kinetic>
  static std::vector<Point_id> hidden_points(const Kinetic& kinetic) {
    std::vector<Point_id> result;
    for (Point_id id = 0; id < kinetic.next_id(); ++id) {
      if (kinetic.contains(id) && kinetic.is_hidden(id)) result.push_back(id);
    }
    return result;
  }

  /// What is wrong with what the events have told; empty if nothing is.
  template <class Kinetic>
  std::string problem(const Kinetic& kinetic) const {
    const std::size_t visible = kinetic.number_of_points() - kinetic.number_of_hidden_points();
    if (kinetic.periodic_edges().size() != 3 * visible) return "there are not 3n edges";
    if (kinetic.periodic_edges() != std::vector(edges_.begin(), edges_.end())) {
      return "the events do not account for the edges";
    }
    if (hidden_points(kinetic) != std::vector(hidden_.begin(), hidden_.end())) {
      return "the events do not account for the hidden points";
    }
    return "";
  }

 private:
  std::set<Periodic_edge> edges_;
  std::set<Point_id> hidden_;
};

// ---- brute force ----

/// The triangulation at a time, of small integer motions with the epoch 0, in integers: without
/// points that are hidden by others with the same trajectory.
template <class Kinetic>
std::vector<Face> reference_at(const Kinetic& kinetic, const Rational& time) {
  const auto p = static_cast<Wide>(numerator(time).template convert_to<std::int64_t>());
  const auto q = static_cast<Wide>(denominator(time).template convert_to<std::int64_t>());
  const auto at = [&](double value, double rate) {
    return static_cast<Wide>(value) * q + static_cast<Wide>(rate) * p;
  };
  const auto place = [&](const Linear_motion_2& motion) -> Vector<Wide> {
    return {at(motion.position.x, motion.velocity.x), at(motion.position.y, motion.velocity.y)};
  };
  const Periodic_box_2& box = kinetic.traits().box();
  std::vector<Placed_point<Wide>> points;
  for (Point_id id = 0; id < kinetic.next_id(); ++id) {
    if (!kinetic.contains(id) || kinetic.vertex(id)->point().id() != id) continue;
    const auto& motion = kinetic.motion(id);
    Wide weight = 0;
    if constexpr (HasWeight<typename Kinetic::Motion>) {
      const Wide radius = at(motion.radius, motion.growth);
      weight = radius * radius + static_cast<Wide>(motion.weight) * q * q;
    }
    points.emplace_back(id, place(motion), weight);
  }
  return reference<Wide>({place(box.first()), place(box.second())}, points);
}

/// Whether the triangulation is that of brute force between now and the next event. At a time at
/// which four images are cocircular for that moment alone it may have other diagonals; so up to
/// five times are tried. Counts in `skipped` the times that are too near to each other for integers
/// of 128 bits.
template <class Kinetic>
bool is_that_of_brute_force(Kinetic& kinetic, std::size_t& skipped) {
  using Time = Algebraic_number;
  const Time& now = kinetic.current_time();
  Time end = Time(Rational(now.upper() + 1));
  if (const auto next = kinetic.next_event_time()) end = std::min(end, *next);
  if (const auto collapse = kinetic.traits().box().collapse_after(now)) {
    end = std::min(end, *collapse);
  }
  const std::vector<Face> faces = faces_of(kinetic);
  for (int tries = 0; tries < 5; ++tries) {
    const Rational time = simplest_between(now, end);
    if (denominator(time) > 1'000'000) {
      ++skipped;
      return true;
    }
    if (reference_at(kinetic, time) == faces) return true;
    end = Time(time);
  }
  return false;
}

}  // namespace kinetri::test

#endif  // KINETRI_TEST_SUPPORT_PERIODIC_RUNS_H
