// SPDX-License-Identifier: GPL-3.0-or-later
//
// CGAL's triangulation data structure with faces that store the queue handle of each edge.
#ifndef KINETRI_IMPL_TRIANGULATION_KINETIC_TRIANGULATION_DATA_STRUCTURE_2_H
#define KINETRI_IMPL_TRIANGULATION_KINETIC_TRIANGULATION_DATA_STRUCTURE_2_H

#include <CGAL/Regular_triangulation_face_base_2.h>
#include <CGAL/Regular_triangulation_vertex_base_2.h>
#include <CGAL/Triangulation_data_structure_2.h>
#include <CGAL/Triangulation_ds_face_base_2.h>
#include <CGAL/Triangulation_face_base_2.h>
#include <CGAL/Triangulation_vertex_base_2.h>

#include <array>
#include <cstdint>

#include "kinetri/impl/events/queue_handle.h"

namespace kinetri {

/// A face with one queue handle for each edge; edge i is opposite vertex i. The two faces at an
/// edge store the same handle. The face fills one cache line.
template <class InstantaneousTraits,
          class FaceBase = CGAL::Triangulation_face_base_2<InstantaneousTraits>>
class alignas(64) Kinetic_face_base_2 : public FaceBase {
 public:
  /// @{
  /// A handle of the data structure.
  using Vertex_handle = typename FaceBase::Vertex_handle;
  using Face_handle = typename FaceBase::Face_handle;
  /// @}

  /// As CGAL requires.
  template <class Tds2>
  struct Rebind_TDS {
    /// The face of the data structure Tds2.
    using Other = Kinetic_face_base_2<InstantaneousTraits,
                                      typename FaceBase::template Rebind_TDS<Tds2>::Other>;
  };

  using FaceBase::FaceBase;

  /// The queue's entry for edge i; no_event if there is none. Precondition: 0 <= i < 3.
  Queue_handle event(int i) const { return events_[static_cast<std::size_t>(i)]; }
  /// Stores the queue's entry for edge i. Precondition: 0 <= i < 3.
  void set_event(int i, Queue_handle event) { events_[static_cast<std::size_t>(i)] = event; }

  /// The version of the face: the number of the last event that changed it; 0 if none did
  /// (docs/PARALLEL.md).
  std::uint32_t version() const {
    return static_cast<std::uint32_t>(high_version_) << 8 |
           static_cast<std::uint32_t>(low_version_);
  }
  /// Sets the version of the face. Precondition: version < 2^24.
  void set_version(std::uint32_t version) {
    low_version_ = static_cast<std::uint8_t>(version);
    high_version_ = static_cast<std::uint16_t>(version >> 8);
  }

 private:
  // In this order the members use the three bytes that CGAL's face leaves in its last word.
  std::uint8_t low_version_ = 0;
  std::uint16_t high_version_ = 0;
  std::array<Queue_handle, 3> events_ = {no_event, no_event, no_event};
};

/// A vertex in one cache line, if its point is small enough.
template <class InstantaneousTraits,
          class VertexBase = CGAL::Triangulation_vertex_base_2<InstantaneousTraits>>
class alignas(64) Kinetic_vertex_base_2 : public VertexBase {
 public:
  /// As CGAL requires.
  template <class Tds2>
  struct Rebind_TDS {
    /// The vertex of the data structure Tds2.
    using Other = Kinetic_vertex_base_2<InstantaneousTraits,
                                        typename VertexBase::template Rebind_TDS<Tds2>::Other>;
  };

  using VertexBase::VertexBase;
};

/// A vertex of a regular triangulation, with a queue handle while it is hidden.
template <class InstantaneousTraits,
          class VertexBase = CGAL::Regular_triangulation_vertex_base_2<InstantaneousTraits>>
class alignas(64) Kinetic_regular_vertex_base_2 : public VertexBase {
 public:
  /// As CGAL requires.
  template <class Tds2>
  struct Rebind_TDS {
    /// The vertex of the data structure Tds2.
    using Other =
        Kinetic_regular_vertex_base_2<InstantaneousTraits,
                                      typename VertexBase::template Rebind_TDS<Tds2>::Other>;
  };

  using VertexBase::VertexBase;

  /// The queue's entry for the hidden point; no_event if there is none.
  Queue_handle event() const { return event_; }
  /// Stores the queue's entry for the hidden point.
  void set_event(Queue_handle event) { event_ = event; }

 private:
  Queue_handle event_ = no_event;
};

/// CGAL's data structure with such faces.
template <class InstantaneousTraits>
using Kinetic_triangulation_data_structure_2 =
    CGAL::Triangulation_data_structure_2<Kinetic_vertex_base_2<InstantaneousTraits>,
                                         Kinetic_face_base_2<InstantaneousTraits>>;

/// The same for a regular triangulation: faces store the vertices that they hide, in a second cache
/// line.
template <class InstantaneousTraits>
using Kinetic_regular_data_structure_2 = CGAL::Triangulation_data_structure_2<
    Kinetic_regular_vertex_base_2<InstantaneousTraits>,
    CGAL::Regular_triangulation_face_base_2<InstantaneousTraits,
                                            Kinetic_face_base_2<InstantaneousTraits>>>;

}  // namespace kinetri

#endif  // KINETRI_IMPL_TRIANGULATION_KINETIC_TRIANGULATION_DATA_STRUCTURE_2_H
