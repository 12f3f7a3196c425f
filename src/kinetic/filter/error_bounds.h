// SPDX-License-Identifier: GPL-3.0-or-later
//
// The window of time over which certificates are looked at, and what bounds the errors of their
// polynomials there. The time is origin + w * window with 0 <= w <= 1.
#ifndef KINETRI_SRC_KINETIC_FILTER_ERROR_BOUNDS_H
#define KINETRI_SRC_KINETIC_FILTER_ERROR_BOUNDS_H

namespace kinetri {

inline constexpr double unit_roundoff = 0x1p-53;

// Sizes outside of this range might under- or overflow on their way to the
// fourth power.
inline constexpr double least_size = 0x1p-200;
inline constexpr double greatest_size = 0x1p200;

inline bool is_in_range(double x) {
  return x > least_size && x < greatest_size;
}

// A window for looking ahead is this share of the time in which the points would pass their
// distance from one another at their relative speed: long enough that most certificates are
// replaced before it ends.
inline constexpr double window_share = 0.5;

// The sizes of differences over a window. An overflow on the way shows in the sizes, which are out
// of range then.
class Error_bounds {
 public:
  // Bounds the sum of the magnitudes of the coefficients of any difference in either coordinate,
  // and with it the difference throughout the window.
  double size() const { return size_; }
  // Bounds a squared length, but for a factor of two, and the weight that is taken from it.
  double lift_size() const { return size_ * size_; }
  // Bounds the weights: points have none.
  static constexpr double weight_size() { return 0; }
  // The sum of the magnitudes of all numbers that the differences were made from.
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
