# SPDX-License-Identifier: GPL-3.0-or-later
# Removes the files that the last `cmake --install` wrote, which MANIFEST lists, and then those folders
# that an installation made, which FOLDERS lists, as far as they are empty. The name of a folder decides
# nothing.
cmake_minimum_required(VERSION 3.25)
if(NOT EXISTS "${MANIFEST}")
  message(FATAL_ERROR "${MANIFEST} does not exist: nothing was installed from this build; expected cmake --install before")
endif()
file(STRINGS "${MANIFEST}" files)
foreach(file IN LISTS files)
  set(path "$ENV{DESTDIR}${file}")
  file(REMOVE "${path}")
  if(EXISTS "${path}" OR IS_SYMLINK "${path}")
    message(FATAL_ERROR
      "${path} cannot be removed; expected the rights of the user who installed it (sudo?)")
  endif()
endforeach()

set(folders)
if(EXISTS "${FOLDERS}")
  file(STRINGS "${FOLDERS}" folders)
endif()
# A folder follows its subfolders.
list(SORT folders ORDER DESCENDING)
foreach(folder IN LISTS folders)
  string(REPLACE "[" "[[]" literal "${folder}")  # A bracket in a name begins no pattern.
  file(GLOB contents "${literal}/*")
  if(IS_DIRECTORY "${folder}" AND NOT IS_SYMLINK "${folder}" AND NOT contents)
    file(REMOVE_RECURSE "${folder}")
  endif()
endforeach()
file(REMOVE "${MANIFEST}" "${FOLDERS}")
