// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef KINETRI_PYTHON_GIL_RELEASE_H
#define KINETRI_PYTHON_GIL_RELEASE_H

#include <pybind11/pybind11.h>

#include <chrono>
#include <thread>

namespace kinetri::python {

/// Gives up the GIL as long as it exists.
///
/// When the interpreter has ended, it exits the daemon threads that ask for the GIL, and C++ ends
/// the process with an error where such an exit meets a destructor. Such a thread waits here
/// instead, until the process ends.
class Gil_release {
 public:
  Gil_release() : is_last_thread_(_Py_IsFinalizing() != 0), state_(PyEval_SaveThread()) {}
  Gil_release(const Gil_release&) = delete;
  Gil_release& operator=(const Gil_release&) = delete;
  ~Gil_release() { take_gil(); }

  /// Calls `function`, with the GIL meanwhile.
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

  const bool is_last_thread_;  // who has the GIL at the end ends the interpreter
  PyThreadState* state_;
};

}  // namespace kinetri::python

#endif  // KINETRI_PYTHON_GIL_RELEASE_H
