// SPDX-License-Identifier: GPL-3.0-or-later
//
// Coordinates of motions, and lengths, scaled to polynomials with integer coefficients, on the heap
// or on the stack.
#ifndef KINETRI_SRC_KINETIC_SCALED_COORDINATES_H
#define KINETRI_SRC_KINETIC_SCALED_COORDINATES_H

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "algebra/static_polynomial.h"
#include "kinetri/kinetic/image_motion_2.h"
#include "kinetri/kinetic/moving_point_2.h"
#include "length.h"

namespace kinetri {

/// A trajectory with such coordinates (Trajectory_2).
template <class Poly>
struct Basic_trajectory_2 {
  Poly x;       ///< w times the x coordinate
  Poly y;       ///< w times the y coordinate
  Poly w;       ///< the common denominator
  Poly weight;  ///< w^2 times the weight
};

/// A length with such a numerator and denominator.
template <class Poly>
struct Basic_length {
  Poly value;  ///< w times the length
  Poly w;      ///< the denominator
};

/// The type of the coefficients of polynomials.
template <class Poly>
using Coefficient_of = std::remove_cvref_t<decltype(std::declval<Poly>()[0])>;

/// mantissa * 2^exponent; zero has the mantissa 0 and any exponent.
template <class Number>
struct Dyadic {
  Number mantissa = 0;
  int exponent = 0;
};

template <class Number>
Dyadic<Number> dyadic(double x) {
  int exponent = 0;
  const double fraction = std::frexp(x, &exponent);
  constexpr int digits = 53;
  return {Number(static_cast<std::int64_t>(std::ldexp(fraction, digits))), exponent - digits};
}

/// Of some nonzero numbers the least exponent, and that of a power of two above every absolute
/// value.
struct Exponents {
  static constexpr int none = 1 << 20;  ///< above those of all products of binary64 numbers here
  int least = none;
  int above = -none;

  template <class Number>
  void add(const Dyadic<Number>& x) {
    if (x.mantissa.is_zero()) return;
    least = std::min(least, x.exponent);
    above = std::max(above, x.exponent + static_cast<int>(bit_length(x.mantissa)));
  }
};

template <class Number>
Number shifted(const Dyadic<Number>& term, int exponent) {
  return term.mantissa.is_zero()
             ? Number(0)
             : Number(term.mantissa << static_cast<unsigned long>(term.exponent - exponent));
}

template <class Number>
Dyadic<Number> product(const Dyadic<Number>& a, const Dyadic<Number>& b) {
  return {a.mantissa * b.mantissa, a.exponent + b.exponent};
}

// The coordinate classes below have `denominator`; `bits_of_sums`, how many bits more than one of
// its terms a coefficient may have; `add_to`, which adds the exponents of their terms; and
// `scaled`, the coordinate times its denominator, divided by 2^exponent. Precondition of `scaled`:
// no nonzero term has a smaller exponent.

/// (position - velocity * epoch) + velocity * t.
template <class Poly>
class Linear_coordinate {
 public:
  using Number = Coefficient_of<Poly>;
  static constexpr int denominator = 1;
  static constexpr int bits_of_sums = 1;

  Linear_coordinate(const Linear_motion_2& motion, double Vector_2::*axis)
      : Linear_coordinate(motion.position.*axis, motion.velocity.*axis, motion.epoch) {}
  Linear_coordinate(double position, double velocity, double epoch)
      : position_(dyadic<Number>(position)), velocity_(dyadic<Number>(velocity)) {
    if (epoch != 0) drift_ = product(velocity_, dyadic<Number>(epoch));
  }

  /// The same times an integer.
  Linear_coordinate times(std::int64_t factor) const {
    Linear_coordinate result = *this;
    for (Dyadic<Number>* term : {&result.position_, &result.velocity_, &result.drift_}) {
      term->mantissa = term->mantissa * Number(factor);
    }
    return result;
  }

  void add_to(Exponents& exponents) const {
    exponents.add(position_);
    exponents.add(velocity_);
    exponents.add(drift_);
  }
  Poly scaled(int exponent) const {
    return {shifted(position_, exponent) - shifted(drift_, exponent), shifted(velocity_, exponent)};
  }

 private:
  Dyadic<Number> position_;
  Dyadic<Number> velocity_;
  Dyadic<Number> drift_;  // velocity * epoch
};

/// The coordinate of a point, plus integers times those of two lattice vectors.
template <class Poly>
class Image_coordinate {
 public:
  static constexpr int denominator = 1;
  static constexpr int bits_of_sums = 3;  // of six terms

