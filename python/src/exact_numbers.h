// SPDX-License-Identifier: GPL-3.0-or-later
//
// Exact numbers of the library as Python's, and the other way round.
#ifndef KINETRI_PYTHON_EXACT_NUMBERS_H
#define KINETRI_PYTHON_EXACT_NUMBERS_H

#include <pybind11/pybind11.h>

#include <optional>
#include <string>

#include "kinetri/algebra/number_types.h"

namespace kinetri::python {

namespace py = pybind11;

/// The int that the integer is.
py::object python_integer(const Integer& value);

/// The integer that an int, or another integer of Python, is.
Integer integer_of(py::handle value);

/// The number that an object with a numerator and a denominator is.
Rational rational_of(py::handle value);

/// The fractions.Fraction that the number is.
py::object fraction(const Rational& value);

/// Whether the object has a numerator and a denominator, as ints and fractions have.
bool is_fraction(py::handle value);

/// The infinity or NaN that the value is, if it is one: a float, or a scalar of NumPy.
std::optional<double> not_finite(py::handle value);

/// The exact number: of an int, a float, a fractions.Fraction, or another scalar that knows the
/// integer ratio that it is. None of anything else. Precondition: it is finite.
std::optional<Rational> exact_rational(py::handle value);

/// What Python says of the object, for messages.
std::string representation_of(py::handle value);

}  // namespace kinetri::python

#endif  // KINETRI_PYTHON_EXACT_NUMBERS_H
