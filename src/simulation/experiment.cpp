// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/impl/simulation/experiment.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numbers>
#include <set>
#include <type_traits>
#include <utility>

#include "kinetri/impl/base/check.h"
#include "kinetri/simulation/scenarios.h"

namespace kinetri {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// The motions of each point, with the times at which they begin.
template <class Traits>
class Path_recorder : public Event_observer {
 public:
  using Motion = typename Traits::Motion;

  struct Piece {
    double from;
    Motion motion;
  };

  explicit Path_recorder(Simulation_2<Traits>& simulation)
      : simulation_(simulation), paths_(simulation.triangulation().number_of_points()) {
    for (Point_id id = 0; id < paths_.size(); ++id) add(id, 0);
    simulation.add_observer(*this);
  }

  // It reads only the motions of points that reach a wall, which are current then.
  bool looks_at_triangulation() const override { return false; }
  void after_event(const Event& event) override {
    if (event.removed) ++edge_changes_;
    if (event.added) ++edge_changes_;
    if (event.kind == Event_kind::wall) add(*event.point_a, event.time.to_double());
  }

  // Precondition: the times for each point ascend.
  Vector_2 place(Point_id id, double time) {
    const auto& path = paths_[id];
    std::size_t& i = present_.at(id);
    while (i + 1 < path.size() && path[i + 1].from <= time) ++i;
    return rounded_place(path[i].motion, time);
  }
  void rewind() { present_.assign(paths_.size(), 0); }

  double radius(Point_id id) const {
    if constexpr (HasWeight<Motion>) {
      return paths_[id].front().motion.radius;
    } else {
      return simulation_.options().radius;
    }
  }
  bool moves(Point_id id) const { return paths_[id].front().motion.velocity != Vector_2{}; }
  std::size_t size() const { return paths_.size(); }
  std::uint64_t edge_changes() const { return edge_changes_; }

 private:
  void add(Point_id id, double time) {
    paths_[id].push_back({time, simulation_.triangulation().motion(id)});
  }

