// SPDX-License-Identifier: GPL-3.0-or-later
//
// Counts of certificates; without exact numbers, for code that only shows the counts.
#ifndef KINETRI_KINETIC_CERTIFICATE_COUNTERS_H
#define KINETRI_KINETIC_CERTIFICATE_COUNTERS_H

#include <cstdint>

#include "kinetri/base/platform.h"

namespace kinetri {

struct Certificate;

/// How many certificates were made, and which means decided each.
struct Certificate_counters {
  std::uint64_t created = 0;          ///< certificates for which something had to be decided
  std::uint64_t root_solves = 0;      ///< certificates for which a root was computed
  std::uint64_t filter_decided = 0;   ///< decided by floating point with a proved error bound
  std::uint64_t refined_decided = 0;  ///< of these, with subdivision or a narrowed root
  std::uint64_t exact_decided = 0;    ///< decided by exact arithmetic

  /// Counts a certificate. Defined in kinetri/kinetic/certificate.h.
  inline void count(const Certificate& certificate);

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

#endif  // KINETRI_KINETIC_CERTIFICATE_COUNTERS_H
