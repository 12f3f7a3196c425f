// SPDX-License-Identifier: GPL-3.0-or-later
//
// The picture of a stream at any time: colors at moving points, on their exact Delaunay
// triangulation. Used by encoder and decoder.
#ifndef KINETRI_VIDEO_CODEC_MOVING_PICTURE_H
#define KINETRI_VIDEO_CODEC_MOVING_PICTURE_H

#include <cstdint>
#include <optional>
#include <span>

#include "kinetri/triangulation/field_2.h"
#include "kinetri/triangulation/kinetic_delaunay_triangulation_2.h"
#include "video/formats/frame.h"
#include "video/stream/present_points.h"
#include "video/stream/stream.h"

namespace kinetri::video {

/// The picture as blocks begin and time advances.
class Moving_picture {
 public:
  using Triangulation = Kinetic_delaunay_triangulation_2<>;
  using Time = Algebraic_number;

  explicit Moving_picture(const Stream_header& header);

  /// Begins a segment at the time of the key, after advancing the previous one to its end.
  /// Precondition: as that of Present_points::follow.
  void begin(const Key& key);

  /// Begins a group: erases and inserts points, and sets motions. Advances to the time at which the
  /// group begins. Precondition: the same, and the time is not after that.
  void begin(const Group& group);

  /// Sets the colors of the present group if they were not known at its begin: those of
  /// `group.inserted` and `group.targets`, whose positions must be unchanged. (The triangulation
  /// does not depend on colors.)
  void set_colors(const Group& group);

  /// Advances to the time. Precondition: it is not before the present one, nor after the end of the
  /// group that has begun.
  void advance_to(const Time& time);

  /// Draws the picture at the present time in the format, whose size and chroma format may differ
  /// from those of the stream, except that a stream without color has none. Values are rounded to
  /// the nearest whole number, halves up. Exact: the triangle of each sample. The values are
  /// computed in binary64 arithmetic, with the same bits on every machine.
  void draw(const Video_format& format, Interpolation style, Frame& frame) const;

  /// Precondition: a key has begun.
  const Triangulation& triangulation() const { return *triangulation_; }
  /// @{
  /// Observes the triangulation of the present segment. Precondition: a key has begun.
  void add_observer(Event_observer& observer) { triangulation_->add_observer(observer); }
  void remove_observer(Event_observer& observer) { triangulation_->remove_observer(observer); }
  /// @}
  /// The time at which the present group, or key, ends.
  std::uint32_t end() const { return end_; }
  /// The number of events of the triangulation, mostly flips; changes of points are not counted.
  std::uint64_t events() const { return events_; }

 private:
  Linear_value color(std::int16_t from, std::int16_t to, std::uint32_t frames) const;
  void set_colors(Point_id id, const Colors& from, const Colors& to, std::uint32_t frames);
  Vector_2 position(const Place& place) const;
  void draw_plane(const Kinetic_field_2<>& field, const Video_format& format, std::size_t plane,
                  Interpolation style, Frame& frame) const;

  Stream_header header_;
  Present_points points_;
  std::optional<Triangulation> triangulation_;
  std::optional<Kinetic_field_2<>> brightness_;  // one channel
  std::optional<Kinetic_field_2<>> color_;       // two channels; none without color
  std::vector<Present_points::Point> at_begin_;  // of the present group
  std::uint32_t begin_ = 0;
  std::uint32_t end_ = 0;
  std::uint64_t events_ = 0;
};

}  // namespace kinetri::video

#endif  // KINETRI_VIDEO_CODEC_MOVING_PICTURE_H
