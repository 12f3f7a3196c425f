# SPDX-License-Identifier: GPL-3.0-or-later
# Installs the build BUILD_DIR in a directory below WORK_DIR, copies that to PREFIX, and uninstalls the
# original: whoever uses PREFIX uses a copy that was moved. PYTHON is the Python that the package in it
# is for, PYTHON_DIR where that is installed; PYTHON is empty where it is not built.
cmake_minimum_required(VERSION 3.25)
# Folders of others that have the project's name, and a space: their names decide nothing.
set(theirs "${WORK_DIR}/of others/kinetri")
set(original "${theirs}/Kinetri")
file(REMOVE_RECURSE "${theirs}" "${PREFIX}")
# What a run that was interrupted has recorded is about folders that are no longer there.
file(REMOVE "${BUILD_DIR}/install_folders.txt")
file(MAKE_DIRECTORY "${theirs}")

function(install)
  execute_process(COMMAND ${CMAKE_COMMAND} --install "${BUILD_DIR}" --prefix "${original}"
    OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# Uninstalls; then there must be just what is named, folders included, or not even the prefix. The
# folder that the prefix is in always stays.
function(uninstall)
  execute_process(COMMAND ${CMAKE_COMMAND} --build "${BUILD_DIR}" --target uninstall
    OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
  file(GLOB_RECURSE left LIST_DIRECTORIES true RELATIVE "${original}" "${original}/*")
  list(SORT left)
  if(NOT left STREQUAL "${ARGN}" OR (EXISTS "${original}" AND NOT left))
    message(SEND_ERROR "uninstall leaves \"${left}\" in ${original}, expected \"${ARGN}\"")
  endif()
  if(NOT EXISTS "${theirs}")
    message(SEND_ERROR "uninstall removes ${theirs}, which no installation made")
  endif()
endfunction()

# What is there already stays, empty folders and hidden files too; and so does what was there when
# it was installed once more.
file(MAKE_DIRECTORY "${original}/share/fish" "${original}/include/kinetri/events")
file(WRITE "${original}/include/kinetri/.theirs")
install()
file(WRITE "${original}/bin/theirs")
file(MAKE_DIRECTORY "${original}/lib/kinetri")
install()
uninstall(bin bin/theirs include include/kinetri include/kinetri/.theirs include/kinetri/events
  lib lib/kinetri share share/fish)
file(REMOVE_RECURSE "${original}")

# A bracket in the name of a folder is no pattern: the folder is not empty, and stays.
file(WRITE "${theirs}/a[bc]/theirs")
file(WRITE "${theirs}/manifest.txt" "${theirs}/a[bc]/ours\n")
file(WRITE "${theirs}/folders.txt" "${theirs}/a[bc]\n")
execute_process(COMMAND ${CMAKE_COMMAND} -D "MANIFEST=${theirs}/manifest.txt"
  -D "FOLDERS=${theirs}/folders.txt" -P "${SOURCE_DIR}/cmake/uninstall.cmake"
  COMMAND_ERROR_IS_FATAL ANY)
if(NOT EXISTS "${theirs}/a[bc]/theirs")
  message(SEND_ERROR "uninstall removes the folder a[bc] with the file of others in it")
endif()

install()
file(COPY "${original}/" DESTINATION "${PREFIX}")

# No file may name where it was made; the text files are those that could.
file(GLOB_RECURSE files "${PREFIX}/*.cmake" "${PREFIX}/*.pc" "${PREFIX}/*.h")
foreach(file IN LISTS files)
  file(READ "${file}" text)
  foreach(path IN ITEMS "${original}" "${BUILD_DIR}" "${SOURCE_DIR}")
    string(FIND "${text}" "${path}" position)
    if(NOT position EQUAL -1)
      message(SEND_ERROR "${file} names ${path}")
    endif()
  endforeach()
  if(file MATCHES "\\.(cmake|pc)$" AND text MATCHES "[;\" ](/[^;\" ]*\\.(so|a))[;\" ]")
    message(SEND_ERROR "${file} names the library ${CMAKE_MATCH_1}")
  endif()
endforeach()

# An installed program runs, and what belongs to it is there.
foreach(program IN ITEMS kinetri kinetri-video)
  if(NOT EXISTS "${PREFIX}/bin/${program}")
    continue()
  endif()
  execute_process(COMMAND "${PREFIX}/bin/${program}" --version OUTPUT_VARIABLE version
    COMMAND_ERROR_IS_FATAL ANY)
  if(NOT version MATCHES "^${program} ${VERSION}")
    message(SEND_ERROR "${program} --version prints \"${version}\", expected ${program} ${VERSION}")
  endif()
  foreach(file IN ITEMS man/man1/${program}.1* bash-completion/completions/${program}
      zsh/site-functions/_${program} fish/vendor_completions.d/${program}.fish)
    file(GLOB found "${PREFIX}/share/${file}")
    if(NOT found)
      message(SEND_ERROR "share/${file} was not installed")
    endif()
  endforeach()
endforeach()

# So does the Python package, and what Python has compiled of it goes as well.
if(PYTHON)
  foreach(prefix IN ITEMS "${PREFIX}" "${original}")
    execute_process(COMMAND ${CMAKE_COMMAND} -E env --unset=PYTHONDONTWRITEBYTECODE
      --unset=PYTHONPYCACHEPREFIX "PYTHONPATH=${prefix}/${PYTHON_DIR}"
      ${PYTHON} -c "import kinetri; print(kinetri.__file__, kinetri.__version__, kinetri.Time(0.5))"
      WORKING_DIRECTORY "${theirs}" OUTPUT_VARIABLE output COMMAND_ERROR_IS_FATAL ANY)
    set(expected "${prefix}/${PYTHON_DIR}/kinetri/__init__.py ${VERSION} Time(0.5)\n")
    if(NOT output STREQUAL expected)
      message(SEND_ERROR "the Python package prints \"${output}\", expected \"${expected}\"")
    endif()
    file(GLOB compiled "${prefix}/${PYTHON_DIR}/kinetri/__pycache__/*.pyc")
    if(NOT compiled)
      message(SEND_ERROR "Python has compiled nothing in ${prefix}, so that nothing of it can be left")
    endif()
  endforeach()
elseif(EXISTS "${PREFIX}/${PYTHON_DIR}/kinetri")
  message(SEND_ERROR "the Python package is installed, which was not built")
endif()

uninstall()
