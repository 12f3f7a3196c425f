// SPDX-License-Identifier: GPL-3.0-or-later
//
// Runs of simulations that are broken off and go on from checkpoints, and the texts of these.
#ifndef KINETRI_TEST_SUPPORT_BROKEN_RUNS_H
#define KINETRI_TEST_SUPPORT_BROKEN_RUNS_H

#include <gtest/gtest.h>

#include <array>
#include <boost/crc.hpp>
#include <cmath>
#include <cstdio>
#include <memory>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "kinetri/base/error.h"
#include "kinetri/io/checkpoint_file.h"
#include "kinetri/io/event_log.h"
#include "kinetri/simulation/simulation_2.h"
#include "support/message_of.h"
#include "support/temporary_directory.h"

namespace kinetri::test {

// ---- texts ----

inline std::string text_of(const Checkpoint& checkpoint) {
  std::ostringstream out;
  write_checkpoint(out, checkpoint);
  return out.str();
}

inline Checkpoint checkpoint_of(const std::string& text) {
  std::istringstream in(text);
  return read_checkpoint(in, "run.kinetri");
}

/// With the checksum that the text, which was changed, should have.
inline std::string signed_anew(const std::string& text) {
  const std::string content = text.substr(0, text.rfind("checksum "));
  boost::crc_32_type crc;
  crc.process_bytes(content.data(), content.size());
  char line[20];
  std::snprintf(line, sizeof line, "checksum %08x\n", static_cast<unsigned>(crc.checksum()));
  return content + line;
}

/// The text with a change and the checksum that it should have then.
inline std::string forged(std::string text, const std::string& old,
                          const std::string& replacement) {
  const std::size_t place = text.find(old);
  EXPECT_NE(place, std::string::npos) << old;
  if (place == std::string::npos) return text;
  return signed_anew(text.replace(place, old.size(), replacement));
}

/// Some bytes of the state changed or left out, with the right checksum.
inline std::string forged_at_random(std::string text, std::mt19937_64& random) {
  const std::size_t first = text.find('\n') + 1;
  for (auto changes = 1 + random() % 2; changes > 0; --changes) {
    const std::size_t end = text.rfind("checksum ");
    const std::size_t place = first + random() % (end - first);
    constexpr std::string_view bytes = "0123456789-.,[]{}\"e/nt";
    if (random() % 3 == 0) {
      text.erase(place, std::min<std::size_t>(1 + random() % 4, end - place));
    } else {
      text[place] = bytes[random() % bytes.size()];
    }
  }
  return signed_anew(text);
}

/// The message with which the text is refused; empty if it is not.
inline std::string refusal(const std::string& text) {
  return message_of<Input_error>([&text] { checkpoint_of(text); });
}

inline void expect_refusal(const std::string& text, const std::string& expected) {
  EXPECT_EQ(refusal(text).rfind("run.kinetri: " + expected, 0), 0u) << refusal(text);
  EXPECT_NE(refusal(text).find("expected"), std::string::npos);
}

// ---- a run with breaks ----

/// A simulation at its start.
template <class Traits>
struct Start {
  std::vector<typename Traits::Motion> motions;
  Simulation_options options = {};
  Traits traits;
};

/// The checkpoint of a simulation.
template <class Traits>
Checkpoint checkpoint_of(const Simulation_2<Traits>& simulation, const std::string& response) {
  Checkpoint result{simulation.snapshot(), response};
  if constexpr (PeriodicKineticTraits_2<Traits>) {
    result.periodic_box = simulation.triangulation().traits().box();
  }
  return result;
}

/// The traits of the simulation of a checkpoint.
template <class Traits>
Traits traits_of(const Checkpoint& checkpoint) {
  if constexpr (PeriodicKineticTraits_2<Traits>) {
    return Traits(checkpoint.periodic_box.value());
  } else {
    return Traits();
  }
}

/// The simulation of a checkpoint.
template <class Traits>
Simulation_2<Traits> restored(const Checkpoint& checkpoint, const Collision_response& response) {
  const auto& snapshot = std::get<Simulation_snapshot<Traits>>(checkpoint.simulation);
  return Simulation_2<Traits>::restore(snapshot, snapshot.has_response ? response : nullptr,
                                       traits_of<Traits>(checkpoint));
}

/// What has been seen of a run: everything that happened, and how it ended.
struct Seen {
  std::string log;
  std::string edges;
  std::string audit;
  int irrational_breaks = 0;
};

/// A run of steps, jumps and changes, all by `seed`. At each break the simulation is written to a
/// file, and goes on as the one that is read from it.
template <class Traits>
class Random_run {
 public:
  Random_run(const Start<Traits>& start, unsigned seed, bool has_breaks)
      : has_breaks_(has_breaks),
        random_(seed),
        response_(start.options.response),
        simulation_(std::make_unique<Simulation_2<Traits>>(start.motions, start.options,
                                                           Algebraic_number(), start.traits)) {
    watch();
    std::mt19937_64 breaks(seed + 1000);
    for (int i = 0; i < 60; ++i) {
      if (breaks() % 12 == 0 || (i == 0 && seed % 5 == 0)) take_up();
      if (!operate()) break;
    }
    take_log();
    note_edges();
    const Audit_report report = simulation_->audit(Audit_level::certificates);
    if (!report.passed()) seen_.audit = report.failures.front();
  }

