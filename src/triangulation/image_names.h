// SPDX-License-Identifier: GPL-3.0-or-later
//
// Names of points, or of discs about them, and of pairs of points, in the plane and in a periodic
// box.
//
// In the plane a point is named by its id, and a pair by two ids (Edge_ids). In a periodic box a
// point is named by the image that another point sees (Periodic_image), whose offset is against the
// position of that other point as given; and a pair by a Periodic_edge. The functions have the same
// names for both, so that simulations and observers are written once. Those that add offsets throw
// Periodic_box_error if the sum is 2^31 or more.
#ifndef KINETRI_SRC_TRIANGULATION_IMAGE_NAMES_H
#define KINETRI_SRC_TRIANGULATION_IMAGE_NAMES_H

#include "kinetri/base/ids.h"
#include "kinetri/impl/events/basic_event.h"
#include "kinetri/impl/triangulation/edge_changes.h"
#include "triangulation/whole_vectors.h"

namespace kinetri::detail {

/// @{
/// Another point, as `between` sees it, for the one that sees `between`.
inline Point_id beyond(Point_id /*between*/, Point_id point) {
  return point;
}
inline Periodic_image beyond(const Periodic_image& between, const Periodic_image& point) {
  return {point.id, sum(between.offset, point.offset)};
}
/// @}

/// @{
/// A point, as `from` sees it, if one point sees both.
inline Point_id seen_from(Point_id /*from*/, Point_id point) {
  return point;
}
inline Periodic_image seen_from(const Periodic_image& from, const Periodic_image& point) {
  return {point.id, sum(point.offset, reversed(from.offset))};
}
/// @}

/// @{
/// The point that sees `from`, as `from` sees it.
inline Point_id back_from(Point_id /*from*/, Point_id id) {
  return id;
}
inline Periodic_image back_from(const Periodic_image& from, Point_id id) {
  return {id, reversed(from.offset)};
}
/// @}

/// @{
/// Whether the point with the id is the first one of the pair with the point that it sees; false
/// for itself.
inline bool is_first(Point_id id, Point_id point) {
  return id < point;
}
inline bool is_first(Point_id id, const Periodic_image& point) {
  return id < point.id || (id == point.id && Lattice_offset_2() < point.offset);
}
/// @}

/// @{
/// The pair of a point and one that it sees, in this order.
inline Edge_ids pair_from(Point_id id, Point_id point) {
  return {id, point};
}
inline Periodic_edge pair_from(Point_id id, const Periodic_image& point) {
  return {{id, point.id}, point.offset};
}
/// @}

/// The same in the order of pairs.
template <class Name>
auto pair_of(Point_id id, const Name& point) {
  if (is_first(id, point)) return pair_from(id, point);
  return pair_from(id_of(point), back_from(point, id));
}

/// @{
/// The second point of a pair, as the first one sees it.
inline Point_id second_of(const Edge_ids& pair) {
  return pair[1];
}
inline Periodic_image second_of(const Periodic_edge& pair) {
  return {pair.ids[1], pair.offset};
}
/// @}

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_TRIANGULATION_IMAGE_NAMES_H
