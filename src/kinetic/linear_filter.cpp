// SPDX-License-Identifier: GPL-3.0-or-later
//
// The filter works with the polynomial of the certificate in w, where the time is origin + w *
// window and 0 <= w <= 1. `size` bounds the difference of any two of the points in either
// coordinate, over the whole window; the errors below are in units of 2^-53 * size^degree and are
// derived in docs/MATH.md, section 7. An overflow on the way shows in the sizes, which are out of
// range then, and the verdict is unknown.
#include "kinetri/kinetic/linear_filter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "coordinate_pair.h"

namespace kinetri {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double unit_roundoff = 0x1p-53;

// Sizes, slopes and windows outside of this range might under- or overflow on their way to the
// fourth power.
constexpr double least_size = 0x1p-200;
constexpr double greatest_size = 0x1p200;

bool is_in_range(double x) {
  return x > least_size && x < greatest_size;
}

// The window is this share of the time in which the points would pass their distance from one
// another at their relative speed: long enough that most certificates are replaced before it ends.
constexpr double window_share = 0.5;

// A failure later than this share of the window is not looked for yet: probably the certificate is
// replaced before it comes.
constexpr double worthwhile = 0.18;

constexpr int max_depth = 8;

template <std::size_t N>
using Coefficients = std::array<double, N + 1>;

// The difference of two linear motions: place + slope * (time - origin).
struct Difference {
  Pair place;
  Pair slope;
};

// Bounds for the differences that a polynomial is made from, by coordinate.
struct Magnitudes {
  Pair terms = {};   // the sum of all numbers that the places were made from
  Pair extent = {};  // of the places
  Pair slope = {};

