// SPDX-License-Identifier: GPL-3.0-or-later
#include "outputs/pressure_output.h"

#include <array>
#include <memory>

#include "answers/table_answer.h"
#include "cli/arguments.h"
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
  write_header(out, detail::Pressure_columns());
}

std::optional<double> Pressure_output::next_time() const {
  if (next_ >= times_.size()) return std::nullopt;
  return times_[next_];
}

void Pressure_output::write(std::ostream& out) {
  ++next_;
  write_rows(out, detail::Pressure_columns(), std::array{measure_()});
}

}  // namespace kinetri::app
