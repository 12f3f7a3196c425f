# SPDX-License-Identifier: GPL-3.0-or-later
# Whether the program kinetri-video can be built, as kinetri is: OpenCV (core, imgproc, video), libpng and zstd are
# there. Sets kinetri_video_default, and defines Kinetri::opencv_core, _imgproc, _video, Kinetri::png and
# Kinetri::zstd where they are.
set(kinetri_video_default OFF)
if((PROJECT_IS_TOP_LEVEL AND KINETRI_BUILD_PROGRAM) OR KINETRI_VIDEO)
  set(kinetri_video_missing "")
  # kinetri_video_library(NAME HEADER LIBRARY PACKAGE)
  macro(kinetri_video_library name header library package)
    string(TOUPPER ${name} variable)
    find_path(KINETRI_${variable}_INCLUDE_DIR ${header} PATH_SUFFIXES opencv4)
    find_library(KINETRI_${variable}_LIBRARY ${library})
    mark_as_advanced(KINETRI_${variable}_INCLUDE_DIR KINETRI_${variable}_LIBRARY)
    if(KINETRI_${variable}_INCLUDE_DIR AND KINETRI_${variable}_LIBRARY)
      if(NOT TARGET Kinetri::${name})
        add_library(Kinetri::${name} UNKNOWN IMPORTED)
        set_target_properties(Kinetri::${name} PROPERTIES
          IMPORTED_LOCATION "${KINETRI_${variable}_LIBRARY}"
          INTERFACE_INCLUDE_DIRECTORIES "${KINETRI_${variable}_INCLUDE_DIR}")
      endif()
    else()
      list(APPEND kinetri_video_missing ${package})
    endif()
  endmacro()
  kinetri_video_library(opencv_core opencv2/core.hpp opencv_core libopencv-core-dev)
  kinetri_video_library(opencv_imgproc opencv2/imgproc.hpp opencv_imgproc libopencv-imgproc-dev)
  kinetri_video_library(opencv_video opencv2/video/tracking.hpp opencv_video libopencv-video-dev)
  kinetri_video_library(png png.h png libpng-dev)
  kinetri_video_library(zstd zstd.h zstd libzstd-dev)
  list(JOIN kinetri_video_missing " " kinetri_video_missing)
  # As a library that is not sanitized, OpenCV hides from a sanitizer what it does.
  if(kinetri_video_missing STREQUAL "" AND NOT KINETRI_SANITIZE STREQUAL "thread")
    set(kinetri_video_default ON)
  elseif(KINETRI_VIDEO)
    message(FATAL_ERROR "KINETRI_VIDEO is ON, but libraries are missing, or KINETRI_SANITIZE is thread; on "
      "Debian: apt-get install ${kinetri_video_missing}; KINETRI_VIDEO=OFF builds without kinetri-video")
  elseif(NOT kinetri_video_missing STREQUAL "")
    message(STATUS "Kinetri: kinetri-video is not built; it needs (Debian): ${kinetri_video_missing}")
  endif()
endif()