  void add(const Difference& d) {
    extent = greater(absolute(d.place), extent);
    slope = greater(absolute(d.slope), slope);
  }
};

Difference difference_from_two_epochs(const Linear_motion_2& p, const Linear_motion_2& q,
                                      double origin, Magnitudes& m) {
  const Pair moved_p = pair(p.velocity) * (origin - p.epoch);
  const Pair moved_q = pair(q.velocity) * (origin - q.epoch);
  m.terms += absolute(pair(p.position)) + absolute(moved_p);
  m.terms += absolute(pair(q.position)) + absolute(moved_q);
  return {(pair(p.position) + moved_p) - (pair(q.position) + moved_q),
          pair(p.velocity) - pair(q.velocity)};
}

inline Difference difference(const Linear_motion_2& p, const Linear_motion_2& q, double origin,
                             Magnitudes& m) {
  Difference d;
  if (p.epoch == q.epoch) {
    // Taking the difference first keeps the coordinates' common part out of the error.
    d.slope = pair(p.velocity) - pair(q.velocity);
    const Pair place = pair(p.position) - pair(q.position);
    const Pair moved = d.slope * (origin - q.epoch);
    m.terms += absolute(place) + absolute(moved);
    d.place = place + moved;
  } else {
    d = difference_from_two_epochs(p, q, origin, m);
  }
  m.add(d);
  return d;
}

template <std::size_t M>
inline double least(const std::array<double, M>& c) {
  double result = c[0];
  for (std::size_t i = 1; i < M; ++i) result = std::min(result, c[i]);
  return result;
}

// The Bernstein coefficients over [0, 1].
Coefficients<4> bernstein(const Coefficients<4>& c) {
  const double c1 = c[1] * 0.25;
  const double c2 = c[2] * (1.0 / 6);
  const double c3 = c[3] * 0.25;
  const double b1 = c[0] + c1;
  const double b2 = b1 + c1 + c2;
  const double b3 = c[0] + 3 * c1 + 3 * c2 + c3;
  const double b4 = c[0] + c[1] + c[2] + c[3] + c[4];
  return {c[0], b1, b2, b3, b4};
}
Coefficients<3> bernstein(const Coefficients<3>& c) {
  const double c1 = c[1] * (1.0 / 3);
  const double c2 = c[2] * (1.0 / 3);
  const double b1 = c[0] + c1;
  const double b2 = b1 + c1 + c2;
  return {c[0], b1, b2, c[0] + c[1] + c[2] + c[3]};
}
Coefficients<2> bernstein(const Coefficients<2>& c) {
  return {c[0], c[0] + 0.5 * c[1], c[0] + c[1] + c[2]};
}
Coefficients<1> bernstein(const Coefficients<1>& c) {
  return {c[0], c[0] + c[1]};
}

template <std::size_t M>
double value(const std::array<double, M>& c, double w) {
  double result = c[M - 1];
  for (std::size_t i = M - 1; i-- > 0;) result = result * w + c[i];
  return result;
}

template <std::size_t M>
double slope(const std::array<double, M>& c, double w) {
  double result = static_cast<double>(M - 1) * c[M - 1];
  for (std::size_t i = M - 1; i-- > 1;) result = result * w + static_cast<double>(i) * c[i];
  return result;
}

// De Casteljau's algorithm at one half: `b` becomes the left half, the right half is returned.
template <std::size_t M>
std::array<double, M> split(std::array<double, M>& b) {
  std::array<double, M> right;
  for (std::size_t i = 0; i < M; ++i) {
    right[M - 1 - i] = b[M - 1];
    for (std::size_t j = M - 1; j > i; --j) b[j] = 0.5 * (b[j - 1] + b[j]);
  }
  return right;
}

// Narrows the only root in [lower, upper], at which the polynomial goes from positive to negative,
// by Newton's method from `w` with bisection as its guard, and certifies the bracket by the signs
// at its ends. Returns false if the ends cannot be certified.
template <std::size_t M>
bool bracket_root(const std::array<double, M>& c, double error, double w, double& lower,
                  double& upper) {
  double low = lower;
  double high = upper;
  double derivative = slope(c, w);
  for (int i = 0; i < 12; ++i) {
    const double v = value(c, w);
    if (std::abs(v) <= error) break;
    (v > 0 ? low : high) = w;
    double next = w - v / derivative;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (next == w) break;
    w = next;
    derivative = slope(c, w);
  }
  // The values grow linearly beside a simple root: twice the error from there they are certain.
  double distance = std::max(3 * error / std::abs(derivative), 4 * unit_roundoff * w);
  for (int i = 0; i < 6; ++i, distance *= 4) {
    const double left = std::max(w - distance, lower);
    const double right = std::min(w + distance, upper);
    if (value(c, left) > error && value(c, right) < -error) {
      lower = left;
      upper = right;
      return true;
    }
  }
  return false;
}

// Up to which share of its interval a polynomial, given by Bernstein coefficients that are known up
// to `error`, is certainly positive: the graph lies above the lower convex hull of the points
// (i / degree, b[i] - error). Zero if it may be negative at the start.
template <std::size_t M>
double positive_share(const std::array<double, M>& b, double error) {
  if (least(b) > error) return 1;
  std::size_t i = 0;
  while (b[i] > error) {
    std::size_t next = i + 1;
    double least = b[next] - b[i];
    for (std::size_t k = i + 2; k < M; ++k) {
      const double rise = (b[k] - b[i]) / static_cast<double>(k - i);
      if (rise < least) {
        least = rise;
        next = k;
      }
    }
    if (!(b[next] > error)) {
      // Rounded down by far more than these operations can err.
      const double crossing = static_cast<double>(i) + (b[i] - error) / -least;
      return crossing / static_cast<double>(M - 1) * (1 - 0x1p-40);
    }
    i = next;
  }
  return 0;
}

// Whether the signs of the coefficients are certain and change just once.
template <std::size_t M>
bool has_one_change(const std::array<double, M>& b, double error) {
  std::size_t i = 0;
  while (i < M && b[i] > error) ++i;
  return i > 0 && i < M &&
         std::all_of(b.begin() + static_cast<std::ptrdiff_t>(i), b.end(),
                     [error](double x) { return x < -error; });
}

// How long the polynomial with coefficients `c` and Bernstein coefficients `b`, each value of which
// over [0, 1] is known up to `error`, is certainly positive; or a bracket of its first root, where
// that is near.
template <std::size_t M>
Filter_verdict first_failure(const std::array<double, M>& c, const std::array<double, M>& b,
                             double error) {
  using Kind = Filter_verdict::Kind;
  struct Piece {
    std::array<double, M> b;
    double lower;
    double width;
    int depth;
  };
  std::array<Piece, max_depth + 1> stack;
  int size = 1;
  stack[0] = {b, 0, 1, 0};
  while (size > 0) {
    Piece piece = stack[static_cast<std::size_t>(--size)];
    const double share = positive_share(piece.b, error);
    if (share == 1) continue;
    const double until = piece.lower + share * piece.width;
    if (until >= worthwhile) return {Kind::holds, {until, until}, piece.depth > 0};
    if (share == 0) return {};
    if (has_one_change(piece.b, error)) {
      double lower = piece.lower;
      double upper = piece.lower + piece.width;
      const double secant = piece.b.front() / (piece.b.front() - piece.b.back());
      if (!bracket_root(c, error, lower + secant * piece.width, lower, upper)) return {};
      return {Kind::fails, {lower, upper}, true};
    }
    if (piece.depth == max_depth) return {};
    const double width = 0.5 * piece.width;
    const std::array<double, M> right = split(piece.b);
    stack[static_cast<std::size_t>(size++)] = {right, piece.lower + width, width, piece.depth + 1};
    stack[static_cast<std::size_t>(size++)] = {piece.b, piece.lower, width, piece.depth + 1};
  }
  return {Kind::holds, {1, 1}, true};
}

// The verdict in time for that in w, rounded to the safe side.
Filter_verdict in_time(const Filter_verdict& v, double origin, double window,
                       const Double_interval& after) {
  // Rounding in origin + w * window is at most one unit in the last place of each of the two. These
  // go at least one further, whatever the rounding mode.
  const auto ulp = [](double x) { return std::abs(x) * 0x1p-52 + 0x1p-1074; };
  const auto down = [ulp](double x) { return x - ulp(x); };
  const auto up = [ulp](double x) { return x + ulp(x); };
  const double lower = down(origin + down(v.bounds.lower * window));
  if (!(lower > after.upper)) return {};
  if (v.kind == Filter_verdict::Kind::holds) return {v.kind, {lower, lower}, v.is_refined};
  const double upper = up(origin + up(v.bounds.upper * window));
  if (v.kind == Filter_verdict::Kind::unknown || !(upper < infinity)) return {};
  return {v.kind, {lower, upper}, v.is_refined};
}

// The window, the sizes that belong to it, and the errors that follow from them.
struct Frame {
  double window = 0;
  double size = 0;
  double total = 0;

