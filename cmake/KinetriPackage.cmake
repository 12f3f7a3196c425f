# SPDX-License-Identifier: GPL-3.0-or-later
# Debian packages, made by `cpack` in a build directory: kinetri, the program; libkinetri-dev and
# libkinetri-io-dev, the static libraries with their headers; and python3-kinetri, if the Python package is
# built. There is no package with a shared library, since versions before 1.0 have no stable binary interface.
if(NOT PROJECT_IS_TOP_LEVEL OR NOT KINETRI_INSTALL OR NOT TARGET kinetri_program)
  return()
endif()
if(BUILD_SHARED_LIBS)
  file(WRITE ${PROJECT_BINARY_DIR}/CPackConfig.cmake
    "message(FATAL_ERROR \"Packages hold the static library; expected a build with "
    "BUILD_SHARED_LIBS=OFF\")\n")
  return()
endif()

# Distributors set their own name: -DCPACK_PACKAGE_CONTACT="Name <address>".
if(NOT CPACK_PACKAGE_CONTACT)
  set(CPACK_PACKAGE_CONTACT "Kinetri <kinetri@example.org>")
endif()
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME kinetri)
set(CPACK_PACKAGE_VENDOR Kinetri)
set(CPACK_COMPONENTS_ALL program development io)
if(KINETRI_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME kinetri)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION math)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS gnuplot-nox)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
  "Keeps the Delaunay triangulation of moving points in the plane exactly right
through time, and logs its events: every decision is the one that exact
arithmetic makes. Simulates points and colliding discs, recorded tracks, and
random scenarios; writes event logs, pictures, and pages that play a run.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libkinetri-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
  "libboost-dev, libcgal-dev (>= 5.5), libgmp-dev, libmpfr-dev, libtbb-dev")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS "cmake, pkg-config")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
  "A C++20 library on top of CGAL's Delaunay_triangulation_2. This package holds
the static library and its headers, and what CMake and pkg-config need to find
them.")

set(CPACK_DEBIAN_IO_PACKAGE_NAME libkinetri-io-dev)
set(CPACK_DEBIAN_IO_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_IO_PACKAGE_DEPENDS
  "libkinetri-dev (= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})")
foreach(dependency IN ITEMS sqlite=libsqlite3-dev expat=libexpat1-dev)
  string(REGEX MATCH "^([a-z]+)=(.*)$" dependency ${dependency})
  if(CMAKE_MATCH_1 IN_LIST KINETRI_OPTIONAL_LIBRARIES)
    string(APPEND CPACK_DEBIAN_IO_PACKAGE_DEPENDS ", ${CMAKE_MATCH_2}")
  endif()
endforeach()
set(CPACK_COMPONENT_IO_DESCRIPTION
  "Files and formats for the C++ library Kinetri: points, recorded tracks, event
logs, checkpoints, pictures and pages. This package holds the static library
and its headers, and what CMake and pkg-config need to find them.")

if(KINETRI_PYTHON)
  # The module is for one version of Python.
  math(EXPR next "${Python_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-kinetri)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.${Python_VERSION_MINOR}~), python3 (<< 3.${next}~), \
python3-numpy")
  # It is also for one version of NumPy's binary interface.
  if(EXISTS /usr/share/numpy3/versions)
    file(STRINGS /usr/share/numpy3/versions abi REGEX "^abi [0-9]+$")
    string(REPLACE "abi " ", python3-numpy-abi" abi "${abi}")
    string(APPEND CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "${abi}")
  endif()
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS
    "python3-distributed, python3-matplotlib, python3-pandas, python3-tqdm")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
    ${PROJECT_SOURCE_DIR}/cmake/debian/postinst ${PROJECT_SOURCE_DIR}/cmake/debian/prerm)
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION
    "Keeps the Delaunay triangulation of moving points in the plane exactly right
through time: NumPy arrays in, NumPy arrays out. Simulates points and colliding
discs of any size, and recorded tracks, runs parameter studies on several
machines, and shows runs in notebooks.")
endif()

# Files that Debian requires in every package, and files that it has in other places.
set(debian_dir ${PROJECT_SOURCE_DIR}/cmake/debian)
set(files ${debian_dir}/copyright)
if(KINETRI_GZIP)
  set(version ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})
  string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
  configure_file(${debian_dir}/changelog ${generated_dir}/changelog @ONLY)
  list(APPEND files ${generated_dir}/changelog.Debian.gz)
  execute_process(COMMAND ${KINETRI_GZIP} -9nc ${generated_dir}/changelog
    OUTPUT_FILE ${generated_dir}/changelog.Debian.gz COMMAND_ERROR_IS_FATAL ANY)
endif()
foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER ${component} name)
  set(folder ${CMAKE_INSTALL_DATADIR}/doc/${CPACK_DEBIAN_${name}_PACKAGE_NAME})
  install(FILES ${files} DESTINATION ${folder} COMPONENT ${component} EXCLUDE_FROM_ALL)
endforeach()
kinetri_install_documents(${CMAKE_INSTALL_DATADIR}/doc/${CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME}
  COMPONENT development EXCLUDE_FROM_ALL)
install(FILES ${KINETRI_DOCUMENTS_DIR}/_kinetri
  DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions COMPONENT program EXCLUDE_FROM_ALL)
install(FILES ${debian_dir}/lintian-overrides DESTINATION ${CMAKE_INSTALL_DATADIR}/lintian/overrides
  RENAME libkinetri-dev COMPONENT development EXCLUDE_FROM_ALL)
include(CPack)
