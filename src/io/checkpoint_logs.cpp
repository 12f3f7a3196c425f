// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/impl/io/checkpoint_logs.h"

#include <array>
#include <fstream>
#include <system_error>

#include "kinetri/base/error.h"
#include "kinetri/impl/io/checksum.h"
#include "kinetri/impl/io/input_text.h"
#include "kinetri/impl/io/output_file.h"
#include "kinetri/impl/io/text.h"
#include "kinetri/io/checkpoint_file.h"

namespace kinetri {
namespace {

namespace fs = std::filesystem;

Checksum checksum_of(const std::string& path) {
  std::ifstream in = open_input(path, "what a run has written");
  Checksum result;
  std::array<char, 1U << 16U> buffer;
  while (in.read(buffer.data(), buffer.size()), in.gcount() > 0) {
    result.add({buffer.data(), static_cast<std::size_t>(in.gcount())});
  }
  if (in.bad()) throw Input_error(path, 0, "cannot be read to its end; expected a readable file");
  return result;
}

std::string in_words(std::uint64_t bytes, std::uint32_t crc32) {
  return joined(bytes, " bytes and the checksum ", hexadecimal(crc32, 8));
}

}  // namespace

Checkpoint_log log_of(const std::string& output, const Output_file& file,
                      const std::string& checkpoint) {
  const fs::path path = file.identity();
  const fs::path relative = path.lexically_relative(fs::path(checkpoint).parent_path());
  const bool is_below = !relative.empty() && *relative.begin() != "..";
  return {output, is_below ? relative.string() : path.string(), file.checksum()->bytes(),
          file.checksum()->crc32()};
}

fs::path path_of(const Checkpoint_log& log, const std::string& checkpoint) {
  if (checkpoint == "-") return log.path;
  std::error_code ignored;
  const bool is_link = fs::is_symlink(checkpoint, ignored);
  const fs::path file = is_link ? fs::canonical(checkpoint, ignored) : fs::path(checkpoint);
  return file.parent_path() / log.path;
}

bool expect_log(const Checkpoint_log& log, const std::string& checkpoint) {
  const std::string path = path_of(log, checkpoint).string();
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored)) return false;
  const Checksum found = checksum_of(path);
  if (found.bytes() == log.bytes && found.crc32() == log.crc32) return true;
  throw Input_error(
      path, 0,
      joined("is not what --", log.output, " wrote for ",
             checkpoint == "-" ? "the checkpoint" : checkpoint, ": it has ",
             in_words(found.bytes(), found.crc32()), "; expected ", in_words(log.bytes, log.crc32),
             ": take the checkpoint that was written with it, or move it away to continue without "
             "it"));
}

}  // namespace kinetri
