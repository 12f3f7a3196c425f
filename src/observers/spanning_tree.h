// SPDX-License-Identifier: GPL-3.0-or-later
//
// The Euclidean minimum spanning tree of a graph of moving points, by cycle certificates.
#ifndef KINETRI_SRC_OBSERVERS_SPANNING_TREE_H
#define KINETRI_SRC_OBSERVERS_SPANNING_TREE_H

#include <algorithm>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "kinetri/kinetic/certificate_polynomials.h"
#include "kinetri/observers/kinetic_spanning_tree_2.h"
#include "observers/edge_follower.h"
#include "observers/failure_queue.h"
#include "observers/rooted_forest.h"
#include "observers/spanning_tree_history.h"

namespace kinetri::detail {

/// Invariant between events: each edge of the graph that is not in the tree has a *cycle
/// certificate*, a cycle of which it is the longest edge: the rest of the cycle is either two other
/// edges of a triangle, or a path that was in the tree when it was found. So no such edge is in the
/// minimum spanning tree. A cycle certificate fails when another edge of the cycle becomes longer
/// than its edge; the queue has the first such failure of each edge that is not in the tree, and
/// for each edge of the tree except the longest one the time at which it becomes longer than that.
///
/// In a periodic box the graph is that of the points modulo the lattice, with several edges between
/// two points. A point and its own image have no edge here, since it would never be in the tree.
template <SimulationKineticTraits_2 Traits>
class Spanning_tree final : private Edge_follower<Traits> {
 public:
  using typename Edge_follower<Traits>::Edge_name;
  using typename Edge_follower<Traits>::Image_2;
  using typename Edge_follower<Traits>::Neighbor;
  using typename Edge_follower<Traits>::Time;
  using History = Spanning_tree_history<Edge_name, Image_2>;

  /// Observes a triangulation or a simulation.
  template <class Observed>
  explicit Spanning_tree(Observed& observed)
      : Edge_follower<Traits>(observed), now_(present_time()) {
    resize();
    std::vector<std::pair<double, Index>> by_length;
    for (const Edge_name& name : this->graph().edges()) {
      if (!joins_points(name)) continue;
      const Index edge = insert(name);
      by_length.emplace_back(rounded_square_length(edge), edge);
    }
    std::ranges::sort(by_length);
    for (const auto& [length, edge] : by_length) withdraw(edge);
    certify_all();
    find_longest();
    history_.forget_counts();
    record();
  }

  /// The time of the answers.
  const Time& present_time() const { return this->triangulation().current_time(); }

  /// @{
  /// Just after that time.
  std::vector<Edge_name> edges() {
    look();
    std::vector<Edge_name> result;
    for (const Edge& edge : edges_) {
      if (edge.is_in_tree) result.push_back(edge.name);
    }
    std::ranges::sort(result);
    return result;
  }
  bool is_edge(const Edge_name& name) {
    look();
    const Index edge = find(name);
    return edge != no_edge && edges_[edge].is_in_tree;
  }
  const History& history() {
    look();
    return history_;
  }
  /// @}

 private:
  using typename Edge_follower<Traits>::Changed_point;
  using Index = Rooted_forest::Index;
  static constexpr Index no_edge = Rooted_forest::no_edge;

  struct Edge {
    Edge_name name = {};
    bool is_in_tree = false;
    bool is_uncertified = false;   // it may belong to the tree
    std::vector<Index> cycle;      // of its certificate, without the edge itself
    std::vector<Index> certified;  // those with this edge in their cycles
    Queue_handle event = no_event;
  };

  // The time at which `near` becomes longer than `far`: the entry of `owner`, one of the two.
  struct Entry : Failure {
    Index owner = no_edge;
    Index near = no_edge;
    Index far = no_edge;
  };
  using Queue = Failure_queue<Entry, Spanning_tree>;
  friend Queue;

  // The second end of an edge, kept at the first one.
  struct Second_end {
    Neighbor id;
    Index edge;
  };

  // Whether an edge is shorter than another one just after now, and if so, the certificate.
  struct Closer {
    bool holds = false;
    Certificate certificate = {};
  };

  // ---- called by the base ----

  void advance(const Time& time) override {
    execute_until(time);
    begin(time);
  }

