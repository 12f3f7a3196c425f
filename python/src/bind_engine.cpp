// SPDX-License-Identifier: GPL-3.0-or-later
//
// The classes Motions and Engine, wrapped by kinetri/_moving.py, which checks shapes and types of
// arguments.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "bindings.h"
#include "event_table.h"
#include "kinetri/io/viewer_page.h"
#include "moving.h"
#include "numpy_arrays.h"

namespace kinetri::python {
namespace {

using Numbers = std::optional<Array<double>>;
using Ids = Array<Point_id>;
using Box = std::array<double, 4>;
/// A periodic box: the two lattice vectors, their rates, and the epoch of both.
using Lattice = std::array<double, 9>;

/// The columns of motions, and the arrays that own them.
class Motions {
 public:
  Motions(const Array<double>& positions, const Numbers& velocities, const Numbers& accelerations,
          const Numbers& jerks, const Numbers& radii, const Numbers& growths,
          const Numbers& weights, double epoch) {
    columns_.size = static_cast<std::size_t>(positions.size()) / 2;
    columns_.positions = keep(positions);
    columns_.velocities = keep(velocities);
    columns_.accelerations = keep(accelerations);
    columns_.jerks = keep(jerks);
    columns_.radii = keep(radii);
    columns_.growths = keep(growths);
    columns_.weights = keep(weights);
    columns_.epoch = epoch;
  }

  const Motion_columns& columns() const { return columns_; }

 private:
  const double* keep(const Numbers& column) {
    if (!column) return nullptr;
    arrays_.push_back(*column);
    return column->data();
  }

