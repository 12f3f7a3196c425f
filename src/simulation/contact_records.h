// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a simulation knows of each point: its entries in the queue, and its overlaps.
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

/// A disc that may come into contact with the one whose record this is.
struct Contact_partner {
  Point_id id;
  Queue_handle event;
};

/// A disc that overlaps, or almost does, or has overlapped until a short time ago.
struct Disc_overlap {
  Point_id id;
  bool passes;   ///< a response has let the two pass: no contact until they have separated
  bool is_edge;  ///< whether there is an edge between the two, if they do overlap now
};

/// The record of a point. Of each pair both points have a record.
struct Contact_record {
  Queue_handle wall_event = no_event;
  Queue_handle vanish_event = no_event;
  std::vector<Contact_partner> partners;
  std::vector<Disc_overlap> overlaps;  ///< all those of the present time, and perhaps others
  std::vector<Point_id> corners;       ///< that the point is linked with (Disc_geometry)
};

/// The records by point id; none if a point has nothing, or has been erased.
///
/// Invariant: what the record of a says of b, that of b says of a. Several threads may call
/// functions for different points, once there is room for them.
class Contact_records {
 public:
  std::size_t size() const { return records_.size(); }
  /// Makes room for the records of points whose ids are less than `ids`.
  void make_room(std::size_t ids) {
    if (ids > records_.size()) records_.resize(ids);
  }

  /// The record of a point; null if there is none.
  Contact_record* find(Point_id id) const {
    return id < records_.size() ? records_[id].get() : nullptr;
  }
  /// The record of a point, which is made if there is none.
  Contact_record& of(Point_id id);
  /// Forgets the record of a point that has been erased.
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
  /// The handle of what a contact or the end of a radius is about.
  Queue_handle event(const Contact_subject& subject) const;
  /// It has another handle from now on.
  void set_event(const Contact_subject& subject, Queue_handle handle);
  /// A contact has come, with this handle.
  void add_event(const Contact_subject& subject, Queue_handle handle);
  /// The entry has left the queue.
  void forget_event(const Contact_subject& subject);
  /// The same of a pair. Returns the handle; no_event if it has none.
  Queue_handle forget_pair(const Edge_ids& pair);
  /// The same in the record of the first point alone.
  Queue_handle forget_partner(Point_id id, Point_id other);

  // ---- overlaps ----

  const std::vector<Disc_overlap>& overlaps(Point_id id) const;
  /// The record of a pair that overlaps; null if there is none.
  const Disc_overlap* find_overlap(const Edge_ids& pair) const;
  /// Makes a record of a pair that overlaps, if there is none. `is_edge` is false too if that is
  /// not known because the two do not overlap.
  void start_overlap(Point_id a, Point_id b, bool is_edge);
  /// Forgets a pair that has a record.
  void forget_overlap(Point_id a, Point_id b);
  /// Whether a response has let two pass that have a record.
  void mark_passing(Point_id a, Point_id b, bool passes) {
    amend_overlap({a, b}, [&](Disc_overlap& overlap) { overlap.passes = passes; });
  }
  /// Whether there is an edge between two that have a record.
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
