// SPDX-License-Identifier: GPL-3.0-or-later
//
// Audits: expensive checks that return a report.
#ifndef KINETRI_TRIANGULATION_AUDIT_H
#define KINETRI_TRIANGULATION_AUDIT_H

#include <string>
#include <vector>

#include "kinetri/base/platform.h"

namespace kinetri {

/// The levels of an audit. Each level includes the levels before it. `embedding` and `delaunay`
/// check the exact positions at a rational time strictly between the current time and the next
/// event.
enum class Audit_level {
  links,         ///< links between vertices and faces, the queue, and the references between them
  embedding,     ///< finite triangles are counterclockwise, and the hull, if any, is convex
  delaunay,      ///< every edge is locally Delaunay
  reference,     ///< the edges, and hidden points, are those of a new triangulation just
                 ///< after the current time: by CGAL, in a periodic box by this library
  certificates,  ///< the queue has the next failure of every certificate, or an earlier recheck;
                 ///< it is empty while certificates are deferred
};

/// The result of an audit.
struct Audit_report {
  /// One line for each failure, with the ids of its points. Empty if the audit passed.
  std::vector<std::string> failures;

  /// Whether there are no failures.
  bool passed() const noexcept { return failures.empty(); }
};

namespace detail {

/// Whether the audit passed. Prints the failures to std::cerr if `verbose`.
bool is_passed(const Audit_report& report, bool verbose);

}  // namespace detail

}  // namespace kinetri

#endif  // KINETRI_TRIANGULATION_AUDIT_H
