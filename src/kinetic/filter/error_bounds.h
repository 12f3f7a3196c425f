// SPDX-License-Identifier: GPL-3.0-or-later
//
// Bounds that the errors of certificates over a time window follow from. A time in the window is
// origin + w * window with 0 <= w <= 1.
#ifndef KINETRI_SRC_KINETIC_FILTER_ERROR_BOUNDS_H
#define KINETRI_SRC_KINETIC_FILTER_ERROR_BOUNDS_H

namespace kinetri {

inline constexpr double unit_roundoff = 0x1p-53;

// The fourth power of a size outside of this range might under- or overflow.
inline constexpr double least_size = 0x1p-200;
inline constexpr double greatest_size = 0x1p200;

inline bool is_in_range(double x) {
  return x > least_size && x < greatest_size;
}

// The usual window, relative to the time in which the points would pass their distance at their
// relative speed: so long that most certificates are replaced before it ends.
inline constexpr double window_share = 0.5;

// Sizes of differences over a window. After an overflow they are out of range.
class Error_bounds {
 public:
  // Bounds the sum of the magnitudes of the coefficients of each coordinate of a difference, and so
  // the difference throughout the window.
  double size() const { return size_; }
  // Bounds half a squared length, and the weight that is subtracted from it.
  double lift_size() const { return size_ * size_; }
  // Bounds the weights; zero for points.
  static constexpr double weight_size() { return 0; }
  // The sum of the magnitudes of all numbers that the differences were computed from.
  double total() const { return total_; }
  // Whether products over the window can be computed without under- or overflow.
  bool is_in_range() const { return size_ > least_size && total_ < greatest_size; }

 protected:
  void set_sizes(double size, double total) {
    size_ = size;
    total_ = total;
  }

 private:
  double size_ = 0;
  double total_ = 0;
};

}  // namespace kinetri

#endif  // KINETRI_SRC_KINETIC_FILTER_ERROR_BOUNDS_H
