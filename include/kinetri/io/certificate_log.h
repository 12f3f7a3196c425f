// SPDX-License-Identifier: GPL-3.0-or-later
//
// The certificates of events as a file that can be checked without Kinetri: one line of JSON for
// each event. docs/PROGRAM.md, section "Certificates", describes its members.
#ifndef KINETRI_IO_CERTIFICATE_LOG_H
#define KINETRI_IO_CERTIFICATE_LOG_H

#include <iosfwd>
#include <string>

#include "kinetri/simulation/event_certificates.h"

namespace kinetri {

/// The line of a certificate, with its line end: a JSON object with the members event, kind,
/// points, polynomial, from, lower, upper, signs, multiplicity, touches of Failure_certificate; or
/// event, kind, points, polynomial (null) and reason. In a periodic box there is a member offsets
/// after points, with two integers for each of these. Coefficients, by ascending power, are texts.
/// A dyadic number is a list of an odd integer, or 0, as a text, and the exponent of a power of
/// two, its factor. Signs are -1, 0 and 1.
std::string certificate_line(const Event_certificate& certificate);

/// An observer that writes the certificate of each event as a line, after the event. Errors are
/// those of the stream. Cost, and traits: those of Event_certificates.
template <class Traits = Linear_kinetic_traits_2>
class Certificate_log_writer : public Event_certificates<Traits> {
 public:
  /// `out` must outlive this object; otherwise as for Event_certificates.
  Certificate_log_writer(std::ostream& out, const Kinetic_triangulation_2<Traits>& triangulation,
                         const Simulation_options& options = {});
};

extern template class Certificate_log_writer<Linear_kinetic_traits_2>;
extern template class Certificate_log_writer<Polynomial_kinetic_traits_2>;
extern template class Certificate_log_writer<Disc_kinetic_traits_2>;
extern template class Certificate_log_writer<Polynomial_disc_kinetic_traits_2>;
extern template class Certificate_log_writer<Periodic_kinetic_traits_2>;
extern template class Certificate_log_writer<Periodic_disc_kinetic_traits_2>;

}  // namespace kinetri

#endif  // KINETRI_IO_CERTIFICATE_LOG_H