  Frame(const Magnitudes& m, double length) : window(length) {
    const double terms = sum(m.terms);
    const double moved = greatest(m.slope) * window;
    total = terms + moved;
    // The last term is more than the error of the extent.
    size = greatest(m.extent) + moved + 0x1p-49 * terms;
  }

  bool is_in_range() const {
    return size > least_size && total < greatest_size &&
           (window == 0 || kinetri::is_in_range(window));
  }
  double in_circle_error() const { return 2048 * unit_roundoff * (size * size) * (size * total); }
  double orientation_error() const { return 256 * unit_roundoff * (size * total); }
};

// The window for looking ahead. Precondition: the slope is in range.
double window_ahead(const Magnitudes& m) {
  return window_share * greatest(m.extent) / greatest(m.slope);
}

// The sum of the coefficients' magnitudes is at most this many times error.
constexpr double in_circle_norm = 12 / (2048 * unit_roundoff);
constexpr double orientation_norm = 4 / (256 * unit_roundoff);

// The verdict on the polynomial with coefficients `c`, whose values are known up to `error`.
template <std::size_t M>
Filter_verdict judge(const std::array<double, M>& c, double error, double window,
                     const Double_interval& after) {
  const std::array<double, M> b = bernstein(c);
  if (least(b) > error) {
    if (least(c) > error) return {Filter_verdict::Kind::holds_for_ever, {}};
    return in_time({Filter_verdict::Kind::holds, {1, 1}}, after.lower, window, after);
  }
  return in_time(first_failure(c, b, error), after.lower, window, after);
}

// Likewise where it has a known root at the time in `after`, of which the next one is wanted.
// `norm` times `error` bounds the sum of the coefficients' magnitudes.
template <std::size_t M>
Filter_verdict judge_after_root(const std::array<double, M>& c, double error, double norm,
                                double window, const Double_interval& after) {
  // c(w) = (w - r) g(w) with 0 <= r <= rest: g has the coefficients c_1, c_2, ... up to an error
  // that r makes, and the next root of c after r is that of g.
  const double rest = 2 * (after.upper - after.lower) / window;
  if (!(rest < 0x1p-10)) return {};
  std::array<double, M - 1> g;
  std::copy(c.begin() + 1, c.end(), g.begin());
  const double error_of_g = error + 2 * norm * error * rest;
  if (least(g) > error_of_g) return {Filter_verdict::Kind::holds_for_ever, {}};
  const std::array<double, M - 1> b = bernstein(g);
  if (least(b) > error_of_g) {
    return in_time({Filter_verdict::Kind::holds, {1, 1}}, after.lower, window, after);
  }
  Filter_verdict verdict = first_failure(g, b, error_of_g);
  if (verdict.kind == Filter_verdict::Kind::fails) {
    // c itself gives the narrower bracket, and the next certificate starts from there.
    auto& [lower, upper] = verdict.bounds;
    bracket_root(c, error, 0.5 * (lower + upper), lower, upper);
  }
  return in_time(verdict, after.lower, window, after);
}

// The verdict on a certificate whose points do not move against each other.
Filter_verdict judge_constant(double value, double error) {
  if (!(value > error)) return {};
  return {Filter_verdict::Kind::holds_for_ever, {}};
}

// The vector products of the places and slopes of two differences, as the polynomial in time that
// is the product of the differences.
struct Product {
  Pair low;     // the coefficients of degree 0 and 1
  double high;  // that of degree 2
};

inline Product vector_product(const Difference& a, const Difference& b) {
  const Pair place = swapped(b.place);
  const Pair slope = swapped(b.slope);
  const Pair pp = a.place * place;
  const Pair ps = a.place * slope;
  const Pair sp = a.slope * place;
  const Pair ss = a.slope * slope;
  const Pair from_place = firsts(pp, ps) - seconds(pp, ps);
  const Pair from_slope = firsts(sp, ss) - seconds(sp, ss);
  return {from_place + Pair{0, from_slope[0]}, from_slope[1]};
}

inline Product squared_length(const Difference& a) {
  const Pair pp = a.place * a.place;
  const Pair ps = a.place * a.slope;
  const Pair half = firsts(pp, ps) + seconds(pp, ps);
  return {half + Pair{0, half[1]}, sum(a.slope * a.slope)};
}

// Minus the in-circle determinant of differences to the fourth point, in powers of w.
inline Coefficients<4> in_circle_coefficients(const std::array<Difference, 3>& d, double window) {
  Pair c01 = {};
  Pair c12 = {};
  Pair c23 = {};
  double c4 = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Product l = squared_length(d[i]);
    const Product m = vector_product(d[(i + 1) % 3], d[(i + 2) % 3]);
    c01 -= l.low[0] * m.low;
    c12 -= l.low[1] * m.low;
    c23 -= l.high * m.low + m.high * l.low;
    c4 -= l.high * m.high;
  }
  const double window_2 = window * window;
  return {c01[0], (c01[1] + c12[0]) * window, (c12[1] + c23[0]) * window_2,
          c23[1] * (window_2 * window), c4 * (window_2 * window_2)};
}

