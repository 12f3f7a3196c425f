// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lesson 7, traits of one's own: the certificates of straight lines, with a closing time after
// which nothing is of interest. What fails later makes no event.
#include <kinetri/kinetic/basic_kinetic_traits_2.h>
// The definitions of the templates: the library has them compiled for its own traits only.
#include <kinetri/triangulation/audit_impl.h>
#include <kinetri/triangulation/kinetic_delaunay_triangulation_2_impl.h>

#include <array>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace {

using Base = kinetri::Linear_kinetic_traits_2;

class Closing_traits : public Base {
 public:
  using P = Point_2;
  using Four = kinetri::Quadruple<P>;
  using State = kinetri::Certificate_state;
  using Counters = kinetri::Certificate_counters;
  using Interval = kinetri::Double_interval;
  using Outlook = kinetri::Outlook<Time>;

  explicit Closing_traits(double closing, Base base = {}) : Base(base), closing_(closing) {}

  // The same without the floating-point filter, for audits.
  Closing_traits exact() const { return Closing_traits(closing_, Base::exact()); }

  Outlook in_circle_outlook(const P& p, const P& q, const P& r, const P& s, const Time& t,
                            State state, Counters& counters) const {
    return cut({&p, &q, &r, &s}, Base::in_circle_outlook(p, q, r, s, t, state, counters));
  }
  Outlook orientation_outlook(const P& p, const P& q, const P& r, const Time& t, State state,
                              Counters& counters) const {
    return cut(Base::orientation_outlook(p, q, r, t, state, counters),
               [&](const Interval& bounds) { return orientation_failure(p, q, r, bounds); });
  }
  Outlook flatness_outlook(const P& p, const P& q, const P& r, const Time& t, State state,
                           Counters& counters) const {
    return cut(Base::flatness_outlook(p, q, r, t, state, counters),
               [&](const Interval& bounds) { return orientation_failure(p, q, r, bounds); });
  }
  std::array<Outlook, 2> in_circle_outlooks(const std::array<Four, 2>& certificates, const Time& t,
                                            Counters& counters) const {
    auto outlooks = Base::in_circle_outlooks(certificates, t, counters);
    return {cut(certificates[0], std::move(outlooks[0])),
            cut(certificates[1], std::move(outlooks[1]))};
  }
  std::array<Outlook, 5> outlooks_after_flip(const kinetri::Flip_neighborhood<P>& around,
                                             const Interval& now, Counters& counters) const {
    auto outlooks = Base::outlooks_after_flip(around, now, counters);
    for (std::size_t i = 0; i < outlooks.size(); ++i) {
      outlooks[i] = cut(around.certificate(i), std::move(outlooks[i]));
    }
    return outlooks;
  }
  std::optional<Time> coincidence_time(const P& p, const P& q, const Time& t, const Interval& among,
                                       Counters& counters) const {
    auto time = Base::coincidence_time(p, q, t, among, counters);
    return time && *time > closing_ ? std::nullopt : std::move(time);
  }

 private:
  // The bounds of the failure decide where they can, and where they cannot its exact time.
  template <class Failure>
  Outlook cut(Outlook outlook, Failure failure) const {
    if (outlook.kind != Outlook::Kind::fails || outlook.bounds.upper <= closing_) return outlook;
    if (outlook.bounds.lower > closing_ || failure(outlook.bounds) > closing_) {
      outlook = {.may_vanish = outlook.may_vanish};  // holds for ever
    }
    return outlook;
  }

  Outlook cut(const Four& points, Outlook outlook) const {
    return cut(std::move(outlook), [&](const Interval& bounds) {
      return in_circle_failure(*points[0], *points[1], *points[2], *points[3], bounds);
    });
  }

  double closing_;
};

}  // namespace

int main() {
  const std::vector<kinetri::Linear_motion_2> motions = {
      {{0, 0}, {0, 0}}, {{6, 0}, {0, 0}}, {{6, 4}, {0, 0}}, {{0, 5}, {0, 0}}, {{2, -3}, {0.5, 1}}};
  kinetri::Kinetic_delaunay_triangulation_2<> open(motions);
  kinetri::Kinetic_delaunay_triangulation_2<Closing_traits> kdt(motions, 0, Closing_traits(7.25));

  for (const double t : {5.0, 7.25}) {
    const std::size_t events = kdt.advance_to(t);
    open.advance_to(t);
    const bool is_same = kdt.finite_edge_ids() == open.finite_edge_ids();
    std::cout << "t = " << t << ", events " << events << ", " << (is_same ? "the same" : "other")
              << " edges, the next event "
              << (kdt.next_event_time() ? "is before closing time" : "never comes") << '\n';
    const kinetri::Audit_report report = kdt.audit(kinetri::Audit_level::certificates);
    std::cout << (report.passed() ? "audit passed\n" : "audit failed\n");
    for (const std::string& failure : report.failures) std::cout << "  " << failure << '\n';
  }
}
