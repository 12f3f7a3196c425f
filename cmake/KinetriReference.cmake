# SPDX-License-Identifier: GPL-3.0-or-later
# The reference manual: the target `reference` writes it to the folder reference/html of the build, if Doxygen
# and Python are found. The test docs.reference does the same.
set(KINETRI_REFERENCE_DIR ${PROJECT_BINARY_DIR}/reference)
find_program(KINETRI_DOXYGEN doxygen)
mark_as_advanced(KINETRI_DOXYGEN)
find_package(Python3 QUIET COMPONENTS Interpreter)
if(Python3_FOUND)
  file(GLOB documents CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/*.md)
  foreach(folder IN ITEMS docs bench data examples viewer live)
    file(GLOB_RECURSE found CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${folder}/*.md)
    list(APPEND documents ${found})
  endforeach()
  list(JOIN documents "\" \"" KINETRI_DOCUMENTS)
  configure_file(${PROJECT_SOURCE_DIR}/docs/Doxyfile.in ${PROJECT_BINARY_DIR}/Doxyfile @ONLY)
  if(KINETRI_DOXYGEN)
    add_custom_target(reference
      COMMAND ${KINETRI_DOXYGEN} ${PROJECT_BINARY_DIR}/Doxyfile
      COMMENT "Writing the reference manual: ${KINETRI_REFERENCE_DIR}/html/index.html"
      VERBATIM)
  endif()
endif()