  std::vector<Array<double>> arrays_;
  Motion_columns columns_;
};

std::optional<Algebraic_number> limit(const py::object& until) {
  if (until.is_none()) return std::nullopt;
  return time_of(until);
}

const Algebraic_number* pointer(const std::optional<Algebraic_number>& time) {
  return time ? &*time : nullptr;
}

std::optional<Periodic_box_2> periodic_box(const std::optional<Lattice>& lattice) {
  if (!lattice) return std::nullopt;
  const auto& [ax, ay, bx, by, ax_rate, ay_rate, bx_rate, by_rate, epoch] = *lattice;
  return Periodic_box_2({{ax, ay}, {ax_rate, ay_rate}, epoch},
                        {{bx, by}, {bx_rate, by_rate}, epoch});
}

std::optional<Lattice> lattice_of(const std::optional<Periodic_box_2>& box) {
  if (!box) return std::nullopt;
  const auto& [a, a_rate, epoch] = box->first();
  const auto& [b, b_rate, same_epoch] = box->second();
  return Lattice{a.x, a.y, b.x, b.y, a_rate.x, a_rate.y, b_rate.x, b_rate.y, epoch};
}

Coincident_points coincident_points(bool are_refused) {
  return are_refused ? Coincident_points::refuse : Coincident_points::hide;
}

Simulation_options simulation_options(const std::optional<Box>& box, bool rim, double radius,
                                      const py::object& collisions, bool refuses_overlaps,
                                      bool refuses_coincident, const Numbers& masses,
                                      const Interrupt_flag& flag) {
  Simulation_options result;
  if (box) result.box = Box_2{(*box)[0], (*box)[1], (*box)[2], (*box)[3]};
  result.rim_touches = rim;
  result.radius = radius;
  result.response = response_of(collisions, flag);
  result.refuses_overlaps = refuses_overlaps;
  result.coincident = coincident_points(refuses_coincident);
  if (masses) result.masses.assign(masses->data(), masses->data() + masses->size());
  return result;
}

Interrupt_flag new_flag() {
  return std::make_shared<std::atomic<bool>>(false);
}

std::shared_ptr<Moving> make_moving_simulation(const Motions& motions, bool is_polynomial,
                                               bool has_weight, const py::object& start,
                                               const std::optional<Box>& box, bool rim,
                                               double radius, const py::object& collisions,
                                               bool refuses_overlaps, bool refuses_coincident,
                                               const Numbers& masses,
                                               const std::optional<Lattice>& lattice) {
  const Interrupt_flag flag = new_flag();
  const Simulation_options options = simulation_options(
      box, rim, radius, collisions, refuses_overlaps, refuses_coincident, masses, flag);
  const Algebraic_number time = time_of(start);
  auto engine = without_gil([&] {
    return make_simulation(motions.columns(), {is_polynomial, has_weight}, time, options,
                           periodic_box(lattice));
  });
  return std::make_shared<Moving>(std::move(engine), flag);
}

// Concatenated tracks: the observations of track i begin at offsets[i]. Returns the simulation and
// its stays, as rows of track, first and last observation.
py::tuple make_moving_tracks(const Array<double>& times, const Array<double>& places,
                             const Array<std::uint64_t>& offsets, const Numbers& radii, double from,
                             double until, double longest_gap, const std::optional<Box>& box,
                             bool rim, double radius, const py::object& collisions,
                             bool refuses_coincident) {
  std::vector<std::vector<Observation_2>> tracks;
  for (py::ssize_t i = 0; i + 1 < offsets.size(); ++i) {
    std::vector<Observation_2>& track = tracks.emplace_back();
    for (std::uint64_t j = offsets.data()[i]; j < offsets.data()[i + 1]; ++j) {
      track.push_back({times.data()[j], {places.data()[2 * j], places.data()[2 * j + 1]}});
    }
  }
  Tracks_options options;
  options.from = from;
  options.until = until;
  options.longest_gap = longest_gap;
  const Interrupt_flag flag = new_flag();
  const Simulation_options simulated = simulation_options(box, rim, radius, collisions, false,
                                                          refuses_coincident, std::nullopt, flag);
  std::vector<std::array<std::uint64_t, 3>> rows;
  auto engine = without_gil([&] {
    const std::vector<Stay> stays = stays_of(tracks, options);
    for (const Stay& stay : stays) rows.push_back({stay.track, stay.first, stay.last});
    return make_tracks_simulation(tracks, radii ? span_of(*radii) : std::span<const double>(),
                                  stays, from, simulated);
  });
  return py::make_tuple(std::make_shared<Moving>(std::move(engine), flag),
                        array_of<std::uint64_t>(std::move(rows), 3));
}

std::shared_ptr<Moving> restored(const Checkpoint& checkpoint, bool is_simulation,
                                 const py::object& collisions) {
  const auto& box = checkpoint.periodic_box;
  if (box && box->first().epoch != box->second().epoch) {
    throw Snapshot_error(
        "the lattice vectors of the state's periodic box have different epochs; expected one, as a "
        "Box has");
  }
  const Interrupt_flag flag = new_flag();
  const Collision_response response = response_of(collisions, flag);
  auto engine = without_gil([&] {
    return restore(checkpoint, is_simulation ? Engine_kind::simulation : Engine_kind::triangulation,
                   response);
  });
  return std::make_shared<Moving>(std::move(engine), flag);
}

// The viewer's page of a recording.
py::bytes page(Moving& moving, const Event_observer& recorder, const std::string& title,
               const std::vector<std::string>& names, const std::optional<Box>& box,
               double radius) {
  Viewer_settings settings;
  settings.title = title;
  settings.names = names;
  if (box) settings.box = Box_2{(*box)[0], (*box)[1], (*box)[2], (*box)[3]};
  settings.radius = radius;
  return py::bytes(moving.with_engine([&](Engine& engine) {
    std::ostringstream out;
    write_viewer_page(out, engine.recording(recorder), settings);
    return out.str();
  }));
}

std::vector<Vector_2> corners_of(const Array<double>& polygon) {
  std::vector<Vector_2> result;
  for (py::ssize_t i = 0; i < polygon.size(); i += 2) {
    result.push_back({polygon.data()[i], polygon.data()[i + 1]});
  }
  return result;
}

py::array_t<Point_id> array_of_edges(std::vector<Edge_ids> edges) {
  return array_of<Point_id>(std::move(edges), 2);
}

std::vector<Edge_ids> pairs_of(const Array<Point_id>& ids) {
  std::vector<Edge_ids> result;
  for (py::ssize_t i = 0; i < ids.size(); i += 2) {
    result.push_back({ids.data()[i], ids.data()[i + 1]});
  }
  return result;
}

/// The answer to a question about a run from now on.
class Moving_watch {
 public:
  Moving_watch(std::shared_ptr<Moving> moving, const std::string& about, std::size_t number,
               std::optional<double> distance, const Array<Point_id>& pairs,
               std::shared_ptr<Cell_limits> limits, double tolerance)
      : moving_(std::move(moving)), watch_(moving_->with_engine([&](Engine& e) {
          return e.watch({about, number, distance, pairs_of(pairs), std::move(limits), tolerance});
        })) {}