  const Seen& seen() const { return seen_; }

 private:
  static constexpr bool is_periodic = PeriodicKineticTraits_2<Traits>;
  using Motion = typename Traits::Motion;

  void watch() {
    log_ = std::make_unique<std::ostringstream>();
    writer_ = std::make_unique<Event_log_writer>(
        *log_, is_periodic ? Event_columns::periodic : Event_columns::planar);
    simulation_->add_observer(*writer_);
  }

  // Without the header line.
  void take_log() {
    const std::string text = log_->str();
    seen_.log += text.substr(text.find('\n') + 1);
  }

  void note_edges() {
    std::ostringstream out;
    const auto& triangulation = simulation_->triangulation();
    if constexpr (is_periodic) {
      for (const auto& [ids, offset] : triangulation.periodic_edges()) {
        out << ids[0] << '-' << ids[1] << ' ' << offset.x << ' ' << offset.y << '\n';
      }
    } else {
      for (const auto& [a, b] : triangulation.finite_edge_ids()) out << a << '-' << b << '\n';
    }
    seen_.edges = out.str();
  }

  void take_up() {
    if (!has_breaks_) return;
    if (!simulation_->current_time().is_known_rational()) ++seen_.irrational_breaks;
    take_log();
    write_checkpoint_file(directory_.file("run"), checkpoint_of(*simulation_, "some"));
    simulation_.reset();
    const Checkpoint checkpoint = read_checkpoint_file(directory_.file("run"));
    EXPECT_EQ(checkpoint.response, "some");
    simulation_.reset(new Simulation_2<Traits>(restored<Traits>(checkpoint, response_)));
    watch();
  }

  // False if the run cannot go on.
  bool operate() {
    const Algebraic_number now = simulation_->current_time();
    const double soon = now.tight_interval().upper + std::ldexp(1 + double(random_() % 8), -6);
    const std::uint64_t choice = random_() % 14;
    const Motion motion = some_motion(now.to_double());
    const Point_id id = static_cast<Point_id>(random_() % simulation_->triangulation().next_id());
    const bool is_there = simulation_->triangulation().contains(id);
    try {
      if (choice < 6) {
        simulation_->step();
      } else if (choice < 8) {
        simulation_->advance_to(Algebraic_number(soon));
      } else if (choice == 8) {
        simulation_->advance_to(beyond(soon));
      } else if (choice == 9) {
        simulation_->insert(motion);
      } else if (choice == 10) {
        if (is_there) simulation_->set_motion(id, motion);
      } else if (choice == 11) {
        if (is_there) simulation_->erase(id);
      } else if (choice == 12) {
        simulation_->schedule_motion(random_() % 2 == 0 ? now : beyond(soon), id, motion);
      } else {
        simulation_->schedule_insert(Algebraic_number(soon), motion);
        simulation_->schedule_erase(beyond(soon), id);
      }
    } catch (const Error& error) {
      *log_ << error.what() << '\n';
      // Within an instant, where a contact or a scheduled change was refused, nothing goes on.
      return choice == 9 || choice == 10;
    }
    return true;
  }

