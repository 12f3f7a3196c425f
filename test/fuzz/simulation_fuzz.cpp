// SPDX-License-Identifier: GPL-3.0-or-later
//
// A whole tiny simulation: points and a start from bytes, run with full audits, and once more
// without filters; of few points also against the brute-force simulator.
//
// The first byte says how numbers are read: as small integers, one byte each, as such integers
// times powers of two, two bytes each, or as any binary64 number. The second is the start.
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

bool has_twins(const std::vector<Linear_motion_2>& motions) {
  for (std::size_t i = 0; i < motions.size(); ++i) {
    for (std::size_t j = i + 1; j < motions.size(); ++j) {
      if (same_trajectory(motions[i], motions[j])) return true;
    }
  }
  return false;
}

void check(const std::vector<Linear_motion_2>& motions, const Algebraic_number& start) {
  test::Kinetic_delaunay kinetic(motions, start);
  test::Kinetic_delaunay exact(motions, start, Linear_kinetic_traits_2::exact());
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

}  // namespace
}  // namespace kinetri

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  kinetri::test::Fuzz_input input(data, size);
  const auto numbers = kinetri::read_numbers(input);
  const kinetri::Algebraic_number start(kinetri::Rational(input.integer(-8, 8), 2));
  std::vector<kinetri::Linear_motion_2> motions;
  for (int points = input.integer(0, kinetri::most_points); points > 0; --points) {
    kinetri::Linear_motion_2 m;
    for (double* const x : {&m.position.x, &m.position.y, &m.velocity.x, &m.velocity.y}) {
      *x = kinetri::number(input, numbers);
    }
    motions.push_back(m);
  }
  try {
    kinetri::check(motions, start);
    kinetri::test::require(!kinetri::has_twins(motions), "one trajectory twice, not refused");
    if (motions.size() <= kinetri::points_for_brute_force(numbers)) {
      const auto problem = kinetri::test::difference_from_brute_force(motions, start);
      kinetri::test::require(problem.empty(), problem + "\n" + kinetri::test::describe(motions));
    }
  } catch (const kinetri::Coincident_trajectories_error&) {
    kinetri::test::require(kinetri::has_twins(motions), "refused, though no trajectory is twice");
  }
  return 0;
}
