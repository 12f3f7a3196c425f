// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Region_run: other motions of many points at one time. A region does what concerns
// the points of which it owns all triangles; of these it writes the slots of their edges, which
// have both ends in the region. Entries leave all parts before the first motion changes, since they
// speak of motions, and come back when the last one has.
#ifndef KINETRI_SRC_TRIANGULATION_REGION_BATCHES_IMPL_H
#define KINETRI_SRC_TRIANGULATION_REGION_BATCHES_IMPL_H

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "kinetri/impl/triangulation/parallel.h"
#include "triangulation/regions.h"

namespace kinetri::detail {

template <class Traits, class Turns>
void Region_run<Traits, Turns>::make_turns(std::span<const Change> turns) {
  struct Share {
    Lane* lane = nullptr;
    std::vector<const Change*> turns = {};
    std::vector<const Change*> others = {};  // of points that have triangles with other regions
    std::vector<Two_sided_edge> edges = {};
    Time now = {};  // a copy of its own
  };
  go_on_with_division();
  forget_first();
  std::vector<Share> shares(regions_);
  for (std::size_t region = 0; region < regions_; ++region) {
    shares[region].lane = &lanes_[region];
    shares[region].now = schedule_.current_time().detached();
  }
  Share rest;
  for (const Change& change : turns) {
    const std::size_t owner = division().owner(change.point);
    (owner < regions_ ? shares[owner] : rest).turns.push_back(&change);
  }
  const auto unschedule = [this](Share& share, Triangulation_counters& counters) {
    for (const Change* turn : share.turns) {
      schedule_.unschedule_around(topology_.vertex(turn->point), share.edges, counters);
    }
  };
  const auto set_points = [this](const Share& share) {
    for (const Change* turn : share.turns) topology_.set_point(*turn);
  };
  call_with_threads(options_.threads, [&] {
    for_each(shares, [&](Share& share) {
      const auto others = std::stable_partition(
          share.turns.begin(), share.turns.end(),
          [&](const Change* turn) { return owns_star(*share.lane, turn->point); });
      share.others.assign(others, share.turns.end());
      share.turns.erase(others, share.turns.end());
      share.edges.reserve(16 * share.turns.size());
      unschedule(share, share.lane->counters);
    });
    for (const Share& share : shares) {
      rest.turns.insert(rest.turns.end(), share.others.begin(), share.others.end());
    }
    unschedule(rest, reporter_.counters());
    for_each(shares, set_points);
    set_points(rest);
    for_each(shares, [this](Share& share) {
      Lane& lane = *share.lane;
      certification_.certify(share.edges, share.now, Certificate_state::any, lane.certificates,
                             [&](const Two_sided_edge& edge, Entry_kind kind, Certificate&& known) {
                               put(lane, edge, kind, std::move(known));
                             });
    });
  });
  schedule_.schedule(rest.edges, schedule_.current_time());
  for (Lane& lane : lanes_) count_certificates(lane);
}

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_TRIANGULATION_REGION_BATCHES_IMPL_H
