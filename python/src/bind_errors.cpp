// SPDX-License-Identifier: GPL-3.0-or-later
//
// Translates the library's exceptions to those of kinetri/errors.py, with their ids and times.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <exception>
#include <string>
#include <string_view>
#include <utility>

#include "bindings.h"
#include "kinetri/base/error.h"
#include "kinetri/kinetic/periodic_box_2.h"
#include "kinetri/simulation/packing.h"
#include "kinetri/simulation/simulation_2.h"
#include "parameter_names.h"

namespace kinetri::python {
namespace {

// The message without the condition and its place in the C++ code.
std::string plain_message(std::string message) {
  constexpr std::string_view begin = "precondition violated: ";
  const std::size_t end = message.rfind(" (expected ");
  if (message.starts_with(begin) && end != std::string::npos && message.ends_with(")")) {
    message.resize(end);
    message.erase(0, begin.size());
  }
  return message;
}

// Raises the class `name` of kinetri.errors, with this message and these attributes.
template <class... Attributes>
void raise(const char* name, const std::string& message,
           const std::pair<const char*, Attributes>&... attributes) {
  const py::object type = py::module_::import("kinetri.errors").attr(name);
  const py::object exception = type(text_of(message));
  (py::setattr(exception, attributes.first, py::cast(attributes.second)), ...);
  PyErr_SetObject(type.ptr(), exception.ptr());
}

template <class... Attributes>
void raise(const char* name, const Error& error,
           const std::pair<const char*, Attributes>&... attributes) {
  raise(name, plain_message(error.what()), attributes...);
}

template <class Value>
std::pair<const char*, Value> attribute(const char* name, const Value& value) {
  return {name, value};
}

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(std::move(thrown));
  } catch (const Coincident_trajectories_error& error) {
    raise("CoincidentTrajectoriesError",
          std::string(error.what()) + ", or make the object with coincident='hide'",
          attribute("ids", std::pair(error.first(), error.second())));
  } catch (const Endless_contacts_error& error) {
    raise("EndlessContactsError", error, attribute("id", error.point()));
  } catch (const Own_image_error& error) {
    raise("OwnImageError", error, attribute("id", error.point()),
          attribute("offset", std::pair(error.offset().x, error.offset().y)),
          attribute("time", error.time()));
  } catch (const Contact_overflow_error& error) {
    raise("ContactOverflowError", error, attribute("id", error.point()));
  } catch (const Contact_error& error) {
    raise("ContactError", error, attribute("id", error.point()));
  } catch (const Overlapping_discs_error& error) {
    raise("OverlappingDiscsError", error, attribute("pairs", error.pairs()));
  } catch (const Negative_radius_error& error) {
    raise("NegativeRadiusError", error, attribute("id", error.point()),
          attribute("time", error.time()));
  } catch (const Outside_box_error& error) {
    raise("OutsideBoxError", error, attribute("id", error.point()));
  } catch (const Periodic_offset_error& error) {
    raise("PeriodicOffsetError", error, attribute("ids", std::pair(error.first(), error.second())),
          attribute("time", error.time()));
  } catch (const Periodic_box_error& error) {
    raise("PeriodicBoxError", error);
  } catch (const Packing_error& error) {
    raise("PackingError", error);
  } catch (const Snapshot_error& error) {
    raise("SnapshotError", error);
  } catch (const Input_error& error) {
    raise("InputError", with_parameters(error.what()));
  } catch (const Output_error& error) {
    raise("OutputError", error);
  } catch (const Precondition_error& error) {
    raise("PreconditionError", error);
  } catch (const Internal_error& error) {
    raise("InternalError", error);
  } catch (const Error& error) {
    raise("Error", error);
  }
}

}  // namespace

void bind_errors(py::module_& /*module*/) {
  py::register_local_exception_translator(translate);
}

}  // namespace kinetri::python
