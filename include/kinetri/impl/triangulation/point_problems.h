// SPDX-License-Identifier: GPL-3.0-or-later
//
// Messages about wrong points and velocities.
#ifndef KINETRI_IMPL_TRIANGULATION_POINT_PROBLEMS_H
#define KINETRI_IMPL_TRIANGULATION_POINT_PROBLEMS_H

#include <cstddef>
#include <span>
#include <string>

#include "kinetri/base/ids.h"
#include "kinetri/kinetic/linear_motion_2.h"

namespace kinetri::detail {

inline constexpr const char* too_many_points = "too many points; expected fewer than 2^32 - 1";

std::string not_finite_problem(std::size_t id);
std::string named_twice_problem(std::size_t id);
std::string unknown_id_problem(std::size_t id);

// Throws Precondition_error unless there are as many vectors as ids, and all are finite. `what` and
// `plural` say what they are.
void check_vectors(std::span<const Point_id> ids, std::span<const Vector_2> vectors,
                   const std::string& what, const std::string& plural);

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_TRIANGULATION_POINT_PROBLEMS_H
