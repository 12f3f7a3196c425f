// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a killed process leaves is removed by the next one that writes the same target, and what a
// living one has is not.
#include "io/temporary.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <functional>
#include <iterator>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "kinetri/impl/io/output_directory.h"
#include "kinetri/impl/io/output_file.h"
#include "support/motions.h"
#include "support/temporary_directory.h"

namespace kinetri::temporary_test {
namespace {

namespace fs = std::filesystem;
using test::read_file;
using test::write_file;
using Entries = std::vector<std::string>;

// A process that does something, says so, and then waits until it is to go on or is killed.
class Other_process {
 public:
  // `rest` is what it does when it is to go on.
  explicit Other_process(
      const std::function<void()>& beginning, const std::function<void()>& rest = [] {}) {
    if (::pipe(ready_) != 0 || ::pipe(go_on_) != 0) throw std::runtime_error("no pipe");
    id_ = ::fork();
    if (id_ < 0) throw std::runtime_error("cannot fork");
    if (id_ == 0) run(beginning, rest);
    ::close(ready_[1]);
    ::close(go_on_[0]);
    char byte = 0;
    if (::read(ready_[0], &byte, 1) != 1) throw std::runtime_error("the process failed");
  }
  ~Other_process() {
    kill();
    ::close(ready_[0]);
    ::close(go_on_[1]);
  }
  Other_process(const Other_process&) = delete;
  Other_process& operator=(const Other_process&) = delete;

  void kill() {
    if (id_ > 0) ::kill(id_, SIGKILL);
    wait();
  }

  // Whether the rest went well.
  bool go_on() { return ::write(go_on_[1], "x", 1) == 1 && wait(); }

 private:
  [[noreturn]] void run(const std::function<void()>& beginning, const std::function<void()>& rest) {
    constexpr unsigned seconds = 60;
    ::alarm(seconds);
    try {
      beginning();
      char byte = 'x';
      if (::write(ready_[1], &byte, 1) != 1 || ::read(go_on_[0], &byte, 1) != 1) ::_exit(1);
      rest();
    } catch (const std::exception&) {
      ::_exit(1);
    }
    ::_exit(0);
  }

  bool wait() {
    int status = 1;
    if (id_ > 0) ::waitpid(id_, &status, 0);
    id_ = 0;
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
  }

  int ready_[2] = {};
  int go_on_[2] = {};
  pid_t id_ = 0;
};

class Temporary_test : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists("/proc/sys/kernel/random/boot_id")) GTEST_SKIP() << "nothing is removed here";
  }

  std::string file(const std::string& name) const { return directory_.file(name); }
  Entries entries() const { return directory_.entries(); }

  // The one entry that is a temporary.
  std::string temporary() const {
    for (const std::string& name : entries()) {
      if (name.starts_with(".kinetri-")) return name;
    }
    throw std::runtime_error("there is no temporary");
  }

  // Leaves a temporary of the target, as a process that is killed.
  void leave_file(const std::string& target) const {
    std::unique_ptr<Output_file> output;
    Other_process([&] {
      output = std::make_unique<Output_file>(file(target));
      output->stream() << "lost" << std::flush;
    }).kill();
  }
  void leave_directory(const std::string& target) const {
    std::unique_ptr<Output_directory> output;
    Other_process([&] {
      output = std::make_unique<Output_directory>(file(target));
      output->write("a", "lost");
      output->write("b", "lost");
    }).kill();
  }

  void write_target(const std::string& name) const {
    Output_file output(file(name));
    output.stream() << "text";
    output.commit();
  }
  void write_directory(const std::string& name) const {
    Output_directory output(file(name));
    output.write("c", "text");
    output.commit();
  }

 private:
  test::Temporary_directory directory_;
};

TEST_F(Temporary_test, of_a_killed_process_is_removed) {
  leave_file("out");
  leave_file("out");
  EXPECT_EQ(entries().size(), 1U);  // the second process has removed that of the first
  EXPECT_EQ(read_file(file(temporary())), "lost");
  write_target("out");
  EXPECT_EQ(entries(), Entries{"out"});
  EXPECT_EQ(read_file(file("out")), "text");
}

TEST_F(Temporary_test, directory_of_a_killed_process_is_removed) {
  leave_directory("out");
  leave_directory("out");
  EXPECT_EQ(entries().size(), 1U);
  write_directory("out");
  EXPECT_EQ(entries(), Entries{"out"});
  EXPECT_EQ(read_file(file("out/c")), "text");
}

