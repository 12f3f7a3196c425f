// SPDX-License-Identifier: GPL-3.0-or-later
#include "outputs/frame_times.h"

#include <cstddef>
#include <utility>

#include "cli/arguments.h"
#include "kinetri/impl/io/text.h"
#include "outputs/regular_times.h"

namespace kinetri::app {
namespace {

constexpr std::size_t usual_intervals = 100;
constexpr std::size_t most_frames = 1'000'000;

[[noreturn]] void refuse(double from, double until, const Frame_rate& rate) {
  throw Usage_error(joined(rate.option, ": ", rate.per_time, " from t = ", from, " to ", until,
                           " are more than ", most_frames, " frames; expected fewer"));
}

}  // namespace

std::vector<double> frame_times(double from, double until, const std::optional<Frame_rate>& rate) {
  if (!rate) return evenly_spaced_times(from, until, usual_intervals);
  auto times = regular_times(from, until, rate->per_time, most_frames);
  if (!times) refuse(from, until, *rate);
  return std::move(*times);
}

std::vector<double> times_of_input(double from, double until, const Frame_rate& rate) {
  auto times = multiples(from, until, rate.per_time, most_frames);
  if (!times) refuse(from, until, rate);
  return std::move(*times);
}

}  // namespace kinetri::app
