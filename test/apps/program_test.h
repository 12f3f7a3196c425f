// SPDX-License-Identifier: GPL-3.0-or-later
//
// The fixture of the program's tests: an empty working directory, and a short way to run kinetri in
// it.
#ifndef KINETRI_TEST_APPS_PROGRAM_TEST_H
#define KINETRI_TEST_APPS_PROGRAM_TEST_H

#include <filesystem>
#include <string>
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
    return Process(KINETRI_PROGRAM, arguments, input).wait();
  }
};

}  // namespace kinetri::test

#endif  // KINETRI_TEST_APPS_PROGRAM_TEST_H
