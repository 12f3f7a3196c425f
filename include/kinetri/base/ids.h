// SPDX-License-Identifier: GPL-3.0-or-later
//
// Identifiers that name things across layers and in files.
#ifndef KINETRI_BASE_IDS_H
#define KINETRI_BASE_IDS_H

#include <cstdint>
#include <limits>

#include "kinetri/base/platform.h"

namespace kinetri {

/// The point's number: its position, counted from 0, in the sequence it came from. Never reused.
using Point_id = std::uint32_t;

/// The id of a moving point that belongs to no sequence (a query point, a circumcenter).
inline constexpr Point_id no_point = std::numeric_limits<Point_id>::max();

}  // namespace kinetri

#endif  // KINETRI_BASE_IDS_H
