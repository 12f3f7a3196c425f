// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Region_run: regions, and the parts of the queue.
#ifndef KINETRI_SRC_TRIANGULATION_REGION_DIVISION_IMPL_H
#define KINETRI_SRC_TRIANGULATION_REGION_DIVISION_IMPL_H

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "kinetri/impl/kinetic/rounded_places.h"
#include "kinetri/impl/triangulation/kd_cells.h"
#include "kinetri/impl/triangulation/parallel.h"
#include "kinetri/impl/triangulation/prefetch.h"
#include "triangulation/regions.h"

namespace kinetri::detail {

template <class Traits, class Turns>
void Region_run<Traits, Turns>::divide() {
  choose_owners();
  division().regions = regions_;
  const std::size_t nodes = division().nodes();
  division().flips.assign(nodes, 0);
  std::vector<double> shares;
  for (std::size_t node = 0; node < nodes; ++node) shares.push_back(division().share(node));
  division().numbers = Flip_numbers(shares, options_.stamp_bits);
  division().events = 0;
  move_to_parts(division().parts());
  go_on_with_division();
}

// Takes up the regions of the division. Stamps of its windows are in the faces.
template <class Traits, class Turns>
void Region_run<Traits, Turns>::go_on_with_division() {
  regions_ = division().regions;
  log_.go_on_with_division();
  lanes_.resize(division().nodes());
  const auto most = static_cast<double>(options_.most_flips);
  for (std::size_t node = 0; node < lanes_.size(); ++node) {
    Lane& lane = lanes_[node];
    lane.number = node;
    lane.level = division().level(node);
    const std::size_t from = lane.is_region() ? node : due_part(node);
    lane.part = &queue().part(from);
    lane.first_handle = queue().named(from, 0);
    lane.log = &log_.node(node);
    if constexpr (has_turns) lane.turn_part = &turns_.queue().part(from);
    const double share = 4 * division().share(node) * events_in_window();
    lane.most_flips = static_cast<std::size_t>(std::min(share + 64, most));
    if (lane.is_region()) {
      // Somewhat more than its share of a window.
      const auto expected = static_cast<std::size_t>(1.2 * share / 16) + 64;
      lane.log->flips.reserve(std::min(expected, lane.most_flips));
      lane.log->keys.reserve(std::min(expected, lane.most_flips));
    }
  }
}

// Whether the numbers of a node may not be enough for a window.
template <class Traits, class Turns>
bool Region_run<Traits, Turns>::are_stamps_spent() const {
  return std::ranges::any_of(
      lanes_, [](const Lane& lane) { return Log::are_numbers_spent(*lane.log, lane.most_flips); });
}

template <class Traits, class Turns>
void Region_run<Traits, Turns>::clear_stamps() {
  const std::vector<Face_handle> faces = topology_.faces();
  auto blocks = blocks_of(std::span(std::as_const(faces)));
  for_each(blocks, [](std::span<const Face_handle> block) {
    for (const Face_handle face : block) face->set_stamp(0);
  });
  log_.start_numbers();
}

template <class Traits, class Turns>
void Region_run<Traits, Turns>::join() {
  or_go_back([this] { call_with_threads(options_.threads, [this] { move_to_parts(1); }); });
  division().clear();
}

// Distributes the entries over parts, and clears the stamps.
template <class Traits, class Turns>
void Region_run<Traits, Turns>::move_to_parts(std::size_t count) {
  const std::vector<Face_handle> faces = topology_.faces();
  using Subject = typename Schedule::Subject;
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
  const auto in_parallel = [this](auto& elements, const auto& work) {
    this->for_each(elements, work);
  };
  // Of the two queues the plain loop may have put one into one part: where it has built all anew.
  queue().distribute(count, blocks_of(std::span(std::as_const(faces))), for_each_subject,
                     in_parallel);
  if constexpr (has_turns) turns_.divide(count, in_parallel);
}

// Whether all that is to come is in parts.
template <class Traits, class Turns>
bool Region_run<Traits, Turns>::is_divided() {
  if constexpr (has_turns) {
    if (!turns_.queue().is_divided()) return false;
  }
  return queue().is_divided();
}

// Regions are the cells of a k-d tree of the places of some vertices.
template <class Traits, class Turns>
void Region_run<Traits, Turns>::choose_owners() {
  std::vector<Vertex_handle> vertices;
  vertices.reserve(topology_.number_of_points());
  for (const Vertex_handle v : triangulation_.finite_vertex_handles()) {
    vertices.push_back(v);
  }
  const double now = schedule_.current_time().to_double();
  const auto place_of = [now](Vertex_handle v) {
    const auto finite = [](double x) { return std::isfinite(x) ? x : 0; };
    const Vector_2 place = rounded_place(v->point().motion(), now);
    return Vector_2{finite(place.x), finite(place.y)};
  };
  std::vector<Vector_2> sample;
  const std::size_t step = Kd_cells::sample_step(vertices.size(), regions_);
  for (std::size_t k = 0; k < vertices.size(); k += step) sample.push_back(place_of(vertices[k]));
  const Kd_cells cells(std::move(sample), regions_);
  std::vector<std::uint16_t>& owners = division().owners;
  owners.assign(topology_.vertices().size(), Region_division::no_region);
  auto blocks = blocks_of(std::span(std::as_const(vertices)));
  for_each(blocks, [&](std::span<const Vertex_handle> block) {
    for (const Vertex_handle v : block) {
      owners[v->point().id()] = static_cast<std::uint16_t>(cells.cell_of(place_of(v)));
    }
  });
}

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_TRIANGULATION_REGION_DIVISION_IMPL_H
