// SPDX-License-Identifier: GPL-3.0-or-later
#include "distance_filter_impl.h"
#include "filter.h"

namespace kinetri {

#define KINETRI_INSTANTIATE(M)                                                                   \
  template Filter_result filter_apart(const M&, const M&, double, const Double_interval&, bool); \
  template Filter_result filter_near(const M&, const M&, double, const Double_interval&, bool);  \
  template Filter_result filter_closer(const M&, const M&, const M&, const M&,                   \
                                       const Double_interval&, bool);                            \
  template Sign certain_distance_comparison(const M&, const M&, const M&, const M&,              \
                                            const Double_interval&)
KINETRI_INSTANTIATE(Linear_motion_2);
KINETRI_INSTANTIATE(Polynomial_motion_2);
KINETRI_INSTANTIATE(Disc_motion_2);
KINETRI_INSTANTIATE(Polynomial_disc_motion_2);
#undef KINETRI_INSTANTIATE

}  // namespace kinetri
