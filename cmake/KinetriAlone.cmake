# SPDX-License-Identifier: GPL-3.0-or-later
# For a program in apps that is built alone: its compile settings and, if it sets KINETRI_NEEDED, the libraries
# of an installed Kinetri (CMAKE_PREFIX_PATH) and the code that programs share (apps/cli).
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()
include(${CMAKE_CURRENT_LIST_DIR}/KinetriTarget.cmake)
if(KINETRI_NEEDED)
  find_package(Kinetri REQUIRED COMPONENTS io)
  # Headers that only these programs include are not installed.
  add_compile_options("-idirafter${CMAKE_CURRENT_LIST_DIR}/../include")
  add_subdirectory(${CMAKE_CURRENT_LIST_DIR}/../apps/cli cli)
endif()
