// SPDX-License-Identifier: GPL-3.0-or-later
//
// Output directories are whole or not there, and every failure is reported.
#include "kinetri/impl/io/output_directory.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include "support/directory_test.h"
#include "support/message_of.h"
#include "support/precondition_error.h"

namespace kinetri::output_directory_test {
namespace {

namespace fs = std::filesystem;
using test::Entries;
using test::message_of;
using test::read_file;
using test::write_file;

class Output_directory_test : public test::Directory_test {
 protected:
  static std::string error_of(const std::string& path) {
    return message_of<Output_error>([&path] { const Output_directory output(path); });
  }
};

constexpr const char* usable = "a directory that is not there yet, or is empty";

TEST_F(Output_directory_test, appears_with_commit_only) {
  Output_directory output(file("out"));
  EXPECT_EQ(output.path(), file("out"));
  EXPECT_EQ(entries(), Entries{});
  output.write("one", "first");
  output.write("two", std::string(1'000'000, 'x'));
  EXPECT_FALSE(fs::exists(file("out")));
  EXPECT_EQ(entries().size(), 1U);
  output.commit();
  output.commit();
  EXPECT_EQ(entries(), Entries{"out"});
  EXPECT_EQ(entries("out"), (Entries{"one", "two"}));
  EXPECT_EQ(read_file(file("out/one")), "first");
  EXPECT_EQ(read_file(file("out/two")), std::string(1'000'000, 'x'));
}

TEST_F(Output_directory_test, without_commit_nothing_is_left) {
  fs::create_directory(file("old"));
  {
    Output_directory created(file("new"));
    Output_directory replaced(file("old"));
    for (int i = 0; i < 100; ++i) created.write(std::to_string(i), "text");
    replaced.write("a", "");
    EXPECT_EQ(entries().size(), 3U);
  }
  EXPECT_EQ(entries(), Entries{"old"});
  EXPECT_EQ(entries("old"), Entries{});
}

TEST_F(Output_directory_test, without_files_is_empty) {
  Output_directory output(file("out"));
  output.commit();
  EXPECT_EQ(entries(), Entries{"out"});
  EXPECT_EQ(entries("out"), Entries{});
  EXPECT_PRECONDITION_ERROR(output.write("late", ""),
                            "a file for a directory that is complete; write it before commit");
}

TEST_F(Output_directory_test, takes_the_place_of_an_empty_one) {
  fs::create_directory(file("out"));
  fs::permissions(file("out"), fs::perms::owner_all);
  fs::create_directory_symlink("out", file("link"));
  Output_directory output(file("link") + "/");
  output.write("a", "text");
  output.commit();
  EXPECT_TRUE(fs::is_symlink(file("link")));
  EXPECT_EQ(read_file(file("out/a")), "text");
  EXPECT_EQ(fs::status(file("out")).permissions(), fs::perms::owner_all);
}

TEST_F(Output_directory_test, has_the_usual_permissions) {
  const mode_t old = ::umask(027);
  Output_directory output(file("out"));
  output.write("a", "");
  output.commit();
  ::umask(old);
  EXPECT_EQ(static_cast<unsigned>(fs::status(file("out")).permissions()), 0750U);
  EXPECT_EQ(static_cast<unsigned>(fs::status(file("out/a")).permissions()), 0640U);
}

TEST_F(Output_directory_test, identity_tells_whether_two_paths_are_one_directory) {
  fs::create_directory(file("a"));
  fs::create_directory_symlink("a", file("link"));
  const auto identity = [](const std::string& path) { return Output_directory(path).identity(); };
  EXPECT_EQ(identity(file("a")), fs::canonical(file("a")).string());
  EXPECT_EQ(identity(file("a") + "/"), identity(file("link")));
  EXPECT_EQ(identity(file("link/b")), identity(file("a/./b/")));
  EXPECT_NE(identity(file("a")), identity(file("b")));
}

TEST_F(Output_directory_test, unusable_paths_are_errors_at_once) {
  fs::create_directory(file("full"));
  write_file(file("full/a"), "kept");
  EXPECT_EQ(error_of(file("full")), file("full") + ": is not empty; expected " + usable +
                                        "; remove what is in it, or name another");
  EXPECT_EQ(error_of(file("full/a")), file("full/a") + ": is no directory; expected " + usable);
  EXPECT_EQ(error_of(file("missing/out")),
            file("missing/out") +
                ": cannot be made: No such file or directory; expected a path in an existing "
                "directory in which directories can be made");
  EXPECT_NE(error_of(file("full/a/out")).find("/full/a/out: cannot be made: Not a directory"),
            std::string::npos);
  EXPECT_EQ(error_of(""), std::string("'': is no path of a directory; expected ") + usable);
  EXPECT_EQ(error_of("-"), std::string("'-': is no path of a directory; expected ") + usable);
  fs::create_symlink("nowhere", file("link"));
  EXPECT_EQ(error_of(file("link")),
            file("link") + ": is a symbolic link that leads nowhere; expected " + usable);
  EXPECT_NE(error_of("/proc").find("/proc: is not empty"), std::string::npos);
  // Where nobody can make a directory, not even root.
  EXPECT_NE(error_of("/proc/out").find("/proc/out: cannot be made: "), std::string::npos);
  EXPECT_EQ(entries(), (Entries{"full", "link"}));
  EXPECT_EQ(read_file(file("full/a")), "kept");
}

TEST_F(Output_directory_test, current_directory_is_refused) {
  fs::create_directory(file("here"));
  const fs::path before = fs::current_path();
  fs::current_path(file("here"));
  const std::string error = error_of(".");
  fs::current_path(before);
  EXPECT_EQ(error, ".: is the current directory; expected another one");
}

TEST_F(Output_directory_test, permissions_are_respected) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everything";
  fs::create_directory(file("closed"));
  fs::permissions(file("closed"), fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_NE(error_of(file("closed/out")).find("cannot be made: Permission denied"),
            std::string::npos);
}

TEST_F(Output_directory_test, failure_to_write_names_the_file) {
  Output_directory output(file("out"));
  const std::string name(300, 'x');  // longer than a name may be
  EXPECT_EQ(message_of<Output_error>([&] { output.write(name, "text"); }),
            file("out") + "/" + name +
                ": writing failed: File name too long; expected a place that takes all of it");
  EXPECT_PRECONDITION_ERROR(
      output.write("a/b", ""),
      "the name of a file in an output directory is empty or has a slash; expected a plain name");
  EXPECT_PRECONDITION_ERROR(
      output.write("", ""),
      "the name of a file in an output directory is empty or has a slash; expected a plain name");
}

// As on a full disk, the part that there is room for is written.
TEST_F(Output_directory_test, part_of_a_file_is_a_failure) {
  rlimit before = {};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto signal = std::signal(SIGXFSZ, SIG_IGN);
  rlimit small = before;
  small.rlim_cur = 1000;
  std::string error;
  {
    Output_directory output(file("out"));
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
    error = message_of<Output_error>([&] { output.write("a", std::string(5000, 'x')); });
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  }
  std::signal(SIGXFSZ, signal);
  EXPECT_EQ(error, file("out") +
                       "/a: writing failed: File too large; expected a place that takes all of it");
  EXPECT_EQ(entries(), Entries{});
}

TEST_F(Output_directory_test, target_that_was_filled_meanwhile_is_reported) {
  fs::create_directory(file("out"));
  Output_directory output(file("out"));
  output.write("a", "text");
  write_file(file("out/other"), "kept");
  EXPECT_THROW(output.commit(), Output_error);
  EXPECT_EQ(entries(), Entries{"out"});
  EXPECT_EQ(entries("out"), Entries{"other"});
}

TEST_F(Output_directory_test, survives_being_moved) {
  std::vector<Output_directory> outputs;
  for (const char* name : {"a", "b", "c"}) {
    outputs.emplace_back(file(name)).write(name, name);
  }
  for (Output_directory& output : outputs) output.commit();
  EXPECT_EQ(entries(), (Entries{"a", "b", "c"}));
  EXPECT_EQ(read_file(file("c/c")), "c");
}

TEST_F(Output_directory_test, all_temporaries_can_be_removed_at_once) {
  std::vector<Output_directory> outputs;
  for (const char* name : {"a", "b", "c"}) {
    outputs.emplace_back(file(name)).write("one", "text");
    outputs.back().write("two", "text");
  }
  outputs[2].commit();
  EXPECT_EQ(entries().size(), 3U);
  Output_directory::remove_all_temporaries();
  EXPECT_EQ(entries(), Entries{"c"});
  EXPECT_EQ(entries("c"), (Entries{"one", "two"}));
}

}  // namespace
}  // namespace kinetri::output_directory_test
