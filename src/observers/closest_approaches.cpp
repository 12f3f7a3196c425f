// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/observers/closest_approaches.h"

#include <algorithm>
#include <limits>
#include <map>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "kinetri/impl/base/check.h"
#include "observers/departures.h"
#include "observers/edge_follower.h"
#include "observers/enlarged_discs.h"

namespace kinetri {
namespace detail {

// Follows the pairs that have an edge or overlap, in a periodic box pairs of images, and keeps the
// nearest ones. Invariant, at the last reported time: each such pair has a piece.
template <HasLinearMotion Traits>
class Approach_tracker final : private Edge_follower<Traits> {
 public:
  using typename Edge_follower<Traits>::Edge_name;
  using typename Edge_follower<Traits>::Image_2;
  using typename Edge_follower<Traits>::Neighbor;
  using typename Edge_follower<Traits>::Time;
  using Edge_follower<Traits>::is_periodic;
  using Disc = decltype(disc_about(std::declval<typename Image_2::Motion>(), 0.0));

  Approach_tracker(Simulation_2<Traits>& simulation, std::size_t number);

  std::vector<Approach> approaches();

 private:
  using typename Edge_follower<Traits>::Changed_point;
  static constexpr bool has_radii = HasWeight<typename Traits::Motion>;

  // A pair that has an edge or overlaps, since that began or the last change of a motion.
  struct Piece {
    Disc p;
    Disc q;
    Time since;
    bool has_touched = false;  // it counts if its discs touch, and not as an edge
  };

  // The least gap of a piece.
  struct Candidate {
    Edge_name points = {};
    Gap_of_pair<Disc> least;
  };

  // A point that is inserted or erased, with its motion at that time.
  struct Passing {
    Point_id id;
    Disc disc;
  };

  static bool is_nearer(const Candidate& a, const Candidate& b);

  void advance(const Time& time) override;
  void change(const Time& time, std::span<const Edge_name> removed,
              std::span<const Edge_name> added, std::span<const Changed_point> points) override;
  void change_overlaps(const Time& time, std::span<const Edge_name> removed,
                       std::span<const Changed_point> points);
  std::pair<Disc, Disc> discs(const Edge_name& pair) const;
  void begin(const Edge_name& pair, const Time& time);
  void begin_overlap(const Edge_name& pair, const Time& time);
  void begin_overlaps(Point_id id, const Time& time);
  void end(const Edge_name& pair, const Time& time);
  void end_overlaps(Point_id id, const Time& time);
  void examine(const Edge_name& pair, const Piece& piece, const Time& until);
  void note_passing(const Time& time, std::span<const Changed_point> points);
  void examine_moment();
  void examine_nearest_by_order(const std::vector<Disc>& gone, const std::vector<Disc>& come);
  void examine_at_moment(std::size_t gone, std::size_t come);
  void keep(Candidate candidate);
  void drop_all_but_nearest();

