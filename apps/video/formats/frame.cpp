// SPDX-License-Identifier: GPL-3.0-or-later
#include "video/formats/frame.h"

#include <filesystem>

#include "video/formats/png_folder.h"
#include "video/formats/y4m.h"

namespace kinetri::video {
namespace {

bool halves_columns(Chroma chroma) {
  return chroma != Chroma::mono && chroma != Chroma::yuv444;
}

bool halves_rows(Chroma chroma) {
  return halves_columns(chroma) && chroma != Chroma::yuv422;
}

}  // namespace

std::uint32_t Video_format::chroma_width() const {
  return halves_columns(chroma) ? (width + 1) / 2 : width;
}

std::uint32_t Video_format::chroma_height() const {
  return halves_rows(chroma) ? (height + 1) / 2 : height;
}

Grid_2 Video_format::grid(std::size_t plane, const Video_format& picture) const {
  const Vector_2 scale = {static_cast<double>(picture.width) / width,
                          static_cast<double>(picture.height) / height};
  if (plane == 0) return {{0.5 * scale.x, 0.5 * scale.y}, scale, width, height};
  const double column_step = halves_columns(chroma) ? 2 : 1;
  const double row_step = halves_rows(chroma) ? 2 : 1;
  const double first_column = chroma == Chroma::yuv420_jpeg ? 1 : 0.5;
  const double first_row =
      chroma == Chroma::yuv420_jpeg || chroma == Chroma::yuv420_mpeg2 ? 1 : 0.5;
  return {{first_column * scale.x, first_row * scale.y},
          {column_step * scale.x, row_step * scale.y},
          chroma_width(),
          chroma_height()};
}

Frame black_frame(const Video_format& format) {
  Frame result;
  const std::uint8_t black = format.is_full_range ? 0 : 16;
  result.planes[0].assign(std::size_t{format.width} * format.height, black);
  for (std::size_t plane = 1; plane < format.planes(); ++plane) {
    result.planes[plane].assign(std::size_t{format.chroma_width()} * format.chroma_height(), 128);
  }
  return result;
}

std::unique_ptr<Frame_source> open_frames(const std::string& path, const Ratio& rate) {
  if (path != "-" && std::filesystem::is_directory(path)) return open_png_folder(path, rate);
  return open_y4m(path);
}

std::unique_ptr<Frame_sink> create_frames(const std::string& path, const Video_format& format) {
  if (path != "-" && (path.ends_with('/') || std::filesystem::is_directory(path))) {
    return create_png_folder(path, format);
  }
  return create_y4m(path, format);
}

}  // namespace kinetri::video
