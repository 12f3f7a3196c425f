// SPDX-License-Identifier: GPL-3.0-or-later
//
// A scheduler in parts beside a sorted list: entries are found under their handles, and come in the
// same order, however they are distributed.
#include "kinetri/impl/events/divided_scheduler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "events/distribute.h"
#include "kinetri/algebra/algebraic_number.h"

namespace kinetri::detail::divided_scheduler_test {
namespace {

struct Entry : Scheduled {
  std::size_t number = 0;
  int mark = 0;

  struct Kept {
    int mark = 0;
  };

  Entry() = default;
  Entry(std::size_t subject, const Double_interval& times, const Kept& kept)
      : Scheduled{times}, number(subject), mark(kept.mark) {}

  std::size_t subject() const { return number; }
  Kept kept() const { return {mark}; }
};

// The time of an entry is known to the policy; its bounds are around it.
struct Policy {
  std::vector<double> times;
  std::vector<std::size_t> parts;
  mutable std::vector<Queue_handle> handles;
  mutable std::size_t times_made = 0;

  Algebraic_number entry_time(const Entry& entry) const {
    ++times_made;
    return times[entry.number];
  }
  bool precedes(const Entry& a, const Entry& b) const { return a.number < b.number; }
  bool is_recheck(const Entry& /*entry*/) const { return false; }
  static void prefetch(const Entry& /*entry*/) {}
  static void prefetch_more(const Entry& /*entry*/) {}
  void prefetch_first(const Entry& /*entry*/) const {}
  std::size_t part_of(std::size_t subject) const { return parts[subject]; }
  Queue_handle handle(std::size_t subject) const { return handles[subject]; }
  void set_handle(std::size_t subject, Queue_handle handle) const { handles[subject] = handle; }
};

class Divided : public testing::TestWithParam<std::uint64_t> {
 protected:
  Divided() : random_(GetParam()), scheduler_(policy_) {
    constexpr std::size_t size = 500;
    policy_.parts.assign(size, 0);
    for (std::size_t k = 0; k < size; ++k) {
      policy_.times.push_back(static_cast<double>(random_() % 200));
      const double time = policy_.times.back();
      const Entry entry(k, {time - 3, time + 2}, {static_cast<int>(3 * k)});
      policy_.handles.push_back(k % 5 == 0 ? scheduler_.push(entry, time)
                                           : scheduler_.emplace(entry));
    }
  }

  // Some subjects belong in other parts then.
  void distribute(std::size_t parts, unsigned percent) {
    for (std::size_t& part : policy_.parts) {
      if (random_() % 100 < percent || part >= parts) part = random_() % parts;
    }
    const std::vector<std::pair<std::size_t, std::size_t>> blocks = {
        {0, 100}, {100, 101}, {101, policy_.times.size()}};
    scheduler_.distribute(
        parts, blocks,
        [this](const auto& block, const auto& function) {
          for (std::size_t k = block.first; k < block.second; ++k) {
            if (policy_.handles[k] != no_event) function(k);
          }
        },
        [](auto& elements, const auto& work) {
          for (auto& element : elements) work(element);
        });
  }

  void expect_everything_in_its_place(std::size_t parts) {
    ASSERT_EQ(scheduler_.number_of_parts(), parts);
    ASSERT_TRUE(scheduler_.is_valid());
    std::size_t size = 0;
    for (std::size_t k = 0; k < policy_.times.size(); ++k) {
      const Queue_handle handle = policy_.handles[k];
      if (handle == no_event) continue;
      ++size;
      ASSERT_TRUE(scheduler_.contains(handle));
      ASSERT_EQ(scheduler_.part_of_handle(handle), parts == 1 ? 0 : policy_.parts[k]);
      const Entry& entry = scheduler_[handle];
      ASSERT_EQ(entry.number, k);
      ASSERT_EQ(entry.mark, static_cast<int>(3 * k));
      ASSERT_EQ(entry.bounds.lower, policy_.times[k] - 3);
      ASSERT_EQ(entry.bounds.upper, policy_.times[k] + 2);
    }
    ASSERT_EQ(scheduler_.size(), size);
    // What a distribution moves is counted nowhere.
    const Queue_counters counters = scheduler_.counters();
    ASSERT_EQ(counters.pushed, policy_.times.size());
    ASSERT_EQ(counters.discarded, 0u);
  }