  const Simulation_2<Traits>& simulation_;
  std::vector<std::vector<Piece>> paths_;  // by point id
  std::vector<std::size_t> present_;       // which piece, by point id
  std::uint64_t edge_changes_ = 0;
};

// The discrete approach: a triangulation of the positions at successive steps.
template <class Traits>
class Discrete_run {
 public:
  explicit Discrete_run(Path_recorder<Traits>& paths)
      : paths_(paths), vertices_(paths.size()), places_(paths.size()) {
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
      // Its new position is near the old one.
      const auto face = vertices_[id]->face();
      const auto neighbor = is_hidden(vertices_[id])
                                ? face->vertex(0)
                                : face->vertex(Triangulation::ccw(face->index(vertices_[id])));
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
  using Delaunay = CGAL::Delaunay_triangulation_2<
      Kernel, CGAL::Triangulation_data_structure_2<
                  CGAL::Triangulation_vertex_base_with_info_2<Point_id, Kernel>>>;
  using Regular = CGAL::Regular_triangulation_2<
      Kernel, CGAL::Triangulation_data_structure_2<
                  CGAL::Triangulation_vertex_base_with_info_2<
                      Point_id, Kernel, CGAL::Regular_triangulation_vertex_base_2<Kernel>>,
                  CGAL::Regular_triangulation_face_base_2<Kernel>>>;
  static constexpr bool has_radii = HasWeight<typename Traits::Motion>;
  using Triangulation = std::conditional_t<has_radii, Regular, Delaunay>;

  static bool is_hidden(typename Triangulation::Vertex_handle v) {
    if constexpr (has_radii) {
      return v->is_hidden();
    } else {
      return false;
    }
  }

  void insert(Point_id id, double time, typename Triangulation::Face_handle near_by) {
    const Vector_2 place = paths_.place(id, time);
    const Kernel::Point_2 point(place.x, place.y);
    if constexpr (has_radii) {
      const double radius = paths_.radius(id);
      vertices_[id] = triangulation_.insert({point, radius * radius}, near_by);
    } else {
      vertices_[id] = triangulation_.insert(point, near_by);
    }
    vertices_[id]->info() = id;
    places_[id] = point;
  }

  // Compares edges and overlaps with those of the previous step.
  void look() {
    std::set<Edge_ids> edges;
    std::set<Edge_ids> overlaps;
    for (const auto& [face, i] : triangulation_.finite_edges()) {
      const auto a = face->vertex(Triangulation::cw(i));
      const auto b = face->vertex(Triangulation::ccw(i));
      const Edge_ids ids = edge_ids(a->info(), b->info());
      edges.insert(ids);
      const double reach = paths_.radius(ids[0]) + paths_.radius(ids[1]);
      if (CGAL::squared_distance(places_[ids[0]], places_[ids[1]]) <= reach * reach) {
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

  Path_recorder<Traits>& paths_;
  Triangulation triangulation_;
  std::vector<typename Triangulation::Vertex_handle> vertices_;  // by point id
  std::vector<Kernel::Point_2> places_;                          // by point id
  std::set<Edge_ids> edges_;
  std::set<Edge_ids> overlaps_;
  std::uint64_t edge_changes_ = 0;
  std::uint64_t contacts_ = 0;
  double seconds_ = 0;
};

// Discs without overlaps, in the cells of a grid.
class Apart {
 public:
  Apart(double side, double greatest_radius, std::size_t discs) : side_(side) {
    const double most = std::sqrt(static_cast<double>(discs));
    const double least_width = 2.001 * greatest_radius;  // more than the diameter, rounded
    cells_in_row_ =
        static_cast<std::size_t>(std::max(1.0, std::floor(std::min(most, side / least_width))));
    cells_.resize(cells_in_row_ * cells_in_row_);
  }

  // Adds the disc, unless it overlaps or almost overlaps another one.
  bool add(const Disc_motion_2& disc) {
    const std::size_t column = cell(disc.position.x);
    const std::size_t row = cell(disc.position.y);
    // Discs in other cells are at least the greatest diameter away.
    for (std::size_t r = row - (row > 0 ? 1 : 0); r < std::min(row + 2, cells_in_row_); ++r) {
      for (std::size_t c = column - (column > 0 ? 1 : 0); c < std::min(column + 2, cells_in_row_);
           ++c) {
        for (const Disc_motion_2& other : cells_[r * cells_in_row_ + c]) {
          if (do_almost_overlap(disc, other)) return false;
        }
      }
    }
    cells_[row * cells_in_row_ + column].push_back(disc);
    return true;
  }

 private:
  std::size_t cell(double coordinate) const {
    const double index = std::floor(coordinate / side_ * static_cast<double>(cells_in_row_));
    return std::min(static_cast<std::size_t>(index), cells_in_row_ - 1);
  }

  // The factor exceeds all roundings.
  static bool do_almost_overlap(const Disc_motion_2& a, const Disc_motion_2& b) {
    const double x = a.position.x - b.position.x;
    const double y = a.position.y - b.position.y;
    const double reach = a.radius + b.radius;
    return x * x + y * y <= reach * reach * (1 + 0x1p-40);
  }

  double side_;
  std::size_t cells_in_row_ = 1;
  std::vector<std::vector<Disc_motion_2>> cells_;  // row by row
};

Scenario_options uniform_options(const Experiment_setting& setting) {
  Scenario_options result;
  result.points = setting.points;
  result.seed = setting.seed;
  result.side = setting.side;
  result.speed = setting.speed;
  return result;
}

// Calls `function` with the traits and the motions of the setting.
template <class Function>
auto with_points(const Experiment_setting& setting, Function function) {
  if (setting.has_sizes()) return function(Disc_kinetic_traits_2(), experiment_discs(setting));
  return function(Linear_kinetic_traits_2(), experiment_motions(setting));
}

template <class Traits>
Experiment_result run(const std::vector<typename Traits::Motion>& motions,
                      const Experiment_setting& setting) {
  const auto start = Clock::now();
  Simulation_2<Traits> simulation(motions, experiment_options(setting));
  simulation.advance_to(setting.duration);
  const double seconds = seconds_since(start);
  return {simulation.triangulation().counters(), simulation.contact_counters(),
          simulation.certificate_counters(), seconds};
}

template <class Traits>
std::vector<Discrete_comparison> compare(const std::vector<typename Traits::Motion>& motions,
                                         const Experiment_setting& passing,
                                         const std::vector<double>& steps) {
  Discrete_comparison kinetic;
  kinetic.kinetic_seconds = run<Traits>(motions, passing).seconds;

  Simulation_2<Traits> simulation(motions, experiment_options(passing));
  simulation.advance_to(0.0);  // overlaps at the start do not count as contacts
  Path_recorder<Traits> paths(simulation);
  const Triangulation_counters before = simulation.triangulation().counters();
  simulation.advance_to(passing.duration);
  const Triangulation_counters& after = simulation.triangulation().counters();
  const auto count = [&](Event_kind kind) {
    const auto i = static_cast<std::size_t>(kind);
    return after.events[i] - before.events[i];
  };
  kinetic.contacts = count(Event_kind::collision);
  kinetic.topologic_events = count(Event_kind::flip) + count(Event_kind::hull_insert) +
                             count(Event_kind::hull_remove) + count(Event_kind::hide) +
                             count(Event_kind::reveal);
  kinetic.edge_changes = paths.edge_changes();

  std::vector<Discrete_comparison> result;
  for (const double step : steps) {
    KINETRI_PRECONDITION(step > 0, "a time step is not greater than 0");
    Discrete_run<Traits> run(paths);
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

}  // namespace

double Experiment_setting::covered_share() const {
  const double small = diameter / 2;
  const double large = small * size_ratio;
  const auto number_of_large = static_cast<double>(points / 2);
  const double number_of_small = static_cast<double>(points) - number_of_large;
  return std::numbers::pi * (number_of_small * small * small + number_of_large * large * large) /
         (side * side);
}

Simulation_options experiment_options(const Experiment_setting& setting) {
  Simulation_options result;
  result.box = Box_2{0, 0, setting.side, setting.side};
  result.radius = setting.has_sizes() ? 0 : setting.diameter / 2;
  result.refuses_overlaps = setting.has_sizes();
  result.response = setting.response;
  return result;
}

std::vector<Linear_motion_2> experiment_motions(const Experiment_setting& setting) {
  KINETRI_PRECONDITION(
      setting.movers <= setting.points,
      "more points move than there are; expected as many movers as points, or fewer");
  std::vector<Linear_motion_2> motions = make_scenario(Scenario::uniform, uniform_options(setting));
  for (std::size_t i = setting.movers; i < motions.size(); ++i) motions[i].velocity = {};
  return motions;
}

// Large discs are placed first. Discs of twice the radii about the placed ones cover less than the
// box, while the area fraction is at most a quarter: so there is always a free position.
std::vector<Disc_motion_2> experiment_discs(const Experiment_setting& setting) {
  KINETRI_PRECONDITION(setting.size_ratio >= 1, "the size ratio of an experiment is less than 1");
  KINETRI_PRECONDITION(setting.covered_share() <= greatest_covered_share,
                       "discs of two sizes cover more than a quarter of the box of an experiment");
  const double small = setting.diameter / 2;
  const double large = small * setting.size_ratio;
  std::vector<Disc_motion_2> result;
  for (const Linear_motion_2& motion : experiment_motions(setting)) {
    result.push_back({motion, result.size() % 2 == 0 ? small : large, 0, 0});
  }
  Apart apart(setting.side, large, result.size());
  Scenario_options more = uniform_options(setting);
  for (const std::size_t first : {std::size_t{1}, std::size_t{0}}) {
    std::vector<std::size_t> waiting;
    for (std::size_t id = first; id < result.size(); id += 2) waiting.push_back(id);
    for (;;) {
      std::erase_if(waiting, [&](std::size_t id) { return apart.add(result[id]); });
      if (waiting.empty()) break;
      more.points = waiting.size();
      more.seed += 0x9e3779b97f4a7c15;  // far from the seeds that users take
      const std::vector<Linear_motion_2> places = make_scenario(Scenario::uniform, more);
      for (std::size_t i = 0; i < waiting.size(); ++i) {
        result[waiting[i]].position = places[i].position;
      }
    }
  }
  return result;
}

Experiment_result run_experiment(const Experiment_setting& setting) {
  return with_points(setting, [&]<class Traits>(const Traits& /*traits*/, const auto& motions) {
    return run<Traits>(motions, setting);
  });
}

std::vector<Discrete_comparison> compare_with_discrete_steps(const Experiment_setting& setting,
                                                             const std::vector<double>& steps) {
  Experiment_setting passing = setting;
  passing.response = log_contact;
  return with_points(passing, [&]<class Traits>(const Traits& /*traits*/, const auto& motions) {
    return compare<Traits>(motions, passing, steps);
  });
}

}  // namespace kinetri
