// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter.h"

#include "filter_impl.h"

namespace kinetri {

// One error bound for all triangles suffices, since most are far from flat.
bool certainly_surrounded(const Linear_motion_2& p, std::span<const Linear_motion_2* const> around,
                          const Double_interval& interval) {
  if (around.size() < 3) return false;
  std::array<Pair, most_around> places;
  Pair terms = {};
  Pair slope = {};
  for (std::size_t i = 0; i < around.size(); ++i) {
    const Difference d = difference(*around[i], p, interval.lower, terms);
    slope = greater(absolute(d.slope), slope);
    places[i] = d.place;
  }
  const double error = error_throughout(sum(terms), greatest(slope), interval);
  Pair previous = places[around.size() - 1];
  bool result = true;
  for (std::size_t i = 0; i < around.size(); ++i) {
    const Pair place = places[i];
    result = result && previous[0] * place[1] - previous[1] * place[0] > error;
    previous = place;
  }
  return result;
}

#define KINETRI_INSTANTIATE(M)                                                                     \
  template Filter_result filter_in_circle(const M&, const M&, const M&, const M&,                  \
                                          const Double_interval&, bool);                           \
  template Filter_result filter_orientation(const M&, const M&, const M&, const Double_interval&,  \
                                            bool);                                                 \
  template Sign certain_x_order(const M&, const M&, const Double_interval&);                       \
  template Sign certain_y_order(const M&, const M&, const Double_interval&);                       \
  template Sign certain_orientation(const M&, const M&, const M&, const Double_interval&);         \
  template Sign certain_in_circle(const M&, const M&, const M&, const M&, const Double_interval&); \
  template Sign certain_scalar_product(const M&, const M&, const M&, const Double_interval&);      \
  template Sign certain_distance_order(const M&, const M&, const M&, const Double_interval&);      \
  template bool certainly_apart(const M&, const M&, const Double_interval&)
KINETRI_INSTANTIATE(Linear_motion_2);
KINETRI_INSTANTIATE(Polynomial_motion_2);
#undef KINETRI_INSTANTIATE

}  // namespace kinetri
