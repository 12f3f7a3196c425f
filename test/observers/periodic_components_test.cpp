// SPDX-License-Identifier: GPL-3.0-or-later
//
// Connected components at a range in periodic boxes, and which of them wrap around the box,
// compared with a search over all pairs of images in range.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "kinetri/observers/connected_components.h"
#include "observers/dynamic_connectivity.h"
#include "observers/random_runs.h"
#include "support/observed_periodic_run.h"

namespace kinetri::periodic_components_test {
namespace {

using Traits = Periodic_kinetic_traits_2;
using Kinetic = Kinetic_delaunay_triangulation_2<Traits>;
using Kind = Component_event_kind;
using Time = Algebraic_number;
using test::Periodic_run;

// ---- by definition ----

struct Component {
  std::size_t size = 0;
  int directions = 0;
  Point_id least = no_point;  // of its points
};

/// The component of each point, for these links: by paths from an image of a point to others of it.
/// Two paths to one point that differ by a net offset make a cycle. The search goes on until no
/// point gets a place.
std::map<Point_id, Component> components_of(const std::set<Point_id>& points,
                                            const std::set<Periodic_edge>& links) {
  std::map<Point_id, std::array<std::int64_t, 2>> places;
  std::map<Point_id, Component> result;
  for (const Point_id root : points) {
    if (places.contains(root)) continue;
    places[root] = {0, 0};
    std::set<Point_id> members = {root};
    for (bool has_grown = true; has_grown;) {
      has_grown = false;
      for (const auto& [ids, offset] : links) {
        const auto [a, b] = ids;
        if (members.contains(a) && members.insert(b).second) {
          places[b] = {places[a][0] + offset.x, places[a][1] + offset.y};
          has_grown = true;
        }
        if (members.contains(b) && members.insert(a).second) {
          places[a] = {places[b][0] - offset.x, places[b][1] - offset.y};
          has_grown = true;
        }
      }
    }
    // The rank of the net offsets.
    std::vector<std::array<std::int64_t, 2>> nets;
    for (const auto& [ids, offset] : links) {
      const auto [a, b] = ids;
      if (!members.contains(a)) continue;
      nets.push_back(
          {places[a][0] + offset.x - places[b][0], places[a][1] + offset.y - places[b][1]});
    }
    int rank = 0;
    for (const auto& u : nets) {
      if (u[0] != 0 || u[1] != 0) rank = std::max(rank, 1);
      for (const auto& v : nets) {
        if (u[0] * v[1] != u[1] * v[0]) rank = 2;
      }
    }
    for (const Point_id id : members) result[id] = {members.size(), rank, *members.begin()};
  }
  return result;
}

/// The numbers that an event tells of all components.
struct Numbers {
  std::size_t components = 0;
  std::size_t largest = 0;
  std::size_t wrapping = 0;

