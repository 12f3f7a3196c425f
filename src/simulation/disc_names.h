// SPDX-License-Identifier: GPL-3.0-or-later
//
// Names of discs and of pairs of discs, in the plane and in a periodic box.
//
// In the plane a disc is named by its id, and a pair by two ids (Edge_ids). In a periodic box a
// disc is named by the image that another disc sees (Periodic_image), whose offset is against the
// position of that other disc as given; and a pair by a Periodic_edge. The functions have the same
// names for both, so that the parts of a simulation are written once.
#ifndef KINETRI_SRC_SIMULATION_DISC_NAMES_H
#define KINETRI_SRC_SIMULATION_DISC_NAMES_H

#include "kinetri/base/ids.h"
#include "kinetri/impl/events/basic_event.h"
#include "kinetri/impl/triangulation/edge_changes.h"
#include "triangulation/whole_vectors.h"

namespace kinetri::detail {

/// @{
/// Another disc as `between` sees it, for the one that sees `between`.
inline Point_id beyond(Point_id /*between*/, Point_id disc) {
  return disc;
}
inline Periodic_image beyond(const Periodic_image& between, const Periodic_image& disc) {
  return {disc.id, sum(between.offset, disc.offset)};
}
/// @}

/// @{
/// A disc as `from` sees it, if one disc sees both.
inline Point_id seen_from(Point_id /*from*/, Point_id disc) {
  return disc;
}
inline Periodic_image seen_from(const Periodic_image& from, const Periodic_image& disc) {
  return {disc.id, sum(disc.offset, reversed(from.offset))};
}
/// @}

/// @{
/// The disc that sees `from`, as `from` sees it.
inline Point_id back_from(Point_id /*from*/, Point_id id) {
  return id;
}
inline Periodic_image back_from(const Periodic_image& from, Point_id id) {
  return {id, reversed(from.offset)};
}
/// @}

/// @{
/// Whether the disc with the id is the first one of the pair with the disc that it sees; false for
/// itself.
inline bool is_first(Point_id id, Point_id disc) {
  return id < disc;
}
inline bool is_first(Point_id id, const Periodic_image& disc) {
  return id < disc.id || (id == disc.id && Lattice_offset_2() < disc.offset);
}
/// @}

/// @{
/// The pair of a disc and one that it sees, in this order.
inline Edge_ids pair_from(Point_id id, Point_id disc) {
  return {id, disc};
}
inline Periodic_edge pair_from(Point_id id, const Periodic_image& disc) {
  return {{id, disc.id}, disc.offset};
}
/// @}

/// The same in the order of pairs.
template <class Disc>
auto pair_of(Point_id id, const Disc& disc) {
  if (is_first(id, disc)) return pair_from(id, disc);
  return pair_from(id_of(disc), back_from(disc, id));
}

/// @{
/// The second disc of a pair, as the first one sees it.
inline Point_id second_of(const Edge_ids& pair) {
  return pair[1];
}
inline Periodic_image second_of(const Periodic_edge& pair) {
  return {pair.ids[1], pair.offset};
}
/// @}

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_SIMULATION_DISC_NAMES_H
