// SPDX-License-Identifier: GPL-3.0-or-later
//
// A checkpoint as the source of a run that continues an earlier one.
#ifndef KINETRI_APPS_CHECKPOINT_SOURCE_H
#define KINETRI_APPS_CHECKPOINT_SOURCE_H

#include <memory>
#include <optional>
#include <string>

#include "sources/run_source.h"

namespace kinetri::app {

/// `path` may be "-". `until`: see Run_source::until.
std::unique_ptr<Run_source> checkpoint_source(const std::string& path, std::optional<double> until);

}  // namespace kinetri::app

#endif  // KINETRI_APPS_CHECKPOINT_SOURCE_H