  Image_coordinate(const Image_motion_2& image, double Vector_2::*axis)
      : point_(image.motion, axis) {
    if (image.offset.x != 0) {
      first_ = Linear_coordinate<Poly>(image.box->first(), axis).times(image.offset.x);
    }
    if (image.offset.y != 0) {
      second_ = Linear_coordinate<Poly>(image.box->second(), axis).times(image.offset.y);
    }
  }

  void add_to(Exponents& exponents) const {
    point_.add_to(exponents);
    first_.add_to(exponents);
    second_.add_to(exponents);
  }
  Poly scaled(int exponent) const {
    return point_.scaled(exponent) + first_.scaled(exponent) + second_.scaled(exponent);
  }

 private:
  Linear_coordinate<Poly> point_;
  Linear_coordinate<Poly> first_ = {0, 0, 0};
  Linear_coordinate<Poly> second_ = {0, 0, 0};
};

/// The sum of the terms of a length.
template <class Poly>
class Length_coordinate {
 public:
  static constexpr int denominator = 1;
  static constexpr int bits_of_sums = Linear_coordinate<Poly>::bits_of_sums;  // see scaled_together

  explicit Length_coordinate(const Length& length)
      : terms_{coordinate(length.terms[0]), coordinate(length.terms[1]),
               coordinate(length.terms[2])} {}

  void add_to(Exponents& exponents) const {
    for (const Linear_coordinate<Poly>& term : terms_) term.add_to(exponents);
  }
  Basic_length<Poly> scaled(int exponent, Coefficient_of<Poly> w) const {
    return {terms_[0].scaled(exponent) + terms_[1].scaled(exponent) + terms_[2].scaled(exponent),
            Poly{std::move(w)}};
  }

 private:
  static Linear_coordinate<Poly> coordinate(const Length::Term& term) {
    return {term.value, term.rate, term.epoch};
  }

  std::array<Linear_coordinate<Poly>, std::tuple_size_v<decltype(Length::terms)>> terms_;
};

/// 6 p + 6 v s + 3 a s^2 + j s^3 with s = t - epoch, as a polynomial in t.
class Polynomial_coordinate {
 public:
  static constexpr int denominator = 6;
  static constexpr int bits_of_sums = 1;

  Polynomial_coordinate(const Polynomial_motion_2& motion, double Vector_2::*axis) {
    const std::array<Dyadic<Integer>, 4> derivatives = {
        dyadic<Integer>(motion.position.*axis), dyadic<Integer>(motion.velocity.*axis),
        dyadic<Integer>(motion.acceleration.*axis), dyadic<Integer>(motion.jerk.*axis)};
    const Dyadic<Integer> back = dyadic<Integer>(-motion.epoch);
    // In (t - epoch)^k / k! the coefficient of t^i is (-epoch)^(k-i) / (i! (k-i)!).
    constexpr std::array<int, 4> factorials = {1, 1, 2, 6};
    for (std::size_t k = 0; k < 4; ++k) {
      Dyadic<Integer> term = derivatives[k];
      for (std::size_t i = k + 1; i-- > 0;) {
        const int factor = denominator / (factorials[i] * factorials[k - i]);
        terms_[i].push_back({term.mantissa * factor, term.exponent});
        term = product(term, back);
      }
    }
  }

  void add_to(Exponents& exponents) const {
    for (const std::vector<Dyadic<Integer>>& power : terms_) {
      for (const Dyadic<Integer>& term : power) exponents.add(term);
    }
  }
  Polynomial scaled(int exponent) const {
    std::vector<Integer> coefficients(terms_.size());
    for (std::size_t i = 0; i < terms_.size(); ++i) {
      for (const Dyadic<Integer>& term : terms_[i]) coefficients[i] += shifted(term, exponent);
    }
    return Polynomial(std::move(coefficients));
  }

 private:
  std::array<std::vector<Dyadic<Integer>>, 4> terms_;  // by power of t
};

/// Both coordinates of a motion.
template <class Poly, class Coordinate>
struct Coordinates {
  static constexpr int denominator = Coordinate::denominator;
  static constexpr int bits_of_sums = Coordinate::bits_of_sums;
  Coordinate x;
  Coordinate y;

  template <class Motion>
  explicit Coordinates(const Motion& motion) : x(motion, &Vector_2::x), y(motion, &Vector_2::y) {}

