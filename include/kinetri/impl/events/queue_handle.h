// SPDX-License-Identifier: GPL-3.0-or-later
//
// The handles of the event queue, for those who store handles and need no queue.
#ifndef KINETRI_IMPL_EVENTS_QUEUE_HANDLE_H
#define KINETRI_IMPL_EVENTS_QUEUE_HANDLE_H

#include <cstdint>
#include <limits>

#include "kinetri/base/platform.h"

namespace kinetri {

/// Names an item of an Indexed_queue from its push to its pop or erase; then it may be reused.
using Queue_handle = std::uint32_t;

/// The handle of no item.
inline constexpr Queue_handle no_event = std::numeric_limits<Queue_handle>::max();

}  // namespace kinetri

#endif  // KINETRI_IMPL_EVENTS_QUEUE_HANDLE_H
