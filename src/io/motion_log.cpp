// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/io/motion_log.h"

#include <ostream>
#include <string>

#include "kinetri/impl/base/check.h"
#include "kinetri/impl/io/text.h"

namespace kinetri {
namespace {

void append_vector(std::string& line, const Vector_2& v) {
  append(line, ',', v.x, ',', v.y);
}

void append_center(std::string& line, const Linear_motion_2& motion) {
  append_vector(line, motion.position);
  append_vector(line, motion.velocity);
  line += ",0,0,0,0";
}

void append_center(std::string& line, const Polynomial_motion_2& motion) {
  append_vector(line, motion.position);
  append_vector(line, motion.velocity);
  append_vector(line, motion.acceleration);
  append_vector(line, motion.jerk);
}

template <class Motion>
void append_motion(std::string& line, const Motion& motion, double radius) {
  append_center(line, center(motion));
  if constexpr (HasWeight<Motion>) {
    KINETRI_PRECONDITION(motion.weight == 0,
                         "a motion has a weight besides its radius, for which a motion log has no "
                         "column; expected discs, or points without weights");
    append(line, ',', motion.radius, ',', motion.growth);
  } else {
    append(line, ',', radius, ",0");
  }
  append(line, ',', motion.epoch);
}

}  // namespace

template <class Traits>
Motion_log_writer<Traits>::Motion_log_writer(std::ostream& out, const Triangulation& triangulation,
                                             double radius)
    : out_(out), triangulation_(triangulation), radius_(radius) {
  out_ << "event,id,x,y,vx,vy,ax,ay,jx,jy,radius,growth,epoch\n";
  for (Point_id id = 0; id < triangulation_.next_id(); ++id) {
    if (const auto motion = motion_now(id)) write(std::nullopt, id, motion);
  }
}

template <class Traits>
void Motion_log_writer<Traits>::before_event(const Event& event) {
  if (event.kind != Event_kind::collision) return;
  before_collision_ = {motion_now(*event.point_a), motion_now(*event.point_b)};
}

template <class Traits>
void Motion_log_writer<Traits>::after_event(const Event& event) {
  switch (event.kind) {
    case Event_kind::wall:
    case Event_kind::insert:
    case Event_kind::erase:
    case Event_kind::trajectory:
      return write(event.number, *event.point_a, motion_now(*event.point_a));
    case Event_kind::collision:
      for (const std::size_t i : {0U, 1U}) {
        const Point_id id = i == 0 ? *event.point_a : *event.point_b;
        const auto motion = motion_now(id);
        if (motion != before_collision_[i]) write(event.number, id, motion);
      }
      return;
    case Event_kind::rebuild:
    case Event_kind::hull_insert:
    case Event_kind::hull_remove:
    case Event_kind::flip:
    case Event_kind::hide:
    case Event_kind::reveal:
      return;
  }
}

template <class Traits>
auto Motion_log_writer<Traits>::motion_now(Point_id id) const -> std::optional<Motion> {
  if (!triangulation_.contains(id)) return std::nullopt;
  return triangulation_.motion(id);
}

template <class Traits>
void Motion_log_writer<Traits>::write(std::optional<std::uint64_t> event, Point_id id,
                                      const std::optional<Motion>& motion) {
  std::string line;
  if (event) append(line, *event);
  append(line, ',', id);
  if (motion) {
    append_motion(line, *motion, radius_);
  } else {
    line += ",,,,,,,,,,,";
  }
  line += '\n';
  out_ << line;
}

template class Motion_log_writer<Linear_kinetic_traits_2>;
template class Motion_log_writer<Polynomial_kinetic_traits_2>;
template class Motion_log_writer<Disc_kinetic_traits_2>;
template class Motion_log_writer<Polynomial_disc_kinetic_traits_2>;
template class Motion_log_writer<Periodic_kinetic_traits_2>;
template class Motion_log_writer<Periodic_disc_kinetic_traits_2>;

}  // namespace kinetri
