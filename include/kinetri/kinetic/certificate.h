// SPDX-License-Identifier: GPL-3.0-or-later
//
// The certificate: what is known, from some time on, of a condition on moving points that holds as
// long as a polynomial in time is not negative. A traits class makes certificates
// (kinetic_traits_2.h).
#ifndef KINETRI_KINETIC_CERTIFICATE_H
#define KINETRI_KINETIC_CERTIFICATE_H

#include <cstdint>
#include <memory>

#include "kinetri/algebra/algebraic_number.h"
#include "kinetri/impl/base/compiler.h"
#include "kinetri/impl/base/double_interval.h"

namespace kinetri {

/// What is known of a condition from a time t on. The *failure time* is the infimum of the times
/// after t at which the condition is violated: t itself if it is violated just after t; there is
/// none if it is never violated. It is exact.
struct Certificate {
  /// How much is known.
  enum class Kind : std::uint8_t {
    never_fails,  ///< there is no failure time
    holds,        ///< the condition holds up to and at the binary64 number bounds.lower, which is
                  ///< bounds.upper; check it again then
    fails,        ///< the failure time is within `bounds`
    unknown,      ///< floating point does not decide; of batches only (BatchKineticTraits_2)
  };
  /// What decided.
  enum class Means : std::uint8_t {
    none,            ///< nothing had to be decided
    filter,          ///< floating point with a proved error bound
    refined_filter,  ///< the filter, which had to subdivide or to narrow a root
    exact,           ///< exact arithmetic
  };

  Kind kind = Kind::never_fails;  ///< how much is known
  Double_interval bounds = {};    ///< of `holds` and `fails`
  /// The failure time, if it has been made. Otherwise the polynomial of the condition changes its
  /// sign at the failure, and has no other root within `bounds`.
  std::unique_ptr<Algebraic_number> failure = nullptr;
  /// If false, the polynomial is certainly positive from just after t on until it fails.
  bool may_be_zero = false;
  Means means = Means::none;    ///< what decided
  bool is_root_solved = false;  ///< whether a root was computed
};

/// What is known of the polynomial at the start of a certificate, the time t.
enum class Certificate_state : std::uint8_t {
  any,       ///< nothing
  vanishes,  ///< the in-circle or orientation polynomial vanishes at that time, at which its
             ///< negation has failed: the edge has just been flipped
};

/// How many certificates were made, and which means decided each.
struct Certificate_counters {
  std::uint64_t created = 0;          ///< certificates for which something had to be decided
  std::uint64_t root_solves = 0;      ///< certificates for which a root was computed
  std::uint64_t filter_decided = 0;   ///< decided by floating point with a proved error bound
  std::uint64_t refined_decided = 0;  ///< of these, with subdivision or a narrowed root
  std::uint64_t exact_decided = 0;    ///< decided by exact arithmetic

  /// Counts a certificate, without branches, which would be mispredicted.
  KINETRI_ALWAYS_INLINE void count(const Certificate& certificate) {
    const auto means = static_cast<unsigned>(certificate.means);
    const unsigned is_exact = means == static_cast<unsigned>(Certificate::Means::exact) ? 1 : 0;
    const unsigned is_decided = means == static_cast<unsigned>(Certificate::Means::none) ? 0 : 1;
    created += is_decided;
    root_solves += certificate.is_root_solved ? 1 : 0;
    filter_decided += is_decided - is_exact;
    refined_decided += certificate.means == Certificate::Means::refined_filter ? 1 : 0;
    exact_decided += is_exact;
  }

  /// Adds the counts of `other`.
  Certificate_counters& operator+=(const Certificate_counters& other) {
    created += other.created;
    root_solves += other.root_solves;
    filter_decided += other.filter_decided;
    refined_decided += other.refined_decided;
    exact_decided += other.exact_decided;
    return *this;
  }

  friend bool operator==(const Certificate_counters&, const Certificate_counters&) = default;
};

}  // namespace kinetri

#endif  // KINETRI_KINETIC_CERTIFICATE_H
