// SPDX-License-Identifier: GPL-3.0-or-later
//
// The records of points: their entries in the queue, and their overlaps.
#ifndef KINETRI_SRC_SIMULATION_CONTACT_RECORDS_H
#define KINETRI_SRC_SIMULATION_CONTACT_RECORDS_H

#include <algorithm>
#include <cstddef>
#include <memory>
#include <vector>

#include "kinetri/base/ids.h"
#include "kinetri/events/event.h"
#include "kinetri/impl/events/queue_handle.h"
#include "simulation/simulation_entry.h"

namespace kinetri::detail {

/// A disc that may come into contact with that of the record.
struct Contact_partner {
  Point_id id;
  Queue_handle event;
};

/// A disc that overlaps, almost overlaps, or has overlapped until recently.
struct Disc_overlap {
  Point_id id;
  bool passes;   ///< whether a response has let the two pass: no contact until they separate
  bool is_edge;  ///< whether there is an edge between the two, if they do overlap now
};

/// The record of a point. Pairs are in the records of both points.
struct Contact_record {
  Queue_handle wall_event = no_event;
  Queue_handle vanish_event = no_event;
  std::vector<Contact_partner> partners;
  std::vector<Disc_overlap> overlaps;  ///< all present ones, and perhaps others
  std::vector<Point_id> corners;       ///< that the point is linked with (Disc_geometry)
};

/// The records by point id. A point without entries and overlaps need not have one.
///
/// Invariant: pairs are in both records, with the same values. Several threads may call functions
/// for different points after make_room.
class Contact_records {
 public:
  std::size_t size() const { return records_.size(); }
  /// Resizes to points with ids less than `ids`.
  void make_room(std::size_t ids) {
    if (ids > records_.size()) records_.resize(ids);
  }

  /// The record of a point; null if there is none.
  Contact_record* find(Point_id id) const {
    return id < records_.size() ? records_[id].get() : nullptr;
  }
  /// The record of a point, created if there is none.
  Contact_record& of(Point_id id);
  /// Deletes the record of an erased point.
  void forget_point(Point_id id) {
    if (id < records_.size()) records_[id].reset();
  }
  /// Calls `function` with each record.
  template <class Function>
  void for_each(const Function& function) const {
    for (const auto& record : records_) {
      if (record != nullptr) function(*record);
    }
  }

  // ---- entries of the queue ----

  /// The handle of the entry of a pair; no_event if there is none.
  Queue_handle pair_event(const Edge_ids& pair) const;
  /// The handle of the entry of a subject; no_event if there is none.
  Queue_handle event(const Contact_subject& subject) const;
  /// Changes the handle of an entry.
  void set_event(const Contact_subject& subject, Queue_handle handle);
  /// Adds the handle of a new entry.
  void add_event(const Contact_subject& subject, Queue_handle handle);
  /// Removes the handle of an entry.
  void forget_event(const Contact_subject& subject);
  /// The same of a pair. Returns the handle; no_event if it has none.
  Queue_handle forget_pair(const Edge_ids& pair);
  /// The same in the record of the first point only.
  Queue_handle forget_partner(Point_id id, Point_id other);

  // ---- overlaps ----

  const std::vector<Disc_overlap>& overlaps(Point_id id) const;
  /// The record of a pair that overlaps; null if there is none.
  const Disc_overlap* find_overlap(const Edge_ids& pair) const;
  /// Records that a pair overlaps, if it is not recorded. `is_edge` may be false if the two only
  /// almost overlap.
  void start_overlap(Point_id a, Point_id b, bool is_edge);
  /// Removes a recorded pair.
  void forget_overlap(Point_id a, Point_id b);
  /// Sets whether a response has let a recorded pair pass.
  void mark_passing(Point_id a, Point_id b, bool passes) {
    amend_overlap({a, b}, [&](Disc_overlap& overlap) { overlap.passes = passes; });
  }
  /// Sets whether a recorded pair has an edge.
  void mark_edge(const Edge_ids& pair, bool is_edge) {
    amend_overlap(pair, [&](Disc_overlap& overlap) { overlap.is_edge = is_edge; });
  }

 private:
  template <class Amend>
  void amend_overlap(const Edge_ids& pair, const Amend& amend) {
    amend(*std::ranges::find(of(pair[0]).overlaps, pair[1], &Disc_overlap::id));
    amend(*std::ranges::find(of(pair[1]).overlaps, pair[0], &Disc_overlap::id));
  }

  std::vector<std::unique_ptr<Contact_record>> records_;
};

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_SIMULATION_CONTACT_RECORDS_H
