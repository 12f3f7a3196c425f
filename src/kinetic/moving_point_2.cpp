// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/kinetic/moving_point_2.h"

#include <algorithm>
#include <limits>
#include <ostream>
#include <utility>

#include "kinetri/impl/base/check.h"
#include "kinetri/kinetic/image_motion_2.h"
#include "scaled_coordinates.h"

namespace kinetri {
namespace {

Trajectory_2 on_heap(Basic_trajectory_2<Polynomial> path) {
  return {std::move(path.x), std::move(path.y), std::move(path.w), std::move(path.weight)};
}

std::ostream& operator<<(std::ostream& out, const Vector_2& v) {
  return out << '(' << v.x << ", " << v.y << ')';
}

void print(std::ostream& out, const Linear_motion_2& motion) {
  out << motion.position << " at time " << motion.epoch << ", velocity " << motion.velocity;
}

void print(std::ostream& out, const Polynomial_motion_2& motion) {
  out << motion.position << " at time " << motion.epoch << ", velocity " << motion.velocity
      << ", acceleration " << motion.acceleration << ", jerk " << motion.jerk;
}

void print(std::ostream& out, const Image_motion_2& image) {
  print(out, image.motion);
  out << ", offset (" << image.offset.x << ", " << image.offset.y << ')';
}

template <class Center>
void print(std::ostream& out, const Basic_disc_motion_2<Center>& disc) {
  print(out, center(disc));
  out << ", radius " << disc.radius << ", growth " << disc.growth << ", weight " << disc.weight;
}

}  // namespace

Trajectory_2 trajectory(const Linear_motion_2& motion) {
  return on_heap(scaled_alone(motion));
}
Trajectory_2 trajectory(const Polynomial_motion_2& motion) {
  return on_heap(scaled_alone(motion));
}
Trajectory_2 trajectory(const Image_motion_2& image) {
  return on_heap(scaled_alone(image));
}
Trajectory_2 trajectory(const Image_disc_motion_2& image) {
  return on_heap(scaled_alone(image));
}
Trajectory_2 trajectory(const Disc_motion_2& motion) {
  return on_heap(scaled_alone(motion));
}
Trajectory_2 trajectory(const Polynomial_disc_motion_2& motion) {
  return on_heap(scaled_alone(motion));
}

template <class Motion>
Basic_moving_point_2<Motion>::Basic_moving_point_2(Trajectory_2 trajectory)
    : constructed_(new Trajectory_2(std::move(trajectory))) {
  KINETRI_PRECONDITION(!constructed_->w.is_zero(), "a trajectory whose denominator is zero");
}

template <class Motion>
Trajectory_2 Basic_moving_point_2<Motion>::trajectory() const {
  return has_motion() ? kinetri::trajectory(motion_) : *constructed_;
}

template <class Motion>
Exact_position_2 Basic_moving_point_2<Motion>::position(const Rational& t) const {
  const Trajectory_2 path = trajectory();
  const Rational w = path.w(t);
  KINETRI_PRECONDITION(w != 0, "the point is nowhere at this time");
  return {path.x(t) / w, path.y(t) / w};
}

template <class Motion>
Rational Basic_moving_point_2<Motion>::weight(const Rational& t) const {
  const Trajectory_2 path = trajectory();
  const Rational w = path.w(t);
  KINETRI_PRECONDITION(w != 0, "the point is nowhere at this time");
  return path.weight(t) / (w * w);
}

template <class Motion>
std::ostream& operator<<(std::ostream& out, const Basic_moving_point_2<Motion>& point) {
  const auto precision = out.precision(std::numeric_limits<double>::max_digits10);
  out << "point ";
  if (point.id() != no_point) out << point.id() << ' ';
  if (point.has_motion()) {
    print(out, point.motion());
  } else {
    const Trajectory_2 path = point.trajectory();
    out << "((" << path.x << ") / (" << path.w << "), (" << path.y << ") / (" << path.w << "))";
  }
  out.precision(precision);
  return out;
}

template <std::size_t N, class Motion>
std::array<Trajectory_2, N> common_trajectories(
    const std::array<const Basic_moving_point_2<Motion>*, N>& points) {
  if (!std::ranges::all_of(points, &Basic_moving_point_2<Motion>::has_motion)) {
    std::array<Trajectory_2, N> result;
    std::ranges::transform(points, result.begin(),
                           [](const auto* point) { return point->trajectory(); });
    return result;
  }
  return [&]<std::size_t... I>(std::index_sequence<I...>) {
    auto paths =
        scaled_together<Polynomial>(std::numeric_limits<int>::max(), points[I]->motion()...);
    return std::array<Trajectory_2, N>{on_heap(std::get<I>(std::move(*paths)))...};
  }
  (std::make_index_sequence<N>());
}

#define KINETRI_INSTANTIATE(N, Motion)                                 \
  template std::array<Trajectory_2, N> common_trajectories<N, Motion>( \
      const std::array<const Basic_moving_point_2<Motion>*, N>&)
#define KINETRI_INSTANTIATE_ALL(Motion)                                                      \
  template class Basic_moving_point_2<Motion>;                                               \
  template std::ostream& operator<<(std::ostream& out, const Basic_moving_point_2<Motion>&); \
  KINETRI_INSTANTIATE(2, Motion);                                                            \
  KINETRI_INSTANTIATE(3, Motion);                                                            \
  KINETRI_INSTANTIATE(4, Motion)
KINETRI_INSTANTIATE_ALL(Linear_motion_2);
KINETRI_INSTANTIATE_ALL(Image_motion_2);
KINETRI_INSTANTIATE_ALL(Image_disc_motion_2);
KINETRI_INSTANTIATE_ALL(Polynomial_motion_2);
KINETRI_INSTANTIATE_ALL(Disc_motion_2);
KINETRI_INSTANTIATE_ALL(Polynomial_disc_motion_2);
#undef KINETRI_INSTANTIATE_ALL
#undef KINETRI_INSTANTIATE

}  // namespace kinetri
