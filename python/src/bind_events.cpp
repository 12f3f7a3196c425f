// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "bindings.h"
#include "event_table.h"
#include "kinetri/events/event_color.h"

namespace kinetri::python {
namespace {

// The fields of Event_row for NumPy.
py::dict event_fields() {
  py::list names;
  py::list formats;
  py::list offsets;
  const auto add = [&](const char* name, const py::object& format, std::size_t offset) {
    names.append(name);
    formats.append(format);
    offsets.append(offset);
  };
  const py::object pair = py::make_tuple("u4", py::make_tuple(2));
  add("kind", py::str("U" + std::to_string(std::tuple_size_v<Kind_text>)),
      offsetof(Event_row, kind));
  add("time", py::str("f8"), offsetof(Event_row, time));
  add("time_lo", py::str("f8"), offsetof(Event_row, time_lo));
  add("time_hi", py::str("f8"), offsetof(Event_row, time_hi));
  add("removed", pair, offsetof(Event_row, removed));
  add("added", pair, offsetof(Event_row, added));
  add("points", pair, offsetof(Event_row, points));
  py::dict result;
  result["names"] = names;
  result["formats"] = formats;
  result["offsets"] = offsets;
  result["itemsize"] = sizeof(Event_row);
  return result;
}

py::object edge(const std::optional<Edge_ids>& ids) {
  if (!ids) return py::none();
  return py::make_tuple((*ids)[0], (*ids)[1]);
}

py::tuple points(const Event& event) {
  if (event.point_a && event.point_b) return py::make_tuple(*event.point_a, *event.point_b);
  if (event.point_a) return py::make_tuple(*event.point_a);
  return py::tuple();
}

std::string event_representation(const Event& event) {
  py::list parts;
  const auto add = [&](const char* name, const py::object& value) {
    parts.append(py::str(", {}={}").format(name, py::repr(value)));
  };
  add("time", py::cast(event.time));
  if (event.removed) add("removed", edge(event.removed));
  if (event.added) add("added", edge(event.added));
  if (event.point_a) add("points", points(event));
  return "<Event " + std::string(name(event.kind)) +
         py::cast<std::string>(py::str("").attr("join")(parts)) + ">";
}

}  // namespace

void bind_events(py::module_& module) {
  module.attr("event_fields") = event_fields();
  module.attr("event_kinds") = [] {
    py::list kinds;
    for (std::size_t i = 0; i < event_kinds; ++i) {
      kinds.append(std::string(name(static_cast<Event_kind>(i))));
    }
    return py::tuple(kinds);
  }();
  module.attr("event_colors") = [] {
    py::dict colors;
    for (std::size_t i = 0; i < event_kinds; ++i) {
      const auto kind = static_cast<Event_kind>(i);
      colors[py::str(std::string(name(kind)))] = std::string(color(kind));
    }
    return colors;
  }();

  py::class_<Event>(module, "Event", py::is_final(), "An event at an exact time.")
      .def_property_readonly(
          "number", [](const Event& event) { return event.number; },
          "int: the number of the event in the run, from 0 on.")
      .def_property_readonly(
          "kind", [](const Event& event) { return std::string(name(event.kind)); },
          "str: 'flip', 'hull_insert', ...; see `kinetri.event_kinds`.")
      .def_property_readonly(
          "time", [](const Event& event) { return event.time; }, "Time: when, exactly.")
      .def_property_readonly(
          "removed", [](const Event& event) { return edge(event.removed); },
          "tuple of two ids, or None: the removed edge, the smaller id first.")
      .def_property_readonly(
          "added", [](const Event& event) { return edge(event.added); },
          "tuple of two ids, or None: the added edge, the smaller id first.")
      .def_property_readonly("points", &points, "tuple of ids: the points concerned, if any.")
      .def("__repr__", event_representation);

  py::class_<Event_observer>(module, "Observer");
  py::class_<Event_table, Event_observer>(module, "EventTable")
      .def(py::init<const Event_table::Kinds&>())
      .def("take", [](Event_table& table, const py::dtype& dtype) {
        auto rows = std::make_unique<std::vector<Event_row>>(table.take());
        const py::capsule owner(
            rows.get(), [](void* vector) { delete static_cast<std::vector<Event_row>*>(vector); });
        const auto* const held = rows.release();
        return py::array(dtype, {static_cast<py::ssize_t>(held->size())},
                         {static_cast<py::ssize_t>(sizeof(Event_row))}, held->data(), owner);
      });
  py::class_<Event_list, Event_observer>(module, "EventList")
      .def(py::init<>())
      .def("take", &Event_list::take);
}

}  // namespace kinetri::python
