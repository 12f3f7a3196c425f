# SPDX-License-Identifier: GPL-3.0-or-later
# Runs PROGRAM, and compares what it prints, byte for byte, with the file EXPECTED.
execute_process(COMMAND ${PROGRAM} RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE errors)
file(READ ${EXPECTED} expected)
if(NOT code EQUAL 0 OR errors OR NOT output STREQUAL expected)
  # Indented, so that CMake shows it as it is.
  string(REPLACE "\n" "\n  " text
    "\nexit code ${code}, expected 0\n${errors}prints\n${output}expected\n${expected}")
  message(FATAL_ERROR "${PROGRAM}:${text}")
endif()
