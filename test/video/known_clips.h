// SPDX-License-Identifier: GPL-3.0-or-later
//
// Clips of which it is known where each place of the picture goes.
#ifndef KINETRI_TEST_VIDEO_KNOWN_CLIPS_H
#define KINETRI_TEST_VIDEO_KNOWN_CLIPS_H

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "video/clips.h"
#include "video/codec/placement.h"
#include "video/stream/present_points.h"

namespace kinetri::video::test {

/// A scene, and where what it shows goes.
struct Known_clip {
  std::string name;
  Scene scene;
  /// Where that is at time t1 which is at the place at time t0; none if it is not seen then, or if
  /// that is not one place.
  std::function<std::optional<Vector_2>(const Vector_2& place, double t0, double t1)> moved;
};

namespace detail {

inline Vector_2 rotated(const Vector_2& v, double angle) {
  return {std::cos(angle) * v.x - std::sin(angle) * v.y,
          std::sin(angle) * v.x + std::cos(angle) * v.y};
}

inline Known_clip translation() {
  return {
      "translation",
      [texture = Texture(1)](double x, double y, double t) { return texture(x - 2.5 * t, y - t); },
      [](const Vector_2& p, double t0, double t1) -> std::optional<Vector_2> {
        return Vector_2{p.x + 2.5 * (t1 - t0), p.y + (t1 - t0)};
      }};
}

/// A hundredth of a radian a frame around a center that moves.
inline Known_clip rotation(double width, double height) {
  const auto from_center = [=](const Vector_2& p, double t) {
    return Vector_2{p.x - width / 2 - 0.8 * t, p.y - height / 2 - 0.4 * t};
  };
  return {"rotation",
          [=, texture = Texture(2)](double x, double y, double t) {
            const Vector_2 p = rotated(from_center({x, y}, t), -0.01 * t);
            return texture(p.x, p.y);
          },
          [=](const Vector_2& p, double t0, double t1) -> std::optional<Vector_2> {
            const Vector_2 q = rotated(from_center(p, t0), 0.01 * (t1 - t0));
            return Vector_2{q.x + width / 2 + 0.8 * t1, q.y + height / 2 + 0.4 * t1};
          }};
}

/// A disc with a texture crosses another texture, which goes the other way.
inline Known_clip layers(double width, double height) {
  constexpr double seam = 8;  // in which a window of the flow sees both
  const double radius = std::min(width, height) / 4;
  const auto from_disc = [=](const Vector_2& p, double t) {
    return std::hypot(p.x - width / 3 - 1.5 * t, p.y - height / 2 - 0.5 * t);
  };
  return {
      "layers",
      [=, disc = Texture(3), ground = Texture(4)](double x, double y, double t) {
        return from_disc({x, y}, t) < radius ? disc(x - 1.5 * t, y - 0.5 * t) : ground(x + t, y);
      },
      [=](const Vector_2& p, double t0, double t1) -> std::optional<Vector_2> {
        if (from_disc(p, t0) < radius - seam) {
          return Vector_2{p.x + 1.5 * (t1 - t0), p.y + 0.5 * (t1 - t0)};
        }
        const Vector_2 q = {p.x - (t1 - t0), p.y};
        if (from_disc(p, t0) < radius + seam || from_disc(q, t1) < radius + seam) {
          return std::nullopt;
        }
        return q;
      }};
}

/// A texture, and from frame `cut` on another one with another motion.
inline Known_clip cut(int frame) {
  return {"cut",
          [=, before = Texture(5), after = Texture(6)](double x, double y, double t) {
            return t < frame ? before(x - t, y) : after(x, y + 1.5 * t);
          },
          [=](const Vector_2& p, double t0, double t1) -> std::optional<Vector_2> {
            if (t1 < frame) return Vector_2{p.x + (t1 - t0), p.y};
            if (t0 >= frame) return Vector_2{p.x, p.y - 1.5 * (t1 - t0)};
            return std::nullopt;
          }};
}

/// A texture that moves and becomes dark until the end.
inline Known_clip fade(int frames) {
  return {"fade",
          [=, texture = Texture(7)](double x, double y, double t) {
            return texture(x - t, y + 0.5 * t) * (1 - 0.9 * t / frames);
          },
          [](const Vector_2& p, double t0, double t1) -> std::optional<Vector_2> {
            return Vector_2{p.x + (t1 - t0), p.y - 0.5 * (t1 - t0)};
          }};
}

}  // namespace detail

/// All of them, for pictures of that size and clips of so many frames.
inline std::vector<Known_clip> known_clips(double width, double height, int frames) {
  return {detail::translation(), detail::rotation(width, height), detail::layers(width, height),
          detail::cut(frames / 2), detail::fade(frames)};
}

/// How far the points of a stream are, at the end of each group, from where that has gone which was
/// at their places at its begin, in pixels, ascending. Of points that are in the picture at both
/// times. Frame n of the stream is at time n * `step` of the clip.
inline std::vector<double> correspondence_errors(const Stream_header& header,
                                                 const std::vector<Block>& blocks,
                                                 const Known_clip& clip, int step = 1) {
  const auto is_in_picture = [&](const Vector_2& p) {
    return p.x >= 0 && p.y >= 0 && p.x <= header.format.width && p.y <= header.format.height;
  };
  Present_points present(header);
  std::vector<double> errors;
  for (const Block& block : blocks) {
    if (const Group* group = std::get_if<Group>(&block)) {
      const auto begin = present.at_begin_of(*group);
      for (std::size_t i = number_of_corners; i < begin.size(); ++i) {
        const Vector_2 from = position_of(header, begin[i].node.place);
        const Vector_2 to = position_of(header, group->targets[i].place);
        if (!is_in_picture(from) || !is_in_picture(to)) continue;
        const auto expected = clip.moved(from, static_cast<double>(group->first) * step,
                                         static_cast<double>(group->last()) * step);
        if (expected) errors.push_back(std::hypot(to.x - expected->x, to.y - expected->y));
      }
    }
    present.follow(block);
  }
  std::ranges::sort(errors);
  return errors;
}

}  // namespace kinetri::video::test

#endif  // KINETRI_TEST_VIDEO_KNOWN_CLIPS_H
