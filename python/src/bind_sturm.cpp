// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bindings.h"
#include "exact_numbers.h"
#include "kinetri/algebra/real_roots.h"
#include "kinetri/algebra/sturm_sequence.h"
#include "kinetri/base/error.h"

namespace kinetri::python {
namespace {

Rational coefficient(std::size_t power, py::handle value) {
  const std::string begin =
      "coefficients[" + std::to_string(power) + "] is " + representation_of(value) + "; expected ";
  if (not_finite(value)) throw Precondition_error(begin + "a finite number");
  if (const auto number = exact_rational(value)) return *number;
  throw Precondition_error(begin + "an int, a float or a fractions.Fraction");
}

Sturm_sequence sequence_of(const py::list& values) {
  std::vector<Rational> coefficients;
  for (const py::handle value : values) {
    coefficients.push_back(coefficient(coefficients.size(), value));
  }
  return without_gil([&] {
    const Polynomial polynomial = primitive_polynomial(coefficients);
    if (polynomial.is_zero()) {
      throw Precondition_error(
          "coefficients are all 0; expected a polynomial that is not zero: every number is a root "
          "of "
          "the zero polynomial, and it has no Sturm sequence");
    }
    return Sturm_sequence(polynomial);
  });
}

// A real number or an infinity.
struct Place {
  int infinity = 0;  // -1 or 1: below or above every number
  Algebraic_number value;
};

Place place_of(const char* name, py::handle value) {
  if (const auto number = not_finite(value)) {
    if (!std::isnan(*number)) return {*number < 0 ? -1 : 1, {}};
  } else if (const auto exact = exact_number(value)) {
    return {0, *exact};
  }
  throw Precondition_error(std::string(name) + " is " + representation_of(value) +
                           "; expected a float, an int, a fractions.Fraction or a kinetri.Time");
}

// An interval with rational ends around t that contains no other root, so that signs do not change
// in it except at t. Both ends are t if it is known to be rational.
Rational_interval surroundings(const Sturm_sequence& sequence, const Algebraic_number& t) {
  const int roots = t.is_root_of(sequence.terms().front()) ? 1 : 0;
  for (;; t.refine()) {
    Rational_interval around = t.isolating_interval();
    if (around.is_point()) return around;
    if (sequence.count(Interval_end{around.lower, true}, Interval_end{around.upper, true}) ==
        roots) {
      return around;
    }
  }
}

int sign_changes(const Sturm_sequence& sequence, py::handle value) {
  const Place t = place_of("t", value);
  return without_gil([&] {
    if (t.infinity < 0) return sequence.sign_changes_at_minus_infinity();
    if (t.infinity > 0) return sequence.sign_changes_at_plus_infinity();
    // At a root, V has the value just after it.
    return sequence.sign_changes_at(surroundings(sequence, t.value).upper);
  });
}

py::tuple signs(const Sturm_sequence& sequence, py::handle value) {
  const Place t = place_of("t", value);
  py::list result;
  for (const Polynomial& term : sequence.terms()) {
    const Sign sign = t.infinity < 0   ? term.sign_at_minus_infinity()
                      : t.infinity > 0 ? term.sign_at_plus_infinity()
                                       : sign_at(term, t.value);
    result.append(static_cast<int>(sign));
  }
  return py::tuple(result);
}

Comparison_result compare_places(const Place& a, const Place& b) {
  if (a.infinity != 0 || b.infinity != 0) {
    return static_cast<Comparison_result>((a.infinity > b.infinity) - (a.infinity < b.infinity));
  }
  return compare(a.value, b.value);
}

int count(const Sturm_sequence& sequence, py::handle from, bool includes_from, py::handle to,
          bool includes_to) {
  const Place lower = from.is_none() ? Place{-1, {}} : place_of("lower", from);
  const Place upper = to.is_none() ? Place{1, {}} : place_of("upper", to);
  const Comparison_result order = compare_places(lower, upper);
  if (order == CGAL::LARGER) {
    throw Precondition_error("lower is " + representation_of(from) + " and upper is " +
                             representation_of(to) + "; expected lower <= upper");
  }
  return without_gil([&] {
    if (order == CGAL::EQUAL) {
      const bool is_point = includes_from && includes_to && lower.infinity == 0;
      return is_point && lower.value.is_root_of(sequence.terms().front()) ? 1 : 0;
    }
    if (lower.infinity == 0 && upper.infinity == 0) {
      // Makes the intervals around the two ends disjoint.
      while (lower.value.upper() > upper.value.lower()) {
        lower.value.refine();
        upper.value.refine();
      }
    }
    // If an end is a root, the interval ends just before or just after it.
    const auto end = [&](const Place& place, bool includes_root, bool before) {
      if (place.infinity != 0) return std::optional<Interval_end>();
      const Rational_interval around = surroundings(sequence, place.value);
      if (around.is_point()) return std::optional(Interval_end{around.lower, includes_root});
      return std::optional(Interval_end{before ? around.lower : around.upper, true});
    };
    return sequence.count(end(lower, includes_from, includes_from),
                          end(upper, includes_to, !includes_to));
  });
}

py::tuple terms(const Sturm_sequence& sequence) {
  py::list result;
  for (const Polynomial& term : sequence.terms()) {
    py::list coefficients;
    for (const Integer& c : term.coefficients()) coefficients.append(python_integer(c));
    result.append(py::tuple(coefficients));
  }
  return py::tuple(result);
}

std::vector<std::pair<Algebraic_number, int>> roots(const Sturm_sequence& sequence) {
  return without_gil([&] {
    std::vector<std::pair<Algebraic_number, int>> result;
    for (const Real_root& root : real_roots(sequence.terms().front())) {
      result.emplace_back(root.value, root.multiplicity);
    }
    return result;
  });
}

}  // namespace

void bind_sturm(py::module_& module) {
  py::class_<Sturm_sequence>(module, "Sturm", py::is_final())
      .def(py::init(&sequence_of), py::arg("coefficients"))
      .def("terms", &terms)
      .def("signs", &signs, py::arg("t"))
      .def("sign_changes", &sign_changes, py::arg("t"))
      .def("count", &count, py::arg("lower"), py::arg("includes_lower"), py::arg("upper"),
           py::arg("includes_upper"))
      .def("roots", &roots);
}

}  // namespace kinetri::python
