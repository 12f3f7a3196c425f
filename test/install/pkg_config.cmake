# SPDX-License-Identifier: GPL-3.0-or-later
# Compiles the consumer in WORK_DIR by hand, with COMPILE_OPTIONS (separated by |) and what pkg-config
# says about the copy in PREFIX, and compares what it prints with what it should.
file(MAKE_DIRECTORY ${WORK_DIR})
set(ENV{PKG_CONFIG_PATH} ${PREFIX}/${LIBDIR}/pkgconfig)
set(ENV{LD_LIBRARY_PATH} ${PREFIX}/${LIBDIR})
foreach(kind IN ITEMS cflags libs)
  execute_process(COMMAND ${PKG_CONFIG} --${kind} kinetri
    OUTPUT_VARIABLE ${kind} OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  separate_arguments(${kind})
endforeach()
string(REPLACE "|" ";" COMPILE_OPTIONS "${COMPILE_OPTIONS}")
execute_process(COMMAND ${LAUNCHER} ${COMPILER} -std=c++20 ${COMPILE_OPTIONS} ${cflags}
  -c ${CONSUMER_DIR}/main.cpp -o ${WORK_DIR}/main.o COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${COMPILER} ${COMPILE_OPTIONS} ${WORK_DIR}/main.o
  -o ${WORK_DIR}/consumer ${libs} COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${WORK_DIR}/consumer OUTPUT_VARIABLE output COMMAND_ERROR_IS_FATAL ANY)
file(READ ${CONSUMER_DIR}/expected.txt expected)
if(NOT output STREQUAL expected)
  message(FATAL_ERROR "the consumer prints\n${output}expected\n${expected}")
endif()
