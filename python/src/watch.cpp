// SPDX-License-Identifier: GPL-3.0-or-later
#include "watch.h"

#include <array>
#include <string_view>

#include "kinetri/impl/base/check.h"
#include "kinetri/impl/observers/answer_columns.h"
#include "kinetri/io/certificate_log.h"
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

// The table of an observer.
template <class Observer, class Columns>
class Watch_of final : public Watch {
 public:
  template <class... Arguments>
  explicit Watch_of(Columns columns, Arguments&&... arguments)
      : columns_(std::move(columns)), observer_(std::forward<Arguments>(arguments)...) {}

  Answer_table table() override {
    const auto& rows = Columns::rows(observer_);
    Answer_table result;
    columns_.visit([&](const char* name, const auto& value, bool is_known = true) {
      result.add(name, rows, value, is_known);
    });
    return result;
  }

 private:
  Columns columns_;
  Observer observer_;
};

template <class Observer, class Columns, class... Arguments>
std::unique_ptr<Watch> watch_of(Columns columns, Arguments&&... arguments) {
  return std::make_unique<Watch_of<Observer, Columns>>(std::move(columns),
                                                       std::forward<Arguments>(arguments)...);
}

// Whether points are discs with a radius, so that gaps differ from distances.
template <class Traits>
bool has_discs(const Simulation_2<Traits>& simulation) {
  return HasWeight<typename Traits::Motion> || simulation.options().radius > 0;
}
template <class Traits>
bool has_discs(const Kinetic_triangulation_2<Traits>& /*triangulation*/) {
  return HasWeight<typename Traits::Motion>;
}

template <class Core, class Traits>
std::unique_ptr<Watch> closest(Core& core, const Question& question) {
  if constexpr (std::is_same_v<Core, Simulation_2<Traits>> && HasLinearMotion<Traits>) {
    return watch_of<Closest_approaches<Traits>>(
        detail::Approach_columns{has_discs(core), PeriodicKineticTraits_2<Traits>}, core,
        question.number);
  } else {
    refuse("closest approaches are those of a simulation of points that move along straight lines");
  }
}

template <class Core, class Traits>
std::unique_ptr<Watch> encounters(Core& core, const Question& question) {
  if constexpr (std::is_constructible_v<Encounters<Traits>, Core&, double>) {
    return watch_of<Encounters<Traits>>(
        detail::Encounter_columns{has_discs(core), PeriodicKineticTraits_2<Traits>}, core,
        *question.distance);
  } else {
    refuse("encounters of discs with radii of their own are those of a Simulation");
  }
}

template <class Core, class Traits>
std::unique_ptr<Watch> components(Core& core, const Question& question) {
  if constexpr (HasWeight<typename Traits::Motion>) {
    refuse(
        "components are those of points, or of discs of one radius; these have radii of their own");
  } else {
    return watch_of<Connected_components<Traits>>(
        detail::Component_columns{PeriodicKineticTraits_2<Traits>}, core, *question.distance);
  }
}

// Rows have the points of the first pair; with several pairs, the package replaces them by names.
template <class Core, class Traits>
std::unique_ptr<Watch> connected(Core& core, const Question& question) {
  if constexpr (HasWeight<typename Traits::Motion>) {
    refuse("connected are points, or discs of one radius; these have radii of their own");
  } else {
    using Names = detail::Connection_columns<Point_id>;
    const std::vector<std::vector<Edge_ids>> pairs = {question.pairs};
    const Names names = {
        {question.pairs.empty() ? Edge_ids{no_point, no_point} : question.pairs.front()}};
    return watch_of<detail::Connections<Traits>>(names, core, *question.distance, pairs);
  }
}

template <class Core, class Traits>
std::unique_ptr<Watch> spanning_tree(Core& core, const Question& /*question*/) {
  if constexpr (HasWeight<typename Traits::Motion>) {
    refuse(
        "spanning trees are those of points, or of discs of one radius; these have radii of their "
        "own");
  } else {
    return watch_of<detail::Spanning_tree_rows<Traits>>(
        detail::Spanning_tree_columns{PeriodicKineticTraits_2<Traits>}, core);
  }
}

template <class Core, class Traits>
std::unique_ptr<Watch> neighbor_lives(Core& core, const Question& question) {
  return watch_of<Neighbor_lives<Traits>>(
      detail::Neighbor_life_columns{question.distance.has_value(), PeriodicKineticTraits_2<Traits>},
      core, question.distance);
}

template <class Core, class Traits>
std::unique_ptr<Watch> exchanges(Core& core, const Question& question) {
  return watch_of<Neighbor_lives<Traits>>(detail::Exchange_columns{question.distance.has_value()},
                                          core, question.distance);
}

template <class Core, class Traits>
std::unique_ptr<Watch> nearest_neighbor_changes(Core& core, const Question& /*question*/) {
  if constexpr (HasNearestNeighbors<Traits>) {
    return watch_of<Nearest_neighbors<Traits>>(
        detail::Nearest_neighbor_columns{PeriodicKineticTraits_2<Traits>}, core);
  } else {
    refuse(
        "nearest neighbors are those of points, or of discs of one radius; these have radii of "
        "their own");
  }
}

