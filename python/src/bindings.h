// SPDX-License-Identifier: GPL-3.0-or-later
//
// The parts of the extension module, one function and one source each.
#ifndef KINETRI_PYTHON_BINDINGS_H
#define KINETRI_PYTHON_BINDINGS_H

#include <pybind11/pybind11.h>

#include <optional>
#include <string_view>

#include "gil_release.h"
#include "kinetri/algebra/algebraic_number.h"

namespace kinetri::python {

namespace py = pybind11;

void bind_errors(py::module_& module);
void bind_time(py::module_& module);
void bind_sturm(py::module_& module);
void bind_events(py::module_& module);
void bind_contacts(py::module_& module);
void bind_engine(py::module_& module);
void bind_files(py::module_& module);

/// A text of the library, which may contain bytes of a file: bytes that are not UTF-8 are escaped,
/// as in Python's names of files.
inline py::object text_of(std::string_view bytes) {
  PyObject* const text =
      PyUnicode_DecodeUTF8(bytes.data(), static_cast<Py_ssize_t>(bytes.size()), "surrogateescape");
  if (text == nullptr) throw py::error_already_set();
  return py::reinterpret_steal<py::object>(text);
}

/// Calls the function without the GIL.
template <class Function>
auto without_gil(const Function& function) {
  const Gil_release no_gil;
  return function();
}

/// The exact number of a Time, an int, a float or a fractions.Fraction; none for other objects.
/// Throws Precondition_error for an infinity or a NaN.
std::optional<Algebraic_number> exact_number(py::handle value);

/// The same, but throws TypeError if there is none.
Algebraic_number time_of(py::handle value);

}  // namespace kinetri::python

#endif  // KINETRI_PYTHON_BINDINGS_H
