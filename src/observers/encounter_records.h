// SPDX-License-Identifier: GPL-3.0-or-later
//
// The encounters of a run, with the data to compute the least gap of each.
#ifndef KINETRI_SRC_OBSERVERS_ENCOUNTER_RECORDS_H
#define KINETRI_SRC_OBSERVERS_ENCOUNTER_RECORDS_H

#include <algorithm>
#include <boost/container/deque.hpp>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "kinetri/impl/observers/neighbor_names.h"
#include "kinetri/observers/encounters.h"
#include "observers/gap_of_pair.h"

namespace kinetri::detail {

/// All encounters so far. Invariant: each stores the former motions that may have its least gap or,
/// after its end, perhaps the least gap itself. The motions of a pair are those of its two ends, in
/// a periodic box of images.
template <class Traits>
class Encounter_records {
 public:
  using Time = Algebraic_number;
  using Pair = Edge_name<Traits>;
  using Motion = typename Certified_point_2<Traits>::Motion;
  using Disc = decltype(disc_about(std::declval<Motion>(), 0.0));

  /// The motions of two points in range, for some time.
  struct Piece {
    Motion p;
    Motion q;
    Time since;
    Time until;
    Double_interval least_gap = {};  ///< bounds of it
  };

  struct Record {
    Pair points;
    Queue_handle end_event = no_event;  ///< set by the owner of this object
    bool has_ended = false;
    Time begin;
    Time end = {};                   ///< if it has ended
    Time since = {};                 ///< of the present motions
    std::vector<Piece> pieces = {};  ///< in the order of time
    Time closest = {};
    double distance = 0;
    double gap = 0;
  };

  /// `radius` is that of points without radii of their own.
  explicit Encounter_records(double radius) : radius_(radius) {}

  /// Adds an encounter that begins. Returns its index.
  std::uint32_t begin(const Pair& points, const Time& time) {
    const auto index = static_cast<std::uint32_t>(records_.size());
    Record& record = records_.emplace_back();
    record.points = points;
    record.begin = time;
    record.since = time;
    return index;
  }
  Record& operator[](std::uint32_t index) { return records_[index]; }

  /// The encounter ends at `time`, up to which the two have these motions.
  void end(Record& record, const Time& time, const Motion& p, const Motion& q) {
    record.has_ended = true;
    record.end = time;
    record.pieces.push_back({p, q, record.since, time});
  }

  /// The two get other motions at `time`. Drops motions without the least gap.
  void begin_piece(Record& record, const Time& time, const Motion& p, const Motion& q) const {
    std::vector<Piece>& pieces = record.pieces;
    pieces.push_back(
        {p, q, record.since, time,
         least_gap_bounds(disc_about(p, radius_), disc_about(q, radius_), record.since, time)});
    record.since = time;
    if (pieces.size() == 1) return;
    double least = pieces.back().least_gap.upper;
    for (const Piece& piece : pieces) least = std::min(least, piece.least_gap.upper);
    std::erase_if(pieces, [&](const Piece& piece) { return piece.least_gap.lower > least; });
    if (pieces.size() < most_pieces) return;
    pieces.assign(1, least_gap_of(pieces).piece);
  }

  /// The result of Encounters::encounters at the time `now`. motions_of(points) are the two present
  /// motions of a pair.
  template <class Motions_of>
  std::vector<Encounter> encounters(const Motions_of& motions_of, const Time& now) {
    std::vector<Encounter> result;
    result.reserve(records_.size());
    for (Record& record : records_) {
      if (!record.has_ended) {
        std::vector<Piece> pieces = record.pieces;
        const auto [p, q] = motions_of(record.points);
        pieces.push_back({p, q, record.since, now});
        keep_least_gap(record, pieces);
      } else if (!record.pieces.empty()) {
        keep_least_gap(record, std::exchange(record.pieces, {}));
      }
      result.push_back({ids_of(record.points), record.begin, record.has_ended ? record.end : now,
                        record.closest, record.distance, record.gap, offset_of(record.points)});
    }
    std::ranges::sort(result, [](const Encounter& a, const Encounter& b) {
      const auto order = a.begin <=> b.begin;
      if (order != 0) return order < 0;
      return a.points != b.points ? a.points < b.points : a.offset < b.offset;
    });
    return result;
  }

 private:
  // The first piece with the least gap, and that gap.
  struct Least_gap {
    Piece piece;
    Gap_of_pair<Disc> gap;
  };
  // With more pieces an exact comparison leaves one of them.
  static constexpr std::size_t most_pieces = 32;

  Least_gap least_gap_of(const std::vector<Piece>& pieces) const {
    std::optional<Least_gap> result;
    for (const Piece& piece : pieces) {
      auto gap = least_gap(disc_about(piece.p, radius_), disc_about(piece.q, radius_), piece.since,
                           piece.until);
      if (!result || gap.compare(result->gap) == CGAL::SMALLER) {
        result = Least_gap{piece, std::move(gap)};
      }
    }
    return std::move(*result);
  }

  void keep_least_gap(Record& record, const std::vector<Piece>& pieces) const {
    const Gap_of_pair<Disc> gap = least_gap_of(pieces).gap;
    record.closest = gap.time();
    record.distance = gap.rounded_distance();
    record.gap = gap.rounded();
  }

  using Large_blocks =
      boost::container::deque_options<boost::container::block_bytes<1U << 16>>::type;
  double radius_;
  boost::container::deque<Record, void, Large_blocks> records_;
};

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_OBSERVERS_ENCOUNTER_RECORDS_H
