// SPDX-License-Identifier: GPL-3.0-or-later
#include "tracks_builder.h"

#include <algorithm>
#include <set>
#include <utility>

#include "kinetri/base/error.h"
#include "kinetri/impl/io/input_text.h"
#include "kinetri/impl/io/text.h"

namespace kinetri {
namespace {

bool earlier(const Track_observation& a, const Track_observation& b) {
  return a.time < b.time;
}

}  // namespace

Tracks_builder::Tracks_builder(const std::string& name, Tracks_duplicates duplicates,
                               std::string_view place_name)
    : name_(name), duplicates_(duplicates), place_name_(place_name) {
  result_.place_name = place_name;
}

void Tracks_builder::fail(std::size_t line, const std::string& message) const {
  throw tracks_error(name_, place_name_, line, message);
}

void Tracks_builder::add(const Tracks_row& row) {
  auto found = rows_.find(row.id);
  if (found == rows_.end()) {
    found = rows_.emplace(row.id, Track{"", {}, row.radius}).first;
  }
  Track& track = found->second;
  expect_radius(row, track);
  if (has_rows_) {
    expect_kind_of_time(row);
  } else {
    has_rows_ = true;
    first_line_ = row.line;
  }
  double time = row.time.number;
  if (row.time.date) {
    // Exact: there are fewer than 2^53 rows.
    time = static_cast<double>(dates_.size());
    dates_.push_back(*row.time.date);
  }
  track.observations.push_back({time, row.place, row.line});
}

void Tracks_builder::expect_radius(const Tracks_row& row, const Track& track) const {
  if (row.radius == track.radius) return;
  fail(row.line, joined("id ", in_quotes(row.id), " has the radius ", row.radius, ", but ",
                        track.radius, " in ", place_name_, ' ', track.observations.front().line,
                        "; expected one radius for each id"));
}

void Tracks_builder::expect_kind_of_time(const Tracks_row& row) const {
  const auto& date = row.time.date;
  if (date.has_value() == dates_.empty()) {
    fail(row.line,
         joined("the time is a ", date ? "date" : "number", ", but a ", date ? "number" : "date",
                " in ", place_name_, ' ', first_line_, "; expected one of the two"));
  }
  if (date && date->has_zone != dates_.front().has_zone) {
    fail(row.line, joined("the date has ", date->has_zone ? "a" : "no", " time zone, but ",
                          date->has_zone ? "none" : "one", " in ", place_name_, ' ', first_line_,
                          "; expected one for all dates or for none"));
  }
}

void Tracks_builder::settle() {
  if (is_settled_) return;
  is_settled_ = true;
  if (!dates_.empty()) replace_dates();
  for (auto& [id, track] : rows_) {
    std::vector<Track_observation>& observations = track.observations;
    count_rows_out_of_order(observations);
    if (!std::is_sorted(observations.begin(), observations.end(), earlier)) {
      std::stable_sort(observations.begin(), observations.end(), earlier);
    }
    merge_times(id, observations);
    result_.observations += observations.size();
  }
  sort_tracks();
}

Tracks_file Tracks_builder::finish() {
  settle();
  if (conflict_) fail_at_two_places();
  return std::move(result_);
}

// From indices to seconds since the earliest.
void Tracks_builder::replace_dates() {
  const Timestamp earliest = *std::min_element(dates_.begin(), dates_.end());
  result_.origin = text_of(earliest);
  for (auto& [id, track] : rows_) {
    for (Track_observation& seen : track.observations) {
      seen.time = seconds_between(earliest, dates_[static_cast<std::size_t>(seen.time)]);
    }
  }
  result_.remarks.push_back(joined("t = 0 is ", result_.origin, ", the earliest date",
                                   earliest.has_zone ? "" : ", which has no time zone",
                                   "; times are in seconds"));
}

void Tracks_builder::count_rows_out_of_order(const std::vector<Track_observation>& observations) {
  for (std::size_t i = 1; i < observations.size(); ++i) {
    if (earlier(observations[i], observations[i - 1])) ++result_.rows_out_of_order;
  }
}

// Merges observations at one time.
void Tracks_builder::merge_times(const std::string& id,
                                 std::vector<Track_observation>& observations) {
  std::size_t times = 0;
  std::size_t conflicts = 0;
  std::optional<Conflict> first;
  for (std::size_t begin = 0; begin < observations.size();) {
    std::size_t end = begin + 1;
    while (end < observations.size() && observations[end].time == observations[begin].time) ++end;
    std::optional<Conflict> conflict;
    observations[times++] =
        end == begin + 1 ? observations[begin]
                         : merged(std::span(observations).subspan(begin, end - begin), conflict);
    if (conflict) {
      ++conflicts;
      if (!first || conflict->second.line < first->second.line) first = std::move(conflict);
    }
    begin = end;
  }
  observations.resize(times);
  // Few may be due to rounded times; many to several things with one id.
  const bool is_refused = duplicates_ == Tracks_duplicates::refuse ||
                          (duplicates_ == Tracks_duplicates::automatic && 2 * conflicts >= times);
  if (!first || !is_refused) return;
  first->id = id;
  if (!conflict_ || first->second.line < conflict_->second.line) conflict_ = std::move(first);
}

// The observations are in the order of the file. A conflict has no id yet.
Track_observation Tracks_builder::merged(std::span<const Track_observation> at_one_time,
                                         std::optional<Conflict>& conflict) {
  Track_observation result = at_one_time.front();
  // A tree, so that no input is slow.
  std::set<std::pair<double, double>> places;
  for (const Track_observation& seen : at_one_time) {
    if (!places.insert({seen.place.x, seen.place.y}).second) {
      ++result_.doubled_rows;
      continue;
    }
    if (places.size() == 1) continue;
    if (!conflict) conflict = {"", at_one_time.front(), seen};
    ++result_.rows_at_another_place;
    if (duplicates_ != Tracks_duplicates::mean) continue;
    const auto number = static_cast<double>(places.size());
    const auto mean = [number](double before, double next) {
      return before + (next / number - before / number);
    };
    result.place = {mean(result.place.x, seen.place.x), mean(result.place.y, seen.place.y)};
  }
  if (conflict && duplicates_ == Tracks_duplicates::last) result = at_one_time.back();
  return result;
}

void Tracks_builder::sort_tracks() {
  std::vector<Track>& tracks = result_.tracks;
  tracks.reserve(rows_.size());
  while (!rows_.empty()) {
    auto node = rows_.extract(rows_.begin());
    tracks.push_back(std::move(node.mapped()));
    tracks.back().id = std::move(node.key());
  }
  std::stable_sort(tracks.begin(), tracks.end(), [](const Track& a, const Track& b) {
    const Track_observation& first_a = a.observations.front();
    const Track_observation& first_b = b.observations.front();
    return first_a.time != first_b.time ? first_a.time < first_b.time : first_a.line < first_b.line;
  });
}

void Tracks_builder::fail_at_two_places() const {
  const auto& [id, first, second] = *conflict_;
  fail(second.line,
       joined("id ", in_quotes(id), " is at two places at t = ", second.time, ": at (",
              second.place.x, ", ", second.place.y, "), and at (", first.place.x, ", ",
              first.place.y, ") in ", place_name_, ' ', first.line,
              "; expected one, or --duplicates first, last or mean, which says what to take"));
}

}  // namespace kinetri
