// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which discs overlap, and which pairs are watched for contacts.
//
// A pair (p, q), p < q, is watched if pq is an edge, or if there is an edge wq to a point w whose
// disc overlaps those of p and q. Let p and q come into contact. The points in the closed disc with
// diameter pq are connected by edges inside of it, so there is a path from p to q; if that is not
// the edge pq, then the last point before q is such a point w.
//
// Discs of any radii: pq is an edge of the regular triangulation, or there is a disc that overlaps
// both, whether it has edges or not (docs/MATH.md, section 8). Two that overlap each other are
// watched too, as no other one need overlap them, and they need have no edge; and a hidden point of
// radius 0 and the corners of the triangle that hides it (Disc_geometry), which count as edges.
//
// Overlaps begin with a contact, or with a new motion of a disc. Let some discs have new motions,
// let all overlaps of the others be known, and let p, which has a new motion, and q, which has
// none, overlap at the place x. Without the discs of new motions x would be in the power cell of a
// disc v: its power there is that of q at most, and so not positive. So v is q or overlaps it, and
// it overlaps p. Now there are three cases (docs/MATH.md, section 8):
//
// - x is in the cell of v still: v is an owner of a place in p;
// - v has a cell, but one that has become smaller: its neighbors include a disc with a new motion;
// - v has none: the triangle that hides it has not been there before, and so has a corner that is a
//   disc with a new motion.
//
// All such v are found (Disc_geometry::discs_about); q is one of them, or overlaps one of them.
// Radii that are 0 need more: see find_overlaps_of_seeds and let_pass.
#ifndef KINETRI_SRC_SIMULATION_OVERLAP_TRACKER_H
#define KINETRI_SRC_SIMULATION_OVERLAP_TRACKER_H

#include <span>
#include <vector>

#include "kinetri/impl/triangulation/event_reporter.h"
#include "simulation/contact_schedule.h"

namespace kinetri::detail {

/// Follows the edges and the motions of points.
///
/// Invariant, between two events: the records have all overlaps of the present time; each pair that
/// is watched and will come into contact has an entry. Without a response nothing is watched.
template <class Traits>
class Simulation_types<Traits>::Overlap_tracker {
 public:
  using Points = std::span<const Point_id>;

  /// The others must outlive this object.
  Overlap_tracker(const Disc_geometry& geometry, Contact_records& records,
                  Contact_schedule& schedule)
      : geometry_(geometry), setup_(geometry.setup()), records_(records), schedule_(schedule) {}

  // ---- all points ----

  /// Finds all overlaps of the present time.
  void find_all();
  /// Schedules the contacts of all pairs that are watched. Several threads make the certificates.
  /// Precondition: none is scheduled, and all overlaps are known.
  void schedule_all_pairs();

  // ---- points that change ----

  /// Ends the passes of a point that are over, because the discs have separated: to be called
  /// before the point gets another motion, with which it may come into contact again.
  void end_passes(Point_id id);
  /// Brings overlaps up to date, and schedules the pairs of points that have got other motions,
  /// come or gone, and have no entries of pairs. They are sorted.
  void schedule_pairs(Points points);
  /// Follows edges that have come and gone, and links, at the present time; but for those of points
  /// that are `changing`, whose pairs are scheduled later.
  void follow(const Edge_trail& trail, Points changing);
  /// Brings the links of a point up to date.
  void follow_links(Point_id id, Points changing);

  // ---- contacts ----

  /// Two discs in contact overlap from now on, and have no contact until they have separated.
  void let_pass(Point_id a, Point_id b, bool is_edge);
  /// All contacts of one time are found before the first of them is executed: if discs overlap
  /// because of a contact, there may be others that are watched because of that overlap
  /// (docs/MATH.md, section 8). So the overlap that begins with a contact of now, which has left
  /// the queue, is noted, and the contact goes back behind those that are not noted. Returns false
  /// if there is nothing to note: no other contact is now, and the two overlap no others.
  bool note_contact(const Contact_entry& contact);
  /// Makes a record of a pair that overlaps, and watches the pairs beside it.
  void start_overlap(Point_id a, Point_id b, bool is_edge);
  /// The same of two that a response has let pass.
  void start_pass(Point_id a, Point_id b, bool is_edge);
  /// Forgets a pair that has a record. The points need not be there any more.
  void end_overlap(Point_id a, Point_id b);

  // ---- for audits ----

  /// Whether there still is a reason to watch a pair that has an entry.
  bool is_watched(const Edge_ids& pair) const;
  /// Calls `function` with the greater point of each pair that is watched because of a disc that
  /// overlaps both, and of which `first` is the smaller one; perhaps more than once. counts(a, b)
  /// says whether a record of an overlap counts.
  template <class Counts, class Function>
  void for_each_pair_of(Point_id first, const Counts& counts, Function function) const;

 private:
  bool is_overlapped(const Edge_ids& pair) const;
  void watch(const Edge_ids& pair, bool is_edge);
  void watch_beside(Point_id a, Point_id b, bool is_edge, Points changing = {});
  void unwatch(const Edge_ids& pair);
  void leave_edge(const Edge_ids& edge);
  void follow_edge(const Edge_ids& edge, Points changing);
  static bool is_changing(const Edge_ids& pair, Points changing);
  void keep_links();
  void schedule_edges(Point_id id, Points points);
  void schedule_pairs_beside(Point_id id);
  template <class Function>
  void for_each_pair_beside(Point_id a, Point_id b, bool is_edge, Function function) const;
  template <class Function>
  void for_each_pair_over(const Edge_ids& edge, Function function) const;
  bool is_passing(Point_id a, Point_id b);
  void update_overlaps(Points points);
  void drop_overlaps(Point_id id);
  void find_new_overlaps_of(Point_id id);
  void find_new_overlaps(Points points);
  void find_overlaps_of_seeds(Points points);
  void examine(Point_id a, Point_id b);

  const Disc_geometry& geometry_;
  const Simulation_setup& setup_;
  Contact_records& records_;
  Contact_schedule& schedule_;
  std::vector<Point_id> seeds_;  // discs that may grow from 0 at the present time
};

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_SIMULATION_OVERLAP_TRACKER_H
