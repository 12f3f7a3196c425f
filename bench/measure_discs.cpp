// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench_discs.h"
#include "cell_list_discs.h"
#include "kinetri/kinetri.h"
#include "kinetri/simulation/simulation_2.h"
#include "measurements.h"

namespace kinetri::bench {
namespace {

using nlohmann::json;

// The two programs are compared up to so many collisions per disc, on average; later, rounding
// separates their paths.
constexpr double collisions_to_compare = 2;

// The greatest overlap allowed in doubles, relative to the sum of the radii.
constexpr double most_overlap = 1e-9;

// The motions for a simulation: points with one common radius, or discs.
template <class Motion>
std::vector<Motion> motions_of(const Bench_discs& discs) {
  if constexpr (HasWeight<Motion>) {
    std::vector<Motion> result;
    for (std::size_t i = 0; i < discs.motions.size(); ++i) {
      result.push_back({discs.motions[i], discs.radii[i], 0, 0});
    }
    return result;
  } else {
    return discs.motions;
  }
}

template <class Motion>
Simulation_options options_of(const Bench_discs& discs) {
  Simulation_options result;
  result.box = discs.box;
  result.response = collide_elastically;
  result.refuses_overlaps = true;
  if constexpr (HasWeight<Motion>) {
    for (const double radius : discs.radii) result.masses.push_back(radius * radius);
  } else {
    result.radius = discs.radii.front();
  }
  return result;
}

template <class Simulation>
Simulation simulation_of(const Bench_discs& discs) {
  using Motion = typename Simulation::Motion;
  return Simulation(motions_of<Motion>(discs), options_of<Motion>(discs));
}

// The contacts of a simulation, with the resulting motions.
template <class Simulation>
class Contact_recorder : public Simulation::Observer {
 public:
  struct Change {
    Point_id id;
    typename Simulation::Motion motion;
  };
  struct Contact {
    Event_kind kind;
    Algebraic_number time;
    std::vector<Change> changes;
  };

  explicit Contact_recorder(Simulation& simulation) : simulation_(simulation) {
    simulation.add_observer(*this);
  }
  Contact_recorder(const Contact_recorder&) = delete;
  Contact_recorder& operator=(const Contact_recorder&) = delete;
  ~Contact_recorder() override { simulation_.remove_observer(*this); }

  void after_event(const Event& event) override {
    if (event.kind != Event_kind::wall && event.kind != Event_kind::collision) return;
    Contact contact = {event.kind, event.time, {}};
    for (const auto& id : {event.point_a, event.point_b}) {
      if (id) contact.changes.push_back({*id, simulation_.triangulation().motion(*id)});
    }
    contacts_.push_back(std::move(contact));
  }

  const std::vector<Contact>& contacts() const { return contacts_; }

