// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/observers/closest_approaches.h"

#include <algorithm>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "kinetri/impl/base/check.h"
#include "kinetri/impl/triangulation/incident.h"
#include "observers/departures.h"

namespace kinetri {
namespace detail {

// Follows the pairs of discs that have an edge or overlap, and keeps the nearest ones.
template <HasLinearMotion Traits>
class Approach_tracker final : public Event_observer, private Overlap_observer {
  static constexpr bool has_radii = HasWeight<typename Traits::Motion>;

 public:
  Approach_tracker(Simulation_2<Traits>& simulation, std::size_t number);
  ~Approach_tracker() override;

  Approach_tracker(const Approach_tracker&) = delete;
  Approach_tracker& operator=(const Approach_tracker&) = delete;

  std::vector<Approach> approaches();

  // If events may name points, as contacts do, their edges are read.
  bool looks_at_triangulation() const override {
    return has_radii || simulation_.options().box || simulation_.options().response;
  }
  void before_event(const Event& event) override;
  void after_event(const Event& event) override;
  void after_hiding(const Algebraic_number& time, std::span<const Point_id> points) override;

 private:
  // A pair that has an edge or overlaps, since that began or the last change of a motion.
  struct Piece {
    Disc_motion_2 p;
    Disc_motion_2 q;
    Algebraic_number since;
    bool is_edge = false;  // if not, the discs overlapped just after `since`
  };

  // The least gap of a piece.
  struct Candidate {
    Edge_ids points = {no_point, no_point};
    Gap_of_pair<Disc_motion_2> least;
  };

  // A point that is inserted or erased, with its motion at that time.
  struct Passing {
    Point_id id;
    Disc_motion_2 disc;
  };

  static bool is_nearer(const Candidate& a, const Candidate& b);

  void after_change(std::span<const Point_id> points) override;
  void follow_link(Point_id id);
  Disc_motion_2 disc(Point_id id) const;
  bool has_changed(const Edge_ids& pair, const Piece& piece) const;
  void begin(const Edge_ids& pair, const Algebraic_number& time, bool is_edge);
  void begin_overlap(const Edge_ids& pair, const Algebraic_number& time);
  void end(const Edge_ids& pair, const Algebraic_number& time);
  void change_motion(Point_id id, const Algebraic_number& time);
  void examine(const Edge_ids& pair, const Piece& piece, const Algebraic_number& until);
  void note_passing(const Event& event);
  void examine_moment();
  void examine_nearest_by_order(const std::vector<Disc_motion_2>& gone,
                                const std::vector<Disc_motion_2>& come);
  void examine_at_moment(std::size_t gone, std::size_t come);
  void keep(Candidate candidate);
  void drop_all_but_nearest();

