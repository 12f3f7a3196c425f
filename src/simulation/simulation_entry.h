// SPDX-License-Identifier: GPL-3.0-or-later
//
// The entries of the queue of a simulation.
#ifndef KINETRI_SRC_SIMULATION_SIMULATION_ENTRY_H
#define KINETRI_SRC_SIMULATION_SIMULATION_ENTRY_H

#include <cstdint>

#include "kinetri/base/ids.h"
#include "kinetri/impl/events/event_scheduler.h"

namespace kinetri::detail {

/// In the order of execution at one time. Contacts of discs that are noted come after the others.
enum class Contact_kind : std::uint8_t { wall, collision, erase, trajectory, insert, vanish };

inline bool is_contact(Contact_kind kind) {
  return kind <= Contact_kind::collision;
}
inline bool is_change(Contact_kind kind) {
  return !is_contact(kind) && kind != Contact_kind::vanish;
}

/// The subject of an entry.
struct Contact_subject {
  Contact_kind kind = Contact_kind::wall;
  Point_id point_a = no_point;
  Point_id point_b = no_point;
};

/// A contact, or a time until which there certainly is none; a scheduled change; or the time at
/// which the radius of a disc reaches zero.
struct Contact_entry : Scheduled {
  Contact_kind kind = Contact_kind::wall;
  bool is_event = false;
  bool is_edge = false;   ///< whether there is an edge between two discs, if they ever touch
  bool is_noted = false;  ///< whether the overlap that begins with the contact is recorded
  Point_id point_a = no_point;
  Point_id point_b = no_point;  ///< of a wall, its index; of a change, its number

  /// The content of an entry besides its subject and times.
  struct Kept {
    bool is_event = false;  ///< a contact, not a time to check again
    bool is_edge = false;   ///< as the entry has it
    std::uint8_t wall = 0;  ///< the index of a wall; 0 for a contact of discs
  };

  Contact_entry() = default;
  /// The entry of a subject, without the exact time.
  Contact_entry(const Contact_subject& subject, const Double_interval& times, const Kept& kept)
      : Scheduled{times},
        kind(subject.kind),
        is_event(kept.is_event),
        is_edge(kept.is_edge),
        point_a(subject.point_a),
        point_b(subject.kind == Contact_kind::wall ? kept.wall : subject.point_b) {}

  Kept kept() const { return {is_event, is_edge, static_cast<std::uint8_t>(point_b & 3U)}; }
  Contact_subject subject() const { return {kind, point_a, point_b}; }
};

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_SIMULATION_SIMULATION_ENTRY_H
