// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/impl/triangulation/point_problems.h"

#include <cmath>

#include "kinetri/impl/base/check.h"

namespace kinetri::detail {

std::string not_finite_problem(std::size_t id) {
  return "the motion of point " + std::to_string(id) + " has a number that is not finite";
}

std::string named_twice_problem(std::size_t id) {
  return "point " + std::to_string(id) + " is named twice; expected each point once";
}

std::string unknown_id_problem(std::size_t id) {
  return "no point has the id " + std::to_string(id) + "; ask contains(id) first";
}

void check_vectors(std::span<const Point_id> ids, std::span<const Vector_2> vectors,
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
