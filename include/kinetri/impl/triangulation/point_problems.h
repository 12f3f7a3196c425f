// SPDX-License-Identifier: GPL-3.0-or-later
//
// Messages about wrong points and velocities.
#ifndef KINETRI_IMPL_TRIANGULATION_POINT_PROBLEMS_H
#define KINETRI_IMPL_TRIANGULATION_POINT_PROBLEMS_H

#include <cmath>
#include <cstddef>
#include <span>
#include <string>

#include "kinetri/base/ids.h"
#include "kinetri/impl/base/check.h"
#include "kinetri/kinetic/linear_motion_2.h"

namespace kinetri::detail {

inline constexpr const char* too_many_points = "too many points; expected fewer than 2^32 - 1";

inline std::string not_finite_problem(std::size_t id) {
  return "the motion of point " + std::to_string(id) + " has a number that is not finite";
}

inline std::string named_twice_problem(std::size_t id) {
  return "point " + std::to_string(id) + " is named twice; expected each point once";
}

// A function of its own, since its callers are small and often inlined.
inline std::string unknown_id_problem(std::size_t id) {
  return "no point has the id " + std::to_string(id) + "; ask contains(id) first";
}

// Precondition: as many vectors as ids, all of them finite. `what` and `plural` say what they are.
inline void check_vectors(std::span<const Point_id> ids, std::span<const Vector_2> vectors,
                          const std::string& what, const std::string& plural) {
  KINETRI_PRECONDITION(ids.size() == vectors.size(), std::to_string(ids.size()) + " ids and " +
                                                         std::to_string(vectors.size()) + " " +
                                                         plural + "; expected as many of each");
  for (std::size_t i = 0; i < ids.size(); ++i) {
    KINETRI_PRECONDITION(std::isfinite(vectors[i].x) && std::isfinite(vectors[i].y),
                         "the " + what + " of point " + std::to_string(ids[i]) +
                             " is not finite; expected two finite numbers");
  }
}

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_TRIANGULATION_POINT_PROBLEMS_H
