# SPDX-License-Identifier: GPL-3.0-or-later
# Finds the libraries that Kinetri::kinetri needs, and the optional ones of Kinetri::io. Used by the build and,
# installed, by KinetriConfig.cmake, so that an installed library contains no path of the build machine.
#
# Defines Boost::headers, CGAL::CGAL, TBB::tbb, Kinetri::gmp and Kinetri::mpfr; sets kinetri_missing to what is
# wrong, or to "". Sets KINETRI_OPTIONAL_LIBRARIES to those of sqlite and expat that are found, and defines
# Kinetri::sqlite and Kinetri::expat. An installed Kinetri::io needs those in kinetri_needed; kinetri_io_missing
# names the missing ones.
set(kinetri_missing "")
set(kinetri_io_missing "")

# CGAL reports a dozen details of its own configuration, and warns about every build that is not a
# Release. Users who want that set this variable to FALSE.
set(CGAL_DO_NOT_WARN_ABOUT_CMAKE_BUILD_TYPE TRUE CACHE BOOL
  "No warning by CGAL about build types other than Release")
mark_as_advanced(CGAL_DO_NOT_WARN_ABOUT_CMAKE_BUILD_TYPE)
set(kinetri_log_level "${CMAKE_MESSAGE_LOG_LEVEL}")
set(CMAKE_MESSAGE_LOG_LEVEL NOTICE)
if(EMSCRIPTEN)
  include(${CMAKE_CURRENT_LIST_DIR}/platforms/wasm/dependencies.cmake)
else()
  find_package(Boost QUIET CONFIG)
  find_package(CGAL QUIET)
  find_package(TBB QUIET)
endif()
set(CMAKE_MESSAGE_LOG_LEVEL "${kinetri_log_level}")
unset(kinetri_log_level)

if(NOT TARGET Boost::headers)
  string(APPEND kinetri_missing "Boost was not found (Debian: libboost-dev). ")
endif()
if(NOT TARGET CGAL::CGAL)
  string(APPEND kinetri_missing "CGAL was not found (Debian: libcgal-dev). ")
elseif(CGAL_VERSION AND CGAL_VERSION VERSION_LESS 5.5)
  string(APPEND kinetri_missing "CGAL ${CGAL_VERSION} is too old; expected 5.5 or newer. ")
endif()

if(NOT TARGET TBB::tbb AND NOT EMSCRIPTEN)
  string(APPEND kinetri_missing "oneTBB was not found (Debian: libtbb-dev). ")
endif()

include(${CMAKE_CURRENT_LIST_DIR}/KinetriFindLibrary.cmake)
foreach(name IN ITEMS gmp mpfr)
  kinetri_find_library(${name} ${name}.h ${name})
  if(NOT TARGET Kinetri::${name})
    string(TOUPPER ${name} variable)
    string(APPEND kinetri_missing "${variable} was not found (Debian: lib${name}-dev). ")
  endif()
endforeach()

# kinetri_optional(NAME HEADER LIBRARY PACKAGE): a library that Kinetri::io can be built without. If it was built
# with the library, it needs it.
set(KINETRI_OPTIONAL_LIBRARIES "")
macro(kinetri_optional name header library package)
  string(TOUPPER ${name} variable)
  if(NOT DEFINED kinetri_needed)
    option(KINETRI_WITH_${variable} "Read tracks with the library ${library}, if it is found" ON)
    mark_as_advanced(KINETRI_WITH_${variable})
  endif()
  if((DEFINED kinetri_needed AND "${name}" IN_LIST kinetri_needed) OR
      (NOT DEFINED kinetri_needed AND KINETRI_WITH_${variable}))
    kinetri_find_library(${name} ${header} ${library})
    if(TARGET Kinetri::${name})
      list(APPEND KINETRI_OPTIONAL_LIBRARIES ${name})
    elseif(DEFINED kinetri_needed)
      string(APPEND kinetri_io_missing "${library} was not found (Debian: ${package}). ")
    endif()
  endif()
endmacro()
kinetri_optional(sqlite sqlite3.h sqlite3 libsqlite3-dev)
kinetri_optional(expat expat.h expat libexpat1-dev)
string(STRIP "${kinetri_missing}" kinetri_missing)
string(STRIP "${kinetri_io_missing}" kinetri_io_missing)
