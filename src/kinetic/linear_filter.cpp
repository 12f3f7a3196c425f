// SPDX-License-Identifier: GPL-3.0-or-later
//
// The filter works with the polynomial of the certificate in w, where the time is origin + w *
// window and 0 <= w <= 1. `size` bounds the difference of any two of the points in either
// coordinate, over the whole window; the errors below are in units of 2^-53 * size^degree and are
// derived in docs/MATH.md, section 7. Where a number overflows a comparison is false, and the
// verdict is unknown.
#include "kinetri/kinetic/linear_filter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace kinetri {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double unit_roundoff = 0x1p-53;

// Sizes outside of this range might under- or overflow on their way to the fourth power. With all
// slopes that matter at least 2^-1022 / 2^-200 times smaller than a size, what underflows is far
// below the error.
constexpr double least_size = 0x1p-200;
constexpr double greatest_size = 0x1p200;

// The window is this share of the time in which the points would pass their distance from one
// another at their relative speed: long enough that most certificates are replaced before it ends.
constexpr double window_share = 0.4;

// A failure later than this share of the window is not looked for yet: probably the certificate is
// replaced before it comes.
constexpr double worthwhile = 0.3;

constexpr int max_depth = 8;

template <std::size_t N>
using Coefficients = std::array<double, N + 1>;

// The difference of two linear motions, place + slope * u with u the time from the origin, and
// bounds on its size.
struct Difference {
  double x, y;              // at the origin
  double slope_x, slope_y;  // per unit of time
};

struct Magnitudes {
  double place = 0;  // of x and y, and of all the numbers they were made from
  double slope = 0;
};

double max_abs(double a, double b) {
  return std::max(std::abs(a), std::abs(b));
}

// Taking the difference first keeps the coordinates' common part out of the error.
inline Difference difference_from_one_epoch(const Linear_motion_2& p, const Linear_motion_2& q,
                                            double elapsed, Magnitudes& magnitudes) {
  const double x = p.position.x - q.position.x;
  const double y = p.position.y - q.position.y;
  const double slope_x = p.velocity.x - q.velocity.x;
  const double slope_y = p.velocity.y - q.velocity.y;
  const double moved_x = slope_x * elapsed;
  const double moved_y = slope_y * elapsed;
  magnitudes.place = std::max(magnitudes.place, max_abs(x, y) + max_abs(moved_x, moved_y));
  magnitudes.slope = std::max(magnitudes.slope, max_abs(slope_x, slope_y));
  return {x + moved_x, y + moved_y, slope_x, slope_y};
}

Difference difference_from_two_epochs(const Linear_motion_2& p, const Linear_motion_2& q,
                                      double origin, Magnitudes& magnitudes) {
  const double elapsed_p = origin - p.epoch;
  const double elapsed_q = origin - q.epoch;
  const double moved_px = p.velocity.x * elapsed_p;
  const double moved_py = p.velocity.y * elapsed_p;
  const double moved_qx = q.velocity.x * elapsed_q;
  const double moved_qy = q.velocity.y * elapsed_q;
  const double slope_x = p.velocity.x - q.velocity.x;
  const double slope_y = p.velocity.y - q.velocity.y;
  const double place = max_abs(p.position.x, p.position.y) + max_abs(moved_px, moved_py) +
                       max_abs(q.position.x, q.position.y) + max_abs(moved_qx, moved_qy);
  magnitudes.place = std::max(magnitudes.place, place);
  magnitudes.slope = std::max(magnitudes.slope, max_abs(slope_x, slope_y));
  return {(p.position.x + moved_px) - (q.position.x + moved_qx),
          (p.position.y + moved_py) - (q.position.y + moved_qy), slope_x, slope_y};
}

inline Difference difference(const Linear_motion_2& p, const Linear_motion_2& q, double origin,
                             Magnitudes& magnitudes) {
  return p.epoch == q.epoch ? difference_from_one_epoch(p, q, origin - q.epoch, magnitudes)
                            : difference_from_two_epochs(p, q, origin, magnitudes);
}