  void pop(std::size_t number) {
    for (std::size_t k = 0; k < number && !scheduler_.empty(); ++k) {
      std::size_t first = policy_.times.size();
      for (std::size_t j = policy_.times.size(); j-- > 0;) {
        if (policy_.handles[j] == no_event) continue;
        if (first == policy_.times.size() || policy_.times[j] <= policy_.times[first]) first = j;
      }
      ASSERT_EQ(scheduler_.top().number, first);
      ASSERT_EQ(scheduler_.pop().number, first);
      policy_.handles[first] = no_event;
    }
  }

  // Some entries go, and some that went come back, to be at another time.
  void change(std::size_t number) {
    for (std::size_t k = 0; k < number; ++k) {
      const std::size_t subject = random_() % policy_.times.size();
      Queue_handle& handle = policy_.handles[subject];
      if (handle != no_event) {
        ASSERT_EQ(scheduler_.erase(handle).number, subject);
        handle = no_event;
        continue;
      }
      const double time = policy_.times[subject] = static_cast<double>(random_() % 200);
      const Entry entry(subject, {time - 3, time + 2}, {static_cast<int>(3 * subject)});
      handle = subject % 3 == 0 ? scheduler_.push(entry, time) : scheduler_.emplace(entry);
    }
  }

  std::mt19937_64 random_;
  Policy policy_;
  Divided_scheduler<Entry, Policy> scheduler_;
};

TEST_P(Divided, entries_keep_their_order_and_their_handles) {
  for (const std::size_t parts : {1u, 3u, 3u, 3u, 20u, 20u, 1u, 4u, 1u, 1u}) {
    distribute(parts, 20);
    ASSERT_NO_FATAL_FAILURE(expect_everything_in_its_place(parts)) << "seed " << GetParam();
    ASSERT_NO_FATAL_FAILURE(pop(45)) << "seed " << GetParam();
  }
}

// Exact times that have been made move with their entries.
TEST_P(Divided, entries_keep_their_exact_times) {
  const auto expect_times = [this] {
    const std::size_t before = policy_.times_made;
    for (std::size_t k = 0; k < policy_.times.size(); k += 5) {
      const Entry& entry = scheduler_[policy_.handles[k]];
      ASSERT_EQ(scheduler_.time_of(entry), policy_.times[k]);
    }
    ASSERT_EQ(policy_.times_made, before);
  };
  for (const std::size_t parts : {5u, 5u, 1u}) {
    distribute(parts, 50);
    ASSERT_NO_FATAL_FAILURE(expect_times()) << parts << " parts";
  }
}

// The part of the first entry is known from pop() on; it follows all changes.
TEST_P(Divided, entries_that_come_and_go_leave_the_order_right) {
  for (const std::size_t parts : {2u, 7u, 37u, 1u, 64u}) {
    ASSERT_NO_FATAL_FAILURE(distribute(parts, 100));
    for (int round = 0; round < 30; ++round) {
      ASSERT_NO_FATAL_FAILURE(pop(3)) << parts << " parts, seed " << GetParam();
      ASSERT_NO_FATAL_FAILURE(change(20));
      ASSERT_TRUE(scheduler_.is_valid()) << parts << " parts, seed " << GetParam();
    }
  }
}

// Parts that are changed by themselves, as regions do.
TEST_P(Divided, parts_that_change_by_themselves_are_found_again) {
  distribute(20, 100);
  for (int round = 0; round < 10; ++round) {
    ASSERT_NO_FATAL_FAILURE(pop(5)) << "seed " << GetParam();
    scheduler_.forget_first();
    for (std::size_t p = 0; p < 20; ++p) {
      if (scheduler_.part(p).empty()) continue;
      policy_.handles[scheduler_.part(p).pop().number] = no_event;
    }
    ASSERT_TRUE(scheduler_.is_valid());
  }
}

// Of entries at one time the exact times are made once, not for each pop.
TEST_P(Divided, first_entries_keep_their_exact_times) {
  distribute(32, 100);
  const std::size_t before = policy_.times_made;
  ASSERT_NO_FATAL_FAILURE(pop(policy_.times.size()));
  EXPECT_LE(policy_.times_made - before, policy_.times.size());
}

INSTANTIATE_TEST_SUITE_P(Seeds, Divided, testing::Range<std::uint64_t>(1, 9));

}  // namespace
}  // namespace kinetri::detail::divided_scheduler_test
