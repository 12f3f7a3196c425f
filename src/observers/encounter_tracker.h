// SPDX-License-Identifier: GPL-3.0-or-later
//
// The implementation of Encounters (encounters.h describes candidates).
#ifndef KINETRI_SRC_OBSERVERS_ENCOUNTER_TRACKER_H
#define KINETRI_SRC_OBSERVERS_ENCOUNTER_TRACKER_H

#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "kinetri/impl/base/check.h"
#include "kinetri/observers/encounters.h"
#include "observers/departures.h"
#include "observers/edge_follower.h"
#include "observers/encounter_records.h"
#include "observers/enlarged_discs.h"
#include "observers/failure_queue.h"
#include "observers/later_time_in_range.h"
#include "simulation/short_vectors.h"

namespace kinetri::detail {

/// Invariant, at the last reported time: each pair in range has a record, and an entry in the queue
/// if that ends; each other candidate has an entry if it will come in range.
template <DistanceKineticTraits_2 Traits>
class Encounter_tracker final : private Edge_follower<Traits> {
 public:
  using typename Edge_follower<Traits>::Edge_name;
  using typename Edge_follower<Traits>::Image_2;
  using typename Edge_follower<Traits>::Neighbor;
  using typename Edge_follower<Traits>::Point_2;
  using typename Edge_follower<Traits>::Time;
  using Edge_follower<Traits>::is_periodic;
  using Records = Encounter_records<Traits>;
  using Motion = typename Records::Motion;
  using Record = typename Records::Record;

  /// Observes a triangulation or a simulation. `radius` is that of points without radii of their
  /// own.
  template <class Observed>
  Encounter_tracker(Observed& observed, double range, double radius)
      : Edge_follower<Traits>(observed),
        range_(range),
        radius_(radius),
        partners_(this->graph().next_id()),
        records_(radius) {
    KINETRI_PRECONDITION(range >= 0 && std::isfinite(range),
                         "the range must be a number of at least 0");
    const auto& graph = this->graph();
    const Time& now = this->triangulation().current_time();
    if constexpr (has_radii) {
      enlarged_discs_ = std::make_unique<Enlarged_discs<Traits>>(graph, range, now, this->traits());
      for (Point_id id = 0; id < partners_.size(); ++id) {
        if (graph.contains(id)) examine_new_motion(id, now);
      }
    } else {
      if constexpr (is_periodic) {  // throws if it would find millions of images of each point
        Short_vectors<Traits>(this->traits(), now).steps(range_);
      }
      for (Point_id id = 0; id < partners_.size(); ++id) {
        if (!graph.contains(id)) continue;
        for (const Neighbor& other : graph.neighbors(id)) {
          if (is_first(id, other)) examine(id, other, now);
        }
      }
    }
    execute(now);
  }

  double range() const { return range_; }
  std::vector<Encounter> encounters() {
    this->update();
    const auto present = [this](Point_id id) -> const Point_2& { return this->graph().point(id); };
    return records_.encounters([&](const Edge_name& pair) { return motions_of(pair, present); },
                               this->triangulation().current_time());
  }
  const Certificate_counters& certificate_counters() const { return certificate_counters_; }
  const Queue_counters& queue_counters() const { return queue_.counters(); }

 private:
  using typename Edge_follower<Traits>::Changed_point;
  static constexpr bool has_radii = HasWeight<typename Traits::Motion>;
  using Disc_traits = Basic_kinetic_traits_2<typename Records::Disc>;

  // ---- called by the base ----

  void advance(const Time& time) override {
    if constexpr (has_radii) {
      // Pairs that come in range by `time` have overlapped as enlarged discs before.
      for (const auto& [points, since] : enlarged_discs_->advance_to(time)) {
        const auto [id, other] = ends_of(points)[0];
        examine(id, other, since);
      }
    }
    execute(time);
  }

  void before_change(std::span<const Edge_name> /*removed*/,
                     std::span<const Changed_point> points) override {
    for (const auto& point : points) {
      if (point.before) discard_entries(point.id);
    }
  }

