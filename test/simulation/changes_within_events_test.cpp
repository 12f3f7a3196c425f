// SPDX-License-Identifier: GPL-3.0-or-later
//
// What observers and responses call within an event, and what may be called after they have thrown.
#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "support/disc_runs.h"
#include "support/multiplier.h"
#include "support/precondition_error.h"

namespace kinetri::changes_within_events_test {
namespace {

using test::Recorder;
using test::Simulation;
using Call = std::function<void(Simulation&)>;

constexpr const char* within =
    "a change of the simulation within an event, or while another change is made; make it when "
    "advance_to, step or the other change has returned, or schedule it";
constexpr const char* left =
    "an error has left the simulation within a contact; make another one, or restore a snapshot";
constexpr const char* left_by_observer =
    "an exception has left the triangulation within an event; make another one, or "
    "restore a snapshot";

struct Nothing : Overlap_observer {
  void after_change(std::span<const Point_id> /*points*/) override {}
};

const Linear_motion_2 motion = {{5, 5}, {1, 0}, 0};

// Every function that changes a simulation, but for those that schedule changes.
std::map<std::string, Call> all_changes() {
  static Event_observer observer;
  static Nothing overlap_observer;
  const std::vector<Point_id> ids = {0, 2};
  return {{"advance_to", [](auto& simulation) { simulation.advance_to(9.0); }},
          {"advance_to, asking",
           [](auto& simulation) { simulation.advance_to(9.0, [] { return true; }); }},
          {"next_event_time", [](auto& simulation) { simulation.next_event_time(); }},
          {"step", [](auto& simulation) { simulation.step(); }},
          {"step until", [](auto& simulation) { simulation.step(9.0); }},
          {"insert", [](auto& simulation) { simulation.insert(motion); }},
          {"set_motion", [](auto& simulation) { simulation.set_motion(0, motion); }},
          {"set_motions",
           [=](auto& simulation) {
             simulation.set_motions(ids, std::vector<Linear_motion_2>{motion, {{8, 5}, {}, 0}});
           }},
          {"set_velocities",
           [=](auto& simulation) {
             simulation.set_velocities(ids, std::vector<Vector_2>{{0, 0}, {0, 0}});
           }},
          {"set_mass", [](auto& simulation) { simulation.set_mass(0, 2); }},
          {"erase", [](auto& simulation) { simulation.erase(0); }},
          {"add_observer", [](auto& simulation) { simulation.add_observer(observer); }},
          {"add_overlap_observer",
           [](auto& simulation) { simulation.add_overlap_observer(overlap_observer); }}};
}

void expect_refused(Simulation& simulation, const char* message) {
  for (const auto& change : all_changes()) {
    SCOPED_TRACE(change.first);
    EXPECT_PRECONDITION_ERROR(change.second(simulation), message);
  }
}

std::vector<Linear_motion_2> motions() {
  return test::discs_in_a_box(16, 0.2, 4);
}

Simulation_options options_with(Collision_response response) {
  return test::discs(test::box_of(16), 3, std::move(response));
}

// Makes calls within the first of each kind of its calls.
class Changer : public Event_observer, public Overlap_observer {
 public:
  explicit Changer(Simulation& simulation) : simulation_(simulation) {}
  void before_event(const Event& event) override { make_calls(event.kind, 'b'); }
  void after_event(const Event& event) override { make_calls(event.kind, 'a'); }
  void after_change(std::span<const Point_id> /*points*/) override {
    make_calls(Event_kind::collision, 'o');
  }
  std::map<std::pair<Event_kind, char>, int> called;

 private:
  void make_calls(Event_kind kind, char which) {
    if (called[{kind, which}]++ == 0) expect_refused(simulation_, within);
  }

