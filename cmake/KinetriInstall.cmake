# SPDX-License-Identifier: GPL-3.0-or-later
# Installs the libraries, their headers, files for find_package and pkg-config, the programs with manual pages
# and completions, and the documents. No installed file names the prefix, so a copy may be moved.
#
# The components program, development, io and python become Debian packages, which also contain the components
# documentation and zsh (KinetriPackage.cmake). python/CMakeLists.txt and apps/video install their own parts.
option(KINETRI_INSTALL "Install the library" ${PROJECT_IS_TOP_LEVEL})
if(NOT KINETRI_INSTALL)
  return()
endif()

include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/Kinetri)
set(pkgconfig_dir ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
set(bash_dir ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
set(zsh_dir ${CMAKE_INSTALL_DATADIR}/zsh/site-functions)
set(fish_dir ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
set(generated_dir ${PROJECT_BINARY_DIR}/package)

# Runs before all other installation, to record which folders do not exist yet.
if(PROJECT_IS_TOP_LEVEL)
  set(folders ${package_dir} ${pkgconfig_dir} ${bash_dir} ${zsh_dir} ${fish_dir}
    ${CMAKE_INSTALL_BINDIR} ${CMAKE_INSTALL_MANDIR}/man1)
  if(KINETRI_PYTHON)
    list(APPEND folders ${KINETRI_PYTHON_DIR}/kinetri)
  endif()
  set(trees ${PROJECT_SOURCE_DIR}/include/kinetri>${CMAKE_INSTALL_INCLUDEDIR}/kinetri)
  foreach(tree IN ITEMS docs examples)
    list(APPEND trees ${PROJECT_SOURCE_DIR}/${tree}>${CMAKE_INSTALL_DOCDIR}/${tree})
  endforeach()
  install(CODE "set(folders \"${folders}\")
    set(trees \"${trees}\")
    set(record \"${PROJECT_BINARY_DIR}/install_folders.txt\")")
  install(SCRIPT ${PROJECT_SOURCE_DIR}/cmake/install_folders.cmake)
  add_custom_target(uninstall
    COMMAND ${CMAKE_COMMAND} -D MANIFEST=${PROJECT_BINARY_DIR}/install_manifest.txt
      -D FOLDERS=${PROJECT_BINARY_DIR}/install_folders.txt
      -P ${PROJECT_SOURCE_DIR}/cmake/uninstall.cmake
    COMMENT "Removing what was installed" VERBATIM)
endif()

# The libraries. Shared ones are in the component of the program, which needs them.
set_target_properties(kinetri_io PROPERTIES INSTALL_RPATH "$ORIGIN")
foreach(library IN ITEMS "kinetri Targets development" "kinetri_io IoTargets io")
  separate_arguments(library)
  list(POP_FRONT library target targets component)
  install(TARGETS ${target} EXPORT Kinetri${targets}
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT ${component}
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT program NAMELINK_COMPONENT ${component}
    RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
  install(EXPORT Kinetri${targets} NAMESPACE Kinetri:: DESTINATION ${package_dir} COMPONENT ${component})
endforeach()
# Of impl, what public headers include; the rest is for the programs (KinetriAlone.cmake).
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/kinetri DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  COMPONENT development FILES_MATCHING PATTERN "*.h" PATTERN "io" EXCLUDE
  REGEX "/impl/(kinetic/drawn_box_2|observers/(answer_columns|connections|spanning_tree_rows)|simulation/(experiment|playback|wave))\\.h$"
  EXCLUDE)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/kinetri/io
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/kinetri COMPONENT io FILES_MATCHING PATTERN "*.h")
install(FILES ${PROJECT_BINARY_DIR}/include/kinetri/version.h
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/kinetri COMPONENT development)

# find_package(Kinetri). A static Kinetri::io needs its optional libraries when it is linked.
set(kinetri_needed "")
if(NOT BUILD_SHARED_LIBS)
  set(kinetri_needed "${KINETRI_OPTIONAL_LIBRARIES}")
endif()
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/KinetriConfig.cmake.in
  ${generated_dir}/KinetriConfig.cmake INSTALL_DESTINATION ${package_dir}
  NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${generated_dir}/KinetriConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${generated_dir}/KinetriConfig.cmake ${generated_dir}/KinetriConfigVersion.cmake
  ${PROJECT_SOURCE_DIR}/cmake/KinetriBuildType.cmake
  ${PROJECT_SOURCE_DIR}/cmake/KinetriDependencies.cmake
  ${PROJECT_SOURCE_DIR}/cmake/KinetriFindLibrary.cmake
  DESTINATION ${package_dir} COMPONENT development)

# pkg-config. The headers need C++20, and those of CGAL the definitions and options of CGAL's target.
file(RELATIVE_PATH pkgconfig_to_prefix /prefix/${pkgconfig_dir} /prefix)
string(REGEX REPLACE "/$" "" pkgconfig_to_prefix "${pkgconfig_to_prefix}")
set(pkgconfig_requires "gmp mpfr tbb")
string(REPLACE sqlite sqlite3 pkgconfig_io_requires "kinetri;${kinetri_needed}")
list(JOIN pkgconfig_io_requires " " pkgconfig_io_requires)
set(pkgconfig_cflags " ${CMAKE_CXX20_STANDARD_COMPILE_OPTION}")
get_target_property(cgal_definitions CGAL::CGAL INTERFACE_COMPILE_DEFINITIONS)
if("CGAL_USE_GMPXX=1" IN_LIST cgal_definitions)
  string(PREPEND pkgconfig_requires "gmpxx ")
  string(APPEND pkgconfig_cflags " -DCGAL_USE_GMPXX=1")
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  string(APPEND pkgconfig_cflags " -frounding-math")
endif()
foreach(part IN ITEMS "kinetri.pc development" "kinetri-io.pc io")
  separate_arguments(part)
  list(POP_FRONT part file component)
  configure_file(${PROJECT_SOURCE_DIR}/cmake/${file}.in ${generated_dir}/${file} @ONLY)
  install(FILES ${generated_dir}/${file} DESTINATION ${pkgconfig_dir} COMPONENT ${component})
endforeach()

# kinetri_install_page(FILE NAME COMPONENT [OPTIONAL]): a manual page, compressed if there is gzip.
function(kinetri_install_page file name component)
  if(KINETRI_GZIP)
    set(file ${KINETRI_DOCUMENTS_DIR}/${name}.1.gz)
  endif()
  install(FILES ${file} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT ${component} ${ARGN})
endfunction()

# kinetri_install_program(TARGET NAME COMPONENT [OPTIONAL]): a program, with its manual page and completions
# (kinetri_program_documents); OPTIONAL: if it has been built. Completions of zsh are a component of their own.
function(kinetri_install_program target name component)
  # Finds the installed shared library by a relative path.
  if(BUILD_SHARED_LIBS)
    file(RELATIVE_PATH bin_to_lib /prefix/${CMAKE_INSTALL_BINDIR} /prefix/${CMAKE_INSTALL_LIBDIR})
    set_target_properties(${target} PROPERTIES INSTALL_RPATH "$ORIGIN/${bin_to_lib}")
  endif()
  install(TARGETS ${target} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT ${component} ${ARGN})
  kinetri_install_page(${KINETRI_DOCUMENTS_DIR}/${name}.1 ${name} ${component} ${ARGN})
  install(FILES ${KINETRI_DOCUMENTS_DIR}/${name}.bash DESTINATION ${bash_dir} RENAME ${name}
    COMPONENT ${component} ${ARGN})
  install(FILES ${KINETRI_DOCUMENTS_DIR}/_${name} DESTINATION ${zsh_dir} COMPONENT zsh ${ARGN})
  install(FILES ${KINETRI_DOCUMENTS_DIR}/${name}.fish DESTINATION ${fish_dir}
    COMPONENT ${component} ${ARGN})
endfunction()
if(TARGET kinetri_program)
  kinetri_install_program(kinetri_program kinetri program)
endif()

if(TARGET kinetri_verify)
  install(TARGETS kinetri_verify
    RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
  kinetri_install_page(${PROJECT_SOURCE_DIR}/apps/verify/kinetri-verify.1 kinetri-verify program)
endif()

# kinetri_install_documents(DESTINATION OPTION...): README, changelog and citation, guides and examples.
function(kinetri_install_documents destination)
  install(FILES ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/CHANGELOG.md ${PROJECT_SOURCE_DIR}/CITATION.cff
    DESTINATION ${destination} ${ARGN})
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs DESTINATION ${destination} ${ARGN}
    FILES_MATCHING PATTERN "*.md" PATTERN "*.png" PATTERN "*.svg")
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/examples DESTINATION ${destination} ${ARGN}
    PATTERN "__pycache__" EXCLUDE)
endfunction()
kinetri_install_documents(${CMAKE_INSTALL_DOCDIR} COMPONENT documentation)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR}
  COMPONENT documentation)