  void before_change(std::span<const Edge_name> removed,
                     std::span<const Changed_point> points) override {
    std::vector<Edge_name> affected(removed.begin(), removed.end());
    for (const auto& point : points) {
      if (!this->graph().contains(point.id)) continue;
      for (const Neighbor& other : this->graph().neighbors(point.id)) {
        affected.push_back(pair_of(point.id, other));
      }
    }
    std::erase_if(affected, [](const Edge_name& name) { return !joins_points(name); });
    std::ranges::sort(affected);
    affected.erase(std::unique(affected.begin(), affected.end()), affected.end());
    // First remove all entries that depend on one of them.
    for (const Edge_name& name : affected) {
      const Index edge = find(name);
      const std::vector<Index> certified = edges_[edge].certified;
      for (const Index other : certified) withdraw(other);
      if (edge != longest_) continue;
      for (Index other = 0; other < edges_.size(); ++other) {
        if (edges_[other].is_in_tree) unschedule(other);
      }
      longest_ = no_edge;
    }
    for (const Edge_name& name : affected) {
      const Index edge = find(name);
      if (edges_[edge].is_in_tree) remove_from_tree(edge);
      withdraw(edge);
      if (std::ranges::binary_search(removed, name)) erase(edge);
    }
  }

  void change(const Time& /*time*/, std::span<const Edge_name> /*removed*/,
              std::span<const Edge_name> added,
              std::span<const Changed_point> /*points*/) override {
    resize();
    for (const Edge_name& name : added) {
      if (joins_points(name)) withdraw(insert(name));
    }
    certify_all();
    find_longest();
  }

  // ---- time ----

  // Advances the tree and its history to the current time.
  void look() {
    this->update();
    execute_until(present_time());
    record();
  }

  void begin(const Time& time) {
    if (time == now_) return;
    record();
    now_ = time;
  }

  void record() {
    typename History::Longest_piece longest = {now_};
    if (longest_ != no_edge) {
      longest = {now_, edges_[longest_].name, end(longest_, 0), end(longest_, 1)};
    }
    history_.record(std::move(longest));
  }

  void execute_until(const Time& time) {
    while (const auto due = queue_.take_due(time)) {
      const Entry& entry = due->entry;
      begin(due->time);
      edges_[entry.owner].event = no_event;
      if (!edges_[entry.owner].is_in_tree) {
        withdraw(entry.owner);
        certify_all();
      } else if (entry.is_recheck) {
        new_in_tree_.push_back(entry.owner);
      } else {
        longest_ = entry.owner;
        compare_all_with_longest();
      }
      find_longest();
    }
  }

  // ---- edges ----

  void resize() {
    forest_.resize(this->graph().next_id());
    ends_.resize(this->graph().next_id());
  }

  // Whether the ends are different points; if not, they are images of one.
  static bool joins_points(const Edge_name& name) { return ids_of(name)[0] != ids_of(name)[1]; }

  Index find(const Edge_name& name) const {
    const Point_id first = ids_of(name)[0];
    if (first >= ends_.size()) return no_edge;
    const auto& ends = ends_[first];
    const auto found = std::ranges::find(ends, second_of(name), &Second_end::id);
    return found == ends.end() ? no_edge : found->edge;
  }

  Index insert(const Edge_name& name) {
    if (free_edges_.empty()) {
      free_edges_.push_back(static_cast<Index>(edges_.size()));
      edges_.emplace_back();
    }
    const Index edge = free_edges_.back();
    free_edges_.pop_back();
    edges_[edge].name = name;
    ends_[ids_of(name)[0]].push_back({second_of(name), edge});
    return edge;
  }

  // Precondition: it is not in the tree nor in a cycle, and is not scheduled.
  void erase(Index edge) {
    auto& ends = ends_[ids(edge)[0]];
    *std::ranges::find(ends, edge, &Second_end::edge) = ends.back();
    ends.pop_back();
    edges_[edge] = {};
    free_edges_.push_back(edge);
  }

  const Edge_ids& ids(Index edge) const { return ids_of(edges_[edge].name); }
  decltype(auto) end(Index edge, std::size_t i) const {
    const Edge_name& name = edges_[edge].name;
    return i == 0 ? this->first_end(name) : this->second_end(name);
  }

