// SPDX-License-Identifier: GPL-3.0-or-later
#include "video/formats/png_folder.h"

#include <png.h>

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>
#include <vector>

#include "kinetri/base/error.h"
#include "kinetri/impl/io/output_directory.h"
#include "kinetri/impl/io/text.h"

namespace kinetri::video {
namespace {

std::uint8_t rounded(int value_times_65536) {
  return static_cast<std::uint8_t>(std::clamp((value_times_65536 + 32768) >> 16, 0, 255));
}

// libpng's simplified interface, with its memory.
class Image {
 public:
  Image() { image_.version = PNG_IMAGE_VERSION; }
  ~Image() { png_image_free(&image_); }
  Image(const Image&) = delete;
  Image& operator=(const Image&) = delete;

  png_image& operator*() { return image_; }
  png_image* operator->() { return &image_; }
  png_image* get() { return &image_; }

 private:
  png_image image_ = {};
};

struct Picture {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  bool is_gray = true;
  std::vector<std::uint8_t> rgb;
};

Picture read_png(const std::string& path) {
  Image image;
  const auto fail = [&](const std::string& what) { throw Input_error(path, 0, what); };
  if (png_image_begin_read_from_file(image.get(), path.c_str()) == 0) {
    fail(joined("it cannot be read: ", image->message, "; expected a PNG file"));
  }
  if (image->width > greatest_size || image->height > greatest_size) {
    fail(joined("it has ", image->width, " x ", image->height, " pixels; expected at most ",
                greatest_size, " in a row and a column"));
  }
  if ((image->format & PNG_FORMAT_FLAG_LINEAR) != 0) {
    fail("it has 16 bits a sample, which the stream has no room for; expected 8");
  }
  Picture result = {image->width, image->height, (image->format & PNG_FORMAT_FLAG_COLOR) == 0, {}};
  image->format = PNG_FORMAT_RGBA;
  std::vector<std::uint8_t> rgba(PNG_IMAGE_SIZE(*image));
  if (png_image_finish_read(image.get(), nullptr, rgba.data(), 0, nullptr) == 0) {
    fail(joined("it cannot be read: ", image->message, "; expected a whole PNG file"));
  }
  const std::size_t pixels = rgba.size() / 4;
  result.rgb.resize(3 * pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    if (rgba[4 * i + 3] != 255) fail("it is transparent in places; expected an opaque picture");
    std::copy_n(&rgba[4 * i], 3, &result.rgb[3 * i]);
  }
  return result;
}

// From the limited range of ITU-R BT.601 to full range.
std::uint8_t full_brightness(std::uint8_t y) {
  return rounded((y - 16) * 76309);  // 255 / 219 * 65536
}
std::uint8_t full_color(std::uint8_t c) {
  return rounded((c - 128) * 74606 + (128 << 16));  // 255 / 224 * 65536
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

// Natural order, in which frame2 is before frame10: digits are compared as numbers of any length,
// other characters by their codes. Names that differ only in leading zeros are in lexicographic
// order.
bool is_before(const std::string& a, const std::string& b) {
  std::size_t i = 0;
  std::size_t j = 0;
  const auto digits_at = [](const std::string& text, std::size_t at) {
    std::size_t end = at;
    while (end < text.size() && is_digit(text[end])) ++end;
    while (at + 1 < end && text[at] == '0') ++at;
    return std::pair(std::string_view(text).substr(at, end - at), end);
  };
  while (i < a.size() && j < b.size()) {
    if (is_digit(a[i]) && is_digit(b[j])) {
      const auto [of_a, end_a] = digits_at(a, i);
      const auto [of_b, end_b] = digits_at(b, j);
      if (of_a.size() != of_b.size()) return of_a.size() < of_b.size();
      if (of_a != of_b) return of_a < of_b;
      i = end_a;
      j = end_b;
    } else {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i;
      ++j;
    }
  }
  if (i < a.size() || j < b.size()) return j < b.size();
  return a < b;
}

class Png_source : public Frame_source {
 public:
  Png_source(const std::string& path, const Ratio& rate) : path_(path) {
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(path, error)) {
      if (entry.path().extension() == ".png") files_.push_back(entry.path().string());
    }
    if (error) throw Input_error(path, 0, joined("it cannot be read: ", error.message()));
    if (files_.empty()) {
      throw Input_error(path, 0, "there is no file *.png in it; expected one for each frame");
    }
    std::ranges::sort(files_, is_before);
    first_ = read_png(files_.front());
    format_ = {first_.width, first_.height, first_.is_gray ? Chroma::mono : Chroma::yuv444,
               true,         rate,          {1, 1}};
  }

  const Video_format& format() const override { return format_; }
  const std::string& name() const override { return path_; }

  bool read(Frame& frame) override {
    if (next_ == files_.size()) return false;
    const std::string& file = files_[next_];
    const Picture picture = next_ == 0 ? std::move(first_) : read_png(file);
    ++next_;
    if (picture.width != format_.width || picture.height != format_.height) {
      throw Input_error(
          file, 0,
          joined("it has ", picture.width, " x ", picture.height, " pixels; expected ",
                 format_.width, " x ", format_.height, ", as ", files_.front(), " has"));
    }
    if (format_.chroma == Chroma::mono && !picture.is_gray) {
      throw Input_error(
          file, 0,
          joined("it has colors, but ", files_.front(), " is gray; expected pictures of one kind"));
    }
    frame = black_frame(format_);
    for (std::size_t i = 0; i < frame.planes[0].size(); ++i) {
      const std::uint8_t* rgb = &picture.rgb[3 * i];
      if (format_.chroma == Chroma::mono) {
        frame.planes[0][i] = rgb[0];
        continue;
      }
      const auto ycbcr = ycbcr_of({rgb[0], rgb[1], rgb[2]});
      for (std::size_t plane = 0; plane < 3; ++plane) frame.planes[plane][i] = ycbcr[plane];
    }
    return true;
  }

 private:
  std::string path_;
  std::vector<std::string> files_;
  Picture first_;
  Video_format format_;
  std::size_t next_ = 0;
};

class Png_sink : public Frame_sink {
 public:
  Png_sink(const std::string& path, const Video_format& format)
      : directory_(path), format_(format) {}

