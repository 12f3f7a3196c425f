// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/simulation/packing.h"

#include <CGAL/enum.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>

#include "kinetri/algebra/number_types.h"
#include "kinetri/impl/base/check.h"
#include "kinetri/simulation/growth.h"
#include "kinetri/simulation/scenarios.h"
#include "kinetri/simulation/simulation_2.h"
#include "simulation/disc_boxes.h"

namespace kinetri {
namespace {

// A stage of the growth: up to the fraction `part` of the final radii, in `steps` steps between
// which velocities are rescaled; the growth of the mean radius is `growth` times the mean speed.
// Dense discs must grow slowly. The numbers were chosen to reach the area fractions in packing.h;
// they are not optimal.
struct Stage {
  double part;
  int steps;
  double growth;
};
constexpr std::array<Stage, 3> stages = {{{0.75, 3, 0.2}, {0.9, 5, 0.04}, {1, 20, 0.015}}};

// Slightly larger radii at the end, so that the discs of the result are apart.
constexpr double enough = 1 + 0x1p-30;

// The traits of a square box, with walls or periodic.
template <class Traits>
Traits traits_of_square(double side) {
  if constexpr (PeriodicKineticTraits_2<Traits>) {
    return Traits({{{side, 0}, {0, 0}, 0}, {{0, side}, {0, 0}, 0}});
  } else {
    return Traits();
  }
}

// The number that differs by a multiple of the side and is at least 0 and less than the side, up to
// rounding.
double wrapped(double x, double side) {
  const double result = x - side * std::floor(x / side);
  return result >= 0 && result < side ? result : 0;
}

template <class Traits>
class Packer {
 public:
  explicit Packer(const Packing_options& options)
      : options_(options),
        side_(options.side.value_or(10 * std::sqrt(static_cast<double>(options.points)))),
        motions_(random_motions(options.seed)),
        radii_(final_radii()),
        mean_radius_(std::accumulate(radii_.begin(), radii_.end(), 0.0) /
                     static_cast<double>(radii_.size())),
        simulation_(points(), simulation_options(), 0, traits_of_square<Traits>(side_)),
        watch_(mean_radius_ * enough) {}

  Packing run() {
    double done = 0;
    for (const auto& [part, steps, growth] : stages) {
      const double begin = done;
      for (int step = 1; step <= steps; ++step) {
        const double end = step == steps ? part : begin + (part - begin) * step / steps;
        grow((end - done) * (end == 1 ? enough : 1), growth);
        done = end;
      }
    }
    return result();
  }

 private:
  static constexpr bool is_periodic = PeriodicKineticTraits_2<Traits>;

  std::vector<Linear_motion_2> random_motions(std::uint64_t seed) const {
    Scenario_options scenario;
    scenario.points = options_.points;
    scenario.seed = seed;
    scenario.side = side_;
    scenario.speed = options_.speed == 0 ? side_ : options_.speed;
    return make_scenario(Scenario::uniform, scenario);
  }

  std::vector<double> final_radii() const {
    std::vector<double> sizes(options_.points, 1.0);
    for (std::size_t i = 1; i < sizes.size(); i += 2) sizes[i] = options_.size_ratio;
    double area = 0;
    for (const double size : sizes) area += std::numbers::pi * size * size;
    const double unit = side_ * std::sqrt(options_.share / area);
    for (double& size : sizes) size *= unit;
    return sizes;
  }

  std::vector<Disc_motion_2> points() const {
    std::vector<Disc_motion_2> result;
    for (const Linear_motion_2& motion : motions_) result.push_back({motion, 0, 0, 0});
    return result;
  }

  Simulation_options simulation_options() const {
    Simulation_options result;
    if (!is_periodic) {
      result.box = box();
      result.rim_touches = true;
    }
    result.response = collide_elastically;
    // Masses are proportional to areas.
    for (const double radius : radii_) {
      const double size = radius / radii_.front();
      result.masses.push_back(size * size);
    }
    return result;
  }

  Box_2 box() const { return {0, 0, side_, side_}; }

  // Lets the radii grow by the fraction `part` of the final ones.
  void grow(double part, double growth) {
    const double now = simulation_.current_time().to_double();
    std::vector<Point_id> ids(options_.points);
    std::iota(ids.begin(), ids.end(), Point_id{0});
    double squares = 0;
    for (const Point_id id : ids) {
      const Vector_2 v = simulation_.triangulation().motion(id).velocity;
      squares += simulation_.mass(id) * (v.x * v.x + v.y * v.y);
    }
    // Scales to the mean energy of a disc of mass 1 and speed 1.
    const double scale = 1 / std::sqrt(squares / static_cast<double>(options_.points));
    std::vector<Disc_motion_2> motions;
    for (const Point_id id : ids) {
      const Disc_motion_2& old = simulation_.triangulation().motion(id);
      Disc_motion_2 motion =
          with_velocity_at(old, {scale * old.velocity.x, scale * old.velocity.y}, now);
      motion.growth = growth * radii_[id] / mean_radius_;
      motions.push_back(motion);
    }
    simulation_.set_motions(ids, motions);
    const double end = now + part * mean_radius_ / growth;
    try {
      while (simulation_.step(Algebraic_number(end)) > 0) {
        if (watch_.is_jammed(simulation_)) {
          throw Packing_error(
              "the discs are jammed before they cover the share; expected a smaller "
              "share");
        }
      }
    } catch (const Own_image_error&) {
      throw Packing_error(
          "a disc meets its own image before the discs cover the share; expected a smaller share, "
          "or "
          "more discs");
    }
    simulation_.advance_to(end);
  }

