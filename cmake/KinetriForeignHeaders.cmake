# SPDX-License-Identifier: GPL-3.0-or-later
# Precompiled headers of CGAL and Boost. Reading these takes most of the time of compiling a small source. They
# are used only for sources that include all of them, so that a missing include is still an error.

# kinetri_includes(FILE RESULT): the direct includes of the file.
function(kinetri_includes file result)
  get_property(is_known GLOBAL PROPERTY "kinetri_includes_${file}" SET)
  if(NOT is_known)
    file(STRINGS ${file} lines REGEX "^#include [\"<]")
    list(TRANSFORM lines REPLACE "^#include [\"<]([^\">]+)[\">].*$" "\\1")
    set_property(GLOBAL PROPERTY "kinetri_includes_${file}" "${lines}")
  endif()
  get_property(lines GLOBAL PROPERTY "kinetri_includes_${file}")
  set(${result} ${lines} PARENT_SCOPE)
endfunction()

# kinetri_foreign_headers(FILE RESULT): the headers of CGAL and Boost that the file includes directly or through
# the project's headers, as <NAME>.
function(kinetri_foreign_headers file result)
  set(files ${file})
  set(seen ${file})
  set(found)
  while(files)
    list(POP_FRONT files next)
    kinetri_includes(${next} names)
    foreach(name IN LISTS names)
      if(name MATCHES "^(CGAL|boost)/")
        list(APPEND found "<${name}>")
        continue()
      endif()
      foreach(folder IN ITEMS include src)
        set(header ${PROJECT_SOURCE_DIR}/${folder}/${name})
        if(EXISTS ${header} AND NOT header IN_LIST seen)
          list(APPEND files ${header})
          list(APPEND seen ${header})
        endif()
      endforeach()
    endforeach()
  endwhile()
  list(REMOVE_DUPLICATES found)
  set(${result} ${found} PARENT_SCOPE)
endfunction()

# Those of headers about triangulations, and of headers about algebraic numbers.
kinetri_foreign_headers(${PROJECT_SOURCE_DIR}/include/kinetri/triangulation/kinetic_triangulation_2.h
  KINETRI_TRIANGULATION_FOREIGN_HEADERS)
kinetri_foreign_headers(${PROJECT_SOURCE_DIR}/include/kinetri/algebra/algebraic_number.h
  KINETRI_ALGEBRA_FOREIGN_HEADERS)

# kinetri_includes_all(FILE RESULT HEADER...): whether the file includes all these headers.
function(kinetri_includes_all file result)
  kinetri_foreign_headers(${file} found)
  set(missing ${ARGN})
  list(REMOVE_ITEM missing ${found})
  if(missing)
    set(${result} OFF PARENT_SCOPE)
  else()
    set(${result} ON PARENT_SCOPE)
  endif()
endfunction()

# kinetri_use_precompiled(TARGET HEADER...): uses the target's precompiled headers, which are these, for those of
# its sources that include all of them.
function(kinetri_use_precompiled target)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${target} PRIVATE -fpch-preprocess)  # ccache needs it.
  endif()
  get_target_property(sources ${target} SOURCES)
  get_target_property(folder ${target} SOURCE_DIR)
  foreach(source IN LISTS sources)
    cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${folder} OUTPUT_VARIABLE path)
    set(all OFF)
    if(EXISTS ${path})
      kinetri_includes_all(${path} all ${ARGN})
    endif()
    if(NOT all)
      set_source_files_properties(${source} TARGET_DIRECTORY ${target}
        PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
    endif()
  endforeach()
endfunction()

# kinetri_precompile(TARGET HEADER...): precompiles these headers, and uses them for those of the target's sources
# that include all of them.
function(kinetri_precompile target)
  target_precompile_headers(${target} PRIVATE ${ARGN})
  kinetri_use_precompiled(${target} ${ARGN})
endfunction()