double max_abs(const Difference& d) {
  return max_abs(d.x, d.y);
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
  if (std::ranges::all_of(b, [error](double x) { return x > error; })) return 1;
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

// How long the polynomial with coefficients `c`, each value of which over [0, 1] is known up to
// `error`, is certainly positive; or a bracket of its first root, where that is near.
template <std::size_t M>
Filter_verdict first_failure(const std::array<double, M>& c, double error) {
  using Kind = Filter_verdict::Kind;
  struct Piece {
    std::array<double, M> b;
    double lower;
    double width;
    int depth;
  };
  std::array<Piece, max_depth + 1> stack;
  int size = 1;
  stack[0] = {bernstein(c), 0, 1, 0};
  while (size > 0) {
    Piece piece = stack[static_cast<std::size_t>(--size)];
    const double share = positive_share(piece.b, error);
    if (share == 1) continue;
    const double until = piece.lower + share * piece.width;
    if (until >= worthwhile) return {Kind::holds, until, until};
    if (share == 0) return {};
    if (has_one_change(piece.b, error)) {
      double lower = piece.lower;
      double upper = piece.lower + piece.width;
      const double secant = piece.b.front() / (piece.b.front() - piece.b.back());
      if (!bracket_root(c, error, lower + secant * piece.width, lower, upper)) return {};
      return {Kind::fails, lower, upper};
    }
    if (piece.depth == max_depth) return {};
    const double width = 0.5 * piece.width;
    const std::array<double, M> right = split(piece.b);
    stack[static_cast<std::size_t>(size++)] = {right, piece.lower + width, width, piece.depth + 1};
    stack[static_cast<std::size_t>(size++)] = {piece.b, piece.lower, width, piece.depth + 1};
  }
  return {Kind::holds, 1, 1};
}

// The verdict in time for that in w, rounded to the safe side.
Filter_verdict in_time(const Filter_verdict& v, double origin, double window,
                       const Double_interval& after) {
  // Rounding in origin + w * window is at most one unit in the last place of each of the two. These
  // go at least one further, whatever the rounding mode.
  const auto ulp = [](double x) { return std::abs(x) * 0x1p-52 + 0x1p-1074; };
  const auto down = [ulp](double x) { return x - ulp(x); };
  const auto up = [ulp](double x) { return x + ulp(x); };
  switch (v.kind) {
    case Filter_verdict::Kind::unknown:
      return v;
    case Filter_verdict::Kind::holds: {
      const double until = down(origin + down(v.upper * window));
      if (!(until > after.upper)) return {};
      return {Filter_verdict::Kind::holds, until, until};
    }
    case Filter_verdict::Kind::fails:
      break;
  }
  const double lower = down(origin + down(v.lower * window));
  const double upper = up(origin + up(v.upper * window));
  if (!(lower > after.upper) || !(upper < infinity)) return {};
  return {Filter_verdict::Kind::fails, lower, upper};
}

// `units` is the error of a value in units of 2^-53 * scale, `norm` * scale bounds the sum of the
// coefficients' magnitudes.
template <std::size_t M>
Filter_verdict judge(const std::array<double, M>& c, double scale, double units, double norm,
                     double window, const Double_interval& after, bool vanishes_at) {
  const double error = units * unit_roundoff * scale;
  const auto first = vanishes_at ? 1 : 0;
  if (std::all_of(c.begin() + first, c.end(), [error](double x) { return x > error; })) {
    return {Filter_verdict::Kind::holds, infinity, infinity};
  }
  if (!vanishes_at) return in_time(first_failure(c, error), after.lower, window, after);
  // c(w) = (w - r) g(w) with 0 <= r <= rest: g has the coefficients c_1, c_2, ... up to an error
  // that r makes, and the next root of c after r is that of g.
  const double rest = 2 * (after.upper - after.lower) / window;
  if (!(rest < 0x1p-10)) return {};
  std::array<double, M - 1> quotient;
  std::copy(c.begin() + 1, c.end(), quotient.begin());
  Filter_verdict verdict = first_failure(quotient, error + 2 * norm * scale * rest);
  if (verdict.kind == Filter_verdict::Kind::fails) {
    // c itself gives the narrower bracket, and the next certificate starts from there.
    bracket_root(c, error, 0.5 * (verdict.lower + verdict.upper), verdict.lower, verdict.upper);
  }
  return in_time(verdict, after.lower, window, after);
}

// The verdict on a certificate whose points do not move against each other.
Filter_verdict judge_constant(double value, double scale, double units) {
  if (!(value > units * unit_roundoff * scale)) return {};
  return {Filter_verdict::Kind::holds, infinity, infinity};
}

// The window and the sizes that belong to it.
struct Frame {
  double window = 0;
  double size = 0;
  double total = 0;

  bool is_in_range() const { return size > least_size && total < greatest_size; }
  double in_circle_scale() const { return size * size * size * total; }
  double orientation_scale() const { return size * total; }
};

constexpr double in_circle_units = 2048;
constexpr double in_circle_norm = 12;
constexpr double orientation_units = 256;
constexpr double orientation_norm = 4;

// The frame of the given window; the slopes of the differences become those over the window.
template <std::size_t N>
Frame frame(std::array<Difference, N>& differences, const Magnitudes& m, double extent,
            double window) {
  for (Difference& d : differences) {
    d.slope_x *= window;
    d.slope_y *= window;
  }
  // The last term is more than the error of the extent.
  return {window, extent + m.slope * window + 0x1p-49 * m.place, m.place + m.slope * window};
}

template <std::size_t N>
double extent_of(const std::array<Difference, N>& differences) {
  double extent = 0;
  for (const Difference& d : differences) extent = std::max(extent, max_abs(d));
  return extent;
}

// The frame for looking ahead.
template <std::size_t N>
Frame frame_ahead(std::array<Difference, N>& differences, const Magnitudes& m) {
  const double extent = extent_of(differences);
  return frame(differences, m, extent, m.slope == 0 ? 1 : window_share * extent / m.slope);
}

// The frame for a given interval of time.
template <std::size_t N>
Frame frame_of(std::array<Difference, N>& differences, const Magnitudes& m,
               const Double_interval& interval) {
  const double length = interval.upper - interval.lower;
  return frame(differences, m, extent_of(differences), length == 0 ? 0 : 2 * length);
}

// Minus the in-circle determinant of differences to the fourth point.
Coefficients<4> in_circle_coefficients(const std::array<Difference, 3>& d) {
  Coefficients<4> c = {};
  for (std::size_t i = 0; i < 3; ++i) {
    const Difference& a = d[i];
    const Difference& b = d[(i + 1) % 3];
    const Difference& e = d[(i + 2) % 3];
    const double l0 = a.x * a.x + a.y * a.y;
    const double l1 = 2 * (a.x * a.slope_x + a.y * a.slope_y);
    const double l2 = a.slope_x * a.slope_x + a.slope_y * a.slope_y;
    const double m0 = b.x * e.y - b.y * e.x;
    const double m1 = (b.x * e.slope_y - b.y * e.slope_x) + (b.slope_x * e.y - b.slope_y * e.x);
    const double m2 = b.slope_x * e.slope_y - b.slope_y * e.slope_x;
    c[0] -= l0 * m0;
    c[1] -= l0 * m1 + l1 * m0;
    c[2] -= l0 * m2 + l1 * m1 + l2 * m0;
    c[3] -= l1 * m2 + l2 * m1;
    c[4] -= l2 * m2;
  }
  return c;
}

// The orientation of differences to the first point.
Coefficients<2> orientation_coefficients(const std::array<Difference, 2>& d) {
  const auto& [a, b] = d;
  return {a.x * b.y - a.y * b.x,
          (a.x * b.slope_y - a.y * b.slope_x) + (a.slope_x * b.y - a.slope_y * b.x),
          a.slope_x * b.slope_y - a.slope_y * b.slope_x};
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
  const double error = 8 * unit_roundoff * m.place +
                       2 * std::abs(slope) * (interval.upper - interval.lower) +
                       std::numeric_limits<double>::min();
  if (value > error) return CGAL::POSITIVE;
  if (value < -error) return CGAL::NEGATIVE;
  return CGAL::ZERO;
}

}  // namespace