  double radius_;  // of points without radii of their own
  std::size_t number_;
  std::map<Edge_name, Piece> pieces_;
  // Of each pair with a piece but without an edge both ends, each with the other one.
  std::map<Point_id, std::vector<Neighbor>> overlaps_;
  // The points that have been erased and inserted at one time.
  Time moment_;
  std::vector<Passing> gone_;
  std::vector<Passing> come_;
  std::map<Edge_name, Candidate> nearest_;
  // `number_` pairs have had this gap or a smaller one: pairs with greater gaps are not kept.
  double limit_;
  struct Nothing {};
  [[no_unique_address]] std::conditional_t<has_radii, std::unique_ptr<Enlarged_discs<Traits>>,
                                           Nothing>
      enlarged_discs_;
};

template <HasLinearMotion Traits>
Approach_tracker<Traits>::Approach_tracker(Simulation_2<Traits>& simulation, std::size_t number)
    : Edge_follower<Traits>(simulation),
      radius_(simulation.options().radius),
      number_(number),
      limit_(std::numeric_limits<double>::infinity()) {
  KINETRI_PRECONDITION(number > 0, "no approach is asked for");
  const auto& graph = this->graph();
  const Time& now = this->triangulation().current_time();
  for (const Edge_name& edge : graph.edges()) begin(edge, now);
  if constexpr (has_radii) {
    enlarged_discs_ = std::make_unique<Enlarged_discs<Traits>>(graph, 0, now, this->traits());
    for (Point_id id = 0; id < graph.next_id(); ++id) {
      if (graph.contains(id)) begin_overlaps(id, now);
    }
  }
}

template <HasLinearMotion Traits>
std::vector<Approach> Approach_tracker<Traits>::approaches() {
  this->update();
  const Time& now = this->triangulation().current_time();
  for (auto& [pair, piece] : pieces_) {
    examine(pair, piece, now);
    piece.since = now;
  }
  drop_all_but_nearest();
  std::vector<const Candidate*> sorted;
  for (const auto& [pair, candidate] : nearest_) sorted.push_back(&candidate);
  std::ranges::sort(sorted, [](const auto* a, const auto* b) { return is_nearer(*a, *b); });
  std::vector<Approach> result;
  for (const Candidate* candidate : sorted) {
    const Gap_of_pair<Disc>& least = candidate->least;
    result.push_back({ids_of(candidate->points), least.time(), least.rounded_distance(),
                      least.rounded(), offset_of(candidate->points)});
  }
  return result;
}

// ---- which pairs ----

template <HasLinearMotion Traits>
void Approach_tracker<Traits>::advance(const Time& time) {
  if constexpr (has_radii) {
    for (const auto& [pair, since] : enlarged_discs_->advance_to(time)) begin_overlap(pair, since);
  }
}

template <HasLinearMotion Traits>
void Approach_tracker<Traits>::change(const Time& time, std::span<const Edge_name> removed,
                                      std::span<const Edge_name> added,
                                      std::span<const Changed_point> points) {
  for (const Edge_name& edge : removed) end(edge, time);
  std::vector<Edge_name> turned;  // the edges that remain, with other motions
  for (const auto& point : points) {
    end_overlaps(point.id, time);
    if (!this->graph().contains(point.id)) continue;
    for (const Neighbor& other : this->graph().neighbors(point.id)) {
      turned.push_back(pair_of(point.id, other));
    }
  }
  std::erase_if(turned, [this](const Edge_name& edge) { return !pieces_.contains(edge); });
  std::ranges::sort(turned);
  turned.erase(std::unique(turned.begin(), turned.end()), turned.end());
  for (const Edge_name& edge : turned) {
    end(edge, time);
    begin(edge, time);
  }
  for (const Edge_name& edge : added) {
    end(edge, time);
    begin(edge, time);
  }
  if constexpr (has_radii) change_overlaps(time, removed, points);
  if constexpr (!is_periodic) note_passing(time, points);
}

// Pieces of overlaps begin after those of edges.
template <HasLinearMotion Traits>
void Approach_tracker<Traits>::change_overlaps(const Time& time, std::span<const Edge_name> removed,
                                               std::span<const Changed_point> points) {
  if constexpr (has_radii) {
    if (!points.empty()) enlarged_discs_->change(points, this->graph());
    for (const Edge_name& edge : removed) {
      const auto& [a, b] = ids_of(edge);
      if (!this->graph().contains(a) || !this->graph().contains(b)) continue;
      if (this->traits().do_touch(this->first_end(edge), this->second_end(edge), 0, time)) {
        begin_overlap(edge, time);
      }
    }
    for (const auto& point : points) {
      if (this->graph().contains(point.id)) begin_overlaps(point.id, time);
    }
  }
}

template <HasLinearMotion Traits>
auto Approach_tracker<Traits>::discs(const Edge_name& pair) const -> std::pair<Disc, Disc> {
  return {disc_about(this->first_end(pair).motion(), radius_),
          disc_about(this->second_end(pair).motion(), radius_)};
}

template <HasLinearMotion Traits>
void Approach_tracker<Traits>::begin(const Edge_name& pair, const Time& time) {
  const auto [p, q] = discs(pair);
  pieces_.insert_or_assign(pair, Piece{p, q, time});
}

// Begins a piece of a pair without an edge that overlaps or touches, unless it has one.
template <HasLinearMotion Traits>
void Approach_tracker<Traits>::begin_overlap(const Edge_name& pair, const Time& time) {
  const auto [p, q] = discs(pair);
  if (!pieces_.try_emplace(pair, Piece{p, q, time, true}).second) return;
  for (const auto& [id, other] : ends_of(pair)) overlaps_[id].push_back(other);
}

template <HasLinearMotion Traits>
void Approach_tracker<Traits>::begin_overlaps(Point_id id, const Time& time) {
  if constexpr (has_radii) {
    for (const Neighbor& other : enlarged_discs_->overlapping(id)) {
      begin_overlap(pair_of(id, other), time);
    }
  }
}

template <HasLinearMotion Traits>
void Approach_tracker<Traits>::end(const Edge_name& pair, const Time& time) {
  const auto piece = pieces_.find(pair);
  if (piece == pieces_.end()) return;
  examine(pair, piece->second, time);
  if (piece->second.has_touched) {
    for (const auto& [id, other] : ends_of(pair)) std::erase(overlaps_[id], other);
  }
  pieces_.erase(piece);
}

// The point has got another motion, or has been erased.
template <HasLinearMotion Traits>
void Approach_tracker<Traits>::end_overlaps(Point_id id, const Time& time) {
  const auto found = overlaps_.find(id);
  if (found == overlaps_.end()) return;
  const std::vector<Neighbor> others = found->second;
  for (const Neighbor& other : others) end(pair_of(id, other), time);
  overlaps_.erase(id);
}

// ---- points that are erased at the time at which others are inserted ----

// Stores the points that have been inserted or erased, and examines the pairs of one of these and
// one of those.
template <HasLinearMotion Traits>
void Approach_tracker<Traits>::note_passing(const Time& time,
                                            std::span<const Changed_point> points) {
  if (moment_ != time) {
    gone_.clear();
    come_.clear();
    moment_ = time;
  }
  for (const auto& [id, before] : points) {
    const bool is_there = this->graph().contains(id);
    if (before && !is_there) gone_.push_back({id, disc_about(before->motion(), radius_)});
    if (!before && is_there) {
      come_.push_back({id, disc_about(this->graph().point(id).motion(), radius_)});
    }
  }
  if (!points.empty()) examine_moment();
}

// Examines the nearest pairs of points that have been erased and inserted at one time.
template <HasLinearMotion Traits>
void Approach_tracker<Traits>::examine_moment() {
  if (gone_.empty() || come_.empty()) return;
  const auto discs_of = [](const std::vector<Passing>& points) {
    std::vector<Disc> result;
    for (const Passing& point : points) result.push_back(point.disc);
    return result;
  };
  const std::vector<Disc> gone = discs_of(gone_);
  const std::vector<Disc> come = discs_of(come_);
  // First some pairs that are probably near, at least `number_` if there are so many: pairs that
  // are farther apart need not be examined.
  examine_nearest_by_order(gone, come);
  drop_all_but_nearest();
  if (limit_ == std::numeric_limits<double>::infinity()) return;  // these were all pairs
  for_each_pair_in_range(gone, come, std::max(limit_, 0.0), moment_,
                         [this](std::size_t i, std::size_t k) { examine_at_moment(i, k); });
}

// Examines, for each erased point, some inserted ones next to it in the order of rounded positions.
template <HasLinearMotion Traits>
void Approach_tracker<Traits>::examine_nearest_by_order(const std::vector<Disc>& gone,
                                                        const std::vector<Disc>& come) {
  const double time = moment_.to_double();
  const auto place = [&](const Disc& disc) {
    const Vector_2 center = rounded_place(disc, time);
    return std::pair(center.x, center.y);
  };
  std::vector<std::pair<std::pair<double, double>, std::size_t>> order;
  for (std::size_t k = 0; k < come.size(); ++k) order.emplace_back(place(come[k]), k);
  std::ranges::sort(order);
  const std::size_t width = std::min(order.size(), number_ / gone.size() + 4);
  for (std::size_t i = 0; i < gone.size(); ++i) {
    const auto next = static_cast<std::size_t>(
        std::ranges::lower_bound(order, std::pair(place(gone[i]), std::size_t{0})) - order.begin());
    const std::size_t first = std::min(next - std::min(next, width / 2), order.size() - width);
    for (std::size_t k = first; k < first + width; ++k) examine_at_moment(i, order[k].second);
  }
}

template <HasLinearMotion Traits>
void Approach_tracker<Traits>::examine_at_moment(std::size_t gone, std::size_t come) {
  if constexpr (!is_periodic) {
    const bool is_first = gone_[gone].id < come_[come].id;
    const Passing& a = is_first ? gone_[gone] : come_[come];
    const Passing& b = is_first ? come_[come] : gone_[gone];
    examine({a.id, b.id}, {a.disc, b.disc, moment_}, moment_);
  }
}

// ---- the nearest of them ----

template <HasLinearMotion Traits>
void Approach_tracker<Traits>::examine(const Edge_name& pair, const Piece& piece,
                                       const Time& until) {
  const auto& [p, q, since, has_touched] = piece;
  if (least_gap_bounds(p, q, since, until).lower > limit_) return;
  Gap_of_pair<Disc> least = least_gap(p, q, since, until);
  if constexpr (has_radii) {
    // Enlarged discs overlap somewhat earlier than the discs touch, if these do.
    const auto& [a, b] = ids_of(pair);
    if (has_touched && !this->traits().do_touch(Image_2(p, a), Image_2(q, b), 0, least.time())) {
      return;
    }
  }
  keep({pair, std::move(least)});
}

template <HasLinearMotion Traits>
bool Approach_tracker<Traits>::is_nearer(const Candidate& a, const Candidate& b) {
  const auto order = a.least.compare(b.least);
  if (order != CGAL::EQUAL) return order == CGAL::SMALLER;
  if (a.least.time() != b.least.time()) return a.least.time() < b.least.time();
  return a.points < b.points;
}

template <HasLinearMotion Traits>
void Approach_tracker<Traits>::keep(Candidate candidate) {
  const auto known = nearest_.find(candidate.points);
  if (known == nearest_.end()) {
    nearest_.emplace(candidate.points, std::move(candidate));
    if (nearest_.size() > 4 * number_ + 1000) drop_all_but_nearest();
  } else if (is_nearer(candidate, known->second)) {
    known->second = std::move(candidate);
  }
}

template <HasLinearMotion Traits>
void Approach_tracker<Traits>::drop_all_but_nearest() {
  if (nearest_.size() < number_) return;
  std::vector<const Candidate*> candidates;
  for (const auto& [pair, candidate] : nearest_) candidates.push_back(&candidate);
  const auto last = candidates.begin() + static_cast<std::ptrdiff_t>(number_ - 1);
  std::ranges::nth_element(candidates, last,
                           [](const auto* a, const auto* b) { return is_nearer(*a, *b); });
  limit_ = (*last)->least.bounds().upper;
  std::vector<Edge_name> dropped;
  for (auto other = last + 1; other != candidates.end(); ++other) {
    dropped.push_back((*other)->points);
  }
  for (const Edge_name& pair : dropped) nearest_.erase(pair);
}

}  // namespace detail

template <HasLinearMotion Traits>
Closest_approaches<Traits>::Closest_approaches(Simulation_2<Traits>& simulation, std::size_t number)
    : tracker_(std::make_unique<detail::Approach_tracker<Traits>>(simulation, number)) {}

template <HasLinearMotion Traits>
Closest_approaches<Traits>::~Closest_approaches() = default;

template <HasLinearMotion Traits>
std::vector<Approach> Closest_approaches<Traits>::approaches() {
  return tracker_->approaches();
}

template class Closest_approaches<Linear_kinetic_traits_2>;
template class Closest_approaches<Disc_kinetic_traits_2>;
template class Closest_approaches<Periodic_kinetic_traits_2>;
template class Closest_approaches<Periodic_disc_kinetic_traits_2>;

}  // namespace kinetri
