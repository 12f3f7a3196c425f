// SPDX-License-Identifier: GPL-3.0-or-later
#include "video/formats/y4m.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <iostream>
#include <istream>
#include <optional>
#include <string_view>
#include <utility>

#include "kinetri/base/error.h"
#include "kinetri/impl/io/output_file.h"
#include "kinetri/impl/io/text.h"

namespace kinetri::video {
namespace {

constexpr std::string_view signature = "YUV4MPEG2";
constexpr std::size_t longest_line = 4096;

struct Chroma_tag {
  std::string_view tag;
  Chroma chroma;
};
// The first tag of a format is used for writing.
constexpr std::array<Chroma_tag, 7> chroma_tags = {{{"mono", Chroma::mono},
                                                    {"444", Chroma::yuv444},
                                                    {"422", Chroma::yuv422},
                                                    {"420jpeg", Chroma::yuv420_jpeg},
                                                    {"420", Chroma::yuv420_jpeg},
                                                    {"420mpeg2", Chroma::yuv420_mpeg2},
                                                    {"420paldv", Chroma::yuv420_paldv}}};
constexpr std::string_view full_range = "COLORRANGE=FULL";

std::optional<std::uint32_t> whole_number(std::string_view text) {
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<Ratio> ratio(std::string_view text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos) return std::nullopt;
  const auto numerator = whole_number(text.substr(0, colon));
  const auto denominator = whole_number(text.substr(colon + 1));
  if (!numerator || !denominator) return std::nullopt;
  return Ratio{*numerator, *denominator};
}

// As 420p10 and mono16.
bool is_deep(std::string_view tag) {
  const std::size_t begin = tag.starts_with("mono") ? 4 : tag.rfind('p') + 1;
  return begin > 0 && whole_number(tag.substr(std::min(begin, tag.size()))).has_value();
}

class Y4m_source : public Frame_source {
 public:
  Y4m_source(std::unique_ptr<std::istream> owned, std::istream& in, std::string name)
      : owned_(std::move(owned)), in_(in), name_(std::move(name)) {
    read_header();
  }

  const Video_format& format() const override { return format_; }
  const std::string& name() const override { return name_; }

  bool read(Frame& frame) override {
    if (in_.peek() == std::istream::traits_type::eof()) {
      if (in_.bad()) fail("it cannot be read any further");
      if (frames_ == 0) fail("there is no frame; expected at least one");
      return false;
    }
    const std::string line = read_line();
    if (line != "FRAME" && !line.starts_with("FRAME ")) {
      fail(joined("frame ", frames_, " does not begin with FRAME; expected frames of ",
                  format_.width, " x ", format_.height, " samples, as the header says"));
    }
    frame = black_frame(format_);
    std::size_t expected = 0;
    for (const auto& plane : frame.planes) expected += plane.size();
    std::size_t found = 0;
    for (auto& plane : frame.planes) {
      // Samples are bytes.
      in_.read(reinterpret_cast<char*>(plane.data()), static_cast<std::streamsize>(plane.size()));
      found += static_cast<std::size_t>(in_.gcount());
      if (static_cast<std::size_t>(in_.gcount()) < plane.size()) {
        fail(joined("frame ", frames_, " is cut off after ", found, " bytes; expected ", expected));
      }
    }
    ++frames_;
    return true;
  }

 private:
  [[noreturn]] void fail(const std::string& message) const { throw Input_error(name_, 0, message); }

  [[noreturn]] void fail_at_begin() const {
    fail(
        "it does not begin with YUV4MPEG2; expected such video (ffmpeg -i CLIP -f yuv4mpegpipe -), "
        "or a folder of PNG files");
  }

  std::string read_line() {
    std::string line;
    char c = 0;
    while (in_.get(c) && c != '\n') {
      line += c;
      if (line.size() > longest_line) {
        if (!line.starts_with(signature)) fail_at_begin();
        fail(joined("a line has more than ", longest_line, " characters; expected fewer"));
      }
    }
    return line;
  }

  void read_header() {
    if (in_.peek() == std::istream::traits_type::eof()) {
      fail("it is empty; expected YUV4MPEG2 video (ffmpeg -i CLIP -f yuv4mpegpipe -)");
    }
    const std::string line = read_line();
    std::string_view rest = line;
    if (!rest.starts_with(signature) || (rest.size() > signature.size() && rest[9] != ' ')) {
      fail_at_begin();
    }
    rest.remove_prefix(signature.size());
    format_.chroma = Chroma::yuv420_jpeg;
    format_.aspect = {0, 0};
    bool has_rate = false;
    while (!rest.empty()) {
      rest.remove_prefix(1);
      const std::size_t end = std::min(rest.find(' '), rest.size());
      const std::string_view token = rest.substr(0, end);
      rest.remove_prefix(end);
      if (!token.empty()) read_parameter(token.front(), token.substr(1), has_rate);
    }
    if (format_.width == 0 || format_.height == 0) {
      fail("the header does not say the size; expected W and H with numbers from 1 on");
    }
    if (!has_rate)
      fail("the header does not say the frame rate; expected F with a ratio, as F25:1");
  }

