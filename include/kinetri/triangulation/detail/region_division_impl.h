// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Region_run: regions, and the parts of the queue.
#ifndef KINETRI_TRIANGULATION_DETAIL_REGION_DIVISION_IMPL_H
#define KINETRI_TRIANGULATION_DETAIL_REGION_DIVISION_IMPL_H

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "kinetri/kinetic/rounded_places.h"
#include "kinetri/triangulation/detail/regions.h"

namespace kinetri::detail {

// Elements in blocks, each for one thread.
template <class Element>
std::vector<std::span<const Element>> blocks_of(std::span<const Element> elements,
                                                std::size_t size = 4096) {
  std::vector<std::span<const Element>> blocks;
  for (std::span<const Element> left = elements; !left.empty();) {
    blocks.push_back(left.first(std::min(size, left.size())));
    left = left.subspan(blocks.back().size());
  }
  return blocks;
}

template <class Kinetic>
void Region_run<Kinetic>::divide() {
  choose_owners();
  division().regions = regions_;
  division().flips.assign(regions_ + 1, 0);
  division().events = 0;
  move_to_parts(2 * regions_ + 2);
  go_on_with_division();
}

// Takes up the regions of the division. Stamps of its windows are in the faces.
template <class Kinetic>
void Region_run<Kinetic>::go_on_with_division() {
  regions_ = division().regions;
  lanes_.resize(regions_);
  const auto most =
      static_cast<double>(std::min(options_.most_flips, std::size_t{1} << (index_bits - 2)));
  const double share = 16 * events_in_window() / static_cast<double>(regions_) + 64;
  for (std::size_t r = 0; r < regions_; ++r) {
    lanes_[r].number = r;
    lanes_[r].part = &queue().part(r);
    lanes_[r].first_handle = queue().named(r, 0);
    lanes_[r].flips_before = division().flips[r];
    lanes_[r].capacity = static_cast<std::size_t>(std::min(share, most));
  }
  rest_.number = regions_;
  rest_.flips_before = division().flips[regions_];
  rest_.capacity = static_cast<std::size_t>(std::min(4 * events_in_window() + 64, most));
}

template <class Kinetic>
void Region_run<Kinetic>::join() {
  const double width = division().window_width;
  in_arena([this] { move_to_parts(1); });
  division() = {};
  division().window_width = width;
}

// Distributes the entries over parts, and clears the stamps.
template <class Kinetic>
void Region_run<Kinetic>::move_to_parts(std::size_t count) {
  const std::vector<Face_handle> faces = kinetic_.faces();
  const auto for_each_edge = [&](std::span<const Face_handle> block, const auto& function) {
    for (const Face_handle face : block) {
      face->set_stamp(0);
      kinetic_.for_each_own_edge(face, [&](const Edge& edge) {
        if (edge.first->event(edge.second) != no_event) function(edge);
      });
    }
  };
  queue().divide(count, blocks_of(std::span(std::as_const(faces))), for_each_edge,
                 [this](auto& elements, const auto& work) { this->for_each(elements, work); });
}

// A k-d tree of the places of some vertices tells who owns a vertex: it cuts the wider side of a
// cell, so that regions have about as many vertices.
template <class Kinetic>
void Region_run<Kinetic>::choose_owners() {
  std::vector<Vertex_handle> vertices;
  vertices.reserve(kinetic_.number_of_points_);
  for (const Vertex_handle v : kinetic_.triangulation_.finite_vertex_handles()) {
    vertices.push_back(v);
  }
  const double now = kinetic_.current_time().to_double();
  const auto place_of = [now](Vertex_handle v) {
    const auto finite = [](double x) { return std::isfinite(x) ? x : 0; };
    const Vector_2 place = rounded_place(v->point().motion(), now);
    return Vector_2{finite(place.x), finite(place.y)};
  };
  constexpr std::size_t sample_per_region = 128;
  std::vector<Vector_2> sample;
  for (std::size_t k = 0; k < vertices.size();
       k += vertices.size() / (sample_per_region * regions_) + 1) {
    sample.push_back(place_of(vertices[k]));
  }
  // A cell of several regions is cut: below `at` it is the next cell, from there on another one.
  struct Cell {
    std::size_t regions;
    std::size_t first_region;
    double Vector_2::*axis = nullptr;
    double at = 0;
    std::size_t above = 0;
  };
  std::vector<Cell> cells;
  const auto cut = [&](const auto& self, std::span<Vector_2> places, std::size_t first,
                       std::size_t count) -> void {
    const std::size_t cell = cells.size();
    cells.push_back({count, first});
    if (count == 1) return;
    const auto extent = [&](double Vector_2::*axis) {
      if (places.empty()) return 0.0;
      const auto [least, greatest] = std::ranges::minmax(places, {}, axis);
      return greatest.*axis - least.*axis;
    };
    double Vector_2::*const axis =
        extent(&Vector_2::x) < extent(&Vector_2::y) ? &Vector_2::y : &Vector_2::x;
    const std::size_t below = count / 2;
    const std::size_t middle = places.size() * below / count;
    if (middle < places.size()) {
      std::ranges::nth_element(places, places.begin() + static_cast<std::ptrdiff_t>(middle), {},
                               axis);
      cells[cell].at = places[middle].*axis;
    }
    cells[cell].axis = axis;
    self(self, places.first(middle), first, below);
    cells[cell].above = cells.size();
    self(self, places.subspan(middle), first + below, count - below);
  };
  cut(cut, sample, 0, regions_);
  std::vector<std::uint16_t>& owners = division().owners;
  owners.assign(kinetic_.vertices_.size(), Region_division::no_region);
  auto blocks = blocks_of(std::span(std::as_const(vertices)));
  for_each(blocks, [&](std::span<const Vertex_handle> block) {
    for (const Vertex_handle v : block) {
      const Vector_2 place = place_of(v);
      std::size_t cell = 0;
      while (cells[cell].regions > 1) {
        cell = place.*cells[cell].axis < cells[cell].at ? cell + 1 : cells[cell].above;
      }
      owners[v->point().id()] = static_cast<std::uint16_t>(cells[cell].first_region);
    }
  });
}

}  // namespace kinetri::detail

#endif  // KINETRI_TRIANGULATION_DETAIL_REGION_DIVISION_IMPL_H