  void change(const Time& time, std::span<const Edge_name> /*removed*/,
              std::span<const Edge_name> added, std::span<const Changed_point> points) override {
    if (partners_.size() < this->graph().next_id()) partners_.resize(this->graph().next_id());
    for (const auto& point : points) change_motion(point.id, time, points);
    if constexpr (!is_periodic) {
      departures_.change(time, points, this->graph(), range_, radius_,
                         [&](const auto& p, const auto& q) { meet_for_a_moment(p, q, time); });
    }
    if constexpr (has_radii) {
      if (!points.empty()) enlarged_discs_->change(points, this->graph());
    } else {
      for (const Edge_name& edge : added) examine_new_edge(edge, time);
    }
    for (const auto& point : points) {
      if (this->graph().contains(point.id)) examine_new_motion(point.id, time);
    }
    execute(time);
  }

  // The begin or end of an encounter.
  struct Entry : Failure {
    bool is_end = false;
    Edge_name points = {};
  };
  using Queue = Failure_queue<Entry, Encounter_tracker>;
  friend Queue;

  // A point that is in range of another one.
  struct Near {
    Neighbor id;
    std::uint32_t record;  // index
  };
  // A point that will come in range of another one.
  struct Waiting {
    Neighbor id;
    Queue_handle begin_event;
  };
  // Pairs are stored at both points, those of a point and its own image twice. Sorted by id.
  struct Partners {
    boost::container::small_vector<Near, 8> near;
    boost::container::small_vector<Waiting, 8> waiting;
  };

  // The position of `id` in a sequence that is sorted by id.
  static auto place(auto& sorted, const auto& id) {
    return std::lower_bound(sorted.begin(), sorted.end(), id,
                            [](const auto& item, const auto& other) { return item.id < other; });
  }
  static bool is_among(const auto& sorted, const auto& id) {
    const auto item = place(sorted, id);
    return item != sorted.end() && item->id == id;
  }
  static void remove_from(auto& sorted, const auto& id) { sorted.erase(place(sorted, id)); }

  // ---- certificates ----

  // Calls `function` with traits and the two points; with discs if the points have a common radius,
  // since its sum with the range may not be a binary64 number.
  template <class Function>
  auto with_discs(const Image_2& p, const Image_2& q, Function function) const {
    if constexpr (!has_radii) {
      if (radius_ != 0) {
        using Moving_disc = typename Disc_traits::Point_2;
        return function(disc_traits_, Moving_disc(disc_about(p.motion(), radius_), p.id()),
                        Moving_disc(disc_about(q.motion(), radius_), q.id()));
      }
    }
    return function(this->traits(), p, q);
  }
  template <class Function>
  auto with_discs(const Edge_name& pair, Function function) const {
    return with_discs(this->first_end(pair), this->second_end(pair), function);
  }

  // ---- candidates ----

  bool is_near(Point_id a, const Neighbor& b) const { return is_among(partners_[a].near, b); }

  // Schedules the begin of the encounter of a candidate, unless it is in range or scheduled.
  // Precondition: `after` is not before the last change of a motion of the two.
  void examine(Point_id a, const Neighbor& b, const Time& after) {
    if (is_near(a, b) || is_among(partners_[a].waiting, b)) return;
    const Edge_name pair = pair_of(a, b);
    Certificate certificate =
        with_discs(pair, [&](const auto& traits, const auto& p, const auto& q) {
          return traits.apart_certificate(p, q, range_, after);
        });
    certificate_counters_.count(certificate);
    wait(pair, std::move(certificate));
  }

  // Candidates (p, q), of which p is the first end, for which a point w is in range of both and wq
  // is an edge. Here w is in range of p, and q any neighbor of w.
  void examine_from(Point_id p, const Neighbor& w, const Time& after) {
    for (const Neighbor& next : this->graph().neighbors(id_of(w))) {
      const Neighbor q = beyond(w, next);
      if (is_first(p, q) && is_near(id_of(w), next)) examine(p, q, after);
    }
  }

  // The same; w is in range of q, its neighbor, and p any point in range of w.
  void examine_to(Point_id w, const Neighbor& q, const Time& after) {
    for (const Near& near : partners_[w].near) {
      const Neighbor p = beyond(back_from(q, w), near.id);
      if (is_first(id_of(p), back_from(p, id_of(q)))) examine(id_of(q), p, after);
    }
  }

