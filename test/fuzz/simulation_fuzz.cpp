// SPDX-License-Identifier: GPL-3.0-or-later
//
// A whole tiny run: points, or discs with weights, and a start from bytes, run with full audits,
// and once more without filters; of few points also against the brute-force simulator.
//
// The first byte says whether there are weights, the second how numbers are read: as small
// integers, one byte each, as such integers times powers of two, two bytes each, or as any binary64
// number. The third is the start.
#include <bit>
#include <cmath>
#include <sstream>

#include "fuzz/fuzz.h"
#include "support/kinetic_runs.h"
#include "support/same_run.h"

namespace kinetri {
namespace {

using test::Fuzz_input;
using test::require;

constexpr int most_points = 8;
constexpr int most_instants = 40;

enum class Numbers { small, scaled, any };

Numbers read_numbers(Fuzz_input& input) {
  const int choice = input.integer(0, 7);
  return choice < 5 ? Numbers::small : choice < 7 ? Numbers::scaled : Numbers::any;
}

// The brute-force simulator is for few points, of few bits.
std::size_t points_for_brute_force(Numbers numbers) {
  return numbers == Numbers::small ? 6 : numbers == Numbers::scaled ? 4 : 0;
}

double number(Fuzz_input& input, Numbers numbers) {
  switch (numbers) {
    case Numbers::small:
      return input.integer(-4, 4);
    case Numbers::scaled: {
      const int mantissa = input.integer(-8, 8);
      return std::ldexp(mantissa, 10 * input.integer(-10, 10));
    }
    default: {
      const auto value = std::bit_cast<double>(input.word());
      return std::isfinite(value) ? value : 0;
    }
  }
}

void read(Fuzz_input& input, Numbers numbers, Linear_motion_2& motion) {
  for (double* const x :
       {&motion.position.x, &motion.position.y, &motion.velocity.x, &motion.velocity.y}) {
    *x = number(input, numbers);
  }
}
void read(Fuzz_input& input, Numbers numbers, Disc_motion_2& disc) {
  read(input, numbers, static_cast<Linear_motion_2&>(disc));
  for (double* const x : {&disc.radius, &disc.growth, &disc.weight}) *x = number(input, numbers);
}

template <class Motion>
bool do_some_coincide(const std::vector<Motion>& motions) {
  for (std::size_t i = 0; i < motions.size(); ++i) {
    for (std::size_t j = i + 1; j < motions.size(); ++j) {
      if (same_trajectory(motions[i], motions[j])) return true;
    }
  }
  return false;
}

template <class Traits>
void check(const std::vector<typename Traits::Motion>& motions, const Algebraic_number& start) {
  Kinetic_triangulation_2<Traits> kinetic(motions, start);
  Kinetic_triangulation_2<Traits> exact(motions, start, Traits::exact());
  test::Event_recorder one(kinetic);
  test::Event_recorder other(exact);
  for (int i = 0; i < most_instants && kinetic.next_event_time(); ++i) {
    require(kinetic.next_event_time() == exact.next_event_time(), "another time without filters");
    kinetic.step();
    exact.step();
    const std::string problem = test::audit_problem(kinetic, Audit_level::certificates);
    require(problem.empty(), problem);
  }
  const std::string problem = test::difference(one.events, other.events);
  require(problem.empty(), problem);
}

template <class Traits>
void run(Fuzz_input& input) {
  using Motion = typename Traits::Motion;
  const Numbers numbers = read_numbers(input);
  const Algebraic_number start(Rational(input.integer(-8, 8), 2));
  std::vector<Motion> motions(static_cast<std::size_t>(input.integer(0, most_points)));
  for (Motion& motion : motions) read(input, numbers, motion);
  check<Traits>(motions, start);
  if constexpr (!HasWeight<Motion>) {
    if (motions.size() > points_for_brute_force(numbers) || do_some_coincide(motions)) return;
    const std::string problem = test::difference_from_brute_force(motions, start);
    require(problem.empty(), problem + "\n" + test::describe(motions));
  }
}

}  // namespace
}  // namespace kinetri

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  kinetri::test::Fuzz_input input(data, size);
  if (input.integer(0, 1) == 0) {
    kinetri::run<kinetri::Linear_kinetic_traits_2>(input);
  } else {
    kinetri::run<kinetri::Disc_kinetic_traits_2>(input);
  }
  return 0;
}
