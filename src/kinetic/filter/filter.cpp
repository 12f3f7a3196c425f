// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter.h"

#include "filter_impl.h"

namespace kinetri {

template bool certainly_surrounded(const Linear_motion_2&, std::span<const Linear_motion_2* const>,
                                   const Double_interval&);
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
