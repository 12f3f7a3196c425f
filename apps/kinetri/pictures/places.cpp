// SPDX-License-Identifier: GPL-3.0-or-later
#include "pictures/places.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace kinetri::app {
namespace {

constexpr double most_copies = 64;

struct Extent_of_moves {
  double least = std::numeric_limits<double>::infinity();
  double greatest = -std::numeric_limits<double>::infinity();

  void add(double number) {
    least = std::min(least, number);
    greatest = std::max(greatest, number);
  }
  double size() const { return greatest - least + 1; }
};

}  // namespace

Places::Places(const Playback& playback) : all_(playback.places()), periodic_box_(nullptr) {
  const auto& periodic_box = playback.recording().periodic_box;
  if (!periodic_box) return;
  periodic_box_ = &*periodic_box;
  box_.emplace(*periodic_box, playback.time());
  for (Recorded_place& place : all_) {
    images_.push_back(box_->image({place.x, place.y}));
    place.x = images_.back().place.x;
    place.y = images_.back().place.y;
  }
}

Vector_2 Places::shift(Point_id from, const Periodic_image& to) const {
  if (!box_) return {};
  return box_->shift(to.offset, images_[from], images_[to.id]);
}

Recorded_place Places::image(Point_id from, const Periodic_image& to) const {
  Recorded_place result = all_[to.id];
  if (!box_) return result;
  const Vector_2 moved = shift(from, to);
  result.x += moved.x;
  result.y += moved.y;
  return result;
}

Vector_2 Places::move_at(Point_id id, double time) const {
  if (!box_) return {};
  return box_->move(images_[id], rounded_place(periodic_box_->first(), time),
                    rounded_place(periodic_box_->second(), time));
}

Vector_2 Places::rate(Point_id id) const {
  if (!box_) return {};
  return box_->move(images_[id], periodic_box_->first().velocity, periodic_box_->second().velocity);
}

std::vector<Vector_2> Places::copies(std::span<const Vector_2> corners) const {
  if (!box_) return {Vector_2()};
  Extent_of_moves x;
  Extent_of_moves y;
  for (const Vector_2& corner : corners) {
    const Vector_2 moves = box_->image(corner).moves;
    x.add(moves.x);
    y.add(moves.y);
  }
  const auto moved = [this](double i, double j) {
    const Vector_2& u = box_->first();
    const Vector_2& v = box_->second();
    return Vector_2{i * u.x + j * v.x, i * u.y + j * v.y};
  };
  if (!(x.size() * y.size() <= most_copies)) return {moved(x.least, y.least)};
  std::vector<Vector_2> result;
  for (double i = x.least; i <= x.greatest; ++i) {
    for (double j = y.least; j <= y.greatest; ++j) result.push_back(moved(i, j));
  }
  return result;
}

std::vector<Vector_2> Places::disc_copies(Point_id id) const {
  if (!box_) return {};
  const Recorded_place& place = all_[id];
  const Vector_2& u = box_->first();
  const Vector_2& v = box_->second();
  // Of the parallelogram about the disc with the sides of the box.
  const double area = std::abs(u.x * v.y - u.y * v.x);
  const double i = place.radius * std::hypot(v.x, v.y) / area;
  const double j = place.radius * std::hypot(u.x, u.y) / area;
  const auto corner = [&](double k, double l) {
    return Vector_2{place.x + k * u.x + l * v.x, place.y + k * u.y + l * v.y};
  };
  const std::array corners = {corner(-i, -j), corner(i, -j), corner(i, j), corner(-i, j)};
  std::vector<Vector_2> result = copies(corners);
  if (result.size() == 1) return {};  // the disc is in the box, or there are very many
  std::erase(result, Vector_2());
  return result;
}

}  // namespace kinetri::app
