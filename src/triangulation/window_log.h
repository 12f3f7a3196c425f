// SPDX-License-Identifier: GPL-3.0-or-later
//
// The log of a time window: its events by node, their order, and how they are rolled back
// (docs/PARALLEL.md).
#ifndef KINETRI_SRC_TRIANGULATION_WINDOW_LOG_H
#define KINETRI_SRC_TRIANGULATION_WINDOW_LOG_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "kinetri/impl/triangulation/certification.h"
#include "kinetri/impl/triangulation/topology.h"
#include "triangulation/region_division.h"

namespace kinetri::detail {

/// The records of the events of a window, and their order. With contacts, some events are velocity
/// changes.
///
/// Invariants: the event of a record with a key has been executed; the version of a face is
/// the number of its last event that has not been rolled back; among events that conflict, numbers
/// grow in the order of execution. Several threads may add records for different nodes.
template <class Traits, bool has_contacts>
class Window_log {
 public:
  using Types = Topology<Traits>;
  using Time = typename Types::Time;
  using Edge = typename Types::Edge;
  using Edge_with_mirror = typename Types::Edge_with_mirror;
  using Face_handle = typename Types::Face_handle;
  using Vertex_handle = typename Types::Vertex_handle;
  using Point_2 = typename Types::Point_2;
  using Certificate_points = typename Certification<Traits>::Certificate_points;
  using Version = std::uint32_t;
  using Points = std::span<const Point_id>;

  /// The time of an entry of a flip, a hull event or a contact.
  struct Moment {
    Certificate_points points = {};
    Double_interval bounds = {};
    std::optional<Time> exact = std::nullopt;  ///< computed when needed
  };

  /// A face that an event has written.
  struct Written_face {
    Face_handle face;
    Version version;  ///< its version before
  };

  /// The part of a record that only velocity changes have.
  struct Velocity_change {
    std::array<Point_id, 2> points = {no_point, no_point};  ///< of the event
    Lattice_offset_2 offset = {};  ///< in a periodic box, of the second one's image
    std::array<Point_id, 2> changed = {no_point, no_point};
    std::array<Point_2, 2> before = {};    ///< their motions
    std::array<Point_2, 2> after = {};     ///< their motions
    std::array<Version, 2> previous = {};  ///< the numbers of their changes before this one
    std::vector<Written_face> faces;       ///< written by it

    Points changed_points() const { return Points(changed).first(changed[1] == no_point ? 1 : 2); }
  };
  struct Nothing {};

  /// A flip of the window, or a velocity change.
  struct Record {
    /// The ends of the edge, right and left as `face` has them, and the corners opposite it, of
    /// `face` and of `neighbor`; no_point is the infinite vertex.
    std::array<Point_id, 4> corners;
    /// In a periodic box, the offsets of the others against the left end.
    [[no_unique_address]] std::conditional_t<Types::is_periodic, std::array<Lattice_offset_2, 3>,
                                             Nothing>
        offsets;
    /// The edge, before the flip.
    Face_handle face;
    Face_handle neighbor;
    std::array<Version, 2> previous;  ///< versions of the two faces
    std::unique_ptr<Time> exact;      ///< the time, if it has been computed
    std::uint8_t i : 2;               ///< the index of the edge in `face`
    std::uint8_t j : 2;               ///< and in `neighbor`
    bool left_had_face : 1;           ///< `face` was the one that CGAL keeps at the left end
    bool right_had_neighbor : 1;      ///< `neighbor` was the one at the right end
    bool is_rolled_back : 1;
    /// Empty if it is a flip.
    [[no_unique_address]] std::conditional_t<has_contacts, std::unique_ptr<Velocity_change>,
                                             Nothing>
        change;
  };

  /// An event, as far as the order needs it.
  struct Key {
    Double_interval bounds;  ///< of its time
    double reached;          ///< the greatest lower bound up to this event of its node
    std::uint32_t index;     ///< of its record in the node
    std::uint16_t node;
    Event_kind kind;
  };

  /// The records of one node, which one thread writes.
  struct alignas(64) Node {
    std::uint16_t number = 0;
    std::uint32_t first_number = 0;  ///< of its events
    std::size_t numbers = 0;         ///< how many numbers it has
    std::size_t before = 0;          ///< events in earlier windows, since versions were cleared
    std::vector<Record> records = {};
    std::vector<Key> keys = {};    ///< of the records
    bool has_rolled_back = false;  ///< whether a record is rolled back
  };

  /// The others must outlive this object.
  Window_log(Topology<Traits>& topology, const Certification<Traits>& certification,
             Region_division& division)
      : topology_(topology), certification_(certification), division_(division) {}

  // ---- nodes ----

  /// Makes the nodes of the division, which may have had windows before.
  void take_up_division();
  Node& node(std::size_t number) { return nodes_[number]; }
  std::vector<Node>& nodes() { return nodes_; }
  /// Makes room for velocity changes of points whose ids are less than `ids`.
  void make_room(std::size_t ids) { last_changes_.resize(ids, 0); }
  /// Whether the numbers of a node may not suffice for a window with at most so many events.
  static bool are_numbers_spent(const Node& node, std::size_t most) {
    const std::size_t left = node.numbers - node.before;
    return left < most && left < node.numbers / 2;
  }
  /// All versions have been cleared: numbers begin again.
  void start_numbers();
  /// Clears the velocity changes of the window.
  void forget_changes();
  /// Removes the events of a node after its window; their numbers stay used.
  void clear(Node& node);
  void reset();

