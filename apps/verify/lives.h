// SPDX-License-Identifier: GPL-3.0-or-later
// Certificates, and the intervals of time (lives) in which they must hold. README.md lists the
// certificates.
#ifndef KINETRI_VERIFY_LIVES_H
#define KINETRI_VERIFY_LIVES_H

#include "files.h"

namespace verify {

constexpr Id infinite = static_cast<Id>(-1);  // the point outside of the hull
constexpr Id absent = infinite - 1;

// A point, moved by its offset. There are no others than points themselves without a periodic box.
struct Image {
  Id id;
  Offset offset;
  Image(Id id_of_point = absent, const Offset& by = {}) : id(id_of_point), offset(by) {}
  friend auto operator<=>(const Image&, const Image&) = default;
};

using Place = std::array<Polynomial, 2>;
using Points = std::array<Image, 4>;

inline bool is_at_rest(const Motion& m) {
  return m[growth] == 0 && std::all_of(&m[vx], &m[radius], [](double n) { return n == 0; });
}

// A motion with lengths multiplied by one integer for all points.
struct Course {
  Motion motion;
  Place place;
  Polynomial radius;
};

// An order of trajectories and weights, as polynomials: neither of two is before the other if and
// only if the points coincide at all times (Lemma 8).
struct Is_before {
  bool operator()(const Course* a, const Course* b) const {
    if (a->place != b->place) return a->place < b->place;
    return a->radius != b->radius && a->radius * a->radius < b->radius * b->radius;
  }
};

// Multiplies lengths by one integer, so that positions and radii are polynomials with integer
// coefficients: 2^(bits + degree * time_bits), times 6 for the thirds and halves of motions.
class Scale {
 public:
  Scale(const Options& options, const std::vector<Change>& points, const std::vector<Row>& rows) {
    for (const auto& [side, place] : options.box) bits_ = std::max(bits_, dyadic(place).e);
    const auto note = [&](const Change& change) {
      for (std::size_t i = 0; change.motion && i < numbers; ++i) {
        unsigned long& bits = i == epoch ? time_bits_ : bits_;
        bits = std::max(bits, dyadic((*change.motion)[i]).e);
        if (i >= ax && i <= jy && (*change.motion)[i] != 0) degree_ = 3;
      }
    };
    std::ranges::for_each(points, note);
    for (const Motion& vector : options.lattice) note({0, vector});
    for (const Row& row : rows) std::ranges::for_each(row.changes, note);
    one_ = Integer(degree_ == 3 ? 6 : 1) << (bits_ + degree_ * time_bits_);
  }

  const Integer& one() const { return one_; }
  Integer operator()(double length) const {
    const Dyadic number = dyadic(length);
    return number.m * one_ >> number.e;
  }

  Course course(const Motion& m) const {
    return {m,
            {expansion({m[x], m[vx], m[ax], m[jx]}, m[epoch]),
             expansion({m[y], m[vy], m[ay], m[jy]}, m[epoch])},
            expansion({m[radius], m[growth], 0, 0}, m[epoch])};
  }

 private:
  // c[0] + c[1] s + c[2] s^2 / 2 + c[3] s^3 / 6, s = t - origin.
  Polynomial expansion(const std::array<double, 4>& c, double origin) const {
    constexpr std::array<unsigned long, 4> factorials = {1, 1, 2, 6};
    const Dyadic start = dyadic(origin);
    const Polynomial s = {-start.m << (time_bits_ - start.e), Integer(1) << time_bits_};
    Polynomial result;
    Polynomial power = {1};
    for (unsigned long i = 0; i <= degree_; ++i, power = power * s) {
      result = result + power * trimmed({(*this)(c[i]) / factorials[i] >> (i * time_bits_)});
    }
    return result;
  }

