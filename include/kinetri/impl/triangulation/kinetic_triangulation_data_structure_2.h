// SPDX-License-Identifier: GPL-3.0-or-later
//
// The combinatorial triangulation under the kinetic one: CGAL's data structure with faces that
// remember, for each of their edges, the event scheduled for it.
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

/// A face with one queue handle for each edge; edge i is the one opposite vertex i. The two faces
/// at an edge hold the same handle. All of it is in one cache line.
template <class InstantaneousTraits,
          class FaceBase = CGAL::Triangulation_face_base_2<InstantaneousTraits>>
class alignas(64) Kinetic_face_base_2 : public FaceBase {
 public:
  /// @{
  /// A handle of the data structure.
  using Vertex_handle = typename FaceBase::Vertex_handle;
  using Face_handle = typename FaceBase::Face_handle;
  /// @}

  /// CGAL's way to tell a base class of its data structure.
  template <class Tds2>
  struct Rebind_TDS {
    /// The face of the data structure Tds2.
    using Other = Kinetic_face_base_2<InstantaneousTraits,
                                      typename FaceBase::template Rebind_TDS<Tds2>::Other>;
  };

  using FaceBase::FaceBase;

  /// The queue's entry for edge i; no_event if there is none. Precondition: 0 <= i < 3.
  Queue_handle event(int i) const { return events_[static_cast<std::size_t>(i)]; }
  /// Remembers the queue's entry for edge i. Precondition: 0 <= i < 3.
  void set_event(int i, Queue_handle event) { events_[static_cast<std::size_t>(i)] = event; }

  /// The last flip of the face within a window of a run by regions; 0 if there was none.
  std::uint32_t stamp() const {
    return static_cast<std::uint32_t>(high_stamp_) << 8 | static_cast<std::uint32_t>(low_stamp_);
  }
  /// Remembers the last flip of the face. Precondition: stamp < 2^24.
  void set_stamp(std::uint32_t stamp) {
    low_stamp_ = static_cast<std::uint8_t>(stamp);
    high_stamp_ = static_cast<std::uint16_t>(stamp >> 8);
  }

 private:
  // CGAL's face leaves three bytes of its last word. The order of members uses them.
  std::uint8_t low_stamp_ = 0;
  std::uint16_t high_stamp_ = 0;
  std::array<Queue_handle, 3> events_ = {no_event, no_event, no_event};
};

/// A vertex that is in one cache line, if the point leaves room for that.
template <class InstantaneousTraits,
          class VertexBase = CGAL::Triangulation_vertex_base_2<InstantaneousTraits>>
class alignas(64) Kinetic_vertex_base_2 : public VertexBase {
 public:
  /// CGAL's way to tell a base class of its data structure.
  template <class Tds2>
  struct Rebind_TDS {
    /// The vertex of the data structure Tds2.
    using Other = Kinetic_vertex_base_2<InstantaneousTraits,
                                        typename VertexBase::template Rebind_TDS<Tds2>::Other>;
  };

  using VertexBase::VertexBase;
};

/// A vertex of a regular triangulation, with the queue's entry for it while it is hidden.
template <class InstantaneousTraits,
          class VertexBase = CGAL::Regular_triangulation_vertex_base_2<InstantaneousTraits>>
class alignas(64) Kinetic_regular_vertex_base_2 : public VertexBase {
 public:
  /// CGAL's way to tell a base class of its data structure.
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
  /// Remembers the queue's entry for the hidden point.
  void set_event(Queue_handle event) { event_ = event; }

 private:
  Queue_handle event_ = no_event;
};

/// CGAL's data structure with such faces.
template <class InstantaneousTraits>
using Kinetic_triangulation_data_structure_2 =
    CGAL::Triangulation_data_structure_2<Kinetic_vertex_base_2<InstantaneousTraits>,
                                         Kinetic_face_base_2<InstantaneousTraits>>;

/// The same for a regular triangulation: faces hold the vertices that they hide, in a second cache
/// line.
template <class InstantaneousTraits>
using Kinetic_regular_data_structure_2 = CGAL::Triangulation_data_structure_2<
    Kinetic_regular_vertex_base_2<InstantaneousTraits>,
    CGAL::Regular_triangulation_face_base_2<InstantaneousTraits,
                                            Kinetic_face_base_2<InstantaneousTraits>>>;

}  // namespace kinetri

#endif  // KINETRI_IMPL_TRIANGULATION_KINETIC_TRIANGULATION_DATA_STRUCTURE_2_H
