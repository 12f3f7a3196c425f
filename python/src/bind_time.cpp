// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/operators.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cmath>
#include <compare>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bindings.h"
#include "exact_numbers.h"
#include "kinetri/algebra/algebraic_number.h"
#include "kinetri/base/error.h"

namespace kinetri::python {
namespace {

// The order of a time and another number; unordered for a NaN; none if `other` is not a number.
std::optional<std::partial_ordering> order(const Algebraic_number& time, py::handle other) {
  if (const std::optional<double> value = not_finite(other)) {
    if (std::isnan(*value)) return std::partial_ordering::unordered;
    return *value > 0 ? std::partial_ordering::less : std::partial_ordering::greater;
  }
  const std::optional<Algebraic_number> number = exact_number(other);
  if (!number) return std::nullopt;
  return time <=> *number;
}

template <class Decide>
auto comparison(const Decide& decide) {
  return [decide](const Algebraic_number& time, py::handle other) -> py::object {
    const auto result = order(time, other);
    if (!result) return py::reinterpret_borrow<py::object>(Py_NotImplemented);
    return py::bool_(decide(*result));
  };
}

std::string text(double value) {
  return py::cast<std::string>(py::repr(py::float_(value)));
}

std::string representation(const Algebraic_number& time) {
  const auto [lower, upper] = time.tight_interval();
  if (lower == upper) return "Time(" + text(lower) + ")";
  return "<Time between " + text(lower) + " and " + text(upper) + ">";
}

// The number as a rational one, if it is. A root p / q of a polynomial has a q that divides the
// leading coefficient, and two such numbers are at least 1 / |coefficient| apart.
std::optional<Rational> rational_value(const Algebraic_number& time) {
  if (time.is_known_rational()) return time.rational();
  const Integer leading = abs(time.polynomial().leading_coefficient());
  time.refine_to(Rational(1, 2 * leading));
  const auto [lower, upper] = time.isolating_interval();
  const Rational scaled = (lower + upper) / 2 * leading;
  // The integer nearest to it.
  const Rational shifted = scaled + Rational(1, 2);
  Integer nearest = numerator(shifted) / denominator(shifted);
  if (nearest > shifted) --nearest;
  const Rational candidate(nearest, leading);
  if (time == Algebraic_number(candidate)) return candidate;
  return std::nullopt;
}

// The state of a number for pickle.
py::tuple state(const Algebraic_number& time) {
  const auto [lower, upper] = time.isolating_interval();
  py::list coefficients;
  if (lower != upper) {
    const Polynomial polynomial = time.polynomial();
    for (const Integer& c : polynomial.coefficients()) coefficients.append(python_integer(c));
  }
  return py::make_tuple(coefficients, fraction(lower), fraction(upper));
}

Algebraic_number restored(const py::tuple& state) {
  const auto coefficients = py::cast<py::list>(state[0]);
  if (coefficients.empty()) return Algebraic_number(rational_of(state[1]));
  std::vector<Integer> numbers;
  for (const py::handle coefficient : coefficients) numbers.push_back(integer_of(coefficient));
  return {Polynomial(std::move(numbers)), rational_of(state[1]), rational_of(state[2])};
}

}  // namespace

std::optional<Algebraic_number> exact_number(py::handle value) {
  if (py::isinstance<Algebraic_number>(value)) return py::cast<Algebraic_number>(value);
  // NumPy's binary64 scalar is a float.
  if (PyFloat_Check(value.ptr()) != 0) return Algebraic_number(PyFloat_AS_DOUBLE(value.ptr()));
  if (const auto number = not_finite(value)) return Algebraic_number(*number);  // throws
  if (const auto number = exact_rational(value)) return Algebraic_number(*number);
  return std::nullopt;
}

Algebraic_number time_of(py::handle value) {
  if (auto result = exact_number(value)) return *std::move(result);
  throw Precondition_error("a time is " + representation_of(value) +
                           "; expected a float, an int, a fractions.Fraction or a kinetri.Time");
}

void bind_time(py::module_& module) {
  py::class_<Algebraic_number>(module, "Time", py::is_final(), R"(An exact time.

Times of events are roots of polynomials, and are kept as such. They are compared exactly with one
another and with floats, ints and fractions. ``float(time)`` is the nearest binary64 number.

Parameters
----------
value : float, int, fractions.Fraction or Time
    Taken exactly.

Raises
------
PreconditionError
    If the value is infinite or not a number.

Examples
--------
>>> import kinetri
>>> kinetri.Time(0.5) < 1, float(kinetri.Time(3))
(True, 3.0)
)")
      .def(py::init([](py::handle value) { return time_of(value); }), py::arg("value"))
      .def("__float__", &Algebraic_number::to_double)
      .def_property_readonly(
          "lower", [](const Algebraic_number& time) { return time.tight_interval().lower; },
          "float: the greatest binary64 number that is not above the time.")
      .def_property_readonly(
          "upper", [](const Algebraic_number& time) { return time.tight_interval().upper; },
          "float: the least binary64 number that is not below the time.")
      .def_property_readonly(
          "fraction",
          [](const Algebraic_number& time) -> py::object {
            const std::optional<Rational> value = rational_value(time);
            return value ? fraction(*value) : py::none();
          },
          "fractions.Fraction or None: the time, if it is a rational number.")
      .def("__lt__", comparison([](std::partial_ordering o) { return o < 0; }))
      .def("__le__", comparison([](std::partial_ordering o) { return o <= 0; }))
      .def("__gt__", comparison([](std::partial_ordering o) { return o > 0; }))
      .def("__ge__", comparison([](std::partial_ordering o) { return o >= 0; }))
      .def("__eq__", comparison([](std::partial_ordering o) { return o == 0; }))
      .def("__ne__", comparison([](std::partial_ordering o) { return o != 0; }))
      // Equal to the hash of an equal int, float or Fraction.
      .def("__hash__",
           [](const Algebraic_number& time) {
             const std::optional<Rational> value = rational_value(time);
             return py::hash(value ? fraction(*value) : py::float_(time.to_double()));
           })
      .def("__repr__", representation)
      .def(py::pickle([](const Algebraic_number& time) { return state(time); },
                      [](const py::tuple& kept) { return restored(kept); }));
}

}  // namespace kinetri::python