  unsigned long bits_ = 0;
  unsigned long time_bits_ = 0;
  unsigned long degree_ = 1;
  Integer one_;
};

// ---- polynomials of points ----

inline Place minus(const Course& a, const Course& b) {
  return {a.place[0] - b.place[0], a.place[1] - b.place[1]};
}
inline Polynomial cross(const Place& u, const Place& v) {
  return u[0] * v[1] - u[1] * v[0];
}
inline Polynomial dot(const Place& u, const Place& v) {
  return u[0] * v[0] + u[1] * v[1];
}
// Positive if abc is a left turn.
inline Polynomial orientation(const Course& a, const Course& b, const Course& c) {
  return cross(minus(b, a), minus(c, a));
}
// The height of the lifted point above the tangent plane of the lifting at the origin. The lifting
// is x^2 + y^2 - radius^2, perturbed by x y, x^2 and y^2, each times a number infinitely small
// compared with the previous one. The first lifting for which a condition is not identically zero
// decides it (Lemma 7).
constexpr std::array liftings = {0, 1, 2, 3};
inline Polynomial lift(int lifting, const Course& point, const Course& origin,
                       const Place& difference) {
  const auto& [x, y] = difference;
  if (lifting > 0) return lifting == 1 ? x * y : lifting == 2 ? x * x : y * y;
  const Polynomial squared = dot(difference, difference);
  if (point.radius == origin.radius) return squared;
  return squared - (point.radius - origin.radius) * (point.radius + origin.radius);
}
// Positive if d is outside the circle of a, b, c, which are counterclockwise. For discs, it is the
// circle orthogonal to theirs: positive if the power of its center to d is greater than to them.
inline Polynomial outside(const Course& a, const Course& b, const Course& c, const Course& d) {
  const Place u = minus(a, d);
  const Place v = minus(b, d);
  const Place w = minus(c, d);
  for (const int lifting : liftings) {
    const Polynomial p = lift(lifting, a, d, u) * cross(v, w) +
                         lift(lifting, b, d, v) * cross(w, u) +
                         lift(lifting, c, d, w) * cross(u, v);
    if (!p.empty()) return -p;
  }
  return {};
}
// Not negative if b is a corner of a convex hull: abc is a left turn or, if they are always on a
// line, b is between a and c.
inline Polynomial corner(const Course& a, const Course& b, const Course& c) {
  Polynomial p = orientation(a, b, c);
  return p.empty() ? dot(minus(b, a), minus(c, b)) : p;
}
// For three points always on a line: not negative if the others do not hide the middle one.
inline Polynomial above_middle(const Course& a, const Course& middle, const Course& b) {
  const Place u = minus(a, middle);
  const Place v = minus(b, middle);
  const Place w = minus(a, b);
  for (const int lifting : liftings) {
    Polynomial p =
        dot(w, u) * lift(lifting, b, middle, v) - dot(w, v) * lift(lifting, a, middle, u);
    if (!p.empty()) return p;
  }
  return {};
}
// Not negative if two discs are apart.
inline Polynomial gap(const Course& a, const Course& b) {
  const Place u = minus(a, b);
  const Polynomial reach = a.radius + b.radius;
  return dot(u, u) - reach * reach;
}

// ---- certificates ----

enum class Rule { not_negative, positive, no_contact, no_new_contact };
inline bool is_about_contact(Rule rule) {
  return rule == Rule::no_contact || rule == Rule::no_new_contact;
}

struct Certificate {
  std::string name;
  Polynomial p;
  Rule rule;
};

struct Instant {
  Time time;
  long first_row;  // number of the first row at this time, or of the next row
  long rows_end;
  long blamed() const { return rows_end > first_row ? rows_end - 1 : first_row; }
};

enum Kind : std::size_t { edge_life, hidden_life, box_life, kinds };

inline std::string name_of(const Offset& offset) {
  return "(" + std::to_string(offset.x) + ", " + std::to_string(offset.y) + ")";
}

// A certificate's points, none of which changes its motion from birth to death.
struct Life {
  Kind kind;
  Points points;  // of an edge: its ends, the apexes at the left and at the right
  std::array<const Course*, 4> courses;
  std::shared_ptr<const Instant> birth, death;
  bool passes = false;   // whether the discs of an edge pass through each other
  bool goes_on = false;  // whether it must also hold just after its death
};

// Whether two discs, or a point and a wall, make contact at t; they are apart if g is positive.
inline bool is_contact(const Polynomial& g, Time& t) {
  return sign_at(g, t) <= 0 && sign_just_after(derivative(g), t) < 0;
}

class Certifier {
 public:
  Certifier(const Options& options, const Scale& scale) : options_(options), scale_(scale) {
    for (const auto& [side, place] : options.box) sides_[side] = trimmed({scale(place)});
  }

  // The distances of the point from the sides of the box, positive inside.
  std::map<std::size_t, Polynomial> clearances(const Course& point) const {
    std::map<std::size_t, Polynomial> result;
    for (const auto& [side, place] : sides_) {
      Polynomial p = point.place[side % 2] - place;
      if (side > 1) p = -std::move(p);
      result[side] = options_.has_rim ? p - point.radius : p;
    }
    return result;
  }

  // The polynomial that is negative when an edge has to be flipped.
  static Polynomial decider(const Life& edge) {
    const auto [a, b, l, r] = edge.courses;
    if (b == nullptr) return corner(*r, *a, *l);
    if (l == nullptr) return r == nullptr ? Polynomial() : orientation(*b, *a, *r);
    return r == nullptr ? orientation(*a, *b, *l) : outside(*a, *b, *l, *r);
  }

