// SPDX-License-Identifier: GPL-3.0-or-later
//
// From the words of the command line to the command that they name. CLI11, which is all in headers,
// is compiled for this alone.
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

/// Reads a command line. The values of the options stand in their targets afterwards.
Invocation parse(const Command& program, int argc, const char* const* argv);

}  // namespace kinetri::app

#endif  // KINETRI_APPS_COMMAND_LINE_H