  void add_to(Exponents& exponents) const {
    x.add_to(exponents);
    y.add_to(exponents);
  }
  Basic_trajectory_2<Poly> scaled(int exponent, Coefficient_of<Poly> w) const {
    return {x.scaled(exponent), y.scaled(exponent), Poly{std::move(w)}, {}};
  }
};

/// The same with the weight of a disc, scaled by the square of the factor of the coordinates.
/// `Center` has the coordinates of the center.
template <class Poly, class Center>
struct Weighted_coordinates {
  using Number = Coefficient_of<Poly>;
  static constexpr int denominator = Center::denominator;
  static constexpr int bits_of_sums = Center::bits_of_sums;
  Center center;
  Linear_coordinate<Poly> radius;
  Dyadic<Number> weight;

  template <class Disc>
  explicit Weighted_coordinates(const Disc& disc)
      : center(kinetri::center(disc)),
        radius(disc.radius, disc.growth, epoch_of(disc)),
        weight(dyadic<Number>(disc.weight)) {}

  void add_to(Exponents& exponents) const {
    center.add_to(exponents);
    radius.add_to(exponents);
    if (weight.mantissa.is_zero()) return;
    // Twice the least exponent must not exceed that of the weight.
    exponents.least = std::min(exponents.least, floor_of_half(weight.exponent));
    exponents.above = std::max(
        exponents.above,
        floor_of_half(weight.exponent + static_cast<int>(bit_length(weight.mantissa))) + 1);
  }
  Basic_trajectory_2<Poly> scaled(int exponent, Number w) const {
    const Poly scaled_radius = radius.scaled(exponent) * Number(denominator);
    const Number scaled_weight = shifted(weight, 2 * exponent) * Number(denominator * denominator);
    Basic_trajectory_2<Poly> result = center.scaled(exponent, std::move(w));
    result.weight = scaled_radius * scaled_radius + Poly{scaled_weight};
    return result;
  }

 private:
  static int floor_of_half(int x) { return x >= 0 ? x / 2 : -((1 - x) / 2); }
};

template <class Poly>
auto coordinates(const Linear_motion_2& motion) {
  return Coordinates<Poly, Linear_coordinate<Poly>>(motion);
}
template <class Poly>
auto coordinates(const Image_motion_2& image) {
  return Coordinates<Poly, Image_coordinate<Poly>>(image);
}
template <std::same_as<Polynomial> Poly>
auto coordinates(const Polynomial_motion_2& motion) {
  return Coordinates<Poly, Polynomial_coordinate>(motion);
}
template <class Poly, class Center>
auto coordinates(const Basic_disc_motion_2<Center>& disc) {
  return Weighted_coordinates<Poly, decltype(coordinates<Poly>(kinetri::center(disc)))>(disc);
}

template <class Poly>
auto coordinates(const Length& length) {
  return Length_coordinate<Poly>(length);
}

/// A trajectory or length, scaled by the least power of two that makes its coefficients integers.
template <class Given>
auto scaled_alone(const Given& given) {
  const auto one = coordinates<Polynomial>(given);
  Exponents exponents;
  one.add_to(exponents);
  const int exponent = std::min(0, exponents.least);
  return one.scaled(exponent, Integer(one.denominator) << -exponent);
}

/// Trajectories and lengths times one common positive number, and weights times its square, so that
/// w is 1. None if a coefficient of a coordinate could have more than `most_bits` bits; those of
/// weights may have twice as many and one more, those of lengths two more. Precondition: the
/// coordinates have the same denominator.
template <class Poly, class... Given>
auto scaled_together(int most_bits, const Given&... given) {
  const std::tuple all(coordinates<Poly>(given)...);
  return std::apply(
      [&](const auto& first, const auto&... others) {
        constexpr int denominator = std::remove_cvref_t<decltype(first)>::denominator;
        static_assert(((denominator == std::remove_cvref_t<decltype(others)>::denominator) && ...));
        Exponents exponents;
        first.add_to(exponents);
        (others.add_to(exponents), ...);
        using One = Coefficient_of<Poly>;
        using Result =
            std::tuple<decltype(first.scaled(0, One(1))), decltype(others.scaled(0, One(1)))...>;
        constexpr int bits_of_sums =
            std::max({std::remove_cvref_t<decltype(first)>::bits_of_sums,
                      std::remove_cvref_t<decltype(others)>::bits_of_sums...});
        if (exponents.above - exponents.least + bits_of_sums > most_bits) {
          return std::optional<Result>();
        }
        return std::optional<Result>(std::in_place, first.scaled(exponents.least, One(1)),
                                     others.scaled(exponents.least, One(1))...);
      },
      all);
}

}  // namespace kinetri

#endif  // KINETRI_SRC_KINETIC_SCALED_COORDINATES_H
