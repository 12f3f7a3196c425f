// SPDX-License-Identifier: GPL-3.0-or-later
//
// For discs, the questions that depend on weights or radii; disc_filter.h has the others.
#include "contact_filter_impl.h"
#include "filter.h"
#include "filter_impl.h"
#include "paired_filter_impl.h"

namespace kinetri {

// Used for discs of one size.
#define KINETRI_OF_POINTS(M)                                                                  \
  extern template Filter_result filter_in_circle(const M&, const M&, const M&, const M&,      \
                                                 const Double_interval&, bool);               \
  extern template Sign certain_in_circle(const M&, const M&, const M&, const M&,              \
                                         const Double_interval&);                             \
  extern template Sign certain_distance_order(const M&, const M&, const M&,                   \
                                              const Double_interval&);                        \
  extern template std::array<Filter_result, 2> filter_in_circles(                             \
      const std::array<Quadruple<M>, 2>&, const Double_interval&);                            \
  extern template std::array<Filter_result, 5> filter_after_flip(const Flip_neighborhood<M>&, \
                                                                 const Double_interval&)
KINETRI_OF_POINTS(Linear_motion_2);
KINETRI_OF_POINTS(Polynomial_motion_2);
#undef KINETRI_OF_POINTS

#define KINETRI_INSTANTIATE(M)                                                                     \
  template Filter_result filter_in_circle(const M&, const M&, const M&, const M&,                  \
                                          const Double_interval&, bool);                           \
  template Sign certain_in_circle(const M&, const M&, const M&, const M&, const Double_interval&); \
  template Sign certain_power_distance_order(const M&, const M&, const M&,                         \
                                             const Double_interval&);                              \
  template Sign certain_weight_order(const M&, const M&, const Double_interval&);                  \
  template std::array<Filter_result, 2> filter_in_circles(const std::array<Quadruple<M>, 2>&,      \
                                                          const Double_interval&);                 \
  template std::array<Filter_result, 5> filter_after_flip(const Flip_neighborhood<M>&,             \
                                                          const Double_interval&);                 \
  template Filter_result filter_contact(const M&, const M&, double, const Double_interval&);       \
  template Filter_result filter_wall_contact(const M&, const Wall_2&, const Double_interval&);     \
  template Sign certain_distance_slope(const M&, const M&, const Double_interval&);                \
  template Sign certain_gap(const M&, const M&, double, const Double_interval&);                   \
  template bool certainly_inside(const M&, const Wall_2&, const Double_interval&)
KINETRI_INSTANTIATE(Disc_motion_2);
KINETRI_INSTANTIATE(Polynomial_disc_motion_2);
#undef KINETRI_INSTANTIATE

}  // namespace kinetri
