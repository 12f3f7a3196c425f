// SPDX-License-Identifier: GPL-3.0-or-later
//
// Standard streams: whether they are terminals, colors, closed pipes.
#ifndef KINETRI_APPS_TERMINAL_H
#define KINETRI_APPS_TERMINAL_H

#include <string>
#include <string_view>

namespace kinetri::app {

enum class Stream { output, error };

/// Opens closed standard streams, so that no file that is opened later gets the descriptor, and the
/// output, of one. Reading and writing them still fails. Must be called before any file is opened.
void occupy_closed_streams();

/// Whether the standard stream is a terminal.
bool is_terminal(Stream stream);

/// Whether colors may be written to the standard stream: it is a terminal other than a "dumb" one,
/// and the environment variable NO_COLOR is not set, or empty.
bool has_colors(Stream stream);

/// @{
/// The text in the color of a heading or of an error if the stream has colors; else unchanged.
std::string heading(std::string_view text, Stream stream);
std::string alarm(std::string_view text, Stream stream);
/// @}

/// Writes `where: what` as a line to standard error.
void report(std::string_view where, std::string_view what);

/// Ends the process as writing to a closed pipe does by default: silently, by the signal SIGPIPE,
/// which a shell shows as exit code 141.
[[noreturn]] void end_by_closed_pipe();

}  // namespace kinetri::app

#endif  // KINETRI_APPS_TERMINAL_H
