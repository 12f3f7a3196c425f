// SPDX-License-Identifier: GPL-3.0-or-later
#include "video/codec/color_fit.h"

#include <algorithm>
#include <utility>

namespace kinetri::video {
namespace {

// More digits than the quantization of colors leaves.
constexpr double least_reduction = 1e-6;
constexpr int most_steps = 60;

}  // namespace

Color_fit::Color_fit(std::size_t points, std::size_t channels)
    : points_(points), channels_(channels), diagonal_(points, 0.0), right_(points * channels, 0.0) {
  products_.reserve(4 * points);
}

void Color_fit::begin_triangle(const std::array<Point_id, 3>& corners) {
  if (corners_[0] != no_point) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(corners_[k], corners_[(k + 1) % 3]);
      diagonal_[corners_[k]] += square_[k];
      products_[std::uint64_t{low} << 32U | high] += product_[k];
    }
  }
  corners_ = corners;
  square_ = {};
  product_ = {};
}

void Color_fit::pull(Point_id point, double weight, std::span<const double> values) {
  diagonal_[point] += weight;
  for (std::size_t channel = 0; channel < channels_; ++channel) {
    right_[point * channels_ + channel] += weight * values[channel];
  }
}

void Color_fit::multiply(const std::vector<double>& x, std::vector<double>& result) const {
  for (std::size_t point = 0; point < points_; ++point) {
    for (std::size_t channel = 0; channel < channels_; ++channel) {
      const std::size_t i = point * channels_ + channel;
      result[i] = diagonal_[point] * x[i];
    }
  }
  for (const Entry& entry : entries_) {
    for (std::size_t channel = 0; channel < channels_; ++channel) {
      const std::size_t i = entry.row * channels_ + channel;
      const std::size_t j = entry.column * channels_ + channel;
      result[i] += entry.value * x[j];
      result[j] += entry.value * x[i];
    }
  }
}

std::vector<double> Color_fit::solve(std::vector<double> start) {
  entries_.clear();
  for (const auto& [numbers, value] : products_) {
    entries_.push_back({static_cast<Point_id>(numbers >> 32U),
                        static_cast<Point_id>(numbers & 0xFFFFFFFFU), value});
  }
  // The order of a hash table is unspecified.
  std::ranges::sort(entries_, {}, [](const Entry& e) { return std::pair(e.row, e.column); });

  std::vector<double> x = std::move(start);
  std::vector<double> residual(x.size());
  std::vector<double> scaled(x.size());
  std::vector<double> image(x.size());
  multiply(x, image);
  for (std::size_t i = 0; i < x.size(); ++i) residual[i] = right_[i] - image[i];
  const auto precondition = [&] {
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double d = diagonal_[i / channels_];
      scaled[i] = d > 0 ? residual[i] / d : 0.0;
    }
  };
  // A sum for each channel: the problems are independent.
  const auto dot = [&](const std::vector<double>& a, const std::vector<double>& b) {
    std::vector<double> sums(channels_, 0.0);
    for (std::size_t i = 0; i < a.size(); ++i) sums[i % channels_] += a[i] * b[i];
    return sums;
  };
  precondition();
  std::vector<double> direction = scaled;
  std::vector<double> size = dot(residual, scaled);
  const std::vector<double> first_size = size;
  for (int step = 0; step < most_steps; ++step) {
    bool is_done = true;
    for (std::size_t c = 0; c < channels_; ++c) {
      if (size[c] > least_reduction * least_reduction * first_size[c]) is_done = false;
    }
    if (is_done) break;
    multiply(direction, image);
    const std::vector<double> curvature = dot(direction, image);
    for (std::size_t i = 0; i < x.size(); ++i) {
      const std::size_t c = i % channels_;
      const double length = curvature[c] > 0 ? size[c] / curvature[c] : 0.0;
      x[i] += length * direction[i];
      residual[i] -= length * image[i];
    }
    precondition();
    const std::vector<double> next_size = dot(residual, scaled);
    for (std::size_t i = 0; i < x.size(); ++i) {
      const std::size_t c = i % channels_;
      direction[i] = scaled[i] + (size[c] > 0 ? next_size[c] / size[c] : 0.0) * direction[i];
    }
    size = next_size;
  }
  return x;
}

}  // namespace kinetri::video
