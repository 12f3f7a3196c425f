# SPDX-License-Identifier: GPL-3.0-or-later
# What every target of the project is compiled with.

# kinetri_compile_settings(TARGET): C++20 without extensions, strict warnings, sanitizers on request.
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
    target_compile_options(${target} PUBLIC -fsanitize=address,undefined -fno-sanitize-recover=all
      -fno-omit-frame-pointer)
    target_link_options(${target} PUBLIC -fsanitize=address,undefined)
  endif()
endfunction()
