# SPDX-License-Identifier: GPL-3.0-or-later
# 64-bit ARM, with Debian's cross compiler and user-mode emulation. KINETRI_SYSROOT is the folder that
# scripts/platform.sh fills with the libraries of that architecture.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)
set(CMAKE_FIND_ROOT_PATH ${KINETRI_SYSROOT} /usr/aarch64-linux-gnu)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64 -L /usr/aarch64-linux-gnu
  -E LD_LIBRARY_PATH=${KINETRI_SYSROOT}/usr/lib/aarch64-linux-gnu)
# Checks of the compiler are separate projects, which get only these variables.
set(CMAKE_TRY_COMPILE_PLATFORM_VARIABLES KINETRI_SYSROOT)
