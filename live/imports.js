// SPDX-License-Identifier: GPL-3.0-or-later
//
// For Emscripten's linker: what the module imports besides system calls. live/kinetri.mjs has these functions.
mergeInto(LibraryManager.library, {kinetri_digits() {}});
