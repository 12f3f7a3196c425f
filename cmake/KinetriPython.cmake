# SPDX-License-Identifier: GPL-3.0-or-later
# Whether the Python package can be built: needs Python with its headers, NumPy and pybind11. Sets
# kinetri_python_default and the variables of find_package(Python) and find_package(pybind11).

# Unless Python_EXECUTABLE is set: the first Python with NumPy, of that on the PATH and that of the system.
function(kinetri_find_python)
  if(Python_EXECUTABLE)
    return()
  endif()
  find_program(python_on_path python3 NO_CACHE)
  foreach(candidate IN ITEMS ${python_on_path} /usr/bin/python3)
    execute_process(COMMAND ${candidate} -c "import numpy" RESULT_VARIABLE result OUTPUT_QUIET ERROR_QUIET)
    if(result EQUAL 0)
      set(Python_EXECUTABLE ${candidate} CACHE FILEPATH "The Python that the package is built for")
      return()
    endif()
  endforeach()
endfunction()

set(kinetri_python_default OFF)
if(PROJECT_IS_TOP_LEVEL OR KINETRI_PYTHON)
  kinetri_find_python()
  find_package(Python COMPONENTS Interpreter Development.Module NumPy QUIET)
  if(Python_FOUND)
    find_package(pybind11 2.10 CONFIG QUIET)
  endif()
  # A Python that is not itself sanitized cannot load a sanitized module.
  if(Python_FOUND AND pybind11_FOUND AND NOT KINETRI_SANITIZE)
    set(kinetri_python_default ON)
  elseif(KINETRI_PYTHON)
    message(FATAL_ERROR "KINETRI_PYTHON is ON, but Python's headers, NumPy or pybind11 are missing, or "
      "KINETRI_SANITIZE is set; on Debian: apt-get install python3-dev python3-numpy pybind11-dev; "
      "Python_EXECUTABLE=/path/to/python3 takes another Python, KINETRI_PYTHON=OFF none")
  endif()
endif()

# Debian's Python searches PREFIX/lib/python3/dist-packages.
set(KINETRI_PYTHON_DIR lib/python3/dist-packages CACHE STRING
  "Where the Python package is installed, below the prefix")
mark_as_advanced(KINETRI_PYTHON_DIR)
