// SPDX-License-Identifier: GPL-3.0-or-later
#include "precise_filter.h"

#include <algorithm>
#include <array>
#include <cfenv>
#include <cmath>

#include "differences.h"
#include "double_double.h"

namespace kinetri {
namespace {

constexpr double unit = unit_roundoff * unit_roundoff;

// Where points are at one time, relative to the last of them.
template <std::size_t N>
class Places {
 public:
  Places(const std::array<const Linear_motion_2*, N>& motions, const Double_double& time) {
    std::array<Place, N> places;
    for (std::size_t i = 0; i < N; ++i) {
      const Linear_motion_2& m = *motions[i];
      const Double_double elapsed = time - Double_double{m.epoch};
      const Double_double moved_x = elapsed * Double_double{m.velocity.x};
      const Double_double moved_y = elapsed * Double_double{m.velocity.y};
      places[i] = {Double_double{m.position.x} + moved_x, Double_double{m.position.y} + moved_y};
      terms_ += std::abs(m.position.x) + std::abs(m.position.y) + std::abs(moved_x.high) +
                std::abs(moved_y.high);
    }
    for (std::size_t i = 0; i + 1 < N; ++i) {
      relative_[i] = {places[i].x - places[N - 1].x, places[i].y - places[N - 1].y};
      size_ = std::max({size_, std::abs(relative_[i].x.high), std::abs(relative_[i].y.high)});
    }
    size_ += 0x1p-90 * terms_;
  }

  Double_double cross(std::size_t i, std::size_t j) const {
    return relative_[i].x * relative_[j].y - relative_[i].y * relative_[j].x;
  }
  Double_double squared_length(std::size_t i) const {
    return relative_[i].x * relative_[i].x + relative_[i].y * relative_[i].y;
  }

  double size() const { return size_; }
  double terms() const { return terms_; }
  bool is_in_range() const { return kinetri::is_in_range(size_) && terms_ < greatest_size; }

 private:
  struct Place {
    Double_double x;
    Double_double y;
  };

  std::array<Place, N - 1> relative_;
  double size_ = 0;   // bounds the relative places
  double terms_ = 0;  // the sum of all numbers that the places were made from
};

// What is proved of the arithmetic holds with rounding to nearest.
bool is_precise() {
  return std::fegetround() == FE_TONEAREST;
}

double certain(const Double_double& value, double error) {
  return std::abs(value.high) > error ? value.high : 0;
}

}  // namespace

double precise_in_circle(const Linear_motion_2& p, const Linear_motion_2& q,
                         const Linear_motion_2& r, const Linear_motion_2& s, double high,
                         double low) {
  const Places<4> places({&p, &q, &r, &s}, {high, low});
  if (!places.is_in_range() || !is_precise()) return 0;
  const Double_double value = places.squared_length(0) * places.cross(1, 2) +
                              places.squared_length(1) * places.cross(2, 0) +
                              places.squared_length(2) * places.cross(0, 1);
  const double size = places.size();
  return certain(value, 4096 * unit * (size * size) * (size * places.terms()));
}

double precise_orientation(const Linear_motion_2& p, const Linear_motion_2& q,
                           const Linear_motion_2& r, double high, double low) {
  // Relative to the last point: the orientation of r, p, q.
  const Places<3> places({&p, &q, &r}, {high, low});
  if (!places.is_in_range() || !is_precise()) return 0;
  return certain(places.cross(0, 1), 256 * unit * (places.size() * places.terms()));
}

double precise_contact(const Linear_motion_2& p, const Linear_motion_2& q, double diameter,
                       double high, double low) {
  const Places<2> places({&p, &q}, {high, low});
  if (!places.is_in_range() || !is_precise() || !is_in_range(diameter)) return 0;
  const Double_double square = exact_product(diameter, diameter);
  return certain(places.squared_length(0) - square,
                 256 * unit * (places.size() * places.terms() + square.high));
}

}  // namespace kinetri
