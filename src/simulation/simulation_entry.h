// SPDX-License-Identifier: GPL-3.0-or-later
//
// The entries of the queue of a simulation.
#ifndef KINETRI_SRC_SIMULATION_SIMULATION_ENTRY_H
#define KINETRI_SRC_SIMULATION_SIMULATION_ENTRY_H

#include <cstdint>
#include <type_traits>

#include "kinetri/base/ids.h"
#include "kinetri/impl/events/event_scheduler.h"
#include "triangulation/image_names.h"

namespace kinetri::detail {

/// In the order of execution at one time. Of collisions, those that are noted come last.
enum class Contact_kind : std::uint8_t { wall, collision, erase, trajectory, insert, vanish };

inline bool is_contact(Contact_kind kind) {
  return kind <= Contact_kind::collision;
}
inline bool is_change(Contact_kind kind) {
  return !is_contact(kind) && kind != Contact_kind::vanish;
}

/// In place of an offset, in the plane.
struct No_offset {
  friend bool operator<(const No_offset&, const No_offset&) { return false; }
};

/// The subject of an entry. A disc is named by `Disc` (image_names.h).
template <class Disc>
struct Basic_contact_subject {
  using Offset =
      std::conditional_t<std::is_same_v<Disc, Periodic_image>, Lattice_offset_2, No_offset>;

  Contact_kind kind = Contact_kind::wall;
  Point_id point_a = no_point;
  Point_id point_b = no_point;
  [[no_unique_address]] Offset offset = {};  ///< of point_b against point_a

  /// The second disc of a contact, as the first one sees it.
  Disc disc_b() const {
    if constexpr (std::is_same_v<Disc, Periodic_image>) {
      return {point_b, offset};
    } else {
      return point_b;
    }
  }
};

/// A contact, or a time until which there certainly is none; a scheduled change; or the time at
/// which the radius of a disc reaches zero.
template <class Disc>
struct Basic_contact_entry : Scheduled {
  using Subject = Basic_contact_subject<Disc>;

  Contact_kind kind = Contact_kind::wall;
  bool is_event = false;
  bool is_edge = false;   ///< whether there is an edge between two discs, if they ever touch
  bool is_noted = false;  ///< whether the overlap that begins with the contact is recorded
  Point_id point_a = no_point;
  Point_id point_b = no_point;  ///< of a wall, its index; of a change, its number
  [[no_unique_address]] typename Subject::Offset offset = {};  ///< of point_b against point_a

  /// The content of an entry besides its subject and times.
  struct Kept {
    bool is_event = false;  ///< a contact, not a time to check again
    bool is_edge = false;   ///< as the entry has it
    std::uint8_t wall = 0;  ///< the index of a wall; 0 for a contact of discs
  };

  Basic_contact_entry() = default;
  /// The entry of a subject, without the exact time.
  Basic_contact_entry(const Subject& subject, const Double_interval& times, const Kept& kept)
      : Scheduled{times},
        kind(subject.kind),
        is_event(kept.is_event),
        is_edge(kept.is_edge),
        point_a(subject.point_a),
        point_b(subject.kind == Contact_kind::wall ? kept.wall : subject.point_b),
        offset(subject.offset) {}

  Kept kept() const { return {is_event, is_edge, static_cast<std::uint8_t>(point_b & 3U)}; }
  Subject subject() const { return {kind, point_a, point_b, offset}; }

  /// Makes this the entry of the contact of a pair.
  void set_pair(const Edge_ids& pair) {
    point_a = pair[0];
    point_b = pair[1];
  }
  void set_pair(const Periodic_edge& pair) {
    point_a = pair.ids[0];
    point_b = pair.ids[1];
    offset = pair.offset;
  }
  /// The second disc of a contact, as the first one sees it.
  Disc disc_b() const { return subject().disc_b(); }
  /// The two discs of a contact.
  auto pair() const { return pair_from(point_a, disc_b()); }
};

using Contact_subject = Basic_contact_subject<Point_id>;  ///< in the plane
using Contact_entry = Basic_contact_entry<Point_id>;      ///< in the plane

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_SIMULATION_SIMULATION_ENTRY_H
