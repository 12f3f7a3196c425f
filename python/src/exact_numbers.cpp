// SPDX-License-Identifier: GPL-3.0-or-later
#include "exact_numbers.h"

#include <cmath>
#include <ios>
#include <string>

namespace kinetri::python {

// Integers are converted by hexadecimal digits, whose number Python does not limit.
py::object python_integer(const Integer& value) {
  const std::string digits =
      (value < 0 ? "-" : "") + abs(value).str(0, std::ios_base::hex | std::ios_base::showbase);
  return py::reinterpret_steal<py::object>(PyLong_FromString(digits.c_str(), nullptr, 0));
}

Integer integer_of(py::handle value) {
  const py::int_ number(py::reinterpret_borrow<py::object>(value));
  std::string digits = py::cast<std::string>(py::str("{:#x}").format(number));
  const bool is_negative = digits.front() == '-';
  if (is_negative) digits.erase(0, 1);
  const Integer result(digits);
  return is_negative ? -result : result;
}

Rational rational_of(py::handle value) {
  return Rational(integer_of(value.attr("numerator")), integer_of(value.attr("denominator")));
}

py::object fraction(const Rational& value) {
  return py::module_::import("fractions")
      .attr("Fraction")(python_integer(numerator(value)), python_integer(denominator(value)));
}

bool is_fraction(py::handle value) {
  return py::hasattr(value, "numerator") && py::hasattr(value, "denominator");
}

std::optional<double> not_finite(py::handle value) {
  if (PyFloat_Check(value.ptr()) != 0) {
    const double number = PyFloat_AS_DOUBLE(value.ptr());
    return std::isfinite(number) ? std::nullopt : std::optional(number);
  }
  if (is_fraction(value) || !py::hasattr(value, "as_integer_ratio")) return std::nullopt;
  const double rounded = py::cast<py::float_>(value);
  if (std::isfinite(rounded)) return std::nullopt;
  // A finite number may be beyond the range of binary64.
  if (std::isnan(rounded) || value.equal(py::float_(rounded))) return rounded;
  return std::nullopt;
}

std::optional<Rational> exact_rational(py::handle value) {
  if (PyFloat_Check(value.ptr()) != 0) return to_rational(PyFloat_AS_DOUBLE(value.ptr()));
  if (is_fraction(value)) return rational_of(value);
  // NumPy's other scalars have as_integer_ratio().
  if (!py::hasattr(value, "as_integer_ratio")) return std::nullopt;
  const auto ratio = py::cast<py::tuple>(value.attr("as_integer_ratio")());
  return Rational(integer_of(ratio[0]), integer_of(ratio[1]));
}

std::string representation_of(py::handle value) {
  return py::cast<std::string>(py::repr(value));
}

}  // namespace kinetri::python