Filter_verdict filter_in_circle(const Linear_motion_2& p, const Linear_motion_2& q,
                                const Linear_motion_2& r, const Linear_motion_2& s,
                                const Double_interval& after, bool vanishes_at) {
  Magnitudes m;
  std::array<Difference, 3> d = {difference(p, s, after.lower, m), difference(q, s, after.lower, m),
                                 difference(r, s, after.lower, m)};
  const Frame f = frame_ahead(d, m);
  if (!f.is_in_range() || !(f.window > 0)) return {};
  const Coefficients<4> c = in_circle_coefficients(d);
  if (m.slope == 0) return judge_constant(c[0], f.in_circle_scale(), in_circle_units);
  return judge(c, f.in_circle_scale(), in_circle_units, in_circle_norm, f.window, after,
               vanishes_at);
}

Filter_verdict filter_orientation(const Linear_motion_2& p, const Linear_motion_2& q,
                                  const Linear_motion_2& r, const Double_interval& after,
                                  bool vanishes_at) {
  Magnitudes m;
  std::array<Difference, 2> d = {difference(q, p, after.lower, m),
                                 difference(r, p, after.lower, m)};
  const Frame f = frame_ahead(d, m);
  if (!f.is_in_range() || !(f.window > 0)) return {};
  const Coefficients<2> c = orientation_coefficients(d);
  if (m.slope == 0) return judge_constant(c[0], f.orientation_scale(), orientation_units);
  return judge(c, f.orientation_scale(), orientation_units, orientation_norm, f.window, after,
               vanishes_at);
}

