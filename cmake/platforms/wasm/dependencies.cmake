# SPDX-License-Identifier: GPL-3.0-or-later
# What cmake/KinetriDependencies.cmake looks for that is headers alone, from the folder KINETRI_SYSROOT: the
# packages of this machine name all of its headers, which are not for WebAssembly. There is no oneTBB.
foreach(name IN ITEMS Boost::headers CGAL::CGAL nlohmann_json::nlohmann_json)
  if(NOT TARGET ${name})
    add_library(${name} INTERFACE IMPORTED GLOBAL)
    target_include_directories(${name} SYSTEM INTERFACE ${KINETRI_SYSROOT}/include)
  endif()
endforeach()
