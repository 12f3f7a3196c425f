// SPDX-License-Identifier: GPL-3.0-or-later
//
// Regions, the subdomains of the plane that threads take: which points are in which, and the parts
// of the queue of edges that follow from that.
#ifndef KINETRI_SRC_TRIANGULATION_SUBDOMAINS_H
#define KINETRI_SRC_TRIANGULATION_SUBDOMAINS_H

#include <cstddef>

#include "kinetri/impl/triangulation/kinetic_core.h"
#include "triangulation/region_options.h"

namespace kinetri::detail {

/// How many regions so many points are divided into.
std::size_t number_of_regions(const Region_options& options, std::size_t points);

/// Divides the points of a triangulation among regions, the cells of a k-d tree of the places of
/// some of them, and the entries of its queue among parts. The division itself is kept by the
/// triangulation, between two runs too.
template <class Traits>
class Subdomains {
 public:
  /// The core and the options must outlive this object.
  Subdomains(Kinetic_core<Traits>& core, const Region_options& options)
      : topology_(core.topology), schedule_(core.schedule), options_(options) {}

  /// Chooses the regions of all points anew. O(n).
  void choose(std::size_t regions);
  /// Distributes the entries over so many parts, as the division says, and clears the versions of
  /// faces. O(n).
  void distribute(std::size_t parts);
  /// Clears the versions of faces. O(n).
  void clear_versions();

 private:
  using Types = Topology<Traits>;
  using Edge = typename Types::Edge;
  using Face_handle = typename Types::Face_handle;
  using Vertex_handle = typename Types::Vertex_handle;

  void choose_owners(std::size_t regions);

  Topology<Traits>& topology_;
  Schedule<Traits>& schedule_;
  const Region_options& options_;
};

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_TRIANGULATION_SUBDOMAINS_H
