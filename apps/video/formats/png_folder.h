// SPDX-License-Identifier: GPL-3.0-or-later
//
// Video as PNG files of one size in a folder, in the order of the numbers in their names:
// frame2.png is before frame10.png.
//
// Red, green and blue are converted to brightness and color, and back, by the formulas of ITU-R
// BT.601 with full range, as in JFIF, in integer arithmetic. A round trip changes a value by at
// most 2. Gray files are not converted.
#ifndef KINETRI_VIDEO_FORMATS_PNG_FOLDER_H
#define KINETRI_VIDEO_FORMATS_PNG_FOLDER_H

#include <array>
#include <cstdint>
#include <memory>
#include <string>

#include "video/formats/frame.h"

namespace kinetri::video {

/// Reads the files of the folder that end with .png. Throws Input_error if there are none, if they
/// are of different sizes, have more than 8 bits, or are transparent anywhere.
std::unique_ptr<Frame_source> open_png_folder(const std::string& path, const Ratio& rate);

/// Writes 00000.png, 00001.png, ... into a new or empty folder, which appears only when complete.
/// Each pixel has the color of the nearest sample.
std::unique_ptr<Frame_sink> create_png_folder(const std::string& path, const Video_format& format);

/// @{
/// Y, Cb, Cr of full range from red, green, blue; and red, green, blue from Y, Cb, Cr of full or
/// limited range. Each is rounded to the nearest number.
std::array<std::uint8_t, 3> ycbcr_of(const std::array<std::uint8_t, 3>& rgb);
std::array<std::uint8_t, 3> rgb_of(const std::array<std::uint8_t, 3>& ycbcr, bool is_full_range);
/// @}

}  // namespace kinetri::video

#endif  // KINETRI_VIDEO_FORMATS_PNG_FOLDER_H
