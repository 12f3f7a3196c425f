// SPDX-License-Identifier: GPL-3.0-or-later
//
// What an observer calls within an event, and what may be called after it has thrown.
#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "kinetri/triangulation/kinetic_delaunay_triangulation_2.h"
#include "support/motions.h"
#include "support/precondition_error.h"

namespace kinetri::changes_within_events_test {
namespace {

using Kinetic_delaunay = Kinetic_delaunay_triangulation_2<>;
using Call = std::function<void(Kinetic_delaunay&)>;

constexpr const char* within =
    "a change of the triangulation within an event, or while another change is made; make it when "
    "advance_to, step or the other change has returned";
constexpr const char* left =
    "an exception has left the triangulation within an event; make another one, or "
    "restore a snapshot";

const Linear_motion_2 motion = {{50, 50}, {1, 0}, 0};

// Every function that changes a triangulation.
std::map<std::string, Call> all_changes() {
  static Event_observer another;
  const std::vector<Point_id> ids = {0, 2};
  const std::vector<Linear_motion_2> motions = {motion, {{51, 50}, {}, 0}};
  return {
      {"advance_to", [](auto& kinetic) { kinetic.advance_to(9.0); }},
      {"advance_to, asking", [](auto& kinetic) { kinetic.advance_to(9.0, [] { return true; }); }},
      {"step", [](auto& kinetic) { kinetic.step(); }},
      {"step until", [](auto& kinetic) { kinetic.step(9.0); }},
      {"next_event_time", [](auto& kinetic) { kinetic.next_event_time(); }},
      {"reverse", [](auto& kinetic) { kinetic.reverse(); }},
      {"set_motion", [](auto& kinetic) { kinetic.set_motion(0, motion); }},
      {"set_motions", [=](auto& kinetic) { kinetic.set_motions(ids, motions); }},
      {"insert", [](auto& kinetic) { kinetic.insert(motion); }},
      {"insert many", [=](auto& kinetic) { kinetic.insert(motions); }},
      {"erase", [](auto& kinetic) { kinetic.erase(0); }},
      {"erase many", [=](auto& kinetic) { kinetic.erase(ids); }},
      {"apply",
       [](auto& kinetic) {
         const Kinetic_delaunay::Change change = {0, motion};
         kinetic.apply(Event_kind::collision, 0, 1, {&change, 1});
       }},
      {"add_observer", [](auto& kinetic) { kinetic.add_observer(another); }}};
}

// Makes calls within the first of each kind of its calls.
class Changer : public Event_observer {
 public:
  explicit Changer(Kinetic_delaunay& kinetic) : kinetic_(kinetic) {}
  void before_event(const Event& /*event*/) override { make_calls(0); }
  void after_event(const Event& /*event*/) override { make_calls(1); }
  void after_rebuild(const Algebraic_number& /*time*/, std::span<const Edge_ids> /*e*/) override {
    make_calls(2);
  }
  std::array<bool, 3> has_called = {};

 private:
  void make_calls(std::size_t kind) {
    if (std::exchange(has_called[kind], true)) return;
    for (const auto& change : all_changes()) {
      SCOPED_TRACE(change.first);
      EXPECT_PRECONDITION_ERROR(change.second(kinetic_), within);
    }
  }

  Kinetic_delaunay& kinetic_;
};

TEST(Changes_within_events, are_refused_and_the_run_goes_on) {
  const auto motions = test::random_motions(30, 100, 5, 1);
  Kinetic_delaunay plain(motions);
  Kinetic_delaunay kinetic(motions);
  Changer changer(kinetic);
  kinetic.add_observer(changer);
  kinetic.advance_to(2.0);
  kinetic.erase(7);
  EXPECT_EQ(changer.has_called, (std::array{true, true, true}));
  plain.advance_to(2.0);
  plain.erase(7);
  EXPECT_EQ(kinetic.advance_to(4.0), plain.advance_to(4.0));
  EXPECT_EQ(kinetic.finite_edge_ids(), plain.finite_edge_ids());
  EXPECT_EQ(kinetic.counters().number_of_events(), plain.counters().number_of_events());
  EXPECT_EQ(kinetic.next_id(), plain.next_id());
  EXPECT_TRUE(kinetic.audit(Audit_level::certificates).failures.empty());
}

TEST(Changes_within_events, are_refused_while_a_run_asks_whether_it_may_go_on) {
  const auto motions = test::random_motions(30, 100, 5, 1);
  for (const auto& change : all_changes()) {
    SCOPED_TRACE(change.first);
    Kinetic_delaunay kinetic(motions);
    kinetic.advance_to(2.0, [&] {
      EXPECT_PRECONDITION_ERROR(change.second(kinetic), within);
      return true;
    });
    EXPECT_TRUE(kinetic.is_valid(true, 1));
  }
}

struct Thrower : Event_observer {
  explicit Thrower(bool is_before) : is_before_(is_before) {}
  void before_event(const Event& /*event*/) override {
    if (is_before_) throw std::runtime_error("enough");
  }
  void after_event(const Event& /*event*/) override {
    if (!is_before_) throw std::runtime_error("enough");
  }

