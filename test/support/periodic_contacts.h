// SPDX-License-Identifier: GPL-3.0-or-later
//
// Simulations of discs in periodic boxes beside the oracle of all pairs of images.
#ifndef KINETRI_TEST_SUPPORT_PERIODIC_CONTACTS_H
#define KINETRI_TEST_SUPPORT_PERIODIC_CONTACTS_H

#include <gtest/gtest.h>

#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include "kinetri/simulation/simulation_2.h"
#include "support/image_contacts.h"

namespace kinetri::test {

struct Contact_recorder : Event_observer {
  void after_event(const Event& event) override {
    if (event.kind == Event_kind::collision) contacts.push_back(event);
  }
  std::vector<Event> contacts;
};

inline Periodic_box_2 square(double side) {
  return {{{side, 0}, {0, 0}}, {{0, side}, {0, 0}}};
}

/// The boxes of the runs: of the side 8 at first.
struct Named_box {
  const char* name;
  Periodic_box_2 box;
  double until = 120;
};
inline std::vector<Named_box> boxes() {
  const double side = 8;
  return {{"at rest", square(side)},
          {"oblique", {{{side, 0}, {0, 0}}, {{3, 6}, {0, 0}}}},
          {"sheared", {{{side, 0}, {0, 0}}, {{0, side}, {1, 0}}}},
          {"growing", {{{side, 0}, {0.015625, 0}}, {{0, side}, {0, 0.015625}}}},
          {"shrinking", {{{side, 0}, {-0.0625, 0}}, {{0, side}, {0, -0.0625}}}},
          {"stretched", {{{side, 0}, {0.125, 0}}, {{0, side}, {0.25, -0.0625}}}, 64}};
}

inline std::string text(const Image_contact& contact) {
  const auto& [ids, offset] = contact.pair;
  return std::to_string(ids[0]) + "-" + std::to_string(ids[1]) + " (" + std::to_string(offset.x) +
         ", " + std::to_string(offset.y) + ") at " + std::to_string(contact.time.to_double());
}

/// Of a run that is to meet an own image.
template <class Simulation>
Own_image_error own_image(Simulation& simulation, double until) {
  try {
    simulation.advance_to(until);
  } catch (const Own_image_error& error) {
    return error;
  }
  throw std::logic_error("no contact with an own image");
}

struct Totals {
  std::size_t contacts = 0;
  std::size_t full = 0;  // runs with as many contacts as wanted
  std::size_t own_images = 0;
  std::size_t endless = 0;  // runs with more contacts at one time than allowed
  std::size_t hidden = 0;   // sums of the hidden discs at all instants
};

/// Runs a simulation and the oracle, for at most so many contacts. Returns the first difference.
template <class Traits>
std::string difference(const Periodic_box_2& box,
                       const std::vector<typename Traits::Motion>& motions,
                       const Simulation_options& options, double until, std::size_t most,
                       Totals& totals) {
  Image_contacts<typename Traits::Motion> oracle(box, motions, options);
  Simulation_2<Traits> simulation(motions, options, 0, Traits(box));
  Contact_recorder recorder;
  simulation.add_observer(recorder);
  std::size_t compared = 0;
  const auto audit_problem = [&](Audit_level level) {
    const Audit_report report = simulation.audit(level);
    return report.passed() ? std::string() : "audit: " + report.failures.front();
  };
  std::string problem = audit_problem(Audit_level::certificates);
  bool meets_own_image = false;
  bool is_endless = false;
  while (problem.empty() && !is_endless && compared < most) {
    std::size_t events = 0;
    try {
      events = simulation.step(until);
    } catch (const Own_image_error& error) {
      meets_own_image = true;
      ++totals.own_images;
      for (; compared < recorder.contacts.size(); ++compared) oracle.step(until);
      const auto expected = oracle.step(until);
      if (!expected || expected->time != error.time() ||
          expected->pair != Periodic_edge{{error.point(), error.point()}, error.offset()}) {
        return "contact with the own image at " + std::to_string(error.time().to_double()) +
               ", expected " + (expected ? text(*expected) : "none");
      }
      break;
    } catch (const Endless_contacts_error&) {
      is_endless = true;
      ++totals.endless;
    }
    for (; compared < recorder.contacts.size(); ++compared) {
      const Event& event = recorder.contacts[compared];
      const Image_contact found = {event.time,
                                   {{*event.point_a, *event.point_b}, event.added_offset}};
      const auto expected = oracle.step(until);
      if (!expected || expected->time != found.time || expected->pair != found.pair) {
        return "contact " + std::to_string(compared) + ": " + text(found) + ", expected " +
               (expected ? text(*expected) : "none");
      }
    }
    totals.hidden += simulation.triangulation().number_of_hidden_points();
    if (compared % 4 == 0) {
      problem =
          audit_problem(compared % 16 == 0 ? Audit_level::certificates : Audit_level::delaunay);
    }
    if (is_endless) {
      const auto expected = oracle.step(until);
      if (!expected || expected->time != simulation.current_time()) return "not endless";
    } else if (events == 0) {
      break;
    }
  }
  totals.contacts += compared;
  totals.full += compared >= most ? 1 : 0;
  if (!problem.empty() || meets_own_image || is_endless || compared >= most) return problem;
  const auto missed = oracle.step(until);
  if (missed) return "missed: " + text(*missed);
  for (Point_id id = 0; id < motions.size(); ++id) {
    const bool is_there = simulation.triangulation().contains(id);
    if (is_there != oracle.motions()[id].has_value() ||
        (is_there && simulation.triangulation().motion(id) != *oracle.motions()[id])) {
      return "point " + std::to_string(id) + " has another motion";
    }
  }
  return audit_problem(Audit_level::certificates);
}

/// Expects that the simulation, restored at the time 4, has the same contacts up to the time 9,
/// more than `least`.
template <class Traits>
void expect_same_contacts_if_restored(Simulation_2<Traits>& simulation,
                                      const Collision_response& response, const Traits& traits,
                                      std::size_t least) {
  simulation.advance_to(4);
  auto restored = Simulation_2<Traits>::restore(simulation.snapshot(), response, traits);
  Contact_recorder before;
  Contact_recorder after;
  simulation.add_observer(before);
  restored.add_observer(after);
  simulation.advance_to(9);
  restored.advance_to(9);
  EXPECT_GT(before.contacts.size(), least);
  ASSERT_EQ(after.contacts.size(), before.contacts.size());
  for (std::size_t i = 0; i < after.contacts.size(); ++i) {
    EXPECT_EQ(after.contacts[i].number, before.contacts[i].number);
    EXPECT_EQ(after.contacts[i].time, before.contacts[i].time);
    EXPECT_EQ(after.contacts[i].added_offset, before.contacts[i].added_offset);
  }
  EXPECT_EQ(restored.snapshot().in_contact, simulation.snapshot().in_contact);
  simulation.remove_observer(before);
  restored.remove_observer(after);
}

}  // namespace kinetri::test

#endif  // KINETRI_TEST_SUPPORT_PERIODIC_CONTACTS_H
