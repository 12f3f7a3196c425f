// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/observers/mean_cell_areas.h"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "kinetri/impl/base/check.h"
#include "observers/edge_follower.h"
#include "observers/limited_cell.h"
#include "observers/sides_of_cell.h"

namespace kinetri {

namespace detail {

/// Integrates areas of cells of given points over time.
template <class Traits>
class Cell_integrator {
 public:
  using Point_2 = Certified_point_2<Traits>;  ///< in a periodic box: an image

  Cell_integrator(const Traits& traits, Cell_limits limits, double tolerance)
      : traits_(traits),
        limits_(std::move(limits)),
        tolerance_(tolerance),
        cell_(limits_, is_periodic) {}

  /// The integral from one time to a later one, and its error, for the cell of the first point
  /// among `points`.
  std::pair<double, double> integral(const std::vector<Point_2>& points, double from,
                                     double until) {
    greatest_error_ = 0;
    const Estimate whole = estimate(points, from, until);
    const double allowed = tolerance_ * whole.integral / (until - from);
    constexpr int most_halvings = 10;
    const Estimate result = refined(points, from, until, whole, allowed, most_halvings);
    // Times and the sum are rounded.
    const double rounding = 0x1p-50 * (std::abs(from) + std::abs(until)) / (until - from);
    return {result.integral, result.error + greatest_error_ * (until - from) +
                                 (rounding + 0x1p-48) * result.integral};
  }

 private:
  static constexpr bool is_periodic = PeriodicKineticTraits_2<Traits>;

  struct Estimate {
    double integral = 0;
    double error = 0;  // the difference of the two rules
  };

  // One application of the rules. (The integrator of Boost 1.74 compares errors for the interval
  // from -1 to 1 with integrals for another one.)
  Estimate estimate(const std::vector<Point_2>& points, double from, double until) {
    using Kronrod = boost::math::quadrature::gauss_kronrod<double, 7>;
    using Gauss = boost::math::quadrature::gauss<double, 3>;
    const double middle = from / 2 + until / 2;
    const double scale = until / 2 - from / 2;
    double kronrod = 0;
    double gauss = 0;
    for (std::size_t i = 0; i < Kronrod::abscissa().size(); ++i) {
      const double step = scale * Kronrod::abscissa()[i];
      double sum = area_at(points, middle + step);
      if (i > 0) sum += area_at(points, middle - step);
      kronrod += Kronrod::weights()[i] * sum;
      if (i % 2 == 0) gauss += Gauss::weights()[i / 2] * sum;
    }
    return {scale * kronrod, scale * std::abs(kronrod - gauss)};
  }

  // Halves the interval until the error is at most `allowed` per unit of time.
  Estimate refined(const std::vector<Point_2>& points, double from, double until,
                   const Estimate& whole, double allowed, int most_halvings) {
    if (most_halvings == 0 || whole.error <= allowed * (until - from)) return whole;
    const double middle = from / 2 + until / 2;
    const Estimate first =
        refined(points, from, middle, estimate(points, from, middle), allowed, most_halvings - 1);
    const Estimate second =
        refined(points, middle, until, estimate(points, middle, until), allowed, most_halvings - 1);
    return {first.integral + second.integral, first.error + second.error};
  }

  double area_at(const std::vector<Point_2>& points, double t) {
    const Algebraic_number time(t);
    const Sides_at_time<Traits> at_time(traits_, time);
    sides_.half_planes.clear();
    sides_.displacement = 0;
    sides_.is_empty = false;
    const Point_2& p = points.front();
    const Ball_2 place = at_time.place(p);
    const auto neighbors = std::span(points).subspan(1);
    for (const Point_2& q : neighbors) at_time.add(p, place, q, at_time.place(q), sides_);
    cell_.set_reach(at_time.reach());
    // A periodic box has no walls, for which the position would matter.
    const Cell_area result = cell_.measure(sides_, is_periodic ? Ball_2() : place,
                                           Exact_cell_at_time(at_time, p, neighbors));
    greatest_error_ = std::max(greatest_error_, result.error);
    return result.area;
  }

  const Traits& traits_;
  const Cell_limits limits_;
  const double tolerance_;
  Limited_cell cell_;
  Sides_of_cell sides_;
  double greatest_error_ = 0;  // of the areas of an integral
};

// Follows the neighbors of each cell, and integrates its area while these do not change.
template <DistanceKineticTraits_2 Traits>
class Mean_area_tracker final : private Edge_follower<Traits> {
 public:
  Mean_area_tracker(Simulation_2<Traits>& simulation, const Cell_limits& limits, double tolerance);
  Mean_area_tracker(Kinetic_triangulation_2<Traits>& triangulation, const Cell_limits& limits,
                    double tolerance);

