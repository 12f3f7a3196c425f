// SPDX-License-Identifier: GPL-3.0-or-later
//
// A tiny simulation of discs from bytes, of one size or of any, with masses and radii that grow or
// shrink, some of which come, turn or go, beside the oracle that looks at all pairs: the same
// contacts at the same exact times, and the same motions at the end.
#include <cmath>
#include <vector>

#include "fuzz/fuzz.h"
#include "kinetri/simulation/simulation_2.h"
#include "support/all_pairs_comparison.h"

namespace kinetri {
namespace {

using test::Fuzz_input;
using test::require;

constexpr int size = 6;
constexpr int most_points = 6;
constexpr double until = 4;

// Small integers, or such with a binary fraction.
class Numbers {
 public:
  explicit Numbers(Fuzz_input& input) : input_(input), bits_(input.integer(0, 2) * 8) {}

  double next(int greatest) {
    double result = input_.integer(-greatest, greatest);
    if (bits_ > 0) result += std::ldexp(input_.byte(), -8);
    if (bits_ > 8) result += std::ldexp(input_.byte(), -50);
    return result;
  }
  Vector_2 vector(int greatest) {
    const double x = next(greatest);
    return {x, next(greatest)};
  }

 private:
  Fuzz_input& input_;
  int bits_;
};

void read(Numbers& numbers, Linear_motion_2& motion) {
  motion.position = numbers.vector(size - 1);
  motion.velocity = numbers.vector(2);
}
void read(Numbers& numbers, Polynomial_motion_2& motion) {
  motion.position = numbers.vector(size - 1);
  motion.velocity = numbers.vector(2);
  motion.acceleration = numbers.vector(1);
  motion.jerk = numbers.vector(1);
}

template <class Center>
void read(Numbers& numbers, Basic_disc_motion_2<Center>& disc) {
  read(numbers, static_cast<Center&>(disc));
  disc.radius = std::abs(numbers.next(9)) / 4;
  disc.growth = numbers.next(2) / 8;
  // A radius that changes is rounded down at every contact, and may not become negative.
  if (disc.radius + until * disc.growth <= disc.radius / 64) disc.growth = 0;
}

template <class Traits>
void run(Fuzz_input& input) {
  using Motion = typename Traits::Motion;
  Simulation_options options;
  const auto responses = static_cast<int>(named_responses.size());
  options.response =
      named_responses[static_cast<std::size_t>(input.integer(1, responses - 1))].response;
  if (!HasWeight<Motion>) options.radius = input.integer(1, 8) / 4.0;
  if (input.integer(0, 1) == 0) options.box = Box_2{-size, -size, size, size};
  if (options.box) options.rim_touches = input.integer(0, 3) == 0;
  Numbers numbers(input);
  std::vector<Motion> motions(static_cast<std::size_t>(input.integer(1, most_points)));
  for (Motion& motion : motions) read(numbers, motion);
  if (input.integer(0, 1) == 0) {
    for (std::size_t i = 0; i < motions.size(); ++i) {
      options.masses.push_back(input.integer(1, 16) / 4.0);
    }
  }
  std::vector<test::All_pairs_change<Motion>> changes;
  auto next_id = static_cast<Point_id>(motions.size());
  for (double time = 0; !input.at_end() && time + 0.5 < until;) {
    time += input.integer(1, 4) / 8.0;
    test::All_pairs_change<Motion> change = {time, no_point, std::nullopt};
    const int kind = input.integer(0, 2);
    change.id = kind == 0 ? next_id++
                          : static_cast<Point_id>(input.integer(0, static_cast<int>(next_id) - 1));
    if (kind < 2) {
      change.motion.emplace();
      read(numbers, *change.motion);
      change.motion->epoch = time;
    }
    changes.push_back(change);
  }
  test::All_pairs_totals totals;
  const std::string problem =
      test::difference_from_all_pairs<Traits>(motions, options, changes, until, totals);
  require(problem.empty(), problem);
}

}  // namespace
}  // namespace kinetri

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  kinetri::test::Fuzz_input input(data, size);
  try {
    switch (input.integer(0, 3)) {
      case 0:
        kinetri::run<kinetri::Linear_kinetic_traits_2>(input);
        break;
      case 1:
        kinetri::run<kinetri::Polynomial_kinetic_traits_2>(input);
        break;
      case 2:
        kinetri::run<kinetri::Disc_kinetic_traits_2>(input);
        break;
      default:
        kinetri::run<kinetri::Polynomial_disc_kinetic_traits_2>(input);
    }
  } catch (const kinetri::Outside_box_error&) {  // numbers with fractions, or a rim
  }
  return 0;
}