  Simulation_2<Traits>& simulation_;
  std::size_t number_;
  std::map<Edge_ids, Piece> pieces_;
  std::map<Point_id, Point_id> links_;  // points, and those that hide them
  // Of each piece without an edge both points, each with the other one.
  std::set<std::pair<Point_id, Point_id>> overlaps_;
  // The points of the present event that existed before it; and the points that have been erased
  // and inserted at one time.
  std::vector<Passing> named_;
  Algebraic_number moment_;
  std::vector<Passing> gone_;
  std::vector<Passing> come_;
  std::map<Edge_ids, Candidate> nearest_;
  // `number_` pairs have had this gap or a smaller one: pairs with greater gaps are not kept.
  double limit_;
};

template <HasLinearMotion Traits>
Approach_tracker<Traits>::Approach_tracker(Simulation_2<Traits>& simulation, std::size_t number)
    : simulation_(simulation), number_(number), limit_(std::numeric_limits<double>::infinity()) {
  KINETRI_PRECONDITION(number > 0, "no approach is asked for");
  KINETRI_PRECONDITION(!has_radii || simulation.options().response,
                       "overlaps are not followed without a response; log_contact changes nothing");
  for (const Edge_ids& edge : simulation_.triangulation().finite_edge_ids()) {
    begin(edge, simulation_.current_time(), true);
  }
  if (simulation_.triangulation().number_of_hidden_points() > 0) {
    for (Point_id id = 0; id < simulation_.triangulation().next_id(); ++id) follow_link(id);
  }
  if constexpr (has_radii) {
    for (Point_id id = 0; id < simulation_.triangulation().next_id(); ++id) {
      after_change({&id, 1});
    }
    simulation_.add_overlap_observer(*this);
  }
  simulation_.add_observer(*this);
}

template <HasLinearMotion Traits>
Approach_tracker<Traits>::~Approach_tracker() {
  simulation_.remove_observer(*this);
  simulation_.remove_overlap_observer(*this);
}

template <HasLinearMotion Traits>
std::vector<Approach> Approach_tracker<Traits>::approaches() {
  for (auto& [pair, piece] : pieces_) {
    examine(pair, piece, simulation_.current_time());
    piece.since = simulation_.current_time();
  }
  examine_moment();
  drop_all_but_nearest();
  std::vector<const Candidate*> sorted;
  for (const auto& [pair, candidate] : nearest_) sorted.push_back(&candidate);
  std::ranges::sort(sorted, [](const auto* a, const auto* b) { return is_nearer(*a, *b); });
  std::vector<Approach> result;
  for (const Candidate* candidate : sorted) {
    const Gap_of_pair<Disc_motion_2>& least = candidate->least;
    result.push_back({candidate->points, least.time(), least.rounded_distance(), least.rounded()});
  }
  return result;
}

// ---- which pairs ----

template <HasLinearMotion Traits>
void Approach_tracker<Traits>::before_event(const Event& event) {
  if (!(gone_.empty() && come_.empty()) && moment_ != event.time) {
    examine_moment();
    gone_.clear();
    come_.clear();
  }
  named_.clear();
  for (const std::optional<Point_id>& id : {event.point_a, event.point_b}) {
    if (id && simulation_.triangulation().contains(*id)) named_.push_back({*id, disc(*id)});
  }
}

template <HasLinearMotion Traits>
void Approach_tracker<Traits>::after_event(const Event& event) {
  note_passing(event);
  if (event.removed) {
    end(*event.removed, event.time);
    begin_overlap(*event.removed, event.time);
  }
  if (event.added) {
    end(*event.added, event.time);
    begin(*event.added, event.time, true);
  }
  for (const std::optional<Point_id>& id : {event.point_a, event.point_b}) {
    if (id) change_motion(*id, event.time);
  }
  if (event.kind == Event_kind::collision) {
    begin_overlap(edge_ids(*event.point_a, *event.point_b), event.time);
  }
}

template <HasLinearMotion Traits>
void Approach_tracker<Traits>::after_hiding(const Algebraic_number& /*time*/,
                                            std::span<const Point_id> points) {
  for (const Point_id id : points) follow_link(id);
}

// Ends the piece of a point with the point that hid it, and begins one with the point that hides
// it, because their motions are the same.
template <HasLinearMotion Traits>
void Approach_tracker<Traits>::follow_link(Point_id id) {
  const auto& triangulation = simulation_.triangulation();
  const bool is_there = triangulation.contains(id);
  const Point_id shown = is_there ? triangulation.vertex(id)->point().id() : id;
  if (const auto link = links_.find(id); link != links_.end()) {
    const Point_id before = link->second;
    if (before == shown) return;
    // They may have got an edge, whose piece has begun.
    const bool is_edge = is_there && triangulation.contains(before) &&
                         triangulation.triangulation().is_edge(triangulation.vertex(before),
                                                               triangulation.vertex(id));
    if (!is_edge) end(edge_ids(before, id), simulation_.current_time());
    links_.erase(link);
  }
  if (shown == id) return;
  links_.emplace(id, shown);
  begin({shown, id}, simulation_.current_time(), true);
}

template <HasLinearMotion Traits>
void Approach_tracker<Traits>::after_change(std::span<const Point_id> points) {
  if constexpr (has_radii) {
    for (const Point_id id : points) {
      if (!simulation_.triangulation().contains(id)) continue;
      for (const Point_id other : simulation_.overlapping_discs(id)) {
        const Edge_ids pair = edge_ids(id, other);
        if (!pieces_.contains(pair)) begin(pair, simulation_.current_time(), false);
      }
    }
  }
}

template <HasLinearMotion Traits>
Disc_motion_2 Approach_tracker<Traits>::disc(Point_id id) const {
  return disc_about(simulation_.triangulation().motion(id), simulation_.options().radius);
}

// Whether the motions of a piece have ended: a point has got another motion or has been erased.
template <HasLinearMotion Traits>
bool Approach_tracker<Traits>::has_changed(const Edge_ids& pair, const Piece& piece) const {
  const auto& triangulation = simulation_.triangulation();
  return !triangulation.contains(pair[0]) || !triangulation.contains(pair[1]) ||
         disc(pair[0]) != piece.p || disc(pair[1]) != piece.q;
}

template <HasLinearMotion Traits>
void Approach_tracker<Traits>::begin(const Edge_ids& pair, const Algebraic_number& time,
                                     bool is_edge) {
  pieces_.insert_or_assign(pair, Piece{disc(pair[0]), disc(pair[1]), time, is_edge});
  if (is_edge) return;
  overlaps_.emplace(pair[0], pair[1]);
  overlaps_.emplace(pair[1], pair[0]);
}

// Begins a piece of a pair without an edge, if it overlaps just after `time`, the current one.
template <HasLinearMotion Traits>
void Approach_tracker<Traits>::begin_overlap(const Edge_ids& pair, const Algebraic_number& time) {
  if constexpr (has_radii) {
    const auto& triangulation = simulation_.triangulation();
    if (pieces_.contains(pair) || !triangulation.contains(pair[0]) ||
        !triangulation.contains(pair[1])) {
      return;
    }
    const auto& p = triangulation.point(pair[0]);
    const auto& q = triangulation.point(pair[1]);
    if (triangulation.traits().may_overlap(p, q, 0, time) &&
        triangulation.traits().exact().may_overlap(p, q, 0, time)) {
      begin(pair, time, false);
    }
  }
}

template <HasLinearMotion Traits>
void Approach_tracker<Traits>::end(const Edge_ids& pair, const Algebraic_number& time) {
  const auto piece = pieces_.find(pair);
  if (piece == pieces_.end()) return;
  examine(pair, piece->second, time);
  if (!piece->second.is_edge) {
    overlaps_.erase({pair[0], pair[1]});
    overlaps_.erase({pair[1], pair[0]});
  }
  pieces_.erase(piece);
}

// The motion may have changed: ends the pieces with their motions. Pieces of edges begin here,
// those of overlaps after these have been updated.
template <HasLinearMotion Traits>
void Approach_tracker<Traits>::change_motion(Point_id id, const Algebraic_number& time) {
  std::vector<Edge_ids> ended;
  const auto add_if_turned = [&](Point_id other, bool is_edge) {
    const Edge_ids pair = edge_ids(id, other);
    const auto piece = pieces_.find(pair);
    // An edge without a piece has not been reported yet.
    if (piece != pieces_.end() && piece->second.is_edge == is_edge &&
        has_changed(pair, piece->second)) {
      ended.push_back(pair);
    }
  };
  const auto& triangulation = simulation_.triangulation();
  if (triangulation.contains(id) && triangulation.number_of_hidden_points() > 0) {
    for (const Point_id other : triangulation.coincident_points(id)) add_if_turned(other, true);
  }
  if (triangulation.contains(id) && !triangulation.is_hidden(id)) {
    for_each_neighbor(triangulation.triangulation(), triangulation.vertex(id),
                      [&](auto neighbor) { add_if_turned(neighbor->point().id(), true); });
  }
  const std::size_t edges = ended.size();
  for (auto other = overlaps_.lower_bound({id, 0}); other != overlaps_.end() && other->first == id;
       ++other) {
    add_if_turned(other->second, false);
  }
  for (const Edge_ids& pair : ended) end(pair, time);
  for (std::size_t i = 0; i < edges; ++i) begin(ended[i], time, true);
}

// ---- points that are erased at the time at which others are inserted ----

// Stores the points that the event has inserted or erased.
template <HasLinearMotion Traits>
void Approach_tracker<Traits>::note_passing(const Event& event) {
  const auto& triangulation = simulation_.triangulation();
  for (const std::optional<Point_id>& id : {event.point_a, event.point_b}) {
    if (!id) continue;
    const auto before = std::ranges::find(named_, *id, &Passing::id);
    if ((before != named_.end()) == triangulation.contains(*id)) continue;
    moment_ = event.time;
    if (before != named_.end()) {
      gone_.push_back(*before);
    } else {
      come_.push_back({*id, disc(*id)});
    }
  }
}

// Examines the nearest pairs of points that have been erased and inserted at one time.
template <HasLinearMotion Traits>
void Approach_tracker<Traits>::examine_moment() {
  if (gone_.empty() || come_.empty()) return;
  const auto discs = [](const std::vector<Passing>& points) {
    std::vector<Disc_motion_2> result;
    for (const Passing& point : points) result.push_back(point.disc);
    return result;
  };
  const std::vector<Disc_motion_2> gone = discs(gone_);
  const std::vector<Disc_motion_2> come = discs(come_);
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
void Approach_tracker<Traits>::examine_nearest_by_order(const std::vector<Disc_motion_2>& gone,
                                                        const std::vector<Disc_motion_2>& come) {
  const double time = moment_.to_double();
  const auto place = [&](const Disc_motion_2& disc) {
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
  const auto& [p, p_disc] = gone_[gone];
  const auto& [q, q_disc] = come_[come];
  if (p == q) return;  // it has been inserted and erased at this time
  examine(edge_ids(p, q), {p_disc, q_disc, moment_}, moment_);
}

// ---- the nearest of them ----

template <HasLinearMotion Traits>
void Approach_tracker<Traits>::examine(const Edge_ids& pair, const Piece& piece,
                                       const Algebraic_number& until) {
  const auto& [p, q, since, is_edge] = piece;
  if (least_gap_bounds(p, q, since, until).lower > limit_) return;
  keep({pair, least_gap(p, q, since, until)});
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
  std::vector<Edge_ids> dropped;
  for (auto other = last + 1; other != candidates.end(); ++other) {
    dropped.push_back((*other)->points);
  }
  for (const Edge_ids& pair : dropped) nearest_.erase(pair);
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

}  // namespace kinetri