TEST_F(Temporary_test, several_are_removed_at_once) {
  {
    std::unique_ptr<Output_file> one;
    std::unique_ptr<Output_file> other;
    Other_process first([&] { one = std::make_unique<Output_file>(file("out")); });
    Other_process second([&] { other = std::make_unique<Output_file>(file("out")); });
    EXPECT_EQ(entries().size(), 2U);
  }
  EXPECT_EQ(entries().size(), 2U);
  write_target("out");
  EXPECT_EQ(entries(), Entries{"out"});
}

TEST_F(Temporary_test, of_a_living_process_stays_until_its_commit) {
  std::unique_ptr<Output_file> output;
  Other_process process(
      [&] {
        output = std::make_unique<Output_file>(file("out"));
        output->stream() << "of the other";
      },
      [&] { output->commit(); });
  write_target("out");
  write_target("out");
  EXPECT_EQ(entries().size(), 2U);
  EXPECT_TRUE(process.go_on());
  EXPECT_EQ(entries(), Entries{"out"});
  EXPECT_EQ(read_file(file("out")), "of the other");
}

// A file that is complete waits for those that belong to it.
TEST_F(Temporary_test, of_a_living_process_stays_when_it_is_complete) {
  std::unique_ptr<Output_file> output;
  Other_process process(
      [&] {
        output = std::make_unique<Output_file>(file("out"));
        output->stream() << "of the other";
        output->finish();
      },
      [&] { output->commit(); });
  write_target("out");
  EXPECT_TRUE(process.go_on());
  EXPECT_EQ(read_file(file("out")), "of the other");
}

TEST_F(Temporary_test, directory_of_a_living_process_stays_until_its_commit) {
  std::unique_ptr<Output_directory> output;
  Other_process process(
      [&] {
        output = std::make_unique<Output_directory>(file("out"));
        output->write("a", "of the other");
      },
      [&] {
        output->write("b", "of the other");
        output->commit();
      });
  { Output_directory another(file("out")); }
  EXPECT_TRUE(process.go_on());
  EXPECT_EQ(entries(), Entries{"out"});
  EXPECT_EQ(read_file(file("out/a")), "of the other");
  EXPECT_EQ(read_file(file("out/b")), "of the other");
}

TEST_F(Temporary_test, of_the_same_process_stays) {
  Output_file one(file("out"));
  Output_file other(file("out"));
  EXPECT_EQ(entries().size(), 2U);
  one.stream() << "one";
  one.commit();
  other.commit();
  EXPECT_EQ(entries(), Entries{"out"});
}

TEST_F(Temporary_test, of_another_target_stays) {
  leave_file("out");
  leave_directory("out");
  for (const char* name : {"other", "ou", "out2", "out-2"}) write_target(name);
  EXPECT_EQ(entries().size(), 6U);
  write_target("out");
  EXPECT_EQ(entries().size(), 6U);  // only the directory is left
  write_directory("out.d");
  fs::remove(file("out"));
  write_directory("out");
  EXPECT_EQ(entries(), (Entries{"other", "ou", "out", "out-2", "out.d", "out2"}));
}

// Who may hold a lock that is not seen here is not known to be dead.
TEST_F(Temporary_test, of_another_kernel_or_file_system_stays) {
  leave_file("out");
  const std::string name = temporary();
  const std::size_t place = std::string(".kinetri-out-").size();
  for (const std::size_t digit : {place, place + 15, place + 17}) {
    std::string other = name;
    other[digit] = other[digit] == '0' ? '1' : '0';
    fs::rename(file(name), file(other));
    write_target("out");
    EXPECT_EQ(entries(), (Entries{other, "out"}));
    fs::rename(file(other), file(name));
  }
  write_target("out");
  EXPECT_EQ(entries(), Entries{"out"});
}

TEST_F(Temporary_test, what_is_no_file_stays) {
  leave_file("out");
  const std::string name = temporary();
  fs::remove(file(name));
  const auto expect_to_stay = [&] {
    write_target("out");
    EXPECT_EQ(entries(), (Entries{name, "out"}));
    fs::remove(file(name));
  };
  ASSERT_EQ(::mkdir(file(name).c_str(), 0700), 0);
  expect_to_stay();
  write_file(file("kept"), "text");
  fs::create_symlink("kept", file(name));
  write_target("out");
  EXPECT_EQ(entries(), (Entries{name, "kept", "out"}));
  fs::remove(file(name));
  fs::remove(file("kept"));
  ASSERT_EQ(::mkfifo(file(name).c_str(), 0600), 0);
  expect_to_stay();
}

