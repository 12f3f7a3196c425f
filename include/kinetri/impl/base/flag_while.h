// SPDX-License-Identifier: GPL-3.0-or-later
//
// A flag that is true during a call.
#ifndef KINETRI_IMPL_BASE_FLAG_WHILE_H
#define KINETRI_IMPL_BASE_FLAG_WHILE_H

#include "kinetri/base/platform.h"

namespace kinetri::detail {

class Flag_while {
 public:
  explicit Flag_while(bool& flag) : flag_(flag) { flag_ = true; }
  ~Flag_while() { flag_ = false; }
  Flag_while(const Flag_while&) = delete;
  Flag_while& operator=(const Flag_while&) = delete;

 private:
  bool& flag_;
};

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_BASE_FLAG_WHILE_H
