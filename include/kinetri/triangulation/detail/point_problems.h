// SPDX-License-Identifier: GPL-3.0-or-later
//
// What may be wrong with the points of a triangulation, in words.
#ifndef KINETRI_TRIANGULATION_DETAIL_POINT_PROBLEMS_H
#define KINETRI_TRIANGULATION_DETAIL_POINT_PROBLEMS_H

#include <cstddef>
#include <string>

#include "kinetri/base/platform.h"

namespace kinetri::detail {

inline constexpr const char* too_many_points = "too many points; expected fewer than 2^32 - 1";

inline std::string not_finite_problem(std::size_t id) {
  return "the motion of point " + std::to_string(id) + " has a number that is not finite";
}

// Apart from where it is used, which is small and often inlined.
inline std::string unknown_id_problem(std::size_t id) {
  return "no point has the id " + std::to_string(id) + "; ask contains(id) first";
}

}  // namespace kinetri::detail

#endif  // KINETRI_TRIANGULATION_DETAIL_POINT_PROBLEMS_H
