// SPDX-License-Identifier: GPL-3.0-or-later
//
// The extension module kinetri._kinetri, used by kinetri's Python code. Not for users.
#include <pybind11/pybind11.h>

#include "bindings.h"
#include "kinetri/version.h"

PYBIND11_MODULE(_kinetri, module) {
  using namespace kinetri::python;
  module.doc() = "Kinetri's engine. Use the package kinetri.";
  module.attr("__version__") = kinetri::version;
  bind_errors(module);
  bind_time(module);
  bind_sturm(module);
  bind_events(module);
  bind_contacts(module);
  bind_engine(module);
  bind_files(module);
}
