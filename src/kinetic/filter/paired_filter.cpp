// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter.h"
#include "paired_filter_impl.h"

namespace kinetri {

#define KINETRI_INSTANTIATE(M)                                                                \
  template std::array<Filter_result, 2> filter_in_circles(const std::array<Quadruple<M>, 2>&, \
                                                          const Double_interval&);            \
  template std::array<Filter_result, 5> filter_after_flip(const Flip_neighborhood<M>&,        \
                                                          const Double_interval&)
KINETRI_INSTANTIATE(Linear_motion_2);
KINETRI_INSTANTIATE(Polynomial_motion_2);
#undef KINETRI_INSTANTIATE

}  // namespace kinetri
