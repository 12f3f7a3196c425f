// SPDX-License-Identifier: GPL-3.0-or-later
//
// Audits: expensive checks that return a report instead of throwing.
#ifndef KINETRI_TRIANGULATION_AUDIT_H
#define KINETRI_TRIANGULATION_AUDIT_H

#include <string>
#include <vector>

#include "kinetri/base/cxx20.h"

namespace kinetri {

/// What an audit looks at. Each level includes those before it. The geometric levels look
/// at the exact positions at a rational time strictly between the present time and the next event.
enum class Audit_level {
  links,         ///< the topology's links, the queue, and the references between them agree
  embedding,     ///< finite triangles make left turns, the hull is convex, no two points coincide
  delaunay,      ///< every edge is locally Delaunay
  reference,     ///< the same edges as a static CGAL triangulation of the exact positions
  certificates,  ///< every certificate's next failure, computed anew, is the one in the queue
};

/// What an audit found.
struct Audit_report {
  /// One line each, naming the point ids involved. Empty if the audit passed.
  std::vector<std::string> failures;

  /// Whether nothing wrong was found.
  bool passed() const noexcept { return failures.empty(); }
};

}  // namespace kinetri

#endif  // KINETRI_TRIANGULATION_AUDIT_H
