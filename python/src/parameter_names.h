// SPDX-License-Identifier: GPL-3.0-or-later
//
// Translates the program's options in the library's messages about files to parameters of the
// package's functions.
#ifndef KINETRI_PYTHON_PARAMETER_NAMES_H
#define KINETRI_PYTHON_PARAMETER_NAMES_H

#include <string>
#include <string_view>

namespace kinetri::python {

/// The message with the parameters of Tracks.read in place of the program's options for reading
/// tracks: projection='local' for --projection local, and columns={'t': '1'} for --columns t=1.
/// Quoted parts, which come from a file, are not changed.
std::string with_parameters(std::string_view message);

}  // namespace kinetri::python

#endif  // KINETRI_PYTHON_PARAMETER_NAMES_H