  std::vector<Mean_cell_area> means();

 private:
  using typename Edge_follower<Traits>::Changed_point;
  using typename Edge_follower<Traits>::Edge_name;
  using typename Edge_follower<Traits>::Image_2;
  using typename Edge_follower<Traits>::Neighbor;

  struct Record {
    double from = 0;
    double until = 0;  // the end of what has been integrated
    double integral = 0;
    double error = 0;
    bool has_come = false;
    bool is_there = false;
    bool is_hidden = false;            // by a triangle
    bool is_linked = false;            // hidden by a point that coincides with it for a while
    int count = 1;                     // of points that share the cell
    std::vector<Image_2> points = {};  // the point, and the neighbors of the cell
  };

  void start(const Cell_limits& limits, double tolerance);
  void advance(const Algebraic_number& /*time*/) override {}
  void change(const Algebraic_number& time, std::span<const Edge_name> removed,
              std::span<const Edge_name> added, std::span<const Changed_point> points) override;
  void integrate(Record& record, double until);
  void begin(Point_id id, double time);
  void update_link(Point_id id);
  // The point that has the vertex of the point.
  Point_id shown_at(Point_id id) const {
    const auto link = this->graph().link(id);
    return link ? ids_of(*link)[0] : id;
  }
  // Whether a neighbor of a point is one that it hides.
  bool is_hidden_by(Point_id shown, const Neighbor& neighbor) const {
    return id_of(neighbor) != shown && shown_at(id_of(neighbor)) == shown;
  }

