// SPDX-License-Identifier: GPL-3.0-or-later
//
// The content of a .kvd stream as values; docs/VIDEO.md describes the bytes.
//
// Time is counted in frames of the source: frame n is at time n. A video is a sequence of segments.
// Each begins with a key: points with places and colors. Then come groups of frames, one after the
// other. At the beginning of a group points are erased and inserted; within it each point moves on
// a straight line at constant speed, and its color changes linearly. Between the last group of a
// segment and the next key the picture stays as it is. The triangulation of the points is not
// stored: it is the Delaunay triangulation, at every time.
//
// Points may be outside of the picture, on the stage, which is larger by a margin on each side, so
// that they enter and leave without a gap at the border.
//
// All numbers are whole: a place is in units of 2^-place_bits of a pixel, a color in units of
// color_step / 8. A group has a power of two of frames, so that the velocities, and the places at
// the times of its frames, are binary64 numbers, and nothing is rounded.
#ifndef KINETRI_VIDEO_STREAM_STREAM_H
#define KINETRI_VIDEO_STREAM_STREAM_H

#include <array>
#include <compare>
#include <cstdint>
#include <variant>
#include <vector>

#include "kinetri/base/ids.h"
#include "video/formats/frame.h"

namespace kinetri::video {

/// The greatest number of frames of a group.
inline constexpr std::uint32_t most_group_frames = 1024;
/// The greatest number of points of a segment at one time.
inline constexpr std::uint32_t most_points = 1 << 24;
inline constexpr unsigned most_place_bits = 8;
/// The first points of each key are the corners of the stage, clockwise from the upper left one;
/// they never move and are never erased, so that the triangles always cover the picture.
inline constexpr std::size_t number_of_corners = 4;

/// A place, in units of the stream.
struct Place {
  std::int32_t x = 0;
  std::int32_t y = 0;

  friend auto operator<=>(const Place&, const Place&) = default;
};

/// The header of a stream.
struct Stream_header {
  Video_format format;      ///< of the source
  unsigned place_bits = 4;  ///< places are multiples of 2^-place_bits pixels
  unsigned color_step = 8;  ///< colors are multiples of color_step / 8; 1 to 255
  unsigned margin = 0;      ///< of the stage, in pixels; at most 255

  friend bool operator==(const Stream_header&, const Stream_header&) = default;

  /// @{
  /// The sides of the stage.
  std::int32_t left() const { return -static_cast<std::int32_t>(margin << place_bits); }
  std::int32_t top() const { return left(); }
  std::int32_t right() const {
    return static_cast<std::int32_t>((format.width + margin) << place_bits);
  }
  std::int32_t bottom() const {
    return static_cast<std::int32_t>((format.height + margin) << place_bits);
  }
  /// @}
  /// The corners of the stage, in order.
  std::array<Place, number_of_corners> corners() const {
    return {{{left(), top()}, {right(), top()}, {right(), bottom()}, {left(), bottom()}}};
  }
};

/// Y, Cb and Cr, in units of the stream; a stream without color has 0 for the others.
using Colors = std::array<std::int16_t, 3>;

/// A point at one time.
struct Node {
  Place place;
  Colors colors = {};

  friend bool operator==(const Node&, const Node&) = default;
};

/// A segment begins. Its points are numbered from 0.
struct Key {
  std::uint32_t frame = 0;  ///< at which time
  std::vector<Node> points;

  friend bool operator==(const Key&, const Key&) = default;
};

/// A group of frames. First points are erased, then points are inserted, and get the next numbers;
/// after that no two are at the same position.
struct Group {
  std::uint32_t first = 0;       ///< the time at which it begins
  std::uint32_t frames = 1;      ///< its length, a power of two
  std::vector<Point_id> erased;  ///< the numbers of erased points, ascending
  std::vector<Node> inserted;    ///< the new points at `first`
  std::vector<Node> targets;     ///< all points by number, at the end

  std::uint32_t last() const { return first + frames; }

  friend bool operator==(const Group&, const Group&) = default;
};

/// The end of the stream.
struct End {
  std::uint32_t frames = 0;  ///< of the source: the picture ends at this time

  friend bool operator==(const End&, const End&) = default;
};

using Block = std::variant<Key, Group, End>;

}  // namespace kinetri::video

#endif  // KINETRI_VIDEO_STREAM_STREAM_H
