// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/events/event.h"

namespace kinetri {

// Blue, green and vermillion are those of Okabe and Ito (Color universal design, 2008). The others
// were found by a search that maximizes the least difference of two colors for all kinds of color
// vision (test/events/event_color_test.cpp), at a lightness that is legible on light and on dark.
std::string_view color(Event_kind kind) {
  switch (kind) {
    case Event_kind::rebuild:
      return "#727bd4";
    case Event_kind::hull_insert:
      return "#009e73";
    case Event_kind::hull_remove:
      return "#a24b8c";
    case Event_kind::flip:
      return "#0072b2";
    case Event_kind::hide:
      return "#8e88b8";
    case Event_kind::reveal:
      return "#ed5699";
    case Event_kind::wall:
      return "#796d57";
    case Event_kind::collision:
      return "#d55e00";
    case Event_kind::insert:
      return "#008fff";
    case Event_kind::erase:
      return "#c13a18";
    case Event_kind::trajectory:
      return "#7b54de";
  }
  return "#000000";
}

}  // namespace kinetri
