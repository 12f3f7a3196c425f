// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Encounters: which pairs are candidates, and the queue in which they wait.
#ifndef KINETRI_SRC_OBSERVERS_ENCOUNTER_CANDIDATES_IMPL_H
#define KINETRI_SRC_OBSERVERS_ENCOUNTER_CANDIDATES_IMPL_H

#include <algorithm>
#include <tuple>
#include <utility>

#include "kinetri/observers/encounters.h"
#include "observers/enlarged_discs.h"

namespace kinetri {
namespace {

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

}  // namespace

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

// ---- candidates ----

template <ContactKineticTraits_2 Traits>
bool Encounters<Traits>::is_near(Point_id a, Point_id b) const {
  return is_among(partners_[a].near, b);
}

// Lets a pair wait that is a candidate, if it is not known that it is or will be in range and if it
// will be. Looks for what is known at `a`. Precondition: `after` is not before the last change of a
// motion of the two.
template <ContactKineticTraits_2 Traits>
void Encounters<Traits>::examine(Point_id a, Point_id b, const Time& after) {
  if (is_near(a, b) || is_among(partners_[a].waiting, b)) return;
  const Edge_ids pair = edge_ids(a, b);
  Certificate certificate = with_discs(pair, [&](const auto& traits, const auto& p, const auto& q) {
    return traits.apart_certificate(p, q, range_, after);
  });
  certificate_counters_.count(certificate);
  wait(pair, std::move(certificate));
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
    if (near.id < q) examine(q, near.id, after);
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
auto Encounters<Traits>::failure_time(const Entry& entry) const -> Time {
  return with_discs(entry.points, [&](const auto& traits, const auto& p, const auto& q) {
    return traits.contact_failure(p, q, range_, entry.bounds);
  });
}

// What begins is before what ends: both are in range at that time.
template <ContactKineticTraits_2 Traits>
bool Encounters<Traits>::precedes(const Entry& a, const Entry& b) const {
  return std::tuple(a.is_end, !a.is_recheck, a.points) <
         std::tuple(b.is_end, !b.is_recheck, b.points);
}

template <ContactKineticTraits_2 Traits>
KINETRI_ALWAYS_INLINE void Encounters<Traits>::prefetch(const Entry& entry) const {
  for (const Point_id id : entry.points) {
    this->graph().prefetch(id);
    detail::prefetch_object(partners_[id]);
  }
}

// Has a pair wait for the failure of the certificate that it is apart, if there is one.
template <ContactKineticTraits_2 Traits>
void Encounters<Traits>::wait(const Edge_ids& pair, Certificate certificate) {
  Entry entry;
  entry.points = pair;
  const Queue_handle event = queue_.push(entry, std::move(certificate));
  if (event == no_event) return;
  for (const auto& [id, other] : {std::pair(pair[0], pair[1]), std::pair(pair[1], pair[0])}) {
    auto& waiting = partners_[id].waiting;
    waiting.insert(place(waiting, other), {other, event});
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
  for (const auto& [other, event] : partners_[id].waiting) {
    remove_from(partners_[other].waiting, id);
    queue_.erase(event);
  }
  partners_[id].waiting.clear();
  for (const Near& near : partners_[id].near) {
    queue_.erase(std::exchange(records_[near.record].end_event, no_event));
  }
}

template <ContactKineticTraits_2 Traits>
void Encounters<Traits>::schedule_end(Record& record, const Time& after) {
  Certificate certificate =
      with_discs(record.points, [&](const auto& traits, const auto& p, const auto& q) {
        return traits.near_certificate(p, q, range_, after);
      });
  certificate_counters_.count(certificate);
  Entry entry;
  entry.is_end = true;
  entry.points = record.points;
  record.end_event = queue_.push(entry, std::move(certificate));
}

// Executes what is due. Where several pairs come in range at one time, one makes another one a
// candidate, which then waits up to the same time. What ends at `time` itself is not due: the two
// are in range still, and may get motions at that time with which they remain so.
template <ContactKineticTraits_2 Traits>
void Encounters<Traits>::execute(const Time& time) {
  const auto waits = [](const Entry& entry) { return entry.is_end; };
  while (const auto due = queue_.take_due(time, waits)) {
    const auto& [entry, entry_time] = *due;
    const auto [a, b] = entry.points;
    if (entry.is_end) {
      const std::uint32_t record = place(partners_[a].near, b)->record;
      if (entry.is_recheck) {
        schedule_end(records_[record], entry_time);
        continue;
      }
      records_[record].end_event = no_event;
      const Point_2& p = this->graph().point(a);
      const Point_2& q = this->graph().point(b);
      end(record, entry_time, p.motion(), q.motion());
      Certificate next = with_discs(
          p, q, [this, &at = entry_time](const auto& traits, const auto& of_p, const auto& of_q) {
            return traits.next_apart_certificate(of_p, of_q, range_, at);
          });
      certificate_counters_.count(next);
      wait(entry.points, std::move(next));
    } else {
      stop_waiting(entry.points);
      if (entry.is_recheck) {
        examine(a, b, entry_time);
      } else {
        begin(entry, entry_time);
      }
    }
  }
}

}  // namespace kinetri

#endif  // KINETRI_SRC_OBSERVERS_ENCOUNTER_CANDIDATES_IMPL_H
