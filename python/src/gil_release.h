// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef KINETRI_PYTHON_GIL_RELEASE_H
#define KINETRI_PYTHON_GIL_RELEASE_H

#include <pybind11/pybind11.h>

#include <chrono>
#include <thread>

namespace kinetri::python {

/// Releases the GIL while it exists.
///
/// After the interpreter has ended, it exits daemon threads that request the GIL, which aborts the
/// process if the exit unwinds through a destructor. Such a thread waits here instead, until the
/// process ends.
class Gil_release {
 public:
  Gil_release() : is_last_thread_(_Py_IsFinalizing() != 0), state_(PyEval_SaveThread()) {}
  Gil_release(const Gil_release&) = delete;
  Gil_release& operator=(const Gil_release&) = delete;
  ~Gil_release() { take_gil(); }

  /// Calls `function` with the GIL.
  template <class Function>
  void with_gil(const Function& function) {
    struct Release {
      Gil_release& self;
      ~Release() { self.state_ = PyEval_SaveThread(); }
    };
    take_gil();
    const Release afterwards = {*this};
    function();
  }

 private:
  void take_gil() {
    while (!is_last_thread_ && _Py_IsFinalizing() != 0) {
      std::this_thread::sleep_for(std::chrono::seconds(1));
    }
    PyEval_RestoreThread(state_);
  }

  const bool is_last_thread_;  // the thread that has the GIL at the end finalizes the interpreter
  PyThreadState* state_;
};

}  // namespace kinetri::python

#endif  // KINETRI_PYTHON_GIL_RELEASE_H
