// SPDX-License-Identifier: GPL-3.0-or-later
//
// The picture that a stream describes, at any time: colors at points that move, on their Delaunay
// triangulation, which is exact at that time. Encoder and decoder both have one.
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

/// The picture while blocks are followed and time goes on.
class Moving_picture {
 public:
  using Triangulation = Kinetic_delaunay_triangulation_2<>;
  using Time = Algebraic_number;

  explicit Moving_picture(const Stream_header& header);

  /// A segment begins at the time of the key; the one before it goes to its end first.
  /// Precondition: as that of Present_points::follow.
  void begin(const Key& key);

  /// Points come and go, and get their motions. The time is then that at which the group begins.
  /// Precondition: the same, and the time is not after that.
  void begin(const Group& group);

  /// Colors of the present group, when these are found only now: those of `group.inserted` and
  /// `group.targets`, which have the places of the group that has begun. (The triangulation does
  /// not depend on them.)
  void set_colors(const Group& group);

  /// Goes to the time. Precondition: it is not before the present one, nor after the end of the
  /// group that has begun.
  void advance_to(const Time& time);

  /// Draws the picture at the present time in the format, whose size may be another one than that
  /// of the stream; the kind of color too, except that a stream without color has none. Values are
  /// rounded to the nearest whole number, halves up.
  /// Exact: the triangle of each sample. The values are computed in binary64 arithmetic, with the
  /// same bits on every machine.
  void draw(const Video_format& format, Interpolation style, Frame& frame) const;

  /// Before the first key there is none.
  const Triangulation& triangulation() const { return *triangulation_; }
  /// @{
  /// Of the triangulation of the present segment, from now on. Precondition: a key has begun.
  void add_observer(Event_observer& observer) { triangulation_->add_observer(observer); }
  void remove_observer(Event_observer& observer) { triangulation_->remove_observer(observer); }
  /// @}
  /// The time at which the present group, or key, ends.
  std::uint32_t end() const { return end_; }
  /// How many events of the triangulation there have been: edges that were flipped, for the most
  /// part, not points that turn, come or go.
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
