// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/observers/encounters.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "kinetri/impl/base/check.h"
#include "observers/encounter_candidates_impl.h"
#include "observers/later_time_in_range.h"

namespace kinetri {
namespace {

// More pieces than this are compared exactly, of which one remains.
constexpr std::size_t most_pieces = 32;

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
  departures_.change(time, points, this->graph(), range_, radius_,
                     [&](const auto& p, const auto& q) { meet_for_a_moment(p, q, time); });
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

// ---- encounters ----

template <ContactKineticTraits_2 Traits>
void Encounters<Traits>::begin(const Entry& entry, const Time& time) {
  const Edge_ids& pair = entry.points;
  const auto [a, b] = pair;
  const auto index = static_cast<std::uint32_t>(records_.size());
  Record& record = records_.emplace_back();
  record.points = pair;
  record.begin = time;
  record.since = time;
  auto& near_a = partners_[a].near;
  auto& near_b = partners_[b].near;
  // With which the two will be examined.
  if constexpr (!has_radii) {
    for (const auto* const near_one : {&near_a, &near_b}) {
      for (const Near& near : *near_one) {
        this->graph().prefetch(near.id);
        detail::prefetch_address(&partners_[near.id].waiting);
      }
    }
  }
  near_a.insert(place(near_a, b), {b, index});
  near_b.insert(place(near_b, a), {a, index});
  // Near the beginning itself no filter could decide when it ends.
  schedule_end(record, entry.changes_sign
                           ? Time(with_discs(pair,
                                             [&](const auto& traits, const auto& p, const auto& q) {
                                               return detail::later_time_in_range(
                                                   traits, p, q, range_, entry.bounds.upper);
                                             }))
                           : time);
  observers_.call([&](Encounter_observer& observer) { observer.begins(pair, time); });
  if constexpr (!has_radii) examine_new_near(pair, time);
}

// The motions are those up to `time`. Precondition: the record has no entry in the queue.
template <ContactKineticTraits_2 Traits>
void Encounters<Traits>::end(std::size_t index, const Time& time, const Motion& p,
                             const Motion& q) {
  Record& record = records_[index];
  const auto [a, b] = record.points;
  remove_from(partners_[a].near, b);
  remove_from(partners_[b].near, a);
  record.has_ended = true;
  record.end = time;
  record.pieces.push_back({p, q, record.since, time});
  observers_.call([&](Encounter_observer& observer) { observer.ends(record.points, time); });
}

// The point has got another motion, or has gone, as have the other ones that have changed.
template <ContactKineticTraits_2 Traits>
void Encounters<Traits>::turn(
    Point_id id, const Time& time,
    std::span<const typename Edge_follower<Traits>::Changed_point> changed) {
  const auto before = [&](Point_id other) -> const Point_2* {
    const auto point = place(changed, other);
    return point != changed.end() && point->id == other ? &*point->before : nullptr;
  };
  const std::vector<Near> partners(partners_[id].near.begin(), partners_[id].near.end());
  for (const auto& [other, index] : partners) {
    const Point_2* const other_before = before(other);
    if (other < id && other_before != nullptr) continue;  // done before
    Record& record = records_[index];
    const auto motion_before = [&](Point_id point) -> const Motion& {
      const Point_2* const changed_point = point == id ? before(id) : other_before;
      return (changed_point == nullptr ? this->graph().point(point) : *changed_point).motion();
    };
    const Motion& p = motion_before(record.points[0]);
    const Motion& q = motion_before(record.points[1]);
    const bool goes_on =
        this->graph().contains(id) && this->graph().contains(other) &&
        with_discs(record.points, [&](const auto& traits, const auto& of_p, const auto& of_q) {
          return traits.do_touch(of_p, of_q, range_, time);
        });
    if (!goes_on) {
      end(index, time, p, q);
      continue;
    }
    finish_piece(record, time, p, q);
    schedule_end(record, time);
  }
}

// Of a point that has gone at the time, and one that comes then.
template <ContactKineticTraits_2 Traits>
void Encounters<Traits>::meet_for_a_moment(const Point_2& p, const Point_2& q, const Time& time) {
  if (p.id() > q.id()) return meet_for_a_moment(q, p, time);
  const bool is_in_range = with_discs(p, q, [&](const auto& traits, const auto& a, const auto& b) {
    return traits.do_touch(a, b, range_, time);
  });
  if (!is_in_range) return;
  Record& record = records_.emplace_back();
  record.points = {p.id(), q.id()};
  record.has_ended = true;
  record.begin = time;
  record.end = time;
  record.pieces.push_back({p.motion(), q.motion(), time, time});
  observers_.call([&](Encounter_observer& observer) { observer.begins(record.points, time); });
  observers_.call([&](Encounter_observer& observer) { observer.ends(record.points, time); });
}

// Keeps the piece that ends at `time`, and drops those that certainly have not the least gap.
template <ContactKineticTraits_2 Traits>
void Encounters<Traits>::finish_piece(Record& record, const Time& time, const Motion& p,
                                      const Motion& q) const {
  std::vector<Piece>& pieces = record.pieces;
  pieces.push_back(
      {p, q, record.since, time, detail::least_gap_bounds(disc(p), disc(q), record.since, time)});
  record.since = time;
  if (pieces.size() == 1) return;
  double least = pieces.back().least_gap.upper;
  for (const Piece& piece : pieces) least = std::min(least, piece.least_gap.upper);
  std::erase_if(pieces, [&](const Piece& piece) { return piece.least_gap.lower > least; });
  if (pieces.size() < most_pieces) return;
  pieces.assign(1, least_gap(pieces).piece);
}

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
    if (!record.has_ended) {
      std::vector<Piece> pieces = record.pieces;
      pieces.push_back({this->graph().point(record.points[0]).motion(),
                        this->graph().point(record.points[1]).motion(), record.since, now});
      keep_least_gap(record, pieces);
    } else if (!record.pieces.empty()) {
      keep_least_gap(record, std::exchange(record.pieces, {}));
    }
    result.push_back({record.points, record.begin, record.has_ended ? record.end : now,
                      record.closest, record.distance, record.gap});
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
