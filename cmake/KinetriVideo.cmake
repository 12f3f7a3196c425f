# SPDX-License-Identifier: GPL-3.0-or-later
# Whether the program kinetri-video can be built: needs OpenCV (core, imgproc, video), libpng and zstd. Sets
# kinetri_video_default, and defines Kinetri::opencv_core, _imgproc, _video, Kinetri::png and Kinetri::zstd if
# they are found.
set(kinetri_video_default OFF)
if((PROJECT_IS_TOP_LEVEL AND KINETRI_BUILD_PROGRAM) OR KINETRI_VIDEO)
  set(kinetri_video_missing "")
  include(${CMAKE_CURRENT_LIST_DIR}/KinetriFindLibrary.cmake)
  foreach(part IN ITEMS core:core imgproc:imgproc video:video/tracking)
    string(REGEX MATCH "^(.+):(.+)$" part ${part})
    set(part ${CMAKE_MATCH_1})
    kinetri_find_library(opencv_${part} opencv2/${CMAKE_MATCH_2}.hpp opencv_${part} opencv4)
    if(NOT TARGET Kinetri::opencv_${part})
      list(APPEND kinetri_video_missing libopencv-${part}-dev)
    endif()
  endforeach()
  foreach(name IN ITEMS png zstd)
    kinetri_find_library(${name} ${name}.h ${name})
    if(NOT TARGET Kinetri::${name})
      list(APPEND kinetri_video_missing lib${name}-dev)
    endif()
  endforeach()
  list(JOIN kinetri_video_missing " " kinetri_video_missing)
  # OpenCV is not sanitized, so ThreadSanitizer does not see its synchronization.
  if(kinetri_video_missing STREQUAL "" AND NOT KINETRI_SANITIZE STREQUAL "thread")
    set(kinetri_video_default ON)
  elseif(KINETRI_VIDEO)
    message(FATAL_ERROR "KINETRI_VIDEO is ON, but libraries are missing, or KINETRI_SANITIZE is thread; on "
      "Debian: apt-get install ${kinetri_video_missing}; KINETRI_VIDEO=OFF builds without kinetri-video")
  elseif(NOT kinetri_video_missing STREQUAL "")
    message(STATUS "Kinetri: kinetri-video is not built; it needs (Debian): ${kinetri_video_missing}")
  endif()
endif()
