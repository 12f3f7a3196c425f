// SPDX-License-Identifier: GPL-3.0-or-later
//
// The colors of kinds: legible on the page, light and dark, and different from each other for every
// kind of color vision, by published formulas.
#include "kinetri/events/event.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace kinetri::event_color_test {
namespace {

using Triple = std::array<double, 3>;
using Matrix = std::array<Triple, 3>;

Triple product(const Matrix& matrix, const Triple& v) {
  Triple result = {};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) result[i] += matrix[i][k] * v[k];
  }
  return result;
}

// Linear red, green and blue of `#rrggbb` (IEC 61966-2-1).
Triple linear(std::string_view color) {
  Triple result = {};
  for (std::size_t i = 0; i < 3; ++i) {
    const double c = std::stoi(std::string(color.substr(1 + 2 * i, 2)), nullptr, 16) / 255.0;
    result[i] = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  }
  return result;
}

double luminance(std::string_view color) {
  const Triple c = linear(color);
  return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
}

// WCAG 2.2.
double contrast(std::string_view a, std::string_view b) {
  const auto [darker, lighter] = std::minmax({luminance(a), luminance(b)});
  return (lighter + 0.05) / (darker + 0.05);
}

// Normal vision, and without the cones for long, middle and short waves, by Machado, Oliveira and
// Fernandes (A physiologically-based model for simulation of color vision deficiency, 2009).
const std::array<std::pair<const char*, Matrix>, 4> visions = {
    {{"normal vision", {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}},
     {"protanopia",
      {{{0.152286, 1.052583, -0.204868},
        {0.114503, 0.786281, 0.099216},
        {-0.003882, -0.048116, 1.051998}}}},
     {"deuteranopia",
      {{{0.367322, 0.860646, -0.227968},
        {0.280085, 0.672501, 0.047413},
        {-0.011820, 0.042940, 0.968881}}}},
     {"tritanopia",
      {{{1.255528, -0.076749, -0.178779},
        {-0.078411, 0.930809, 0.147602},
        {0.004733, 0.691367, 0.303900}}}}}};

// Oklab (Ottosson, 2020), in which equal distances look about equal.
Triple oklab(Triple color) {
  for (double& c : color) c = std::clamp(c, 0.0, 1.0);
  Triple cones = product({{{0.4122214708, 0.5363325363, 0.0514459929},
                           {0.2119034982, 0.6806995451, 0.1073969566},
                           {0.0883024619, 0.2817188376, 0.6299787005}}},
                         color);
  for (double& c : cones) c = std::cbrt(c);
  return product({{{0.2104542553, 0.7936177850, -0.0040720468},
                   {1.9779984951, -2.4285922050, 0.4505937099},
                   {0.0259040371, 0.7827717662, -0.8086757660}}},
                 cones);
}

std::vector<Event_kind> all_kinds() {
  std::vector<Event_kind> result;
  for (std::size_t i = 0; i < event_kinds; ++i) result.push_back(static_cast<Event_kind>(i));
  return result;
}

TEST(Event_color, is_legible_on_the_page_light_and_dark) {
  for (const Event_kind kind : all_kinds()) {
    ASSERT_EQ(color(kind).size(), 7U);
    // Page and surface of viewer/style.css.
    for (const char* background : {"#ffffff", "#f6f7f9", "#191f27", "#12161c"}) {
      EXPECT_GE(contrast(color(kind), background), 3) << name(kind) << " on " << background;
    }
  }
}

// 0.02 is about the least difference that is seen of large fields side by side.
TEST(Event_color, differs_from_all_others_for_every_color_vision) {
  for (const auto& [vision, matrix] : visions) {
    for (const Event_kind a : all_kinds()) {
      for (const Event_kind b : all_kinds()) {
        if (a >= b) continue;
        const Triple p = oklab(product(matrix, linear(color(a))));
        const Triple q = oklab(product(matrix, linear(color(b))));
        EXPECT_GE(std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]), 0.055)
            << name(a) << " and " << name(b) << ", " << vision;
      }
    }
  }
}

}  // namespace
}  // namespace kinetri::event_color_test
