// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation/contact_records.h"

namespace kinetri::detail {

template <class Disc>
auto Basic_contact_records<Disc>::of(Point_id id) -> Contact_record& {
  make_room(std::size_t{id} + 1);
  if (records_[id] == nullptr) records_[id] = std::make_unique<Contact_record>();
  return *records_[id];
}

// ---- entries of the queue ----

template <class Disc>
Queue_handle Basic_contact_records<Disc>::pair_event(const Pair& pair) const {
  const Contact_record* const record = find(ids_of(pair)[0]);
  if (record == nullptr) return no_event;
  const auto partner =
      std::ranges::find(record->partners, second_of(pair), &Contact_partner<Disc>::disc);
  return partner == record->partners.end() ? no_event : partner->event;
}

template <class Disc>
Queue_handle Basic_contact_records<Disc>::event(const Contact_subject& subject) const {
  if (subject.kind == Contact_kind::collision) {
    return pair_event(pair_from(subject.point_a, subject.disc_b()));
  }
  const Contact_record* const record = find(subject.point_a);
  if (record == nullptr) return no_event;
  return subject.kind == Contact_kind::wall ? record->wall_event : record->vanish_event;
}

template <class Disc>
void Basic_contact_records<Disc>::set_event(const Contact_subject& subject, Queue_handle handle) {
  if (subject.kind == Contact_kind::wall) {
    find(subject.point_a)->wall_event = handle;
  } else if (subject.kind == Contact_kind::vanish) {
    find(subject.point_a)->vanish_event = handle;
  } else {
    const auto set = [&](Point_id id, const Disc& other) {
      std::ranges::find(find(id)->partners, other, &Contact_partner<Disc>::disc)->event = handle;
    };
    const Disc b = subject.disc_b();
    set(subject.point_a, b);
    set(id_of(b), back_from(b, subject.point_a));
  }
}

template <class Disc>
void Basic_contact_records<Disc>::add_event(const Contact_subject& subject, Queue_handle handle) {
  if (subject.kind == Contact_kind::wall) {
    of(subject.point_a).wall_event = handle;
  } else if (subject.kind == Contact_kind::vanish) {
    of(subject.point_a).vanish_event = handle;
  } else {
    const Disc b = subject.disc_b();
    of(subject.point_a).partners.push_back({b, handle});
    of(id_of(b)).partners.push_back({back_from(b, subject.point_a), handle});
  }
}

template <class Disc>
void Basic_contact_records<Disc>::forget_event(const Contact_subject& subject) {
  if (subject.kind == Contact_kind::wall) {
    of(subject.point_a).wall_event = no_event;
  } else if (subject.kind == Contact_kind::vanish) {
    of(subject.point_a).vanish_event = no_event;
  } else {
    forget_pair(pair_from(subject.point_a, subject.disc_b()));
  }
}

template <class Disc>
Queue_handle Basic_contact_records<Disc>::forget_pair(const Pair& pair) {
  const Point_id a = ids_of(pair)[0];
  const Disc b = second_of(pair);
  const Queue_handle event = forget_partner(a, b);
  if (event != no_event) forget_partner(id_of(b), back_from(b, a));
  return event;
}

template <class Disc>
Queue_handle Basic_contact_records<Disc>::forget_partner(Point_id id, const Disc& other) {
  Contact_record* const record = find(id);
  if (record == nullptr) return no_event;
  auto& partners = record->partners;
  const auto partner = std::ranges::find(partners, other, &Contact_partner<Disc>::disc);
  if (partner == partners.end()) return no_event;
  const Queue_handle event = partner->event;
  *partner = partners.back();
  partners.pop_back();
  return event;
}

// ---- overlaps ----

template <class Disc>
auto Basic_contact_records<Disc>::overlaps(Point_id id) const -> const std::vector<Disc_overlap>& {
  static const std::vector<Disc_overlap> none;
  const Contact_record* const record = find(id);
  return record == nullptr ? none : record->overlaps;
}

template <class Disc>
auto Basic_contact_records<Disc>::find_overlap(const Pair& pair) const -> const Disc_overlap* {
  // Both have a record; a large disc may overlap many.
  const Point_id a = ids_of(pair)[0];
  const Disc b = second_of(pair);
  const bool is_second_shorter = overlaps(id_of(b)).size() < overlaps(a).size();
  const std::vector<Disc_overlap>& shorter = overlaps(is_second_shorter ? id_of(b) : a);
  const auto overlap =
      std::ranges::find(shorter, is_second_shorter ? back_from(b, a) : b, &Disc_overlap::disc);
  return overlap == shorter.end() ? nullptr : &*overlap;
}

template <class Disc>
void Basic_contact_records<Disc>::start_overlap(Point_id a, const Disc& b, bool is_edge) {
  if (find_overlap(pair_from(a, b)) == nullptr) {
    of(a).overlaps.push_back({b, false, is_edge});
    of(id_of(b)).overlaps.push_back({back_from(b, a), false, is_edge});
  } else if (is_edge) {
    mark_edge(pair_from(a, b), true);
  }
}

template <class Disc>
void Basic_contact_records<Disc>::forget_overlap(Point_id a, const Disc& b) {
  const auto forget = [this](Point_id id, const Disc& other) {
    std::erase_if(of(id).overlaps,
                  [&](const Disc_overlap& overlap) { return overlap.disc == other; });
  };
  const Disc other = b;  // b may be in the records
  forget(a, other);
  forget(id_of(other), back_from(other, a));
}

template class Basic_contact_records<Point_id>;
template class Basic_contact_records<Periodic_image>;

}  // namespace kinetri::detail
