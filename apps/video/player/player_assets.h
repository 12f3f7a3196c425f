// SPDX-License-Identifier: GPL-3.0-or-later
//
// The embedded files of the player page.
#ifndef KINETRI_VIDEO_PLAYER_PLAYER_ASSETS_H
#define KINETRI_VIDEO_PLAYER_PLAYER_ASSETS_H

#include <string_view>

namespace kinetri::video {

extern const std::string_view player_page;    // player.html without its end
extern const std::string_view player_script;  // player.js

}  // namespace kinetri::video

#endif  // KINETRI_VIDEO_PLAYER_PLAYER_ASSETS_H
