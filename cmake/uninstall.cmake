# SPDX-License-Identifier: GPL-3.0-or-later
# Removes the files that the last `cmake --install` wrote, which MANIFEST lists, with what Python has
# compiled of them, and then those folders that an installation made, which FOLDERS lists, as far as they
# are empty. The name of a folder decides nothing.
cmake_minimum_required(VERSION 3.25)

# Sets `result` to the pattern of that path: a bracket in a name begins no pattern.
function(pattern_of path result)
  string(REPLACE "[" "[[]" pattern "${path}")
  set(${result} "${pattern}" PARENT_SCOPE)
endfunction()

if(NOT EXISTS "${MANIFEST}")
  message(FATAL_ERROR "${MANIFEST} does not exist: nothing was installed from this build; expected cmake --install before")
endif()
file(STRINGS "${MANIFEST}" files)
set(folders)
foreach(file IN LISTS files)
  set(path "$ENV{DESTDIR}${file}")
  file(REMOVE "${path}")
  if(EXISTS "${path}" OR IS_SYMLINK "${path}")
    message(FATAL_ERROR
      "${path} cannot be removed; expected the rights of the user who installed it (sudo?)")
  endif()
  if(path MATCHES "\\.py$")
    cmake_path(GET path PARENT_PATH folder)
    cmake_path(GET path STEM LAST_ONLY module)
    pattern_of("${folder}/__pycache__" compiled)
    file(GLOB compiled "${compiled}/${module}.*.pyc")
    if(compiled)
      file(REMOVE ${compiled})
      list(APPEND folders "${folder}/__pycache__")
    endif()
  endif()
endforeach()

if(EXISTS "${FOLDERS}")
  file(STRINGS "${FOLDERS}" made)
  list(APPEND folders ${made})
endif()
list(REMOVE_DUPLICATES folders)
# A folder follows its subfolders.
list(SORT folders ORDER DESCENDING)
foreach(folder IN LISTS folders)
  pattern_of("${folder}" literal)
  file(GLOB contents "${literal}/*")
  if(IS_DIRECTORY "${folder}" AND NOT IS_SYMLINK "${folder}" AND NOT contents)
    file(REMOVE_RECURSE "${folder}")
  endif()
endforeach()
file(REMOVE "${MANIFEST}" "${FOLDERS}")
