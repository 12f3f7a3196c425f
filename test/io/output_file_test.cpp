// SPDX-License-Identifier: GPL-3.0-or-later
//
// Output files are whole or not there, and every failure is reported.
#include "kinetri/impl/io/output_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "support/directory_test.h"
#include "support/message_of.h"

namespace kinetri::output_file_test {
namespace {

namespace fs = std::filesystem;
using test::Entries;
using test::message_of;
using test::read_file;
using test::write_file;

class Output_file_test : public test::Directory_test {
 protected:
  static std::string error_of(const std::string& path) {
    return message_of<Output_error>([&path] { const Output_file output(path); });
  }

  static unsigned permissions(const std::string& path) {
    return static_cast<unsigned>(fs::status(path).permissions());
  }
};

TEST_F(Output_file_test, target_appears_with_commit_only) {
  Output_file output(file("out"));
  EXPECT_EQ(output.path(), file("out"));
  output.stream() << "text";
  output.stream().flush();
  EXPECT_FALSE(fs::exists(file("out")));
  output.finish();
  EXPECT_FALSE(fs::exists(file("out")));
  output.commit();
  EXPECT_EQ(read_file(file("out")), "text");
  EXPECT_EQ(entries(), Entries{"out"});
}

TEST_F(Output_file_test, without_commit_nothing_changes) {
  write_file(file("old"), "before");
  {
    Output_file changed(file("old"));
    Output_file created(file("new"));
    changed.stream() << "after";
    created.stream() << "after";
    created.finish();
    EXPECT_EQ(entries().size(), 3U);
  }
  EXPECT_EQ(read_file(file("old")), "before");
  EXPECT_EQ(entries(), Entries{"old"});
}

TEST_F(Output_file_test, commit_replaces_the_old_file) {
  write_file(file("out"), "a longer text that was there before");
  Output_file output(file("out"));
  output.stream() << "new";
  output.commit();
  EXPECT_EQ(read_file(file("out")), "new");
  EXPECT_EQ(entries(), Entries{"out"});
}

TEST_F(Output_file_test, finish_and_commit_may_be_repeated) {
  Output_file output(file("out"));
  output.stream() << "text";
  output.finish();
  output.finish();
  output.commit();
  output.commit();
  EXPECT_EQ(read_file(file("out")), "text");
}

TEST_F(Output_file_test, nothing_can_be_written_after_finish) {
  Output_file output(file("out"));
  output.finish();
  EXPECT_FALSE(output.stream() << "late");
  output.commit();
  EXPECT_EQ(read_file(file("out")), "");
}

TEST_F(Output_file_test, survives_being_moved) {
  std::vector<Output_file> outputs;
  for (const char* name : {"a", "b", "c"}) {
    outputs.emplace_back(file(name)).stream() << name;
  }
  for (Output_file& output : outputs) output.commit();
  EXPECT_EQ(read_file(file("a")), "a");
  EXPECT_EQ(read_file(file("c")), "c");
  EXPECT_EQ(entries(), (Entries{"a", "b", "c"}));
}

TEST_F(Output_file_test, holds_more_than_its_buffer) {
  std::string text;
  for (int i = 0; i < 100'000; ++i) text += std::to_string(i) + '\n';
  Output_file output(file("out"));
  output.stream() << text << 'x';
  for (const char c : text) output.stream().put(c);
  output.commit();
  EXPECT_EQ(read_file(file("out")), text + 'x' + text);
}

TEST_F(Output_file_test, keeps_the_permissions_of_the_old_file) {
  write_file(file("out"), "before");
  for (const unsigned mode : {0640U, 0600U, 0666U, 0755U}) {
    fs::permissions(file("out"), static_cast<fs::perms>(mode));
    Output_file(file("out")).commit();
    EXPECT_EQ(permissions(file("out")), mode);
  }
}

TEST_F(Output_file_test, new_file_has_the_usual_permissions) {
  const mode_t old = ::umask(027);
  Output_file(file("out")).commit();
  ::umask(old);
  EXPECT_EQ(permissions(file("out")), 0640U);
}

TEST_F(Output_file_test, symbolic_links_are_followed) {
  fs::create_directory(file("elsewhere"));
  write_file(file("elsewhere/target"), "before");
  fs::create_symlink("elsewhere/target", file("link"));
  fs::create_symlink("link", file("chain"));
  fs::create_symlink("elsewhere/missing", file("dangling"));
  Output_file output(file("chain"));
  output.stream() << "after";
  output.commit();
  Output_file missing(file("dangling"));
  missing.stream() << "created";
  missing.commit();
  EXPECT_TRUE(fs::is_symlink(file("chain")));
  EXPECT_TRUE(fs::is_symlink(file("dangling")));
  EXPECT_EQ(read_file(file("elsewhere/target")), "after");
  EXPECT_EQ(read_file(file("elsewhere/missing")), "created");
}

TEST_F(Output_file_test, identity_tells_whether_two_paths_are_one_file) {
  fs::create_symlink("a", file("link"));
  write_file(file("a"), "");
  const auto identity = [](const std::string& path) { return Output_file(path).identity(); };
  EXPECT_EQ(identity(file("a")), identity(file("link")));
  EXPECT_EQ(identity(file("a")),
            identity(directory() + "/./../" + fs::path(directory()).filename().string() + "//a"));
  EXPECT_EQ(identity(file("b")), identity(directory() + "/./b"));
  EXPECT_NE(identity(file("a")), identity(file("b")));
  EXPECT_EQ(identity("-"), "-");
  EXPECT_EQ(identity("/dev/null"), "");
}

TEST_F(Output_file_test, paths_that_cannot_be_written_are_errors_at_once) {
  EXPECT_EQ(error_of(directory()), directory() + ": is a directory; expected the path of a file");
  EXPECT_EQ(error_of(file("missing/out")),
            file("missing/out") +
                ": cannot be written: No such file or directory; expected a path in an existing "
                "directory in which files can be created");
  write_file(file("plain"), "");
  EXPECT_EQ(error_of(file("plain/out")),
            file("plain/out") +
                ": cannot be written: Not a directory; expected a path that can be reached");
  EXPECT_EQ(error_of(""),
            "'': is no path of an output file; expected a path, or - for standard output");
  EXPECT_EQ(entries(), Entries{"plain"});
}

TEST_F(Output_file_test, permissions_are_respected) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everything";
  write_file(file("read-only"), "before");
  fs::permissions(file("read-only"), fs::perms::owner_read);
  EXPECT_NE(error_of(file("read-only")).find("exists and cannot be written: Permission denied"),
            std::string::npos);
  fs::create_directory(file("closed"));
  fs::permissions(file("closed"), fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_NE(error_of(file("closed/out")).find("cannot be written: Permission denied"),
            std::string::npos);
}

TEST_F(Output_file_test, devices_are_written_directly) {
  Output_file output("/dev/null");
  output.stream() << "text";
  output.commit();
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(Output_file_test, full_disk_is_reported) {
  for (const std::size_t size : {std::size_t{1}, std::size_t{1} << 20U}) {
    Output_file output("/dev/full");
    output.stream() << std::string(size, 'x');
    EXPECT_EQ(message_of<Output_error>([&output] { output.commit(); }),
              "/dev/full: writing failed: No space left on device; expected a place that takes all "
              "of it");
  }
}

TEST_F(Output_file_test, stream_shows_a_failure_while_writing) {
  Output_file output("/dev/full");
  for (int i = 0; i < 1000 && output.stream(); ++i) output.stream() << std::string(1000, 'x');
  EXPECT_FALSE(output.stream());
}

TEST_F(Output_file_test, named_pipes_are_written_directly) {
  ASSERT_EQ(::mkfifo(file("pipe").c_str(), 0600), 0);
  std::string received;
  std::thread reader([&] { received = read_file(file("pipe")); });
  {
    Output_file output(file("pipe"));
    output.stream() << "through the pipe";
    output.commit();
  }
  reader.join();
  EXPECT_EQ(received, "through the pipe");
  EXPECT_TRUE(fs::is_fifo(file("pipe")));
}

TEST_F(Output_file_test, all_temporaries_can_be_removed_at_once) {
  write_file(file("old"), "before");
  std::vector<Output_file> outputs;
  for (const char* name : {"old", "new", "other"}) outputs.emplace_back(file(name));
  outputs[2].commit();
  EXPECT_EQ(entries().size(), 4U);
  Output_file::remove_all_temporaries();
  EXPECT_EQ(entries(), (Entries{"old", "other"}));
  EXPECT_EQ(read_file(file("old")), "before");
}

TEST_F(Output_file_test, target_that_became_a_directory_is_reported) {
  Output_file output(file("out"));
  fs::create_directory(file("out"));
  EXPECT_THROW(output.commit(), Output_error);
  EXPECT_EQ(entries(), Entries{"out"});
}

}  // namespace
}  // namespace kinetri::output_file_test
