// SPDX-License-Identifier: GPL-3.0-or-later
#include "moving.h"

#include <chrono>
#include <exception>

#include "kinetri/base/error.h"
#include "kinetri/kinetic/periodic_box_2.h"
#include "kinetri/simulation/simulation_2.h"

namespace kinetri::python {

namespace py = pybind11;

Moving::Use::Use(Moving& moving, Event_observer* observer) : moving_(moving), observer_(observer) {
  if (moving.is_within_instant_) {
    throw Precondition_error(
        "an error has left the simulation between two events of one time; expected another one: "
        "make it anew, or restore a snapshot");
  }
  if (moving.is_in_use_.exchange(true)) {
    throw Precondition_error(
        "the object is in use: time advances, or another thread asks it; expected calls one after "
        "the other (two objects can be used at once)");
  }
  if (observer_ == nullptr) return;
  try {
    moving_.engine_->add_observer(*observer_);
  } catch (...) {  // an observer has thrown within an event
    moving_.is_in_use_ = false;
    throw;
  }
}

Moving::Use::~Use() {
  if (observer_ != nullptr) moving_.engine_->remove_observer(*observer_);
  moving_.is_in_use_ = false;
}

// Errors of contacts (except contacts without end) and of responses leave the simulation within an
// instant.
template <class Run>
std::size_t Moving::guarded(const Run& run) {
  try {
    return run();
  } catch (const Negative_radius_error&) {
    throw;
  } catch (const Coincident_trajectories_error&) {
    // Such points are refused, and a scheduled change has been dropped.
    throw;
  } catch (const Outside_box_error&) {
    throw;
  } catch (const Periodic_box_error&) {  // the box would lose its area: no event is executed
    throw;
  } catch (const Endless_contacts_error&) {  // the state is that before the contact
    throw;
  } catch (const Own_image_error&) {  // the same
    throw;
  } catch (...) {
    is_within_instant_ = true;
    throw;
  }
}

void Moving::raise_if_interrupted() {
  if (interrupted_ && interrupted_->exchange(false)) {
    PyErr_SetNone(PyExc_KeyboardInterrupt);
    throw py::error_already_set();
  }
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

std::size_t Moving::advance(const Algebraic_number& until, Event_observer* observer,
                            const py::object& progress) {
  using Clock = std::chrono::steady_clock;
  constexpr auto most_time = std::chrono::milliseconds(50);
  const Use use(*this, observer);
  if (until < engine_->current_time()) engine_->advance_to(until, nullptr);  // throws
  const auto look = [&] {
    raise_if_interrupted();
    if (!progress.is_none()) progress(engine_->current_time().to_double());
  };
  std::size_t events = 0;
  std::exception_ptr error;  // from the callback, after which the engine stops by itself
  {
    Gil_release no_gil;
    auto next_look = Clock::now() + most_time;
    const auto may_go_on = [&] {
      if (!(interrupted_ && *interrupted_) && Clock::now() < next_look) return true;
      no_gil.with_gil([&] {
        try {
          look();
        } catch (...) {
          error = std::current_exception();
        }
      });
      next_look = Clock::now() + most_time;
      return error == nullptr;
    };
    events = guarded([&] { return engine_->advance_to(until, may_go_on); });
  }
  if (error) std::rethrow_exception(error);
  look();
  return events;
}

std::size_t Moving::step(const Algebraic_number* until, Event_observer* observer) {
  std::size_t events = 0;
  {
    const Use use(*this, observer);
    const Gil_release no_gil;
    events = guarded([&] { return engine_->step(until); });
  }
  raise_if_interrupted();
  return events;
}

}  // namespace kinetri::python