  // ---- numbers ----

  Node& node_of(Version version) { return nodes_[division_.numbers.node(version - 1)]; }
  bool is_of_window(Version version) {
    return version != 0 && index_of(version) >= node_of(version).before;
  }
  static Version version(const Node& node, std::size_t index) {
    return static_cast<Version>(node.first_number + node.before + index + 1);
  }
  /// Precondition: is_of_window(version).
  const Key& key(Version version) {
    const Node& node = node_of(version);
    return node.keys[index_of(version) - node.before];
  }
  Record& record(Version version) { return record(key(version)); }
  Record& record(const Key& key) { return nodes_[key.node].records[key.index]; }
  static bool is_contact(const Key& key) {
    return key.kind == Event_kind::wall || key.kind == Event_kind::collision;
  }

  // ---- records ----

  /// Adds the record of a flip that is about to be executed.
  Record& start_flip(Node& node, const Edge_with_mirror& edge);
  /// Gives the last record of the node its key, and returns the number of the event. If this does
  /// not throw, the event must be executed.
  Version add_key(Node& node, const Double_interval& bounds, Event_kind kind);
  /// Adds the record of a velocity change and takes ownership of it; if this throws before, the
  /// caller keeps it.
  Version add_change(Node& node, std::unique_ptr<Velocity_change>&& change, const Moment& moment,
                     Event_kind kind);
  /// Notes that the points of a velocity change have got their motions.
  void note_change(Velocity_change& change, Version number);
  /// Notes that a velocity change has been rolled back.
  void forget_change(const Velocity_change& change);
  /// Whether a point has got another motion in this window.
  bool has_changed(Point_id id) const { return last_changes_[id] != 0; }

  /// The names of the edge before a flip and after it.
  static auto flipped_edges(const Record& record);
  /// Restores faces, motions and versions to those just before the event. Does not change the
  /// queue, and allocates nothing. Precondition: the event is the last one of its faces.
  void roll_back(Record& record);
  /// Rolls all events back, the last ones first.
  void roll_back_all();

  // ---- times ----

  const Time& time(Moment& moment) const {
    if (!moment.exact) moment.exact = certification_.failure_time(moment.points, moment.bounds);
    return *moment.exact;
  }
  /// The time of an event. That of a hull event was computed when the event was executed.
  const Time& time(const Key& key);
  /// The points of the certificate that failed at a flip. Precondition: the corners are finite.
  Certificate_points certificate_points(const Key& key);
  /// The order of two times, of moments or keys: negative, zero or positive.
  template <class A, class B>
  int compare(A& a, B& b) {
    if (a.bounds.upper < b.bounds.lower) return -1;
    if (b.bounds.upper < a.bounds.lower) return 1;
    const auto order = time(a) <=> time(b);
    return order < 0 ? -1 : (order > 0 ? 1 : 0);
  }
  /// Whether an event of the window is later than the moment.
  bool is_later(Version version, Moment& moment) {
    return is_of_window(version) && compare(key(version), moment) > 0;
  }

  // ---- motions at other times ----

  /// Gives the points of a velocity change the motions after it, or before it.
  void set_motions(const Velocity_change& change, bool are_after);
  /// Gives the points the motions that they had when the window began, since observers see the
  /// velocity changes one after the other.
  void restore_motions();
  /// Gives the points of an event the motions after it.
  void go_through(const Key& key) {
    if constexpr (has_contacts) {
      if (is_contact(key)) set_motions(*record(key).change, true);
    }
  }

  // ---- the order of time ----

  /// Sorts the events that are not rolled back by time, in slices of about `per_slice` events, each
  /// by one thread. for_each(vector, work) calls work with each element, on several threads.
  template <class For_each>
  void put_in_order(std::size_t per_slice, const For_each& for_each);
  std::vector<Key>& order() { return order_; }
  const std::vector<Key>& order() const { return order_; }

  /// Calls `function` with each face that an event has written.
  template <class Function>
  static void for_each_written_face(const Record& record, const Function& function) {
    if constexpr (has_contacts) {
      if (record.change) {
        for (const auto& [face, version] : record.change->faces) function(face);
        return;
      }
    }
    function(record.face);
    function(record.neighbor);
  }

 private:
  using Triangulation = typename Types::Triangulation;

  // The events with least <= Key::reached < end.
  struct Slice {
    double least;
    double end;
    std::size_t size = 0;   // the number that is not rolled back
    std::size_t first = 0;  // the index of these in order_
    bool is_in_order = false;
  };

  // Among the events of its node since versions were cleared.
  std::size_t index_of(Version version) { return version - 1 - node_of(version).first_number; }
  const Point_2& point_at(Point_id id, Version flip);
  static std::span<const Key> keys_in(const Node& node, const Slice& slice);
  std::size_t count_keys(const Slice& slice) const;
  void distribute(const Slice& slice, double width, std::span<Key> keys) const;
  bool insert_in_order(std::span<Key> keys);
  std::size_t insert_in_order(std::span<Key> keys, std::size_t k);

  Topology<Traits>& topology_;
  const Certification<Traits>& certification_;
  Region_division& division_;
  std::vector<Node> nodes_;
  std::vector<Key> order_;
  std::vector<Version> last_changes_;  // by point: the last change of the window, or 0
};

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_TRIANGULATION_WINDOW_LOG_H
