// SPDX-License-Identifier: GPL-3.0-or-later
//
// The color of each kind of event: the one table for the viewer's page, the plots of the program,
// and the Python package.
#ifndef KINETRI_EVENTS_EVENT_COLOR_H
#define KINETRI_EVENTS_EVENT_COLOR_H

#include <string_view>

#include "kinetri/impl/events/basic_event.h"

namespace kinetri {

/// The color of the kind in every picture, as `#rrggbb` in sRGB. Its contrast with the page, light
/// or dark, is at least 3 : 1 (WCAG 2.2, success criterion 1.4.11), and no two kinds look the same
/// with protanopia, deuteranopia or tritanopia. Constant time.
std::string_view color(Event_kind kind);

}  // namespace kinetri

#endif  // KINETRI_EVENTS_EVENT_COLOR_H
