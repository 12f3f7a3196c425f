// SPDX-License-Identifier: GPL-3.0-or-later
//
// Enlarged discs: those with a gap of at most a given range overlap, and perhaps others.
#ifndef KINETRI_SRC_OBSERVERS_ENLARGED_DISCS_H
#define KINETRI_SRC_OBSERVERS_ENLARGED_DISCS_H

#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "kinetri/impl/base/check.h"
#include "observers/edge_follower.h"
#include "simulation/known_responses.h"
#include "simulation/simulation_core.h"

namespace kinetri::detail {

/// A second simulation, beside the observed one, of discs whose radii are greater by somewhat more
/// than half of `range`: two with a gap of at most `range` overlap here, and do not only touch. It
/// tracks all overlaps (docs/MATH.md, section 8); in a periodic box those of images, also of one
/// disc, with radii of any size (section 18).
template <class Traits>
class Enlarged_discs : private Event_observer {
 public:
  using Motion = typename Traits::Motion;
  using Pair = Edge_name<Traits>;
  using Neighbor = Neighbor_name<Traits>;

  /// Two discs that begin to overlap at the time; in a periodic box images. A pair may have
  /// several.
  struct Contact {
    Pair points;
    Algebraic_number time;
  };

  Enlarged_discs(const Neighbor_graph<Traits>& graph, double range, const Algebraic_number& start,
                 const Traits& traits)
      : range_(range), own_ids_(graph.next_id(), no_point) {
    std::vector<Motion> motions;
    for (Point_id id = 0; id < graph.next_id(); ++id) {
      if (graph.contains(id)) motions.push_back(enlarged(graph.point(id).motion()));
      if (graph.contains(id)) know(id, static_cast<Point_id>(motions.size() - 1));
    }
    Simulation_options options;
    options.response = let_images_overlap;
    simulation_ = std::make_unique<Simulation_2<Traits>>(motions, options, start, traits);
    simulation_->add_observer(*this);
  }
  ~Enlarged_discs() override { simulation_->remove_observer(*this); }
  Enlarged_discs(const Enlarged_discs&) = delete;
  Enlarged_discs& operator=(const Enlarged_discs&) = delete;

  /// Advances to `time`. Returns the contacts up to it.
  std::vector<Contact> advance_to(const Algebraic_number& time) {
    simulation_->advance_to(time);
    return std::exchange(contacts_, {});
  }

  /// Makes the changes that have been made in the graph.
  template <class Changed_points>
  void change(const Changed_points& points, const Neighbor_graph<Traits>& graph) {
    std::vector<Point_id> ids;
    std::vector<Motion> motions;
    for (const auto& [id, before] : points) {
      if (!before) continue;
      if (!graph.contains(id)) {
        simulation_->erase(own_ids_[id]);
      } else {
        ids.push_back(own_ids_[id]);
        motions.push_back(enlarged(graph.point(id).motion()));
      }
    }
    if (!ids.empty()) simulation_->set_motions(ids, motions);
    for (const auto& [id, before] : points) {
      if (before || !graph.contains(id)) continue;
      know(id, simulation_->insert(enlarged(graph.point(id).motion())));
    }
  }

  /// The discs that overlap the disc of the point just after the present time.
  std::vector<Neighbor> overlapping(Point_id id) const {
    std::vector<Neighbor> result = Core_access::core(*simulation_)->overlapping_discs(own_ids_[id]);
    for (Neighbor& other : result) other = observed(other);
    return result;
  }

 private:
  // The additional weight does not concern gaps.
  Motion enlarged(Motion motion) const {
    motion.radius =
        std::nextafter(motion.radius + range_ / 2, std::numeric_limits<double>::infinity());
    motion.weight = 0;
    KINETRI_PRECONDITION(std::isfinite(motion.radius),
                         "the range is too large: the sum of a radius and half of it is not "
                         "finite; expected a smaller one");
    return motion;
  }

  void know(Point_id id, Point_id own_id) {
    if (id >= own_ids_.size()) own_ids_.resize(std::size_t{id} + 1, no_point);
    own_ids_[id] = own_id;
    if (own_id >= ids_.size()) ids_.resize(std::size_t{own_id} + 1, no_point);
    ids_[own_id] = id;
  }

  // The observed point, or image, of one here. Each is where it is there, so offsets are the same.
  Neighbor observed(Neighbor own) const {
    if constexpr (PeriodicKineticTraits_2<Traits>) {
      own.id = ids_[own.id];
      return own;
    } else {
      return ids_[own];
    }
  }

  bool looks_at_triangulation() const override { return false; }
  void after_event(const Event& event) override {
    if (event.kind != Event_kind::collision) return;
    Neighbor other;
    if constexpr (PeriodicKineticTraits_2<Traits>) {
      other = {*event.point_b, event.added_offset};
    } else {
      other = *event.point_b;
    }
    contacts_.push_back({pair_of(ids_[*event.point_a], observed(other)), event.time});
  }

  double range_;
  std::unique_ptr<Simulation_2<Traits>> simulation_;
  std::vector<Point_id> own_ids_;  // of the simulation here, by id
  std::vector<Point_id> ids_;      // the reverse
  std::vector<Contact> contacts_;
};

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_OBSERVERS_ENLARGED_DISCS_H
