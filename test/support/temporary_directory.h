// SPDX-License-Identifier: GPL-3.0-or-later
//
// A directory for the files of one test; reads and writes files.
#ifndef KINETRI_TEST_SUPPORT_TEMPORARY_DIRECTORY_H
#define KINETRI_TEST_SUPPORT_TEMPORARY_DIRECTORY_H

#include <stdlib.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace kinetri::test {

inline std::string read_file(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw std::runtime_error("cannot read " + path.string());
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

inline void write_file(const std::filesystem::path& path, const std::string& text) {
  std::ofstream out(path, std::ios::binary);
  out << text;
  if (!out.flush()) throw std::runtime_error("cannot write " + path.string());
}

/// The names of all entries of the directory, hidden ones included, sorted.
inline std::vector<std::string> entries_of(const std::filesystem::path& directory) {
  std::vector<std::string> result;
  for (const auto& entry : std::filesystem::directory_iterator(directory)) {
    result.push_back(entry.path().filename().string());
  }
  std::sort(result.begin(), result.end());
  return result;
}

/// An empty directory that is removed with its contents at the end of the test.
class Temporary_directory {
 public:
  Temporary_directory() {
    std::string name = (std::filesystem::temp_directory_path() / "kinetri-test-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary directory");
    path_ = name;
  }
  ~Temporary_directory() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Temporary_directory(const Temporary_directory&) = delete;
  Temporary_directory& operator=(const Temporary_directory&) = delete;

  const std::filesystem::path& path() const { return path_; }

  /// The path of the file `name` in the directory.
  std::string file(const std::string& name) const { return (path_ / name).string(); }

  /// The names of all entries, hidden ones included, sorted.
  std::vector<std::string> entries() const { return entries_of(path_); }

 private:
  std::filesystem::path path_;
};

}  // namespace kinetri::test

#endif  // KINETRI_TEST_SUPPORT_TEMPORARY_DIRECTORY_H
