// SPDX-License-Identifier: GPL-3.0-or-later
//
// Triangulations of users' own traits, which the library does not compile: traits that are derived
// from the library's share its topology; traits with predicates of their own share nothing. Both
// behave as the library's.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

#include "kinetri/triangulation/audit_impl.h"
#include "kinetri/triangulation/kinetic_triangulation_2_impl.h"
#include "support/discs.h"
#include "support/kinetic_runs.h"
#include "support/motions.h"

namespace kinetri::own_traits_test {
namespace {

using test::operator<<;

template <class Library>
struct Derived : Library {
  using Base = Library;
  static Derived exact() { return {}; }
};

template <class Base>
struct Own_predicates : Base {
  using Base::Base;
};

// The predicates are those of the library, but have another type.
template <class Library>
struct With_own_predicates : Library {
  using Base = Library;
  using Instantaneous_traits = Own_predicates<typename Library::Instantaneous_traits>;

  static With_own_predicates exact() { return {}; }
  static Instantaneous_traits instantaneous_traits(const Instant& instant) {
    return Instantaneous_traits(instant);
  }
  static Instantaneous_traits instantaneous_traits(const Instant_clock& clock) {
    return Instantaneous_traits(clock);
  }
};

template <class Traits>
constexpr bool is_shared = detail::Kinetic_types<Traits>::has_library_geometry;
static_assert(is_shared<Linear_kinetic_traits_2> && is_shared<Derived<Linear_kinetic_traits_2>>);
static_assert(is_shared<Derived<Disc_kinetic_traits_2>>);
static_assert(!is_shared<With_own_predicates<Linear_kinetic_traits_2>>);
static_assert(!is_shared<Periodic_kinetic_traits_2>);

std::vector<Linear_motion_2> random_motions_as(Linear_motion_2 /*kind*/, std::size_t n,
                                               unsigned seed) {
  return test::random_motions(n, 40, 5, seed);
}
std::vector<Disc_motion_2> random_motions_as(Disc_motion_2 /*kind*/, std::size_t n, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> number(0, 4);
  std::vector<Disc_motion_2> discs;
  for (const Linear_motion_2& motion : test::random_motions(n, 40, 5, seed)) {
    Disc_motion_2& disc = discs.emplace_back();
    disc.position = motion.position;
    disc.velocity = motion.velocity;
    disc.radius = number(random);
  }
  return discs;
}

// A triangulation with the events that it reports.
template <class Traits>
struct Observed {
  using Motion = typename Traits::Motion;

  explicit Observed(const std::vector<Motion>& motions) : kinetic(motions), recorder(kinetic) {}

  std::vector<Point_id> hidden_points() const {
    std::vector<Point_id> result;
    for (Point_id id = 0; id < kinetic.next_id(); ++id) {
      if (kinetic.contains(id) && kinetic.is_hidden(id)) result.push_back(id);
    }
    return result;
  }

  Kinetic_triangulation_2<Traits> kinetic;
  test::Event_recorder recorder;
};

// The first difference in what users see; empty if there is none.
template <class Own, class Library>
std::string difference(const Observed<Own>& own, const Observed<Library>& library) {
  std::ostringstream out;
  const auto& events = own.recorder.events;
  const auto& expected = library.recorder.events;
  for (std::size_t i = 0; i < std::min(events.size(), expected.size()); ++i) {
    const auto all = [](const Event& e) {
      return std::tie(e.number, e.kind, e.point_a, e.point_b, e.removed, e.added, e.apex);
    };
    if (all(events[i]) == all(expected[i]) && events[i].time == expected[i].time) continue;
    out << "event " << i << ": " << events[i] << "; expected " << expected[i];
    return out.str();
  }
  if (events.size() != expected.size()) {
    out << events.size() << " events; expected " << expected.size();
  } else if (own.kinetic.finite_edge_ids() != library.kinetic.finite_edge_ids()) {
    out << "other edges";
  } else if (own.hidden_points() != library.hidden_points()) {
    out << "other hidden points";
  }
  return out.str();
}

template <class Traits>
class Own_traits : public testing::Test {
 protected:
  using Motion = typename Traits::Motion;

  // Does the same to both triangulations, and compares them.
  template <class Action>
  void both(const Action& action) {
    action(own_.kinetic);
    action(library_.kinetic);
    ASSERT_EQ(difference(own_, library_), "");
    ASSERT_EQ(test::audit_problem(own_.kinetic, Audit_level::certificates), "");
  }

  std::vector<Motion> motions_ = random_motions_as(Motion(), 60, 1);
  Observed<Traits> own_{motions_};
  Observed<typename Traits::Base> library_{motions_};
};

using All =
    testing::Types<Derived<Linear_kinetic_traits_2>, With_own_predicates<Linear_kinetic_traits_2>,
                   With_own_predicates<Disc_kinetic_traits_2>>;
TYPED_TEST_SUITE(Own_traits, All);

TYPED_TEST(Own_traits, have_the_events_of_the_library) {
  this->both([](auto& kinetic) { kinetic.advance_to(2.5); });
  this->both([](auto& kinetic) { kinetic.reverse(); });
  this->both([](auto& kinetic) { kinetic.advance_to(-1.0); });
  EXPECT_GT(this->own_.recorder.events.size(), 50U);
}

TYPED_TEST(Own_traits, move_all_points_as_the_library) {
  std::mt19937_64 random(2);
  std::vector<Point_id> ids(this->motions_.size());
  std::iota(ids.begin(), ids.end(), 0U);
  double time = 0;
  for (const double length : {0.1, 1.0, 30.0}) {
    SCOPED_TRACE(length);
    std::normal_distribution<double> shift(0, length);
    auto moved = this->motions_;
    for (auto& motion : moved) {
      motion.epoch = time;
      motion.position = {motion.position.x + shift(random), motion.position.y + shift(random)};
    }
    this->both([&](auto& kinetic) { kinetic.set_motions(ids, moved); });
    moved[40] = moved[7];
    this->both([&](auto& kinetic) { kinetic.set_motions(ids, moved); });
    time += 0.5;
    this->both([&](auto& kinetic) { kinetic.advance_to(time); });
  }
}

TYPED_TEST(Own_traits, change_some_points_as_the_library) {
  const auto others = random_motions_as(this->motions_[0], 6, 3);
  this->both([&](auto& kinetic) { kinetic.set_motion(5, others[0]); });
  this->both([&](auto& kinetic) { kinetic.set_motion(6, others[0]); });
  this->both([&](auto& kinetic) { kinetic.insert(others); });
  this->both([](auto& kinetic) { kinetic.advance_to(0.5); });
  this->both([](auto& kinetic) {
    const std::vector<Point_id> ids = {0, 5, 9, 61};
    kinetic.erase(ids);
  });
  this->both([](auto& kinetic) { kinetic.advance_to(1.0); });
}

// Points in rows are cocircular and collinear.
TYPED_TEST(Own_traits, start_as_the_library_in_rows) {
  std::vector<typename TypeParam::Motion> rows(30);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].position = {static_cast<double>(i % 6), static_cast<double>(i / 6)};
  }
  rows.push_back(rows[8]);
  const Observed<TypeParam> own(rows);
  const Observed<typename TypeParam::Base> library(rows);
  EXPECT_EQ(difference(own, library), "");
  EXPECT_EQ(own.hidden_points(), std::vector<Point_id>{30});
}

}  // namespace
}  // namespace kinetri::own_traits_test
