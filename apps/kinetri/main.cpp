// SPDX-License-Identifier: GPL-3.0-or-later
//
// The program kinetri.
#include "cli/run_program.h"
#include "commands/commands.h"

int main(int argc, char** argv) {
  return kinetri::app::run_program(kinetri::app::program, argc, argv);
}
