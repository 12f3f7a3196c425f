// SPDX-License-Identifier: GPL-3.0-or-later
#include "response.h"

#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>

#include "bindings.h"
#include "kinetri/base/error.h"

namespace kinetri::python {
namespace {

using Pair = std::array<double, 2>;

std::optional<Vector_2> velocity(const py::object& value) {
  if (value.is_none()) return std::nullopt;
  const auto [x, y] = py::cast<Pair>(value);
  return Vector_2{x, y};
}

Contact_response_2 called(const py::object& function, const Contact_2& contact) {
  // The contact refers to the present state: it must not be used after the call.
  const py::object argument = py::cast(contact);
  struct Closing {
    Contact_2& contact;
    ~Closing() { contact.would_approach = nullptr; }
  } closing = {py::cast<Contact_2&>(argument)};
  const auto result = py::cast<py::tuple>(function(argument));
  return {velocity(result[0]),       velocity(result[1]),       py::cast<bool>(result[2]),
          py::cast<bool>(result[3]), py::cast<bool>(result[4]), py::cast<bool>(result[5])};
}

// A reference that any thread may drop.
std::shared_ptr<py::object> shared(const py::object& object) {
  return {new py::object(object), [](py::object* held) {
            const py::gil_scoped_acquire gil;
            delete held;
          }};
}

Pair pair(const Vector_2& vector) {
  return {vector.x, vector.y};
}

}  // namespace

Collision_response response_of(const py::object& response, const Interrupt_flag& flag) {
  if (response.is_none()) return nullptr;
  if (py::isinstance<py::str>(response)) {
    const auto name = py::cast<std::string>(response);
    std::string names;
    for (const Named_response& named : named_responses) {
      if (named.name == name) return named.response;
      names += (names.empty() ? "'" : ", '") + std::string(named.name) + "'";
    }
    throw Precondition_error("collisions is '" + name + "'; expected " + names +
                             ", None or a function");
  }
  return [function = shared(response), flag](const Contact_2& contact) {
    const py::gil_scoped_acquire gil;
    try {
      return called(*function, contact);
    } catch (const py::error_already_set& error) {
      if (!error.matches(PyExc_KeyboardInterrupt)) throw;
    }
    flag->store(true);
    return called(*function, contact);
  };
}

void bind_contacts(py::module_& module) {
  py::class_<Contact_2>(module, "Contact", py::is_final(),
                        R"(Two discs that touch while they approach each other.

The argument of a response. All numbers are rounded to binary64; the contact itself was decided
exactly. A contact is valid only while its response runs.
)")
      .def_readonly("time", &Contact_2::time, "float: time of the contact.")
      .def_property_readonly(
          "ids", [](const Contact_2& c) { return std::pair(c.point_a, c.point_b); },
          "tuple of two ids: point a and point b, the smaller id first.")
      .def_property_readonly(
          "separation", [](const Contact_2& c) { return pair(c.separation); },
          "[float, float]: center of b minus center of a; may be rounded to zero.")
      .def_property_readonly(
          "velocity_a", [](const Contact_2& c) { return pair(c.velocity_a); },
          "[float, float]: of a, just before the contact.")
      .def_property_readonly(
          "velocity_b", [](const Contact_2& c) { return pair(c.velocity_b); },
          "[float, float]: of b, just before the contact.")
      .def_readonly("mass_a", &Contact_2::mass_a, "float: of a.")
      .def_readonly("mass_b", &Contact_2::mass_b, "float: of b.")
      .def_readonly("growth_a", &Contact_2::growth_a,
                    "float: growth of the radius of a per unit of time.")
      .def_readonly("growth_b", &Contact_2::growth_b,
                    "float: growth of the radius of b per unit of time.")
      .def_readonly("is_pressed", &Contact_2::is_pressed,
                    "bool: whether they accelerate, but have no speed, toward each other, "
                    "so that no exchange of velocities separates them.")
      .def(
          "would_approach",
          [](const Contact_2& c, const Pair& a, const Pair& b) {
            if (!c.would_approach) {
              throw Precondition_error(
                  "the contact is over; expected a call while its response runs");
            }
            return c.would_approach({a[0], a[1]}, {b[0], b[1]});
          },
          py::arg("velocity_a"), py::arg("velocity_b"),
          "Whether the two would approach each other with these velocities, decided exactly.");
  module.def(
      "respond",
      [](const std::string& name, const Contact_2& contact) {
        const auto* const found = std::ranges::find(named_responses, name, &Named_response::name);
        if (found == named_responses.end() || found->response == nullptr) {
          throw Precondition_error("name is '" + name +
                                   "'; expected 'log', 'swap', 'elastic', 'stop' or 'remove'");
        }
        const Contact_response_2 result = found->response(contact);
        const auto optional_pair = [](const std::optional<Vector_2>& v) {
          return v ? std::optional(pair(*v)) : std::nullopt;
        };
        return py::make_tuple(optional_pair(result.velocity_a), optional_pair(result.velocity_b),
                              result.erases_a, result.erases_b, result.stops_a, result.stops_b);
      },
      py::arg("name"), py::arg("contact"));
}

}  // namespace kinetri::python
