// SPDX-License-Identifier: GPL-3.0-or-later
//
// Exit codes. Scripts rely on the numbers.
#ifndef KINETRI_APPS_EXIT_CODE_H
#define KINETRI_APPS_EXIT_CODE_H

namespace kinetri::app {

enum class Exit_code {
  done = 0,
  audit_failed = 1,  ///< or the verification
  bad_input =
      2,  ///< bad usage, unusable input, an output that cannot be written, too little memory
  internal_error = 3,
  interrupted = 130,
};

}  // namespace kinetri::app

#endif  // KINETRI_APPS_EXIT_CODE_H