 private:
  Simulation& simulation_;
  std::vector<Contact> contacts_;
};

template <class Kinetic>
std::uint64_t number_of(const Kinetic& triangulation, Event_kind kind) {
  return triangulation.counters().events[static_cast<std::size_t>(kind)];
}

template <class Kinetic>
std::uint64_t number_of_flips(const Kinetic& triangulation) {
  return number_of(triangulation, Event_kind::flip) +
         number_of(triangulation, Event_kind::hull_insert) +
         number_of(triangulation, Event_kind::hull_remove);
}

template <class Simulation>
long double energy(const Simulation& simulation) {
  long double sum = 0;
  for (Point_id id = 0; id < simulation.triangulation().next_id(); ++id) {
    const Vector_2 v = simulation.triangulation().motion(id).velocity;
    const long double x = v.x;
    const long double y = v.y;
    sum += (x * x + y * y) * simulation.mass(id);
  }
  return sum;
}

double drift(long double before, long double after) {
  return static_cast<double>(std::abs(after / before - 1));
}

// The work of the triangulation alone: it executes the flips between the recorded contacts, and
// gets the motions after each contact.
struct Replay {
  std::uint64_t flips = 0;
  std::vector<Edge_ids> edges;  // at the end
  double flip_seconds = 0;
  double change_seconds = 0;
};

template <class Simulation>
Replay replay(const Bench_discs& discs,
              const std::vector<typename Contact_recorder<Simulation>::Contact>& contacts,
              double until) {
  using Triangulation = typename Simulation::Triangulation;
  Triangulation triangulation(motions_of<typename Simulation::Motion>(discs));
  Replay result;
  std::vector<typename Triangulation::Change> changes;
  const Stopwatch watch;
  double last = watch.seconds();
  const auto lap = [&](double& seconds) {
    const double now = watch.seconds();
    seconds += now - last;
    last = now;
  };
  for (const auto& [kind, time, points] : contacts) {
    triangulation.advance_to(time);
    lap(result.flip_seconds);
    changes.clear();
    for (const auto& [id, motion] : points) {
      if (motion != triangulation.motion(id)) {
        changes.push_back({id, motion});
      }
    }
    triangulation.apply(kind, points.front().id, points.back().id, changes);
    lap(result.change_seconds);
  }
  triangulation.advance_to(until);
  lap(result.flip_seconds);
  result.flips = number_of_flips(triangulation);
  result.edges = triangulation.finite_edge_ids();
  return result;
}

// Throws unless both programs find the same collisions and wall contacts up to `time`.
template <class Simulation>
void check_agreement(const Bench_discs& discs, double time) {
  auto simulation = simulation_of<Simulation>(discs);
  const Contact_recorder recorder(simulation);
  simulation.advance_to(time);
  std::vector<Cell_list_discs::Pair> exact;
  for (const auto& contact : recorder.contacts()) {
    if (contact.kind != Event_kind::collision) continue;
    exact.push_back(edge_ids(contact.changes[0].id, contact.changes[1].id));
  }
  std::vector<Cell_list_discs::Pair> collisions;
  Cell_list_discs cell_list(discs.motions, discs.radii, discs.box);
  cell_list.log_collisions(collisions);
  cell_list.advance_to(time);
  // Nearly simultaneous ones may be in another order.
  std::ranges::sort(exact);
  std::ranges::sort(collisions);
  if (exact != collisions || number_of(simulation.triangulation(), Event_kind::wall) !=
                                 cell_list.counters().wall_contacts) {
    throw std::runtime_error(
        "the cell list and the exact simulation disagree before time " + std::to_string(time) +
        ": " + std::to_string(collisions.size()) + " and " + std::to_string(exact.size()) +
        " collisions, " + std::to_string(cell_list.counters().wall_contacts) + " and " +
        std::to_string(number_of(simulation.triangulation(), Event_kind::wall)) +
        " contacts with walls");
  }
}

// The mean over as many runs as take 0.2 seconds.
json measure_cell_list(const Setup& setup, const Bench_discs& discs) {
  constexpr double enough = 0.2;
  double total = 0;
  int runs = 0;
  json result;
  while (total < enough) {
    Cell_list_discs cell_list(discs.motions, discs.radii, discs.box);
    const long double energy_before = cell_list.energy();
    const Stopwatch watch;
    cell_list.advance_to(setup.until);
    total += watch.seconds();
    ++runs;
    const double overlap = cell_list.deepest_overlap();
    if (overlap > most_overlap) {
      throw std::runtime_error("discs of the cell list overlap by " + std::to_string(overlap) +
                               " of the sum of their radii");
    }
    const Cell_list_counters& counters = cell_list.counters();
    result["baseline_collisions"] = counters.collisions;
    result["baseline_wall_contacts"] = counters.wall_contacts;
    result["baseline_crossings"] = counters.crossings;
    result["baseline_looked_again"] = counters.looked_again;
    result["baseline_energy_drift"] = drift(energy_before, cell_list.energy());
    result["baseline_deepest_overlap"] = overlap;
  }
  const double seconds = total / runs;
  result["baseline_run_seconds"] = seconds;
  result["baseline_collisions_per_second"] =
      ratio(result["baseline_collisions"].get<double>(), seconds);
  return result;
}

// One run of the simulation and its replay, and several of the cell list.
template <class Simulation>
json measure_round(const Setup& setup, const Bench_discs& discs,
                   const std::vector<typename Contact_recorder<Simulation>::Contact>& contacts) {
  json result;
  double per_second = 0;
  {  // Freed before the cell list runs.
    auto simulation = simulation_of<Simulation>(discs);
    const auto& triangulation = simulation.triangulation();
    const long double energy_before = energy(simulation);
    const Stopwatch watch;
    simulation.advance_to(setup.until);
    const double seconds = watch.seconds();
    const auto collisions = static_cast<double>(number_of(triangulation, Event_kind::collision));
    const auto flips = static_cast<double>(number_of_flips(triangulation));
    const Certificate_counters certificates = simulation.certificate_counters();
    per_second = ratio(collisions, seconds);
    result["run_seconds"] = seconds;
    result["collisions"] = number_of(triangulation, Event_kind::collision);
    result["wall_contacts"] = number_of(triangulation, Event_kind::wall);
    result["flips"] = number_of_flips(triangulation);
    result["edges_rebuilt"] = number_of(triangulation, Event_kind::rebuild);
    result["filter_decided"] = certificates.filter_decided;
    result["exact_decided"] = certificates.exact_decided;
    result["collisions_per_second"] = per_second;
    result["flips_per_collision"] = ratio(flips, collisions);
    result["energy_drift"] = drift(energy_before, energy(simulation));
    const Replay parts = replay<Simulation>(discs, contacts, setup.until);
    if (parts.flips != number_of_flips(triangulation) ||
        parts.edges != triangulation.finite_edge_ids()) {
      throw std::runtime_error("the replay of the contacts has other flips than the simulation");
    }
    result["share_of_flips"] = ratio(parts.flip_seconds, seconds);
    result["share_of_changes"] = ratio(parts.change_seconds, seconds);
    result["share_of_triangulation"] = ratio(parts.flip_seconds + parts.change_seconds, seconds);
    result["seconds_per_flip"] = ratio(parts.flip_seconds, flips);
    result["seconds_per_change"] =
        ratio(parts.change_seconds, static_cast<double>(contacts.size()));
  }
  result.update(measure_cell_list(setup, discs));
  result["ratio"] = per_second / result["baseline_collisions_per_second"].get<double>();
  return result;
}

template <class Simulation>
json measure(const Setup& setup, const Bench_discs& discs) {
  auto simulation = simulation_of<Simulation>(discs);
  const Contact_recorder recorder(simulation);
  simulation.advance_to(setup.until);
  const auto collisions =
      static_cast<double>(number_of(simulation.triangulation(), Event_kind::collision));
  const double to_compare = collisions_to_compare * static_cast<double>(discs.motions.size()) / 2;
  check_agreement<Simulation>(discs, setup.until * std::min(1.0, ratio(to_compare, collisions)));
  return median_round([&] { return measure_round<Simulation>(setup, discs, recorder.contacts()); });
}

}  // namespace

json measure_discs(const Setup& setup) {
  json result = setup.size_ratio ? measure<Simulation_2<Disc_kinetic_traits_2>>(
                                       setup, discs_of_different_sizes(setup))
                                 : measure<Simulation_2<>>(setup, equal_discs(setup));
  result["area_fraction"] = setup.area_fraction;
  if (setup.size_ratio) result["size_ratio"] = *setup.size_ratio;
  return result;
}

}  // namespace kinetri::bench
