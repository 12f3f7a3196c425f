// SPDX-License-Identifier: GPL-3.0-or-later
// The two vectors of a periodic box, and the images of points. The lemmas named here are in
// README.md.
#ifndef KINETRI_VERIFY_LATTICE_H
#define KINETRI_VERIFY_LATTICE_H

#include "lives.h"

namespace verify {

class Lattice {
 public:
  Lattice(const Options& options, const Scale& scale) {
    for (const Motion& vector : options.lattice) vectors_.push_back(scale.course(vector));
  }

  Course moved(Course point, const Offset& by) const {
    if (by == Offset()) return point;
    for (std::size_t i = 0; i < 2; ++i) {
      point.place[i] = point.place[i] + times(vectors_[0].place[i], Integer(by.x)) +
                       times(vectors_[1].place[i], Integer(by.y));
    }
    return point;
  }

  // The image that is in the box at time 0. Two points have the same one if and only if their
  // images are the same at all times (Lemma 8), as moves by whole multiples of the two vectors do
  // not change it.
  Course wrapped(const Course& point) const {
    Course result = point;
    for (const std::size_t i : {0UL, 1UL}) {  // how often vector i is in the place, rounded down
      const Place& other = vectors_[1 - i].place;
      Integer count;
      mpz_fdiv_q(count.get_mpz_t(), constant(cross(point.place, other)).get_mpz_t(),
                 constant(cross(vectors_[i].place, other)).get_mpz_t());
      for (std::size_t k = 0; k < 2; ++k) {
        result.place[k] = result.place[k] - times(vectors_[i].place[k], count);
      }
    }
    return result;
  }

  // Twice the area of a triangle over that of the box, if all points were at the origin.
  static Integer area(const Image& a, const Image& b, const Image& c) {
    const Offset u = b.offset - a.offset;
    const Offset v = c.offset - a.offset;
    return Integer(u.x) * Integer(v.y) - Integer(u.y) * Integer(v.x);
  }

 private:
  // The value at time 0.
  static Integer constant(const Polynomial& p) { return p.empty() ? Integer(0) : p[0]; }
  static Polynomial times(const Polynomial& p, const Integer& factor) {
    return p * trimmed({factor});
  }

  std::vector<Course> vectors_;
};

}  // namespace verify

#endif  // KINETRI_VERIFY_LATTICE_H
