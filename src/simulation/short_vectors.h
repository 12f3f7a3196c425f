// SPDX-License-Identifier: GPL-3.0-or-later
//
// Shortest vectors of the lattice of a periodic box at one time, exactly; and discs that overlap an
// image of themselves, since they are greater than such a vector.
#ifndef KINETRI_SRC_SIMULATION_SHORT_VECTORS_H
#define KINETRI_SRC_SIMULATION_SHORT_VECTORS_H

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "kinetri/algebra/algebraic_number.h"
#include "kinetri/impl/triangulation/torus_triangulation.h"
#include "kinetri/kinetic/instant.h"
#include "kinetri/simulation/simulation_errors.h"
#include "simulation/shortest_text.h"
#include "triangulation/whole_vectors.h"
#include "triangulation/wrapping.h"

namespace kinetri::detail {

/// A basis (a, b) of the lattice that is reduced in the sense of Lagrange: |a| <= |b|, |b| <= |b +
/// a| and |b| <= |b - a|. So a is a shortest vector of the lattice. Exact.
template <class Traits>
class Short_vectors {
 public:
  using Point_2 = typename Traits::Point_2;

  /// At a time at which the box has an area.
  Short_vectors(const Traits& traits, const Algebraic_number& time)
      : at_(traits.instantaneous_traits(Instant{time, Time_side::at})),
        basis_(Wrapping(traits.box(), time.to_double()).basis()) {
    // Mostly it is reduced already. Each step makes a vector shorter, and no other change longer.
    auto& [a, b] = basis_;
    for (;;) {
      if (is_shorter(b, a)) {
        const Lattice_offset_2 before = a;
        a = b;
        b = reversed(before);
        continue;
      }
      const Lattice_offset_2 less = sum(b, reversed(a));
      const Lattice_offset_2 more = sum(b, a);
      if (is_shorter(less, b)) {
        b = less;
      } else if (is_shorter(more, b)) {
        b = more;
      } else {
        return;
      }
    }
  }

  const Lattice_offset_2& shortest() const { return basis_[0]; }

  // The parallelogram of a and b is at least sqrt(3) / 2 times the shortest vector wide in both
  // directions. So of two positions that are no farther apart than m times that vector is long, the
  // numbers of a, and of b, in them differ by at most 2 m / sqrt(3).

  /// How many times each of a and b two positions are apart: the numbers of a, and of b, in them
  /// differ by less.
  using Steps = std::int64_t;
  /// For positions that are no farther apart than the shortest vector is long.
  static constexpr Steps fewest_steps = 2;
  /// For positions that are at most `distance` apart, up to a relative error of 2^-20. Throws
  /// Periodic_box_error if they are more than 1000, since each disc would have millions of images.
  Steps steps(double distance) const {
    if (length_ == 0) {
      const Point_2 origin(typename Traits::Motion(), no_point);
      const Vector_2 vector =
          rounded_position(center(at_.image(origin, shortest()).motion()), at_.instant().time);
      length_ = std::hypot(vector.x, vector.y);
    }
    // The factor is greater than 2 / sqrt(3), by more than the errors.
    const double most = std::ceil(1.1548 * distance / length_);
    if (!(most <= 1000)) {
      throw Periodic_box_error(
          "two discs touch, or are in range, at a distance of " + text(distance) +
          ", and the shortest lattice vector has the length " + text(length_) +
          ", so that each has millions of images near each other; expected smaller discs, or a "
          "smaller range of their gaps");
    }
    return std::max(static_cast<Steps>(most), fewest_steps);
  }

  /// Calls `function` with the offset of each image of q that is so near to p, and others.
  template <class Function>
  void for_each_near(const Point_2& p, const Point_2& q, Steps steps,
                     const Function& function) const {
    // p is in the parallelogram at the image of q with this offset.
    const Lattice_offset_2 whole = whole_vectors(at_, q, at_.image(p, {}), basis_);
    for_each_around(whole, 1 - steps, steps, function);
  }

  /// The offset of the image of p that is in the parallelogram at the origin.
  Lattice_offset_2 home(const Point_2& p) const {
    const Point_2 origin(typename Traits::Motion(), no_point);
    return reversed(whole_vectors(at_, origin, at_.image(p, {}), basis_));
  }
  /// Calls `function` with the offset of each image of the point at home that is so near to some
  /// position in the parallelogram at the origin, and others.
  template <class Function>
  void for_each_around(const Lattice_offset_2& home, Steps steps, const Function& function) const {
    for_each_around(home, -steps, steps, function);
  }

 private:
  template <class Function>
  void for_each_around(const Lattice_offset_2& offset, Steps least, Steps most,
                       const Function& function) const {
    const auto& [a, b] = basis_;
    for (Steps i = least; i <= most; ++i) {
      for (Steps j = least; j <= most; ++j) {
        function(offset_of_image(offset.x + i * a.x + j * b.x, offset.y + i * a.y + j * b.y));
      }
    }
  }
  bool is_shorter(const Lattice_offset_2& u, const Lattice_offset_2& v) const {
    const Point_2 origin(typename Traits::Motion(), no_point);
    return at_.compare_distance_2_object()(at_.image(origin, {}), at_.image(origin, u),
                                           at_.image(origin, v)) == CGAL::SMALLER;
  }

  typename Traits::Instantaneous_traits at_;
  Lattice_basis_2 basis_;
  mutable double length_ = 0;  // of the shortest vector, rounded; 0 if it is not known
};

/// Throws that a disc and an image of itself overlap or have a contact at a time.
[[noreturn]] inline void throw_own_image_error(const Periodic_image& image,
                                               const Algebraic_number& time) {
  throw Own_image_error(image.id, image.offset, time.detached(),
                        "disc " + std::to_string(image.id) + " meets its own image (" +
                            std::to_string(image.offset.x) + ", " + std::to_string(image.offset.y) +
                            ") at t = " + text(time) +
                            "; expected lattice vectors that stay longer than the diameter: take "
                            "smaller discs or a larger periodic box, or end before that time");
}

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_SIMULATION_SHORT_VECTORS_H