  std::vector<Certificate> certificates(const Life& life) const {
    std::vector<Certificate> result;
    const auto [a, b, c, d] = life.courses;
    const Points& points = life.points;
    const auto name = [&](const char* what, std::initializer_list<std::size_t> of) {
      std::string text = what;
      for (const std::size_t i : of) {
        const auto& [id, offset] = points[i];
        text.append(" ").append(std::to_string(id));
        if (offset != Offset()) text.append(" ").append(name_of(offset));
      }
      return text;
    };
    const auto add_triangle = [&](std::size_t i, std::size_t j, std::size_t apex) {
      if (life.courses[apex] == nullptr || points[apex].id < std::max(points[i].id, points[j].id))
        return;
      result.push_back({name("triangle", {i, j, apex}),
                        orientation(*life.courses[i], *life.courses[j], *life.courses[apex]),
                        Rule::positive});
    };
    if (life.kind == box_life) {
      for (const auto& [side, p] : clearances(*a)) {
        result.push_back({name("the box around point", {0}), p, Rule::not_negative});
      }
    } else if (life.kind == hidden_life) {
      for (const auto& [u, v] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
        result.push_back({name("the triangle of hidden point", {3}), orientation(*u, *v, *d),
                          Rule::not_negative});
      }
      result.push_back({name("hidden point", {3}), outside(*a, *b, *c, *d), Rule::not_negative});
    } else if (b == nullptr) {
      result.push_back({name("hull corner", {3, 0, 2}), decider(life), Rule::positive});
      if (orientation(*d, *a, *c).empty()) {
        result.push_back(
            {name("hull corner", {3, 0, 2}), above_middle(*d, *a, *c), Rule::not_negative});
      }
    } else {
      add_triangle(0, 1, 2);
      add_triangle(1, 0, 3);
      if (c != nullptr && d != nullptr) {
        result.push_back({name("edge", {0, 1}), decider(life), Rule::not_negative});
      }
      if (options_.has_contacts) {
        result.push_back({name("contact of", {0, 1}), gap(*a, *b),
                          life.passes ? Rule::no_new_contact : Rule::no_contact});
      }
    }
    return result;
  }

  // The first failure in (birth, death), with the first row after it.
  std::optional<Refuted> refutation(const Life& life, const std::vector<Row>& rows) const {
    std::optional<Refuted> first;
    const auto note = [&](long row, const Certificate& certificate, Time time) {
      if (first && first->row <= row) return;
      for (int i = 0; i < 60 && !time.f.empty(); ++i) refine(time);
      std::ostringstream message;
      message.precision(17);
      message << certificate.name << " fails at " << approximate(time.hi) << ", before "
              << row_name(row, rows) << ", and stays\n  polynomial " << text(certificate.p)
              << "\n  at a time in [" << approximate(time.lo) << ", " << approximate(time.hi)
              << "]";
      first = Refuted{row, message.str()};
    };
    for (const Certificate& certificate : certificates(life)) {
      const auto& [name, p, rule] = certificate;
      Time birth = life.birth->time;
      Time death = life.death->time;
      const Signs signs(p, birth.lo, death.hi);
      if (signs.inside > 0 && !(life.goes_on && signs.last == 0)) continue;
      const int sign = is_about_contact(rule) ? 1 : sign_just_after(p, birth);
      if (sign < 0 || (sign == 0 && rule == Rule::positive) ||
          (rule == Rule::no_contact && is_contact(p, birth))) {
        note(life.birth->blamed(), certificate, birth);
        continue;
      }
      std::vector<Time> times = roots_in(p, birth.lo, death.hi);
      if (rule == Rule::no_contact) {
        std::ranges::move(roots_in(derivative(p), birth.lo, death.hi), std::back_inserter(times));
      }
      for (Time& time : times) {
        if (compare(time, birth) <= 0 || compare(time, death) >= (life.goes_on ? 1 : 0)) continue;
        if (is_about_contact(rule) ? !is_contact(p, time) : !changes_sign(p, time)) continue;
        if (rule == Rule::no_new_contact && !changes_sign(p, time)) continue;
        const auto row = std::partition_point(rows.begin(), rows.begin() + life.death->first_row,
                                              [&](const Row& before) {
                                                Time hi = exactly(before.hi);
                                                return compare(hi, time) < 0;
                                              });
        note(row - rows.begin(), certificate, time);
      }
    }
    return first;
  }

