// SPDX-License-Identifier: GPL-3.0-or-later
//
// Parses command lines. Only the source of this header includes CLI11, which is slow to compile.
#ifndef KINETRI_APPS_COMMAND_LINE_H
#define KINETRI_APPS_COMMAND_LINE_H

#include <string>

#include "cli/command.h"

namespace kinetri::app {

/// What a command line asks for.
struct Invocation {
  enum class Request { run, help, version, nothing };

  const Command* command;  ///< the one that is named, or the program
  std::string name;        ///< in full: `kinetri generate uniform`
  Request request = Request::nothing;
  std::string problem = {};  ///< why the command line cannot be used, if the request is nothing
};

/// Parses a command line, and stores the values of the options in their targets.
Invocation parse(const Command& program, int argc, const char* const* argv);

}  // namespace kinetri::app

#endif  // KINETRI_APPS_COMMAND_LINE_H