// The orientation of differences to the first point.
Coefficients<2> orientation_coefficients(const std::array<Difference, 2>& d, double window) {
  const Product m = vector_product(d[0], d[1]);
  return {m.low[0], m.low[1] * window, m.high * (window * window)};
}

// The sign of a polynomial all of whose values over [0, 1] are certainly of one sign, else zero.
template <std::size_t M>
Sign certain_sign(const std::array<double, M>& c, double error) {
  const std::array<double, M> b = bernstein(c);
  if (std::ranges::all_of(b, [error](double x) { return x > error; })) return CGAL::POSITIVE;
  if (std::ranges::all_of(b, [error](double x) { return x < -error; })) return CGAL::NEGATIVE;
  return CGAL::ZERO;
}

// The sign of a coordinate of the difference p - q throughout the interval.
Sign certain_coordinate(double value, double slope, const Magnitudes& m,
                        const Double_interval& interval) {
  const double error = 16 * unit_roundoff * sum(m.terms) +
                       2 * std::abs(slope) * (interval.upper - interval.lower) +
                       std::numeric_limits<double>::min();
  if (value > error) return CGAL::POSITIVE;
  if (value < -error) return CGAL::NEGATIVE;
  return CGAL::ZERO;
}

// The frame for a given interval of time.
Frame frame_of(const Magnitudes& m, const Double_interval& interval) {
  return Frame(m, 2 * (interval.upper - interval.lower));
}

