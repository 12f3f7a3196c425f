// SPDX-License-Identifier: GPL-3.0-or-later
#include "pictures/camera.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kinetri/impl/simulation/playback.h"
#include "pictures/box_extent.h"

namespace kinetri::app {
namespace {

constexpr double outliers = 0.02;  // fraction of the coordinates at each end that may be outside
constexpr double shown_beyond = 0.25;     // fraction of the extent that is added for outliers
constexpr int times_in_motion = 8;        // samples of an accelerated motion
constexpr std::size_t times_in_run = 32;  // samples of all points if the camera follows them
constexpr double most_growth = 1.5;       // of the extent during a run with one extent
constexpr double margin = 28;             // pixels
constexpr double axis_width = 48;         // pixels; enough for the axes with most numbers
constexpr double axis_height = 24;

struct Span {
  double low;
  double high;
};

// Leaves out coordinates that overflow.
void add_finite(double number, std::vector<double>& numbers) {
  if (std::isfinite(number)) numbers.push_back(number);
}

// The span of most of the numbers, with a margin.
Span span_of_most(std::vector<double> numbers) {
  if (numbers.empty()) return {-1, 1};
  std::ranges::sort(numbers);
  const auto last = static_cast<double>(numbers.size() - 1);
  const double low = numbers[static_cast<std::size_t>(std::floor(outliers * last))];
  const double high = numbers[static_cast<std::size_t>(std::ceil((1 - outliers) * last))];
  const double room = shown_beyond * (high - low);
  return {std::max(numbers.front(), low - room), std::min(numbers.back(), high + room)};
}

// The span with discs of the radius; never empty, and of finite size.
Span widened(Span span, double radius, double other_size) {
  span.low -= radius;
  span.high += radius;
  const double least =
      std::max({other_size / 1e3, std::abs(span.low) * 1e-9, std::numeric_limits<double>::min()});
  const double size = span.high - span.low;
  if (size < least) {
    const double half = least > 1e-300 ? least / 2 : 1;
    return {span.low - half, span.high + half};
  }
  return size < std::numeric_limits<double>::infinity() ? span : Span{span.low / 2, span.high / 2};
}

Box_2 extent_of(const std::vector<double>& xs, const std::vector<double>& ys, double radius) {
  const Span x = span_of_most(xs);
  const Span y = span_of_most(ys);
  const double size = std::max(x.high - x.low, y.high - y.low) + 2 * radius;
  const Span wide = widened(x, radius, size);
  const Span high = widened(y, radius, size);
  return {wide.low, high.low, wide.high, high.high};
}

double greater_side(const Box_2& box) {
  return std::max(box.xmax - box.xmin, box.ymax - box.ymin);
}

std::size_t number_of_points(const Recording& recording) {
  std::size_t result = 0;
  for (const Recorded_motion& motion : recording.motions) {
    result = std::max(result, std::size_t{motion.point} + 1);
  }
  return result;
}

// The box, or the extent of all positions in the run.
Box_2 whole_extent(const Viewer_page& page) {
  if (const auto& box = page.recording.periodic_box) {
    return extent_of_box(*box, page.recording.from, page.recording.until,
                         number_of_points(page.recording));
  }
  if (const auto& box = page.settings.box) {
    return extent_of({box->xmin, box->xmax}, {box->ymin, box->ymax}, 0);
  }
  const Recording& recording = page.recording;
  std::vector<double> xs;
  std::vector<double> ys;
  double radius = page.settings.radius;
  // The time at which the next motion of the same point begins.
  std::vector<double> next_begin;
  std::vector<double> end(recording.motions.size(), recording.until);
  for (std::size_t i = recording.motions.size(); i-- > 0;) {
    const auto& [event, id, motion] = recording.motions[i];
    if (next_begin.size() <= id) next_begin.resize(std::size_t{id} + 1, recording.until);
    end[i] = next_begin[id];
    next_begin[id] = event ? recording.events[*event].time.nearest : recording.from;
  }
  for (std::size_t i = 0; i < recording.motions.size(); ++i) {
    const auto& [event, id, motion] = recording.motions[i];
    if (!motion) continue;
    const double begin = event ? recording.events[*event].time.nearest : recording.from;
    const bool is_straight = motion->acceleration == Vector_2() && motion->jerk == Vector_2();
    const int steps = is_straight ? 1 : times_in_motion;
    for (int step = 0; step <= steps; ++step) {
      const Recorded_place place = place_of(*motion, begin + (end[i] - begin) * step / steps);
      add_finite(place.x, xs);
      add_finite(place.y, ys);
      radius = std::max(radius, place.radius);
    }
  }
  return extent_of(xs, ys, radius);
}

}  // namespace

Extents::Extents(const Viewer_page& page)
    : from_(page.recording.from), until_(page.recording.until), whole_(whole_extent(page)) {
  if (!page.settings.box && !page.recording.periodic_box && until_ > from_) sample(page);
}

void Extents::sample(const Viewer_page& page) {
  const Recording& recording = page.recording;
  // If points appear, disappear or change their motions, the camera stays: it would move back and
  // forth.
  if (std::ranges::any_of(recording.motions,
                          [](const Recorded_motion& motion) { return motion.event.has_value(); })) {
    return;
  }
  std::vector<Box_2> samples;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i <= times_in_run; ++i) {
    const double time =
        from_ + (until_ - from_) * static_cast<double>(i) / static_cast<double>(times_in_run);
    std::vector<double> xs;
    std::vector<double> ys;
    double radius = page.settings.radius;
    for (const Recorded_motion& recorded : recording.motions) {
      const Recorded_place place = place_of(*recorded.motion, time);
      add_finite(place.x, xs);
      add_finite(place.y, ys);
      radius = std::max(radius, place.radius);
    }
    samples.push_back(extent_of(xs, ys, radius));
    least = std::min(least, greater_side(samples.back()));
  }
  if (greater_side(whole_) / least > most_growth) samples_ = std::move(samples);
}