 private:
  bool is_before_;
};

TEST(Changes_within_events, are_refused_for_ever_when_an_observer_has_thrown) {
  const auto motions = test::random_motions(30, 100, 5, 1);
  for (const bool is_before : {true, false}) {
    Kinetic_delaunay kinetic(motions);
    const Kinetic_delaunay::Snapshot snapshot = kinetic.snapshot();
    Thrower thrower(is_before);
    kinetic.add_observer(thrower);
    EXPECT_THROW(kinetic.advance_to(2.0), std::runtime_error);
    kinetic.remove_observer(thrower);
    for (const auto& change : all_changes()) {
      SCOPED_TRACE(change.first);
      EXPECT_PRECONDITION_ERROR(change.second(kinetic), left);
    }
    // What the message advises.
    Kinetic_delaunay restored = Kinetic_delaunay::restore(snapshot);
    restored.advance_to(2.0);
    EXPECT_TRUE(restored.is_valid(true, 1));
  }
}

// What is refused before it begins leaves a triangulation as it is.
TEST(Changes_within_events, may_follow_a_change_that_has_been_refused) {
  Kinetic_delaunay kinetic(test::random_motions(30, 100, 5, 1), {}, {}, Coincident_points::refuse);
  kinetic.advance_to(1.0);
  EXPECT_THROW(kinetic.insert(kinetic.motion(3)), Coincident_trajectories_error);
  EXPECT_THROW(kinetic.erase(99), Precondition_error);
  EXPECT_EQ(kinetic.insert(motion), 30u);
  kinetic.advance_to(2.0);
  EXPECT_TRUE(kinetic.is_valid(true, 1));
}

// Counts the events that it sees; at the one of that number, removes some observers.
struct Remover : Event_observer {
  void before_event(const Event& event) override {
    ++before;
    if (event.number != number) return;
    for (Event_observer* const observer : removed) kinetic->remove_observer(*observer);
  }
  void after_event(const Event& /*event*/) override { ++after; }
  Kinetic_delaunay* kinetic = nullptr;
  std::uint64_t number = 0;
  std::vector<Event_observer*> removed;
  std::size_t before = 0;
  std::size_t after = 0;
};

TEST(Changes_within_events, may_remove_observers) {
  Kinetic_delaunay kinetic(test::random_motions(30, 100, 5, 1));
  std::array<Remover, 3> observers;
  for (Remover& observer : observers) {
    observer.kinetic = &kinetic;
    observer.number = ~std::uint64_t{0};
    kinetic.add_observer(observer);
  }
  observers[1].number = 5;
  observers[1].removed = {&observers[0], &observers[1]};
  const std::size_t events = kinetic.advance_to(2.0);
  ASSERT_GT(events, 6u);
  EXPECT_EQ(observers[0].before, 6u);
  EXPECT_EQ(observers[0].after, 5u);
  EXPECT_EQ(observers[1].before, 6u);
  EXPECT_EQ(observers[1].after, 5u);
  EXPECT_EQ(observers[2].before, events);
  EXPECT_EQ(observers[2].after, events);
}

// The point is there, of which the observer has been told.
TEST(Changes_within_events, leave_the_point_whose_insertion_an_observer_has_interrupted) {
  Kinetic_delaunay kinetic(test::random_motions(30, 100, 5, 1));
  struct Stepper : Event_observer {
    Kinetic_delaunay* kinetic = nullptr;
    void after_event(const Event& /*event*/) override { kinetic->step(); }
  } stepper;
  stepper.kinetic = &kinetic;
  kinetic.add_observer(stepper);
  EXPECT_THROW(kinetic.insert({{50, 50.5}, {0, 0}, 0}), Precondition_error);
  EXPECT_TRUE(kinetic.contains(30));
  EXPECT_EQ(kinetic.next_id(), 31u);
  EXPECT_EQ(kinetic.number_of_points(), 31u);
}

}  // namespace
}  // namespace kinetri::changes_within_events_test
