// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of the log, and exact times.
#ifndef KINETRI_VERIFY_ROWS_H
#define KINETRI_VERIFY_ROWS_H

#include "files.h"

namespace verify {

inline bool is_of_time_of(const Row& a, const Row& b) {
  return a.time == b.time && compare(a.lo, b.lo) == 0 && compare(a.hi, b.hi) == 0;
}

// The ends of an interval are equal if the time is a binary64 number, and only then.
inline bool is_binary64(const Row& row) {
  return compare(row.lo, row.hi) == 0;
}

inline bool is_in(Time& time, const Row& row) {
  Time lo = exactly(row.lo);
  Time hi = exactly(row.hi);
  const int order = compare(time, lo);
  return is_binary64(row) ? order == 0 : order > 0 && compare(time, hi) < 0;
}

inline std::vector<Time> roots_in(const Polynomial& p, const Row& row) {
  std::vector<Time> roots = roots_in(p, row.lo, row.hi);
  std::erase_if(roots, [&](Time& root) { return !is_in(root, row); });
  return roots;
}

inline bool is_flip(const Row& row) {
  return row.kind == "flip" || row.kind.starts_with("hull");
}

// Whether the time of the row is the binary64 number nearest to the exact one, ties to even.
inline bool is_nearest(Time& exact, const Row& row) {
  if (!is_in(exact, row)) return false;
  if (is_binary64(row)) return true;
  Time time = exactly(dyadic(row.time));
  const int order = compare(exact, time);
  const double infinity = std::numeric_limits<double>::infinity();
  const double other = std::nextafter(row.time, order < 0 ? -infinity : infinity);
  if (order == 0 || std::isinf(other)) return false;  // a binary64 number has no interval
  Time half_way = exactly(middle(time.lo, dyadic(other)));
  const int beyond = order * compare(exact, half_way);
  return beyond < 0 || (beyond == 0 && std::bit_cast<std::uint64_t>(row.time) % 2 == 0);
}

}  // namespace verify

#endif  // KINETRI_VERIFY_ROWS_H
