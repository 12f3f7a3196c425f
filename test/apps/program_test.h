// SPDX-License-Identifier: GPL-3.0-or-later
//
// The fixture of the program's tests: an empty working directory, and a short way to run kinetri in
// it. Each run of a simulation that goes well is verified by kinetri-verify, where that is built,
// unless it is of a kind that this does not verify.
#ifndef KINETRI_TEST_APPS_PROGRAM_TEST_H
#define KINETRI_TEST_APPS_PROGRAM_TEST_H

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "apps/process.h"
#include "support/directory_test.h"

namespace kinetri::test {

using Arguments = std::vector<std::string>;

/// Four points whose triangulation changes once from t = 0 on: at t = 1 they are the corners of a
/// square, and the edge 0-3 becomes 1-2.
constexpr const char* one_flip =
    "x,y,vx,vy\n"
    "0,0,0,0\n"
    "4,0,0,0\n"
    "0,4,0,0\n"
    "3,3,1,1\n";

/// Nine balls in a square of side 9 that fall.
constexpr const char* falling_balls =
    "x,y,vx,vy,ax,ay,jx,jy\n"
    "1,1,2,0,0,-2,0,0\n4,1,-1,1,0,-2,0,0\n7.5,1.25,0,1,0,-2,0.1,0\n"
    "1,4,0,0,0,-2,0,0\n4,4.5,1,1,0,-2,0,0\n7,4,-2,0,0,-2,0,0.2\n"
    "1.5,7,1,0,0,-2,0,0\n4,7,0,-1,0,-2,0,0\n7,7,0.5,0,0,0,0,0\n";

class Program_test : public Directory_test {
 protected:
  void write(const std::string& name, const std::string& text) const {
    write_file(file(name), text);
  }
  std::string read(const std::string& name) const { return read_file(file(name)); }
  bool exists(const std::string& name) const { return std::filesystem::exists(file(name)); }

  Outcome run(const Arguments& arguments, Process_input input = {}) const {
    input.directory = directory();
    const bool is_verified = is_simulation(arguments) && input.standard_output.empty();
    if (!is_verified) return Process(KINETRI_PROGRAM, arguments, input).wait();
    Arguments with_answer = arguments;
    with_answer.emplace_back("--verify");
    Outcome outcome = Process(KINETRI_PROGRAM, with_answer, input).wait();
    if (outcome.exit_code == 2) {
      const Outcome alone = Process(KINETRI_PROGRAM, arguments, input).wait();
      EXPECT_TRUE(alone.exit_code == 2 || is_unsupported(outcome.err)) << outcome.err;
      return alone;
    }
    if (outcome.exit_code == 0 || outcome.exit_code == 1) take_answer(outcome);
    return outcome;
  }

 private:
  static bool is_simulation([[maybe_unused]] const Arguments& arguments) {
#ifdef KINETRI_HAS_VERIFIER
    const auto is_there = [&](const char* word) {
      return std::ranges::find(arguments, word) != arguments.end();
    };
    return !arguments.empty() && !is_there("--help") &&
           (arguments.front() != "experiment" || is_there("--single")) &&
           std::ranges::find(simulations, arguments.front()) != simulations.end();
#else
    return false;
#endif
  }

  // Whether kinetri-verify says that it does not verify such runs.
  static bool is_unsupported(const std::string& message) {
    return message.find("all discs are on one line") != std::string::npos;
  }

  // Removes what kinetri-verify says: `verified: 4 points, 1 events, 13 certificates`.
  static void take_answer(Outcome& outcome) {
    for (std::string* const text : {&outcome.out, &outcome.err}) {
      const std::size_t begin = text->rfind("verified: ");
      if (begin == std::string::npos || (begin > 0 && (*text)[begin - 1] != '\n')) continue;
      text->erase(begin, text->find('\n', begin) + 1 - begin);
      return;
    }
    ADD_FAILURE() << "the run is not verified: " << outcome.out << outcome.err;
  }

  static constexpr std::array<std::string_view, 5> simulations = {"simulate", "tracks", "resume",
                                                                  "experiment", "wave"};
};

}  // namespace kinetri::test

#endif  // KINETRI_TEST_APPS_PROGRAM_TEST_H
