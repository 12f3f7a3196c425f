// SPDX-License-Identifier: GPL-3.0-or-later
//
// A small triangulation from bytes, with points or weighted points, most of them on a grid, that
// are moved to other positions in steps of every kind, with other changes and motion between: after
// each step beside a new triangulation of the same motions.
#include "fuzz/fuzz.h"
#include "support/position_runs.h"

namespace {

template <class Kinetic>
void run(kinetri::test::Fuzz_input& input) {
  constexpr int steps = 12;
  const kinetri::test::Position_range range = {40, input.integer(1, 12), input.integer(0, 3) > 0};
  const std::string problem =
      kinetri::test::Position_run<Kinetic, kinetri::test::Fuzz_input>(input, range).problem(steps);
  kinetri::test::require(problem.empty(), problem);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  kinetri::test::Fuzz_input input(data, size);
  if (input.integer(0, 2) > 0) {
    run<kinetri::Kinetic_delaunay_triangulation_2<>>(input);
  } else {
    run<kinetri::Kinetic_regular_triangulation_2<>>(input);
  }
  return 0;
}