  // For initial orders, which need not be right.
  double rounded_square_length(Index edge) const {
    const double time = now_.interval().lower;
    const Vector_2 p = rounded_place(end(edge, 0).motion(), time);
    const Vector_2 q = rounded_place(end(edge, 1).motion(), time);
    return (p.x - q.x) * (p.x - q.x) + (p.y - q.y) * (p.y - q.y);
  }

  // ---- comparisons just after now, and the queue ----

  Closer closer(Index near, Index far) const {
    Certificate certificate = this->traits().closer_certificate(end(near, 0), end(near, 1),
                                                                end(far, 0), end(far, 1), now_);
    if (certificate.kind == Certificate::Kind::fails) {
      const bool fails_now = certificate.bounds.lower <= now_.interval().upper &&
                             time_of(certificate, near, far) == now_;
      if (fails_now) return {};
    } else if (certificate.may_be_zero && edges_[near].name > edges_[far].name &&
               distance_comparison_polynomial(end(near, 0), end(near, 1), end(far, 0), end(far, 1))
                   .is_zero()) {
      return {};
    }
    return {true, std::move(certificate)};
  }

  Time time_of(const Certificate& certificate, Index near, Index far) const {
    if (certificate.kind == Certificate::Kind::holds) return Time(certificate.bounds.lower);
    if (certificate.failure) return *certificate.failure;
    return this->traits().closer_failure(end(near, 0), end(near, 1), end(far, 0), end(far, 1),
                                         certificate.bounds);
  }

  Time failure_time(const Entry& entry) const {
    return this->traits().closer_failure(end(entry.near, 0), end(entry.near, 1), end(entry.far, 0),
                                         end(entry.far, 1), entry.bounds);
  }
  bool precedes(const Entry& a, const Entry& b) const {
    return edges_[a.owner].name < edges_[b.owner].name;
  }

  void schedule(Index owner, Index near, Index far, Certificate certificate) {
    Entry entry;
    entry.owner = owner;
    entry.near = near;
    entry.far = far;
    edges_[owner].event = queue_.push(entry, std::move(certificate));
  }
  void unschedule(Index owner) { queue_.erase(std::exchange(edges_[owner].event, no_event)); }

  // ---- cycle certificates ----

  // Removes the cycle certificate of an edge, and marks it as uncertified.
  void withdraw(Index edge) {
    if (edges_[edge].is_uncertified) return;
    for (const Index other : std::exchange(edges_[edge].cycle, {})) {
      auto& certified = edges_[other].certified;
      *std::ranges::find(certified, edge) = certified.back();
      certified.pop_back();
    }
    unschedule(edge);
    edges_[edge].is_uncertified = true;
    uncertified_.push_back(edge);
  }

  // Each edge gets a certificate or enters the tree, mostly instead of a longer one, which is then
  // uncertified. The order does not matter, since the minimum spanning tree is unique.
  void certify_all() {
    for (std::size_t i = 0; i < uncertified_.size(); ++i) {
      const Index edge = uncertified_[i];
      if (!std::exchange(edges_[edge].is_uncertified, false)) continue;
      if (!find_triangle(edge)) find_path(edge);
    }
    uncertified_.clear();
  }

  // Looks for a triangle of edges of which the edge is the longest one. It need not be a face.
  bool find_triangle(Index edge) {
    const Point_id a = ids(edge)[0];
    const Neighbor b = second_of(edges_[edge].name);
    for (const Neighbor& corner : this->graph().neighbors(a)) {
      if (id_of(corner) == a || id_of(corner) == id_of(b)) continue;
      const Index to_b = find(pair_of(id_of(corner), seen_from(corner, b)));
      if (to_b == no_edge) continue;
      const Index to_a = find(pair_of(a, corner));
      Closer first = closer(to_a, edge);
      if (!first.holds) continue;
      Closer second = closer(to_b, edge);
      if (!second.holds) continue;
      std::vector<Certificate> certificates;
      certificates.push_back(std::move(first.certificate));
      certificates.push_back(std::move(second.certificate));
      certify(edge, {to_a, to_b}, std::move(certificates));
      return true;
    }
    return false;
  }

