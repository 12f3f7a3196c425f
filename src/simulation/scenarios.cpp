// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/simulation/scenarios.h"

#include <cmath>
#include <limits>
#include <random>

#include "kinetri/base/ids.h"
#include "kinetri/impl/base/check.h"

namespace kinetri {
namespace {

constexpr double largest_whole_speed = 0x1p53;

bool is_size_or_zero(double x) {
  return x == 0 || is_scenario_size(x);
}

class Generator {
 public:
  explicit Generator(std::uint64_t seed) : bits_(seed) {}

  // Uniform on the multiples of 2^-53 in [0, 1).
  double unit() { return static_cast<double>(bits_() >> 11U) * 0x1p-53; }

  // Uniform in [-bound, bound).
  double symmetric(double bound) { return bound * (2 * unit() - 1); }

  // Uniform on 0, ..., count - 1, but for a bias of count / 2^64.
  std::uint64_t below(std::uint64_t count) { return bits_() % count; }

  // A whole number from -bound to bound.
  double whole(std::uint64_t bound) {
    return static_cast<double>(static_cast<std::int64_t>(below(2 * bound + 1)) -
                               static_cast<std::int64_t>(bound));
  }

  // True with probability exp(-x), 0 <= x <= 1. The length n of the run x > u_1 > u_2 > ... > u_n
  // is at least k with probability x^k / k!, so it is even with probability 1 - x + x^2 / 2 - ...
  // Source: J. von Neumann, Various techniques used in connection with random digits, 1951.
  bool with_probability_exp_minus(double x) {
    bool even = true;
    for (double u = unit(); u < x; u = unit()) {
      even = !even;
      x = u;
    }
    return even;
  }

  // A standard normal number, from comparisons of uniform ones alone.
  // Source: C. F. F. Karney, Sampling exactly from the normal distribution, ACM TOMS 42 (2016),
  // algorithm N: k + x has density proportional to exp(-(k + x)^2 / 2).
  double normal() {
    for (;;) {
      unsigned k = 0;
      while (with_probability_exp_minus(0.5)) ++k;
      if (!repeatedly(k * (k - 1), 0.5)) continue;
      const double x = unit();
      const double step = x * (2 * k + x) / (2 * k + 2);
      if (!repeatedly(k + 1, step)) continue;
      return below(2) == 0 ? k + x : -(k + x);
    }
  }

 private:
  // True with probability exp(-times * x).
  bool repeatedly(unsigned times, double x) {
    for (unsigned i = 0; i < times; ++i) {
      if (!with_probability_exp_minus(x)) return false;
    }
    return true;
  }

  std::mt19937_64 bits_;
};

// A number a + b i of the ring Z[i].
struct Gaussian_integer {
  std::int64_t a = 0;
  std::int64_t b = 0;

  friend Gaussian_integer operator*(Gaussian_integer p, Gaussian_integer q) {
    return {p.a * q.a - p.b * q.b, p.a * q.b + p.b * q.a};
  }
};

// Velocities of exactly one speed. The radius r = 5 13 17 29 37 41 53 < 2^32 is a product of primes
// p = q q' that split in Z[i], so the lattice points on the circle of radius r are the products of
// a unit and of one of q^2, q q', q'^2 for each prime: 4 * 3^7 of them. They are scaled by a number
// with 21 bits, which is exact: r 2^21 < 2^53.
class Directions {
 public:
  explicit Directions(double speed) {
    if (speed == 0) return;
    constexpr double radius = 2576450045.0;
    int exponent = 0;
    const double fraction = std::frexp(speed / radius, &exponent);
    scale_ = std::ldexp(std::floor(std::ldexp(fraction, 21) + 0.5), exponent - 21);
  }

  Vector_2 operator()(Generator& random) const {
    constexpr std::array<Gaussian_integer, 7> primes = {
        {{2, 1}, {3, 2}, {4, 1}, {5, 2}, {6, 1}, {5, 4}, {7, 2}}};
    constexpr std::array<Gaussian_integer, 4> units = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
    Gaussian_integer product = units[random.below(4)];
    for (const Gaussian_integer& prime : primes) {
      const Gaussian_integer conjugate = {prime.a, -prime.b};
      const std::uint64_t choice = random.below(3);
      product = product * (choice == 0 ? conjugate : prime) * (choice == 2 ? prime : conjugate);
    }
    return {scale_ * static_cast<double>(product.a), scale_ * static_cast<double>(product.b)};
  }

 private:
  double scale_ = 0;
};

double side(const Scenario_options& options) {
  return options.side.value_or(10 * std::sqrt(static_cast<double>(options.points)));
}

Vector_2 random_place(double side, Generator& random) {
  const double x = side * random.unit();
  const double y = side * random.unit();
  return {x, y};
}

Vector_2 random_velocity(double speed, Generator& random) {
  const double x = random.symmetric(speed);
  const double y = random.symmetric(speed);
  return {x, y};
}

Vector_2 whole_velocity(std::uint64_t speed, Generator& random) {
  const double x = random.whole(speed);
  const double y = random.whole(speed);
  return {x, y};
}

// Lattice points are numbered row by row.
class Lattice {
 public:
  explicit Lattice(const Scenario_options& options)
      : points_(options.points), spacing_(options.spacing) {
    width_ = static_cast<std::size_t>(std::sqrt(static_cast<double>(points_)));
    if (width_ * width_ < points_) ++width_;
  }

  std::size_t column(std::size_t point) const { return point % width_; }
  std::size_t row(std::size_t point) const { return point / width_; }
  std::size_t middle() const { return row(points_ - 1) / 2 * width_ + width_ / 2; }

