// SPDX-License-Identifier: GPL-3.0-or-later
//
// The manual page of the program.
#ifndef KINETRI_APPS_MANUAL_H
#define KINETRI_APPS_MANUAL_H

#include <iosfwd>

#include "cli/command.h"

namespace kinetri::app {

/// Writes the manual page in roff.
void write_manual(std::ostream& out, const Command& program);

}  // namespace kinetri::app

#endif  // KINETRI_APPS_MANUAL_H
