// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/io/certificate_log.h"

#include <ostream>
#include <span>

#include "kinetri/impl/base/check.h"
#include "kinetri/impl/io/json_writer.h"

namespace kinetri {
namespace {

void write_dyadic(Json_writer& json, const Rational& x) {
  Integer mantissa = numerator(x);
  const Integer denominator = boost::multiprecision::denominator(x);
  KINETRI_ASSERT(boost::multiprecision::msb(denominator) == boost::multiprecision::lsb(denominator),
                 "the numbers of a certificate are dyadic");
  long power = -static_cast<long>(boost::multiprecision::lsb(denominator));
  if (mantissa != 0) {
    const unsigned long zeros = boost::multiprecision::lsb(Integer(abs(mantissa)));
    mantissa >>= zeros;
    power += static_cast<long>(zeros);
  }
  json.begin_list();
  json.value(mantissa.str());
  json.value(power);
  json.end_list();
}

void write_failure(Json_writer& json, const Failure_certificate& failure) {
  json.key("polynomial");
  json.begin_list();
  for (const Integer& coefficient : failure.polynomial.coefficients()) {
    json.value(coefficient.str());
  }
  json.end_list();
  json.key("from");
  write_dyadic(json, failure.from);
  json.key("lower");
  write_dyadic(json, failure.lower);
  json.key("upper");
  write_dyadic(json, failure.upper);
  json.key("signs");
  json.begin_list();
  for (const std::vector<Sign>& row : failure.signs) {
    json.begin_list();
    for (const Sign sign : row) json.value(static_cast<int>(sign));
    json.end_list();
  }
  json.end_list();
  json.member("multiplicity", failure.multiplicity);
  json.key("touches");
  json.begin_list();
  for (const auto& [lower, upper] : failure.touches) {
    json.begin_list();
    write_dyadic(json, lower);
    write_dyadic(json, upper);
    json.end_list();
  }
  json.end_list();
}

}  // namespace

std::string certificate_line(const Event_certificate& certificate) {
  std::string line;
  Json_writer json(line);
  json.begin_object();
  json.member("event", certificate.event);
  json.member("kind", name(certificate.kind));
  json.key("points");
  json.begin_list();
  for (const Point_id id : certificate.points) json.value(id);
  json.end_list();
  if (!certificate.offsets.empty()) {
    json.key("offsets");
    json.begin_list();
    for (const auto& [x, y] : certificate.offsets) {
      json.begin_list();
      json.value(x);
      json.value(y);
      json.end_list();
    }
    json.end_list();
  }
  if (certificate.failure) {
    write_failure(json, *certificate.failure);
  } else {
    json.key("polynomial");
    json.null();
    json.member("reason", certificate.reason);
  }
  json.end_object();
  line += '\n';
  return line;
}

template <class Traits>
Certificate_log_writer<Traits>::Certificate_log_writer(
    std::ostream& out, const Kinetic_triangulation_2<Traits>& triangulation,
    const Simulation_options& options)
    : Event_certificates<Traits>(
          triangulation, options,
          [&out](const Event_certificate& certificate) { out << certificate_line(certificate); }) {}

template class Certificate_log_writer<Linear_kinetic_traits_2>;
template class Certificate_log_writer<Polynomial_kinetic_traits_2>;
template class Certificate_log_writer<Disc_kinetic_traits_2>;
template class Certificate_log_writer<Polynomial_disc_kinetic_traits_2>;
template class Certificate_log_writer<Periodic_kinetic_traits_2>;
template class Certificate_log_writer<Periodic_disc_kinetic_traits_2>;

}  // namespace kinetri
