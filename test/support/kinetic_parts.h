// SPDX-License-Identifier: GPL-3.0-or-later
//
// The parts of a kinetic triangulation, each with only the parts that it uses, for tests of one
// part.
#ifndef KINETRI_TEST_SUPPORT_KINETIC_PARTS_H
#define KINETRI_TEST_SUPPORT_KINETIC_PARTS_H

#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "kinetri/impl/triangulation/event_loop_impl.h"
#include "kinetri/impl/triangulation/topology_impl.h"
#include "support/brute_force_simulator.h"

namespace kinetri::test {

inline Linear_motion_2 resting(double x, double y) {
  return {{x, y}, {0, 0}};
}

/// The moving points with these motions, whose ids are their indices.
template <class Point_2, class Motion>
std::vector<Point_2> points_of(const std::vector<Motion>& motions) {
  std::vector<Point_2> points;
  for (const Motion& m : motions) points.emplace_back(m, static_cast<Point_id>(points.size()));
  return points;
}

/// The edges just after a time.
template <class Motion>
std::set<Edge_ids> edges_after(const std::vector<Motion>& motions, const Algebraic_number& time) {
  const std::vector<Algebraic_number> times = critical_times(motions, time);
  const Algebraic_number end =
      times.empty() ? Algebraic_number(Rational(time.upper() + 1)) : times.front();
  return edges_at(motions, simplest_between(time, end));
}

/// CGAL's triangulation of moving points.
template <class Traits = Linear_kinetic_traits_2>
struct Topology_part {
  using Topology = detail::Topology<Traits>;
  using Motion = typename Traits::Motion;
  using Point_2 = typename Traits::Point_2;
  using Edge = typename Topology::Edge;
  using Edge_with_mirror = typename Topology::Edge_with_mirror;
  using Vertex_handle = typename Topology::Vertex_handle;
  using Face_handle = typename Topology::Face_handle;
  using Triangulation = typename Topology::Triangulation;
  using Time = Algebraic_number;

  /// The triangulation just after a time, made by CGAL.
  explicit Topology_part(const std::vector<Motion>& motions, const Time& start = 0.0)
      : topology({start, Time_side::after}) {
    const std::vector<Point_2> points = points_of<Point_2>(motions);
    Triangulation made(Traits().instantaneous_traits(topology.clock()));
    for (const Point_2& point : points) made.insert(point);
    topology.set_weights_equal(Topology::have_equal_weights(points));
    topology.start(std::move(made), points.size());
  }

  std::set<Edge_ids> edges() const {
    const std::vector<Edge_ids> ids = topology.finite_edges();
    return {ids.begin(), ids.end()};
  }
  /// The edge between two points, or between one and the infinite vertex (no_point).
  Edge_with_mirror edge(Point_id a, Point_id b) const {
    const Triangulation& triangulation = topology.triangulation();
    const Vertex_handle v = b == no_point ? triangulation.infinite_vertex() : topology.vertex(b);
    Edge result;
    EXPECT_TRUE(triangulation.is_edge(topology.vertex(a), v, result.first, result.second))
        << "an edge " << a << " - " << b;
    return topology.with_mirror(result);
  }
  std::vector<Edge_with_mirror> all_edges() const {
    std::vector<Edge_with_mirror> result;
    for (const Edge& edge : topology.triangulation().all_edges()) {
      result.push_back(Topology::chosen_side(topology.with_mirror(edge)));
    }
    return result;
  }

  Topology topology;
};

/// The same with certificates.
template <class Traits = Linear_kinetic_traits_2>
struct Certification_part : Topology_part<Traits> {
  using Base = Topology_part<Traits>;
  using Base::Base;
  using typename Base::Edge_with_mirror;
  using typename Base::Time;

  /// The failure of an edge's certificate, which is rechecked while it only holds.
  std::optional<std::pair<detail::Entry_kind, Time>> failure(const Edge_with_mirror& edge,
                                                             Time after) const {
    for (;;) {
      const auto [kind, certificate] = certification.certificate_of(edge, after);
      switch (certificate.kind) {
        case Certificate::Kind::never_fails:
          return std::nullopt;
        case Certificate::Kind::holds:
          EXPECT_LT(after, Time(certificate.bounds.lower)) << "it holds for some time";
          after = Time(certificate.bounds.lower);
          break;
        default:
          return std::pair(kind, certificate.failure
                                     ? *certificate.failure
                                     : certification.failure_time(certification.points(edge),
                                                                  certificate.bounds));
      }
    }
  }

  detail::Certification<Traits> certification{Traits(), this->topology};
};

/// The same with a schedule of all edges.
template <class Traits = Linear_kinetic_traits_2>
struct Schedule_part : Certification_part<Traits> {
  using Base = Certification_part<Traits>;
  using typename Base::Edge_with_mirror;
  using typename Base::Motion;
  using typename Base::Time;

  explicit Schedule_part(const std::vector<Motion>& motions, const Time& start = 0.0)
      : Base(motions, start), schedule(this->certification, start, counters) {
    schedule.schedule_all();
  }

  /// A violation of the invariant of the schedule: an edge has an entry if and only if its
  /// certificate may fail after the present time; the entry is the failure, or a recheck at an
  /// earlier time.
  std::string problem() const {
    std::size_t entries = 0;
    for (const Edge_with_mirror& edge : this->all_edges()) {
      const Queue_handle handle = edge.here.first->event(edge.here.second);
      const auto [a, b] = Topology_part<Traits>::Topology::ids_of(edge.here);
      const std::string who = "edge " + std::to_string(a) + " - " + std::to_string(b);
      if (handle != edge.there.first->event(edge.there.second)) return who + " has two handles";
      const auto expected = this->failure(edge, schedule.current_time());
      if (handle == no_event) {
        if (expected) return who + " fails and has no entry";
        continue;
      }
      ++entries;
      const auto& entry = schedule.queue()[handle];
      const Time time = schedule.queue().time_of(entry);
      if (entry.kind == detail::Entry_kind::recheck) {
        if (expected && expected->second < time) return who + " fails before it is checked again";
      } else if (!expected || expected->second != time) {
        return who + " has an entry at another time than its failure";
      }
    }
    return entries == schedule.queue().size() ? "" : "an entry of no edge";
  }

  Triangulation_counters counters;
  detail::Schedule<Traits> schedule;
};

/// The same with a reporter.
template <class Traits = Linear_kinetic_traits_2>
struct Reporter_part : Schedule_part<Traits> {
  using Schedule_part<Traits>::Schedule_part;

  detail::Event_reporter<Traits> reporter{this->topology, this->schedule, this->counters};
};

/// The same with changes of faces.
template <class Traits = Linear_kinetic_traits_2>
struct Updates_part : Reporter_part<Traits> {
  using Reporter_part<Traits>::Reporter_part;

  typename detail::Kinetic_types<Traits>::Updates updates{this->topology, this->certification,
                                                          this->schedule, this->reporter};
};

/// The same with a loop.
template <class Traits = Linear_kinetic_traits_2>
struct Event_loop_part : Updates_part<Traits> {
  using Updates_part<Traits>::Updates_part;

  typename detail::Kinetic_types<Traits>::Event_loop loop{
      this->topology, this->certification, this->schedule, this->reporter, this->updates};
};

}  // namespace kinetri::test

#endif  // KINETRI_TEST_SUPPORT_KINETIC_PARTS_H
