// SPDX-License-Identifier: GPL-3.0-or-later
//
// Clips whose motion is known: textures that are sums of waves, so that they have a value at every
// position, not only at pixels.
#ifndef KINETRI_TEST_VIDEO_CLIPS_H
#define KINETRI_TEST_VIDEO_CLIPS_H

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "video/formats/frame.h"

namespace kinetri::video::test {

/// A texture: its brightness at a position, about 128.
class Texture {
 public:
  explicit Texture(unsigned seed) {
    std::mt19937 random(seed);
    // No std distribution: these differ from library to library.
    const auto uniform = [&](double from, double to) {
      return from + (to - from) * static_cast<double>(random()) / 4294967296.0;
    };
    for (int i = 0; i < 24; ++i) {
      const double angle = uniform(0, 6.283185307179586);
      const double frequency = uniform(0.2, 0.7);
      waves_.push_back({frequency * std::cos(angle), frequency * std::sin(angle),
                        uniform(0, 6.283185307179586), uniform(4, 16)});
    }
  }

  double operator()(double x, double y) const {
    double sum = 128;
    for (const Wave& wave : waves_) {
      sum += wave.height * std::sin(wave.x * x + wave.y * y + wave.phase);
    }
    return sum;
  }

 private:
  struct Wave {
    double x;
    double y;
    double phase;
    double height;
  };

  std::vector<Wave> waves_;
};

/// The brightness at a position and time.
using Scene = std::function<double(double x, double y, double t)>;

inline std::uint8_t sample_of(double value) {
  return static_cast<std::uint8_t>(std::clamp(std::floor(value + 0.5), 0.0, 255.0));
}

/// The frame of a scene at a time. Color, where there is any, is another function of the brightness
/// at its samples.
inline Frame frame_of(const Video_format& format, const Scene& scene, double t) {
  Frame frame = black_frame(format);
  for (std::size_t plane = 0; plane < format.planes(); ++plane) {
    const Grid_2 grid = format.grid(plane, format);
    for (std::size_t row = 0; row < grid.rows; ++row) {
      for (std::size_t column = 0; column < grid.columns; ++column) {
        const Vector_2 p = grid.place(column, row);
        const double value = scene(p.x, p.y, t);
        const double shown = plane == 0 ? value : plane == 1 ? 192 - value / 2 : 64 + value / 2;
        frame.planes[plane][row * grid.columns + column] = sample_of(shown);
      }
    }
  }
  return frame;
}

/// Frames that are in memory.
class Clip : public Frame_source {
 public:
  Clip(const Video_format& format, std::vector<Frame> frames)
      : format_(format), frames_(std::move(frames)) {}

  /// The frames of a scene at the times 0, `step`, 2 * `step`, ...
  Clip(const Video_format& format, const Scene& scene, int frames, int step = 1) : format_(format) {
    for (int i = 0; i < frames; ++i) {
      frames_.push_back(frame_of(format, scene, static_cast<double>(i) * step));
    }
  }

  const Video_format& format() const override { return format_; }
  const std::string& name() const override { return name_; }
  bool read(Frame& frame) override {
    if (next_ == frames_.size()) return false;
    frame = frames_[next_++];
    return true;
  }

  const std::vector<Frame>& frames() const { return frames_; }
  void rewind() { next_ = 0; }

 private:
  Video_format format_;
  std::vector<Frame> frames_;
  std::string name_ = "clip";
  std::size_t next_ = 0;
};

/// Gray frames of full range.
inline Video_format gray_format(std::uint32_t width, std::uint32_t height) {
  return {width, height, Chroma::mono, true, {25, 1}, {1, 1}};
}

}  // namespace kinetri::video::test

#endif  // KINETRI_TEST_VIDEO_CLIPS_H
