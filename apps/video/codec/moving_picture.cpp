// SPDX-License-Identifier: GPL-3.0-or-later
#include "video/codec/moving_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "kinetri/impl/base/check.h"

namespace kinetri::video {
namespace {

std::uint8_t rounded_sample(double value) {
  return static_cast<std::uint8_t>(std::clamp(std::floor(value + 0.5), 0.0, 255.0));
}

}  // namespace

Moving_picture::Moving_picture(const Stream_header& header) : header_(header), points_(header) {}

Vector_2 Moving_picture::position(const Place& place) const {
  const double unit = std::ldexp(1.0, -static_cast<int>(header_.place_bits));
  return {place.x * unit, place.y * unit};
}

Linear_value Moving_picture::color(std::int16_t from, std::int16_t to, std::uint32_t frames) const {
  const double unit = header_.color_step / 8.0;
  const double change = frames == 0 ? 0 : (to - from) * unit / frames;
  return {from * unit, change, static_cast<double>(begin_)};
}

void Moving_picture::set_colors(Point_id id, const Colors& from, const Colors& to,
                                std::uint32_t frames) {
  brightness_->set_values(id, std::array{color(from[0], to[0], frames)});
  if (!color_) return;
  color_->set_values(id, std::array{color(from[1], to[1], frames), color(from[2], to[2], frames)});
}

void Moving_picture::begin(const Key& key) {
  if (triangulation_) advance_to(static_cast<double>(end_));
  points_.follow(key);
  begin_ = end_ = key.frame;
  std::vector<Linear_motion_2> motions;
  const double time = key.frame;
  for (const Node& node : key.points) motions.push_back({position(node.place), {0, 0}, time});
  color_.reset();
  brightness_.reset();
  triangulation_.emplace(motions, Time(time));
  brightness_.emplace(*triangulation_, 1);
  if (header_.format.planes() > 1) color_.emplace(*triangulation_, 2);
  for (const auto& point : points_.points()) {
    set_colors(point.id, point.node.colors, point.node.colors, 0);
  }
}

void Moving_picture::begin(const Group& group) {
  const double time = group.first;
  advance_to(time);
  begin_ = group.first;
  end_ = group.last();
  at_begin_ = points_.at_begin_of(group);
  std::vector<Point_id> ids;
  std::vector<Linear_motion_2> motions;
  const double frames = group.frames;
  for (std::size_t i = 0; i < at_begin_.size(); ++i) {
    const Vector_2 from = position(at_begin_[i].node.place);
    const Vector_2 to = position(group.targets[i].place);
    ids.push_back(at_begin_[i].id);
    motions.push_back({from, {(to.x - from.x) / frames, (to.y - from.y) / frames}, time});
  }
  const std::size_t staying = at_begin_.size() - group.inserted.size();
  triangulation_->erase(group.erased);
  triangulation_->insert(std::span(motions).subspan(staying));
  triangulation_->set_motions(std::span(ids).first(staying), std::span(motions).first(staying));
  points_.follow(group);
  set_colors(group);
}

void Moving_picture::set_colors(const Group& group) {
  KINETRI_ASSERT(at_begin_.size() == group.targets.size(), "the group is another one");
  const std::size_t staying = at_begin_.size() - group.inserted.size();
  for (std::size_t i = staying; i < at_begin_.size(); ++i) {
    at_begin_[i].node.colors = group.inserted[i - staying].colors;
  }
  for (std::size_t i = 0; i < at_begin_.size(); ++i) {
    set_colors(at_begin_[i].id, at_begin_[i].node.colors, group.targets[i].colors, group.frames);
  }
  points_.set_colors(group.targets);
}

void Moving_picture::advance_to(const Time& time) {
  events_ += triangulation_->advance_to(time);
}

void Moving_picture::draw(const Video_format& format, Interpolation style, Frame& frame) const {
  frame = black_frame(format);
  draw_plane(*brightness_, format, 0, style, frame);
  if (color_ && format.planes() > 1) draw_plane(*color_, format, 1, style, frame);
}

void Moving_picture::draw_plane(const Kinetic_field_2<>& field, const Video_format& format,
                                std::size_t plane, Interpolation style, Frame& frame) const {
  const Grid_2 grid = format.grid(plane, header_.format);
  const std::size_t channels = field.channels();
  std::vector<double> values(grid.rows * grid.columns * channels);
  field.raster(grid, style, values);
  for (std::size_t i = 0; i < grid.rows * grid.columns; ++i) {
    for (std::size_t channel = 0; channel < channels; ++channel) {
      frame.planes[plane + channel][i] = rounded_sample(values[i * channels + channel]);
    }
  }
}

}  // namespace kinetri::video