  std::unique_ptr<Cell_integrator<Traits>> integrator_;
  std::vector<Record> records_;  // by id
  std::size_t edges_ = 0;        // of the graph
  std::size_t links_ = 0;        // those of them that join points that coincide for a while
};

template <DistanceKineticTraits_2 Traits>
Mean_area_tracker<Traits>::Mean_area_tracker(Simulation_2<Traits>& simulation,
                                             const Cell_limits& limits, double tolerance)
    : Edge_follower<Traits>(simulation) {
  start(limits, tolerance);
}

template <DistanceKineticTraits_2 Traits>
Mean_area_tracker<Traits>::Mean_area_tracker(Kinetic_triangulation_2<Traits>& triangulation,
                                             const Cell_limits& limits, double tolerance)
    : Edge_follower<Traits>(triangulation) {
  start(limits, tolerance);
}

template <DistanceKineticTraits_2 Traits>
void Mean_area_tracker<Traits>::start(const Cell_limits& limits, double tolerance) {
  KINETRI_PRECONDITION(tolerance > 0, "the tolerance is " + std::to_string(tolerance) +
                                          "; expected a number greater than 0");
  integrator_ = std::make_unique<Cell_integrator<Traits>>(this->traits(), limits, tolerance);
  const double now = this->triangulation().current_time().to_double();
  records_.resize(this->graph().next_id());
  for (Point_id id = 0; id < this->graph().next_id(); ++id) {
    if (!this->graph().contains(id)) continue;
    edges_ += this->graph().neighbors(id).size();
    update_link(id);
  }
  edges_ /= 2;
  for (Point_id id = 0; id < this->graph().next_id(); ++id) {
    if (this->graph().contains(id)) begin(id, now);
  }
}

template <DistanceKineticTraits_2 Traits>
std::vector<Mean_cell_area> Mean_area_tracker<Traits>::means() {
  this->update();
  const double now = this->triangulation().current_time().to_double();
  std::vector<Mean_cell_area> result;
  for (Point_id id = 0; id < records_.size(); ++id) {
    Record& record = records_[id];
    if (record.is_there) integrate(record, now);
    if (!record.has_come || record.until == record.from) continue;
    const double length = record.until - record.from;
    result.push_back(
        {id, record.from, record.until, record.integral / length, record.error / length});
  }
  return result;
}

// Integrates from the last change to `until`.
template <DistanceKineticTraits_2 Traits>
void Mean_area_tracker<Traits>::integrate(Record& record, double until) {
  if (until == record.until) return;
  if (!record.is_hidden) {
    const auto [integral, error] = integrator_->integral(record.points, record.until, until);
    record.integral += integral / record.count;
    record.error += error / record.count;
  }
  record.until = until;
}

// Counts the point among those that others hide, if it is.
template <DistanceKineticTraits_2 Traits>
void Mean_area_tracker<Traits>::update_link(Point_id id) {
  Record& record = records_[id];
  if (record.is_linked) --links_;
  record.is_linked = this->graph().link(id).has_value();
  if (record.is_linked) ++links_;
}

// A point has these neighbors from now on.
template <DistanceKineticTraits_2 Traits>
void Mean_area_tracker<Traits>::begin(Point_id id, double time) {
  Record& record = records_[id];
  if (!record.has_come) record.from = record.until = time;
  record.has_come = true;
  record.is_there = true;
  record.count = 1;
  const Point_id shown = shown_at(id);
  // Images are as the point that is shown sees them.
  const auto link = this->graph().link(id);
  record.points.assign(1, link ? this->second_end(*link) : this->itself(id));
  for (const Neighbor& neighbor : this->graph().neighbors(shown)) {
    if (is_hidden_by(shown, neighbor)) {
      ++record.count;
    } else {
      record.points.push_back(this->image(neighbor));
    }
  }
  // If the triangulation has edges, triangles hide points without one; else they hide all but one.
  record.is_hidden = record.points.size() == 1 && edges_ > links_;
  if (edges_ > links_) return;
  for (Point_id other = 0; other < this->graph().next_id(); ++other) {
    if (this->graph().contains(other) && shown_at(other) != shown) {
      record.points.push_back(this->itself(other));
    }
  }
}

template <DistanceKineticTraits_2 Traits>
void Mean_area_tracker<Traits>::change(const Algebraic_number& time,
                                       std::span<const Edge_name> removed,
                                       std::span<const Edge_name> added,
                                       std::span<const Changed_point> points) {
  const double now = time.to_double();
  records_.resize(this->graph().next_id());
  const bool had_edges = edges_ > links_;
  edges_ += added.size();
  edges_ -= removed.size();
  std::set<Point_id> changed;
  for (const auto edges : {removed, added}) {
    for (const Edge_name& edge : edges) changed.insert(ids_of(edge).begin(), ids_of(edge).end());
  }
  for (const Changed_point& point : points) {
    changed.insert(point.id);
    if (!this->graph().contains(point.id)) continue;
    for (const Neighbor& neighbor : this->graph().neighbors(point.id)) {
      changed.insert(id_of(neighbor));
    }
  }
  for (const Point_id id : changed) update_link(id);
  if (links_ > 0) {
    // All that share a cell.
    for (const Point_id id : std::vector(changed.begin(), changed.end())) {
      if (!this->graph().contains(id)) continue;
      const Point_id shown = shown_at(id);
      changed.insert(shown);
      for (const Neighbor& neighbor : this->graph().neighbors(shown)) {
        if (is_hidden_by(shown, neighbor)) changed.insert(id_of(neighbor));
      }
    }
  }
  if (!had_edges || edges_ == links_) {  // at most one point has a cell of its own
    for (Point_id id = 0; id < records_.size(); ++id) changed.insert(id);
  }
  for (const Point_id id : changed) {
    Record& record = records_[id];
    if (record.is_there) integrate(record, now);
    record.is_there = this->graph().contains(id);
    if (record.is_there) {
      begin(id, now);
    } else {
      record.points = {};
    }
  }
}

}  // namespace detail

template <DistanceKineticTraits_2 Traits>
Mean_cell_areas<Traits>::Mean_cell_areas(Simulation_2<Traits>& simulation,
                                         const Cell_limits& limits, double tolerance)
    : tracker_(std::make_unique<detail::Mean_area_tracker<Traits>>(simulation, limits, tolerance)) {
}

template <DistanceKineticTraits_2 Traits>
Mean_cell_areas<Traits>::Mean_cell_areas(Kinetic_triangulation_2<Traits>& triangulation,
                                         const Cell_limits& limits, double tolerance)
    : tracker_(
          std::make_unique<detail::Mean_area_tracker<Traits>>(triangulation, limits, tolerance)) {}

template <DistanceKineticTraits_2 Traits>
Mean_cell_areas<Traits>::~Mean_cell_areas() = default;

template <DistanceKineticTraits_2 Traits>
std::vector<Mean_cell_area> Mean_cell_areas<Traits>::means() {
  return tracker_->means();
}

template class Mean_cell_areas<Linear_kinetic_traits_2>;
template class Mean_cell_areas<Polynomial_kinetic_traits_2>;
template class Mean_cell_areas<Disc_kinetic_traits_2>;
template class Mean_cell_areas<Polynomial_disc_kinetic_traits_2>;
template class Mean_cell_areas<Periodic_kinetic_traits_2>;
template class Mean_cell_areas<Periodic_disc_kinetic_traits_2>;

}  // namespace kinetri
