// SPDX-License-Identifier: GPL-3.0-or-later
#include "pictures/coloring.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <utility>

#include "kinetri/impl/io/text.h"
#include "pictures/theme.h"

namespace kinetri::app {
namespace {

constexpr int range_times = 7;         // samples of all numbers for the scale
constexpr double range_beyond = 0.02;  // fraction of the numbers beyond either end of the scale
constexpr double most_linear = 30;     // ratio of the ends up to which the scale is linear
constexpr std::size_t most_kinds = 8;
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

// The name without the number at its end.
std::string kind_of_name(const std::string& name) {
  const std::size_t last = name.find_last_not_of("0123456789");
  if (last == std::string::npos) return name.empty() ? name : "(number)";
  if (last + 1 == name.size()) return name;
  const std::size_t end = name.find_last_not_of(" \t_#.-", last);
  return end == std::string::npos ? "(number)" : name.substr(0, end + 1);
}

// Empty if there are too many.
std::vector<std::string> kinds_of(const Viewer_page& page) {
  std::set<std::string> kinds;
  for (const std::string& name : page.settings.names) {
    kinds.insert(kind_of_name(name));
    if (kinds.size() > most_kinds) return {};
  }
  return {kinds.begin(), kinds.end()};
}

bool is_of_cells(Quantity quantity) {
  return quantity == Quantity::area || quantity == Quantity::density;
}

bool is_whole(Quantity quantity) {
  return quantity == Quantity::degree || quantity == Quantity::changes ||
         quantity == Quantity::members;
}

// For each point the least id in its component; pairs within range are linked.
std::vector<Point_id> components(const std::vector<Periodic_edge>& pairs, std::size_t points) {
  std::vector<Point_id> parent(points);
  std::iota(parent.begin(), parent.end(), Point_id{0});
  const auto root = [&](Point_id id) {
    while (parent[id] != id) id = parent[id] = parent[parent[id]];
    return id;
  };
  for (const auto& [pair, offset] : pairs) {
    const Point_id p = root(pair[0]);
    const Point_id q = root(pair[1]);
    parent[std::max(p, q)] = std::min(p, q);
  }
  for (Point_id& id : parent) id = root(id);
  return parent;
}

// The number of edges added or removed at each point so far.
std::vector<double> changes_so_far(const Playback& playback) {
  std::vector<double> result(playback.points());
  for (std::size_t row = 0; row < playback.rows(); ++row) {
    const Recorded_event& event = playback.recording().events[row];
    for (const auto& edge : {event.removed, event.added}) {
      if (!edge) continue;
      for (const Point_id end : *edge) ++result[end];
    }
  }
  return result;
}

}  // namespace

bool has_encounters(const Viewer_page& page) {
  const auto& encounters = page.settings.encounters;
  return encounters && encounters->all.size() == encounters->in_all;
}

std::vector<Periodic_edge> encounters_at(const Viewer_page& page, double time) {
  std::vector<Periodic_edge> result;
  for (const auto& [points, begin, end, offset] : page.settings.encounters->all) {
    if (begin <= time && time <= end) result.push_back({points, offset});
  }
  return result;
}

std::vector<Quantity> quantities_of(const Viewer_page& page) {
  std::vector<Quantity> result = {Quantity::none,  Quantity::area,   Quantity::density,
                                  Quantity::speed, Quantity::degree, Quantity::changes};
  if (has_weights(page.recording)) result.push_back(Quantity::size);
  if (has_encounters(page)) {
    result.insert(result.end(), {Quantity::component, Quantity::members});
  }
  if (kinds_of(page).size() > 1) result.push_back(Quantity::kind);
  return result;
}

Coloring::Coloring(const Viewer_page& page, Quantity quantity) : page_(page), quantity_(quantity) {
  if (!is_of_kinds()) {
    find_range();
    return;
  }
  if (quantity == Quantity::component) return;
  kinds_ = kinds_of(page);
  for (const std::string& name : page.settings.names) {
    const auto kind = std::ranges::find(kinds_, kind_of_name(name));
    kind_of_point_.push_back(static_cast<double>(kind - kinds_.begin()));
  }
}

// The number of each point by id; no_number if it has none.
std::vector<double> Coloring::numbers(const Playback& playback, const Places& places,
                                      const std::vector<Cell>& cells) const {
  if (quantity_ == Quantity::changes) return changes_so_far(playback);
  if (quantity_ == Quantity::kind) return kind_of_point_;
  std::vector<double> result(places.size(), no_number);
  if (quantity_ == Quantity::component || quantity_ == Quantity::members) {
    const auto component = components(encounters_at(page_, playback.time()), places.size());
    std::vector<std::size_t> size(places.size());
    for (const Point_id least : component) ++size[least];
    for (std::size_t i = 0; i < places.size(); ++i) {
      const std::size_t members = size[component[i]];
      if (quantity_ == Quantity::members) {
        result[i] = static_cast<double>(members);
      } else if (members > 1) {  // isolated points have no color
        result[i] = component[i];
      }
    }
    return result;
  }
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!places[i].is_there) continue;
    if (is_of_cells(quantity_)) {
      const double area = cells[i].area;
      if (area > 0) result[i] = quantity_ == Quantity::area ? area : 1 / area;
    } else if (quantity_ == Quantity::degree) {
      result[i] = static_cast<double>(cells[i].degree);
    } else if (quantity_ == Quantity::size) {
      result[i] = places[i].radius;
    } else {
      const Vector_2 v =
          rounded_velocity(*playback.motion(static_cast<Point_id>(i)), playback.time());
      result[i] = std::hypot(v.x, v.y);
    }
  }
  return result;
}

