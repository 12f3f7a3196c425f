# SPDX-License-Identifier: GPL-3.0-or-later
# The reference manual: the target `reference` writes it to the folder reference/html of the build, if Doxygen
# and Python are found. The test docs.reference does the same.
set(KINETRI_REFERENCE_DIR ${PROJECT_BINARY_DIR}/reference)
find_program(KINETRI_DOXYGEN doxygen)
mark_as_advanced(KINETRI_DOXYGEN)
find_package(Python3 QUIET COMPONENTS Interpreter)
if(Python3_FOUND)
  # A program that only chooses a Python, such as those of pyenv, takes five times as long to start as that Python.
  # Doxygen starts it for each file, and tests do.
  execute_process(COMMAND ${Python3_EXECUTABLE} -c "import sys; print(sys.executable)"
    OUTPUT_VARIABLE python3 OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(EXISTS "${python3}")
    set(Python3_EXECUTABLE "${python3}")
  endif()
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
