// SPDX-License-Identifier: GPL-3.0-or-later
//
// The program kinetri-video.
#include "cli/run_program.h"
#include "video/program/commands.h"

int main(int argc, char** argv) {
  return kinetri::app::run_program(kinetri::video::program, argc, argv);
}