// Samples the numbers at some times of the run.
void Coloring::find_range() {
  Playback playback(page_.recording);
  const auto& [from, until] = std::pair(page_.recording.from, page_.recording.until);
  const double span = std::min(until - from, std::numeric_limits<double>::max());
  std::vector<double> all;
  for (int i = 0; i < range_times; ++i) {
    playback.go_to(std::min(from + span * i / (range_times - 1), until));
    const Places places(playback);
    const std::vector<double> now =
        numbers(playback, places, cells(playback, places, page_.settings.box));
    for (std::size_t k = 0; k < now.size(); ++k) {
      if (places[k].is_there && std::isfinite(now[k])) all.push_back(now[k]);
    }
  }
  if (all.empty()) return;
  std::ranges::sort(all);
  const auto last = static_cast<double>(all.size() - 1);
  const double beyond = is_whole(quantity_) ? 0 : range_beyond;
  least_ = all[static_cast<std::size_t>(std::floor(beyond * last))];
  greatest_ = all[static_cast<std::size_t>(std::ceil((1 - beyond) * last))];
  is_logarithmic_ = is_of_cells(quantity_) && greatest_ > most_linear * least_;
  is_cut_ = all.front() < least_ || all.back() > greatest_;
}

std::vector<std::optional<Color>> Coloring::colors(const Playback& playback, const Places& places,
                                                   const std::vector<Cell>& cells) const {
  const std::vector<double> now = numbers(playback, places, cells);
  const auto height = [this](double x) { return is_logarithmic_ ? std::log(x) : x; };
  const double span = height(greatest_) - height(least_);
  std::vector<std::optional<Color>> result(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!places[i].is_there || !std::isfinite(now[i])) continue;
    if (is_of_kinds()) {
      result[i] = kind_color(static_cast<std::size_t>(now[i]));
      continue;
    }
    const double share = span > 0 ? (height(now[i]) - height(least_)) / span : 0;
    const double shade = std::round(std::clamp(share, 0.0, 1.0) * (shades - 1));
    result[i] = Color{color_scale()[static_cast<std::size_t>(shade)]};
  }
  return result;
}

std::string Coloring::title(const std::string& unit) const {
  std::string result;
  std::string measure;
  switch (quantity_) {
    case Quantity::area:
      result = "Cell area";
      measure = joined("in ", unit, "\u00b2");
      break;
    case Quantity::density:
      result = "Density";
      measure = joined("in 1 / ", unit, "\u00b2");
      break;
    case Quantity::speed:
      result = "Speed";
      measure = joined("in ", unit, " per unit of time");
      break;
    case Quantity::size:
      result = "Disc radius";
      measure = joined("in ", unit);
      break;
    case Quantity::degree:
      return "Neighbors";
    case Quantity::changes:
      return "Changes so far";
    case Quantity::members:
      return "Points in the component";
    default:
      return "Kind";
  }
  if (!unit.empty()) append(result, ", ", measure);
  if (is_logarithmic_) append(result, ", logarithmic");
  return result;
}

}  // namespace kinetri::app
