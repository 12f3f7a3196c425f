// SPDX-License-Identifier: GPL-3.0-or-later
//
// The library's messages about files name the options of the program; those of the package name
// the parameters of its functions.
#ifndef KINETRI_PYTHON_PARAMETER_NAMES_H
#define KINETRI_PYTHON_PARAMETER_NAMES_H

#include <string>
#include <string_view>

namespace kinetri::python {

/// The message with the parameters of Tracks.read in place of the program's options for reading
/// tracks: projection='local' for --projection local, and columns={'t': '1'} for --columns t=1.
/// What is in quotation marks, which comes from a file, stays as it is.
std::string with_parameters(std::string_view message);

}  // namespace kinetri::python

#endif  // KINETRI_PYTHON_PARAMETER_NAMES_H
