// SPDX-License-Identifier: GPL-3.0-or-later
//
// Converts exact numbers between the library and Python.
#ifndef KINETRI_PYTHON_EXACT_NUMBERS_H
#define KINETRI_PYTHON_EXACT_NUMBERS_H

#include <pybind11/pybind11.h>

#include <optional>
#include <string>

#include "kinetri/algebra/number_types.h"

namespace kinetri::python {

namespace py = pybind11;

/// The integer as an int.
py::object python_integer(const Integer& value);

/// The integer of an int, or another integer of Python.
Integer integer_of(py::handle value);

/// The number of an object with a numerator and a denominator.
Rational rational_of(py::handle value);

/// The number as a fractions.Fraction.
py::object fraction(const Rational& value);

/// Whether the object has a numerator and a denominator, as ints and fractions have.
bool is_fraction(py::handle value);

/// The value of a float or a scalar of NumPy, if it is an infinity or a NaN.
std::optional<double> not_finite(py::handle value);

/// The exact number of an int, a float, a fractions.Fraction, or another scalar with
/// as_integer_ratio(); none for other objects. Precondition: it is finite.
std::optional<Rational> exact_rational(py::handle value);

/// repr() of the object, for messages.
std::string representation_of(py::handle value);

}  // namespace kinetri::python

#endif  // KINETRI_PYTHON_EXACT_NUMBERS_H