  void examine_new_edge(const Edge_name& edge, const Time& after) {
    const auto [from_a, from_b] = ends_of(edge);
    examine(from_a.first, from_a.second, after);
    if (!is_near(from_a.first, from_a.second)) return;
    examine_to(from_a.first, from_a.second, after);
    examine_to(from_b.first, from_b.second, after);
  }

  void examine_new_near(const Edge_name& pair, const Time& after) {
    const auto ends = ends_of(pair);
    for (const auto& [id, other] : ends) examine_from(id, other, after);
    if (!this->graph().is_edge(pair)) return;
    for (const auto& [id, other] : ends) examine_to(id, other, after);
  }

  void examine_new_motion(Point_id id, const Time& after) {
    if constexpr (has_radii) {
      for (const Neighbor& other : enlarged_discs_->overlapping(id)) examine(id, other, after);
    } else {
      for (const Neighbor& other : this->graph().neighbors(id)) {
        examine(id, other, after);
        if (is_near(id, other)) examine_to(id_of(other), back_from(other, id), after);
      }
      for (const Near& near : partners_[id].near) examine_from(id, near.id, after);
    }
  }

  // ---- the queue ----

  Time failure_time(const Entry& entry) const {
    return with_discs(entry.points, [&](const auto& traits, const auto& p, const auto& q) {
      return traits.contact_failure(p, q, range_, entry.bounds);
    });
  }
  // Begins come before ends: encounters are closed in time.
  bool precedes(const Entry& a, const Entry& b) const {
    return std::tuple(a.is_end, !a.is_recheck, a.points) <
           std::tuple(b.is_end, !b.is_recheck, b.points);
  }
  KINETRI_ALWAYS_INLINE void prefetch(const Entry& entry) const {
    for (const Point_id id : ids_of(entry.points)) {
      this->graph().prefetch(id);
      prefetch_object(partners_[id]);
    }
  }

  // Schedules the failure of the certificate that a pair is apart.
  void wait(const Edge_name& pair, Certificate certificate) {
    Entry entry;
    entry.points = pair;
    const Queue_handle event = queue_.push(entry, std::move(certificate));
    if (event == no_event) return;
    for (const auto& [id, other] : ends_of(pair)) {
      auto& waiting = partners_[id].waiting;
      waiting.insert(place(waiting, other), {other, event});
    }
  }

  void stop_waiting(const Edge_name& pair) {
    for (const auto& [id, other] : ends_of(pair)) remove_from(partners_[id].waiting, other);
  }

  // The point is about to get another motion, or to be erased.
  void discard_entries(Point_id id) {
    for (const auto& [other, event] : partners_[id].waiting) {
      if (id_of(other) != id) {
        remove_from(partners_[id_of(other)].waiting, back_from(other, id));
      } else if (!is_first(id, other)) {
        continue;  // its own image, which is there twice
      }
      queue_.erase(event);
    }
    partners_[id].waiting.clear();
    for (const Near& near : partners_[id].near) {
      queue_.erase(std::exchange(records_[near.record].end_event, no_event));
    }
  }