  // Whether a motion starts where the old one ends at the time of the row, up to rounding;
  // README.md has the conditions.
  bool goes_on(const Course& old, const Course& next, const Row& row) const {
    const Motion& was = old.motion;
    const Motion& is = next.motion;
    const Dyadic t = dyadic(row.time);
    const bool has_stopped = is_at_rest(is);
    if (is[epoch] != row.time || (is[growth] != was[growth] && !has_stopped)) return false;
    const bool is_straight = std::all_of(&was[ax], &was[radius], [](double n) { return n == 0; });
    // At a lower side (1) or an upper one (-1), one component is reversed. The boundary of a disc
    // leaves the side as fast as it came.
    const Integer grown = options_.has_rim ? 2 * scale_(was[growth]) : Integer(0);
    const auto is_turned = [&](std::size_t i, int side) {
      const double before = was[vx + i];
      const double after = is[vx + i];
      return (side > 0 ? after > before : after < before) && is[vy - i] == was[vy - i] &&
             is_nearest(trimmed({side * grown - scale_(before)}), t, after);
    };
    if (row.kind == "wall" && is_straight && !is_turned(0, 1) && !is_turned(0, -1) &&
        !is_turned(1, 1) && !is_turned(1, -1)) {
      return false;
    }
    for (const std::size_t i : {0UL, 1UL}) {
      const Polynomial acceleration = derivative(derivative(old.place[i]));
      if (!is_nearest(old.place[i], t, is[i]) && !is_moved_inside(old, next, i, row)) return false;
      if (has_stopped) continue;
      if (!is_nearest(acceleration, t, is[ax + i]) || is[jx + i] != was[jx + i]) return false;
    }
    if (was[growth] == 0) return is[radius] == was[radius];
    // It is less by at most 2^-44 of the numbers of the motions, which are multiplied by times.
    constexpr std::array<unsigned long, epoch> orders = {0, 0, 1, 1, 2, 2, 3, 3, 0, 1};
    const double longest = std::max({std::abs(row.time), std::abs(was[epoch]), 1.0});
    const auto shift = static_cast<unsigned long>(std::ilogb(longest) + 2);
    Dyadic sum;
    for (std::size_t i = 0; i < epoch; ++i) {
      for (const double number : {was[i], is[i]}) {
        const Dyadic n = dyadic(std::abs(number));
        sum = sum + Dyadic{n.m << (orders[i] * shift), n.e};
      }
    }
    const Dyadic less = value(old.radius, t) + Dyadic{-scale_(is[radius]), 0};
    return less.m >= 0 && compare({less.m << 44, less.e}, {sum.m * scale_.one(), sum.e}) <= 0;
  }

 private:
  // Whether a number is the binary64 number nearest to p at t, ties to even.
  bool is_nearest(const Polynomial& p, const Dyadic& t, double number) const {
    const Dyadic exact = value(p, t);
    for (const int side : {-1, 1}) {
      const double other = std::nextafter(number, side * std::numeric_limits<double>::infinity());
      if (std::isinf(other)) return false;  // the greatest number is not a valid position
      const Dyadic half_way = middle(dyadic(number), dyadic(other));
      const int order = side * compare(exact, {half_way.m * scale_.one(), half_way.e});
      if (order > 0 || (order == 0 && std::bit_cast<std::uint64_t>(number) % 2 != 0)) return false;
    }
    return true;
  }

  // Whether a coordinate is the first binary64 number, inward from the position on the old motion,
  // at which the point is inside for all times in the interval of the row.
  bool is_moved_inside(const Course& old, const Course& next, std::size_t i, const Row& row) const {
    const Polynomial moved = trimmed({scale_(next.motion[i])}) - old.place[i];
    const int direction = sign_at(moved, dyadic(row.time));
    for (const std::size_t side : {i, i + 2}) {
      if (!sides_.contains(side) || direction != (side > 1 ? -1 : 1)) continue;
      const auto is_inside = [&](double number) {
        if (std::isinf(number)) return false;
        const Dyadic shift =
            dyadic(number) + Dyadic{-dyadic(next.motion[i]).m, dyadic(next.motion[i]).e};
        Polynomial p = clearances(next).at(side);
        p.resize(4);
        for (Integer& c : p) c <<= shift.e;
        p[0] += (side > 1 ? -1 : 1) * shift.m * scale_.one();
        return std::ranges::all_of(bernstein(p, row.lo, row.hi),
                                   [](const Integer& c) { return c >= 0; });
      };
      const double infinity = (side > 1 ? 1 : -1) * std::numeric_limits<double>::infinity();
      if (is_inside(next.motion[i]) && !is_inside(std::nextafter(next.motion[i], infinity)))
        return true;
    }
    return false;
  }

  Options options_;
  const Scale& scale_;
  std::map<std::size_t, Polynomial> sides_;
};

}  // namespace verify

#endif  // KINETRI_VERIFY_LIVES_H
