# SPDX-License-Identifier: GPL-3.0-or-later
# Compiles the consumers in WORK_DIR by hand, with COMPILE_OPTIONS (separated by |) and what pkg-config
# says about the copy in PREFIX, and compares what they print with what they should. Then compiles
# headers as C++17: the compiler stops at the one #error that asks for C++20.
file(MAKE_DIRECTORY "${WORK_DIR}")
set(ENV{PKG_CONFIG_PATH} "${PREFIX}/${LIBDIR}/pkgconfig")
set(ENV{LD_LIBRARY_PATH} "${PREFIX}/${LIBDIR}")
# Geometry needs no library of files.
execute_process(COMMAND ${PKG_CONFIG} --print-requires kinetri OUTPUT_VARIABLE output COMMAND_ERROR_IS_FATAL ANY)
if(NOT output MATCHES "gmp" OR output MATCHES "sqlite|expat")
  message(SEND_ERROR "kinetri requires ${output}")
endif()
string(REPLACE "|" ";" COMPILE_OPTIONS "${COMPILE_OPTIONS}")
foreach(program IN ITEMS "kinetri-io files.cpp expected_of_files.txt" "kinetri main.cpp expected.txt")
  separate_arguments(program)
  list(POP_FRONT program package source expected)
  foreach(kind IN ITEMS cflags libs)
    execute_process(COMMAND ${PKG_CONFIG} --${kind} ${package}
      OUTPUT_VARIABLE output OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
    separate_arguments(${kind} UNIX_COMMAND "${output}")
  endforeach()
  execute_process(COMMAND ${LAUNCHER} ${COMPILER} ${COMPILE_OPTIONS} ${cflags}
    -c "${CONSUMER_DIR}/${source}" -o "${WORK_DIR}/${source}.o" COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND ${COMPILER} ${COMPILE_OPTIONS} "${WORK_DIR}/${source}.o"
    -o "${WORK_DIR}/${package}" ${libs} COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND "${WORK_DIR}/${package}" OUTPUT_VARIABLE output COMMAND_ERROR_IS_FATAL ANY)
  file(READ "${CONSUMER_DIR}/${expected}" expected)
  if(NOT output STREQUAL expected)
    message(FATAL_ERROR "the program that uses ${package} prints\n${output}expected\n${expected}")
  endif()
endforeach()

foreach(header IN ITEMS kinetri/kinetri.h kinetri/io/event_log.h
    kinetri/triangulation/kinetic_delaunay_triangulation_2.h)
  file(WRITE "${WORK_DIR}/header.cpp" "#include <${header}>\n")
  execute_process(COMMAND ${COMPILER} ${cflags} -std=c++17 -fsyntax-only "${WORK_DIR}/header.cpp"
    RESULT_VARIABLE code ERROR_VARIABLE errors)
  # The second error is that of the header which does not exist, after which compilers stop.
  string(REPLACE ";" "," errors "${errors}")
  string(REGEX MATCHALL "error: [^\n]*" found "${errors}")
  list(LENGTH found count)
  if(code EQUAL 0 OR NOT count EQUAL 2 OR NOT found MATCHES "Kinetri needs C\\+\\+20, expected")
    string(REPLACE "\n" "\n  " errors "\n${errors}")
    message(SEND_ERROR "<${header}> as C++17 ends with ${code}; expected one #error:${errors}")
  endif()
endforeach()
