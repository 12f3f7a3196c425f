// SPDX-License-Identifier: GPL-3.0-or-later
//
// CGAL's regular triangulation, extended: it hides and shows single vertices, which CGAL does only
// within its own insertions.
#ifndef KINETRI_IMPL_TRIANGULATION_REGULAR_TRIANGULATION_H
#define KINETRI_IMPL_TRIANGULATION_REGULAR_TRIANGULATION_H

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Regular_triangulation_2.h>

#include <cstddef>
#include <utility>

#include "kinetri/impl/triangulation/kinetic_triangulation_data_structure_2.h"

namespace kinetri::detail {

/// A CGAL::Regular_triangulation_2 at the instant of its traits. A point without a power cell is a
/// hidden vertex: `is_hidden()` is true, `face()` is a triangle that it is above, and it is in the
/// `vertex_list()` of that triangle. In dimensions below 2 the triangle is an edge or a vertex.
template <class InstantaneousTraits>
class Regular_triangulation
    : public CGAL::Regular_triangulation_2<InstantaneousTraits,
                                           Kinetic_regular_data_structure_2<InstantaneousTraits>> {
  using Base = CGAL::Regular_triangulation_2<InstantaneousTraits,
                                             Kinetic_regular_data_structure_2<InstantaneousTraits>>;

 public:
  /// @{
  /// A type of CGAL.
  using Data_structure = typename Base::Triangulation_data_structure;
  using Vertex_handle = typename Base::Vertex_handle;
  using Face_handle = typename Base::Face_handle;
  /// @}
  /// The Delaunay triangulation on the same data structure.
  using Delaunay = CGAL::Delaunay_triangulation_2<InstantaneousTraits, Data_structure>;

  using Base::Base;
  Regular_triangulation() = default;
  ~Regular_triangulation() = default;
  Regular_triangulation(const Regular_triangulation&) = delete;
  Regular_triangulation& operator=(const Regular_triangulation&) = delete;
  /// @{
  /// Moves the other triangulation, which must not be used any more. O(n).
  Regular_triangulation(Regular_triangulation&& other) noexcept(false) : Base(other.geom_traits()) {
    *this = std::move(other);
  }
  Regular_triangulation& operator=(Regular_triangulation&& other) noexcept(false) {
    this->swap(other);
    count_hidden_vertices();
    return *this;
  }
  /// @}

  std::size_t number_of_vertices() const {
    return this->tds().number_of_vertices() - 1 - number_of_hidden_vertices();
  }
  /// The number of hidden vertices. O(1).
  std::size_t number_of_hidden_vertices() const {
    return Base::number_of_hidden_vertices() + hidden_;
  }

  /// Counts the hidden vertices, after the data structure has been changed as a whole. O(n).
  void count_hidden_vertices() {
    std::size_t number = 0;
    for (auto v = this->hidden_vertices_begin(); v != this->hidden_vertices_end(); ++v) ++number;
    hidden_ = number - Base::number_of_hidden_vertices();
  }

  /// Hides a vertex that has no faces, or that is hidden and in no list, in `face`.
  void hide(Vertex_handle v, Face_handle face) {
    if (!v->is_hidden()) ++hidden_;
    v->set_hidden(true);
    v->set_face(face);
    face->vertex_list().push_back(v);
  }

  /// Removes a hidden vertex from the list of its face. It stays hidden. Linear in the length of
  /// the list.
  void take_from_face(Vertex_handle v) { v->face()->vertex_list().remove(v); }

  /// Makes a hidden vertex in no list visible. It has no faces yet.
  void show(Vertex_handle v) {
    --hidden_;
    v->set_hidden(false);
  }

  /// Calls `function` with the Delaunay triangulation of the same vertices and faces. Precondition:
  /// all weights are equal, so that it is the regular one, and no vertex is hidden.
  template <class Function>
  void as_delaunay(const Function& function) {
    Delaunay delaunay(this->geom_traits());
    const auto exchange = [&] {
      const Vertex_handle infinite = this->infinite_vertex();
      this->tds().swap(delaunay.tds());
      this->set_infinite_vertex(delaunay.infinite_vertex());
      delaunay.set_infinite_vertex(infinite);
    };
    exchange();
    function(delaunay);
    exchange();
  }

 private:
  std::size_t hidden_ = 0;  // those that CGAL does not count; modulo the range of the type
};

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_TRIANGULATION_REGULAR_TRIANGULATION_H
