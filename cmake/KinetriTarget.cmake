# SPDX-License-Identifier: GPL-3.0-or-later
# Compile settings of all targets of the project.

if(KINETRI_SANITIZE AND NOT KINETRI_SANITIZE MATCHES "^(address,undefined|thread)$")
  message(FATAL_ERROR "KINETRI_SANITIZE is '${KINETRI_SANITIZE}'; expected 'address,undefined', 'thread' or nothing")
endif()
if(KINETRI_COVERAGE AND NOT CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  message(FATAL_ERROR "KINETRI_COVERAGE needs g++; the compiler is ${CMAKE_CXX_COMPILER}")
endif()

# kinetri_compile_settings(TARGET): C++20 without extensions, strict warnings, sanitizers or counters
# of coverage on request.
function(kinetri_compile_settings target)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
  target_compile_features(${target} PUBLIC cxx_std_20)
  # GCC fuses a*b+c by default outside ISO mode; proofs of exactness assume that nothing is fused.
  target_compile_options(${target} PRIVATE -ffp-contract=off)
  # __FILE__ must not depend on the build directory.
  target_compile_options(${target} PRIVATE -fmacro-prefix-map=${PROJECT_SOURCE_DIR}/=)
  if(KINETRI_WARNINGS_AS_ERRORS)
    target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion
      -Wsign-conversion -Wold-style-cast -Wnon-virtual-dtor -Woverloaded-virtual -Werror)
  endif()
  if(KINETRI_SANITIZE)
    target_compile_options(${target} PUBLIC -fsanitize=${KINETRI_SANITIZE} -fno-sanitize-recover=all
      -fno-omit-frame-pointer)
    target_link_options(${target} PUBLIC -fsanitize=${KINETRI_SANITIZE})
    # With sanitizers, g++ 12 has false warnings of uninitialized memory.
    target_compile_options(${target} PRIVATE
      $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  endif()
  if(KINETRI_COVERAGE)
    # Not in the code of CGAL and the tests, which would only be slow. Atomic, since test programs run in parallel.
    target_compile_options(${target} PRIVATE --coverage -fprofile-update=atomic
      "-fprofile-filter-files=${PROJECT_SOURCE_DIR}/(include|src|apps)/.*")
    target_link_options(${target} PUBLIC --coverage)
  endif()
endfunction()

# The folder for manual pages and completions of programs.
set(KINETRI_DOCUMENTS_DIR ${PROJECT_BINARY_DIR}/documents)
find_program(KINETRI_GZIP gzip)
mark_as_advanced(KINETRI_GZIP)

# kinetri_compressed_page(FILE NAME VARIABLE): if there is gzip, compresses the manual page of a program to
# KINETRI_DOCUMENTS_DIR, and appends the result to the list VARIABLE.
function(kinetri_compressed_page file name variable)
  if(KINETRI_GZIP)
    set(page ${KINETRI_DOCUMENTS_DIR}/${name}.1.gz)
    add_custom_command(OUTPUT ${page}
      COMMAND ${CMAKE_COMMAND} -E make_directory ${KINETRI_DOCUMENTS_DIR}
      COMMAND ${KINETRI_GZIP} -9nc ${file} > ${page} DEPENDS ${file} VERBATIM)
    set(${variable} ${${variable}} ${page} PARENT_SCOPE)
  endif()
endfunction()

# kinetri_program_documents(TARGET NAME): the manual page, also compressed if there is gzip, and the completions of
# a program, which the program itself writes, in the folder KINETRI_DOCUMENTS_DIR.
function(kinetri_program_documents target name)
  set(documents)
  foreach(document IN ITEMS "${name}.1 manual" "${name}.bash completion bash" "_${name} completion zsh"
      "${name}.fish completion fish")
    separate_arguments(document)
    list(POP_FRONT document file)
    add_custom_command(OUTPUT ${KINETRI_DOCUMENTS_DIR}/${file}
      COMMAND ${CMAKE_COMMAND} -E make_directory ${KINETRI_DOCUMENTS_DIR}
      COMMAND ${target} ${document} > ${KINETRI_DOCUMENTS_DIR}/${file}
      DEPENDS ${target} COMMENT "Writing ${file}" VERBATIM)
    list(APPEND documents ${KINETRI_DOCUMENTS_DIR}/${file})
  endforeach()
  kinetri_compressed_page(${KINETRI_DOCUMENTS_DIR}/${name}.1 ${name} documents)
  string(REPLACE - _ prefix ${name})
  add_custom_target(${prefix}_documents ALL DEPENDS ${documents})
endfunction()

# Compiling a small source mostly takes the time of the headers of GMP, CGAL, pybind11 or nlohmann_json, and of
# templates that others instantiate too. So several sources are compiled as one, except in a debug build, for
# fast changes of one source and for clang-tidy, and with counters of coverage, which are by source.
set(kinetri_compile_together ON)
if(CMAKE_BUILD_TYPE STREQUAL "Debug" OR KINETRI_COVERAGE)
  set(kinetri_compile_together OFF)
endif()
option(KINETRI_COMPILE_TOGETHER "Compile several sources at a time" ${kinetri_compile_together})
mark_as_advanced(KINETRI_COMPILE_TOGETHER)

# kinetri_compile_as_one(TARGET GROUP REGEX): compiles as one those sources of the target that match and are not in
# a group yet.
function(kinetri_compile_as_one target group regex)
  if(NOT KINETRI_COMPILE_TOGETHER)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources INCLUDE REGEX "${regex}")
  foreach(source IN LISTS sources)
    get_source_file_property(before ${source} UNITY_GROUP)
    if(NOT before)
      set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group})
    endif()
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()

# kinetri_compile_in_batches(TARGET COUNT): compiles the sources of the target COUNT at a time.
function(kinetri_compile_in_batches target count)
  set_target_properties(${target} PROPERTIES
    UNITY_BUILD ${KINETRI_COMPILE_TOGETHER} UNITY_BUILD_MODE BATCH UNITY_BUILD_BATCH_SIZE ${count})
endfunction()
