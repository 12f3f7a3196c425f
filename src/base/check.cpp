// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/impl/base/check.h"

#include <string>
#include <string_view>

#include "kinetri/base/error.h"

namespace kinetri::detail {
namespace {

// The file name without folders: messages must not depend on where the library was built.
std::string location(std::string_view file, int line) {
  const std::size_t slash = file.find_last_of('/');
  if (slash != std::string_view::npos) file.remove_prefix(slash + 1);
  return std::string(file) + ":" + std::to_string(line);
}

}  // namespace

void precondition_failed(const char* condition, const char* message, const char* file, int line) {
  throw Precondition_error(std::string("precondition violated: ") + message + " (expected " +
                           condition + "; " + location(file, line) + ")");
}

void assertion_failed(const char* condition, const char* message, const char* file, int line) {
  throw Internal_error(std::string("internal check failed: ") + message + " (expected " +
                       condition + "; " + location(file, line) +
                       "); please report this with the input that caused it");
}

}  // namespace kinetri::detail
