// SPDX-License-Identifier: GPL-3.0-or-later
#include "video/program/x264.h"

#include <sys/wait.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string_view>
#include <system_error>
#include <utility>

#include "kinetri/base/error.h"
#include "kinetri/impl/io/text.h"
#include "video/formats/y4m.h"

namespace kinetri::video {
namespace {

namespace fs = std::filesystem;

constexpr int not_found = 127;  // exit code of the shell if a program is not found

std::string_view pixel_format(Chroma chroma) {
  constexpr std::array<std::string_view, 6> names = {"gray",    "yuv444p", "yuv422p",
                                                     "yuv420p", "yuv420p", "yuv420p"};
  return names[static_cast<std::size_t>(chroma)];
}

// A new folder for temporary files, which is removed with its content.
class Temporary_folder {
 public:
  Temporary_folder() : path_((fs::temp_directory_path() / "kinetri-video-XXXXXX").string()) {
    if (mkdtemp(path_.data()) == nullptr) {
      throw std::system_error(errno, std::generic_category(), path_);
    }
  }
  ~Temporary_folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Temporary_folder(const Temporary_folder&) = delete;
  Temporary_folder& operator=(const Temporary_folder&) = delete;

  std::string file(const std::string& name) const { return path_ + "/" + name; }
  /// The path of a file, quoted for the shell.
  std::string word(const std::string& name) const {
    std::string result = "'";
    for (const char c : file(name)) c == '\'' ? result += R"('\'')" : result += c;
    return result + "'";
  }

 private:
  std::string path_;
};

// A shell command that reads frames from standard input.
class Command_pipe {
 public:
  explicit Command_pipe(const std::string& command) : pipe_(popen(command.c_str(), "w")) {}
  ~Command_pipe() {
    if (pipe_ != nullptr) pclose(pipe_);
  }
  Command_pipe(const Command_pipe&) = delete;
  Command_pipe& operator=(const Command_pipe&) = delete;

  // Whether it reads more. An absent plane has no bytes, and no address.
  bool write(const void* bytes, std::size_t size) {
    return pipe_ != nullptr && (size == 0 || std::fwrite(bytes, 1, size, pipe_) == size);
  }

  // The exit code of the command.
  int close() {
    if (pipe_ == nullptr) return -1;
    const int status = pclose(std::exchange(pipe_, nullptr));
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

 private:
  std::FILE* pipe_;
};

// Runs the command with the frames as Y4M. Returns its exit code.
int run_on_frames(const std::string& command, const std::string& path, const Ratio& rate) {
  const auto source = open_frames(path, rate);
  const std::string header = y4m_header(source->format());
  Command_pipe pipe(command);
  bool is_wanted = pipe.write(header.data(), header.size());
  Frame frame;
  while (is_wanted && source->read(frame)) {
    is_wanted = pipe.write(y4m_frame_line.data(), y4m_frame_line.size());
    for (const auto& plane : frame.planes) {
      is_wanted = is_wanted && pipe.write(plane.data(), plane.size());
    }
  }
  return pipe.close();
}

// The first message of ffmpeg, which is the cause of the others, without the name and address of
// its component: "[libx264 @ 0x55] requested bitrate is too low".
std::string first_message(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  const std::size_t end = line.starts_with('[') ? line.find("] ") : std::string::npos;
  return end == std::string::npos ? line : line.substr(end + 2);
}

}  // namespace

X264_result x264_at(const std::string& source, const Ratio& rate, std::uint64_t bytes,
                    std::uint64_t frames) {
  X264_result result;
  if (source == "-") {
    result.problem = "the source is a pipe, which cannot be read twice";
    return result;
  }
  const Video_format format = open_frames(source, rate)->format();
  const double seconds =
      static_cast<double>(frames) * format.rate.denominator / format.rate.numerator;
  const auto bits_a_second = static_cast<std::uint64_t>(8 * static_cast<double>(bytes) / seconds);
  const Temporary_folder folder;
  const std::string ffmpeg = "ffmpeg -nostdin -v error -y ";
  const std::string messages = joined(" 2>", folder.word("messages"));
  const auto failed = [&](int code) {
    if (code == 0) return false;
    result.problem = code == not_found
                         ? "ffmpeg is not installed"
                         : joined("ffmpeg failed: ", first_message(folder.file("messages")));
    return true;
  };
  for (const int pass : {1, 2}) {
    const std::string command =
        joined(ffmpeg, "-f yuv4mpegpipe -i pipe:0 -c:v libx264 -preset medium -pix_fmt ",
               pixel_format(format.chroma), " -b:v ", bits_a_second, " -pass ", pass,
               " -passlogfile ", folder.word("log"), " -f h264 ",
               pass == 1 ? "/dev/null" : folder.word("stream.h264"), messages);
    if (failed(run_on_frames(command, source, rate))) return result;
  }
  // Without these options ffmpeg converts full range to limited range.
  const std::string_view range = format.is_full_range ? "pc" : "tv";
  const std::string command =
      joined(ffmpeg, "-i ", folder.word("stream.h264"),
             " -fps_mode passthrough -vf scale=out_range=", range, " -color_range ", range,
             " -pix_fmt ", pixel_format(format.chroma), " ", folder.word("frames.y4m"), messages);
  const int status = std::system(command.c_str());
  if (failed(WIFEXITED(status) ? WEXITSTATUS(status) : -1)) return result;

  result.bytes = fs::file_size(folder.file("stream.h264"));
  result.quality.emplace(format);
  const auto all = open_frames(source, rate);
  const auto others = open_y4m(folder.file("frames.y4m"));
  if (others->format().is_full_range != format.is_full_range) {
    result.problem = "ffmpeg has changed the range of the samples";
    return result;
  }
  Frame frame;
  Frame other;
  while (all->read(frame)) {
    if (!others->read(other) || other.planes[0].size() != frame.planes[0].size()) {
      result.problem = "ffmpeg has lost frames";
      return result;
    }
    result.quality->add(frame, other);
  }
  return result;
}

}  // namespace kinetri::video
