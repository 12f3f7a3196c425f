# SPDX-License-Identifier: GPL-3.0-or-later
# Installs the library, its headers, and what find_package and pkg-config need to find it. Nothing that
# is installed names the place it is installed in: the copy may be moved.
option(KINETRI_INSTALL "Install the library" ${PROJECT_IS_TOP_LEVEL})
if(NOT KINETRI_INSTALL)
  return()
endif()

include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/Kinetri)
set(generated_dir ${PROJECT_BINARY_DIR}/package)

install(TARGETS kinetri EXPORT KinetriTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
  RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/kinetri DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  FILES_MATCHING PATTERN "*.h")
install(FILES ${PROJECT_BINARY_DIR}/include/kinetri/version.h
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/kinetri)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

# find_package(Kinetri).
install(EXPORT KinetriTargets NAMESPACE Kinetri:: DESTINATION ${package_dir})
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/KinetriConfig.cmake.in
  ${generated_dir}/KinetriConfig.cmake INSTALL_DESTINATION ${package_dir}
  NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${generated_dir}/KinetriConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${generated_dir}/KinetriConfig.cmake ${generated_dir}/KinetriConfigVersion.cmake
  ${PROJECT_SOURCE_DIR}/cmake/KinetriDependencies.cmake DESTINATION ${package_dir})

# pkg-config. CGAL's headers depend on a definition and an option that its target carries.
file(RELATIVE_PATH pkgconfig_to_prefix
  /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)
string(REGEX REPLACE "/$" "" pkgconfig_to_prefix "${pkgconfig_to_prefix}")
set(pkgconfig_requires "gmp mpfr tbb")
set(pkgconfig_cflags "")
get_target_property(cgal_definitions CGAL::CGAL INTERFACE_COMPILE_DEFINITIONS)
if("CGAL_USE_GMPXX=1" IN_LIST cgal_definitions)
  string(PREPEND pkgconfig_requires "gmpxx ")
  string(APPEND pkgconfig_cflags " -DCGAL_USE_GMPXX=1")
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  string(APPEND pkgconfig_cflags " -frounding-math")
endif()
configure_file(${PROJECT_SOURCE_DIR}/cmake/kinetri.pc.in ${generated_dir}/kinetri.pc @ONLY)
install(FILES ${generated_dir}/kinetri.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

# An installed program finds an installed shared library next to it.
if(TARGET kinetri_program AND BUILD_SHARED_LIBS)
  file(RELATIVE_PATH bin_to_lib /prefix/${CMAKE_INSTALL_BINDIR} /prefix/${CMAKE_INSTALL_LIBDIR})
  set_target_properties(kinetri_program PROPERTIES INSTALL_RPATH "$ORIGIN/${bin_to_lib}")
endif()

if(PROJECT_IS_TOP_LEVEL)
  add_custom_target(uninstall
    COMMAND ${CMAKE_COMMAND} -D MANIFEST=${PROJECT_BINARY_DIR}/install_manifest.txt
      -P ${PROJECT_SOURCE_DIR}/cmake/uninstall.cmake
    COMMENT "Removing what was installed" VERBATIM)
endif()
