// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/observers/encounters.h"

#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <tuple>
#include <utility>

#include "kinetri/algebra/real_roots.h"
#include "kinetri/base/check.h"
#include "kinetri/kinetic/certificate_polynomials.h"
#include "kinetri/simulation/detail/disc_boxes.h"
#include "observers/enlarged_discs.h"

namespace kinetri {
namespace {

// More pieces than this are compared exactly, of which one remains.
constexpr std::size_t most_pieces = 32;

// The place of `id` in a sequence that is sorted by id.
template <class Partners>
auto place(Partners& partners, Point_id id) {
  return std::lower_bound(partners.begin(), partners.end(), id,
                          [](const auto& partner, Point_id other) { return partner.id < other; });
}

template <class Partners>
bool is_among(const Partners& partners, Point_id id) {
  const auto partner = place(partners, id);
  return partner != partners.end() && partner->id == id;
}

template <class Partners>
void remove_from(Partners& partners, Point_id id) {
  partners.erase(place(partners, id));
}

// On straight lines two that part never come in range again: their gap is convex.
template <class Motion>
constexpr bool part_once = std::same_as<Centre_motion_of<Motion>, Linear_motion_2>;

}  // namespace

template <ContactKineticTraits_2 Traits>
Encounters<Traits>::Encounters(Simulation_2<Traits>& simulation, double range)
    : Edge_follower<Traits>(simulation), range_(range) {
  start(simulation.options().radius);
}

template <ContactKineticTraits_2 Traits>
Encounters<Traits>::~Encounters() = default;

template <ContactKineticTraits_2 Traits>
void Encounters<Traits>::start(double radius) {
  KINETRI_PRECONDITION(range_ >= 0 && std::isfinite(range_),
                       "the range must be a number of at least 0");
  radius_ = radius;
  const Time& now = this->triangulation().current_time();
  partners_.resize(this->graph().next_id());
  if constexpr (has_radii) {
    enlarged_discs_ = std::make_shared<detail::Enlarged_discs<Traits>>(this->graph(), range_, now);
    for (Point_id id = 0; id < partners_.size(); ++id) {
      if (this->graph().contains(id)) examine_new_motion(id, now);
    }
  } else {
    for (Point_id id = 0; id < partners_.size(); ++id) {
      if (!this->graph().contains(id)) continue;
      for (const Point_id other : this->graph().neighbors(id)) {
        if (id < other) examine(id, other, now);
      }
    }
  }
  execute(now);
}

// ---- what the base tells ----

template <ContactKineticTraits_2 Traits>
void Encounters<Traits>::advance(const Time& time) {
  if constexpr (has_radii) {
    // Those that come in range by `time` have overlapped here before.
    for (const auto& [points, since] : enlarged_discs_->advance_to(time)) {
      examine(points[0], points[1], since);
    }
  }
  execute(time);
}

template <ContactKineticTraits_2 Traits>
void Encounters<Traits>::before_change(
    std::span<const Edge_ids> /*removed*/,
    std::span<const typename Edge_follower<Traits>::Changed_point> points) {
  for (const auto& point : points) {
    if (point.before) discard_entries(point.id);
  }
}

template <ContactKineticTraits_2 Traits>
void Encounters<Traits>::change(
    const Time& time, std::span<const Edge_ids> /*removed*/, std::span<const Edge_ids> added,
    std::span<const typename Edge_follower<Traits>::Changed_point> points) {
  if (partners_.size() < this->graph().next_id()) partners_.resize(this->graph().next_id());
  for (const auto& point : points) turn(point.id, time, points);
  meet_those_gone(time, points);
  if constexpr (has_radii) {
    if (!points.empty()) enlarged_discs_->change(points, this->graph());
  } else {
    for (const Edge_ids& edge : added) examine_new_edge(edge, time);
  }
  for (const auto& point : points) {
    if (this->graph().contains(point.id)) examine_new_motion(point.id, time);
  }
  execute(time);
}

// ---- certificates ----

// Calls `function` with traits and the two points; with discs if the points have a common radius,
// since the sum of that and the range may be no binary64 number.
template <ContactKineticTraits_2 Traits>
template <class Function>
auto Encounters<Traits>::with_discs(const Point_2& p, const Point_2& q, Function function) const {
  if constexpr (!has_radii) {
    if (radius_ != 0) {
      using Moving_disc = typename Disc_traits::Point_2;
      return function(disc_traits_, Moving_disc(disc(p.motion()), p.id()),
                      Moving_disc(disc(q.motion()), q.id()));
    }
  }
  return function(this->traits(), p, q);
}

template <ContactKineticTraits_2 Traits>
auto Encounters<Traits>::Queue_policy::entry_time(const Entry& entry) const -> Time {
  if (!entry.is_event) return Time(entry.bounds.lower);
  return encounters.with_discs(entry.points, [&](const auto& traits, const auto& p, const auto& q) {
    return traits.contact_failure(p, q, encounters.range_, entry.bounds);
  });
}

// What begins is before what ends: both are in range at that time.
template <ContactKineticTraits_2 Traits>
bool Encounters<Traits>::Queue_policy::precedes(const Entry& a, const Entry& b) const {
  return std::tie(a.is_end, a.is_event, a.points) < std::tie(b.is_end, b.is_event, b.points);
}

// ---- candidates ----

template <ContactKineticTraits_2 Traits>
bool Encounters<Traits>::is_near(Point_id a, Point_id b) const {
  return is_among(partners_[a].near, b);
}

// Lets a pair wait that is a candidate, if it is not known that it is or will be in range and if it
// will be. Precondition: `after` is not before the last change of a motion of the two.
template <ContactKineticTraits_2 Traits>
void Encounters<Traits>::examine(Point_id a, Point_id b, const Time& after) {
  if (is_near(a, b) || is_among(partners_[a].waiting, b)) return;
  const Edge_ids pair = edge_ids(a, b);
  Certificate certificate = with_discs(pair, [&](const auto& traits, const auto& p, const auto& q) {
    return traits.apart_certificate(p, q, range_, after);
  });
  certificate_counters_.count(certificate);
  if (certificate.kind != Certificate::Kind::never_fails) wait(pair, std::move(certificate));
}

// Of paths p w q, in which w is in range of both ends and wq is an edge: a pair has such a path
// from either end, and that from the smaller id is enough. Here w is in range of p, and q any
// neighbor of w.
template <ContactKineticTraits_2 Traits>
void Encounters<Traits>::examine_from(Point_id p, Point_id w, const Time& after) {
  for (const Point_id q : this->graph().neighbors(w)) {
    if (p < q && is_near(w, q)) examine(p, q, after);
  }
}

// The same, where w is in range of q, its neighbor, and p any point in range of w.
template <ContactKineticTraits_2 Traits>
void Encounters<Traits>::examine_to(Point_id w, Point_id q, const Time& after) {
  for (const Near& near : partners_[w].near) {
    if (near.id < q) examine(near.id, q, after);
  }
}

template <ContactKineticTraits_2 Traits>
void Encounters<Traits>::examine_new_edge(const Edge_ids& edge, const Time& after) {
  const auto [a, b] = edge;
  examine(a, b, after);
  if (!is_near(a, b)) return;
  examine_to(a, b, after);
  examine_to(b, a, after);
}

template <ContactKineticTraits_2 Traits>
void Encounters<Traits>::examine_new_near(const Edge_ids& pair, const Time& after) {
  const auto [a, b] = pair;
  examine_from(a, b, after);
  examine_from(b, a, after);
  if (!this->graph().is_edge(pair)) return;
  examine_to(a, b, after);
  examine_to(b, a, after);
}

template <ContactKineticTraits_2 Traits>
void Encounters<Traits>::examine_new_motion(Point_id id, const Time& after) {
  if constexpr (has_radii) {
    for (const Point_id other : enlarged_discs_->overlapping(id)) examine(id, other, after);
  } else {
    for (const Point_id other : this->graph().neighbors(id)) {
      examine(id, other, after);
      if (is_near(id, other)) examine_to(other, id, after);
    }
    for (const Near& near : partners_[id].near) examine_from(id, near.id, after);
  }
}

// ---- the queue ----

template <ContactKineticTraits_2 Traits>
void Encounters<Traits>::wait(const Edge_ids& pair, Certificate certificate) {
  Entry entry;
  entry.bounds = certificate.bounds;
  entry.is_event = certificate.kind == Certificate::Kind::fails;
  entry.is_crossing = entry.is_event && !certificate.failure;
  entry.points = pair;
  const Queue_handle event = certificate.failure
                                 ? queue_.push(entry, std::move(*certificate.failure))
                                 : queue_.emplace(entry);
  for (const auto& [id, other] : {std::pair(pair[0], pair[1]), std::pair(pair[1], pair[0])}) {
    auto& waiting = partners_[id].waiting;
    waiting.insert(place(waiting, other), {other, event});
  }
}

// The pair has been in range up to `after`, and is not just after that.
template <ContactKineticTraits_2 Traits>
void Encounters<Traits>::wait_again(const Edge_ids& pair, const Time& after) {
  if constexpr (!part_once<Motion>) {
    std::optional<Real_root> touch =
        with_discs(pair, [&](const auto& /*traits*/, const auto& p, const auto& q) {
          return first_root_after(contact_polynomial(p, q, range_), after);
        });
    if (!touch) return;
    Certificate certificate;
    certificate.kind = Certificate::Kind::fails;
    certificate.bounds = touch->value.interval();
    certificate.failure = std::make_unique<Time>(std::move(touch->value));
    wait(pair, std::move(certificate));
  }
}

template <ContactKineticTraits_2 Traits>
void Encounters<Traits>::stop_waiting(const Edge_ids& pair) {
  remove_from(partners_[pair[0]].waiting, pair[1]);
  remove_from(partners_[pair[1]].waiting, pair[0]);
}

// The point will have another motion, or will have gone.
template <ContactKineticTraits_2 Traits>
void Encounters<Traits>::discard_entries(Point_id id) {
  for (const auto& [other, event] : std::exchange(partners_[id].waiting, {})) {
    remove_from(partners_[other].waiting, id);
    queue_.erase(event);
  }
  for (const Near& near : partners_[id].near) {
    const Queue_handle event = std::exchange(records_[near.record].end_event, no_event);
    if (event != no_event) queue_.erase(event);
  }
}

template <ContactKineticTraits_2 Traits>
void Encounters<Traits>::schedule_end(Record& record, const Time& after) {
  Certificate certificate =
      with_discs(record.points, [&](const auto& traits, const auto& p, const auto& q) {
        return traits.near_certificate(p, q, range_, after);
      });
  certificate_counters_.count(certificate);
  record.end_event = no_event;
  if (certificate.kind == Certificate::Kind::never_fails) return;
  Entry entry;
  entry.bounds = certificate.bounds;
  entry.is_end = true;
  entry.is_event = certificate.kind == Certificate::Kind::fails;
  entry.points = record.points;
  record.end_event = certificate.failure ? queue_.push(entry, std::move(*certificate.failure))
                                         : queue_.emplace(entry);
}

// What ends at `time` itself is not due: the two are in range still, and may get motions at that
// time with which they remain so.
template <ContactKineticTraits_2 Traits>
bool Encounters<Traits>::is_due(const Entry& entry, const Time& time) {
  const Double_interval bounds = time.interval();
  if (entry.bounds.upper < bounds.lower) return true;
  if (entry.bounds.lower > bounds.upper) return false;
  const auto order = queue_.time(entry) <=> time;
  return entry.is_end ? order < 0 : order <= 0;
}

// Executes what is due. Where several pairs come in range at one time, one makes another one a
// candidate, which then waits up to the same time.
template <ContactKineticTraits_2 Traits>
void Encounters<Traits>::execute(const Time& time) {
  while (!queue_.empty() && is_due(queue_.top(), time)) {
    const Time entry_time = queue_.time(queue_.top());
    const Entry entry = queue_.pop();
    const auto [a, b] = entry.points;
    if (entry.is_end) {
      const std::size_t record = place(partners_[a].near, b)->record;
      if (entry.is_event) {
        records_[record].end_event = no_event;
        end(record, entry_time);
        wait_again(entry.points, entry_time);
      } else {
        schedule_end(records_[record], entry_time);
      }
    } else {
      stop_waiting(entry.points);
      if (entry.is_event) {
        begin(entry, entry_time);
      } else {
        examine(a, b, entry_time);
      }
    }
  }
}

// ---- encounters ----

template <ContactKineticTraits_2 Traits>
void Encounters<Traits>::begin(const Entry& entry, const Time& time) {
  const Edge_ids& pair = entry.points;
  const auto [a, b] = pair;
  const std::size_t index = records_.size();
  Record& record = records_.emplace_back(Record{pair, time});
  record.pieces.push_back({this->graph().point(a).motion(), this->graph().point(b).motion(), time});
  auto& near_a = partners_[a].near;
  auto& near_b = partners_[b].near;
  near_a.insert(place(near_a, b), {b, index});
  near_b.insert(place(near_b, a), {a, index});
  schedule_end(record, entry.is_crossing ? Time(inside(entry)) : time);
  for (Encounter_observer* const observer : observers_) observer->begins(pair, time);
  if constexpr (!has_radii) examine_new_near(pair, time);
}

// A time at which a pair that has just come in range is still in range, without having parted: near
// the beginning no filter could decide when it ends. On straight lines the gap is convex, so that
// any later time at which the pair is in range will do, such as that of the least distance.
template <ContactKineticTraits_2 Traits>
double Encounters<Traits>::inside(const Entry& entry) const {
  const double begin = entry.bounds.upper;
  if constexpr (part_once<Motion>) {
    const Motion& p = this->graph().point(entry.points[0]).motion();
    const Motion& q = this->graph().point(entry.points[1]).motion();
    const Vector_2 place_p = rounded_place(p, begin);
    const Vector_2 place_q = rounded_place(q, begin);
    const Vector_2 velocity_p = rounded_velocity(p, begin);
    const Vector_2 velocity_q = rounded_velocity(q, begin);
    const Vector_2 d = {place_q.x - place_p.x, place_q.y - place_p.y};
    const Vector_2 v = {velocity_q.x - velocity_p.x, velocity_q.y - velocity_p.y};
    const double least = begin - (d.x * v.x + d.y * v.y) / (v.x * v.x + v.y * v.y);
    if (std::isfinite(least) && least > begin &&
        with_discs(entry.points, [&](const auto& traits, const auto& a, const auto& b) {
          return traits.do_touch(a, b, range_, Time(least));
        })) {
      return least;
    }
  }
  return begin;
}

// Precondition: the record has no entry in the queue.
template <ContactKineticTraits_2 Traits>
void Encounters<Traits>::end(std::size_t index, const Time& time) {
  Record& record = records_[index];
  const auto [a, b] = record.points;
  remove_from(partners_[a].near, b);
  remove_from(partners_[b].near, a);
  record.end = time;
  record.pieces.back().until = time;
  for (Encounter_observer* const observer : observers_) observer->ends(record.points, time);
}

// The point has got another motion, or has gone, as have the other ones that have changed.
template <ContactKineticTraits_2 Traits>
void Encounters<Traits>::turn(
    Point_id id, const Time& time,
    std::span<const typename Edge_follower<Traits>::Changed_point> changed) {
  const auto has_changed = [&](Point_id other) {
    const auto point = place(changed, other);
    return point != changed.end() && point->id == other;
  };
  const std::vector<Near> partners = partners_[id].near;
  for (const auto& [other, index] : partners) {
    if (other < id && has_changed(other)) continue;  // done before
    Record& record = records_[index];
    const bool goes_on =
        this->graph().contains(id) && this->graph().contains(other) &&
        with_discs(record.points, [&](const auto& traits, const auto& p, const auto& q) {
          return traits.do_touch(p, q, range_, time);
        });
    if (!goes_on) {
      end(index, time);
      continue;
    }
    finish_piece(record, time);
    record.pieces.push_back({this->graph().point(record.points[0]).motion(),
                             this->graph().point(record.points[1]).motion(), time});
    schedule_end(record, time);
  }
}

// Points that come meet those that have gone at the same time.
template <ContactKineticTraits_2 Traits>
void Encounters<Traits>::meet_those_gone(
    const Time& time, std::span<const typename Edge_follower<Traits>::Changed_point> changed) {
  if (changed.empty()) return;
  if (gone_at_ != time) gone_.clear();
  gone_at_ = time;
  std::vector<Point_id> come;
  for (const auto& [id, before] : changed) {
    const bool is_there = this->graph().contains(id);
    if (before && !is_there) gone_.push_back(*before);
    if (!before && is_there) come.push_back(id);
  }
  if (gone_.empty() || come.empty()) return;
  const Double_interval times = time.tight_interval();
  const auto box = [&](const Point_2& point, double range, std::size_t index) {
    Disc large = disc(point.motion());
    large.radius = std::nextafter(large.radius + range, std::numeric_limits<double>::infinity());
    return detail::box_around(large, static_cast<Point_id>(index), times.lower, times);
  };
  std::vector<detail::Disc_box> boxes_gone;
  for (std::size_t i = 0; i < gone_.size(); ++i) boxes_gone.push_back(box(gone_[i], range_, i));
  std::vector<detail::Disc_box> boxes_come;
  for (const Point_id id : come) boxes_come.push_back(box(this->graph().point(id), 0, id));
  std::vector<std::pair<Point_id, Point_id>> close;
  CGAL::box_intersection_d(
      boxes_gone.begin(), boxes_gone.end(), boxes_come.begin(), boxes_come.end(),
      [&](const auto& p, const auto& q) { close.emplace_back(p.info(), q.info()); });
  for (const auto& [index, id] : close) {
    meet_for_a_moment(gone_[index], this->graph().point(id), time);
  }
}

template <ContactKineticTraits_2 Traits>
void Encounters<Traits>::meet_for_a_moment(const Point_2& p, const Point_2& q, const Time& time) {
  if (p.id() > q.id()) return meet_for_a_moment(q, p, time);
  const bool is_in_range = with_discs(p, q, [&](const auto& traits, const auto& a, const auto& b) {
    return traits.do_touch(a, b, range_, time);
  });
  if (!is_in_range) return;
  Record& record = records_.emplace_back(Record{{p.id(), q.id()}, time, time});
  record.pieces.push_back({p.motion(), q.motion(), time, time});
  for (Encounter_observer* const observer : observers_) observer->begins(record.points, time);
  for (Encounter_observer* const observer : observers_) observer->ends(record.points, time);
}

// Ends the last piece, and drops those that certainly have not the least gap.
template <ContactKineticTraits_2 Traits>
void Encounters<Traits>::finish_piece(Record& record, const Time& time) const {
  std::vector<Piece>& pieces = record.pieces;
  Piece& last = pieces.back();
  last.until = time;
  last.least_gap = detail::least_gap_bounds(disc(last.p), disc(last.q), last.since, last.until);
  if (pieces.size() == 1) return;
  double least = last.least_gap.upper;
  for (const Piece& piece : pieces) least = std::min(least, piece.least_gap.upper);
  std::erase_if(pieces, [&](const Piece& piece) { return piece.least_gap.lower > least; });
  if (pieces.size() < most_pieces) return;
  pieces.assign(1, least_gap(pieces).piece);
}

// Precondition: the pieces have ended.
template <ContactKineticTraits_2 Traits>
auto Encounters<Traits>::least_gap(const std::vector<Piece>& pieces) const -> Least_gap {
  std::optional<Least_gap> result;
  for (const Piece& piece : pieces) {
    auto gap = detail::least_gap(disc(piece.p), disc(piece.q), piece.since, piece.until);
    if (!result || gap.compare(result->gap) == CGAL::SMALLER) {
      result = Least_gap{piece, std::move(gap)};
    }
  }
  return std::move(*result);
}

template <ContactKineticTraits_2 Traits>
void Encounters<Traits>::keep_least_gap(Record& record, const std::vector<Piece>& pieces) const {
  const detail::Gap_of_pair<Disc> gap = least_gap(pieces).gap;
  record.closest = gap.time();
  record.distance = gap.rounded_distance();
  record.gap = gap.rounded();
}

// ---- answers ----

template <ContactKineticTraits_2 Traits>
std::vector<Encounter> Encounters<Traits>::encounters() {
  this->update();
  const Time& now = this->triangulation().current_time();
  std::vector<Encounter> result;
  result.reserve(records_.size());
  for (Record& record : records_) {
    if (!record.end) {
      std::vector<Piece> pieces = record.pieces;
      pieces.back().until = now;
      keep_least_gap(record, pieces);
    } else if (!record.pieces.empty()) {
      keep_least_gap(record, std::exchange(record.pieces, {}));
    }
    result.push_back({record.points, record.begin, record.end.value_or(now), record.closest,
                      record.distance, record.gap});
  }
  std::ranges::sort(result, [](const Encounter& a, const Encounter& b) {
    const auto order = a.begin <=> b.begin;
    return order != 0 ? order < 0 : a.points < b.points;
  });
  return result;
}

template <ContactKineticTraits_2 Traits>
std::vector<Point_id> Encounters<Traits>::in_range(Point_id id) {
  this->update();
  KINETRI_PRECONDITION(this->graph().contains(id), "there is no point with this id");
  std::vector<Point_id> result;
  for (const Near& near : partners_[id].near) result.push_back(near.id);
  return result;
}

template class Encounters<Linear_kinetic_traits_2>;
template class Encounters<Polynomial_kinetic_traits_2>;
template class Encounters<Disc_kinetic_traits_2>;
template class Encounters<Polynomial_disc_kinetic_traits_2>;

}  // namespace kinetri