TEST_F(Temporary_test, directory_in_one_stays) {
  leave_directory("out");
  const std::string name = temporary();
  fs::create_directory(file(name + "/inner"));
  write_file(file(name + "/inner/kept"), "text");
  write_directory("out");
  EXPECT_EQ(read_file(file(name + "/inner/kept")), "text");
}

TEST_F(Temporary_test, of_a_target_with_a_long_name_is_removed) {
  std::string umlauts;
  while (umlauts.size() + 2 <= 255) umlauts += "\u00fc";
  for (const std::string& name : {std::string(255, 'x'), umlauts}) {
    leave_file(name);
    EXPECT_EQ(entries().size(), 1U);
    EXPECT_LE(temporary().size(), 255U);
    write_target(name);
    EXPECT_EQ(entries(), Entries{name});
    fs::remove(file(name));
  }
}

TEST_F(Temporary_test, is_removed_where_the_target_is_relative_or_a_link) {
  fs::create_directory(file("elsewhere"));
  fs::create_symlink("elsewhere/out", file("link"));
  leave_file("link");
  EXPECT_EQ(entries(), (Entries{"elsewhere", "link"}));
  const fs::path before = fs::current_path();
  fs::current_path(file("elsewhere"));
  Output_file("out").commit();
  fs::current_path(before);
  EXPECT_EQ(std::distance(fs::directory_iterator(file("elsewhere")), fs::directory_iterator()), 1);
}

// Some are killed at any moment, others write the same targets: each that is not killed succeeds,
// and the last one removes all that is left.
TEST_F(Temporary_test, processes_do_not_disturb_each_other) {
  const auto write_again_and_again = [&](unsigned seed) {
    ::alarm(60);
    std::mt19937 random(seed);
    for (int i = 0; i < 60; ++i) {
      std::vector<Output_file> outputs;
      for (const char* name : {"one", "two"}) outputs.emplace_back(file(name)).stream() << seed;
      if (random() % 2 == 0) continue;
      for (Output_file& output : outputs) output.finish();
      for (Output_file& output : outputs) output.commit();
    }
  };
  std::mt19937 random(1);
  for (int round = 0; round < test::cases(2); ++round) {
    std::vector<pid_t> processes;
    for (unsigned i = 0; i < 6; ++i) {
      processes.push_back(::fork());
      ASSERT_GE(processes.back(), 0);
      if (processes.back() != 0) continue;
      try {
        write_again_and_again(static_cast<unsigned>(round) * 10 + i);
      } catch (const std::exception&) {
        ::_exit(1);
      }
      ::_exit(0);
    }
    for (std::size_t i = 0; i < processes.size(); ++i) {
      const bool is_to_be_killed = i % 2 == 0;
      if (is_to_be_killed) {
        std::this_thread::sleep_for(std::chrono::microseconds(random() % 10000));
        ::kill(processes[i], SIGKILL);
      }
      int status = 1;
      ASSERT_EQ(::waitpid(processes[i], &status, 0), processes[i]);
      if (!is_to_be_killed) {
        ASSERT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
      }
    }
  }
  write_target("one");
  write_target("two");
  EXPECT_EQ(entries(), (Entries{"one", "two"}));
}

// ---- signals ----

extern "C" {
static void remove_and_end(int /*signal*/) {
  Output_file::remove_all_temporaries();
  Output_directory::remove_all_temporaries();
  ::_exit(0);
}
}

TEST_F(Temporary_test, signal_at_any_moment_leaves_nothing) {
  const std::array<std::function<void()>, 3> writers = {
      [&] { Output_file output(file("out")); }, [&] { Output_file(file("out")).commit(); },
      [&] { Output_directory(file("out")).write("a", "text"); }};
  std::mt19937 random(1);
  for (const auto& write_output : writers) {
    for (int i = 0; i < test::cases(60); ++i) {
      const pid_t process = ::fork();
      ASSERT_GE(process, 0);
      if (process == 0) {
        ::alarm(60);
        std::signal(SIGTERM, remove_and_end);
        while (true) write_output();
      }
      std::this_thread::sleep_for(std::chrono::microseconds(500 + random() % 1000));
      ::kill(process, SIGTERM);
      ASSERT_EQ(::waitpid(process, nullptr, 0), process);
      fs::remove(file("out"));
      ASSERT_EQ(entries(), Entries());
    }
  }
}

}  // namespace
}  // namespace kinetri::temporary_test
