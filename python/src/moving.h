// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a Python object holds: an engine, and what keeps two threads from using it at once.
#ifndef KINETRI_PYTHON_MOVING_H
#define KINETRI_PYTHON_MOVING_H

#include <pybind11/pybind11.h>

#include <atomic>
#include <cstddef>
#include <memory>
#include <utility>

#include "engine.h"
#include "gil_release.h"
#include "response.h"

namespace kinetri::python {

class Moving {
 public:
  explicit Moving(std::unique_ptr<Engine> engine, Interrupt_flag interrupted = nullptr)
      : engine_(std::move(engine)), interrupted_(std::move(interrupted)) {}

  /// What `function` gives for the engine, without the GIL. Throws Precondition_error if another
  /// call has not ended: of another thread, or one whose response or progress calls this; or if an
  /// error has left a simulation within an instant.
  template <class Function>
  decltype(auto) with_engine(const Function& function) {
    const Use use(*this);
    const Gil_release no_gil;
    return function(*engine_);
  }

  /// Executes all events up to `until`, and goes to that time. Returns their number. The observer,
  /// if there is one, sees them. Between events, or windows of time of a run by regions, it lets
  /// Python deal with signals, and calls progress(time) at most 20 times a second, unless that is
  /// None.
  std::size_t advance(const Algebraic_number& until, Event_observer* observer,
                      const pybind11::object& progress);

  /// Executes the events of the next time, if that is not after `until`. Returns their number. The
  /// observer, if there is one, sees them.
  std::size_t step(const Algebraic_number* until, Event_observer* observer);

 private:
  class Use {
   public:
    explicit Use(Moving& moving, Event_observer* observer = nullptr);
    Use(const Use&) = delete;
    Use& operator=(const Use&) = delete;
    ~Use();

   private:
    Moving& moving_;
    Event_observer* observer_;
  };

  template <class Run>
  std::size_t guarded(const Run& run);
  void raise_if_interrupted();

  std::unique_ptr<Engine> engine_;
  Interrupt_flag interrupted_;
  std::atomic<bool> is_in_use_ = false;
  bool is_within_instant_ = false;  // an error has left it so
};

}  // namespace kinetri::python

#endif  // KINETRI_PYTHON_MOVING_H
