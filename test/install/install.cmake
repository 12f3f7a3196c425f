# SPDX-License-Identifier: GPL-3.0-or-later
# Installs the build BUILD_DIR in a directory below WORK_DIR, copies that to PREFIX, and uninstalls the
# original: whoever uses PREFIX uses a copy that was moved.
set(original ${WORK_DIR}/original)
file(REMOVE_RECURSE ${original} ${PREFIX})

execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${original}
  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
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

# An installed program runs.
if(EXISTS ${PREFIX}/bin/kinetri)
  execute_process(COMMAND ${PREFIX}/bin/kinetri --version OUTPUT_VARIABLE version
    COMMAND_ERROR_IS_FATAL ANY)
  if(NOT version MATCHES "${VERSION}")
    message(SEND_ERROR "kinetri --version prints \"${version}\", expected ${VERSION}")
  endif()
endif()

execute_process(COMMAND ${CMAKE_COMMAND} --build ${BUILD_DIR} --target uninstall
  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
file(GLOB_RECURSE left ${original}/*)
if(left OR EXISTS ${original}/include/kinetri)
  message(SEND_ERROR "uninstall left ${left} or a folder of its own")
endif()
