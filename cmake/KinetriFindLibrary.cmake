# SPDX-License-Identifier: GPL-3.0-or-later
# kinetri_find_library(NAME HEADER LIBRARY [FOLDER]): defines Kinetri::NAME if the header, perhaps in FOLDER of an
# include directory, and the library are found. Sets the cache variables KINETRI_NAME_INCLUDE_DIR and
# KINETRI_NAME_LIBRARY, with NAME in upper case.
function(kinetri_find_library name header library)
  if(TARGET Kinetri::${name})
    return()
  endif()
  string(TOUPPER ${name} variable)
  find_path(KINETRI_${variable}_INCLUDE_DIR ${header} PATH_SUFFIXES ${ARGN})
  find_library(KINETRI_${variable}_LIBRARY ${library})
  mark_as_advanced(KINETRI_${variable}_INCLUDE_DIR KINETRI_${variable}_LIBRARY)
  if(KINETRI_${variable}_INCLUDE_DIR AND KINETRI_${variable}_LIBRARY)
    add_library(Kinetri::${name} UNKNOWN IMPORTED)
    set_target_properties(Kinetri::${name} PROPERTIES
      IMPORTED_LOCATION "${KINETRI_${variable}_LIBRARY}"
      INTERFACE_INCLUDE_DIRECTORIES "${KINETRI_${variable}_INCLUDE_DIR}")
  endif()
endfunction()
