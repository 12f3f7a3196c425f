// SPDX-License-Identifier: GPL-3.0-or-later
#include "outputs/area_output.h"

#include <fstream>
#include <ostream>
#include <string>

#include "cli/arguments.h"
#include "cli/text.h"
#include "kinetri/impl/io/input_text.h"
#include "kinetri/impl/io/text.h"
#include "outputs/frame_times.h"

namespace kinetri::app {

Cell_limits cell_limits(const Answer_settings& settings, const Run_source& source, bool is_periodic,
                        const char* option) {
  Cell_limits result;
  if (settings.cutoff) result.cutoff = *settings.cutoff;
  if (is_periodic) return result;  // all cells are bounded
  if (!settings.walkable) {
    const std::string area = source.walkable_area();
    if (area.empty() && !settings.cutoff) {
      throw Usage_error(joined(option,
                               ": cells of points on the convex hull are unbounded; expected "
                               "--walkable FILE, or --cutoff R, or both as well"));
    }
    if (area.empty()) return result;
    result.walkable =
        Walkable_area::from_wkt(area, input_name(source.path()) + " (its walkable area)");
    return result;
  }
  constexpr std::size_t longest = std::size_t{1} << 26;
  const std::string& path = *settings.walkable;
  std::ifstream in = open_input(path, "a walkable area, as Well-Known Text");
  std::string text;
  std::string piece(std::size_t{1} << 16, '\0');
  while (in) {
    in.read(piece.data(), static_cast<std::streamsize>(piece.size()));
    text.append(piece, 0, static_cast<std::size_t>(in.gcount()));
    if (text.size() >= longest) {
      throw Input_error(path, 0, joined("has ", longest, " bytes or more; expected fewer"));
    }
  }
  if (in.bad()) throw Input_error(path, 0, "cannot be read to its end; expected a readable file");
  result.walkable = Walkable_area::from_wkt(text, path);
  return result;
}

void Area_output::start(const Run_source& source, const Any_simulation& simulation, double until) {
  labels_ = source.labels();
  const double from =
      simulation.visit([](const auto& s) { return s.current_time().tight_interval().upper; });
  const std::optional<Frame_rate> own = source.frame_rate();
  times_ = !rate_ && own ? times_of_input(from, until, *own) : frame_times(from, until, rate_);
}

std::optional<double> Area_output::next_time() const {
  if (next_ == times_.size()) return std::nullopt;
  return times_[next_];
}

void Area_output::write(std::ostream& out, const Any_simulation& simulation) {
  std::string rows;
  if (next_ == 0) append(rows, "t,id,area,density", labels_.empty() ? "\n" : ",label\n");
  const double time = times_[next_++];
  const std::vector<Cell_area> areas =
      simulation.visit([&](const auto& s) { return cell_areas(s.triangulation(), *limits_); });
  for (const Cell_area& cell : areas) {
    append(rows, time, ",", cell.id, ",", cell.area, ",");
    if (cell.area > 0) append(rows, cell.density());
    if (!labels_.empty()) append(rows, ",", csv_field(labels_[cell.id]));
    rows += '\n';
  }
  out << rows;
}

}  // namespace kinetri::app
