// SPDX-License-Identifier: GPL-3.0-or-later
#include "outputs/pressure_output.h"

#include <memory>
#include <ostream>
#include <string>

#include "cli/arguments.h"
#include "kinetri/impl/io/text.h"
#include "kinetri/impl/observers/answer_columns.h"
#include "outputs/frame_times.h"

namespace kinetri::app {

void Pressure_output::start(std::ostream& out, const Any_simulation& simulation, double until) {
  simulation.visit([&]<class Traits>(Simulation_2<Traits>& s) {
    if constexpr (PeriodicKineticTraits_2<Traits>) {
      times_ = frame_times(s.current_time().tight_interval().upper, until, rate_);
      if (times_.back() < until) times_.push_back(until);
      const auto observer = std::make_shared<Mean_pressure<Traits>>(s);
      measure_ = [observer] { return observer->next(); };
    } else {
      throw Usage_error(
          "--pressure: is for periodic boxes, and this run is in the plane; expected a run in a "
          "periodic box, or no --pressure");
    }
  });
  std::string header;
  detail::Pressure_columns::visit([&](const char* name, const auto& /*value*/) {
    append(header, header.empty() ? "" : ",", name);
  });
  out << header << '\n';
}

std::optional<double> Pressure_output::next_time() const {
  if (next_ >= times_.size()) return std::nullopt;
  return times_[next_];
}

void Pressure_output::write(std::ostream& out) {
  ++next_;
  std::string row;
  const Pressure_2 mean = measure_();
  detail::Pressure_columns::visit([&](const char* /*name*/, const auto& value) {
    append(row, row.empty() ? "" : ",", std::invoke(value, mean));
  });
  out << row << '\n';
}

}  // namespace kinetri::app