  void read_parameter(char name, std::string_view value, bool& has_rate) {
    switch (name) {
      case 'W':
        format_.width = size(name, value);
        break;
      case 'H':
        format_.height = size(name, value);
        break;
      case 'F': {
        const auto rate = ratio(value);
        if (!rate || rate->numerator == 0 || rate->denominator == 0) {
          fail(joined("the frame rate is '", value, "'; expected a ratio, as 30000:1001"));
        }
        format_.rate = *rate;
        has_rate = true;
        break;
      }
      case 'I':
        if (value != "p" && value != "?") {
          fail("frames are interlaced; expected progressive ones (ffmpeg -vf yadif makes them)");
        }
        break;
      case 'A': {
        const auto aspect = ratio(value);
        if (!aspect)
          fail(joined("the aspect of samples is '", value, "'; expected a ratio, as 1:1"));
        format_.aspect = *aspect;
        break;
      }
      case 'C':
        format_.chroma = chroma(value);
        break;
      case 'X':
        if (value == full_range) format_.is_full_range = true;
        break;
      default:
        fail(joined("the header has the parameter '", name, value,
                    "', which is not known; expected W, H, F, I, A, C and X"));
    }
  }

  std::uint32_t size(char name, std::string_view value) const {
    const auto number = whole_number(value);
    if (!number || *number == 0 || *number > greatest_size) {
      fail(joined("the header has ", name, value, "; expected a size from 1 to ", greatest_size));
    }
    return *number;
  }

  Chroma chroma(std::string_view tag) const {
    for (const Chroma_tag& known : chroma_tags) {
      if (known.tag == tag) return known.chroma;
    }
    constexpr std::string_view expected =
        "; expected 420jpeg, 420mpeg2, 420paldv, 422, 444 or mono (ffmpeg -pix_fmt yuv420p)";
    if (is_deep(tag)) {
      fail(joined("samples have more than 8 bits (C", tag, "), which the stream has no room for",
                  expected));
    }
    if (tag == "444alpha") fail(joined("frames are transparent (C444alpha)", expected));
    fail(joined("the color format C", tag, " is not known", expected));
  }

  std::unique_ptr<std::istream> owned_;
  std::istream& in_;
  std::string name_;
  Video_format format_;
  std::size_t frames_ = 0;
};

class Y4m_sink : public Frame_sink {
 public:
  Y4m_sink(const std::string& path, const Video_format& format) : output_(path) {
    output_.stream() << y4m_header(format);
  }

  void write(const Frame& frame) override {
    std::ostream& out = output_.stream();
    out << y4m_frame_line;
    for (const auto& plane : frame.planes) {
      out.write(reinterpret_cast<const char*>(plane.data()),
                static_cast<std::streamsize>(plane.size()));
    }
    // Nobody reads the rest.
    if (!out) output_.finish();
  }

  void commit() override { output_.commit(); }

 private:
  Output_file output_;
};

}  // namespace

std::string_view y4m_color(Chroma chroma) {
  return std::ranges::find(chroma_tags, chroma, &Chroma_tag::chroma)->tag;
}

std::string y4m_header(const Video_format& format) {
  std::string header = joined(signature, " W", format.width, " H", format.height, " F",
                              format.rate.numerator, ":", format.rate.denominator, " Ip A",
                              format.aspect.numerator, ":", format.aspect.denominator);
  append(header, " C", y4m_color(format.chroma));
  if (format.is_full_range) append(header, " X", full_range);
  return header + "\n";
}

std::unique_ptr<Frame_source> read_y4m(std::istream& in, const std::string& name) {
  return std::make_unique<Y4m_source>(nullptr, in, name);
}

std::unique_ptr<Frame_source> open_y4m(const std::string& path) {
  if (path == "-") return read_y4m(std::cin, "standard input");
  auto file = std::make_unique<std::ifstream>(path, std::ios::binary);
  if (!*file) {
    throw Input_error(path, 0,
                      joined("it cannot be opened: ", std::strerror(errno),
                             "; expected YUV4MPEG2 video or a folder of PNG files"));
  }
  std::istream& in = *file;
  return std::make_unique<Y4m_source>(std::move(file), in, path);
}

std::unique_ptr<Frame_sink> create_y4m(const std::string& path, const Video_format& format) {
  return std::make_unique<Y4m_sink>(path, format);
}

}  // namespace kinetri::video
