# SPDX-License-Identifier: GPL-3.0-or-later
# Finds the libraries that are seen through the public headers. Used by the build and, installed, by
# KinetriConfig.cmake, so that an installed library names no path of the machine it was built on.
#
# Defines Boost::headers, CGAL::CGAL, TBB::tbb, Kinetri::gmp and Kinetri::mpfr; sets kinetri_missing to what is
# wrong, or to "".
set(kinetri_missing "")

# CGAL reports a dozen details of its own configuration, and warns about every build that is not a
# Release; whoever wants that sets this variable.
set(CGAL_DO_NOT_WARN_ABOUT_CMAKE_BUILD_TYPE TRUE CACHE BOOL
  "No warning by CGAL about build types other than Release")
mark_as_advanced(CGAL_DO_NOT_WARN_ABOUT_CMAKE_BUILD_TYPE)
set(kinetri_log_level "${CMAKE_MESSAGE_LOG_LEVEL}")
set(CMAKE_MESSAGE_LOG_LEVEL NOTICE)
find_package(Boost QUIET CONFIG)
find_package(CGAL QUIET)
find_package(TBB QUIET)
set(CMAKE_MESSAGE_LOG_LEVEL "${kinetri_log_level}")
unset(kinetri_log_level)

if(NOT TARGET Boost::headers)
  string(APPEND kinetri_missing "Boost was not found (Debian: libboost-dev). ")
endif()
if(NOT TARGET CGAL::CGAL)
  string(APPEND kinetri_missing "CGAL was not found (Debian: libcgal-dev). ")
elseif(CGAL_VERSION VERSION_LESS 5.5)
  string(APPEND kinetri_missing "CGAL ${CGAL_VERSION} is too old; expected 5.5 or newer. ")
endif()

if(NOT TARGET TBB::tbb)
  string(APPEND kinetri_missing "oneTBB was not found (Debian: libtbb-dev). ")
endif()

foreach(name IN ITEMS gmp mpfr)
  if(NOT TARGET Kinetri::${name})
    string(TOUPPER ${name} variable)
    find_path(KINETRI_${variable}_INCLUDE_DIR ${name}.h)
    find_library(KINETRI_${variable}_LIBRARY ${name})
    mark_as_advanced(KINETRI_${variable}_INCLUDE_DIR KINETRI_${variable}_LIBRARY)
    if(KINETRI_${variable}_INCLUDE_DIR AND KINETRI_${variable}_LIBRARY)
      add_library(Kinetri::${name} UNKNOWN IMPORTED)
      set_target_properties(Kinetri::${name} PROPERTIES
        IMPORTED_LOCATION "${KINETRI_${variable}_LIBRARY}"
        INTERFACE_INCLUDE_DIRECTORIES "${KINETRI_${variable}_INCLUDE_DIR}")
    else()
      string(APPEND kinetri_missing "${variable} was not found (Debian: lib${name}-dev). ")
    endif()
  endif()
endforeach()
string(STRIP "${kinetri_missing}" kinetri_missing)
