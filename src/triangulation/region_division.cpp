// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangulation/region_division.h"

#include "kinetri/impl/triangulation/schedule.h"

namespace kinetri::detail {

std::shared_ptr<Region_division> make_division() {
  return std::make_shared<Region_division>();
}

std::size_t number_of_regions(const Region_division& division) {
  return division.regions;
}

std::size_t node_of(const Region_division& division, Point_id a, Point_id b) {
  return division.node_of(a, b);
}

}  // namespace kinetri::detail
