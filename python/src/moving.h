// SPDX-License-Identifier: GPL-3.0-or-later
//
// The content of a Python object: an engine, guarded against concurrent use.
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

  /// Calls `function` with the engine, without the GIL. Throws Precondition_error during another
  /// call, by another thread or from a response or progress function; or if an error has left the
  /// simulation within an instant.
  template <class Function>
  decltype(auto) with_engine(const Function& function) {
    const Use use(*this);
    const Gil_release no_gil;
    return function(*engine_);
  }

  /// Executes all events up to `until`, and advances to that time. Returns their number. The
  /// observer, if not null, observes them. Between events, or time windows of parallel execution,
  /// it lets Python handle signals, and calls progress(time) at most 20 times a second, unless that
  /// is None.
  std::size_t advance(const Algebraic_number& until, Event_observer* observer,
                      const pybind11::object& progress);

  /// Executes the events of the next time, if it is not after `until`. Returns their number. The
  /// observer, if not null, observes them.
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
  bool is_within_instant_ = false;  // because of an error
};

}  // namespace kinetri::python

#endif  // KINETRI_PYTHON_MOVING_H
