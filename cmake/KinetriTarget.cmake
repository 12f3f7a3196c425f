# SPDX-License-Identifier: GPL-3.0-or-later
# What every target of the project is compiled with.

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
  # GCC contracts a*b+c by default outside ISO mode; exactness proofs assume that nothing is contracted.
  target_compile_options(${target} PRIVATE -ffp-contract=off)
  # What __FILE__ says must not depend on where the library was built.
  target_compile_options(${target} PRIVATE -fmacro-prefix-map=${PROJECT_SOURCE_DIR}/=)
  if(KINETRI_WARNINGS_AS_ERRORS)
    target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion
      -Wsign-conversion -Wold-style-cast -Wnon-virtual-dtor -Woverloaded-virtual -Werror)
  endif()
  if(KINETRI_SANITIZE)
    target_compile_options(${target} PUBLIC -fsanitize=${KINETRI_SANITIZE} -fno-sanitize-recover=all
      -fno-omit-frame-pointer)
    target_link_options(${target} PUBLIC -fsanitize=${KINETRI_SANITIZE})
    # With what the sanitizers add, g++ 12 sees uninitialized memory that is none.
    target_compile_options(${target} PRIVATE
      $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  endif()
  if(KINETRI_COVERAGE)
    # Not in the code of CGAL and the tests, which only makes it slow. Test programs run at once.
    target_compile_options(${target} PRIVATE --coverage -fprofile-update=atomic
      "-fprofile-filter-files=${PROJECT_SOURCE_DIR}/(include|src|apps)/.*")
    target_link_options(${target} PUBLIC --coverage)
  endif()
endfunction()

# Where manual pages and completions of programs are written.
set(KINETRI_DOCUMENTS_DIR ${PROJECT_BINARY_DIR}/documents)
find_program(KINETRI_GZIP gzip)
mark_as_advanced(KINETRI_GZIP)

# kinetri_compressed_page(FILE NAME VARIABLE): the manual page of a program, compressed in the folder
# KINETRI_DOCUMENTS_DIR where gzip is there; appended to the list VARIABLE.
function(kinetri_compressed_page file name variable)
  if(KINETRI_GZIP)
    set(page ${KINETRI_DOCUMENTS_DIR}/${name}.1.gz)
    add_custom_command(OUTPUT ${page}
      COMMAND ${CMAKE_COMMAND} -E make_directory ${KINETRI_DOCUMENTS_DIR}
      COMMAND ${KINETRI_GZIP} -9nc ${file} > ${page} DEPENDS ${file} VERBATIM)
    set(${variable} ${${variable}} ${page} PARENT_SCOPE)
  endif()
endfunction()

# kinetri_program_documents(TARGET NAME): the manual page, compressed where that is possible, and the completions
# of a program, which it writes from its own tables, in the folder KINETRI_DOCUMENTS_DIR.
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

# Most of the time of a small source is that of the headers of GMP, CGAL, pybind11 or nlohmann_json, and of
# the templates that it instantiates once more. So sources are compiled several at a time; not in a debug build,
# in which one changes a source at a time, and which clang-tidy goes by; nor where counters of coverage tell
# sources apart.
set(kinetri_compile_together ON)
if(CMAKE_BUILD_TYPE STREQUAL "Debug" OR KINETRI_COVERAGE)
  set(kinetri_compile_together OFF)
endif()
option(KINETRI_COMPILE_TOGETHER "Compile several sources at a time" ${kinetri_compile_together})
mark_as_advanced(KINETRI_COMPILE_TOGETHER)

# kinetri_compile_as_one(TARGET GROUP REGEX): the sources of the target that match, and are in no group
# before, are compiled as one.
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

# kinetri_compile_in_batches(TARGET COUNT): the sources of the target are compiled COUNT at a time.
function(kinetri_compile_in_batches target count)
  set_target_properties(${target} PROPERTIES
    UNITY_BUILD ${KINETRI_COMPILE_TOGETHER} UNITY_BUILD_MODE BATCH UNITY_BUILD_BATCH_SIZE ${count})
endfunction()
