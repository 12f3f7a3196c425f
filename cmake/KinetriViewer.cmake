# SPDX-License-Identifier: GPL-3.0-or-later
# Makes the C++ source with the files of the viewer page (viewer/). One literal for each file, since compilers
# need not accept literals longer than 65 536 bytes.
function(kinetri_viewer_assets output)
  set(folder ${PROJECT_SOURCE_DIR}/viewer)
  file(STRINGS ${folder}/scripts.txt scripts)
  foreach(name IN ITEMS page.html style.css scripts.txt LISTS scripts)
    set_property(DIRECTORY ${PROJECT_SOURCE_DIR} APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS
      ${folder}/${name})
  endforeach()
  file(READ ${folder}/page.html KINETRI_VIEWER_page.html)
  file(READ ${folder}/style.css KINETRI_VIEWER_style.css)
  list(LENGTH scripts KINETRI_VIEWER_SCRIPTS)
  set(KINETRI_VIEWER_SCRIPT_LITERALS)
  foreach(name IN LISTS scripts)
    file(READ ${folder}/${name} script)
    string(APPEND KINETRI_VIEWER_SCRIPT_LITERALS "\nR\"kinetri(${script})kinetri\",")
  endforeach()
  configure_file(${PROJECT_SOURCE_DIR}/cmake/viewer_assets.cpp.in ${output} @ONLY)
endfunction()
