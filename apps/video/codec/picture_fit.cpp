// SPDX-License-Identifier: GPL-3.0-or-later
#include "video/codec/picture_fit.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace kinetri::video {
namespace {

// The weight, in samples, by which a color is pulled toward its previous value: a color that few
// samples determine stays, which costs no bits.
constexpr double inertia = 2;
// The same for a color that must stay: more than all samples of a picture.
constexpr double fixation = 1e9;
// A color changes only if it is off by more than this many steps.
constexpr double dead_zone = 1;

// The last frame of a group counts as much as all others together. Else its colors, with which the
// next group begins, would be biased by the earlier frames, and oscillate from group to group.
double importance_of(std::uint32_t frame, std::uint32_t frames) {
  return frame == frames ? std::max(frames, 1U) : 1.0;
}

}  // namespace

Picture_fit::Picture_fit(const Stream_header& header)
    : header_(header), sets_(plane_sets(header.format)) {}

std::vector<Picture_fit::Plane_set> Picture_fit::plane_sets(const Video_format& format) {
  const Grid_2 brightness = format.grid(0, format);
  if (format.chroma == Chroma::mono) return {{0, 1, brightness}};
  if (format.chroma == Chroma::yuv444) return {{0, 3, brightness}};
  return {{0, 1, brightness}, {1, 2, format.grid(1, format)}};
}

std::int16_t Picture_fit::quantized(double value) const {
  return static_cast<std::int16_t>(std::clamp(std::floor(value / unit() + 0.5), -32000.0, 32000.0));
}

void Picture_fit::fit(Moving_picture& picture, const Points& points, std::uint32_t first,
                      std::uint32_t frames, const Frames& frame, std::vector<Node>& targets,
                      std::size_t fixed) {
  const std::size_t ids = points.back().id + std::size_t{1};
  std::vector<Color_fit> fits;
  std::vector<std::vector<double>> colors;
  for (const auto& [begin, count, grid] : sets_) {
    Color_fit& fit = fits.emplace_back(ids, count);
    std::vector<double>& known = colors.emplace_back(ids * count);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto& point = points[i];
      double* here = &known[point.id * count];
      for (std::size_t c = 0; c < count; ++c) here[c] = point.node.colors[begin + c] * unit();
      fit.pull(point.id, i < fixed ? fixation : inertia, {here, count});
    }
  }
  for (std::uint32_t k = frames == 0 ? 0 : 1; k <= frames; ++k) {
    picture.advance_to(static_cast<double>(first) + k);
    const double share = frames == 0 ? 1 : static_cast<double>(k) / frames;
    for (std::size_t s = 0; s < sets_.size(); ++s) {
      add_frame(picture, sets_[s], frame(first + k), importance_of(k, frames), share, colors[s],
                fits[s]);
    }
  }
  for (std::size_t s = 0; s < sets_.size(); ++s) {
    const auto [begin, count, grid] = sets_[s];
    const std::vector<double> found = fits[s].solve(colors[s]);
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (std::size_t c = 0; c < count; ++c) {
        const double value = found[points[i].id * count + c];
        const std::int16_t before = points[i].node.colors[begin + c];
        const bool stays =
            i < fixed || (frames > 0 && std::abs(value - before * unit()) <= dead_zone * unit());
        targets[i].colors[begin + c] = stays ? before : quantized(value);
      }
    }
  }
}

void Picture_fit::add_frame(const Moving_picture& picture, const Plane_set& set, const Frame& frame,
                            double importance, double share, std::vector<double> colors,
                            Color_fit& fit) {
  std::vector<Corner_weights>& weights = set.first == 0 ? weights_ : color_weights_;
  weights.resize(set.grid.rows * set.grid.columns);
  find_corner_weights(picture.triangulation(), set.grid, weights);
  for (double& value : colors) value *= 1 - share;
  fit.add(weights, importance, share, colors, [&](std::size_t i, std::size_t channel) {
    return static_cast<double>(frame.planes[set.first + channel][i]);
  });
}

std::vector<double> Picture_fit::error(const Points& points, const Frame& frame) const {
  std::vector<double> values(points.back().id + std::size_t{1});
  for (const auto& point : points) values[point.id] = point.node.colors[0] * unit();
  const auto& samples = frame.planes[0];
  std::vector<double> result(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    result[i] = samples[i];
    for (std::size_t k = 0; k < 3; ++k) {
      result[i] -= weights_[i].weights[k] * values[weights_[i].corners[k]];
    }
  }
  return result;
}

}  // namespace kinetri::video
