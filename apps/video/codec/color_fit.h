// SPDX-License-Identifier: GPL-3.0-or-later
//
// Fits colors at points to given frames by least squares.
#ifndef KINETRI_VIDEO_CODEC_COLOR_FIT_H
#define KINETRI_VIDEO_CODEC_COLOR_FIT_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "kinetri/triangulation/field_2.h"

namespace kinetri::video {

/// The normal equations of a least squares problem with one unknown for each point. A sample of a
/// frame is the sum of the unknowns at the corners of its triangle, each times its weight; frames
/// have different weights. `channels` problems with one matrix are solved together.
class Color_fit {
 public:
  /// `points`: one more than the greatest number.
  Color_fit(std::size_t points, std::size_t channels);

  /// Adds a frame with the weight `importance`. At each position the sample should equal the
  /// interpolated unknowns times `factor` plus the interpolated known values. `known` has the
  /// values of the points by number, then by channel; `samples` is called with a position and a
  /// channel. O(positions).
  template <class Samples>
  void add(std::span<const Corner_weights> weights, double importance, double factor,
           std::span<const double> known, Samples samples) {
    for (std::size_t i = 0; i < weights.size(); ++i) {
      const Corner_weights& here = weights[i];
      if (here.corners != corners_) begin_triangle(here.corners);
      for (std::size_t channel = 0; channel < channels_; ++channel) {
        double rest = samples(i, channel);
        for (std::size_t k = 0; k < 3; ++k) {
          rest -= here.weights[k] * known[here.corners[k] * channels_ + channel];
        }
        for (std::size_t k = 0; k < 3; ++k) {
          right_[here.corners[k] * channels_ + channel] +=
              importance * factor * here.weights[k] * rest;
        }
      }
      for (std::size_t k = 0; k < 3; ++k) {
        const double share = importance * factor * factor * here.weights[k];
        square_[k] += share * here.weights[k];
        product_[k] += share * here.weights[(k + 1) % 3];
      }
    }
    begin_triangle({no_point, no_point, no_point});
  }

  /// Pulls the unknowns of a point toward `values`, as `weight` samples at the point would.
  void pull(Point_id point, double weight, std::span<const double> values);

  /// The unknowns by number, then by channel, by the method of conjugate gradients with the
  /// diagonal as preconditioner (M. R. Hestenes, E. Stiefel, Methods of conjugate gradients for
  /// solving linear systems, 1952), from `start` on. Points without any sample keep their values.
  std::vector<double> solve(std::vector<double> start);

 private:
  struct Entry {
    Point_id row;
    Point_id column;
    double value;
  };

  void begin_triangle(const std::array<Point_id, 3>& corners);
  void multiply(const std::vector<double>& x, std::vector<double>& result) const;

  std::size_t points_;
  std::size_t channels_;
  std::vector<double> diagonal_;
  std::vector<double> right_;
  std::unordered_map<std::uint64_t, double> products_;  // by the numbers of two points
  std::vector<Entry> entries_;                          // the same, sorted, once all are known
  // Sums for the triangle of the last positions, not yet added to those above.
  std::array<Point_id, 3> corners_ = {no_point, no_point, no_point};
  std::array<double, 3> square_ = {};
  std::array<double, 3> product_ = {};
};

}  // namespace kinetri::video

#endif  // KINETRI_VIDEO_CODEC_COLOR_FIT_H
