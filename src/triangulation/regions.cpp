// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangulation/regions.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <numeric>
#include <random>
#include <span>
#include <vector>

#include "kinetri/impl/triangulation/kinetic_core_impl.h"
#include "kinetri/impl/triangulation/parallel.h"
#include "triangulation/regions_impl.h"

namespace kinetri::detail {

// With fewer points two threads gain little (bench/README.md).
bool may_pay_by_regions(std::size_t points, std::size_t threads) {
  constexpr std::size_t least_points = 50'000;
  constexpr std::size_t most_points = 100'000'000;  // so that handles of a part have enough bits
  return points >= least_points && points <= most_points && usable_threads(threads) > 1;
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
void Region_runs<Traits>::make_turns(
    Core& core, std::span<const typename Kinetic_types<Traits>::Change> turns) {
  if constexpr (Kinetic_types<Traits>::is_weighted) {
    KINETRI_ASSERT(turns.empty(), "weighted points turn by regions");
  } else {
    Region_run<Traits>(core, with_threads(core.threads)).make_turns(turns);
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

// Of turns, which are not there, nothing is compiled.
template <class Traits>
using Run = Region_run<Traits>;
template Run<Linear_kinetic_traits_2>::Region_run(Kinetic_core<Linear_kinetic_traits_2>&,
                                                  const Region_options&, No_turns);
template std::size_t Run<Linear_kinetic_traits_2>::advance_to(const Algebraic_number&,
                                                              const std::function<bool()>&);
template void Run<Linear_kinetic_traits_2>::join();
template void Run<Linear_kinetic_traits_2>::make_turns(
    std::span<const Run<Linear_kinetic_traits_2>::Change>);
template Run<Polynomial_kinetic_traits_2>::Region_run(Kinetic_core<Polynomial_kinetic_traits_2>&,
                                                      const Region_options&, No_turns);
template std::size_t Run<Polynomial_kinetic_traits_2>::advance_to(const Algebraic_number&,
                                                                  const std::function<bool()>&);
template void Run<Polynomial_kinetic_traits_2>::join();
template void Run<Polynomial_kinetic_traits_2>::make_turns(
    std::span<const Run<Polynomial_kinetic_traits_2>::Change>);
template Run<Disc_kinetic_traits_2>::Region_run(Kinetic_core<Disc_kinetic_traits_2>&,
                                                const Region_options&, No_turns);
template std::size_t Run<Disc_kinetic_traits_2>::advance_to(const Algebraic_number&,
                                                            const std::function<bool()>&);
template void Run<Disc_kinetic_traits_2>::join();
template Run<Polynomial_disc_kinetic_traits_2>::Region_run(
    Kinetic_core<Polynomial_disc_kinetic_traits_2>&, const Region_options&, No_turns);
template std::size_t Run<Polynomial_disc_kinetic_traits_2>::advance_to(
    const Algebraic_number&, const std::function<bool()>&);
template void Run<Polynomial_disc_kinetic_traits_2>::join();

}  // namespace kinetri::detail
