// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <optional>
#include <ostream>
#include <utility>

#include "checkpoint_format.h"
#include "checkpoint_motion.h"
#include "counters.h"
#include "kinetri/impl/base/check.h"
#include "kinetri/impl/io/json_writer.h"
#include "kinetri/impl/io/output_file.h"
#include "kinetri/impl/io/text.h"
#include "kinetri/io/checkpoint_file.h"

namespace kinetri {
namespace {

void write(Json_writer& json, const Algebraic_number& time) {
  if (time.is_known_rational()) return json.value(time.rational().str());
  json.begin_object();
  json.key("root_of");
  json.begin_list();
  const Polynomial polynomial = time.polynomial();
  for (const Integer& c : polynomial.coefficients()) json.value(c.str());
  json.end_list();
  const Rational_interval between = time.isolating_interval();
  json.key("between");
  json.begin_list();
  json.value(between.lower.str());
  json.value(between.upper.str());
  json.end_list();
  json.end_object();
}

template <class List>
void write_list(Json_writer& json, const List& list) {
  json.begin_list();
  for (const auto& element : list) json.value(element);
  json.end_list();
}

template <class Counters, std::size_t n>
void write(Json_writer& json, const Counters& counters,
           const std::array<Named_counter<Counters>, n>& names) {
  json.begin_object();
  write_counters(json, counters, names);
  json.end_object();
}

void write(Json_writer& json, const Triangulation_counters& counters) {
  json.begin_object();
  json.key("events");
  write_list(json, counters.events);
  write_counters(json, counters, triangulation_counters);
  json.end_object();
}

template <class Motion>
void write(Json_writer& json, const std::optional<Motion>& motion) {
  if (!motion) return json.null();
  write_list(json, Checkpoint_motion<Motion>::numbers(*motion));
}

// The ids; in a periodic box also the offset.
void write(Json_writer& json, const Edge_ids& pair) {
  write_list(json, pair);
}

void write(Json_writer& json, const Periodic_edge& pair) {
  json.begin_list();
  for (const Point_id id : pair.ids) json.value(id);
  for (const std::int32_t count : {pair.offset.x, pair.offset.y}) json.value(count);
  json.end_list();
}

template <class Traits>
class Checkpoint_writer {
 public:
  explicit Checkpoint_writer(std::string& text) : text_(text) {}

  void write_state(const Simulation_snapshot<Traits>& snapshot, const Checkpoint& checkpoint) {
    KINETRI_PRECONDITION(PeriodicKineticTraits_2<Traits> == checkpoint.periodic_box.has_value(),
                         "a checkpoint with a periodic box of a simulation in the plane, or "
                         "without one of a simulation in a periodic box; set both or none");
    const Triangulation_snapshot<Traits>& topology = snapshot.triangulation;
    text_ += '{';
    add("motion", Checkpoint_motion<typename Traits::Motion>::name);
    add_written("time", topology.time);
    add("response", std::string_view(checkpoint.response));
    add_list("logs", checkpoint.logs, [](Json_writer& json, const Checkpoint_log& log) {
      json.begin_object();
      json.member("output", std::string_view(log.output));
      json.member("path", std::string_view(log.path));
      json.member("bytes", log.bytes);
      json.member("crc32", std::string_view(hexadecimal(log.crc32, 8)));
      json.end_object();
    });
    write_periodic_box(checkpoint.periodic_box);
    write_options(snapshot);
    add_list("masses", snapshot.options.masses,
             [](Json_writer& json, double mass) { json.value(mass); });
    add_written("counters", topology.counters);
    add_written("contact_counters", snapshot.counters, contact_counters);
    add_list("points", topology.motions,
             [](Json_writer& json, const auto& motion) { write(json, motion); });
    add_list("in_contact", snapshot.in_contact,
             [](Json_writer& json, const auto& pair) { write(json, pair); });
    add_list("scheduled", snapshot.scheduled, [](Json_writer& json, const auto& change) {
      json.begin_object();
      json.key("time");
      write(json, change.time);
      json.member("kind", name(change.kind));
      json.member("point", change.point);
      json.key("motion");
      write(json, change.motion);
      json.end_object();
    });
    text_ += "\n}\n";
  }

 private:
  // Its two vectors, or null.
  void write_periodic_box(const std::optional<Periodic_box_2>& box) {
    Json_writer json = begin("periodic_box");
    if (!box) return json.null();
    json.begin_list();
    for (const Linear_motion_2& vector : {box->first(), box->second()}) {
      write_list(json, Checkpoint_motion<Linear_motion_2>::numbers(vector));
    }
    json.end_list();
  }

  void write_options(const Simulation_snapshot<Traits>& snapshot) {
    const Simulation_options& options = snapshot.options;
    Json_writer json = begin("box");
    if (options.box) {
      const auto& [xmin, ymin, xmax, ymax] = *options.box;
      write_list(json, std::array{xmin, ymin, xmax, ymax});
    } else {
      json.null();
    }
    add("rim_touches", options.rim_touches);
    add("radius", options.radius);
    add("refuses_overlaps", options.refuses_overlaps);
    add("refuses_coincident_points", options.coincident == Coincident_points::refuse);
    add("has_response", snapshot.has_response);
    if (options.max_contacts_per_instant) {
      add("max_contacts_per_instant", *options.max_contacts_per_instant);
    }
  }

  // The writer of the value of a member.
  Json_writer begin(const char* key) {
    if (!std::exchange(is_first_, false)) text_ += ',';
    text_ += "\n\"";
    text_ += key;
    text_ += "\":";
    return Json_writer(text_);
  }

  template <class Value>
  void add(const char* key, const Value& value) {
    begin(key).value(value);
  }

  // Adds a member whose value `write` writes.
  template <class... Values>
  void add_written(const char* key, const Values&... values) {
    Json_writer json = begin(key);
    write(json, values...);
  }

  template <class List, class Function>
  void add_list(const char* key, const List& list, Function write_element) {
    begin(key);
    text_ += '[';
    for (bool is_first = true; const auto& element : list) {
      text_ += std::exchange(is_first, false) ? "\n" : ",\n";
      Json_writer json(text_);
      write_element(json, element);
    }
    text_ += ']';
  }

  std::string& text_;
  bool is_first_ = true;
};

}  // namespace

void write_checkpoint(std::ostream& out, const Checkpoint& checkpoint) {
  std::string state;
  std::visit(
      [&]<class Traits>(const Simulation_snapshot<Traits>& snapshot) {
        Checkpoint_writer<Traits>(state).write_state(snapshot, checkpoint);
      },
      checkpoint.simulation);
  out << checkpoint_text(state);
}

void write_checkpoint_file(const std::string& path, const Checkpoint& checkpoint) {
  Output_file file(path);
  write_checkpoint(file.stream(), checkpoint);
  file.commit();
}

}  // namespace kinetri
