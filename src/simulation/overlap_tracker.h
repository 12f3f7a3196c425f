// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which discs overlap, and which pairs are watched for contacts.
//
// A pair (p, q), p < q, is watched if pq is an edge, or if there is an edge wq to a point w whose
// disc overlaps those of p and q. That suffices: let p and q come into contact. The points in the
// closed disc with diameter pq are connected by edges inside it, so there is a path from p to q; if
// it is not the edge pq, the last point before q is such a point w.
//
// Discs of any radii: (p, q) is watched if pq is an edge of the regular triangulation, or if a disc
// overlaps both (docs/MATH.md, section 8). Pairs that overlap are watched too, since they need
// neither a third disc nor an edge; so are links (Disc_geometry), which count as edges.
//
// Overlaps begin with a contact, or with a new motion of a disc. Let some discs have new motions,
// let all overlaps of the others be recorded, and let p, with a new motion, and q, without one,
// overlap at the position x. Without the discs with new motions x would be in the power cell of a
// disc v: its power there is at most that of q, so not positive. So v is q or overlaps it, and it
// overlaps p. There are three cases (docs/MATH.md, section 8):
//
// - x is still in the cell of v, which meets p;
// - v has a smaller cell: its neighbors include a disc with a new motion;
// - v has none: the triangle that hides it is new, and so has a corner with a new motion.
//
// All such v are found (Disc_geometry::discs_about); q is one of them, or overlaps one of them. For
// radii 0 see find_overlaps_of_seeds and let_pass.
//
// In a periodic box all of that is said of images (docs/MATH.md, section 18): p < q means that p is
// the first disc of the pair.
#ifndef KINETRI_SRC_SIMULATION_OVERLAP_TRACKER_H
#define KINETRI_SRC_SIMULATION_OVERLAP_TRACKER_H

#include <span>
#include <vector>

#include "kinetri/impl/triangulation/event_reporter.h"
#include "simulation/contact_schedule.h"

namespace kinetri::detail {

/// Follows the edges and the motions of points.
///
/// Invariant, between two events: all present overlaps are recorded; each watched pair that will
/// come into contact has an entry. Without a response nothing is watched.
template <class Traits>
class Simulation_types<Traits>::Overlap_tracker {
 public:
  using Points = std::span<const Point_id>;
  using Vectors = typename Disc_geometry::Vectors;

  /// The others must outlive this object.
  Overlap_tracker(const Disc_geometry& geometry, Contact_records& records,
                  Contact_schedule& schedule)
      : geometry_(geometry), setup_(geometry.setup()), records_(records), schedule_(schedule) {}

  // ---- all points ----

  /// Finds all overlaps of the present time.
  void find_all();
  /// Schedules the contacts of all watched pairs, with certificates computed on several threads.
  /// Precondition: none is scheduled, and all overlaps are recorded.
  void schedule_all_pairs();

  // ---- points that change ----

  /// Ends the passes of a point whose discs have separated: called before the point gets another
  /// motion, with which it may come into contact again.
  void end_passes(Point_id id);
  /// Updates the overlaps and schedules the pairs of points that have got other motions or have
  /// been inserted or erased. The points are sorted and have no entries of pairs.
  void schedule_pairs(Points points);
  /// Follows added and removed edges, and links, at the present time; except those of `changing`
  /// points, whose pairs are scheduled later.
  void follow(const Edge_trail& trail, Points changing);
  /// Updates the links of a point.
  void follow_links(Point_id id, Points changing);

  // ---- contacts ----

  /// Two discs in contact overlap from now on, and have no contact until they have separated.
  void let_pass(Point_id a, const Disc& b, bool is_edge);
  /// Records the overlap of a contact of the present time that has left the queue, and returns the
  /// contact to the queue, behind those that are not noted. Returns false, and does nothing, if no
  /// other contact happens now and the two overlap no others. An overlap that begins with a contact
  /// may show further contacts of the same time: so all of them are noted before the first one is
  /// executed (docs/MATH.md, section 8).
  bool note_contact(const Contact_entry& contact);
  /// Records that a pair overlaps, and watches the pairs of the two with others.
  void start_overlap(Point_id a, const Disc& b, bool is_edge);
  /// The same for a pair that a response has let pass.
  void start_pass(Point_id a, const Disc& b, bool is_edge);
  /// Removes a recorded pair. The points need not exist any more.
  void end_overlap(Point_id a, const Disc& b);

  // ---- for audits ----

  /// Whether a pair that has an entry is still to be watched.
  bool is_watched(const Pair& pair) const;
  /// Calls `function` with the second disc of each pair of which `first` is the first one, and that
  /// is watched because of a disc that overlaps both; perhaps more than once. counts(a, b) says
  /// whether a recorded overlap counts.
  template <class Counts, class Function>
  void for_each_pair_of(Point_id first, const Counts& counts, Function function) const;

 private:
  bool is_overlapped(const Pair& pair) const;
  void watch(const Pair& pair, bool is_edge);
  void watch_beside(Point_id a, const Disc& b, bool is_edge, Points changing = {});
  void unwatch(const Pair& pair);
  void leave_edge(const Pair& edge);
  void follow_edge(const Pair& edge, Points changing);
  static bool is_changing(const Pair& pair, Points changing);
  void keep_links();
  void schedule_edges(Point_id id, Points points);
  void schedule_pairs_beside(Point_id id);
  template <class Function>
  void for_each_pair_beside(Point_id a, const Disc& b, bool is_edge, Function function) const;
  template <class Function>
  void for_each_pair_over(const Pair& edge, Function function) const;
  bool is_passing(Point_id a, const Disc& b);
  void update_overlaps(Points points);
  void drop_overlaps(Point_id id);
  void find_new_overlaps_of(Point_id id);
  void find_new_overlaps(Points points);
  void find_overlaps_of_seeds(Points points, const Vectors& vectors);
  void examine(Point_id a, Point_id b, const Vectors& vectors);
  void examine(Point_id a, const Disc& b);

  const Disc_geometry& geometry_;
  const Simulation_setup& setup_;
  Contact_records& records_;
  Contact_schedule& schedule_;
  std::vector<Point_id> seeds_;  // discs that may have the radius 0 and grow
};

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_SIMULATION_OVERLAP_TRACKER_H
