// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/events/event.h"

namespace kinetri {

std::string_view name(Event_kind kind) {
  switch (kind) {
    case Event_kind::rebuild:
      return "rebuild";
    case Event_kind::hull_insert:
      return "hull_insert";
    case Event_kind::hull_remove:
      return "hull_remove";
    case Event_kind::flip:
      return "flip";
    case Event_kind::hide:
      return "hide";
    case Event_kind::reveal:
      return "reveal";
    case Event_kind::wall:
      return "wall";
    case Event_kind::collision:
      return "collision";
    case Event_kind::insert:
      return "insert";
    case Event_kind::erase:
      return "erase";
    case Event_kind::trajectory:
      return "trajectory";
  }
  return "unknown";
}

}  // namespace kinetri
