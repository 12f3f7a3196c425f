// SPDX-License-Identifier: GPL-3.0-or-later
#include "temporary.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <fstream>
#include <memory>
#include <random>
#include <string_view>
#include <system_error>

#include "kinetri/impl/io/text.h"

namespace kinetri {
namespace {

namespace fs = std::filesystem;

// A beginning of the target's name that is short enough: names may have 255 bytes.
std::string beginning_of_name(const fs::path& target) {
  constexpr std::size_t most = 170;
  std::string name = target.filename().string();
  if (name.size() > most) {
    std::size_t size = most;
    const auto is_inside_character = [&](std::size_t i) {  // UTF-8
      return (static_cast<unsigned char>(name[i]) & 0xC0U) == 0x80;
    };
    while (size > 0 && is_inside_character(size)) --size;
    name.resize(size);
  }
  return joined(".kinetri-", name, '-');
}

// Identifies the running kernel; empty if unknown.
const std::string& running_kernel() {
  static const std::string id = [] {
    constexpr std::size_t size = 36;  // as 01234567-89ab-...
    std::string text;
    std::ifstream("/proc/sys/kernel/random/boot_id") >> text;
    return text.size() == size ? text.substr(0, 8) + text.substr(9, 4) + text.substr(14, 4) : "";
  }();
  return id;
}

// Identifies the processes to which a lock of this process on a file in the directory is visible.
// Empty if unknown.
std::string place_of_locks(const fs::path& directory) {
  struct stat status = {};
  if (running_kernel().empty() || ::stat(directory.c_str(), &status) != 0) return "";
  return joined(running_kernel(), '-', hexadecimal(status.st_dev, 1), '-');
}

std::string_view ending(Temporary_kind kind) {
  return kind == Temporary_kind::file ? ".tmp" : ".dir";
}

// A text that occurs in no other name of a temporary.
std::string unique_part() {
  static const std::string of_process = [] {
    std::random_device random;
    return hexadecimal(random(), 8) + hexadecimal(random(), 8);
  }();
  static std::atomic<unsigned> next_number = 0;
  return joined(of_process, '-', next_number++);
}

File_descriptor opened(Temporary_kind kind, const std::string& path) {
  constexpr int always = O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK;
  // On NFS an exclusive lock needs a descriptor for writing.
  const int flags = kind == Temporary_kind::file ? O_WRONLY : O_RDONLY | O_DIRECTORY;
  return File_descriptor(::open(path.c_str(), flags | always));
}

File_descriptor created(Temporary_kind kind, const std::string& path) {
  if (kind == Temporary_kind::file) {
    return File_descriptor(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
  }
  if (::mkdir(path.c_str(), 0777) != 0) return {};
  File_descriptor result = opened(kind, path);
  if (!result) {
    const int error = errno;
    ::rmdir(path.c_str());
    errno = error;
  }
  return result;
}

void remove(Temporary_kind kind, const File_descriptor& descriptor, const std::string& path) {
  if (kind == Temporary_kind::directory) {
    remove_directory(descriptor.number(), path.c_str());
  } else {
    ::unlink(path.c_str());
  }
}

enum class Lock { got, held_by_another, impossible };

// Locks an open file. Lock::got only if the path still names it: another process may have removed
// it, and released its lock, meanwhile.
Lock lock_file(const File_descriptor& descriptor, const std::string& path) {
  if (::flock(descriptor.number(), LOCK_EX | LOCK_NB) != 0) {
    return errno == EWOULDBLOCK ? Lock::held_by_another : Lock::impossible;
  }
  struct stat held = {};
  struct stat there = {};
  const bool is_there = ::fstat(descriptor.number(), &held) == 0 &&
                        ::lstat(path.c_str(), &there) == 0 && held.st_dev == there.st_dev &&
                        held.st_ino == there.st_ino;
  return is_there ? Lock::got : Lock::held_by_another;
}

void remove_left_over(Temporary_kind kind, const fs::path& directory,
                      const std::string& beginning) {
  std::error_code error;
  for (fs::directory_iterator entry(directory, error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (!name.starts_with(beginning) || !name.ends_with(ending(kind))) continue;
    const std::string path = entry->path().string();
    const File_descriptor descriptor = opened(kind, path);
    // Its creator holds a lock; or, before locking it, fails to get the lock held here, and creates
    // another one.
    if (descriptor && lock_file(descriptor, path) == Lock::got) remove(kind, descriptor, path);
  }
}

}  // namespace

Made_temporary make_temporary(Temporary_kind kind, const fs::path& target) {
  const fs::path directory = target.has_parent_path() ? target.parent_path() : ".";
  const std::string beginning = beginning_of_name(target);
  std::string place = place_of_locks(directory);
  if (!place.empty()) remove_left_over(kind, directory, beginning + place);
  while (true) {
    Made_temporary made;
    made.path = (directory / joined(beginning, place, unique_part(), ending(kind))).string();
    made.descriptor = created(kind, made.path);
    if (!made.descriptor) {
      made.error = errno;
      if (made.error == EEXIST) continue;
      return made;
    }
    if (place.empty()) return made;
    switch (lock_file(made.descriptor, made.path)) {
      case Lock::got:
        return made;
      case Lock::held_by_another:  // which removes it
        break;
      case Lock::impossible:
        remove(kind, made.descriptor, made.path);
        place.clear();  // so that no process removes it
        break;
    }
  }
}

void remove_directory(int descriptor, const char* path) {
  struct Closer {
    void operator()(DIR* list) const { ::closedir(list); }
  };
  const int copy = ::openat(descriptor, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (const std::unique_ptr<DIR, Closer> list(copy < 0 ? nullptr : ::fdopendir(copy)); list) {
    while (const dirent* const entry = ::readdir(list.get())) {
      ::unlinkat(descriptor, static_cast<const char*>(entry->d_name), 0);
    }
  }
  ::rmdir(path);
}

}  // namespace kinetri
