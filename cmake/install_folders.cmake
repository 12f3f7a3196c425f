# SPDX-License-Identifier: GPL-3.0-or-later
# Run by `cmake --install` before it installs anything: adds to the file `record` those of the folders
# `folders`, and of the ones they are in, that are not there and so will be made. uninstall.cmake
# removes them.
set(made)
if(EXISTS "${record}")
  file(STRINGS "${record}" made)
endif()
foreach(folder IN LISTS folders)
  cmake_path(ABSOLUTE_PATH folder BASE_DIRECTORY "${CMAKE_INSTALL_PREFIX}" NORMALIZE)
  set(folder "$ENV{DESTDIR}${folder}")
  while(folder AND NOT EXISTS "${folder}")
    list(APPEND made "${folder}")
    cmake_path(GET folder PARENT_PATH folder)
  endwhile()
endforeach()
list(REMOVE_DUPLICATES made)
list(JOIN made "\n" made)
file(WRITE "${record}" "${made}")
