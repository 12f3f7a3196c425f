// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/impl/io/output_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <streambuf>
#include <system_error>
#include <utility>
#include <vector>

#include "output_failure.h"
#include "temporary.h"

namespace kinetri {
namespace {

namespace fs = std::filesystem;

// The temporaries that a signal handler must remove.
std::array<std::atomic<const char*>, 16> temporaries;
static_assert(std::atomic<const char*>::is_always_lock_free);

void remember(const char* temporary) {
  for (auto& entry : temporaries) {
    const char* expected = nullptr;
    if (entry.compare_exchange_strong(expected, temporary)) return;
  }
}

void forget(const char* temporary) {
  for (auto& entry : temporaries) {
    const char* expected = temporary;
    if (entry.compare_exchange_strong(expected, nullptr)) return;
  }
}

// The end of a chain of symbolic links; it need not exist.
fs::path resolved(fs::path path) {
  constexpr int longest_chain = 40;
  std::error_code error;
  for (int i = 0; i < longest_chain && fs::is_symlink(path, error); ++i) {
    const fs::path next = fs::read_symlink(path, error);
    if (error) break;
    path = path.parent_path() / next;
  }
  return path;
}

}  // namespace

// Writes to a file descriptor, and stores the error.
class Output_file::Buffer : public std::streambuf {
 public:
  Buffer(int descriptor, bool owned) : descriptor_(descriptor), owned_(owned), memory_(size) {
    setp(memory_.data(), memory_.data() + memory_.size());
  }
  ~Buffer() override {
    if (owned_ && descriptor_ >= 0) ::close(descriptor_);
  }
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;

  int error() const { return error_; }
  void keep_checksum() { checksum_.emplace(); }
  const std::optional<Checksum>& checksum() const { return checksum_; }

  // Flushes and closes. False if any write failed.
  bool close() {
    flush();
    if (owned_ && descriptor_ >= 0 && ::close(descriptor_) != 0 && error_ == 0) error_ = errno;
    descriptor_ = -1;
    return error_ == 0;
  }

 protected:
  int_type overflow(int_type c) override {
    if (!flush()) return traits_type::eof();
    if (traits_type::eq_int_type(c, traits_type::eof())) return traits_type::not_eof(c);
    *pptr() = traits_type::to_char_type(c);
    pbump(1);
    return c;
  }

  int sync() override { return flush() ? 0 : -1; }

 private:
  static constexpr std::size_t size = std::size_t{1} << 16U;

  bool flush() {
    const char* from = pbase();
    while (from != pptr() && error_ == 0) {
      const ssize_t written = ::write(descriptor_, from, static_cast<std::size_t>(pptr() - from));
      if (written >= 0) {
        from += written;
      } else if (errno != EINTR) {
        error_ = errno;
      }
    }
    if (checksum_) checksum_->add({pbase(), static_cast<std::size_t>(pptr() - pbase())});
    setp(memory_.data(), memory_.data() + memory_.size());
    return error_ == 0;
  }

