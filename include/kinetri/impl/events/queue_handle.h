// SPDX-License-Identifier: GPL-3.0-or-later
//
// The handles of the event queue, for code that stores handles and needs no queue.
#ifndef KINETRI_IMPL_EVENTS_QUEUE_HANDLE_H
#define KINETRI_IMPL_EVENTS_QUEUE_HANDLE_H

#include <cstdint>
#include <limits>

#include "kinetri/base/platform.h"

namespace kinetri {

/// A handle of an item of an Indexed_queue; reused after the item has left.
using Queue_handle = std::uint32_t;

inline constexpr Queue_handle no_event = std::numeric_limits<Queue_handle>::max();

}  // namespace kinetri

#endif  // KINETRI_IMPL_EVENTS_QUEUE_HANDLE_H
