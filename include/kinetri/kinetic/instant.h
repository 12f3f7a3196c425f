// SPDX-License-Identifier: GPL-3.0-or-later
//
// An instant: a time and a side of it. "Just after t" means: throughout some open interval that
// begins at t. A structure that is right just after t is right until its next certificate fails.
#ifndef KINETRI_KINETIC_INSTANT_H
#define KINETRI_KINETIC_INSTANT_H

#include <memory>
#include <utility>

#include "kinetri/algebra/algebraic_number.h"

namespace kinetri {

/// A side of a time, or the time itself.
enum class Time_side {
  before,  ///< throughout some open interval that ends at the time
  at,      ///< at the time
  after,   ///< throughout some open interval that begins at the time
};

/// A time and a side of it.
struct Instant {
  Algebraic_number time;           ///< exact
  Time_side side = Time_side::at;  ///< of the time
};

/// The present instant of all traits made from the clock, and of their copies
/// (Basic_instantaneous_traits_2). Only the owner of the clock, which cannot be copied, moves a
/// triangulation with such traits in time.
class Instant_clock {
 public:
  /// Shows the given instant; by default at time 0.
  explicit Instant_clock(Instant instant = {})
      : instant_(std::make_shared<Instant>(std::move(instant))) {}

  Instant_clock(const Instant_clock&) = delete;
  Instant_clock& operator=(const Instant_clock&) = delete;

  /// The present instant.
  const Instant& instant() const { return *instant_; }

  /// Shows another instant. No other thread may use the clock, or traits made from it, meanwhile.
  /// O(1). Structures that use such traits stay right only if no certificate fails in between.
  // NOLINTNEXTLINE(performance-unnecessary-value-param): it is moved
  void set(Instant instant) { *instant_ = std::move(instant); }

  /// The present instant, for users of the clock that may outlive it.
  std::shared_ptr<const Instant> shared_instant() const { return instant_; }

 private:
  std::shared_ptr<Instant> instant_;
};

/// The sign of `p` at the instant. Exact. On one side of a root it is the sign of the first
/// derivative that does not vanish; zero there only for the zero polynomial.
Sign sign_at(const Polynomial& p, const Instant& instant);

}  // namespace kinetri

#endif  // KINETRI_KINETIC_INSTANT_H