Sign certain_x_order(const Linear_motion_2& p, const Linear_motion_2& q,
                     const Double_interval& interval) {
  Magnitudes m;
  const Difference d = difference(p, q, interval.lower, m);
  return certain_coordinate(d.x, d.slope_x, m, interval);
}

Sign certain_y_order(const Linear_motion_2& p, const Linear_motion_2& q,
                     const Double_interval& interval) {
  Magnitudes m;
  const Difference d = difference(p, q, interval.lower, m);
  return certain_coordinate(d.y, d.slope_y, m, interval);
}

Sign certain_orientation(const Linear_motion_2& p, const Linear_motion_2& q,
                         const Linear_motion_2& r, const Double_interval& interval) {
  Magnitudes m;
  std::array<Difference, 2> d = {difference(q, p, interval.lower, m),
                                 difference(r, p, interval.lower, m)};
  const Frame f = frame_of(d, m, interval);
  if (!f.is_in_range()) return CGAL::ZERO;
  return certain_sign(orientation_coefficients(d),
                      orientation_units * unit_roundoff * f.orientation_scale());
}

Sign certain_in_circle(const Linear_motion_2& p, const Linear_motion_2& q, const Linear_motion_2& r,
                       const Linear_motion_2& s, const Double_interval& interval) {
  Magnitudes m;
  std::array<Difference, 3> d = {difference(p, s, interval.lower, m),
                                 difference(q, s, interval.lower, m),
                                 difference(r, s, interval.lower, m)};
  const Frame f = frame_of(d, m, interval);
  if (!f.is_in_range()) return CGAL::ZERO;
  return -certain_sign(in_circle_coefficients(d),
                       in_circle_units * unit_roundoff * f.in_circle_scale());
}

bool certainly_never_coincide(const Linear_motion_2& p, const Linear_motion_2& q) {
  Magnitudes m;
  const Difference d = difference(p, q, p.epoch, m);
  if (m.slope == 0) return true;
  if (!(m.place > least_size && m.place < greatest_size)) return false;
  if (!(m.slope > least_size && m.slope < greatest_size)) return false;
  const double cross = d.x * d.slope_y - d.y * d.slope_x;
  return std::abs(cross) > 64 * unit_roundoff * (m.place * m.slope);
}

}  // namespace kinetri
