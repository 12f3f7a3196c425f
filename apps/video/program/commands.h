// SPDX-License-Identifier: GPL-3.0-or-later
//
// The commands of the program kinetri-video, one by each function.
#ifndef KINETRI_VIDEO_PROGRAM_COMMANDS_H
#define KINETRI_VIDEO_PROGRAM_COMMANDS_H

#include <string>
#include <string_view>

#include "cli/command.h"
#include "video/formats/frame.h"

namespace kinetri::video {

app::Command encode_command();
app::Command decode_command();
app::Command info_command();
app::Command compare_command();
app::Command play_command();

/// The program with all of them.
app::Command program();

/// A frame rate: a positive whole number, decimal number or ratio, as "25", "23.976" and
/// "30000:1001". Throws Usage_error.
Ratio rate_argument(std::string_view option, std::string_view text);

/// Throws Usage_error if both are the same file, which the output would replace. `argument` names
/// the output.
void check_output(std::string_view argument, const std::string& output, const std::string& input);

}  // namespace kinetri::video

#endif  // KINETRI_VIDEO_PROGRAM_COMMANDS_H