  void schedule_end(Record& record, const Time& after) {
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

  // Executes due entries. A pair that comes in range may make another one a candidate that comes in
  // range at the same time. Ends at `time` itself are not due: the two are still in range, and may
  // get motions at that time with which they remain so.
  void execute(const Time& time) {
    const auto waits = [](const Entry& entry) { return entry.is_end; };
    while (const auto due = queue_.take_due(time, waits)) {
      const auto& [entry, entry_time] = *due;
      const auto [a, b] = ends_of(entry.points)[0];
      if (entry.is_end) {
        const std::uint32_t record = place(partners_[a].near, b)->record;
        if (entry.is_recheck) {
          schedule_end(records_[record], entry_time);
          continue;
        }
        records_[record].end_event = no_event;
        const auto& p = this->first_end(entry.points);
        const auto& q = this->second_end(entry.points);
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

  // ---- encounters ----

  void begin(const Entry& entry, const Time& time) {
    const Edge_name& pair = entry.points;
    const std::uint32_t index = records_.begin(pair, time);
    // The pairs that will be examined.
    if constexpr (!has_radii) {
      for (const Point_id id : ids_of(pair)) {
        for (const Near& near : partners_[id].near) {
          this->graph().prefetch(id_of(near.id));
          prefetch_address(&partners_[id_of(near.id)].waiting);
        }
      }
    }
    for (const auto& [id, other] : ends_of(pair)) {
      auto& near = partners_[id].near;
      near.insert(place(near, other), {other, index});
    }
    // A filter cannot decide the end from the begin on, when the certificate is 0.
    schedule_end(records_[index],
                 entry.changes_sign
                     ? Time(with_discs(pair,
                                       [&](const auto& traits, const auto& p, const auto& q) {
                                         return later_time_in_range(traits, p, q, range_,
                                                                    entry.bounds.upper);
                                       }))
                     : time);
    if constexpr (!has_radii) examine_new_near(pair, time);
  }

  // The motions are those up to `time`. Precondition: the record has no entry in the queue.
  void end(std::uint32_t index, const Time& time, const Motion& p, const Motion& q) {
    Record& record = records_[index];
    for (const auto& [id, other] : ends_of(record.points)) remove_from(partners_[id].near, other);
    records_.end(record, time, p, q);
  }

  // The point has got another motion or has been erased, as the others in `changed`.
  void change_motion(Point_id id, const Time& time, const auto& changed) {
    const auto before = [&](Point_id other) -> const Point_2* {
      const auto point = place(changed, other);
      return point != changed.end() && point->id == other ? &*point->before : nullptr;
    };
    const auto point_before = [&](Point_id point) -> const Point_2& {
      const Point_2* const changed_point = before(point);
      return changed_point == nullptr ? this->graph().point(point) : *changed_point;
    };
    const std::vector<Near> partners(partners_[id].near.begin(), partners_[id].near.end());
    for (const auto& [other, index] : partners) {
      if (!is_first(id, other) && before(id_of(other)) != nullptr) continue;  // done before
      Record& record = records_[index];
      const auto [p, q] = motions_of(record.points, point_before);
      const bool goes_on =
          this->graph().contains(id) && this->graph().contains(id_of(other)) &&
          with_discs(record.points, [&](const auto& traits, const auto& of_p, const auto& of_q) {
            return traits.do_touch(of_p, of_q, range_, time);
          });
      if (!goes_on) {
        end(index, time, p, q);
        continue;
      }
      records_.begin_piece(record, time, p, q);
      schedule_end(record, time);
    }
  }

  // The motions of the ends of a pair, if its points are those that `point_of` gives.
  template <class Point_of>
  std::pair<Motion, Motion> motions_of(const Edge_name& pair, const Point_of& point_of) const {
    const auto& [a, b] = ids_of(pair);
    if constexpr (is_periodic) {
      return {this->traits().image(point_of(a), {}).motion(),
              this->traits().image(point_of(b), pair.offset).motion()};
    } else {
      return {point_of(a).motion(), point_of(b).motion()};
    }
  }

  // An encounter of a point that is erased at the time, and one that is inserted then.
  void meet_for_a_moment(const Point_2& p, const Point_2& q, const Time& time) {
    if (p.id() > q.id()) return meet_for_a_moment(q, p, time);
    const bool is_in_range =
        with_discs(p, q, [&](const auto& traits, const auto& a, const auto& b) {
          return traits.do_touch(a, b, range_, time);
        });
    if (!is_in_range) return;
    Record& record = records_[records_.begin({p.id(), q.id()}, time)];
    records_.end(record, time, p.motion(), q.motion());
  }

  double range_;
  double radius_;
  Disc_traits disc_traits_;
  std::vector<Partners> partners_;  // by id
  Queue queue_{*this};
  Records records_;
  Departures<Point_2> departures_;
  struct Nothing {};
  [[no_unique_address]] std::conditional_t<has_radii, std::unique_ptr<Enlarged_discs<Traits>>,
                                           Nothing>
      enlarged_discs_;
  Certificate_counters certificate_counters_;
};

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_OBSERVERS_ENCOUNTER_TRACKER_H