  Packing result() const {
    const double now = simulation_.current_time().to_double();
    const std::vector<Linear_motion_2> velocities = random_motions(options_.seed + 1);
    Packing packing = {box(), {}};
    for (Point_id id = 0; id < options_.points; ++id) {
      Vector_2 place = rounded_place(simulation_.triangulation().motion(id), now);
      if (is_periodic) place = {wrapped(place.x, side_), wrapped(place.y, side_)};
      const Vector_2 velocity = options_.speed == 0 ? Vector_2() : velocities[id].velocity;
      packing.discs.push_back({{place, velocity, 0}, radii_[id], 0, 0});
    }
    check(packing);
    return packing;
  }

  // A disc, or an image of it, exactly.
  struct Exact_disc {
    Rational x;
    Rational y;
    Rational radius;
  };

  // Exactly, for all pairs whose bounding boxes intersect.
  static void check(const Packing& packing) {
    const Rational side = to_rational(packing.box.xmax);
    std::vector<Exact_disc> discs;
    std::vector<detail::Disc_box> boxes;
    const auto add = [&](const Disc_motion_2& disc, int k, int l) {
      const auto id = static_cast<Point_id>(discs.size());
      boxes.push_back(detail::box_around(about_image(disc, k, l, packing.box), id, 0, {0, 0}));
      discs.push_back({to_rational(disc.position.x) + k * side,
                       to_rational(disc.position.y) + l * side, to_rational(disc.radius)});
    };
    for (const Disc_motion_2& disc : packing.discs) {
      add(disc, 0, 0);
      const auto& [x, y, radius] = discs.back();
      if constexpr (is_periodic) {
        KINETRI_ASSERT(x >= 0 && y >= 0 && x < side && y < side && 2 * radius <= side,
                       "a disc of a packing is outside of the box, or too large for it");
      } else {
        KINETRI_ASSERT(x >= radius && y >= radius && x + radius <= side && y + radius <= side,
                       "a disc of a packing is partly outside of the box");
      }
    }
    if (is_periodic) {
      for (const Disc_motion_2& disc : packing.discs) {
        for_each_image_in(packing.box, disc, [&](int k, int l) { add(disc, k, l); });
      }
    }
    detail::for_each_pair_of_boxes(boxes, [&](Point_id a, Point_id b) {
      const Rational x = discs[a].x - discs[b].x;
      const Rational y = discs[a].y - discs[b].y;
      const Rational contact = discs[a].radius + discs[b].radius;
      KINETRI_ASSERT(x * x + y * y >= contact * contact, "two discs of a packing overlap");
    });
  }

  // A disc that contains the image.
  static Disc_motion_2 about_image(Disc_motion_2 disc, int k, int l, const Box_2& box) {
    disc.position.x += k * box.xmax;
    disc.position.y += l * box.ymax;
    disc.radius += 0x1p-40 * box.xmax;  // more than all roundings
    return disc;
  }

  // The offsets of all other images that may reach into the box. If two images overlap, images of
  // these do so in the box, with centers less than a side away from it.
  template <class Function>
  static void for_each_image_in(const Box_2& box, const Disc_motion_2& disc, Function function) {
    for (int k = -1; k <= 1; ++k) {
      for (int l = -1; l <= 1; ++l) {
        const Disc_motion_2 image = about_image(disc, k, l, box);
        const auto& [x, y] = image.position;
        const double r = image.radius;
        const bool is_within = x + r >= 0 && x - r <= box.xmax && y + r >= 0 && y - r <= box.ymax;
        if ((k != 0 || l != 0) && is_within) function(k, l);
      }
    }
  }

  Packing_options options_;
  double side_;
  std::vector<Linear_motion_2> motions_;
  std::vector<double> radii_;
  double mean_radius_;
  Simulation_2<Traits> simulation_;
  Jam_watch watch_;
};

}  // namespace

Packing make_packing(const Packing_options& options) {
  KINETRI_PRECONDITION(options.points > 0, "a packing of no discs");
  KINETRI_PRECONDITION(options.share > 0 && options.share < 1,
                       "the share of a packing is not between 0 and 1");
  KINETRI_PRECONDITION(options.size_ratio >= 1 && options.size_ratio <= 1000,
                       "the ratio of the sizes of a packing is not from 1 to 1000");
  if (options.is_periodic) return Packer<Periodic_disc_kinetic_traits_2>(options).run();
  return Packer<Disc_kinetic_traits_2>(options).run();
}

}  // namespace kinetri
