// SPDX-License-Identifier: GPL-3.0-or-later
//
// Nothing: the target that compiles this compiles the headers that tests share
// (test/CMakeLists.txt).