  /// The columns by name, in order.
  py::dict table() {
    Answer_table table = moving_->with_engine([&](Engine&) { return watch_->table(); });
    py::dict result;
    for (auto& [name, column] : table.columns()) {
      result[py::str(name)] = std::visit([](auto& values) { return values_of(values); }, column);
    }
    return result;
  }

 private:
  template <class Value>
  static py::object values_of(std::vector<Value>& values) {
    if constexpr (std::is_same_v<Value, std::string>) {
      return py::cast(values);
    } else {
      return array_of<Value>(std::move(values));
    }
  }

  std::shared_ptr<Moving> moving_;
  std::unique_ptr<Watch> watch_;  // must be destroyed before the engine
};

py::dict statistics(const Statistics& statistics) {
  py::dict events;
  for (std::size_t i = 0; i < event_kinds; ++i) {
    events[py::str(std::string(name(static_cast<Event_kind>(i))))] = statistics.events[i];
  }
  const Certificate_counters& counters = statistics.certificates;
  py::dict certificates;
  certificates["created"] = counters.created;
  certificates["root_solves"] = counters.root_solves;
  certificates["filter_decided"] = counters.filter_decided;
  certificates["exact_decided"] = counters.exact_decided;
  py::dict result;
  result["events"] = events;
  result["certificates"] = certificates;
  result["instants"] = statistics.instants;
  result["reconstructions"] = statistics.reconstructions;
  return result;
}

Audit_level audit_level(const std::string& level) {
  constexpr std::array<const char*, 5> levels = {"links", "embedding", "delaunay", "reference",
                                                 "certificates"};
  for (std::size_t i = 0; i < levels.size(); ++i) {
    if (level == levels[i]) return static_cast<Audit_level>(i);
  }
  throw Precondition_error("level is '" + level +
                           "'; expected 'links', 'embedding', 'delaunay', 'reference' or "
                           "'certificates'");
}

py::dict motion_fields(const Polynomial_disc_motion_2& motion) {
  const auto pair = [](const Vector_2& vector) { return py::make_tuple(vector.x, vector.y); };
  py::dict result;
  result["position"] = pair(motion.position);
  result["velocity"] = pair(motion.velocity);
  result["acceleration"] = pair(motion.acceleration);
  result["jerk"] = pair(motion.jerk);
  result["radius"] = motion.radius;
  result["growth"] = motion.growth;
  result["weight"] = motion.weight;
  result["epoch"] = motion.epoch;
  return result;
}

/// None in the plane.
using Offsets = std::optional<py::array_t<std::int32_t>>;

Offsets array_of_offsets(std::optional<std::vector<Lattice_offset_2>> offsets) {
  if (!offsets) return std::nullopt;
  return array_of<std::int32_t>(std::move(*offsets), 2);
}

void check_has_box(const Engine& engine) {
  if (engine.box()) return;
  throw Precondition_error("offsets are of images; expected an object in a periodic box");
}

py::tuple cell_fields(Cell answer) {
  const Voronoi_cell_2<Vector_2>& cell = answer.cell;
  std::optional<py::array_t<double>> rays;
  if (cell.rays) {
    rays = array_of<double>(std::vector<Vector_2>(cell.rays->begin(), cell.rays->end()), 2);
  }
  return py::make_tuple(array_of<Point_id>(cell.neighbors), array_of<double>(cell.vertices, 2),
                        rays, cell.is_empty, array_of_offsets(std::move(answer.offsets)));
}

std::string location_name(Location_2::Kind kind) {
  switch (kind) {
    case Location_2::Kind::vertex:
      return "vertex";
    case Location_2::Kind::edge:
      return "edge";
    case Location_2::Kind::face:
      return "face";
    case Location_2::Kind::outside_convex_hull:
      break;
  }
  return "outside_convex_hull";
}

void check_contains(const Engine& engine, std::span<const Point_id> ids) {
  for (const Point_id id : ids) {
    if (engine.contains(id)) continue;
    throw Precondition_error("there is no point " + std::to_string(id) +
                             "; expected an id that has been given and not been erased");
  }
}

// Makes a method that calls the engine without the GIL, and converts the answer with the GIL.
template <class Ask, class Convert>
auto answer(const Ask& ask, const Convert& convert) {
  return [ask, convert](Moving& moving) {
    return convert(moving.with_engine([&](Engine& engine) { return ask(engine); }));
  };
}

void bind_present(py::class_<Moving, std::shared_ptr<Moving>>& type) {
  const auto same = [](auto value) { return value; };
  type.def("current_time", answer([](Engine& e) { return e.current_time(); }, same))
      .def("kind", answer([](Engine& e) { return e.motion_kind(); },
                          [](const Motion_kind& kind) {
                            return py::make_tuple(kind.is_polynomial, kind.has_weight);
                          }))
      .def("number_of_points", answer([](Engine& e) { return e.number_of_points(); }, same))
      .def("next_id", answer([](Engine& e) { return e.next_id(); }, same))
      .def("contains",
           [](Moving& moving, Point_id id) {
             return moving.with_engine([&](Engine& e) { return e.contains(id); });
           })
      .def("motion",
           [](Moving& moving, Point_id id) {
             return motion_fields(moving.with_engine([&](Engine& e) {
               check_contains(e, {&id, 1});
               return e.motion(id);
             }));
           })
      .def("masses", answer(
                         [](Engine& e) {
                           std::vector<double> masses;
                           for (Point_id id = 0; id < e.next_id(); ++id) {
                             masses.push_back(e.mass(id));
                           }
                           return masses;
                         },
                         [](auto masses) { return array_of<double>(std::move(masses)); }))
      .def("edges", answer([](Engine& e) { return e.edges(); }, array_of_edges))
      .def("triangles",
           answer([](Engine& e) { return e.triangles(); },
                  [](auto triangles) { return array_of<Point_id>(std::move(triangles), 3); }))
      .def("hull", answer([](Engine& e) { return e.hull(); },
                          [](auto ids) { return array_of<Point_id>(std::move(ids)); }))
      .def("hidden_points", answer([](Engine& e) { return e.hidden_points(); },
                                   [](auto ids) { return array_of<Point_id>(std::move(ids)); }))
      .def("coincident_points",
           [](Moving& moving, Point_id id) {
             return array_of<Point_id>(moving.with_engine([&](Engine& e) {
               check_contains(e, {&id, 1});
               return e.coincident_points(id);
             }));
           })
      .def("positions", answer([](Engine& e) { return e.positions(); },
                               [](auto places) { return array_of<double>(std::move(places), 2); }))
      .def("velocities",
           answer([](Engine& e) { return e.velocities(); },
                  [](auto vectors) { return array_of<double>(std::move(vectors), 2); }))
      .def("radii", answer([](Engine& e) { return e.radii(); },
                           [](auto radii) { return array_of<double>(std::move(radii)); }));
}

std::vector<Lattice_offset_2> offsets(const std::vector<Periodic_edge>& edges) {
  std::vector<Lattice_offset_2> result;
  for (const Periodic_edge& edge : edges) result.push_back(edge.offset);
  return result;
}

// Three of each.
std::vector<Lattice_offset_2> offsets(const std::vector<Periodic_triangle>& triangles) {
  std::vector<Lattice_offset_2> result;
  for (const Periodic_triangle& triangle : triangles) {
    for (const Periodic_image& corner : triangle) result.push_back(corner.offset);
  }
  return result;
}

template <class Image_or_edge>
py::object offset_of(const std::optional<Image_or_edge>& answer) {
  if (!answer) return py::none();
  return py::make_tuple(answer->offset.x, answer->offset.y);
}

void bind_box(py::class_<Moving, std::shared_ptr<Moving>>& type) {
  type.def("box", answer([](Engine& e) { return lattice_of(e.box()); },
                         [](const std::optional<Lattice>& lattice) { return lattice; }))
      .def("edge_offsets",
           answer([](Engine& e) { return offsets(e.periodic_edges()); }, array_of_offsets))
      .def("triangle_offsets",
           answer([](Engine& e) { return offsets(e.periodic_triangles()); }, array_of_offsets))
      .def("neighbor_offsets",
           [](Moving& moving, Point_id id) {
             return array_of_offsets(moving.with_engine([&](Engine& e) {
               check_has_box(e);
               check_contains(e, {&id, 1});
               return e.neighbors(id).offsets;
             }));
           })
      .def("nearest_vertex_offset",
           [](Moving& moving, double x, double y) {
             return offset_of(moving.with_engine([&](Engine& e) {
               check_has_box(e);
               return e.nearest_vertex({x, y});
             }));
           })
      .def("closest_pair_offset",
           [](Moving& moving) {
             return offset_of(moving.with_engine([](Engine& e) {
               check_has_box(e);
               return e.closest_pair();
             }));
           })
      .def("positions_of",
           [](Moving& moving, const Ids& ids, const Array<std::int32_t>& offsets) {
             std::vector<Lattice_offset_2> of_images;
             for (py::ssize_t i = 0; i < offsets.size(); i += 2) {
               of_images.push_back({offsets.data()[i], offsets.data()[i + 1]});
             }
             return array_of<double>(moving.with_engine([&](Engine& e) {
               return e.positions_of(span_of(ids), of_images);
             }),
                                     2);
           })
      .def("wrapped_positions",
           answer([](Engine& e) { return e.wrapped_positions(); },
                  [](auto places) { return array_of<double>(std::move(places), 2); }));
}

void bind_time_and_changes(py::class_<Moving, std::shared_ptr<Moving>>& type) {
  type.def("advance",
           [](Moving& moving, const py::object& until, Event_observer* observer,
              const py::object& progress) {
             return moving.advance(time_of(until), observer, progress);
           })
      .def("check_can_advance_to",
           [](Moving& moving, const py::object& time) {
             const Algebraic_number until = time_of(time);
             moving.with_engine([&](Engine& e) { e.check_can_advance_to(until); });
           })
      .def("threads",
           [](Moving& moving) { return moving.with_engine([](Engine& e) { return e.threads(); }); })
      .def("set_threads",
           [](Moving& moving, std::size_t most) {
             moving.with_engine([&](Engine& e) { e.set_threads(most); });
           })
      .def("step",
           [](Moving& moving, const py::object& until, Event_observer* observer) {
             const auto time = limit(until);
             return moving.step(pointer(time), observer);
           })
      .def("next_event_time",
           [](Moving& moving) {
             return moving.with_engine([](Engine& e) { return e.next_event_time(); });
           })
      .def("reverse",
           [](Moving& moving) { return moving.with_engine([](Engine& e) { return e.reverse(); }); })
      .def("insert",
           [](Moving& moving, const Motions& motions, const Numbers& masses) {
             return moving.with_engine([&](Engine& e) {
               return e.insert(motions.columns(),
                               masses ? span_of(*masses) : std::span<const double>());
             });
           })
      .def("erase",
           [](Moving& moving, const Ids& ids) {
             moving.with_engine([&](Engine& e) {
               check_contains(e, span_of(ids));
               e.erase(span_of(ids));
             });
           })
      .def("set_motions",
           [](Moving& moving, const Ids& ids, const Motions& motions) {
             moving.with_engine([&](Engine& e) {
               check_contains(e, span_of(ids));
               e.set_motions(span_of(ids), motions.columns());
             });
           })
      .def("set_velocities",
           [](Moving& moving, const Ids& ids, const Array<double>& velocities) {
             moving.with_engine([&](Engine& e) {
               check_contains(e, span_of(ids));
               e.set_velocities(span_of(ids), span_of(velocities));
             });
           })
      .def("set_positions",
           [](Moving& moving, const Ids& ids, const Array<double>& positions) {
             moving.with_engine([&](Engine& e) {
               check_contains(e, span_of(ids));
               e.set_positions(span_of(ids), span_of(positions));
             });
           })
      .def("set_masses",
           [](Moving& moving, const Ids& ids, const Array<double>& masses) {
             moving.with_engine([&](Engine& e) {
               check_contains(e, span_of(ids));
               e.set_masses(span_of(ids), span_of(masses));
             });
           })
      .def("schedule_insert",
           [](Moving& moving, const py::object& time, const Motions& motion, double mass) {
             const Algebraic_number at = time_of(time);
             return moving.with_engine(
                 [&](Engine& e) { return e.schedule_insert(at, motion.columns(), mass); });
           })
      .def("schedule_motion",
           [](Moving& moving, const py::object& time, Point_id id, const Motions& motion) {
             const Algebraic_number at = time_of(time);
             moving.with_engine([&](Engine& e) { e.schedule_motion(at, id, motion.columns()); });
           })
      .def("schedule_erase", [](Moving& moving, const py::object& time, Point_id id) {
        const Algebraic_number at = time_of(time);
        moving.with_engine([&](Engine& e) { e.schedule_erase(at, id); });
      });
}

void bind_answers(py::class_<Moving, std::shared_ptr<Moving>>& type) {
  type.def("nearest_vertex",
           [](Moving& moving, double x, double y) {
             const auto nearest = moving.with_engine([&](Engine& e) {
               return e.nearest_vertex({x, y});
             });
             return nearest ? std::optional(nearest->id) : std::nullopt;
           })
      .def("locate",
           [](Moving& moving, double x, double y) {
             const auto [kind, points] = moving.with_engine([&](Engine& e) {
               return e.locate({x, y});
             });
             py::object offsets = py::none();
             if (points.offsets) {
               py::list of_points;
               for (const auto& [k, l] : *points.offsets) of_points.append(py::make_tuple(k, l));
               offsets = py::tuple(of_points);
             }
             return py::make_tuple(location_name(kind), py::tuple(py::cast(points.ids)), offsets);
           })
      .def("neighbors",
           [](Moving& moving, Point_id id) {
             return array_of<Point_id>(moving.with_engine([&](Engine& e) {
               check_contains(e, {&id, 1});
               return e.neighbors(id).ids;
             }));
           })
      .def("voronoi_cell",
           [](Moving& moving, Point_id id) {
             return cell_fields(moving.with_engine([&](Engine& e) {
               check_contains(e, {&id, 1});
               return e.voronoi_cell(id);
             }));
           })
      .def("voronoi_areas",
           [](Moving& moving, const Array<double>& polygon) {
             const std::vector<Vector_2> corners = corners_of(polygon);
             return array_of<double>(
                 moving.with_engine([&](Engine& e) { return e.voronoi_areas(corners); }));
           })
      .def("cell_areas",
           [](Moving& moving, const Cell_limits& limits) {
             const std::vector<Cell_area> cells =
                 moving.with_engine([&](Engine& e) { return e.cell_areas(limits); });
             std::vector<Point_id> ids;
             std::vector<double> areas;
             for (const Cell_area& cell : cells) {
               ids.push_back(cell.id);
               areas.push_back(cell.area);
             }
             return py::make_tuple(array_of<Point_id>(std::move(ids)),
                                   array_of<double>(std::move(areas)));
           })
      .def("gabriel_edges", answer([](Engine& e) { return e.gabriel_edges(); }, array_of_edges))
      .def("relative_neighbor_edges",
           answer([](Engine& e) { return e.relative_neighbor_edges(); }, array_of_edges))
      .def("nearest_neighbors",
           [](Moving& moving, std::optional<std::size_t> k) {
             Images images = moving.with_engine([&](Engine& e) { return e.nearest_neighbors(k); });
             return py::make_tuple(array_of<Point_id>(std::move(images.ids), k.value_or(0)),
                                   array_of_offsets(std::move(images.offsets)));
           })
      .def("closest_pair",
           [](Moving& moving) {
             const auto pair = moving.with_engine([](Engine& e) { return e.closest_pair(); });
             return pair ? std::optional(std::pair(pair->ids[0], pair->ids[1])) : std::nullopt;
           })
      .def("audit",
           [](Moving& moving, const std::string& level) {
             const Audit_level exact = audit_level(level);
             return moving.with_engine([&](Engine& e) { return e.audit(exact); }).failures;
           })
      .def("snapshot",
           [](Moving& moving, const std::string& response) {
             return py::bytes(moving.with_engine([&](Engine& e) {
               Checkpoint checkpoint = e.snapshot();
               checkpoint.response = response;
               std::ostringstream out;
               write_checkpoint(out, checkpoint);
               return out.str();
             }));
           })
      .def("save",
           [](Moving& moving, const std::string& path, const std::string& response) {
             moving.with_engine([&](Engine& e) {
               Checkpoint checkpoint = e.snapshot();
               checkpoint.response = response;
               write_checkpoint_file(path, checkpoint);
             });
           })
      .def("box_and_radius",
           [](Moving& moving) {
             const Simulation_options options =
                 moving.with_engine([](Engine& e) { return e.options(); });
             py::object box = py::none();
             if (options.box) {
               const auto& [xmin, ymin, xmax, ymax] = *options.box;
               box = py::make_tuple(xmin, ymin, xmax, ymax);
             }
             return py::make_tuple(box, options.radius);
           })
      .def("recorder",
           [](Moving& moving, double until, std::size_t most_rows) {
             return moving.with_engine([&](Engine& e) { return e.recorder(until, most_rows); });
           })
      .def("page", page)
      .def("statistics", [](Moving& moving) {
        return statistics(moving.with_engine([](Engine& e) { return e.statistics(); }));
      });
}

}  // namespace

void bind_engine(py::module_& module) {
  py::class_<Motions>(module, "Motions")
      .def(py::init<const Array<double>&, const Numbers&, const Numbers&, const Numbers&,
                    const Numbers&, const Numbers&, const Numbers&, double>(),
           py::arg("positions"), py::arg("velocities") = py::none(),
           py::arg("accelerations") = py::none(), py::arg("jerks") = py::none(),
           py::arg("radii") = py::none(), py::arg("growths") = py::none(),
           py::arg("weights") = py::none(), py::arg("epoch") = 0.0);
  py::class_<Moving, std::shared_ptr<Moving>> engine(module, "Engine");
  bind_present(engine);
  bind_box(engine);
  bind_time_and_changes(engine);
  bind_answers(engine);
  module.def("make_triangulation", [](const Motions& motions, bool is_polynomial, bool has_weight,
                                      const py::object& start, bool refuses_coincident,
                                      const std::optional<Lattice>& lattice) {
    const Algebraic_number time = time_of(start);
    return std::make_shared<Moving>(without_gil([&] {
      return make_triangulation(motions.columns(), {is_polynomial, has_weight}, time,
                                coincident_points(refuses_coincident), periodic_box(lattice));
    }));
  });
  module.def("make_simulation", make_moving_simulation);
  py::class_<Cell_limits, std::shared_ptr<Cell_limits>>(module, "CellLimits")
      .def(py::init([](const std::optional<std::string>& text,
                       const std::optional<Array<double>>& polygon, double cutoff,
                       bool is_in_periodic_box) {
        auto limits = std::make_shared<Cell_limits>();
        limits->cutoff = cutoff;
        if (text) limits->walkable = Walkable_area::from_wkt(*text, "walkable");
        if (polygon) limits->walkable = Walkable_area(corners_of(*polygon));
        limits->check(is_in_periodic_box);
        return limits;
      }));
  py::class_<Moving_watch>(module, "Watch")
      .def(py::init<std::shared_ptr<Moving>, const std::string&, std::size_t, std::optional<double>,
                    const Array<Point_id>&, std::shared_ptr<Cell_limits>, double>(),
           py::arg(), py::arg(), py::arg(), py::arg(), py::arg("pairs"),
           py::arg("limits") = nullptr, py::arg("tolerance") = 0.0)
      .def("table", &Moving_watch::table);
  module.def("make_tracks", make_moving_tracks);
  module.def("restore",
             [](const py::bytes& state, bool is_simulation, const py::object& collisions) {
               std::istringstream in{std::string(state)};
               return restored(read_checkpoint(in, "snapshot"), is_simulation, collisions);
             });
  module.def("load", [](const std::string& path, bool is_simulation, const py::object& collisions) {
    const Checkpoint checkpoint = read_checkpoint_file(path);
    const bool takes_name = py::isinstance<py::ellipsis>(collisions);
    const py::object response = takes_name ? py::object(py::str(checkpoint.response)) : collisions;
    return py::make_tuple(restored(checkpoint, is_simulation, response), checkpoint.response);
  });
}

}  // namespace kinetri::python
