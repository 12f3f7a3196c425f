// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/impl/simulation/triangle_map.h"

#include <algorithm>

#include "kinetri/impl/base/check.h"

namespace kinetri::detail {
namespace {

template <class Corner>
Corner nothing() {
  if constexpr (std::same_as<Corner, Point_id>) return no_point;
  return {};
}

// The corner as the point p sees it.
template <class Corner>
Corner against(const Corner& corner, const Corner& p) {
  return seen_from(offset_of(p), corner);
}

}  // namespace

template <class Corner>
requires std::same_as<Corner, Point_id> || std::same_as<Corner, Periodic_image>
auto Triangle_map<Corner>::sides(Point_id p) const -> const std::vector<Side>& {
  static const std::vector<Side> none;
  return p < sides_.size() ? sides_[p] : none;
}

template <class Corner>
requires std::same_as<Corner, Point_id> || std::same_as<Corner, Periodic_image> Corner
Triangle_map<Corner>::apex(const Corner& p, const Corner& q)
const {
  const std::vector<Side>& at_p = sides(id_of(p));
  const auto side = std::ranges::find(at_p, against(q, p), &Side::end);
  return side == at_p.end() ? nothing<Corner>()
                            : seen_from(offset_between(offset_of(p), {}), side->apex);
}

template <class Corner>
requires std::same_as<Corner, Point_id> || std::same_as<Corner, Periodic_image>
void Triangle_map<Corner>::insert(const Corners& corners) {
  for (std::size_t k = 0; k < 3; ++k) {
    const Corner& p = corners[k];
    const Corner& q = corners[(k + 1) % 3];
    KINETRI_ASSERT(id_of(apex(p, q)) == no_point, "a side has one triangle to its left");
    if (id_of(p) >= sides_.size()) sides_.resize(std::size_t{id_of(p)} + 1);
    sides_[id_of(p)].push_back({against(q, p), against(corners[(k + 2) % 3], p)});
  }
}

template <class Corner>
requires std::same_as<Corner, Point_id> || std::same_as<Corner, Periodic_image>
void Triangle_map<Corner>::erase(const Corners& corners) {
  for (std::size_t k = 0; k < 3; ++k) {
    const Corner& p = corners[k];
    auto& at_p = sides_[id_of(p)];
    const auto side = std::ranges::find(at_p, against(corners[(k + 1) % 3], p), &Side::end);
    KINETRI_ASSERT(side != at_p.end() && side->apex == against(corners[(k + 2) % 3], p),
                   "a triangle that is erased is there");
    *side = at_p.back();
    at_p.pop_back();
  }
}

template class Triangle_map<Point_id>;
template class Triangle_map<Periodic_image>;

}  // namespace kinetri::detail
