// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lesson 7, user-defined traits: the certificates of linear motion up to a closing time. Later
// failures are no events.
#include <kinetri/kinetic/basic_kinetic_traits_2.h>
// The definitions of the templates, which the library compiles for its own traits only.
#include <kinetri/triangulation/audit_impl.h>
#include <kinetri/triangulation/kinetic_delaunay_triangulation_2.h>
#include <kinetri/triangulation/kinetic_triangulation_2_impl.h>

#include <iostream>
#include <string>
#include <vector>

namespace {

using Base = kinetri::Linear_kinetic_traits_2;

class Closing_traits : public Base {
 public:
  using P = Point_2;
  using State = kinetri::Certificate_state;
  using Interval = kinetri::Double_interval;
  using Certificate = kinetri::Certificate;

  explicit Closing_traits(double closing, Base base = {}) : Base(base), closing_(closing) {}

  // The same without the floating-point filter, for audits.
  Closing_traits exact() const { return Closing_traits(closing_, Base::exact()); }

  Certificate in_circle_certificate(const P& p, const P& q, const P& r, const P& s, const Time& t,
                                    State state) const {
    return cut(Base::in_circle_certificate(p, q, r, s, t, state),
               [&](const Interval& bounds) { return in_circle_failure(p, q, r, s, bounds); });
  }
  Certificate orientation_certificate(const P& p, const P& q, const P& r, const Time& t,
                                      State state) const {
    return cut(Base::orientation_certificate(p, q, r, t, state),
               [&](const Interval& bounds) { return orientation_failure(p, q, r, bounds); });
  }
  Certificate flatness_certificate(const P& p, const P& q, const P& r, const Time& t,
                                   State state) const {
    return cut(Base::flatness_certificate(p, q, r, t, state),
               [&](const Interval& bounds) { return orientation_failure(p, q, r, bounds); });
  }
  Certificate coincidence_certificate(const P& p, const P& q, const Time& t,
                                      const Interval& among) const {
    return cut(Base::coincidence_certificate(p, q, t, among),
               [&](const Interval&) { return closing_; });  // never called: the time is known
  }

 private:
  // The bounds of the failure decide if possible, else its exact time.
  template <class Failure>
  Certificate cut(Certificate certificate, Failure failure) const {
    const auto& [lower, upper] = certificate.bounds;
    if (certificate.kind != Certificate::Kind::fails || upper <= closing_) return certificate;
    const auto time = [&]() -> Time {
      return certificate.failure ? *certificate.failure : failure(certificate.bounds);
    };
    if (lower > closing_ || time() > closing_) {
      return {.may_be_zero = certificate.may_be_zero, .means = certificate.means};  // never fails
    }
    return certificate;
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