  // The edge enters the tree if it joins two parts of it, or if the longest edge of the path
  // between its ends is longer; else it gets a cycle with the path.
  void find_path(Index edge) {
    std::optional<std::vector<Index>> path = forest_.path(ids(edge)[0], ids(edge)[1]);
    if (!path) return add_to_tree(edge);
    std::vector<Certificate> certificates;
    Index longest = no_edge;
    for (const Index other : *path) {
      Closer comparison = closer(other, edge);
      if (comparison.holds) {
        certificates.push_back(std::move(comparison.certificate));
      } else if (longest == no_edge || closer(longest, other).holds) {
        longest = other;
      }
    }
    if (longest == no_edge) return certify(edge, std::move(*path), std::move(certificates));
    remove_from_tree(longest);
    add_to_tree(edge);
    withdraw(longest);
  }

  // Schedules the first failure of the certificates that the edges of the cycle are shorter. A
  // cycle remains valid when one of its edges leaves the tree.
  void certify(Index edge, std::vector<Index> cycle, std::vector<Certificate> certificates) {
    std::optional<std::size_t> first;
    for (std::size_t i = 0; i < cycle.size(); ++i) {
      edges_[cycle[i]].certified.push_back(edge);
      const Certificate& certificate = certificates[i];
      if (certificate.kind == Certificate::Kind::never_fails) continue;
      const auto is_earlier = [&] {
        if (!first) return true;
        const Certificate& earliest = certificates[*first];
        if (certificate.bounds.upper < earliest.bounds.lower) return true;
        if (certificate.bounds.lower > earliest.bounds.upper) return false;
        return time_of(certificate, cycle[i], edge) < time_of(earliest, cycle[*first], edge);
      };
      if (is_earlier()) first = i;
    }
    if (first) schedule(edge, cycle[*first], edge, std::move(certificates[*first]));
    edges_[edge].cycle = std::move(cycle);
  }

  // ---- the tree, and its longest edge ----

  void add_to_tree(Index edge) {
    forest_.add(edge, ids(edge));
    edges_[edge].is_in_tree = true;
    history_.count(edges_[edge].name, 1);
    new_in_tree_.push_back(edge);
  }

  void remove_from_tree(Index edge) {
    forest_.remove(edge, ids(edge));
    edges_[edge].is_in_tree = false;
    history_.count(edges_[edge].name, -1);
    unschedule(edge);
    if (edge == longest_) longest_ = no_edge;
  }

  // Compares the edges that have entered the tree with the longest one, or all, if that has left.
  void find_longest() {
    const std::vector<Index> added = std::exchange(new_in_tree_, {});
    if (longest_ == no_edge) return compare_all_with_longest();
    for (const Index edge : added) {
      if (!edges_[edge].is_in_tree || edge == longest_) continue;
      unschedule(edge);
      Closer comparison = closer(edge, longest_);
      if (!comparison.holds) {
        longest_ = edge;
        return compare_all_with_longest();
      }
      schedule(edge, edge, longest_, std::move(comparison.certificate));
    }
  }

  // Begins with longest_ or, if there is none, with an edge of about the greatest length.
  void compare_all_with_longest() {
    std::vector<Index> tree;
    for (Index edge = 0; edge < edges_.size(); ++edge) {
      if (!edges_[edge].is_in_tree) continue;
      tree.push_back(edge);
      unschedule(edge);
    }
    if (tree.empty()) return;
    if (longest_ == no_edge) {
      longest_ = *std::ranges::max_element(
          tree, {}, [this](Index edge) { return rounded_square_length(edge); });
    }
    std::vector<std::pair<Index, Certificate>> certificates;
    for (std::size_t i = 0; i < tree.size(); ++i) {
      if (tree[i] == longest_) continue;
      Closer comparison = closer(tree[i], longest_);
      if (comparison.holds) {
        certificates.emplace_back(tree[i], std::move(comparison.certificate));
        continue;
      }
      longest_ = tree[i];
      certificates.clear();
      i = static_cast<std::size_t>(-1);  // all again
    }
    for (auto& [edge, certificate] : certificates) {
      schedule(edge, edge, longest_, std::move(certificate));
    }
  }

  Time now_;
  std::vector<Edge> edges_;
  std::vector<Index> free_edges_;
  std::vector<std::vector<Second_end>> ends_;  // by the id of the first end of an edge
  Rooted_forest forest_;
  std::vector<Index> uncertified_;
  std::vector<Index> new_in_tree_;  // not compared with the longest one yet
  Index longest_ = no_edge;
  History history_;
  Queue queue_{*this};
};

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_OBSERVERS_SPANNING_TREE_H