  void write(const Frame& frame) override {
    Image image;
    image->width = format_.width;
    image->height = format_.height;
    const bool is_gray = format_.chroma == Chroma::mono;
    image->format = is_gray ? PNG_FORMAT_GRAY : PNG_FORMAT_RGB;
    const std::vector<std::uint8_t> pixels = pixels_of(frame);
    std::string file(PNG_IMAGE_PNG_SIZE_MAX(*image), '\0');
    png_alloc_size_t size = file.size();
    if (png_image_write_to_memory(image.get(), file.data(), &size, 0, pixels.data(), 0, nullptr) ==
        0) {
      throw Output_error(joined(directory_.path(), ": frame ", frames_,
                                " cannot be made a PNG file: ", image->message));
    }
    file.resize(size);
    std::string number = std::to_string(frames_++);
    if (number.size() < 5) number.insert(0, 5 - number.size(), '0');
    directory_.write(number + ".png", file);
  }

  void commit() override { directory_.commit(); }

 private:
  std::vector<std::uint8_t> pixels_of(const Frame& frame) const {
    std::vector<std::uint8_t> result;
    const bool is_gray = format_.chroma == Chroma::mono;
    result.reserve(frame.planes[0].size() * (is_gray ? 1 : 3));
    const std::uint32_t columns_each = format_.chroma_width() < format_.width ? 2 : 1;
    const std::uint32_t rows_each = format_.chroma_height() < format_.height ? 2 : 1;
    for (std::uint32_t row = 0; row < format_.height; ++row) {
      for (std::uint32_t column = 0; column < format_.width; ++column) {
        const std::uint8_t y = frame.planes[0][std::size_t{row} * format_.width + column];
        if (is_gray) {
          result.push_back(format_.is_full_range ? y : full_brightness(y));
          continue;
        }
        const std::size_t i =
            std::size_t{row / rows_each} * format_.chroma_width() + column / columns_each;
        const auto rgb = rgb_of({y, frame.planes[1][i], frame.planes[2][i]}, format_.is_full_range);
        result.insert(result.end(), rgb.begin(), rgb.end());
      }
    }
    return result;
  }

  Output_directory directory_;
  Video_format format_;
  std::size_t frames_ = 0;
};

}  // namespace

// The factors are those of JFIF times 65536: 0.299, 0.587, 0.114 and what follows from them.
std::array<std::uint8_t, 3> ycbcr_of(const std::array<std::uint8_t, 3>& rgb) {
  const auto [r, g, b] = std::array<int, 3>{rgb[0], rgb[1], rgb[2]};
  return {rounded(19595 * r + 38470 * g + 7471 * b),
          rounded(-11059 * r - 21709 * g + 32768 * b + (128 << 16)),
          rounded(32768 * r - 27439 * g - 5329 * b + (128 << 16))};
}

std::array<std::uint8_t, 3> rgb_of(const std::array<std::uint8_t, 3>& ycbcr, bool is_full) {
  const int y = 65536 * (is_full ? ycbcr[0] : full_brightness(ycbcr[0]));
  const int cb = (is_full ? ycbcr[1] : full_color(ycbcr[1])) - 128;
  const int cr = (is_full ? ycbcr[2] : full_color(ycbcr[2])) - 128;
  return {rounded(y + 91881 * cr), rounded(y - 22554 * cb - 46802 * cr), rounded(y + 116130 * cb)};
}

std::unique_ptr<Frame_source> open_png_folder(const std::string& path, const Ratio& rate) {
  return std::make_unique<Png_source>(path, rate);
}

std::unique_ptr<Frame_sink> create_png_folder(const std::string& path, const Video_format& format) {
  return std::make_unique<Png_sink>(path, format);
}

}  // namespace kinetri::video
