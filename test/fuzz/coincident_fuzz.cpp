// SPDX-License-Identifier: GPL-3.0-or-later
//
// A tiny triangulation from bytes that keeps coincident points, with points or weighted points:
// after each change beside an oracle that decides in rationals which points coincide.
#include "fuzz/fuzz.h"
#include "support/coincident_runs.h"

namespace {

template <class Kinetic>
void run(kinetri::test::Fuzz_input& input) {
  constexpr int steps = 8;
  const std::string problem =
      kinetri::test::Coincident_run<Kinetic, kinetri::test::Fuzz_input>(input).problem(steps);
  kinetri::test::require(problem.empty(), problem);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  kinetri::test::Fuzz_input input(data, size);
  if (input.integer(0, 1) == 0) {
    run<kinetri::Kinetic_delaunay_triangulation_2<>>(input);
  } else {
    run<kinetri::Kinetic_regular_triangulation_2<>>(input);
  }
  return 0;
}