Box_2 Extents::at(double time) const {
  if (samples_.empty()) return whole_;
  const double share = (time - from_) / (until_ - from_);
  const double place = share > 0 ? share * times_in_run : 0;  // also 0 if the span overflows
  const std::size_t i = std::min(static_cast<std::size_t>(place), times_in_run - 1);
  const auto between = [&](double Box_2::*side) {
    return samples_[i].*side +
           (samples_[i + 1].*side - samples_[i].*side) * (place - static_cast<double>(i));
  };
  return {between(&Box_2::xmin), between(&Box_2::ymin), between(&Box_2::xmax),
          between(&Box_2::ymax)};
}

void Camera::fit(const Box_2& extent, bool has_axes) {
  const double left = has_axes ? axis_width : 0;
  const double bottom = has_axes ? axis_height : 0;
  const auto room = [](double pixels, double axis) {
    return std::max(pixels - axis - 2 * margin, pixels / 2);
  };
  scale_ = std::min(room(width_, left) / (extent.xmax - extent.xmin),
                    room(height(), bottom) / (extent.ymax - extent.ymin));
  // In the middle of the area beside the axes.
  center(extent.xmin / 2 + extent.xmax / 2 - left / 2 / scale_,
         extent.ymin / 2 + extent.ymax / 2 - bottom / 2 / scale_);
}

void Camera::look(double x, double y, double width) {
  center(x, y);
  scale_ = width_ / width;
}

void Camera::center(double x, double y) {
  x_ = x;
  y_ = y;
}

double Camera::spacing(const Box_2& extent, std::size_t points) const {
  const auto seen = [](double low, double high, double room) {
    return std::max(std::min(high, room) - std::max(low, 0.0), 1.0);
  };
  const double area =
      seen(x(extent.xmin), x(extent.xmax), width_) * seen(y(extent.ymax), y(extent.ymin), height());
  return std::sqrt(area / static_cast<double>(points + 1));
}

double Detail::dot_radius() const {
  return std::clamp(spacing_ / 9, 0.5, 4.5);
}

double Detail::dot_strength() const {
  return std::clamp(spacing_ / 4, 0.25, 1.0);
}

double Detail::edge_strength(bool is_behind) const {
  constexpr double vanish = 2.6;  // distances of neighbors at which edges vanish, and begin to fade
  constexpr double fade = 5.5;
  const double spacing = is_behind ? spacing_ / 3 : spacing_;
  return std::clamp((spacing - vanish) / (fade - vanish), 0.0, 1.0);
}

double Detail::line_width() const {
  return std::clamp(spacing_ / 14, 0.7, 1.4);
}

}  // namespace kinetri::app