// Whether the polynomial over the window can be computed without under- or overflow.
bool is_safe(const Magnitudes& m, const Frame& f) {
  const double slope = greatest(m.slope);
  return f.is_in_range() && (f.window == 0 || slope == 0 || is_in_range(slope));
}

}  // namespace

Filter_verdict filter_in_circle(const Linear_motion_2& p, const Linear_motion_2& q,
                                const Linear_motion_2& r, const Linear_motion_2& s,
                                const Double_interval& after, bool vanishes_at) {
  Magnitudes m;
  const double origin = after.lower;
  const std::array<Difference, 3> d = {difference(p, s, origin, m), difference(q, s, origin, m),
                                       difference(r, s, origin, m)};
  if (!is_in_range(greatest(m.slope))) {
    const Frame f(m, 0);
    if (greatest(m.slope) != 0 || !f.is_in_range()) return {};
    return judge_constant(in_circle_coefficients(d, 0)[0], f.in_circle_error());
  }
  const Frame f(m, window_ahead(m));
  if (!f.is_in_range()) return {};
  const Coefficients<4> c = in_circle_coefficients(d, f.window);
  const double error = f.in_circle_error();
  return vanishes_at ? judge_after_root(c, error, in_circle_norm, f.window, after)
                     : judge(c, error, f.window, after);
}

Filter_verdict filter_orientation(const Linear_motion_2& p, const Linear_motion_2& q,
                                  const Linear_motion_2& r, const Double_interval& after,
                                  bool vanishes_at) {
  Magnitudes m;
  const double origin = after.lower;
  const std::array<Difference, 2> d = {difference(q, p, origin, m), difference(r, p, origin, m)};
  if (!is_in_range(greatest(m.slope))) {
    const Frame f(m, 0);
    if (greatest(m.slope) != 0 || !f.is_in_range()) return {};
    return judge_constant(orientation_coefficients(d, 0)[0], f.orientation_error());
  }
  const Frame f(m, window_ahead(m));
  if (!f.is_in_range()) return {};
  const Coefficients<2> c = orientation_coefficients(d, f.window);
  const double error = f.orientation_error();
  return vanishes_at ? judge_after_root(c, error, orientation_norm, f.window, after)
                     : judge(c, error, f.window, after);
}

Sign certain_x_order(const Linear_motion_2& p, const Linear_motion_2& q,
                     const Double_interval& interval) {
  Magnitudes m;
  const Difference d = difference(p, q, interval.lower, m);
  return certain_coordinate(d.place[0], d.slope[0], m, interval);
}

Sign certain_y_order(const Linear_motion_2& p, const Linear_motion_2& q,
                     const Double_interval& interval) {
  Magnitudes m;
  const Difference d = difference(p, q, interval.lower, m);
  return certain_coordinate(d.place[1], d.slope[1], m, interval);
}

Sign certain_orientation(const Linear_motion_2& p, const Linear_motion_2& q,
                         const Linear_motion_2& r, const Double_interval& interval) {
  Magnitudes m;
  const std::array<Difference, 2> d = {difference(q, p, interval.lower, m),
                                       difference(r, p, interval.lower, m)};
  const Frame f = frame_of(m, interval);
  if (!is_safe(m, f)) return CGAL::ZERO;
  return certain_sign(orientation_coefficients(d, f.window), f.orientation_error());
}

Sign certain_in_circle(const Linear_motion_2& p, const Linear_motion_2& q, const Linear_motion_2& r,
                       const Linear_motion_2& s, const Double_interval& interval) {
  Magnitudes m;
  const std::array<Difference, 3> d = {difference(p, s, interval.lower, m),
                                       difference(q, s, interval.lower, m),
                                       difference(r, s, interval.lower, m)};
  const Frame f = frame_of(m, interval);
  if (!is_safe(m, f)) return CGAL::ZERO;
  return -certain_sign(in_circle_coefficients(d, f.window), f.in_circle_error());
}

bool certainly_never_coincide(const Linear_motion_2& p, const Linear_motion_2& q) {
  Magnitudes m;
  const Difference d = difference(p, q, p.epoch, m);
  const double slope = greatest(m.slope);
  if (slope == 0) return true;
  const double terms = sum(m.terms);
  if (!is_in_range(terms) || !is_in_range(slope)) return false;
  const double cross = vector_product(d, Difference{d.slope, Pair{}}).low[0];
  return std::abs(cross) > 64 * unit_roundoff * (terms * slope);
}

}  // namespace kinetri
