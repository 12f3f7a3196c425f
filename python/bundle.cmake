# SPDX-License-Identifier: GPL-3.0-or-later
# Run by `cmake --install BUILD --component wheel --prefix PREFIX`: writes PREFIX/kinetri, with the
# extension module `module` as it was built, which looks for libraries in its own folder first; the
# shared libraries that it needs, except those of every Linux; and, in licenses, which they are (`table`)
# and their licences. A library that is not in the table is an error.
set(folder "$ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}/kinetri")

# Prints what is done, as CMake's own installation does.
function(copy source name)
  message(STATUS "Installing: ${folder}/${name}")
  cmake_path(GET name PARENT_PATH parent)
  file(MAKE_DIRECTORY "${folder}/${parent}")
  file(COPY_FILE "${source}" "${folder}/${name}" ONLY_IF_DIFFERENT)
endfunction()

cmake_path(GET module FILENAME name)
copy("${module}" ${name})
# Its folder alone: where libraries of the build are elsewhere, their folders were named as well.
file(RPATH_SET FILE "${folder}/${name}" NEW_RPATH "$ORIGIN")
if(strip)
  execute_process(COMMAND ${strip} --strip-unneeded "${folder}/${name}" COMMAND_ERROR_IS_FATAL ANY)
endif()

# Left out are those of the C and C++ compilers, which Python and NumPy need as well.
file(GET_RUNTIME_DEPENDENCIES MODULES "${module}" RESOLVED_DEPENDENCIES_VAR libraries
  UNRESOLVED_DEPENDENCIES_VAR missing
  PRE_EXCLUDE_REGEXES "^(ld-linux|linux-vdso|lib(c|m|dl|rt|pthread|gcc_s|stdc[+][+])[.]so)")
if(missing)
  message(FATAL_ERROR "shared libraries of the Python package were not found: ${missing}")
endif()

copy("${table}" licenses/bundled_libraries.md)
file(READ "${table}" table)
find_program(DPKG_QUERY dpkg-query)
foreach(library IN LISTS libraries)
  cmake_path(GET library FILENAME name)
  string(REGEX REPLACE "[.]so.*" "" short "${name}")
  if(NOT table MATCHES "`${short}`")
    message(FATAL_ERROR
      "the Python package needs ${name}, which python/bundled_libraries.md does not name with its license")
  endif()
  file(REAL_PATH "${library}" file)
  copy("${file}" ${name})
  # Where it is of a Debian package, the texts that go with it there.
  if(DPKG_QUERY)
    # Packages may name it in /lib, which is a link to /usr/lib.
    string(REGEX REPLACE "^/usr/lib/" "/lib/" linked "${file}")
    foreach(path IN ITEMS "${file}" "${linked}")
      execute_process(COMMAND ${DPKG_QUERY} -S "${path}" RESULT_VARIABLE code OUTPUT_VARIABLE owner
        ERROR_QUIET)
      if(code EQUAL 0)
        break()
      endif()
    endforeach()
    string(REGEX REPLACE "[:,].*" "" owner "${owner}")
    if(code EQUAL 0 AND EXISTS /usr/share/doc/${owner}/copyright)
      copy(/usr/share/doc/${owner}/copyright licenses/${short}.txt)
      file(READ /usr/share/doc/${owner}/copyright notice)
      string(REGEX MATCHALL "/usr/share/common-licenses/[A-Za-z0-9.-]*[A-Za-z0-9]" texts "${notice}")
      foreach(text IN LISTS texts)
        cmake_path(GET text FILENAME name)
        copy(${text} licenses/${name}.txt)
      endforeach()
    endif()
  endif()
endforeach()
