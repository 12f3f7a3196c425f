// SPDX-License-Identifier: GPL-3.0-or-later
#include "outputs/frame_outputs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>

#include "kinetri/impl/io/text.h"
#include "outputs/frame_times.h"
#include "pictures/box_extent.h"

namespace kinetri::app {
namespace {

// The bounding box of the positions at `from` and, with the present motions, at `until`.
template <class Traits>
Box_2 extent_of(const Kinetic_triangulation_2<Traits>& kinetic, double from, double until) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Box_2 extent = {infinity, infinity, -infinity, -infinity};
  for (const auto v : kinetic.triangulation().finite_vertex_handles()) {
    for (const double time : {from, until}) {
      const auto [x, y] = rounded_place(v->point().motion(), time);
      if (!std::isfinite(x) || !std::isfinite(y)) continue;
      extent = {std::min(extent.xmin, x), std::min(extent.ymin, y), std::max(extent.xmax, x),
                std::max(extent.ymax, y)};
    }
  }
  return extent.xmin <= extent.xmax ? extent : Box_2{-1, -1, 1, 1};
}

// Approximately the greatest radius of a disc between the two times, with the present growth.
template <class Traits>
double greatest_radius_of(const Simulation_2<Traits>& simulation, double from, double until) {
  double result = simulation.options().radius;
  if constexpr (HasWeight<typename Traits::Motion>) {
    const auto& kinetic = simulation.triangulation();
    for (Point_id id = 0; id < kinetic.next_id(); ++id) {
      if (!kinetic.contains(id)) continue;
      for (const double time : {from, until}) {
        const double radius = rounded_radius(kinetic.motion(id), time);
        if (std::isfinite(radius)) result = std::max(result, radius);
      }
    }
  }
  return result;
}

// Includes discs if the simulation has them.
template <class Traits>
Frame_2 frame_of_simulation(const Simulation_2<Traits>& simulation) {
  Frame_2 frame = frame_of(simulation.triangulation());
  const double radius = simulation.options().radius;
  if (radius == 0) return frame;
  frame.discs.emplace();
  for (const Point_id id : frame.ids) {
    frame.discs->push_back({radius, simulation.triangulation().is_hidden(id)});
  }
  return frame;
}

std::string frame_name(std::size_t number, const char* extension) {
  const std::string digits = std::to_string(number);
  const std::string zeros(digits.size() < 6 ? 6 - digits.size() : 0, '0');
  return joined("frame_", zeros, digits, ".", extension);
}

}  // namespace

void Frame_outputs::start(const Run_source& source, const Any_simulation& simulation,
                          double until) {
  simulation.visit([&]<class Traits>(const Simulation_2<Traits>& s) {
    const double from = s.current_time().tight_interval().upper;
    times_ = frame_times(from, until, rate_);
    view_.points = s.triangulation().number_of_points();
    view_.radius = greatest_radius_of(s, from, until);
    if constexpr (PeriodicKineticTraits_2<Traits>) {
      view_.extent = extent_of_box(s.triangulation().traits().box(), from, until, view_.points);
    } else {
      const std::optional<Box_2>& box = s.options().box;
      const std::optional<Box_2> known = box ? box : source.extent();
      view_.extent = known ? *known : extent_of(s.triangulation(), from, until);
      view_.box = box;
    }
  });
}

std::optional<double> Frame_outputs::next_time() const {
  if (next_ == times_.size()) return std::nullopt;
  return times_[next_];
}

void Frame_outputs::write(const Any_simulation& simulation) {
  const Frame_2 frame = simulation.visit([](const auto& s) { return frame_of_simulation(s); });
  if (svg_ != nullptr) {
    std::ostringstream picture;
    write_svg_frame(picture, frame, view_);
    svg_->write(frame_name(next_, "svg"), picture.view());
  }
  if (vtu_ != nullptr) {
    std::ostringstream file;
    write_vtu(file, frame);
    series_.push_back({frame.time, frame_name(next_, "vtu")});
    vtu_->write(series_.back().file, file.view());
  }
  ++next_;
}

void Frame_outputs::finish() {
  if (vtu_ == nullptr) return;
  std::ostringstream series;
  write_pvd(series, series_);
  vtu_->write("frames.pvd", series.view());
}

std::optional<Frame_outputs> frame_outputs(Run_outputs& outputs,
                                           const std::optional<Frame_rate>& rate) {
  if (!outputs.has(Output::frames) && !outputs.has(Output::vtu)) return std::nullopt;
  return Frame_outputs(outputs.directory(Output::frames), outputs.directory(Output::vtu), rate);
}

}  // namespace kinetri::app
