// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Window_log.
#ifndef KINETRI_SRC_TRIANGULATION_WINDOW_LOG_IMPL_H
#define KINETRI_SRC_TRIANGULATION_WINDOW_LOG_IMPL_H

#include <algorithm>
#include <limits>
#include <numeric>

#include "kinetri/impl/base/check.h"
#include "triangulation/window_log.h"

namespace kinetri::detail {

// ---- nodes ----

template <class Traits, bool has_contacts>
void Window_log<Traits, has_contacts>::take_up_division() {
  nodes_.resize(division_.nodes());
  for (std::size_t number = 0; number < nodes_.size(); ++number) {
    Node& node = nodes_[number];
    node.number = static_cast<std::uint16_t>(number);
    node.before = division_.flips[number];
    node.first_number = division_.numbers.first(number);
    node.numbers = division_.numbers.size(number);
  }
}

template <class Traits, bool has_contacts>
void Window_log<Traits, has_contacts>::start_numbers() {
  for (Node& node : nodes_) division_.flips[node.number] = node.before = 0;
}

template <class Traits, bool has_contacts>
void Window_log<Traits, has_contacts>::forget_changes() {
  if constexpr (has_contacts) {
    for (const Node& node : nodes_) {
      for (const Record& record : node.records) {
        if (!record.change) continue;
        for (const Point_id id : record.change->changed_points()) last_changes_[id] = 0;
      }
    }
  }
}

template <class Traits, bool has_contacts>
void Window_log<Traits, has_contacts>::clear(Node& node) {
  node.before += node.records.size();
  division_.flips[node.number] = node.before;
  node.records.clear();
  node.keys.clear();
  node.has_rolled_back = false;
}

template <class Traits, bool has_contacts>
void Window_log<Traits, has_contacts>::reset() {
  nodes_.clear();
  order_.clear();
  std::ranges::fill(last_changes_, 0);
}

// ---- records ----

template <class Traits, bool has_contacts>
auto Window_log<Traits, has_contacts>::start_flip(Node& node, const Edge_with_mirror& edge)
    -> Record& {
  const auto [face, i] = edge.here;
  const auto [neighbor, j] = edge.there;
  Record& f = node.records.emplace_back();
  const Vertex_handle right = face->vertex(Triangulation::ccw(i));
  const Vertex_handle left = face->vertex(Triangulation::cw(i));
  f.corners = {right->point().id(), left->point().id(), face->vertex(i)->point().id(),
               neighbor->vertex(j)->point().id()};
  if constexpr (Types::is_periodic) {
    const int at_left = Triangulation::cw(i);
    f.offsets = {Triangulation::offset(face, at_left, Triangulation::ccw(i)),
                 Triangulation::offset(face, at_left, i),
                 Triangulation::offset(neighbor, Triangulation::ccw(j), j)};
  }
  f.face = face;
  f.neighbor = neighbor;
  f.i = static_cast<std::uint8_t>(i & 3);
  f.j = static_cast<std::uint8_t>(j & 3);
  f.left_had_face = left->face() == face;
  f.right_had_neighbor = right->face() == neighbor;
  f.previous = {face->version(), neighbor->version()};
  return f;
}

template <class Traits, bool has_contacts>
auto Window_log<Traits, has_contacts>::add_key(Node& node, const Double_interval& bounds,
                                               Event_kind kind) -> Version {
  const std::size_t index = node.records.size() - 1;
  const double reached = index > 0 ? node.keys.back().reached : bounds.lower;
  node.keys.push_back({bounds, std::max(reached, bounds.lower), static_cast<std::uint32_t>(index),
                       node.number, kind});
  return version(node, index);
}

template <class Traits, bool has_contacts>
auto Window_log<Traits, has_contacts>::add_change(Node& node,
                                                  std::unique_ptr<Velocity_change>&& change,
                                                  const Moment& moment, Event_kind kind)
    -> Version {
  Record& f = node.records.emplace_back();
  f.exact = std::make_unique<Time>(*moment.exact);
  f.change = std::move(change);
  return add_key(node, moment.bounds, kind);
}

template <class Traits, bool has_contacts>
void Window_log<Traits, has_contacts>::note_change(Velocity_change& change, Version number) {
  const Points changed = change.changed_points();
  for (std::size_t k = 0; k < changed.size(); ++k) {
    change.previous[k] = std::exchange(last_changes_[changed[k]], number);
  }
}

template <class Traits, bool has_contacts>
void Window_log<Traits, has_contacts>::forget_change(const Velocity_change& change) {
  const Points changed = change.changed_points();
  for (std::size_t k = 0; k < changed.size(); ++k) last_changes_[changed[k]] = change.previous[k];
}

template <class Traits, bool has_contacts>
auto Window_log<Traits, has_contacts>::flipped_edges(const Record& f) {
  const auto& [right, left, apex, opposite] = f.corners;
  if constexpr (Types::is_periodic) {
    const auto& [to_right, to_apex, to_opposite] = f.offsets;
    const Lattice_offset_2 across = {to_opposite.x - to_apex.x, to_opposite.y - to_apex.y};
    return std::pair(periodic_edge(left, right, to_right), periodic_edge(apex, opposite, across));
  } else {
    return std::pair(edge_ids(right, left), edge_ids(apex, opposite));
  }
}

template <class Traits, bool has_contacts>
void Window_log<Traits, has_contacts>::roll_back(Record& f) {
  f.is_rolled_back = true;
  if constexpr (has_contacts) {
    if (f.change) {
      set_motions(*f.change, false);
      for (const auto& [face, version] : f.change->faces) face->set_version(version);
      return;
    }
  }
  const int i = f.i;
  const int j = f.j;
  const Vertex_handle left = f.neighbor->vertex(Triangulation::ccw(j));
  const Vertex_handle right = f.face->vertex(Triangulation::ccw(i));
  if constexpr (Types::is_periodic) {
    Triangulation::flip_back(Edge(f.face, i), Edge(f.neighbor, j));
  } else {  // The inverse of CGAL's flip.
    const Edge at_bottom = topology_.with_mirror(Edge(f.face, i)).there;
    const Edge at_top = topology_.with_mirror(Edge(f.neighbor, j)).there;
    auto& tds = topology_.triangulation().tds();
    f.face->set_vertex(Triangulation::cw(i), left);
    f.neighbor->set_vertex(Triangulation::cw(j), right);
    tds.set_adjacency(f.face, i, f.neighbor, j);
    tds.set_adjacency(f.face, Triangulation::ccw(i), at_top.first, at_top.second);
    tds.set_adjacency(f.neighbor, Triangulation::ccw(j), at_bottom.first, at_bottom.second);
  }
  if (f.left_had_face) left->set_face(f.face);
  if (f.right_had_neighbor) right->set_face(f.neighbor);
  f.face->set_version(f.previous[0]);
  f.neighbor->set_version(f.previous[1]);
}

// In any order of the nodes of a level, whose events do not conflict. A record without a key is of
// an event that has not been executed.
template <class Traits, bool has_contacts>
void Window_log<Traits, has_contacts>::roll_back_all() {
  const auto roll_back_in = [this](Node& node) {
    for (std::size_t k = std::min(node.records.size(), node.keys.size()); k-- > 0;) {
      if (!node.records[k].is_rolled_back) roll_back(node.records[k]);
    }
  };
  std::for_each(nodes_.rbegin(), nodes_.rend(), roll_back_in);
}

// ---- times ----

template <class Traits, bool has_contacts>
auto Window_log<Traits, has_contacts>::time(const Key& key) -> const Time& {
  Record& f = record(key);
  if (!f.exact) {
    f.exact =
        std::make_unique<Time>(certification_.failure_time(certificate_points(key), key.bounds));
  }
  return *f.exact;
}

// Those of Certification::points at that time.
template <class Traits, bool has_contacts>
auto Window_log<Traits, has_contacts>::certificate_points(const Key& key) -> Certificate_points {
  const Version number = version(nodes_[key.node], key.index);
  const Record& f = record(key);
  const auto corner = [&](std::size_t k, [[maybe_unused]] std::size_t offset) {
    const Point_2& point = point_at(f.corners[k], number);
    if constexpr (Types::is_periodic) {
      return certification_.traits().image(
          point, offset < f.offsets.size() ? f.offsets[offset] : Lattice_offset_2());
    } else {
      return &point;
    }
  };
  return {Entry_kind::flip, {corner(0, 0), corner(1, 3), corner(2, 1), corner(3, 2)}};
}

// ---- motions of other times ----

// The point with the motion that it had at the flip.
template <class Traits, bool has_contacts>
auto Window_log<Traits, has_contacts>::point_at(Point_id id, Version flip) -> const Point_2& {
  if constexpr (has_contacts) {
    const Point_2* result = nullptr;
    for (Version number = last_changes_[id]; number != 0;) {
      const Velocity_change& change = *record(number).change;
      const std::size_t k = change.changed[0] == id ? 0 : 1;
      if (number < flip) return result == nullptr ? change.after[k] : *result;
      result = &change.before[k];
      number = change.previous[k];
    }
    if (result != nullptr) return *result;
  }
  return topology_.vertex(id)->point();
}

template <class Traits, bool has_contacts>
void Window_log<Traits, has_contacts>::set_motions(const Velocity_change& change, bool are_after) {
  for (std::size_t k = 0; k < 2 && change.changed[k] != no_point; ++k) {
    topology_.vertex(change.changed[k])->set_point(are_after ? change.after[k] : change.before[k]);
  }
}

template <class Traits, bool has_contacts>
void Window_log<Traits, has_contacts>::restore_motions() {
  if constexpr (has_contacts) {
    for (auto key = order_.rbegin(); key != order_.rend(); ++key) {
      if (is_contact(*key)) set_motions(*record(*key).change, false);
    }
  }
}

// ---- the order of time ----

// Slices are divided by lower bounds. Since bounds may overlap, the first events of a slice may
// then move into earlier slices.
template <class Traits, bool has_contacts>
template <class For_each>
void Window_log<Traits, has_contacts>::put_in_order(std::size_t per_slice,
                                                    const For_each& for_each) {
  order_.clear();
  std::size_t size = 0;
  double least = std::numeric_limits<double>::infinity();
  double greatest = -least;
  for (const Node& node : nodes_) {
    if (node.keys.empty()) continue;
    size += node.keys.size();
    least = std::min(least, node.keys.front().reached);
    greatest = std::max(greatest, node.keys.back().reached);
  }
  if (size == 0) return;
  const std::size_t number = size / per_slice + 1;
  std::vector<Slice> slices;
  for (std::size_t k = 0; k < number; ++k) {
    const double share = static_cast<double>(k + 1) / static_cast<double>(number);
    const double end = k + 1 == number ? std::numeric_limits<double>::infinity()
                                       : least + share * (greatest - least);
    slices.push_back({k == 0 ? least : slices.back().end, end});
  }
  for_each(slices, [this](Slice& slice) { slice.size = count_keys(slice); });
  std::size_t first = 0;
  for (Slice& slice : slices) slice.first = std::exchange(first, first + slice.size);
  order_.resize(first);
  for_each(slices, [&](Slice& slice) {
    const std::span<Key> keys = std::span(order_).subspan(slice.first, slice.size);
    distribute(slice, (greatest - least) / static_cast<double>(number), keys);
    slice.is_in_order = insert_in_order(keys);
  });
  bool are_in_order = true;
  for (const Slice& slice : slices) {
    are_in_order = are_in_order && slice.is_in_order;
    // If one stays, so do those after it in its slice.
    std::size_t k = slice.first;
    while (are_in_order && k < slice.first + slice.size && insert_in_order(order_, k) > 0) ++k;
  }
  if (are_in_order) return;
  std::ranges::sort(order_, [this](const Key& a, const Key& b) { return compare(a, b) < 0; });
}

template <class Traits, bool has_contacts>
auto Window_log<Traits, has_contacts>::keys_in(const Node& node, const Slice& slice)
    -> std::span<const Key> {
  const auto first = std::ranges::lower_bound(node.keys, slice.least, {}, &Key::reached);
  const auto last = std::ranges::lower_bound(first, node.keys.end(), slice.end, {}, &Key::reached);
  return std::span(node.keys).subspan(static_cast<std::size_t>(first - node.keys.begin()),
                                      static_cast<std::size_t>(last - first));
}

template <class Traits, bool has_contacts>
std::size_t Window_log<Traits, has_contacts>::count_keys(const Slice& slice) const {
  std::size_t result = 0;
  for (const Node& node : nodes_) {
    const std::span<const Key> keys = keys_in(node, slice);
    result += keys.size();
    if (!node.has_rolled_back) continue;
    const auto is_rolled_back = [&](const Key& key) {
      return node.records[key.index].is_rolled_back;
    };
    result -= static_cast<std::size_t>(std::ranges::count_if(keys, is_rolled_back));
  }
  return result;
}

// Writes the keys of a slice, without those rolled back, to `keys`, nearly sorted: by as many
// buckets of equal width.
template <class Traits, bool has_contacts>
void Window_log<Traits, has_contacts>::distribute(const Slice& slice, double width,
                                                  std::span<Key> keys) const {
  const auto count = static_cast<double>(keys.size());
  const auto bucket_of = [&](const Key& key) {
    const double bucket = (key.reached - slice.least) / width * count;
    return bucket < count ? static_cast<std::size_t>(bucket) : keys.size();
  };
  const auto for_each_key = [&](const auto& function) {
    for (const Node& node : nodes_) {
      for (const Key& key : keys_in(node, slice)) {
        if (!node.has_rolled_back || !node.records[key.index].is_rolled_back) function(key);
      }
    }
  };
  std::vector<std::size_t> first(keys.size() + 2, 0);  // of each bucket
  for_each_key([&](const Key& key) { ++first[bucket_of(key) + 1]; });
  std::partial_sum(first.begin(), first.end(), first.begin());
  for_each_key([&](const Key& key) { keys[first[bucket_of(key)]++] = key; });
}

// Insertion sort. Stops and returns false after too many steps.
template <class Traits, bool has_contacts>
bool Window_log<Traits, has_contacts>::insert_in_order(std::span<Key> keys) {
  std::size_t steps = 8 * keys.size();
  for (std::size_t k = 1; k < keys.size(); ++k) {
    const std::size_t moved = insert_in_order(keys, k);
    if (moved > steps) return false;
    steps -= moved;
  }
  return true;
}

// Moves keys[k] to its position among the sorted keys before it. Returns how many it passes.
template <class Traits, bool has_contacts>
inline std::size_t Window_log<Traits, has_contacts>::insert_in_order(std::span<Key> keys,
                                                                     std::size_t k) {
  if (k == 0 || keys[k - 1].bounds.upper < keys[k].bounds.lower) return 0;
  const Key key = keys[k];
  std::size_t to = k;
  for (; to > 0 && compare(key, keys[to - 1]) < 0; --to) keys[to] = keys[to - 1];
  keys[to] = key;
  return k - to;
}

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_TRIANGULATION_WINDOW_LOG_IMPL_H