template <class Core, class Traits>
std::unique_ptr<Watch> mean_areas(Core& core, const Question& question) {
  return watch_of<Mean_cell_areas<Traits>>(detail::Mean_area_columns(), core, *question.limits,
                                           question.tolerance);
}

template <class Core, class Traits>
std::unique_ptr<Watch> pressure(Core& core, [[maybe_unused]] const Question& question) {
  if constexpr (PeriodicKineticTraits_2<Traits> && std::is_same_v<Core, Simulation_2<Traits>>) {
    return watch_of<Mean_pressure<Traits>>(detail::Pressure_columns(), core);
  } else {
    refuse("the pressure is that of a Simulation in a periodic box; expected box=kinetri.Box(...)");
  }
}

template <class Traits>
const Kinetic_triangulation_2<Traits>& triangulation_of(const Simulation_2<Traits>& simulation) {
  return simulation.triangulation();
}
template <class Traits>
const Kinetic_triangulation_2<Traits>& triangulation_of(
    const Kinetic_triangulation_2<Traits>& triangulation) {
  return triangulation;
}

template <class Traits>
Simulation_options options_of(const Simulation_2<Traits>& simulation) {
  return simulation.options();
}
template <class Traits>
Simulation_options options_of(const Kinetic_triangulation_2<Traits>& /*triangulation*/) {
  return {};
}

// A row for each event, with the line of its certificate.
template <class Core, class Traits>
class Certificate_watch final : public Watch {
 public:
  explicit Certificate_watch(Core& core)
      : core_(core),
        observer_(triangulation_of(core), options_of(core),
                  [this](const Event_certificate& certificate) { add(certificate); }) {
    core_.add_observer(observer_);
  }
  ~Certificate_watch() override { core_.remove_observer(observer_); }
  Certificate_watch(const Certificate_watch&) = delete;
  Certificate_watch& operator=(const Certificate_watch&) = delete;

  Answer_table table() override {
    Answer_table result;
    result.add("event", rows_, &Row::event);
    result.add("kind", rows_, &Row::kind);
    result.add("certificate", rows_, &Row::line);
    return result;
  }

 private:
  struct Row {
    std::size_t event;
    std::string kind;
    std::string line;
  };

  void add(const Event_certificate& certificate) {
    std::string line = certificate_line(certificate);
    line.pop_back();  // its end
    rows_.push_back({static_cast<std::size_t>(certificate.event),
                     std::string(name(certificate.kind)), std::move(line)});
  }

  Core& core_;
  std::vector<Row> rows_;
  Event_certificates<Traits> observer_;
};

template <class Core, class Traits>
std::unique_ptr<Watch> certificates(Core& core, const Question& /*question*/) {
  return std::make_unique<Certificate_watch<Core, Traits>>(core);
}

// The questions by name.
template <class Core>
struct Named_question {
  std::string_view about;
  std::unique_ptr<Watch> (*watch)(Core&, const Question&);
};

}  // namespace

template <class Core>
std::unique_ptr<Watch> watch(Core& core, const Question& question) {
  using Traits = typename Traits_of<Core>::type;
  constexpr std::array<Named_question<Core>, 11> questions = {{
      {"closest", &closest<Core, Traits>},
      {"encounters", &encounters<Core, Traits>},
      {"components", &components<Core, Traits>},
      {"connected", &connected<Core, Traits>},
      {"spanning_tree", &spanning_tree<Core, Traits>},
      {"neighbor_lives", &neighbor_lives<Core, Traits>},
      {"exchanges", &exchanges<Core, Traits>},
      {"nearest_neighbor_changes", &nearest_neighbor_changes<Core, Traits>},
      {"mean_areas", &mean_areas<Core, Traits>},
      {"pressure", &pressure<Core, Traits>},
      {"certificates", &certificates<Core, Traits>},
  }};
  for (const auto& [about, follow] : questions) {
    if (about == question.about) return follow(core, question);
  }
  refuse("nothing is known about " + question.about);
}

#define KINETRI_INSTANTIATE(Traits)                                                         \
  template std::unique_ptr<Watch> watch(Kinetic_triangulation_2<Traits>&, const Question&); \
  template std::unique_ptr<Watch> watch(Simulation_2<Traits>&, const Question&)
KINETRI_INSTANTIATE(Linear_kinetic_traits_2);
KINETRI_INSTANTIATE(Polynomial_kinetic_traits_2);
KINETRI_INSTANTIATE(Disc_kinetic_traits_2);
KINETRI_INSTANTIATE(Polynomial_disc_kinetic_traits_2);
KINETRI_INSTANTIATE(Periodic_kinetic_traits_2);
KINETRI_INSTANTIATE(Periodic_disc_kinetic_traits_2);
#undef KINETRI_INSTANTIATE

}  // namespace kinetri::python
