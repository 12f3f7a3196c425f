// SPDX-License-Identifier: GPL-3.0-or-later
//
// Chooses the regions (subdomains), and partitions the queue of edges by them. The schedule keeps
// the division.
#ifndef KINETRI_SRC_TRIANGULATION_SUBDOMAINS_H
#define KINETRI_SRC_TRIANGULATION_SUBDOMAINS_H

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "events/distribute.h"
#include "kinetic/rounded_places.h"
#include "kinetri/impl/base/compiler.h"
#include "kinetri/impl/triangulation/kinetic_core.h"
#include "kinetri/impl/triangulation/parallel.h"
#include "triangulation/kd_cells.h"
#include "triangulation/region_options.h"
#include "triangulation/wrapping.h"

namespace kinetri::detail {

/// The number of regions for so many points.
std::size_t number_of_regions(const Region_options& options, std::size_t points);

/// The positions by which points are assigned to regions: their own or, in a periodic box, those of
/// their images in one cell of the lattice.
template <class Traits>
class Place_in_cell {
 public:
  Place_in_cell(const Kinetic_core<Traits>& core, double time) {
    if constexpr (is_periodic) wrapping_.emplace(core.certification.traits().box(), time);
  }
  Vector_2 operator()(const Vector_2& place) const {
    if constexpr (is_periodic) return wrapping_->position(wrapping_->place_of_image(place));
    return place;
  }

 private:
  static constexpr bool is_periodic = Kinetic_types<Traits>::is_periodic;
  std::optional<Wrapping> wrapping_;
};

/// Assigns all points to regions: the cells of a k-d tree of a sample of their positions. O(n).
template <class Traits>
void choose_regions(Kinetic_core<Traits>& core, const Region_options& options,
                    std::size_t regions) {
  using Vertex_handle = typename Topology<Traits>::Vertex_handle;
  const Topology<Traits>& topology = core.topology;
  std::vector<Vertex_handle> vertices;
  vertices.reserve(topology.number_of_vertices());
  for (const Vertex_handle v : topology.triangulation().finite_vertex_handles()) {
    vertices.push_back(v);
  }
  const double now = core.schedule.current_time().to_double();
  const auto place_of = [now, to_cell = Place_in_cell<Traits>(core, now)](Vertex_handle v) {
    const auto finite = [](double x) { return std::isfinite(x) ? x : 0; };
    const Vector_2 place = to_cell(rounded_place(v->point().motion(), now));
    return Vector_2{finite(place.x), finite(place.y)};
  };
  std::vector<Vector_2> sample;
  const std::size_t step = Kd_cells::sample_step(vertices.size(), regions);
  for (std::size_t k = 0; k < vertices.size(); k += step) sample.push_back(place_of(vertices[k]));
  const Kd_cells cells(std::move(sample), regions);
  Region_division& division = core.schedule.division();
  std::vector<std::uint16_t>& owners = division.owners;
  owners.assign(topology.vertices().size(), Region_division::no_region);
  auto blocks = blocks_of(std::span(std::as_const(vertices)));
  call_for_each(options, blocks, [&](std::span<const Vertex_handle> block) {
    for (const Vertex_handle v : block) {
      owners[v->point().id()] = static_cast<std::uint16_t>(cells.cell_of(place_of(v)));
    }
  });
  division.regions = regions;
  const std::size_t nodes = division.nodes();
  division.flips.assign(nodes, 0);
  std::vector<double> shares;
  for (std::size_t node = 0; node < nodes; ++node) shares.push_back(division.share(node));
  division.numbers = Flip_numbers(shares, options.version_bits);
  division.events = 0;
}

/// Distributes the entries of edges and hidden points over so many parts, by the division, and
/// clears the versions of faces. O(n).
template <class Traits>
void distribute_edges(Kinetic_core<Traits>& core, const Region_options& options,
                      std::size_t parts) {
  using Types = Topology<Traits>;
  using Edge = typename Types::Edge;
  using Face_handle = typename Types::Face_handle;
  const Topology<Traits>& topology = core.topology;
  const std::vector<Face_handle> faces = topology.faces();
  using Subject = typename Schedule<Traits>::Subject;
  const auto for_each_subject = [&](std::span<const Face_handle> block, const auto& function) {
    // Prefetched, since faces are far apart in memory.
    for (std::size_t k = 0; k < block.size(); ++k) {
      if (k + 12 < block.size()) prefetch(block[k + 12]);
      if (k + 6 < block.size()) prefetch_around(block[k + 6]);
      block[k]->set_version(0);
      topology.for_each_own_edge(block[k], [&](const Edge& edge) {
        if (edge.first->event(edge.second) == no_event) return;
        function(Subject{topology.chosen_side(topology.with_mirror(edge)).here});
      });
      if constexpr (Types::is_weighted) {
        for (const auto hidden : block[k]->vertex_list()) {
          if (hidden->event() != no_event) function(Subject{Edge(block[k], 0), hidden});
        }
      }
    }
  };
  core.schedule.queue().distribute(
      parts, blocks_of(std::span(std::as_const(faces))), for_each_subject,
      [&options](auto& elements, const auto& work) { call_for_each(options, elements, work); });
}

/// Clears the versions of faces. O(n).
template <class Traits>
void clear_versions(const Topology<Traits>& topology, const Region_options& options) {
  using Face_handle = typename Topology<Traits>::Face_handle;
  const std::vector<Face_handle> faces = topology.faces();
  auto blocks = blocks_of(std::span(std::as_const(faces)));
  call_for_each(options, blocks, [](std::span<const Face_handle> block) {
    for (const Face_handle face : block) face->set_version(0);
  });
}

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_TRIANGULATION_SUBDOMAINS_H
