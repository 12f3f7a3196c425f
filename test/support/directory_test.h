// SPDX-License-Identifier: GPL-3.0-or-later
//
// A fixture with an empty directory.
#ifndef KINETRI_TEST_SUPPORT_DIRECTORY_TEST_H
#define KINETRI_TEST_SUPPORT_DIRECTORY_TEST_H

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/temporary_directory.h"

namespace kinetri::test {

using Entries = std::vector<std::string>;

class Directory_test : public testing::Test {
 protected:
  std::string directory() const { return directory_.path(); }
  /// The path of the file `name` in it.
  std::string file(const std::string& name) const { return directory_.file(name); }
  /// The names of all entries, sorted.
  Entries entries() const { return directory_.entries(); }
  /// The names of all entries of its directory `name`, sorted.
  Entries entries(const std::string& name) const { return entries_of(file(name)); }

 private:
  Temporary_directory directory_;
};

}  // namespace kinetri::test

#endif  // KINETRI_TEST_SUPPORT_DIRECTORY_TEST_H
