# SPDX-License-Identifier: GPL-3.0-or-later
# WebAssembly, with Emscripten. KINETRI_SYSROOT is the folder that scripts/platform.sh fills with GMP and MPFR, and
# with links to the headers of this machine that fit every platform.
execute_process(COMMAND em-config EMSCRIPTEN_ROOT OUTPUT_VARIABLE kinetri_emscripten
  OUTPUT_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE kinetri_failed)
if(kinetri_failed)
  message(FATAL_ERROR "Emscripten was not found; scripts/setup.sh live installs it")
endif()
include(${kinetri_emscripten}/cmake/Modules/Platform/Emscripten.cmake)
list(APPEND CMAKE_FIND_ROOT_PATH ${KINETRI_SYSROOT})
# Rounding modes do nothing there. Exceptions and vectors are in all browsers since 2023.
set(CMAKE_CXX_FLAGS_INIT "-fwasm-exceptions -msimd128 -DCGAL_ALWAYS_ROUND_TO_NEAREST -include \"${CMAKE_CURRENT_LIST_DIR}/wasm/standard_library.h\"")
set(CMAKE_CROSSCOMPILING_EMULATOR node)
set(CMAKE_TRY_COMPILE_PLATFORM_VARIABLES KINETRI_SYSROOT)
