// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Subdomains.
#ifndef KINETRI_SRC_TRIANGULATION_SUBDOMAINS_IMPL_H
#define KINETRI_SRC_TRIANGULATION_SUBDOMAINS_IMPL_H

#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "kinetri/impl/kinetic/rounded_places.h"
#include "kinetri/impl/triangulation/kd_cells.h"
#include "kinetri/impl/triangulation/parallel.h"
#include "kinetri/impl/triangulation/prefetch.h"
#include "triangulation/subdomains.h"

namespace kinetri::detail {

template <class Traits>
void Subdomains<Traits>::choose(std::size_t regions) {
  choose_owners(regions);
  Region_division& division = schedule_.division();
  division.regions = regions;
  const std::size_t nodes = division.nodes();
  division.flips.assign(nodes, 0);
  std::vector<double> shares;
  for (std::size_t node = 0; node < nodes; ++node) shares.push_back(division.share(node));
  division.numbers = Flip_numbers(shares, options_.stamp_bits);
  division.events = 0;
}

template <class Traits>
void Subdomains<Traits>::choose_owners(std::size_t regions) {
  std::vector<Vertex_handle> vertices;
  vertices.reserve(topology_.number_of_points());
  for (const Vertex_handle v : topology_.triangulation().finite_vertex_handles()) {
    vertices.push_back(v);
  }
  const double now = schedule_.current_time().to_double();
  const auto place_of = [now](Vertex_handle v) {
    const auto finite = [](double x) { return std::isfinite(x) ? x : 0; };
    const Vector_2 place = rounded_place(v->point().motion(), now);
    return Vector_2{finite(place.x), finite(place.y)};
  };
  std::vector<Vector_2> sample;
  const std::size_t step = Kd_cells::sample_step(vertices.size(), regions);
  for (std::size_t k = 0; k < vertices.size(); k += step) sample.push_back(place_of(vertices[k]));
  const Kd_cells cells(std::move(sample), regions);
  std::vector<std::uint16_t>& owners = schedule_.division().owners;
  owners.assign(topology_.vertices().size(), Region_division::no_region);
  auto blocks = blocks_of(std::span(std::as_const(vertices)));
  call_for_each(options_, blocks, [&](std::span<const Vertex_handle> block) {
    for (const Vertex_handle v : block) {
      owners[v->point().id()] = static_cast<std::uint16_t>(cells.cell_of(place_of(v)));
    }
  });
}

template <class Traits>
void Subdomains<Traits>::distribute(std::size_t parts) {
  const std::vector<Face_handle> faces = topology_.faces();
  using Subject = typename Schedule<Traits>::Subject;
  const auto for_each_subject = [&](std::span<const Face_handle> block, const auto& function) {
    // What is far away in memory is asked for in time.
    for (std::size_t k = 0; k < block.size(); ++k) {
      if (k + 12 < block.size()) prefetch(block[k + 12]);
      if (k + 6 < block.size()) prefetch_around(block[k + 6]);
      block[k]->set_stamp(0);
      topology_.for_each_own_edge(block[k], [&](const Edge& edge) {
        if (edge.first->event(edge.second) == no_event) return;
        function(Subject{topology_.chosen_side(topology_.two_sided(edge)).here});
      });
      if constexpr (Types::is_weighted) {
        for (const Vertex_handle hidden : block[k]->vertex_list()) {
          if (hidden->event() != no_event) function(Subject{Edge(block[k], 0), hidden});
        }
      }
    }
  };
  schedule_.queue().distribute(
      parts, blocks_of(std::span(std::as_const(faces))), for_each_subject,
      [this](auto& elements, const auto& work) { call_for_each(options_, elements, work); });
}

template <class Traits>
void Subdomains<Traits>::clear_versions() {
  const std::vector<Face_handle> faces = topology_.faces();
  auto blocks = blocks_of(std::span(std::as_const(faces)));
  call_for_each(options_, blocks, [](std::span<const Face_handle> block) {
    for (const Face_handle face : block) face->set_stamp(0);
  });
}

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_TRIANGULATION_SUBDOMAINS_IMPL_H
