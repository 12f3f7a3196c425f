// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation/contact_records.h"

namespace kinetri::detail {

Contact_record& Contact_records::of(Point_id id) {
  make_room(std::size_t{id} + 1);
  if (records_[id] == nullptr) records_[id] = std::make_unique<Contact_record>();
  return *records_[id];
}

// ---- entries of the queue ----

Queue_handle Contact_records::pair_event(const Edge_ids& pair) const {
  const Contact_record* const record = find(pair[0]);
  if (record == nullptr) return no_event;
  const auto partner = std::ranges::find(record->partners, pair[1], &Contact_partner::id);
  return partner == record->partners.end() ? no_event : partner->event;
}

Queue_handle Contact_records::event(const Contact_subject& subject) const {
  if (subject.kind == Contact_kind::collision) {
    return pair_event({subject.point_a, subject.point_b});
  }
  const Contact_record* const record = find(subject.point_a);
  if (record == nullptr) return no_event;
  return subject.kind == Contact_kind::wall ? record->wall_event : record->vanish_event;
}

void Contact_records::set_event(const Contact_subject& subject, Queue_handle handle) {
  if (subject.kind == Contact_kind::wall) {
    find(subject.point_a)->wall_event = handle;
  } else if (subject.kind == Contact_kind::vanish) {
    find(subject.point_a)->vanish_event = handle;
  } else {
    const auto set = [&](Point_id id, Point_id other) {
      std::ranges::find(find(id)->partners, other, &Contact_partner::id)->event = handle;
    };
    set(subject.point_a, subject.point_b);
    set(subject.point_b, subject.point_a);
  }
}

void Contact_records::add_event(const Contact_subject& subject, Queue_handle handle) {
  if (subject.kind == Contact_kind::wall) {
    of(subject.point_a).wall_event = handle;
  } else if (subject.kind == Contact_kind::vanish) {
    of(subject.point_a).vanish_event = handle;
  } else {
    of(subject.point_a).partners.push_back({subject.point_b, handle});
    of(subject.point_b).partners.push_back({subject.point_a, handle});
  }
}

void Contact_records::forget_event(const Contact_subject& subject) {
  if (subject.kind == Contact_kind::wall) {
    of(subject.point_a).wall_event = no_event;
  } else if (subject.kind == Contact_kind::vanish) {
    of(subject.point_a).vanish_event = no_event;
  } else {
    forget_pair({subject.point_a, subject.point_b});
  }
}

Queue_handle Contact_records::forget_pair(const Edge_ids& pair) {
  const Queue_handle event = forget_partner(pair[0], pair[1]);
  if (event != no_event) forget_partner(pair[1], pair[0]);
  return event;
}

Queue_handle Contact_records::forget_partner(Point_id id, Point_id other) {
  Contact_record* const record = find(id);
  if (record == nullptr) return no_event;
  auto& partners = record->partners;
  const auto partner = std::ranges::find(partners, other, &Contact_partner::id);
  if (partner == partners.end()) return no_event;
  const Queue_handle event = partner->event;
  *partner = partners.back();
  partners.pop_back();
  return event;
}

// ---- overlaps ----

const std::vector<Disc_overlap>& Contact_records::overlaps(Point_id id) const {
  static const std::vector<Disc_overlap> none;
  const Contact_record* const record = find(id);
  return record == nullptr ? none : record->overlaps;
}

const Disc_overlap* Contact_records::find_overlap(const Edge_ids& pair) const {
  // Both have a record; a large disc may overlap many.
  const bool is_second_shorter = overlaps(pair[1]).size() < overlaps(pair[0]).size();
  const std::vector<Disc_overlap>& shorter = overlaps(pair[is_second_shorter ? 1 : 0]);
  const auto overlap =
      std::ranges::find(shorter, pair[is_second_shorter ? 0 : 1], &Disc_overlap::id);
  return overlap == shorter.end() ? nullptr : &*overlap;
}

void Contact_records::start_overlap(Point_id a, Point_id b, bool is_edge) {
  if (find_overlap({a, b}) == nullptr) {
    of(a).overlaps.push_back({b, false, is_edge});
    of(b).overlaps.push_back({a, false, is_edge});
  } else if (is_edge) {
    mark_edge({a, b}, true);
  }
}

void Contact_records::forget_overlap(Point_id a, Point_id b) {
  const auto forget = [this](Point_id id, Point_id other) {
    std::erase_if(of(id).overlaps,
                  [&](const Disc_overlap& overlap) { return overlap.id == other; });
  };
  forget(a, b);
  forget(b, a);
}

}  // namespace kinetri::detail
