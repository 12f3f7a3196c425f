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
#include "kinetri/events/event.h"

namespace kinetri::python {
namespace {

// The fields of Event_row, or Periodic_event_row, for NumPy.
py::dict event_fields(bool is_periodic) {
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
  if (is_periodic) {
    static_assert(offsetof(Periodic_event_row, event) == 0);
    const py::object offset = py::make_tuple("i4", py::make_tuple(2));
    add("removed_offset", offset, offsetof(Periodic_event_row, removed_offset));
    add("added_offset", offset, offsetof(Periodic_event_row, added_offset));
  }
  py::dict result;
  result["names"] = names;
  result["formats"] = formats;
  result["offsets"] = offsets;
  result["itemsize"] = is_periodic ? sizeof(Periodic_event_row) : sizeof(Event_row);
  return result;
}

py::object edge(const std::optional<Edge_ids>& ids) {
  if (!ids) return py::none();
  return py::make_tuple((*ids)[0], (*ids)[1]);
}

py::object offset(const std::optional<Edge_ids>& ids, const Lattice_offset_2& offset) {
  if (!ids) return py::none();
  return py::make_tuple(offset.x, offset.y);
}

py::tuple points(const Event& event) {
  if (event.point_a && event.point_b) return py::make_tuple(*event.point_a, *event.point_b);
  if (event.point_a) return py::make_tuple(*event.point_a);
  return py::tuple();
}

std::string event_representation(const Event& event) {
  py::list parts;
  const auto add = [&](const std::string& name, const py::object& value) {
    parts.append(py::str(", {}={}").format(name, py::repr(value)));
  };
  add("time", py::cast(event.time));
  const auto add_edge = [&](const std::string& name, const std::optional<Edge_ids>& ids,
                            const Lattice_offset_2& by) {
    if (ids) add(name, edge(ids));
    if (by != Lattice_offset_2()) add(name + "_offset", offset(ids, by));
  };
  add_edge("removed", event.removed, event.removed_offset);
  add_edge("added", event.added, event.added_offset);
  if (event.point_a) add("points", points(event));
  return "<Event " + std::string(name(event.kind)) +
         py::cast<std::string>(py::str("").attr("join")(parts)) + ">";
}

template <class Row>
void bind_table(py::module_& module, const char* name) {
  using Table = Event_table<Row>;
  py::class_<Table, Event_observer>(module, name)
      .def(py::init<const typename Table::Kinds&>())
      .def("take", [](Table& table, const py::dtype& dtype) {
        auto rows = std::make_unique<std::vector<Row>>(table.take());
        const py::capsule owner(
            rows.get(), [](void* vector) { delete static_cast<std::vector<Row>*>(vector); });
        const auto* const held = rows.release();
        return py::array(dtype, {static_cast<py::ssize_t>(held->size())},
                         {static_cast<py::ssize_t>(sizeof(Row))}, held->data(), owner);
      });
}

}  // namespace

void bind_events(py::module_& module) {
  module.attr("event_fields") = event_fields(false);
  module.attr("periodic_event_fields") = event_fields(true);
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
      .def_property_readonly(
          "removed_offset",
          [](const Event& event) { return offset(event.removed, event.removed_offset); },
          "tuple of two int, or None: in a periodic box, which image of the second end is meant.")
      .def_property_readonly(
          "added_offset",
          [](const Event& event) { return offset(event.added, event.added_offset); },
          "tuple of two int, or None: in a periodic box, which image of the second end is meant.")
      .def_property_readonly("points", &points, "tuple of ids: the points concerned, if any.")
      .def("__repr__", event_representation);

  py::class_<Event_observer>(module, "Observer");
  bind_table<Event_row>(module, "EventTable");
  bind_table<Periodic_event_row>(module, "PeriodicEventTable");
  py::class_<Event_list, Event_observer>(module, "EventList")
      .def(py::init<>())
      .def("take", &Event_list::take);
}

}  // namespace kinetri::python
