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

void Pressure_output::start(const Any_simulation& simulation, double until) {
  simulation.visit([&]<class Traits>(Simulation_2<Traits>& s) {
    if constexpr (PeriodicKineticTraits_2<Traits>) {
      times_ = frame_times(s.current_time().tight_interval().upper, until, rate_);
      const auto observer = std::make_shared<Mean_pressure<Traits>>(s);
      measure_ = [observer] { return observer->next(); };
    } else {
      throw Usage_error(
          "--pressure: is for periodic boxes; expected --periodic LX,LY as well, since walls have "
          "a pressure of their own");
    }
  });
}

std::optional<double> Pressure_output::next_time() const {
  if (next_ >= times_.size()) return std::nullopt;
  return times_[next_];
}

void Pressure_output::write(std::ostream& out) {
  std::string header;
  std::string row;
  const Pressure_2 mean = measure_();
  detail::Pressure_columns::visit([&](const char* name, const auto& value) {
    append(header, header.empty() ? "" : ",", name);
    append(row, row.empty() ? "" : ",", std::invoke(value, mean));
  });
  if (next_++ == 1) out << header << '\n';
  out << row << '\n';
}

}  // namespace kinetri::app
