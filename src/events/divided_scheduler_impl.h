// SPDX-License-Identifier: GPL-3.0-or-later
//
// The definitions of Divided_scheduler that concern several parts.
#ifndef KINETRI_SRC_EVENTS_DIVIDED_SCHEDULER_IMPL_H
#define KINETRI_SRC_EVENTS_DIVIDED_SCHEDULER_IMPL_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "kinetri/impl/events/divided_scheduler.h"

namespace kinetri::detail {

template <class Entry, class Policy>
void Divided_scheduler<Entry, Policy>::move_first(std::size_t from, std::size_t to) {
  Part& source = part(from);
  const Entry entry = source.top();
  const Queue_handle handle = entry.time == Time_pool::none
                                  ? part(to).emplace(entry)
                                  : part(to).push(entry, source.time_of(entry));
  source.pop();
  policy_.set_handle(entry.subject(), named(to, handle));
}

template <class Entry, class Policy>
void Divided_scheduler<Entry, Policy>::move_home(std::size_t from) {
  Part& source = part(from);
  while (!source.empty()) move_first(from, policy_.part_of(source.top().subject()));
}

template <class Entry, class Policy>
Queue_counters Divided_scheduler<Entry, Policy>::counters() const noexcept {
  Queue_counters result = first_.counters();
  for (const auto& part : parts_) {
    result.pushed += part->counters().pushed;
    result.discarded += part->counters().discarded;
  }
  result.peak = std::max<std::uint64_t>(result.peak, size());
  return result;
}

template <class Entry, class Policy>
bool Divided_scheduler<Entry, Policy>::is_valid() const {
  for (std::size_t match = 1; is_first_known() && match < parts_.size(); ++match) {
    if (winners_[match] != winner(match, made)) return false;
  }
  return first_.is_valid() &&
         std::ranges::all_of(parts_, [](const auto& part) { return part->is_valid(); });
}

template <class Entry, class Policy>
Queue_handle Divided_scheduler<Entry, Policy>::push(Entry entry, Algebraic_number time) {
  if (!is_divided()) return first_.push(std::move(entry), std::move(time));
  const std::size_t to = policy_.part_of(entry.subject());
  const Queue_handle result = named(to, part(to).push(std::move(entry), std::move(time)));
  follow(to);
  return result;
}

template <class Entry, class Policy>
void Divided_scheduler<Entry, Policy>::clear() {
  Queue_counters cleared = counters();
  cleared.discarded += size();
  first_.clear();
  parts_.clear();
  forget_first();
  shift_ = shift_of(1);
  first_.count_as(cleared);
}

template <class Entry, class Policy>
Queue_handle Divided_scheduler<Entry, Policy>::emplace_in_parts(const Entry& entry) {
  const std::size_t to = policy_.part_of(entry.subject());
  const Queue_handle result = named(to, part(to).emplace(entry));
  follow(to);
  return result;
}

template <class Entry, class Policy>
const Entry& Divided_scheduler<Entry, Policy>::top_of_parts() const {
  return part(first_part()).top();
}

template <class Entry, class Policy>
Entry Divided_scheduler<Entry, Policy>::pop_of_parts() {
  find_first();
  const std::size_t from = winners_[1];
  Entry result = part(from).pop();
  follow(from);
  return result;
}

template <class Entry, class Policy>
Entry Divided_scheduler<Entry, Policy>::erase_from_parts(Queue_handle handle) {
  const std::size_t from = part_of_handle(handle);
  Entry result = part(from).erase(local(handle));
  follow(from);
  return result;
}

template <class Entry, class Policy>
template <class Time_in>
std::size_t Divided_scheduler<Entry, Policy>::winner(std::size_t match,
                                                     const Time_in& time_in) const {
  const std::size_t p = player(2 * match);
  const std::size_t q = player(2 * match + 1);
  if (parts_[q]->empty()) return p;
  return parts_[p]->empty() || precedes(*parts_[q], *parts_[p], time_in) ? q : p;
}

template <class Entry, class Policy>
void Divided_scheduler<Entry, Policy>::find_first() {
  if (is_first_known()) return;
  try {
    winners_.resize(parts_.size());
    for (std::size_t match = parts_.size(); --match > 0;) set_winner(match);
  } catch (...) {  // a time needs memory
    forget_first();
    throw;
  }
}

// A part has changed. If memory is missing, the tournament is repeated later.
template <class Entry, class Policy>
void Divided_scheduler<Entry, Policy>::follow(std::size_t changed) noexcept {
  if (!is_first_known()) return;
  try {
    for (std::size_t match = (parts_.size() + changed) / 2; match > 0; match /= 2) {
      const std::size_t before = winners_[match];
      set_winner(match);
      // The change has no effect higher up.
      if (winners_[match] == before && before != changed) return;
    }
  } catch (...) {
    forget_first();
  }
}

template <class Entry, class Policy>
void Divided_scheduler<Entry, Policy>::set_winner(std::size_t match) {
  const auto kept = [](Part& part, const Entry& entry) -> const Algebraic_number& {
    return part.time(entry);
  };
  winners_[match] = static_cast<std::uint16_t>(winner(match, kept));
}

// The part that has the first entry. Precondition: not empty.
template <class Entry, class Policy>
std::size_t Divided_scheduler<Entry, Policy>::first_part() const {
  if (is_first_known()) return winners_[1];
  std::size_t first = 0;
  for (std::size_t p = 1; p < parts_.size(); ++p) {
    if (part(p).empty()) continue;
    if (part(first).empty() || precedes(*parts_[p], *parts_[first], made)) first = p;
  }
  return first;
}

template <class Entry, class Policy>
template <class Time_in>
bool Divided_scheduler<Entry, Policy>::precedes(Part& p, Part& q, const Time_in& time_in) const {
  const Entry& a = p.top();
  const Entry& b = q.top();
  if (a.bounds.upper < b.bounds.lower) return true;
  if (b.bounds.upper < a.bounds.lower) return false;
  const auto order = time_in(p, a) <=> time_in(q, b);
  return order != 0 ? order < 0 : policy_.precedes(a, b);
}

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_EVENTS_DIVIDED_SCHEDULER_IMPL_H
