// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangulation/regions.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numeric>
#include <random>
#include <span>
#include <vector>

#include "kinetri/impl/triangulation/kinetic_core_impl.h"
#include "kinetri/impl/triangulation/parallel.h"
#include "triangulation/regions_impl.h"
#include "triangulation/subdomains.h"
#include "triangulation/torus_triangulation_impl.h"

namespace kinetri::detail {

// With fewer points two threads gain little (bench/README.md).
bool may_pay_by_regions(std::size_t points, std::size_t threads) {
  constexpr std::size_t least_points = 50'000;
  constexpr std::size_t most_points = 100'000'000;  // handles of a part need enough bits
  return points >= least_points && points <= most_points && usable_threads(threads) > 1;
}

// Several for each thread, and so many that the data of a region are close in memory. Fewer if
// there are few points, since a greater share of them then has neighbors in other regions. Fewer
// also if there are very many points: a handle names one of at most 5 R - 1 parts, and its other
// bits must suffice for the entries of all 3 n edges in one part, and as many again later.
std::size_t number_of_regions(const Region_options& options, std::size_t points) {
  const std::size_t threads = usable_threads(options.threads);
  const std::size_t enough = std::max(4 * threads, points / 12'500);
  const auto by_points =
      std::min(enough, static_cast<std::size_t>(std::sqrt(static_cast<double>(points)) / 15));
  const int bits = std::max(2, 32 - static_cast<int>(std::bit_width(6 * points)));
  const std::size_t most = std::min<std::size_t>(128, ((std::size_t{1} << bits) + 1) / 5);
  return std::bit_floor(
      std::clamp<std::size_t>(options.regions > 0 ? options.regions : by_points, 1, most));
}

void call_for_each_index(const Region_options& options, std::size_t count,
                         const std::function<void(std::size_t)>& work) {
  if (options.threads != 1) return for_each_index_in_parallel(count, work);
  if (options.order_of_tasks == 0) {
    for (std::size_t k = 0; k < count; ++k) work(k);
    return;
  }
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::shuffle(order, std::mt19937_64(options.order_of_tasks));
  std::ranges::for_each(order, work);
}

template <class Traits>
std::size_t Region_runs<Traits>::advance_to(Core& core, const Algebraic_number& until,
                                            const std::function<bool()>& may_go_on) {
  return Region_run<Traits>(core, with_threads(core.threads)).advance_to(until, may_go_on);
}

template <class Traits>
void Region_runs<Traits>::change_in_place(
    Core& core, std::span<const typename Kinetic_types<Traits>::Change> changes) {
  if constexpr (Kinetic_types<Traits>::is_weighted) {
    KINETRI_ASSERT(changes.empty(), "weighted points change by regions");
  } else {
    Region_run<Traits>(core, with_threads(core.threads)).change_in_place(changes);
  }
}

template <class Traits>
void Region_runs<Traits>::join(Core& core) {
  Region_run<Traits>(core, with_threads(core.threads)).join();
}

template struct Region_runs<Linear_kinetic_traits_2>;
template struct Region_runs<Polynomial_kinetic_traits_2>;
template struct Region_runs<Disc_kinetic_traits_2>;
template struct Region_runs<Polynomial_disc_kinetic_traits_2>;
template struct Region_runs<Periodic_kinetic_traits_2>;
template struct Region_runs<Periodic_disc_kinetic_traits_2>;
template class Region_run<Linear_kinetic_traits_2>;
template class Region_run<Polynomial_kinetic_traits_2>;
template class Region_run<Disc_kinetic_traits_2>;
template class Region_run<Polynomial_disc_kinetic_traits_2>;
template class Region_run<Periodic_kinetic_traits_2>;
template class Region_run<Periodic_disc_kinetic_traits_2>;

}  // namespace kinetri::detail
