// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/simulation/growth.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "kinetri/algebra/number_types.h"
#include "kinetri/impl/base/check.h"

namespace kinetri {
namespace {

template <class Traits, class Function>
void for_each_disc(const Simulation_2<Traits>& simulation, Function function) {
  const auto& kinetic = simulation.triangulation();
  for (Point_id id = 0; id < kinetic.next_id(); ++id) {
    if (kinetic.contains(id)) function(kinetic.motion(id));
  }
}

template <class Traits>
const Box_2& box_of(const Simulation_2<Traits>& simulation) {
  KINETRI_PRECONDITION(simulation.options().box.has_value(), "there is no box to be covered");
  return *simulation.options().box;
}

// Whether the sum of the areas is at least `area`; may be false by the rounding of pi only.
template <class Traits>
bool do_cover(const Simulation_2<Traits>& simulation, const Rational& area, double time) {
  static_assert(std::numbers::pi == 0x1.921fb54442d18p+1);  // which is less than pi
  Rational squares = 0;
  for_each_disc(simulation, [&](const auto& disc) {
    const Rational radius =
        to_rational(disc.radius) +
        to_rational(disc.growth) * (to_rational(time) - to_rational(disc.epoch));
    if (radius > 0) squares += radius * radius;
  });
  return squares * to_rational(std::numbers::pi) >= area;
}

// About the time in which the sum of the squared radii, squares + 2 mixed t + rates t^2, increases
// by `more`. May be infinite, or NaN.
double time_of_increase(double more, double mixed, double rates) {
  const double root = std::sqrt(mixed * mixed + rates * std::max(more, 0.0));
  // Avoids cancellation.
  return mixed < 0 ? (root - mixed) / rates : more / (mixed + root);
}

}  // namespace

template <class Traits>
double covered_share(const Simulation_2<Traits>& simulation) {
  const Box_2& box = box_of(simulation);
  const double now = simulation.current_time().to_double();
  double squares = 0;
  for_each_disc(simulation, [&](const auto& disc) {
    const double radius = rounded_radius(disc, now);
    squares += radius * radius;
  });
  return std::numbers::pi * squares / ((box.xmax - box.xmin) * (box.ymax - box.ymin));
}

template <class Traits>
std::optional<double> time_of_share(const Simulation_2<Traits>& simulation, double share) {
  KINETRI_PRECONDITION(share > 0 && std::isfinite(share), "the share is not positive and finite");
  const Box_2& box = box_of(simulation);
  const Rational area = to_rational(share) * (to_rational(box.xmax) - to_rational(box.xmin)) *
                        (to_rational(box.ymax) - to_rational(box.ymin));
  const double now = simulation.current_time().tight_interval().upper;
  if (do_cover(simulation, area, now)) return now;
  double squares = 0;
  double mixed = 0;
  double rates = 0;
  for_each_disc(simulation, [&](const auto& disc) {
    const double radius = rounded_radius(disc, now);
    squares += radius * radius;
    mixed += radius * disc.growth;
    rates += disc.growth * disc.growth;
  });
  const double more = to_double(area) / std::numbers::pi - squares;
  double time = now + time_of_increase(more, mixed, rates);
  // A time that is too early by roundings is increased by more and more of them.
  constexpr double rounding = std::numeric_limits<double>::epsilon();
  for (double step = rounding;; step *= 2) {
    if (!std::isfinite(time)) return std::nullopt;
    if (time > now && do_cover(simulation, area, time)) return time;
    time += step * std::max({std::abs(time), time - now, std::numeric_limits<double>::min()});
  }
}

template <class Traits>
double mean_radius(const Simulation_2<Traits>& simulation, double time) {
  double sum = 0;
  std::size_t number = 0;
  for_each_disc(simulation, [&](const auto& disc) {
    sum += rounded_radius(disc, time);
    ++number;
  });
  KINETRI_PRECONDITION(number > 0, "the mean radius of no discs");
  return sum / static_cast<double>(number);
}

template <class Traits>
bool does_disc_fill_box(const Simulation_2<Traits>& simulation, double time) {
  if (!simulation.options().box) return false;
  const Box_2& box = *simulation.options().box;
  const Rational side = std::min<Rational>(to_rational(box.xmax) - to_rational(box.xmin),
                                           to_rational(box.ymax) - to_rational(box.ymin));
  bool result = false;
  for_each_disc(simulation, [&](const auto& disc) {
    if (result || !(disc.growth > 0)) return;
    const Rational radius =
        to_rational(disc.radius) +
        to_rational(disc.growth) * (to_rational(time) - to_rational(disc.epoch));
    result = 2 * radius >= side;
  });
  return result;
}

void Jam_watch::after_event(const Event& event) {
  if (event.kind != Event_kind::wall && event.kind != Event_kind::collision) return;
  for (const auto& id : {event.point_a, event.point_b}) {
    if (!id) continue;
    if (*id >= contacts_of_discs_.size()) contacts_of_discs_.resize(*id + 1);
    ++contacts_of_discs_[*id];
  }
}

void Jam_watch::find_jammed_discs() {
  jammed_discs_.clear();
  std::uint64_t most = 0;
  for (const std::uint64_t contacts : contacts_of_discs_) most = std::max(most, contacts);
  for (Point_id id = 0; id < contacts_of_discs_.size() && most > 0; ++id) {
    if (contacts_of_discs_[id] >= (most + 1) / 2) jammed_discs_.push_back(id);
  }
  std::ranges::fill(contacts_of_discs_, std::uint64_t{0});
}

// The mean growth of the radii that is still missing.
template <class Traits>
double Jam_watch::growth_to_come(const Simulation_2<Traits>& simulation) const {
  const double now = simulation.current_time().to_double();
  if (!end_) return mean_radius_ - mean_radius(simulation, now);
  double sum = 0;
  std::size_t number = 0;
  for_each_disc(simulation, [&](const auto& disc) {
    sum += std::max(disc.growth, 0.0) * (*end_ - now);
    ++number;
  });
  return number > 0 ? sum / static_cast<double>(number) : 0;
}

template <class Traits>
bool Jam_watch::look(const Simulation_2<Traits>& simulation, std::uint64_t contacts) {
  constexpr std::uint64_t contacts_of_each = 32;
  // A few discs may touch often without being jammed, as a light one between heavy ones.
  constexpr std::uint64_t fewest = 10'000;
  constexpr double part = 0.25;
  const double now = simulation.current_time().to_double();
  double speeds = 0;
  std::uint64_t number = 0;
  for_each_disc(simulation, [&](const auto& disc) {
    const Vector_2 v = rounded_velocity(disc, now);
    speeds += std::hypot(v.x, v.y);
    ++number;
  });
  const bool is_first = !time_;
  // The mean path: the mean speed over the mean rate of contacts of a disc.
  const double path =
      is_first ? 0 : speeds * (now - *time_) / static_cast<double>(contacts - contacts_);
  contacts_ = contacts;
  time_ = now;
  next_ = contacts + std::max(fewest, contacts_of_each * number);
  find_jammed_discs();
  return !is_first && number > 0 && path < part * growth_to_come(simulation);
}

template double covered_share(const Simulation_2<Disc_kinetic_traits_2>&);
template double covered_share(const Simulation_2<Polynomial_disc_kinetic_traits_2>&);
template std::optional<double> time_of_share(const Simulation_2<Disc_kinetic_traits_2>&, double);
template std::optional<double> time_of_share(const Simulation_2<Polynomial_disc_kinetic_traits_2>&,
                                             double);
template bool does_disc_fill_box(const Simulation_2<Disc_kinetic_traits_2>&, double);
template bool does_disc_fill_box(const Simulation_2<Polynomial_disc_kinetic_traits_2>&, double);
template double mean_radius(const Simulation_2<Disc_kinetic_traits_2>&, double);
template double mean_radius(const Simulation_2<Polynomial_disc_kinetic_traits_2>&, double);
template bool Jam_watch::look(const Simulation_2<Disc_kinetic_traits_2>&, std::uint64_t);
template bool Jam_watch::look(const Simulation_2<Polynomial_disc_kinetic_traits_2>&, std::uint64_t);
template bool Jam_watch::look(const Simulation_2<Periodic_disc_kinetic_traits_2>&, std::uint64_t);

}  // namespace kinetri
