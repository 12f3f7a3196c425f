// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/run_program.h"

#include <exception>
#include <ios>
#include <new>
#include <string>

#include "cli/arguments.h"
#include "cli/command_line.h"
#include "cli/help.h"
#include "cli/interrupt.h"
#include "cli/terminal.h"
#include "cli/text.h"
#include "kinetri/base/error.h"
#include "kinetri/impl/io/output_file.h"
#include "kinetri/impl/io/text.h"
#include "kinetri/version.h"

namespace kinetri::app {
namespace {

Exit_code print(const std::string& text) {
  Output_file output("-");
  output.stream() << text;
  output.commit();
  return Exit_code::done;
}

Exit_code report_usage(const Invocation& invocation, const std::string& problem) {
  report(invocation.name, problem);
  print_error(joined("Run '", invocation.name, " --help' for what is possible.\n"));
  return Exit_code::bad_input;
}

// Precondition: the message begins with the name of the file.
Exit_code report_file(const std::string& message) {
  const std::size_t colon = message.find(": ");
  report(message.substr(0, colon), message.substr(colon + 2));
  return Exit_code::bad_input;
}

Exit_code report_failure(const Command& program, Exit_code code, const std::string& message) {
  report(program.name, message);
  return code;
}

Exit_code run(const Command& all, int argc, char** argv) {
  const Invocation invocation = parse(all, argc, argv);
  switch (invocation.request) {
    case Invocation::Request::help:
      return print(help_text(*invocation.command, invocation.name));
    case Invocation::Request::version:
      return print(joined(all.name, " ", version, "\n"));
    case Invocation::Request::nothing:
      return report_usage(invocation, invocation.problem);
    case Invocation::Request::run:
      break;
  }
  try {
    return invocation.command->run(all);
  } catch (const Usage_error& error) {
    return report_usage(invocation, error.what());
  }
}

Exit_code guarded_run(const Command& program, int argc, char** argv) {
  try {
    return run(program, argc, argv);
  } catch (const Input_error& error) {
    return report_file(error.what());
  } catch (const Unread_output_error&) {
    // As in `kinetri ... | head`: the reader needs no more.
    end_by_closed_pipe();
  } catch (const Output_error& error) {
    return report_file(error.what());
  } catch (const Run_error& error) {
    return report_failure(program, Exit_code::bad_input, error.what());
  } catch (const std::bad_alloc&) {
    return report_failure(program, Exit_code::bad_input,
                          "there is not enough memory; expected fewer points, or more memory");
  } catch (const Internal_error& error) {
    return report_failure(program, Exit_code::internal_error, error.what());
  } catch (const std::exception& error) {
    return report_failure(program, Exit_code::internal_error,
                          joined("unexpected error: ", error.what(),
                                 "; please report this with the input that caused it"));
  }
}

}  // namespace

int run_program(Command (*make_program)(), int argc, char** argv) {
  occupy_closed_streams();
  // If synchronized with C's stdin, std::cin reports a failure to read as the end of the file.
  std::ios::sync_with_stdio(false);
  static const Command program = make_program();
  install_signal_handlers(program.name);
  return static_cast<int>(guarded_run(program, argc, argv));
}

}  // namespace kinetri::app