  // The root of t^2 - 2 beyond `time`: irrational, and no event.
  static Algebraic_number beyond(double time) {
    const Rational c = to_rational(time);
    const std::array<Rational, 3> coefficients = {c * c - Rational(2, 1000000), Rational(-2 * c),
                                                  Rational(1)};
    return {primitive_polynomial(coefficients), c, Rational(c + 1)};
  }

  Motion some_motion(double time) {
    const auto number = [&] { return static_cast<double>(random_() % 6); };
    const double x = number();
    const double y = number();
    const double vx = number() - 3;
    const Linear_motion_2 center = {{x, y}, {vx, number() - 3}, time};
    if constexpr (HasWeight<Motion>) {
      return {center, number() / 8, 0, 0};
    } else {
      return center;
    }
  }

  bool has_breaks_;
  std::mt19937_64 random_;
  Temporary_directory directory_;
  Collision_response response_;
  std::unique_ptr<std::ostringstream> log_;
  std::unique_ptr<Event_log_writer> writer_;
  std::unique_ptr<Simulation_2<Traits>> simulation_;
  Seen seen_;
};

// A row without its instant: at the time of a break that begins again, since a writer knows of the
// events that it has written (event_log.h). The instant is the field after the tenth comma.
inline std::string without_instant(const std::string& row) {
  std::size_t begin = 0;
  for (int commas = 0; commas < 11 && begin != std::string::npos; ++commas) {
    begin = row.find(',', begin == 0 ? 0 : begin + 1);
  }
  if (begin == std::string::npos) return row;  // the message of an error
  const std::size_t end = row.find(',', begin + 1);
  return row.substr(0, begin) + (end == std::string::npos ? "" : row.substr(end));
}

/// The first lines that differ, but for the instant; empty if there are none.
inline std::string difference(const std::string& one, const std::string& other) {
  std::istringstream lines(one);
  std::istringstream other_lines(other);
  std::string line;
  std::string other_line;
  for (;;) {
    const bool is_there = static_cast<bool>(std::getline(lines, line));
    const bool is_other_there = static_cast<bool>(std::getline(other_lines, other_line));
    if (!is_there && !is_other_there) return {};
    if (!is_there) return "only the other: " + other_line;
    if (!is_other_there) return "only the one: " + line;
    if (without_instant(line) != without_instant(other_line)) {
      return line + "; the other: " + other_line;
    }
  }
}

/// Sums over runs.
struct Broken_runs {
  int irrational_breaks = 0;
  std::size_t bytes = 0;  // of the logs
};

/// Compares a run that is broken off with the one that is not.
template <class Traits>
void expect_the_run_without_breaks(const Start<Traits>& start, unsigned seed, Broken_runs& sums) {
  const Random_run<Traits> whole(start, seed, false);
  const Random_run<Traits> broken(start, seed, true);
  ASSERT_EQ(difference(broken.seen().log, whole.seen().log), "");
  ASSERT_EQ(broken.seen().edges, whole.seen().edges);
  ASSERT_EQ(broken.seen().audit, whole.seen().audit);
  sums.irrational_breaks += broken.seen().irrational_breaks;
  sums.bytes += whole.seen().log.size();
}

}  // namespace kinetri::test

#endif  // KINETRI_TEST_SUPPORT_BROKEN_RUNS_H
