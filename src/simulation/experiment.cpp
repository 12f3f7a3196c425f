// SPDX-License-Identifier: GPL-3.0-or-later
#include "experiment.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <set>
#include <utility>

#include "kinetri/base/check.h"
#include "kinetri/simulation/scenarios.h"

namespace kinetri {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// The motion of each point over time: each of its motions, with the time from which on it holds.
class Path_recorder : public Simulation_2<>::Observer {
 public:
  struct Piece {
    double from;
    Linear_motion_2 motion;
  };

  explicit Path_recorder(Simulation_2<>& simulation)
      : simulation_(simulation), paths_(simulation.triangulation().number_of_points()) {
    for (Point_id id = 0; id < paths_.size(); ++id) add(id, 0);
    simulation.add_observer(*this);
  }

  void after_event(const Event& event) override {
    if (event.removed) ++edge_changes_;
    if (event.added) ++edge_changes_;
    if (event.kind == Event_kind::wall) add(*event.point_a, event.time.to_double());
  }

  // Of each point in turn, at times that ascend.
  Vector_2 place(Point_id id, double time) {
    const auto& path = paths_[id];
    std::size_t& i = present_.at(id);
    while (i + 1 < path.size() && path[i + 1].from <= time) ++i;
    return rounded_place(path[i].motion, time);
  }
  void rewind() { present_.assign(paths_.size(), 0); }

  bool moves(Point_id id) const { return paths_[id].front().motion.velocity != Vector_2{}; }
  std::size_t size() const { return paths_.size(); }
  std::uint64_t edge_changes() const { return edge_changes_; }

 private:
  void add(Point_id id, double time) {
    paths_[id].push_back({time, simulation_.triangulation().motion(id)});
  }

  const Simulation_2<>& simulation_;
  std::vector<std::vector<Piece>> paths_;  // by point id
  std::vector<std::size_t> present_;       // which piece, by point id
  std::uint64_t edge_changes_ = 0;
};

// The discrete approach: a triangulation of the places at one step after another.
class Discrete_run {
 public:
  Discrete_run(Path_recorder& paths, double diameter)
      : paths_(paths), squared_diameter_(diameter * diameter), vertices_(paths.size()) {
    paths_.rewind();
    const auto start = Clock::now();
    for (Point_id id = 0; id < paths_.size(); ++id) insert(id, 0, {});
    seconds_ += seconds_since(start);
    look();
    edge_changes_ = 0;
    contacts_ = 0;
  }

  void go_to(double time) {
    const auto start = Clock::now();
    for (Point_id id = 0; id < paths_.size(); ++id) {
      if (!paths_.moves(id)) continue;
      // Its new place is near to its neighbors of before.
      const auto face = vertices_[id]->face();
      const auto neighbor = face->vertex(Triangulation::ccw(face->index(vertices_[id])));
      triangulation_.remove(vertices_[id]);
      insert(id, time, neighbor->face());
    }
    seconds_ += seconds_since(start);
    look();
  }

  double seconds() const { return seconds_; }
  std::uint64_t edge_changes() const { return edge_changes_; }
  std::uint64_t contacts() const { return contacts_; }

 private:
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Triangulation = CGAL::Delaunay_triangulation_2<
      Kernel, CGAL::Triangulation_data_structure_2<
                  CGAL::Triangulation_vertex_base_with_info_2<Point_id, Kernel>>>;

  void insert(Point_id id, double time, Triangulation::Face_handle near_by) {
    const Vector_2 place = paths_.place(id, time);
    vertices_[id] = triangulation_.insert({place.x, place.y}, near_by);
    vertices_[id]->info() = id;
  }

  // Compares edges and overlaps with those of the step before.
  void look() {
    std::set<Edge_ids> edges;
    std::set<Edge_ids> overlaps;
    for (const auto& [face, i] : triangulation_.finite_edges()) {
      const auto a = face->vertex(Triangulation::cw(i));
      const auto b = face->vertex(Triangulation::ccw(i));
      const Edge_ids ids = edge_ids(a->info(), b->info());
      edges.insert(ids);
      if (CGAL::squared_distance(a->point(), b->point()) <= squared_diameter_) {
        overlaps.insert(ids);
      }
    }
    std::vector<Edge_ids> changes;
    std::ranges::set_symmetric_difference(edges, edges_, std::back_inserter(changes));
    edge_changes_ += changes.size();
    changes.clear();
    std::ranges::set_difference(overlaps, overlaps_, std::back_inserter(changes));
    contacts_ += changes.size();
    edges_ = std::move(edges);
    overlaps_ = std::move(overlaps);
  }

