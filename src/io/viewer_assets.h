// SPDX-License-Identifier: GPL-3.0-or-later
//
// The files of viewer/, which compose the viewer page. The build generates the definitions.
#ifndef KINETRI_IO_VIEWER_ASSETS_H
#define KINETRI_IO_VIEWER_ASSETS_H

#include <span>
#include <string_view>

namespace kinetri::detail {

extern const std::string_view viewer_page;  // with markers for insertions
extern const std::string_view viewer_style;
extern const std::span<const std::string_view> viewer_scripts;  // in their order

// Those of live/. The module is the library as WebAssembly, compressed, as text in pieces; empty if
// it has not been built.
extern const std::string_view live_style;
extern const std::span<const std::string_view> live_scripts;
extern const std::span<const std::string_view> live_module;

}  // namespace kinetri::detail

#endif  // KINETRI_IO_VIEWER_ASSETS_H
