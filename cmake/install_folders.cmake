# SPDX-License-Identifier: GPL-3.0-or-later
# `cmake --install` runs this first: adds to the file `record` every folder that the installation will create.
# uninstall.cmake removes these folders and no others.
#
# `folders` has the folders of the installed files; `trees` the source folders that are installed with all
# subfolders, each as SOURCE>DESTINATION.
foreach(tree IN LISTS trees)
  string(REGEX MATCH "^(.*)>(.*)$" tree "${tree}")
  set(source "${CMAKE_MATCH_1}")
  set(destination "${CMAKE_MATCH_2}")
  list(APPEND folders "${destination}")
  file(GLOB_RECURSE entries LIST_DIRECTORIES true RELATIVE "${source}" "${source}/*")
  foreach(entry IN LISTS entries)
    if(IS_DIRECTORY "${source}/${entry}")
      list(APPEND folders "${destination}/${entry}")
    endif()
  endforeach()
endforeach()

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