  Path_recorder& paths_;
  double squared_diameter_;
  Triangulation triangulation_;
  std::vector<Triangulation::Vertex_handle> vertices_;  // by point id
  std::set<Edge_ids> edges_;
  std::set<Edge_ids> overlaps_;
  std::uint64_t edge_changes_ = 0;
  std::uint64_t contacts_ = 0;
  double seconds_ = 0;
};

}  // namespace

Simulation_options experiment_options(const Experiment_setting& setting) {
  Simulation_options result;
  result.box = Box_2{0, 0, setting.side, setting.side};
  result.radius = setting.diameter / 2;
  result.response = setting.response;
  return result;
}

std::vector<Linear_motion_2> experiment_motions(const Experiment_setting& setting) {
  KINETRI_PRECONDITION(
      setting.movers <= setting.points,
      "more points move than there are; expected as many movers as points, or fewer");
  Scenario_options scenario;
  scenario.points = setting.points;
  scenario.seed = setting.seed;
  scenario.side = setting.side;
  scenario.speed = setting.speed;
  std::vector<Linear_motion_2> motions = make_scenario(Scenario::uniform, scenario);
  for (std::size_t i = setting.movers; i < motions.size(); ++i) motions[i].velocity = {};
  return motions;
}

Experiment_result run_experiment(const Experiment_setting& setting) {
  const std::vector<Linear_motion_2> motions = experiment_motions(setting);
  const auto start = Clock::now();
  Simulation_2<> simulation(motions, experiment_options(setting));
  simulation.advance_to(setting.duration);
  const double seconds = seconds_since(start);
  return {simulation.triangulation().counters(), simulation.contact_counters(),
          simulation.certificate_counters(), seconds};
}

std::vector<Discrete_comparison> compare_with_discrete_steps(const Experiment_setting& setting,
                                                             const std::vector<double>& steps) {
  Experiment_setting passing = setting;
  passing.response = log_contact;
  const std::vector<Linear_motion_2> motions = experiment_motions(passing);
  Discrete_comparison kinetic;
  kinetic.kinetic_seconds = run_experiment(passing).seconds;

  Simulation_2<> simulation(motions, experiment_options(passing));
  simulation.advance_to(0.0);  // discs that overlap at the start are no contacts to be missed
  Path_recorder paths(simulation);
  const Triangulation_counters before = simulation.triangulation().counters();
  simulation.advance_to(passing.duration);
  const Triangulation_counters& after = simulation.triangulation().counters();
  const auto count = [&](Event_kind kind) {
    const auto i = static_cast<std::size_t>(kind);
    return after.events[i] - before.events[i];
  };
  kinetic.contacts = count(Event_kind::collision);
  kinetic.topologic_events =
      count(Event_kind::flip) + count(Event_kind::hull_insert) + count(Event_kind::hull_remove);
  kinetic.edge_changes = paths.edge_changes();

  std::vector<Discrete_comparison> result;
  for (const double step : steps) {
    KINETRI_PRECONDITION(step > 0, "a time step is not greater than 0");
    Discrete_run run(paths, passing.diameter);
    const auto number = static_cast<std::uint64_t>(std::floor(passing.duration / step));
    for (std::uint64_t i = 1; i <= number; ++i) run.go_to(static_cast<double>(i) * step);
    Discrete_comparison comparison = kinetic;
    comparison.step = step;
    comparison.seconds = run.seconds();
    const auto missed = [](std::uint64_t all, std::uint64_t seen) {
      return all > seen ? all - seen : 0;
    };
    comparison.edge_changes_missed = missed(kinetic.edge_changes, run.edge_changes());
    comparison.contacts_missed = missed(kinetic.contacts, run.contacts());
    result.push_back(comparison);
  }
  return result;
}

}  // namespace kinetri
