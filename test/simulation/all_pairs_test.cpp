// SPDX-License-Identifier: GPL-3.0-or-later
//
// Contacts against an oracle that looks at all pairs: every response, linear and accelerated
// motion, with and without a box, discs apart and discs that overlap.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <random>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

#include "kinetri/simulation/simulation_2.h"
#include "support/all_pairs_simulator.h"

namespace kinetri {
namespace {

/// The contacts that a simulation reports.
struct Contacts : Event_observer {
  void after_event(const Event& event) override {
    if (event.kind == Event_kind::wall || event.kind == Event_kind::collision) {
      events.push_back(event);
    }
  }
  std::vector<Event> events;
};

struct Totals {
  std::size_t runs = 0;
  std::size_t contacts = 0;
  std::size_t pressed = 0;
  std::size_t started_overlapping = 0;  // pairs
};

std::string contact_text(Event_kind kind, Point_id a, Point_id b, const Algebraic_number& time) {
  std::ostringstream out;
  out << name(kind) << ' ' << a;
  if (b != no_point) out << ' ' << b;
  out << " at " << time.to_double();
  return out.str();
}
std::string text(const Event& event) {
  return contact_text(event.kind, *event.point_a, event.point_b.value_or(no_point), event.time);
}
std::string text(const test::All_pairs_contact& contact) {
  return contact_text(contact.kind, contact.a, contact.b, contact.time);
}

/// Runs both up to `until`, or up to so many contacts, and compares them.
template <class Traits>
void compare(const std::vector<typename Traits::Motion>& motions, const Simulation_options& options,
             const Algebraic_number& until, Totals& totals) {
  constexpr std::size_t most_contacts = 120;
  test::All_pairs_simulator<typename Traits::Motion> oracle(motions, options);
  Simulation_2<Traits> simulation(motions, options);
  Contacts contacts;
  simulation.add_observer(contacts);
  ++totals.runs;
  std::size_t compared = 0;
  bool is_pressed = false;
  const auto audit = [&](Audit_level level) {
    const Audit_report report = simulation.audit(level);
    ASSERT_TRUE(report.passed()) << "at " << simulation.current_time().to_double() << ": "
                                 << report.failures.front();
  };
  ASSERT_NO_FATAL_FAILURE(audit(Audit_level::certificates));
  for (std::size_t events = 1; events > 0 && !is_pressed && compared < most_contacts;) {
    try {
      events = simulation.step(until);
    } catch (const Endless_contacts_error&) {
      is_pressed = true;
    }
    for (; compared < contacts.events.size(); ++compared) {
      const Event& event = contacts.events[compared];
      const auto expected = oracle.step(until);
      ASSERT_TRUE(expected) << "contact " << compared << " too many: " << text(event);
      const bool is_wall = event.kind == Event_kind::wall;
      ASSERT_TRUE(event.kind == expected->kind && event.time == expected->time &&
                  *event.point_a == expected->a && (is_wall || *event.point_b == expected->b))
          << "contact " << compared << ": " << text(event) << "; expected " << text(*expected);
    }
    if (!is_pressed) {
      ASSERT_NO_FATAL_FAILURE(audit(Audit_level::delaunay));
    }
  }
  if (!is_pressed) {
    ASSERT_NO_FATAL_FAILURE(audit(Audit_level::certificates));
  }
  totals.contacts += compared;
  if (compared >= most_contacts) return;
  const auto missed = oracle.step(until);
  ASSERT_FALSE(missed) << "contact " << compared << " missed: " << text(*missed);
  EXPECT_EQ(is_pressed, oracle.is_pressed());
  totals.pressed += is_pressed ? 1 : 0;
  if (is_pressed) return;
  for (const auto& [id, motion] : oracle.motions()) {
    ASSERT_TRUE(simulation.triangulation().contains(id));
    EXPECT_EQ(simulation.triangulation().motion(id), motion) << "point " << id;
  }
  EXPECT_EQ(simulation.triangulation().number_of_points(), oracle.motions().size());
}

/// The numbers of a random motion: of binary64, or small whole ones, which make contacts at one
/// time.
class Numbers {
 public:
  Numbers(bool are_whole, unsigned seed) : are_whole_(are_whole), random_(seed) {}

