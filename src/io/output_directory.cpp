// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/impl/io/output_directory.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>
#include <utility>

#include "kinetri/impl/base/check.h"
#include "output_failure.h"
#include "temporary.h"

namespace kinetri {
namespace {

namespace fs = std::filesystem;

constexpr const char* usable_target = "a directory that is not there yet, or is empty";

// Absolute and without symbolic links as far as it exists, and without a slash at the end.
fs::path canonical_path(const std::string& path) {
  std::error_code error;
  const fs::path absolute = fs::absolute(path, error);
  fs::path result = fs::weakly_canonical(absolute, error);
  if (error) result = absolute.lexically_normal();
  return result.has_filename() ? result : result.parent_path();
}

void check_existing_target(const std::string& path, const fs::path& target) {
  struct stat here = {};
  struct stat above = {};
  if (::stat(target.c_str(), &here) != 0) {
    if (::lstat(path.c_str(), &here) != 0) return;
    fail_output(path, "is a symbolic link that leads nowhere", 0, usable_target);
  }
  if (!S_ISDIR(here.st_mode)) fail_output(path, "is no directory", 0, usable_target);
  std::error_code error;
  const bool is_empty = fs::is_empty(target, error);
  if (error) fail_output(path, "cannot be read", error.value(), usable_target);
  if (!is_empty) {
    fail_output(path, "is not empty", 0,
                std::string(usable_target) + "; remove what is in it, or name another");
  }
  // The current directory and mount points cannot be replaced.
  if (target == fs::current_path(error)) {
    fail_output(path, "is the current directory", 0, "another one");
  }
  if (::stat(target.parent_path().c_str(), &above) == 0 && above.st_dev != here.st_dev) {
    fail_output(path, "is where a file system is mounted", 0, "a directory in it");
  }
}

// Makes a hidden directory beside the target.
Made_temporary make_directory_beside(const std::string& path, const fs::path& target) {
  Made_temporary made = make_temporary(Temporary_kind::directory, target);
  if (made.descriptor) return made;
  fail_output(path, "cannot be made", made.error,
              "a path in an existing directory in which directories can be made");
}

// Writes the whole content. Returns 0 or an errno.
int write_all(int descriptor, std::string_view content) {
  while (!content.empty()) {
    const ssize_t written = ::write(descriptor, content.data(), content.size());
    if (written >= 0) {
      content.remove_prefix(static_cast<std::size_t>(written));
    } else if (errno != EINTR) {
      return errno;
    }
  }
  return 0;
}

}  // namespace

// The directory beside the target, with a list of its files for signal handlers.
struct Output_directory::Temporary {
  struct File {
    std::string path;
    std::unique_ptr<File> previous;
  };

  explicit Temporary(Made_temporary made)
      : path(std::move(made.path)), lock(std::move(made.descriptor)) {
    for (auto& entry : all) {
      const Temporary* expected = nullptr;
      if (entry.compare_exchange_strong(expected, this)) return;
    }
  }
  ~Temporary() {
    for (auto& entry : all) {
      const Temporary* expected = this;
      if (entry.compare_exchange_strong(expected, nullptr)) break;
    }
    // Iteratively: destructors of a long list would recurse deeply.
    std::unique_ptr<File> file(last.load());
    while (file) file = std::move(file->previous);
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;

  // The path of a new file; listed before the file is created.
  const char* add(std::string_view name) {
    auto file = std::make_unique<File>();
    file->path = path + '/' + std::string(name);
    file->previous.reset(last.load());
    last = file.release();
    return last.load()->path.c_str();
  }

  // Async-signal-safe. Does nothing after the directory has been renamed.
  void remove() const noexcept {
    for (const File* file = last.load(); file != nullptr; file = file->previous.get()) {
      ::unlink(file->path.c_str());
    }
    ::rmdir(path.c_str());
  }

  // The directories that a signal handler must remove.
  static inline std::array<std::atomic<const Temporary*>, 16> all = {};

  std::string path;
  File_descriptor lock;
  std::atomic<File*> last = nullptr;
  static_assert(std::atomic<File*>::is_always_lock_free);
};

Output_directory::Output_directory(std::string path) : path_(std::move(path)) {
  if (path_.empty() || path_ == "-") {
    fail_output("'" + path_ + "'", "is no path of a directory", 0, usable_target);
  }
  const fs::path target = canonical_path(path_);
  identity_ = target.string();
  check_existing_target(path_, target);
  const Signals_held_back held_back;
  ::rmdir(make_directory_beside(path_, target).path.c_str());
}

Output_directory::~Output_directory() {
  discard();
}

Output_directory::Output_directory(Output_directory&&) noexcept = default;

void Output_directory::make_temporary() {
  // So that signal handlers know every existing directory.
  const Signals_held_back held_back;
  temporary_ = std::make_unique<Temporary>(make_directory_beside(path_, identity_));
}

void Output_directory::write(std::string_view name, std::string_view content) {
  KINETRI_PRECONDITION(!committed_,
                       "a file for a directory that is complete; write it before commit");
  KINETRI_PRECONDITION(
      !name.empty() && name.find('/') == std::string_view::npos,
      "the name of a file in an output directory is empty or has a slash; expected a plain name");
  if (!temporary_) make_temporary();
  const int file = ::open(temporary_->add(name), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  int error = file < 0 ? errno : write_all(file, content);
  if (file >= 0 && ::close(file) != 0 && error == 0) error = errno;
  if (error == 0) return;
  fail_output((fs::path(path_) / name).string(), "writing failed", error,
              "a place that takes all of it");
}

void Output_directory::commit() {
  if (committed_) return;
  if (!temporary_) make_temporary();
  struct stat replaced = {};
  const bool replaces = ::stat(identity_.c_str(), &replaced) == 0;
  if (std::rename(temporary_->path.c_str(), identity_.c_str()) != 0) {
    const int error = errno;
    discard();
    fail_output(path_, "cannot be replaced by the directory written beside it", error,
                usable_target);
  }
  if (replaces) {
    // Failures are ignored: not all users may change owners, and the result must not be lost.
    const bool owner_kept = ::chown(identity_.c_str(), replaced.st_uid, replaced.st_gid) == 0;
    const bool mode_kept = ::chmod(identity_.c_str(), replaced.st_mode & 07777U) == 0;
    static_cast<void>(owner_kept && mode_kept);
  }
  temporary_.reset();
  committed_ = true;
}

void Output_directory::discard() noexcept {
  if (!temporary_) return;
  temporary_->remove();
  temporary_.reset();
}

void Output_directory::remove_all_temporaries() noexcept {
  for (const auto& entry : Temporary::all) {
    if (const Temporary* const temporary = entry.load()) temporary->remove();
  }
}

}  // namespace kinetri
