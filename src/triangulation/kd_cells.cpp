// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangulation/kd_cells.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "kinetri/impl/base/check.h"

namespace kinetri::detail {

Kd_cells::Kd_cells(std::vector<Vector_2> sample, std::size_t count) {
  KINETRI_PRECONDITION(count > 0, "a plane without cells");
  constexpr double infinity = std::numeric_limits<double>::infinity();
  split(sample, count, {{-infinity, -infinity}, {infinity, infinity}});
}

// Splits a part of the plane, with these positions of the sample, into `count` cells.
void Kd_cells::split(std::span<Vector_2> places, std::size_t count, const Cell& part) {
  const std::size_t number = nodes_.size();
  nodes_.push_back({count, cells_.size()});
  if (count == 1) return cells_.push_back(part);
  const auto extent = [&](double Vector_2::*axis) {
    if (places.empty()) return 0.0;
    const auto [least, greatest] = std::ranges::minmax(places, {}, axis);
    return greatest.*axis - least.*axis;
  };
  double Vector_2::*const axis =
      extent(&Vector_2::x) < extent(&Vector_2::y) ? &Vector_2::y : &Vector_2::x;
  const std::size_t below = count / 2;
  const std::size_t middle = places.size() * below / count;
  double at = 0;
  if (middle < places.size()) {
    std::ranges::nth_element(places, places.begin() + static_cast<std::ptrdiff_t>(middle), {},
                             axis);
    at = places[middle].*axis;
  }
  nodes_[number].axis = axis;
  nodes_[number].at = at;
  Cell part_below = part;
  part_below.greatest.*axis = at;
  split(places.first(middle), below, part_below);
  nodes_[number].above = nodes_.size();
  Cell part_above = part;
  part_above.least.*axis = at;
  split(places.subspan(middle), count - below, part_above);
}

std::size_t Kd_cells::cell_of(const Vector_2& place) const {
  std::size_t node = 0;
  while (nodes_[node].cells > 1) {
    node = place.*nodes_[node].axis < nodes_[node].at ? node + 1 : nodes_[node].above;
  }
  return nodes_[node].first_cell;
}

}  // namespace kinetri::detail