  int descriptor_;
  bool owned_;
  int error_ = 0;
  std::optional<Checksum> checksum_;
  std::vector<char> memory_;
};

Output_file::Output_file(std::string path) : path_(std::move(path)) {
  struct stat status = {};
  if (path_.empty()) {
    fail_output("''", "is no path of an output file", 0, "a path, or - for standard output");
  } else if (path_ == "-") {
    // Detected before a long run, not after it.
    const int flags = ::fcntl(STDOUT_FILENO, F_GETFL);
    if (flags < 0 || (flags & O_ACCMODE) == O_RDONLY) {
      fail_output(path_, "is closed, or open for reading alone", 0, "it open for writing");
    }
    identity_ = path_;
    buffer_ = std::make_unique<Buffer>(STDOUT_FILENO, false);
  } else if (::stat(path_.c_str(), &status) != 0) {
    if (errno != ENOENT)
      fail_output(path_, "cannot be written", errno, "a path that can be reached");
    open_temporary(nullptr);
  } else if (S_ISDIR(status.st_mode)) {
    fail_output(path_, "is a directory", 0, "the path of a file");
  } else if (S_ISREG(status.st_mode)) {
    open_temporary(&status);
  } else {
    open_directly(S_ISCHR(status.st_mode));
  }
  stream_ = std::make_unique<std::ostream>(buffer_.get());
}

Output_file::~Output_file() {
  discard();
}

Output_file::Output_file(Output_file&&) noexcept = default;

std::ostream& Output_file::stream() noexcept {
  return *stream_;
}

void Output_file::keep_checksum() {
  if (temporary_) buffer_->keep_checksum();
}

const std::optional<Checksum>& Output_file::checksum() const noexcept {
  return buffer_->checksum();
}

void Output_file::open_temporary(const struct stat* existing) {
  if (existing != nullptr && ::access(path_.c_str(), W_OK) != 0) {
    fail_output(path_, "exists and cannot be written", errno, "a file that may be replaced");
  }
  target_ = resolved(path_).string();
  std::error_code ignored;
  identity_ = fs::weakly_canonical(fs::absolute(target_, ignored), ignored).string();

  // So that signal handlers know every existing file.
  const Signals_held_back held_back;
  Made_temporary made = make_temporary(Temporary_kind::file, target_);
  // Closed after renaming, so that the file is locked until then.
  if (made.descriptor) {
    lock_ = File_descriptor(::fcntl(made.descriptor.number(), F_DUPFD_CLOEXEC, 0));
    if (!lock_) {
      made.error = errno;
      ::unlink(made.path.c_str());
    }
  }
  if (!lock_) {
    fail_output(path_, "cannot be written", made.error,
                "a path in an existing directory in which files can be created");
  }
  temporary_ = std::make_unique<std::string>(std::move(made.path));
  remember(temporary_->c_str());
  const int descriptor = made.descriptor.release();
  buffer_ = std::make_unique<Buffer>(descriptor, true);
  if (existing != nullptr) {
    // Failures are ignored: not all users may change owners, and the result must not be lost.
    const bool owner_kept = ::fchown(descriptor, existing->st_uid, existing->st_gid) == 0;
    const bool mode_kept = ::fchmod(descriptor, existing->st_mode & 0777U) == 0;
    static_cast<void>(owner_kept && mode_kept);
  }
}

void Output_file::open_directly(bool character_device) {
  const int descriptor = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) fail_output(path_, "cannot be written", errno, "a writable file");
  if (!character_device) {
    std::error_code ignored;
    identity_ = fs::weakly_canonical(path_, ignored).string();
  }
  buffer_ = std::make_unique<Buffer>(descriptor, true);
}

void Output_file::finish() {
  if (finished_) return;
  stream_->flush();
  const bool stream_good = stream_->good();
  const bool closed = buffer_->close();
  stream_->setstate(std::ios::badbit);  // later output is lost
  if (!stream_good || !closed) {
    discard();
    const bool is_unread = path_ == "-" && buffer_->error() == EPIPE;
    const auto fail = is_unread ? fail_output<Unread_output_error> : fail_output<Output_error>;
    fail(path_, "writing failed", buffer_->error(), "a place that takes all of it");
  }
  finished_ = true;
}

void Output_file::commit() {
  finish();
  if (!temporary_) return;
  if (std::rename(temporary_->c_str(), target_.c_str()) != 0) {
    const int error = errno;
    discard();
    fail_output(path_, "cannot be replaced by the file written beside it", error,
                "a file that may be replaced");
  }
  forget(temporary_->c_str());
  temporary_.reset();
  lock_.reset();
}

void Output_file::discard() noexcept {
  if (!temporary_) return;
  ::unlink(temporary_->c_str());
  forget(temporary_->c_str());
  temporary_.reset();
  lock_.reset();
}

void Output_file::remove_all_temporaries() noexcept {
  for (const auto& entry : temporaries) {
    if (const char* const temporary = entry.load()) ::unlink(temporary);
  }
}

}  // namespace kinetri
