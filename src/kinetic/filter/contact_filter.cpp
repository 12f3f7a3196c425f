// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact_filter_impl.h"
#include "filter.h"

namespace kinetri {

#define KINETRI_INSTANTIATE(M)                                                                 \
  template Filter_result filter_contact(const M&, const M&, double, const Double_interval&);   \
  template Filter_result filter_wall_contact(const M&, const Wall_2&, const Double_interval&); \
  template Sign certain_distance_slope(const M&, const M&, const Double_interval&);            \
  template Sign certain_gap(const M&, const M&, double, const Double_interval&);               \
  template bool certainly_inside(const M&, const Wall_2&, const Double_interval&)
KINETRI_INSTANTIATE(Linear_motion_2);
KINETRI_INSTANTIATE(Polynomial_motion_2);
#undef KINETRI_INSTANTIATE

}  // namespace kinetri