  Simulation& simulation_;
};

TEST(Changes_within_events_of_simulations, are_refused_and_the_run_goes_on) {
  Simulation plain(motions(), options_with(collide_elastically));
  int calls = 0;
  Simulation* of_response = nullptr;
  Simulation simulation(motions(), options_with([&](const Contact_2& contact) {
                          if (calls++ == 0) expect_refused(*of_response, within);
                          return collide_elastically(contact);
                        }));
  of_response = &simulation;
  Changer changer(simulation);
  simulation.add_observer(changer);
  simulation.add_overlap_observer(changer);
  Recorder one;
  Recorder other;
  plain.add_observer(one);
  simulation.add_observer(other);
  for (Simulation* const each : {&plain, &simulation}) {
    each->advance_to(2.0);
    each->erase(3);
    each->schedule_erase(2.5, 4);
    each->advance_to(3.0);
  }
  EXPECT_GT(calls, 5);
  for (const Event_kind kind :
       {Event_kind::flip, Event_kind::wall, Event_kind::collision, Event_kind::erase}) {
    EXPECT_GT((changer.called[{kind, 'a'}]), 0) << name(kind);
    EXPECT_GT((changer.called[{kind, 'b'}]), 0) << name(kind);
  }
  EXPECT_GT((changer.called[{Event_kind::collision, 'o'}]), 0);
  ASSERT_EQ(one.events.size(), other.events.size());
  for (std::size_t i = 0; i < one.events.size(); ++i) {
    EXPECT_EQ(one.events[i].kind, other.events[i].kind);
    EXPECT_EQ(one.events[i].time, other.events[i].time);
  }
  EXPECT_TRUE(simulation.audit(Audit_level::certificates).failures.empty());
}

TEST(Changes_within_events_of_simulations, are_refused_while_a_run_asks_whether_it_may_go_on) {
  Simulation simulation(motions(), options_with(collide_elastically));
  int asked = 0;
  simulation.advance_to(1.0, [&] {
    if (++asked < 4) expect_refused(simulation, within);
    return true;
  });
  EXPECT_GT(asked, 4);
  EXPECT_TRUE(simulation.is_valid(true, 1));
}

// At the contact of 0 and 1 at t = 2 the response has 2 erased at t = 3, and one inserted at t = 4.
TEST(Changes_within_events_of_simulations, may_be_scheduled_by_a_response) {
  Simulation* of_response = nullptr;
  Simulation simulation(
      {{{0, 0}, {1, 0}, 0}, {{4, 0}, {0, 0}, 0}, {{9, 9}, {0, 0}, 0}},
      test::discs(1, [&](const Contact_2& contact) {
        of_response->schedule_erase(contact.time + 1, 2);
        EXPECT_EQ(of_response->schedule_insert(contact.time + 2, {{0, 20}, {0, 0}, 0}, 5), 3u);
        return swap_velocities(contact);
      }));
  of_response = &simulation;
  simulation.advance_to(2.5);
  EXPECT_TRUE(simulation.triangulation().contains(2));
  simulation.advance_to(3.5);
  EXPECT_FALSE(simulation.triangulation().contains(2));
  EXPECT_FALSE(simulation.triangulation().contains(3));
  simulation.advance_to(4.0);
  EXPECT_TRUE(simulation.triangulation().contains(3));
  EXPECT_EQ(simulation.mass(3), 5);
  EXPECT_TRUE(simulation.audit(Audit_level::certificates).failures.empty());
}

TEST(Changes_within_events_of_simulations, are_refused_for_ever_when_a_response_has_thrown) {
  Simulation simulation(motions(), options_with([](const Contact_2&) -> Contact_response_2 {
                          throw std::runtime_error("enough");
                        }));
  const Simulation::Snapshot snapshot = simulation.snapshot();
  EXPECT_THROW(simulation.advance_to(3.0), std::runtime_error);
  expect_refused(simulation, left);
  EXPECT_PRECONDITION_ERROR(simulation.schedule_erase(9.0, 0), left);
  EXPECT_PRECONDITION_ERROR(simulation.schedule_motion(9.0, 0, motion), left);
  EXPECT_PRECONDITION_ERROR(simulation.schedule_insert(9.0, motion), left);
  EXPECT_EQ(simulation.triangulation().next_id(), 16u);
  // What the message advises.
  Simulation restored = Simulation::restore(snapshot, collide_elastically);
  restored.advance_to(3.0);
  EXPECT_TRUE(restored.is_valid(true, 1));
}

// Two points in a corner between walls that meet there: more contacts than are allowed.
TEST(Changes_within_events_of_simulations, may_follow_contacts_without_end) {
  Simulation_options options = test::in_box({0, 0, 10, 10});
  options.max_contacts_per_instant = 1;
  Simulation simulation({{{1, 1}, {-1, -1}, 0}, {{2, 3}, {0, 0}, 0}}, options);
  EXPECT_THROW(simulation.advance_to(3.0), Endless_contacts_error);
  EXPECT_EQ(simulation.current_time(), Algebraic_number(1));
  EXPECT_EQ(test::velocity(simulation, 0), (Vector_2{1, -1})) << "the second contact is to come";
  EXPECT_EQ(simulation.audit(Audit_level::certificates).failures, std::vector<std::string>());
  EXPECT_NO_THROW(simulation.snapshot());
  simulation.set_motion(0, {{0, 0}, {1, 1}, 1});
  simulation.schedule_erase(2.0, 1);
  EXPECT_GT(simulation.advance_to(3.0), 0u);
  EXPECT_TRUE(simulation.is_valid(true, 1));
}

// An observer that throws such an error within a contact is one that throws.
TEST(Changes_within_events_of_simulations, are_refused_for_ever_whatever_an_observer_has_thrown) {
  struct Thrower : Event_observer {
    void after_event(const Event& event) override {
      if (event.kind == Event_kind::collision) throw Endless_contacts_error(0, "made up");
    }
  };
  Simulation simulation(motions(), options_with(collide_elastically));
  Thrower thrower;
  simulation.add_observer(thrower);
  EXPECT_THROW(simulation.advance_to(3.0), Endless_contacts_error);
  simulation.remove_observer(thrower);
  expect_refused(simulation, left);
  EXPECT_THROW(simulation.snapshot(), Precondition_error);
}

// Discs of several radii and a point on a grid, with many contacts at one time. One contact at a
// time is allowed, but the run goes on after each error, or a restored one does: it is that without
// a limit.
TEST(Contacts_without_end, are_left_as_they_were_before) {
  using Discs = Simulation_2<Disc_kinetic_traits_2>;
  std::size_t errors = 0;
  for (unsigned seed = 1; seed <= test::cases(40u); ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    const auto one_of = [&](int least, int most) {
      return std::uniform_int_distribution<int>(least, most)(random);
    };
    std::vector<Disc_motion_2> discs;
    for (int k = 0; k < 16; ++k) {
      const Vector_2 place = {4.0 * (k % 4) + 2, 4.0 * (k / 4) + 2};
      const Vector_2 velocity = {1.0 * one_of(-1, 1), 1.0 * one_of(-1, 1)};
      discs.push_back({{place, velocity}, k == 5 ? 0 : one_of(1, 2) / 2.0, 0, 0});
    }
    Simulation_options options = test::in_box({0, 0, 16, 16});
    options.rim_touches = seed % 2 == 0;
    options.response = named_responses[1 + seed % 5].response;
    Discs plain(discs, options);
    options.max_contacts_per_instant = 1;
    auto stopped = std::make_unique<Discs>(discs, options);
    Recorder expected;
    Recorder recorder;
    plain.add_observer(expected);
    stopped->add_observer(recorder);
    plain.advance_to(4.0);
    for (bool is_there = false; !is_there;) {
      try {
        stopped->advance_to(4.0);
        is_there = true;
      } catch (const Endless_contacts_error&) {
        ++errors;
        ASSERT_EQ(stopped->audit(Audit_level::certificates).failures, std::vector<std::string>());
        if (one_of(0, 1) == 0) continue;
        stopped.reset(new Discs(Discs::restore(stopped->snapshot(), options.response)));
        stopped->add_observer(recorder);
      }
    }
    ASSERT_EQ(expected.events.size(), recorder.events.size());
    for (std::size_t i = 0; i < expected.events.size(); ++i) {
      const Event& one = expected.events[i];
      const Event& other = recorder.events[i];
      EXPECT_EQ(one.kind, other.kind) << i;
      EXPECT_EQ(one.number, other.number) << i;
      EXPECT_EQ(one.time, other.time) << i;
      EXPECT_EQ(one.point_a, other.point_a) << i;
      EXPECT_EQ(one.point_b, other.point_b) << i;
    }
    EXPECT_EQ(plain.triangulation().finite_edge_ids(), stopped->triangulation().finite_edge_ids());
  }
  EXPECT_GT(errors, 100u);
}

TEST(Changes_within_events_of_simulations, are_refused_for_ever_when_an_observer_has_thrown) {
  struct Thrower : Event_observer {
    explicit Thrower(Event_kind kind) : kind_(kind) {}
    void after_event(const Event& event) override {
      if (event.kind == kind_) throw std::runtime_error("enough");
    }
    Event_kind kind_;
  };
  for (const Event_kind kind :
       {Event_kind::flip, Event_kind::wall, Event_kind::collision, Event_kind::erase}) {
    SCOPED_TRACE(name(kind));
    Simulation simulation(motions(), options_with(collide_elastically));
    simulation.schedule_erase(1.0, 5);
    Thrower thrower(kind);
    simulation.add_observer(thrower);
    EXPECT_THROW(simulation.advance_to(3.0), std::runtime_error);
    simulation.remove_observer(thrower);
    const bool is_contact = kind == Event_kind::wall || kind == Event_kind::collision;
    expect_refused(simulation, is_contact ? left : left_by_observer);
    EXPECT_PRECONDITION_ERROR(simulation.schedule_erase(9.0, 0),
                              is_contact ? left : left_by_observer);
  }
}

// A change that is refused leaves a simulation as it is.
TEST(Changes_within_events_of_simulations, may_follow_a_change_that_has_been_refused) {
  Simulation simulation({{{5, 5}, {1, 0}, 0}, {{6, 6}, {0, 0}, 0}}, test::in_box({0, 0, 10, 10}));
  EXPECT_THROW(simulation.set_motion(0, {{50, 5}, {}, 0}), Outside_box_error);
  simulation.schedule_motion(1.0, 1, {{50, 5}, {}, 0});
  EXPECT_THROW(simulation.advance_to(2.0), Outside_box_error);
  simulation.advance_to(2.0);
  simulation.set_motion(0, {{5, 5}, {}, 0});
  EXPECT_TRUE(simulation.audit(Audit_level::certificates).failures.empty());
}

TEST(Changes_within_events_of_simulations, may_remove_observers) {
  struct Remover : Event_observer, Overlap_observer {
    explicit Remover(Simulation& observed) : simulation(observed) {
      simulation.add_observer(*this);
      simulation.add_overlap_observer(*this);
    }
    void after_event(const Event& /*event*/) override {
      ++events;
      simulation.remove_observer(*this);
    }
    void after_change(std::span<const Point_id> /*points*/) override {
      ++changes;
      simulation.remove_overlap_observer(*this);
    }
    Simulation& simulation;
    int events = 0;
    int changes = 0;
  };
  Simulation simulation(motions(), options_with(collide_elastically));
  Remover one(simulation);
  Remover other(simulation);
  simulation.advance_to(3.0);
  for (const Remover* const remover : {&one, &other}) {
    EXPECT_EQ(remover->events, 1);
    EXPECT_EQ(remover->changes, 1);
  }
  EXPECT_TRUE(simulation.is_valid(true, 1));
}

}  // namespace
}  // namespace kinetri::changes_within_events_test
