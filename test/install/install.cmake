# SPDX-License-Identifier: GPL-3.0-or-later
# Installs the build BUILD_DIR in a directory below WORK_DIR, copies that to PREFIX, and uninstalls the
# original: whoever uses PREFIX uses a copy that was moved.
cmake_minimum_required(VERSION 3.25)
set(original ${WORK_DIR}/original)
file(REMOVE_RECURSE ${original} ${PREFIX})

function(install)
  execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${original}
    OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# Uninstalls; then there must be just what is named, folders included, or not even the prefix.
function(uninstall)
  execute_process(COMMAND ${CMAKE_COMMAND} --build ${BUILD_DIR} --target uninstall
    OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
  file(GLOB_RECURSE left LIST_DIRECTORIES true RELATIVE ${original} ${original}/*)
  list(SORT left)
  if(NOT left STREQUAL "${ARGN}" OR (EXISTS ${original} AND NOT left))
    message(SEND_ERROR "uninstall leaves \"${left}\" in ${original}, expected \"${ARGN}\"")
  endif()
endfunction()

# What is there already stays, empty folders and hidden files too; and so does what was there when
# it was installed once more.
file(MAKE_DIRECTORY ${original}/share/fish)
file(WRITE ${original}/include/kinetri/.theirs)
install()
file(WRITE ${original}/bin/theirs)
install()
uninstall(bin bin/theirs include include/kinetri include/kinetri/.theirs share share/fish)
file(REMOVE_RECURSE ${original})

install()
file(COPY ${original}/ DESTINATION ${PREFIX})

# No file may name where it was made; the text files are those that could.
file(GLOB_RECURSE files ${PREFIX}/*.cmake ${PREFIX}/*.pc ${PREFIX}/*.h)
foreach(file IN LISTS files)
  file(READ ${file} text)
  foreach(path IN ITEMS ${original} ${BUILD_DIR} ${SOURCE_DIR})
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
if(EXISTS ${PREFIX}/bin/kinetri)
  execute_process(COMMAND ${PREFIX}/bin/kinetri --version OUTPUT_VARIABLE version
    COMMAND_ERROR_IS_FATAL ANY)
  if(NOT version MATCHES "${VERSION}")
    message(SEND_ERROR "kinetri --version prints \"${version}\", expected ${VERSION}")
  endif()
  foreach(file IN ITEMS man/man1/kinetri.1* bash-completion/completions/kinetri
      zsh/site-functions/_kinetri fish/vendor_completions.d/kinetri.fish)
    file(GLOB found ${PREFIX}/share/${file})
    if(NOT found)
      message(SEND_ERROR "share/${file} was not installed")
    endif()
  endforeach()
endif()

uninstall()