  explicit Numbers(const std::map<Point_id, Component>& of_points) {
    double number = 0;
    double number_that_wraps = 0;
    for (const auto& [id, component] : of_points) {
      number += 1.0 / static_cast<double>(component.size);
      if (component.directions > 0) number_that_wraps += 1.0 / static_cast<double>(component.size);
      largest = std::max(largest, component.size);
    }
    components = static_cast<std::size_t>(number + 0.5);
    wrapping = static_cast<std::size_t>(number_that_wraps + 0.5);
  }
  explicit Numbers(const Component_event& event)
      : components(event.components), largest(event.largest), wrapping(event.wrapping) {}
};

std::string text(const Numbers& numbers) {
  return std::to_string(numbers.components) + " components, the largest of " +
         std::to_string(numbers.largest) + ", " + std::to_string(numbers.wrapping) + " wrap";
}

TEST(Periodic_connectivity, is_that_of_a_search_over_all_edges) {
  for (unsigned seed = 0; seed < test::cases(100u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    const unsigned most = 1 + seed % 7;
    Basic_dynamic_connectivity<Periodic_edge> graph;
    std::set<Point_id> points;
    std::set<Periodic_edge> edges;
    for (int step = 0; step < 120; ++step) {
      const auto a = static_cast<Point_id>(random() % most);
      const auto b = static_cast<Point_id>(random() % most);
      const auto number = [&] { return static_cast<std::int32_t>(random() % 3) - 1; };
      const std::int32_t x = number();
      const Lattice_offset_2 offset = {x, seed % 3 == 0 ? 0 : number()};
      if (!points.contains(a)) {
        graph.add_point(a);
        points.insert(a);
      } else if (points.contains(b) && !(a == b && offset == Lattice_offset_2())) {
        const Periodic_edge edge = periodic_edge(a, b, offset);
        ASSERT_EQ(graph.is_edge(edge), edges.contains(edge));
        // Few at a time, so that components split and unwrap.
        if (edges.contains(edge)) {
          graph.remove_edge(edge);
          edges.erase(edge);
        } else {
          graph.add_edge(edge);
          edges.insert(edge);
        }
      }
      if (edges.size() > most) {
        const auto one =
            std::next(edges.begin(), static_cast<std::ptrdiff_t>(random() % edges.size()));
        graph.remove_edge(*one);
        edges.erase(one);
      }
      const auto expected = components_of(points, edges);
      for (const auto& [id, component] : expected) {
        ASSERT_EQ(graph.size_of(id), component.size) << "step " << step;
        ASSERT_EQ(graph.wrapping_directions(id), component.directions) << "step " << step;
      }
      const Numbers numbers(expected);
      ASSERT_EQ(graph.number_of_components(), numbers.components);
      ASSERT_EQ(graph.largest(), numbers.largest);
      ASSERT_EQ(graph.number_of_wrapping_components(), numbers.wrapping);
    }
  }
}

// ---- by hand ----

TEST(Periodic_components, of_a_chain_around_the_box_wrap) {
  // A square of the side 4; two points at rest, and one that passes between them.
  const Periodic_box_2 box({{4, 0}, {0, 0}, 0}, {{0, 4}, {0, 0}, 0});
  const std::vector<Linear_motion_2> motions = {
      {{0, 0}, {0, 0}, 0}, {{2, 0}, {0, 0}, 0}, {{1, -2}, {0, 1}, 0}};
  Kinetic kinetic(motions, Time(), Traits(box));
  Connected_components components(kinetic, 1);
  kinetic.advance_to(1.0);
  EXPECT_EQ(components.number_of_wrapping_components(), 0U);
  // A range of 2 links the two points at rest across the border, too.
  Connected_components more(kinetic, 2);
  EXPECT_EQ(more.wrapping_directions(0), 1);
  EXPECT_EQ(more.wrapping_directions(2), 1);  // it is at most 2 from both
  EXPECT_EQ(more.number_of_wrapping_components(), 1U);
  Connected_components all(kinetic, 4);
  EXPECT_EQ(all.wrapping_directions(1), 2);
}

TEST(Periodic_components, of_one_point_wrap_when_its_images_are_in_range) {
  const Periodic_box_2 box({{4, 0}, {-1, 0}, 0}, {{0, 4}, {0, -0.5}, 0});
  Kinetic kinetic(std::vector<Linear_motion_2>{{{0, 0}, {1, 1}, 0}}, Time(), Traits(box));
  Connected_components components(kinetic, 3);
  kinetic.advance_to(3.0);
  const auto& events = components.events();
  ASSERT_EQ(events.size(), 3U);
  EXPECT_EQ(events[0].kind, Kind::start);
  EXPECT_EQ(events[1].kind, Kind::wrap);
  EXPECT_EQ(events[1].time, Time(1.0));
  EXPECT_EQ(events[1].offset, (Lattice_offset_2{1, 0}));
  EXPECT_EQ(events[1].directions, (std::array{0, 1}));
  EXPECT_EQ(events[1].sizes, (std::array<std::size_t, 2>{1, 0}));
  EXPECT_EQ(events[1].wrapping, 1U);
  EXPECT_EQ(events[2].kind, Kind::wrap);
  EXPECT_EQ(events[2].time, Time(2.0));
  EXPECT_EQ(events[2].directions, (std::array{1, 2}));
  EXPECT_EQ(events[2].components, 1U);
}

// ---- all pairs of images ----

constexpr std::array<double, 6> ranges = {1, 2, 1.5, 3, 2.5, 0};

/// The times at which pairs of images are in range.
std::vector<Encounter> links_of(const Periodic_run& run, double range) {
  std::vector<Encounter> result;
  run.for_each_pair(range, [&](const Periodic_edge& pair, const auto& p, const auto& q) {
    test::add_encounters(p, q, pair, 0, range, false, result);
  });
  return result;
}

/// The links at a time, those that begin or end included, or just after it.
std::set<Periodic_edge> links_at(const std::vector<Encounter>& links, const Time& time,
                                 bool is_after, const Time& now) {
  std::set<Periodic_edge> result;
  for (const Encounter& link : links) {
    const bool is_there =
        link.begin <= time && (is_after ? link.end > time || link.end == now : link.end >= time);
    if (is_there) result.insert({link.points, link.offset});
  }
  return result;
}

/// The closed intervals up to `now` in which the points 0 and 1 are in one component.
class Expected_intervals {
 public:
  using Components = std::map<Point_id, Component>;

  /// The components at a time and just after it. Times ascend.
  void add(const Time& time, const Components& at, const Components& after) {
    if (!since_ && are_connected(at)) since_ = time;
    if (since_ && !are_connected(after)) finish(time);
  }
  void finish(const Time& time) {
    if (since_) intervals.emplace_back(*since_, time);
    since_.reset();
  }
  std::vector<std::pair<Time, Time>> intervals;

 private:
  static bool are_connected(const Components& components) {
    return components.size() > 1 && components.at(0).least == components.at(1).least;
  }
  std::optional<Time> since_;
};

TEST(Periodic_components, are_those_of_all_pairs_of_images_at_all_times) {
  std::size_t connections = 0;
  std::array<std::size_t, component_event_kinds> kinds = {};
  std::size_t two_directions = 0;
  for (unsigned seed = 0; seed < test::cases(120u); ++seed) {
    Periodic_run run(seed);
    const double range = ranges[seed % ranges.size()];
    SCOPED_TRACE("seed " + std::to_string(seed) + ", " + Periodic_run::name(seed) + ", range " +
                 std::to_string(range));
    Connected_components components(run.kinetic(), range);
    components.watch({0, 1});
    run.kinetic().advance_to(1.0);
    if (seed % 2 == 0) static_cast<void>(components.events());
    const Time now(3.0);
    run.kinetic().advance_to(now);
    const auto& events = components.events();
    const auto links = links_of(run, range);
    std::set<Point_id> points;
    for (Point_id id = 0; id < run.kinetic().next_id(); ++id) points.insert(id);
    // At each time at which a link begins or ends: after the merges, and after the splits.
    std::set<Time> times = {Time(0.0)};
    for (const Encounter& link : links) times.insert({link.begin, link.end});
    auto event = events.begin();
    Expected_intervals connected;
    for (const Time& time : times) {
      if (time == now) break;
      ASSERT_TRUE(event == events.end() || event->time >= time)
          << "an event at no time at which a link begins or ends";
      // Merges and wraps come first.
      const auto components_at = components_of(points, links_at(links, time, false, now));
      const auto components_after = components_of(points, links_at(links, time, true, now));
      connected.add(time, components_at, components_after);
      const Numbers at(components_at);
      const Numbers after(components_after);
      auto last = event == events.begin() ? event : event - 1;
      while (
          event != events.end() && event->time == time &&
          (event->kind == Kind::start || event->kind == Kind::merge || event->kind == Kind::wrap)) {
        last = event++;
      }
      ASSERT_EQ(text(Numbers(*last)), text(at)) << "at " << time.to_double();
      while (event != events.end() && event->time == time) {
        ASSERT_TRUE(event->kind == Kind::split || event->kind == Kind::unwrap);
        last = event++;
      }
      ASSERT_EQ(text(Numbers(*last)), text(after)) << "after " << time.to_double();
    }
    const auto at_end = components_of(points, links_at(links, now, false, now));
    connected.add(now, at_end, at_end);
    connected.finish(now);
    const auto found = components.connected_intervals({0, 1});
    ASSERT_EQ(found.size(), connected.intervals.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      ASSERT_EQ(found[i].begin, connected.intervals[i].first);
      ASSERT_EQ(found[i].end, connected.intervals[i].second);
    }
    connections += found.size();
    for (const Component_event& each : events) {
      ++kinds[static_cast<std::size_t>(each.kind)];
      two_directions += each.kind == Kind::wrap && each.directions[1] == 2;
    }
  }
  EXPECT_GT(kinds[static_cast<std::size_t>(Kind::merge)], 25U);
  EXPECT_GT(kinds[static_cast<std::size_t>(Kind::split)], 25U);
  EXPECT_GT(kinds[static_cast<std::size_t>(Kind::wrap)], 25U);
  EXPECT_GT(kinds[static_cast<std::size_t>(Kind::unwrap)], 25U);
  EXPECT_GT(two_directions, 8U);
  EXPECT_GT(connections, 60U);
}

// Points that turn, jump, come, go, and coincide with images of others for a while.
TEST(Periodic_components, of_points_that_change_are_those_of_all_pairs_of_images) {
  std::size_t wrapping = 0;
  for (unsigned seed = 0; seed < test::cases(100u); ++seed) {
    Periodic_run run(seed);
    const double range = ranges[seed % ranges.size()];
    SCOPED_TRACE("seed " + std::to_string(seed) + ", " + Periodic_run::name(seed) + ", range " +
                 std::to_string(range));
    Connected_components components(run.kinetic(), range);
    for (double time = 0; time <= 3; time += 0.5) {
      run.kinetic().advance_to(time);
      const int changes = run.integer(0, 3);
      for (int i = 0; i < changes; ++i) run.change();
      if (run.integer(0, 2) == 0) continue;
      std::set<Point_id> points;
      for (Point_id id = 0; id < run.kinetic().next_id(); ++id) {
        if (run.kinetic().contains(id)) points.insert(id);
      }
      // Just after the time: that of the present motions.
      const auto expected = components_of(points, run.links_after(range));
      for (const auto& [id, component] : expected) {
        ASSERT_EQ(components.size_of(id), component.size) << "point " << id << ", " << time;
        ASSERT_EQ(components.wrapping_directions(id), component.directions)
            << "point " << id << ", " << time;
        wrapping += component.directions > 0;
      }
      const Numbers numbers(expected);
      ASSERT_EQ(text(Numbers(components.events().back())), text(numbers));
    }
  }
  EXPECT_GT(wrapping, 120U);
}

}  // namespace
}  // namespace kinetri::periodic_components_test
