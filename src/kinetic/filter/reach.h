// SPDX-License-Identifier: GPL-3.0-or-later
//
// The reach, that is, the contact distance of two points or discs from the origin on: a constant,
// or a linear function if discs grow. docs/MATH.md, section 8, derives the errors.
#ifndef KINETRI_SRC_KINETIC_FILTER_REACH_H
#define KINETRI_SRC_KINETIC_FILTER_REACH_H

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "error_bounds.h"
#include "kinetri/kinetic/disc_motion_2.h"
#include "kinetri/kinetic/wall_2.h"
#include "weighted_differences.h"

namespace kinetri {

// A constant reach, not negative. A type of its own, so that the code of points stays fast.
struct Constant_reach {
  double constant = 0;
};

// Whether the reach changes.
template <class Reach>
inline constexpr bool is_changing = requires(const Reach& reach) {
  reach.slope;
};

inline void scale(Constant_reach& /*reach*/, double /*window*/) {}
inline void scale(Linear_function& reach, double window) {
  reach.slope *= window;
}

// A bound for the scaled reach.
inline double size(const Constant_reach& reach) {
  return reach.constant;
}
inline double size(const Linear_function& reach) {
  return reach.terms + std::abs(reach.slope);
}

// The difference of two centers, and their reach; by powers of w once scaled.
template <class Differences, class Reach>
class Differences_and_reach : public Differences {
 public:
  template <class Center>
  Differences_and_reach(const std::array<const Center*, 1>& from, const Center& to, double origin,
                        const Reach& reach)
      : Differences(from, to, origin), reach_(reach) {}

  std::optional<double> window_ahead(double share) const {
    return shorter(Differences::window_ahead(share), window_of_growth(share, 0));
  }
  // Within the reach, the points have to pass the reach, not their distance.
  std::optional<double> window_within_reach(double share) const {
    const double reach = std::abs(reach_.constant);
    return shorter(Differences::window_ahead(share, reach), window_of_growth(share, reach));
  }

  void scale(double window) {
    Differences::scale(window);
    kinetri::scale(reach_, window);
  }

  const Reach& reach() const { return reach_; }
  // A bound for the scaled reach.
  double reach_size() const { return size(reach_); }
  bool is_in_range() const { return reach_size() < greatest_size && Differences::is_in_range(); }

 private:
  std::optional<double> window_of_growth(double share, double least_extent) const {
    if constexpr (is_changing<Reach>) {
      const double extent = std::max(greatest(absolute(place((*this)[0]))), least_extent);
      if (reach_.slope != 0) return share * extent / std::abs(reach_.slope);
    }
    return std::nullopt;
  }

  Reach reach_;
};

// The kind of differences (differences.h) of two centers with their reach.
template <class Reach>
struct With_reach {
  template <class Differences, class Center>
  auto make(const std::array<const Center*, 1>& from, const Center& to, double origin) const {
    return Differences_and_reach<Differences, Reach>(from, to, origin, reach);
  }

  Reach reach;
};
template <class Reach>
With_reach(Reach) -> With_reach<Reach>;

// Calls `function` with the reach of two points: the diameter plus both radii.
template <class Motion, class Function>
inline auto with_reach_of(const Motion& p, const Motion& q, double diameter, double origin,
                          const Function& function) {
  if constexpr (HasWeight<Motion>) {
    const auto is_constant = [](const Motion& disc) {
      return disc.growth == 0 && disc.radius >= 0;
    };
    if (!is_constant(p) || !is_constant(q)) {
      const Linear_function of_points = {diameter, 0, diameter};
      return function(of_points + (radius_from(p, origin) + radius_from(q, origin)));
    }
    diameter += p.radius + q.radius;
  }
  return function(Constant_reach{diameter});
}

// The same for a point and a wall: the clearance, plus the radius if the boundary touches.
template <class Motion, class Function>
inline auto with_reach_of(const Motion& p, const Wall_2& wall, double origin,
                          const Function& function) {
  if constexpr (HasWeight<Motion>) {
    if (wall.rim_touches) {
      const Linear_function of_center = {wall.clearance, 0, wall.clearance};
      return function(of_center + radius_from(p, origin));
    }
  }
  return function(Constant_reach{wall.clearance});
}

}  // namespace kinetri

#endif  // KINETRI_SRC_KINETIC_FILTER_REACH_H
