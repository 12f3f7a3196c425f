// SPDX-License-Identifier: GPL-3.0-or-later
//
// The names of counters in files, for writers and readers.
#ifndef KINETRI_SRC_IO_COUNTERS_H
#define KINETRI_SRC_IO_COUNTERS_H

#include <array>
#include <cstdint>

#include "kinetri/impl/io/json_writer.h"
#include "kinetri/kinetic/certificate.h"
#include "kinetri/simulation/simulation_options.h"
#include "kinetri/triangulation/triangulation_counters.h"

namespace kinetri {

/// A counter of a class of counters, and its name.
template <class Counters>
struct Named_counter {
  const char* name;
  std::uint64_t Counters::*counter;
};

/// Of certificates, all.
inline constexpr std::array<Named_counter<Certificate_counters>, 5> certificate_counters = {{
    {"created", &Certificate_counters::created},
    {"root_solves", &Certificate_counters::root_solves},
    {"filter_decided", &Certificate_counters::filter_decided},
    {"refined_decided", &Certificate_counters::refined_decided},
    {"exact_decided", &Certificate_counters::exact_decided},
}};

/// Of a triangulation, those that do not depend on the number of threads, except the counts by
/// kinds of events.
inline constexpr std::array<Named_counter<Triangulation_counters>, 6> triangulation_counters = {{
    {"instants", &Triangulation_counters::instants},
    {"largest_instant", &Triangulation_counters::largest_instant},
    {"batches", &Triangulation_counters::batches},
    {"flat_hulls", &Triangulation_counters::flat_hulls},
    {"points_set_aside", &Triangulation_counters::points_set_aside},
    {"reconstructions", &Triangulation_counters::reconstructions},
}};

/// Of contacts, those that do not depend on the number of threads.
inline constexpr std::array<Named_counter<Contact_counters>, 2> contact_counters = {{
    {"instants", &Contact_counters::instants},
    {"most_at_one_time", &Contact_counters::most_at_one_time},
}};

/// Of a queue, all.
inline constexpr std::array<Named_counter<Queue_counters>, 3> queue_counters = {{
    {"pushed", &Queue_counters::pushed},
    {"discarded", &Queue_counters::discarded},
    {"peak", &Queue_counters::peak},
}};

/// Writes counters as members of the present object.
template <class Counters, std::size_t n>
void write_counters(Json_writer& json, const Counters& counters,
                    const std::array<Named_counter<Counters>, n>& names) {
  for (const auto& [name, counter] : names) json.member(name, counters.*counter);
}

}  // namespace kinetri

#endif  // KINETRI_SRC_IO_COUNTERS_H