  Vector_2 place(std::size_t point) const {
    return {spacing_ * static_cast<double>(column(point)),
            spacing_ * static_cast<double>(row(point))};
  }

 private:
  std::size_t points_;
  std::size_t width_;
  double spacing_;
};

Vector_2 lattice_velocity(std::size_t point, const Lattice& lattice,
                          const Scenario_options& options, Generator& random) {
  const auto speed = static_cast<std::uint64_t>(options.speed);
  switch (options.movers) {
    case Lattice_movers::none:
      return {};
    case Lattice_movers::one: {
      Vector_2 velocity;
      while (point == lattice.middle() && velocity == Vector_2{}) {
        velocity = whole_velocity(speed, random);
      }
      return velocity;
    }
    case Lattice_movers::columns:
      return {0, lattice.column(point) % 2 == 1 ? static_cast<double>(speed) : 0};
    case Lattice_movers::all:
      return whole_velocity(speed, random);
  }
  return {};
}

void check(Scenario scenario, const Scenario_options& options) {
  KINETRI_PRECONDITION(options.points < no_point,
                       "a scenario of too many points; expected fewer than 2^32 - 1");
  KINETRI_PRECONDITION(!options.side || is_scenario_size(*options.side),
                       "the side is out of range; expected a number from 1e-100 to 1e100");
  KINETRI_PRECONDITION(is_size_or_zero(options.speed),
                       "the speed is out of range; expected 0, or a number from 1e-100 to 1e100");
  KINETRI_PRECONDITION(is_scenario_size(options.spacing),
                       "the spacing is out of range; expected a number from 1e-100 to 1e100");
  KINETRI_PRECONDITION(is_size_or_zero(options.jitter),
                       "the jitter is out of range; expected 0, or a number from 1e-100 to 1e100");
  const bool whole = scenario == Scenario::lattice && options.movers != Lattice_movers::none;
  KINETRI_PRECONDITION(
      !whole || (options.speed >= 1 && options.speed <= largest_whole_speed),
      "the speed of a moving lattice is out of range; expected a number from 1 to 2^53");
}

// Calls motion(id) for each point.
template <class Motion>
std::vector<Linear_motion_2> each_point(const Scenario_options& options, Motion motion) {
  std::vector<Linear_motion_2> motions;
  motions.reserve(options.points);
  for (std::size_t id = 0; id < options.points; ++id) motions.push_back(motion(id));
  return motions;
}

// Calls velocity(id) for each point, after drawing its position.
template <class Velocity>
std::vector<Linear_motion_2> in_square(const Scenario_options& options, Generator& random,
                                       Velocity velocity) {
  return each_point(options, [&](std::size_t id) {
    const Vector_2 place = random_place(side(options), random);
    return Linear_motion_2{place, velocity(id), 0};
  });
}

std::vector<Linear_motion_2> gaussian(const Scenario_options& options, Generator& random) {
  const double center = side(options) / 2;
  const double deviation = side(options) / 4;
  return each_point(options, [&](std::size_t) {
    const double x = center + deviation * random.normal();
    const double y = center + deviation * random.normal();
    return Linear_motion_2{{x, y}, random_velocity(options.speed, random), 0};
  });
}

std::vector<Linear_motion_2> lattice_jitter(const Scenario_options& options, Generator& random) {
  const Lattice lattice(options);
  return each_point(options, [&](std::size_t id) {
    const Vector_2 place = lattice.place(id);
    const double x = place.x + random.symmetric(options.jitter);
    const double y = place.y + random.symmetric(options.jitter);
    return Linear_motion_2{{x, y}, random_velocity(options.speed, random), 0};
  });
}

}  // namespace

std::string_view name(Scenario scenario) {
  switch (scenario) {
    case Scenario::uniform:
      return "uniform";
    case Scenario::gaussian:
      return "gaussian";
    case Scenario::constant_speed:
      return "constant-speed";
    case Scenario::one_mover:
      return "one-mover";
    case Scenario::lattice:
      return "lattice";
    case Scenario::lattice_jitter:
      return "lattice-jitter";
  }
  return "unknown";
}

std::string_view name(Lattice_movers movers) {
  switch (movers) {
    case Lattice_movers::none:
      return "none";
    case Lattice_movers::one:
      return "one";
    case Lattice_movers::columns:
      return "columns";
    case Lattice_movers::all:
      return "all";
  }
  return "unknown";
}

std::vector<Linear_motion_2> make_scenario(Scenario scenario, const Scenario_options& options) {
  check(scenario, options);
  Generator random(options.seed);
  switch (scenario) {
    case Scenario::uniform:
      return in_square(options, random,
                       [&](std::size_t) { return random_velocity(options.speed, random); });
    case Scenario::gaussian:
      return gaussian(options, random);
    case Scenario::constant_speed:
      return in_square(options, random, [&, directions = Directions(options.speed)](std::size_t) {
        return directions(random);
      });
    case Scenario::one_mover:
      return in_square(options, random,
                       [&, directions = Directions(options.speed)](std::size_t id) {
                         return id == 0 ? directions(random) : Vector_2{};
                       });
    case Scenario::lattice: {
      const Lattice lattice(options);
      return each_point(options, [&](std::size_t id) {
        return Linear_motion_2{lattice.place(id), lattice_velocity(id, lattice, options, random),
                               0};
      });
    }
    case Scenario::lattice_jitter:
      return lattice_jitter(options, random);
  }
  KINETRI_PRECONDITION(false, "no such scenario; expected one of all_scenarios");
  return {};
}

}  // namespace kinetri
