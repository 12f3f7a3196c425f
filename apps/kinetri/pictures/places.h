// SPDX-License-Identifier: GPL-3.0-or-later
//
// The positions of points at one time, and of their images in a periodic box.
#ifndef KINETRI_APPS_PLACES_H
#define KINETRI_APPS_PLACES_H

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "kinetri/impl/kinetic/drawn_box_2.h"
#include "kinetri/impl/simulation/playback.h"

namespace kinetri::app {

/// The positions of all points by id at the time of a playback. In a periodic box they are those of
/// the images within the box as it is drawn.
class Places {
 public:
  explicit Places(const Playback& playback);

  std::size_t size() const { return all_.size(); }
  const Recorded_place& operator[](std::size_t id) const { return all_[id]; }
  void set_radius(double radius) {
    for (Recorded_place& place : all_) place.radius = radius;
  }

  /// The periodic box as it is drawn; none in the plane.
  const std::optional<Drawn_box_2>& box() const { return box_; }

  /// What leads from the place of the point `to.id` to the image of it that has the offset
  /// `to.offset` against the point `from`, if that is at its own place here. Zero in the plane.
  Vector_2 shift(Point_id from, const Periodic_image& to) const;
  /// The place of that image.
  Recorded_place image(Point_id from, const Periodic_image& to) const;

  /// What is to be added to the position of the point at any time for the image that is here now.
  Vector_2 move_at(Point_id id, double time) const;
  /// The same of its velocity.
  Vector_2 rate(Point_id id) const;

  /// The vectors by which a figure with these corners is to be moved for images that together cover
  /// in the periodic box what all images of the figure cover there; in the plane only zero. If
  /// there are very many, as just before a box loses its area, only one.
  std::vector<Vector_2> copies(std::span<const Vector_2> corners) const;

  /// The vectors by which the disc about the point is to be moved for its other images that reach
  /// into the periodic box. None in the plane, or if there are very many.
  std::vector<Vector_2> disc_copies(Point_id id) const;

 private:
  std::vector<Recorded_place> all_;
  std::optional<Drawn_box_2> box_;
  std::vector<Drawn_box_2::Image> images_;
  const Periodic_box_2* periodic_box_;
};

}  // namespace kinetri::app

#endif  // KINETRI_APPS_PLACES_H
