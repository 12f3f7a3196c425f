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
template <class Disc>
struct Contact_partner {
  Disc disc;  ///< as that of the record sees it
  Queue_handle event;
};

/// A disc that overlaps, almost overlaps, or has overlapped until recently.
template <class Disc>
struct Basic_disc_overlap {
  Disc disc;     ///< as that of the record sees it
  bool passes;   ///< whether a response has let the two pass: no contact until they separate
  bool is_edge;  ///< whether there is an edge between the two, if they do overlap now
};

/// The record of a point. Pairs are in the records of both points; that of a point with an image of
/// itself is twice in its record, with either offset.
template <class Disc>
struct Basic_contact_record {
  Queue_handle wall_event = no_event;
  Queue_handle vanish_event = no_event;
  std::vector<Contact_partner<Disc>> partners;
  std::vector<Basic_disc_overlap<Disc>> overlaps;  ///< all present ones, and perhaps others
  std::vector<Disc> corners;  ///< that the point is linked with (Disc_geometry)
};

/// The records by point id. A point without entries and overlaps need not have one.
///
/// Invariant: pairs are in both records, with the same values. Several threads may call functions
/// for different points after make_room. A disc is named by `Disc`, a pair by `Pair`
/// (image_names.h); the discs of a pair may be in any order.
template <class Disc>
class Basic_contact_records {
 public:
  using Contact_subject = Basic_contact_subject<Disc>;
  using Contact_record = Basic_contact_record<Disc>;
  using Disc_overlap = Basic_disc_overlap<Disc>;
  using Pair = decltype(pair_from(Point_id(), Disc()));

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
  Queue_handle pair_event(const Pair& pair) const;
  /// The handle of the entry of a subject; no_event if there is none.
  Queue_handle event(const Contact_subject& subject) const;
  /// Changes the handle of an entry.
  void set_event(const Contact_subject& subject, Queue_handle handle);
  /// Adds the handle of a new entry.
  void add_event(const Contact_subject& subject, Queue_handle handle);
  /// Removes the handle of an entry.
  void forget_event(const Contact_subject& subject);
  /// The same of a pair. Returns the handle; no_event if it has none.
  Queue_handle forget_pair(const Pair& pair);
  /// The same in the record of the first point only.
  Queue_handle forget_partner(Point_id id, const Disc& other);

  // ---- overlaps ----

  const std::vector<Disc_overlap>& overlaps(Point_id id) const;
  /// The record of a pair that overlaps; null if there is none.
  const Disc_overlap* find_overlap(const Pair& pair) const;
  /// Records that a pair overlaps, if it is not recorded. `is_edge` may be false if the two only
  /// almost overlap.
  void start_overlap(Point_id a, const Disc& b, bool is_edge);
  /// Removes a recorded pair.
  void forget_overlap(Point_id a, const Disc& b);
  /// Sets whether a response has let a recorded pair pass.
  void mark_passing(Point_id a, const Disc& b, bool passes) {
    amend_overlap(pair_from(a, b), [&](Disc_overlap& overlap) { overlap.passes = passes; });
  }
  /// Sets whether a recorded pair has an edge.
  void mark_edge(const Pair& pair, bool is_edge) {
    amend_overlap(pair, [&](Disc_overlap& overlap) { overlap.is_edge = is_edge; });
  }

 private:
  template <class Amend>
  void amend_overlap(const Pair& pair, const Amend& amend) {
    const Point_id a = ids_of(pair)[0];
    const Disc b = second_of(pair);
    amend(*std::ranges::find(of(a).overlaps, b, &Disc_overlap::disc));
    amend(*std::ranges::find(of(id_of(b)).overlaps, back_from(b, a), &Disc_overlap::disc));
  }

  std::vector<std::unique_ptr<Contact_record>> records_;
};

extern template class Basic_contact_records<Point_id>;
extern template class Basic_contact_records<Periodic_image>;

using Contact_record = Basic_contact_record<Point_id>;    ///< in the plane
using Contact_records = Basic_contact_records<Point_id>;  ///< in the plane
using Disc_overlap = Basic_disc_overlap<Point_id>;        ///< in the plane

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_SIMULATION_CONTACT_RECORDS_H
