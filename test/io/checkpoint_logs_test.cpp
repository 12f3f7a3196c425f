// SPDX-License-Identifier: GPL-3.0-or-later
//
// The files that belong to a checkpoint are found again, and known again.
#include "kinetri/impl/io/checkpoint_logs.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "kinetri/base/error.h"
#include "kinetri/impl/io/output_file.h"
#include "kinetri/io/checkpoint_file.h"
#include "support/temporary_directory.h"

namespace kinetri::checkpoint_logs_test {
namespace {

namespace fs = std::filesystem;
using test::write_file;

class Checkpoint_logs : public testing::Test {
 protected:
  std::string file(const std::string& name) const { return directory_.file(name); }

  // The note of a file that is written with this content, for the checkpoint run.kinetri.
  Checkpoint_log written(const std::string& name, const std::string& content = "123456789") const {
    Output_file output(file(name));
    output.keep_checksum();
    output.stream() << content;
    output.commit();
    return log_of("events", output, Output_file(file("run.kinetri")).identity());
  }

  std::string problem(const Checkpoint_log& log) const {
    try {
      return expect_log(log, file("run.kinetri")) ? "none" : "not there";
    } catch (const Input_error& error) {
      return error.what();
    }
  }

 private:
  test::Temporary_directory directory_;
};

TEST_F(Checkpoint_logs, has_the_size_and_the_checksum_of_the_file) {
  EXPECT_EQ(written("events.csv"), (Checkpoint_log{"events", "events.csv", 9, 0xCBF43926}));
  const std::string large(1'000'000, 'x');
  EXPECT_EQ(written("events.csv", large).bytes, large.size());
  EXPECT_EQ(problem(written("events.csv", large)), "none");
}

TEST_F(Checkpoint_logs, none_of_what_is_written_directly) {
  Output_file output("/dev/null");
  output.keep_checksum();
  output.stream() << "text";
  output.commit();
  EXPECT_FALSE(output.checksum());
  Output_file unasked(file("out"));
  unasked.commit();
  EXPECT_FALSE(unasked.checksum());
}

TEST_F(Checkpoint_logs, path_is_relative_below_the_directory_of_the_checkpoint) {
  fs::create_directories(file("sub/sub"));
  EXPECT_EQ(written("sub/sub/e").path, "sub/sub/e");
  fs::create_directory(file("runs"));
  Output_file output(file("e"));
  output.keep_checksum();
  output.commit();
  const std::string checkpoint = Output_file(file("runs/run.kinetri")).identity();
  EXPECT_EQ(log_of("edges", output, checkpoint).path, output.identity());
  // A checkpoint that is standard output, or a device, has no directory.
  EXPECT_EQ(log_of("edges", output, "-").path, output.identity());
  EXPECT_EQ(log_of("edges", output, "").path, output.identity());
}

TEST_F(Checkpoint_logs, is_found_from_anywhere) {
  fs::create_directory(file("a"));
  const Checkpoint_log below = {"events", "e", 0, 0};
  EXPECT_EQ(path_of(below, file("a/run.kinetri")), file("a/e"));
  EXPECT_EQ(path_of(below, "run.kinetri"), "e");
  EXPECT_EQ(path_of(below, "-"), "e");
  EXPECT_EQ(path_of({"events", "/x/e", 0, 0}, file("a/run.kinetri")), "/x/e");
  write_file(file("a/run.kinetri"), "");
  fs::create_symlink("a/run.kinetri", file("link"));
  EXPECT_EQ(path_of(below, file("link")), fs::canonical(file("a")) / "e");
}

TEST_F(Checkpoint_logs, file_that_is_gone_is_not_there) {
  const Checkpoint_log log = written("e");
  EXPECT_EQ(problem(log), "none");
  fs::remove(file("e"));
  EXPECT_EQ(problem(log), "not there");
  fs::create_directory(file("e"));
  EXPECT_EQ(problem(log), "not there");
}

TEST_F(Checkpoint_logs, file_that_was_changed_is_refused) {
  const Checkpoint_log log = written("e");
  const std::string end =
      "; expected 9 bytes and the checksum cbf43926: take the checkpoint that was written with it, "
      "or "
      "move it away to continue without it";
  const std::string beginning =
      file("e") + ": is not what --events wrote for " + file("run.kinetri") + ": it has ";
  write_file(file("e"), "123456780");
  EXPECT_EQ(problem(log), beginning + "9 bytes and the checksum b2288182" + end);
  write_file(file("e"), "");
  EXPECT_EQ(problem(log), beginning + "0 bytes and the checksum 00000000" + end);
  write_file(file("e"), "123456789\n");
  EXPECT_NE(problem(log), "none");
  // One and the same checksum is not enough.
  Checkpoint_log longer = log;
  longer.bytes = 10;
  write_file(file("e"), "123456789");
  EXPECT_NE(problem(longer), "none");
}

}  // namespace
}  // namespace kinetri::checkpoint_logs_test
