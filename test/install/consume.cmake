# SPDX-License-Identifier: GPL-3.0-or-later
# Configures the project CONSUMER_DIR in WORK_DIR with the options OPTIONS (separated by |), builds its
# target TARGET, runs PROGRAM with the ARGUMENTS (separated by |), and compares what that prints with the file
# EXPECTED, in the folder of the project. Where REFUSED is given, configuring must fail instead, with a message
# that matches it; where HINT is given, nothing is built, and configuring must say what an empty
# CMAKE_BUILD_TYPE means (ON), or not (OFF). The program must not be linked with a library that matches
# NEEDS_NOT, where that is given.

# Stops with the message and the text under it, which CMake shows as it is where it is indented.
function(fail message text)
  string(REPLACE "\n" "\n  " text "\n${text}")
  message(FATAL_ERROR "${message}${text}")
endfunction()

string(REPLACE "|" ";" OPTIONS "${OPTIONS}")
# Nothing found before is found again without looking; but what has been compiled may stay.
file(REMOVE "${WORK_DIR}/CMakeCache.txt")
execute_process(
  COMMAND ${CMAKE_COMMAND} -S "${CONSUMER_DIR}" -B "${WORK_DIR}" -G ${GENERATOR} ${OPTIONS}
  RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE errors)
if(DEFINED REFUSED)
  string(REGEX REPLACE "[ \n]+" " " message "${errors}")
  if(code EQUAL 0 OR NOT message MATCHES "${REFUSED}")
    fail("configuring ended with ${code}, expected a refusal with \"${REFUSED}\":" "${errors}")
  endif()
  return()
endif()
if(NOT code EQUAL 0 OR errors)
  fail("configuring ended with ${code}:" "${output}${errors}")
endif()
if(DEFINED HINT)
  if((HINT AND NOT output MATCHES "expected -DCMAKE_BUILD_TYPE=Release") OR
      (NOT HINT AND output MATCHES "Kinetri: CMAKE_BUILD_TYPE"))
    fail("configuring says" "${output}")
  endif()
  return()
endif()
if(output MATCHES "CGAL|Boost")
  fail("configuring talks about Kinetri's dependencies:" "${output}")
endif()

execute_process(COMMAND ${CMAKE_COMMAND} --build "${WORK_DIR}" --target ${TARGET} --parallel 2
  RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(NOT code EQUAL 0)
  fail("building ended with ${code}:" "${output}")
endif()

if(DEFINED NEEDS_NOT)
  execute_process(COMMAND ldd "${WORK_DIR}/${PROGRAM}" OUTPUT_VARIABLE libraries COMMAND_ERROR_IS_FATAL ANY)
  if(NOT libraries MATCHES "libgmp" OR libraries MATCHES "${NEEDS_NOT}")
    fail("${PROGRAM} is linked with" "${libraries}")
  endif()
endif()
string(REPLACE "|" ";" ARGUMENTS "${ARGUMENTS}")
execute_process(COMMAND "${WORK_DIR}/${PROGRAM}" ${ARGUMENTS} OUTPUT_VARIABLE output
  COMMAND_ERROR_IS_FATAL ANY)
file(READ "${CONSUMER_DIR}/${EXPECTED}" expected)
if(NOT output STREQUAL expected)
  fail("${PROGRAM} prints" "${output}expected\n${expected}")
endif()
