# SPDX-License-Identifier: GPL-3.0-or-later
# Prints a message if a project that uses Kinetri is built without optimization by accident: much of the
# library is compiled in the user's sources. Used by the build and, installed, by KinetriConfig.cmake.
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES AND NOT CMAKE_CXX_FLAGS MATCHES "-O"
    AND NOT Kinetri_FIND_QUIETLY)
  message(STATUS "Kinetri: CMAKE_BUILD_TYPE is empty, and without optimization programs run about 14 times slower; expected -DCMAKE_BUILD_TYPE=Release")
endif()