  double between(int least, int greatest) {
    if (are_whole_) return std::uniform_int_distribution<int>(least, greatest)(random_);
    return std::uniform_real_distribution<double>(least, greatest)(random_);
  }
  Vector_2 vector(int size) {
    const double x = between(-size, size);
    return {x, between(-size, size)};
  }

 private:
  bool are_whole_;
  std::mt19937_64 random_;
};

template <class Motion>
Motion random_motion(Numbers& numbers, int size) {
  const Vector_2 place = numbers.vector(size);
  const Vector_2 velocity = numbers.vector(3);
  if constexpr (std::same_as<Motion, Linear_motion_2>) {
    return {place, velocity, 0};
  } else {
    const Vector_2 acceleration = numbers.vector(2);
    // Of whole numbers some rest, or move with constant velocity.
    const double kind = numbers.between(0, 3);
    const Vector_2 jerk = numbers.vector(2);
    if (kind == 0) return {place, {}, {}, {}, 0};
    if (kind == 1) return {place, {}, acceleration, {}, 0};
    return {place, velocity, acceleration, kind < 2.5 ? Vector_2() : jerk, 0};
  }
}

/// The name of the response; whether there is a box, whole numbers, and discs that overlap at the
/// start.
using Case = std::tuple<std::string, bool, bool, bool>;

class All_pairs : public testing::TestWithParam<Case> {
 protected:
  template <class Traits>
  void run(std::size_t points, double until, int seeds) {
    const auto& [response, has_box, are_whole, may_overlap] = GetParam();
    Totals totals;
    for (int seed = 1; seed <= seeds * test::multiplier(); ++seed) {
      constexpr int size = 8;
      Simulation_options options;
      options.radius = may_overlap ? 1.5 : 0.75;
      for (const Named_response& named : named_responses) {
        if (named.name == response) options.response = named.response;
      }
      if (has_box) options.box = Box_2{-size, -size, size, size};
      Numbers numbers(are_whole, static_cast<unsigned>(seed));
      std::vector<typename Traits::Motion> motions;
      while (motions.size() < points) {
        const auto motion = random_motion<typename Traits::Motion>(numbers, size);
        const auto is_refused = [&](const auto& other) {
          const double x = other.position.x - motion.position.x;
          const double y = other.position.y - motion.position.y;
          const bool overlap = x * x + y * y < 4 * options.radius * options.radius;
          if (overlap && may_overlap) ++totals.started_overlapping;
          return same_trajectory(other, motion) || (overlap && !may_overlap);
        };
        if (std::ranges::none_of(motions, is_refused)) motions.push_back(motion);
      }
      ASSERT_NO_FATAL_FAILURE(compare<Traits>(motions, options, Algebraic_number(until), totals))
          << "seed " << seed;
    }
    std::printf("%zu runs, %zu contacts, %zu ended pressed, %zu pairs overlapped at the start\n",
                totals.runs, totals.contacts, totals.pressed, totals.started_overlapping);
    EXPECT_GT(totals.contacts, totals.runs / 3);
  }
};

TEST_P(All_pairs, of_linear_points_have_the_same_contacts) {
  run<Linear_kinetic_traits_2>(14, 5, 3);
}

TEST_P(All_pairs, of_accelerated_points_have_the_same_contacts) {
  run<Polynomial_kinetic_traits_2>(9, 3, 3);
}

std::string case_name(const testing::TestParamInfo<Case>& info) {
  const auto& [response, has_box, are_whole, may_overlap] = info.param;
  std::string result = response;
  result += has_box ? "_in_a_box" : "_in_the_plane";
  result += are_whole ? "_on_a_grid" : "_at_random";
  result += may_overlap ? "_overlapping" : "_apart";
  return result;
}

INSTANTIATE_TEST_SUITE_P(, All_pairs,
                         testing::Combine(testing::Values("log", "swap", "elastic", "stop",
                                                          "remove"),
                                          testing::Bool(), testing::Bool(), testing::Bool()),
                         case_name);

}  // namespace
}  // namespace kinetri
