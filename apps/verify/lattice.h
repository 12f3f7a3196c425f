// SPDX-License-Identifier: GPL-3.0-or-later
// The two vectors of a periodic box, and the images of points. The lemmas named here are in
// README.md.
#ifndef KINETRI_VERIFY_LATTICE_H
#define KINETRI_VERIFY_LATTICE_H

#include "lives.h"

namespace verify {

class Lattice {
 public:
  // Throws Bad_input unless the area of the box, if there is one, is positive at all times.
  Lattice(const Options& options, const Scale& scale) : start_(options.from) {
    for (const Motion& vector : options.lattice) vectors_.push_back(scale.course(vector));
    if (vectors_.empty()) return;
    const Polynomial area = cross(vectors_[0].place, vectors_[1].place);
    if (sign_at(area, start_) <= 0 || !roots_in(area, start_, options.until).empty()) {
      throw Bad_input(
          "the area of the --periodic box is 0 or negative at a time of the run; expected the "
          "second vector to the left of the first one at all times");
    }
  }

  Course moved(Course point, const Offset& by) const {
    if (by == Offset()) return point;
    for (std::size_t i = 0; i < 2; ++i) {
      point.place[i] = point.place[i] + times(vectors_[0].place[i], Integer(by.x)) +
                       times(vectors_[1].place[i], Integer(by.y));
    }
    return point;
  }

  // The image that is in the box at the start. Two points have the same one if and only if their
  // images are the same at all times (Lemma 8), as moves by whole multiples of the two vectors do
  // not change it.
  Course wrapped(const Course& point) const {
    Course result = point;
    for (const std::size_t i : {0UL, 1UL}) {
      const Integer count = count_of(i, point.place, start_);
      for (std::size_t k = 0; k < 2; ++k) {
        result.place[k] = result.place[k] - times(vectors_[i].place[k], count);
      }
    }
    return result;
  }

  // How often vector i is in a place at a time, rounded down.
  Integer count_of(std::size_t i, const Place& place, const Dyadic& time) const {
    const Place& other = vectors_[1 - i].place;
    const Dyadic of_place = value(cross(place, other), time);
    const Dyadic of_vector = value(cross(vectors_[i].place, other), time);
    Integer count;
    mpz_fdiv_q(count.get_mpz_t(), Integer(of_place.m << of_vector.e).get_mpz_t(),
               Integer(of_vector.m << of_place.e).get_mpz_t());
    return count;
  }

  // Twice the area of a triangle over that of the box, if all points were at the origin.
  static Integer area(const Image& a, const Image& b, const Image& c) {
    const Offset u = b.offset - a.offset;
    const Offset v = c.offset - a.offset;
    return Integer(u.x) * Integer(v.y) - Integer(u.y) * Integer(v.x);
  }

 private:
  static Polynomial times(const Polynomial& p, const Integer& factor) {
    return p * trimmed({factor});
  }

  Dyadic start_;
  std::vector<Course> vectors_;
};

}  // namespace verify

#endif  // KINETRI_VERIFY_LATTICE_H
