// SPDX-License-Identifier: GPL-3.0-or-later
#include "watch.h"

#include "kinetri/base/check.h"
#include "kinetri/observers/closest_approaches.h"
#include "kinetri/observers/connected_components.h"
#include "kinetri/observers/encounters.h"
#include "kinetri/observers/mean_cell_areas.h"
#include "kinetri/observers/nearest_neighbors.h"
#include "kinetri/observers/neighbor_lives.h"
#include "kinetri/simulation/simulation_2.h"

namespace kinetri::python {
namespace {

template <class Core>
struct Traits_of;
template <template <class> class Core, class Traits>
struct Traits_of<Core<Traits>> {
  using type = Traits;
};

[[noreturn]] void refuse(const std::string& problem) {
  throw Precondition_error(problem);
}

// An observer, and the function that makes its table.
template <class Observer, class Make_table>
class Watch_of final : public Watch {
 public:
  template <class Core>
  Watch_of(Core& core, auto parameter, Make_table make_table)
      : observer_(core, parameter), make_table_(make_table) {}
  Answer_table table() override { return make_table_(observer_); }

 private:
  Observer observer_;
  Make_table make_table_;
};

template <class Observer, class Core, class Parameter, class Make_table>
std::unique_ptr<Watch> watch_of(Core& core, Parameter parameter, Make_table make_table) {
  return std::make_unique<Watch_of<Observer, Make_table>>(core, parameter, make_table);
}

// Whether distances of centres and gaps between rims differ.
template <class Traits>
bool has_discs(const Simulation_2<Traits>& simulation) {
  return HasWeight<typename Traits::Motion> || simulation.options().radius > 0;
}
template <class Traits>
bool has_discs(const Kinetic_triangulation_2<Traits>& /*triangulation*/) {
  return HasWeight<typename Traits::Motion>;
}

template <class Core, class Traits>
std::unique_ptr<Watch> closest(Core& core, std::size_t number) {
  if constexpr (std::is_same_v<Core, Simulation_2<Traits>> && HasLinearMotion<Traits>) {
    return watch_of<Closest_approaches<Traits>>(
        core, number, [discs = has_discs(core)](auto& observer) {
          const std::vector<Approach> rows = observer.approaches();
          Answer_table result;
          result.add_pair(rows, [](const Approach& row) { return row.points; });
          result.add_times("time", rows, [](const Approach& row) { return row.time; });
          result.add("distance", rows, [](const Approach& row) { return row.distance; });
          if (discs) result.add("gap", rows, [](const Approach& row) { return row.gap; });
          return result;
        });
  } else {
    refuse("closest approaches are those of a simulation of points that move along straight lines");
  }
}

template <class Core, class Traits>
std::unique_ptr<Watch> encounters(Core& core, double range) {
  if constexpr (std::is_constructible_v<Encounters<Traits>, Core&, double>) {
    return watch_of<Encounters<Traits>>(core, range, [discs = has_discs(core)](auto& observer) {
      const std::vector<Encounter> rows = observer.encounters();
      Answer_table result;
      result.add_pair(rows, [](const Encounter& row) { return row.points; });
      result.add_times("begin", rows, [](const Encounter& row) { return row.begin; });
      result.add_times("end", rows, [](const Encounter& row) { return row.end; });
      result.add_times("closest", rows, [](const Encounter& row) { return row.closest; });
      result.add("distance", rows, [](const Encounter& row) { return row.distance; });
      if (discs) result.add("gap", rows, [](const Encounter& row) { return row.gap; });
      return result;
    });
  } else {
    refuse("encounters of discs with radii of their own are those of a Simulation");
  }
}

template <class Core, class Traits>
std::unique_ptr<Watch> components(Core& core, double range) {
  if constexpr (HasWeight<typename Traits::Motion>) {
    refuse(
        "components are those of points, or of discs of one radius; these have radii of their own");
  } else {
    return watch_of<Connected_components<Traits>>(core, range, [](auto& observer) {
      const std::vector<Component_event>& rows = observer.events();
      Answer_table result;
      result.add_times("time", rows, [](const Component_event& row) { return row.time; });
      result.add("kind", rows,
                 [](const Component_event& row) { return std::string(name(row.kind)); });
      result.add_pair(rows, [](const Component_event& row) { return row.points; });
      result.add("components", rows, [](const Component_event& row) {
        return static_cast<std::int64_t>(row.components);
      });
      result.add("largest", rows,
                 [](const Component_event& row) { return static_cast<std::int64_t>(row.largest); });
      return result;
    });
  }
}

template <class Core, class Traits>
std::unique_ptr<Watch> neighbor_lives(Core& core, std::optional<double> ridge) {
  return watch_of<Neighbor_lives<Traits>>(
      core, ridge, [has_ridge = ridge.has_value()](auto& observer) {
        const std::vector<Neighbor_life> rows = observer.lives();
        Answer_table result;
        result.add_pair(rows, [](const Neighbor_life& row) { return row.points; });
        result.add_times("begin", rows, [](const Neighbor_life& row) { return row.begin; });
        result.add_times("end", rows, [](const Neighbor_life& row) { return row.end; });
        result.add("begins_by", rows,
                   [](const Neighbor_life& row) { return std::string(name(row.begins_by)); });
        result.add("ends_by", rows,
                   [](const Neighbor_life& row) { return std::string(name(row.ends_by)); });
        if (has_ridge) {
          result.add("short", rows, [](const Neighbor_life& row) {
            return static_cast<std::uint8_t>(row.is_short ? 1 : 0);
          });
        }
        return result;
      });
}

template <class Core, class Traits>
std::unique_ptr<Watch> exchanges(Core& core, std::optional<double> ridge) {
  return watch_of<Neighbor_lives<Traits>>(
      core, ridge, [has_ridge = ridge.has_value()](auto& observer) {
        using Row = Point_exchanges;
        const std::vector<Row> rows = observer.exchanges();
        const auto number = [](std::size_t value) { return static_cast<std::int64_t>(value); };
        Answer_table result;
        result.add("id", rows, [](const Row& row) { return row.id; });
        result.add_times("begin", rows, [](const Row& row) { return row.from; });
        result.add_times("end", rows, [](const Row& row) { return row.until; });
        result.add("gained", rows, [&](const Row& row) { return number(row.gained); });
        result.add("lost", rows, [&](const Row& row) { return number(row.lost); });
        if (has_ridge) {
          result.add("short", rows, [&](const Row& row) { return number(row.short_ones); });
        }
        return result;
      });
}

template <class Core, class Traits>
std::unique_ptr<Watch> nearest_neighbor_changes(Core& core) {
  if constexpr (HasNearestNeighbors<Traits>) {
    using Row = Nearest_neighbor_change;
    using On_change = typename Nearest_neighbors<Traits>::On_change;
    return watch_of<Nearest_neighbors<Traits>>(core, On_change(), [](auto& observer) {
      const std::vector<Row>& rows = observer.changes();
      Answer_table result;
      result.add_times("time", rows, [](const Row& row) { return row.time; });
      result.add("id", rows, [](const Row& row) { return row.id; });
      result.add("before", rows, [](const Row& row) { return row.before; });
      result.add("after", rows, [](const Row& row) { return row.after; });
      return result;
    });
  } else {
    refuse(
        "nearest neighbors are those of points, or of discs of one radius; these have radii of "
        "their own");
  }
}

template <class Core, class Traits>
std::unique_ptr<Watch> mean_areas(Core& core, const Question& question) {
  struct Observer : Mean_cell_areas<Traits> {
    Observer(Core& observed, const Question& asked)
        : Mean_cell_areas<Traits>(observed, *asked.limits, asked.tolerance) {}
  };
  return watch_of<Observer, Core, const Question&>(core, question, [](auto& observer) {
    const std::vector<Mean_cell_area> rows = observer.means();
    Answer_table result;
    result.add("id", rows, [](const Mean_cell_area& row) { return row.id; });
    result.add("from", rows, [](const Mean_cell_area& row) { return row.from; });
    result.add("until", rows, [](const Mean_cell_area& row) { return row.until; });
    result.add("area", rows, [](const Mean_cell_area& row) { return row.area; });
    result.add("error", rows, [](const Mean_cell_area& row) { return row.error; });
    return result;
  });
}

}  // namespace

template <class Core>
std::unique_ptr<Watch> watch(Core& core, const Question& question) {
  using Traits = typename Traits_of<Core>::type;
  if (question.about == "closest") return closest<Core, Traits>(core, question.number);
  if (question.about == "encounters") return encounters<Core, Traits>(core, *question.distance);
  if (question.about == "components") return components<Core, Traits>(core, *question.distance);
  if (question.about == "neighbor_lives") {
    return neighbor_lives<Core, Traits>(core, question.distance);
  }
  if (question.about == "exchanges") return exchanges<Core, Traits>(core, question.distance);
  if (question.about == "nearest_neighbor_changes") {
    return nearest_neighbor_changes<Core, Traits>(core);
  }
  if (question.about == "mean_areas") return mean_areas<Core, Traits>(core, question);
  refuse("nothing is known about " + question.about);
}

#define KINETRI_INSTANTIATE(Traits)                                                         \
  template std::unique_ptr<Watch> watch(Kinetic_triangulation_2<Traits>&, const Question&); \
  template std::unique_ptr<Watch> watch(Simulation_2<Traits>&, const Question&)
KINETRI_INSTANTIATE(Linear_kinetic_traits_2);
KINETRI_INSTANTIATE(Polynomial_kinetic_traits_2);
KINETRI_INSTANTIATE(Disc_kinetic_traits_2);
KINETRI_INSTANTIATE(Polynomial_disc_kinetic_traits_2);
#undef KINETRI_INSTANTIATE

}  // namespace kinetri::python
