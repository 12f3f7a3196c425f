// SPDX-License-Identifier: GPL-3.0-or-later
//
// For images of points in a periodic box, and for those of discs the questions that depend on
// weights; disc_filter.h has the others.
#include "contact_filter_impl.h"
#include "distance_filter_impl.h"
#include "filter.h"
#include "filter_impl.h"
#include "paired_filter_impl.h"

namespace kinetri {

using M = Image_motion_2;
template Filter_result filter_in_circle(const M&, const M&, const M&, const M&,
                                        const Double_interval&, bool);
template Filter_result filter_orientation(const M&, const M&, const M&, const Double_interval&,
                                          bool);
template std::array<Filter_result, 2> filter_in_circles(const std::array<Quadruple<M>, 2>&,
                                                        const Double_interval&);
template std::array<Filter_result, 5> filter_after_flip(const Flip_neighborhood<M>&,
                                                        const Double_interval&);
template Filter_result filter_contact(const M&, const M&, double, const Double_interval&);
template Sign certain_distance_slope(const M&, const M&, const Double_interval&);
template Sign certain_x_order(const M&, const M&, const Double_interval&);
template Sign certain_y_order(const M&, const M&, const Double_interval&);
template Sign certain_orientation(const M&, const M&, const M&, const Double_interval&);
template Sign certain_in_circle(const M&, const M&, const M&, const M&, const Double_interval&);
template Sign certain_scalar_product(const M&, const M&, const M&, const Double_interval&);
template Sign certain_distance_order(const M&, const M&, const M&, const Double_interval&);
template Filter_result filter_apart(const M&, const M&, double, const Double_interval&, bool);
template Filter_result filter_near(const M&, const M&, double, const Double_interval&, bool);
template Filter_result filter_closer(const M&, const M&, const M&, const M&, const Double_interval&,
                                     bool);
template Sign certain_distance_comparison(const M&, const M&, const M&, const M&,
                                          const Double_interval&);
template Sign certain_gap(const M&, const M&, double, const Double_interval&);
template bool certainly_apart(const M&, const M&, const Double_interval&);
template bool certainly_surrounded(const M&, std::span<const M* const>, const Double_interval&);

using D = Image_disc_motion_2;
template Filter_result filter_in_circle(const D&, const D&, const D&, const D&,
                                        const Double_interval&, bool);
template Sign certain_in_circle(const D&, const D&, const D&, const D&, const Double_interval&);
template Sign certain_power_distance_order(const D&, const D&, const D&, const Double_interval&);
template Sign certain_weight_order(const D&, const D&, const Double_interval&);
template std::array<Filter_result, 2> filter_in_circles(const std::array<Quadruple<D>, 2>&,
                                                        const Double_interval&);
template std::array<Filter_result, 5> filter_after_flip(const Flip_neighborhood<D>&,
                                                        const Double_interval&);
template Filter_result filter_contact(const D&, const D&, double, const Double_interval&);
template Sign certain_distance_slope(const D&, const D&, const Double_interval&);
template Sign certain_gap(const D&, const D&, double, const Double_interval&);
template Filter_result filter_apart(const D&, const D&, double, const Double_interval&, bool);
template Filter_result filter_near(const D&, const D&, double, const Double_interval&, bool);
template Filter_result filter_closer(const D&, const D&, const D&, const D&, const Double_interval&,
                                     bool);
template Sign certain_distance_comparison(const D&, const D&, const D&, const D&,
                                          const Double_interval&);

}  // namespace kinetri
