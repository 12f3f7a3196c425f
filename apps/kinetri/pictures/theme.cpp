// SPDX-License-Identifier: GPL-3.0-or-later
#include "pictures/theme.h"

#include <algorithm>
#include <cmath>

#include "kinetri/impl/io/text.h"

namespace kinetri::app {

std::string color_between(const std::vector<std::array<int, 3>>& colors, double share,
                          double strength) {
  const double place = std::clamp(share, 0.0, 1.0) * static_cast<double>(colors.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(place), colors.size() - 2);
  std::string result = "#";
  for (std::size_t k = 0; k < 3; ++k) {
    const double from = colors[i][k];
    const double part =
        strength * (from + (colors[i + 1][k] - from) * (place - static_cast<double>(i)));
    result += hexadecimal(static_cast<std::uint64_t>(std::clamp(std::round(part), 0.0, 255.0)), 2);
  }
  return result;
}

const std::array<std::string, shades>& color_scale() {
  static const std::array<std::string, shades> result = [] {
    const std::vector<std::array<int, 3>> viridis = {
        {0x44, 0x01, 0x54}, {0x47, 0x2d, 0x7b}, {0x3b, 0x52, 0x8b},
        {0x2c, 0x72, 0x8e}, {0x21, 0x91, 0x8c}, {0x28, 0xae, 0x80},
        {0x5e, 0xc9, 0x62}, {0xad, 0xdc, 0x30}, {0xfd, 0xe7, 0x25}};
    std::array<std::string, shades> scale;
    for (std::size_t i = 0; i < shades; ++i) {
      scale[i] = color_between(viridis, static_cast<double>(i) / (shades - 1));
    }
    return scale;
  }();
  return result;
}

Color kind_color(std::size_t i) {
  constexpr std::array<std::string_view, 8> colors = {"#0072b2", "#e69f00", "#009e73", "#cc79a7",
                                                      "#56b4e9", "#d55e00", "#f0e442", "#8a8f98"};
  return {colors[i % colors.size()]};
}

}  // namespace kinetri::app
