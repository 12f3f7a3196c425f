// SPDX-License-Identifier: GPL-3.0-or-later
//
// What queries ask of a kinetic triangulation: nothing about certificates. So the queries that the
// library compiles for its own traits also answer for traits that are derived from those.
#ifndef KINETRI_IMPL_TRIANGULATION_QUERIED_TRIANGULATION_H
#define KINETRI_IMPL_TRIANGULATION_QUERIED_TRIANGULATION_H

#include <optional>
#include <vector>

#include "kinetri/impl/triangulation/kinetic_core.h"
#include "kinetri/triangulation/kinetic_triangulation_2.h"

namespace kinetri::detail {

/// A kinetic triangulation whose certificates may be those of other traits.
template <class Traits>
class Queried_triangulation : public Kinetic_types<Traits> {
 public:
  using typename Kinetic_types<Traits>::Point_2;
  using typename Kinetic_types<Traits>::Time;
  using typename Kinetic_types<Traits>::Triangulation;
  using typename Kinetic_types<Traits>::Vertex_handle;
  using Predicates = typename Kinetic_types<Traits>::Instantaneous_traits;

  virtual ~Queried_triangulation() = default;

  /// @{
  /// As those of Kinetic_triangulation_2.
  virtual const Time& current_time() const = 0;
  virtual const Triangulation& triangulation() const = 0;
  virtual const Triangulation_counters& counters() const = 0;
  virtual Point_id next_id() const = 0;
  virtual bool contains(Point_id id) const = 0;
  virtual bool is_hidden(Point_id id) const = 0;
  virtual Vertex_handle vertex(Point_id id) const = 0;
  virtual const Point_2& point(Point_id id) const = 0;
  virtual bool has_event_before(const Time& time) const = 0;
  /// @}
  virtual Predicates predicates(const Instant& instant) const = 0;
  /// A vertex that is probably near a point now. Precondition: there is a point.
  virtual Vertex_handle vertex_near(const Point_2& point) const = 0;
  /// As Twins has them.
  virtual const std::vector<Point_id>& hidden_by(Point_id shown) const = 0;
  /// The first pair of a point and one that it hides so, in the order of Edge_ids. O(n).
  virtual std::optional<Edge_ids> first_coincident_pair() const = 0;
};

/// One with the certificates of the traits `Own`. It must outlive this object.
template <class Own, class Traits>
class Queried final : public Queried_triangulation<Traits> {
  using Base = Queried_triangulation<Traits>;
  using typename Base::Point_2;
  using typename Base::Predicates;
  using typename Base::Time;
  using typename Base::Triangulation;
  using typename Base::Vertex_handle;

 public:
  explicit Queried(const Kinetic_triangulation_2<Own>& kinetic) : kinetic_(kinetic) {}

  const Time& current_time() const override { return kinetic_.current_time(); }
  const Triangulation& triangulation() const override { return kinetic_.triangulation(); }
  const Triangulation_counters& counters() const override { return kinetic_.counters(); }
  Point_id next_id() const override { return kinetic_.next_id(); }
  bool contains(Point_id id) const override { return kinetic_.contains(id); }
  bool is_hidden(Point_id id) const override { return kinetic_.is_hidden(id); }
  Vertex_handle vertex(Point_id id) const override { return kinetic_.vertex(id); }
  const Point_2& point(Point_id id) const override { return kinetic_.point(id); }
  bool has_event_before(const Time& time) const override { return kinetic_.has_event_before(time); }
  Predicates predicates(const Instant& instant) const override {
    return kinetic_.traits().instantaneous_traits(instant);
  }
  Vertex_handle vertex_near(const Point_2& point) const override {
    return topology().vertex_near(point, current_time().to_double());
  }
  const std::vector<Point_id>& hidden_by(Point_id shown) const override {
    return topology().twins().hidden_by(shown);
  }
  std::optional<Edge_ids> first_coincident_pair() const override {
    std::optional<Edge_ids> first;
    for (const auto& [id, twin] : topology().twins().all()) {
      const Edge_ids pair = {twin.shown, id};
      if (!first || pair < *first) first = pair;
    }
    return first;
  }

 private:
  const Topology<Own>& topology() const { return Core_access::core(kinetic_).topology; }

  const Kinetic_triangulation_2<Own>& kinetic_;
};

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_TRIANGULATION_QUERIED_TRIANGULATION_H
