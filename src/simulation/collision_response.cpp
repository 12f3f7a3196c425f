// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/simulation/collision_response.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>

#include "simulation/known_responses.h"

namespace kinetri {

Contact_response_2 log_contact(const Contact_2& /*contact*/) {
  return {};
}

Contact_response_2 swap_velocities(const Contact_2& contact) {
  if (!contact.is_pressed && contact.would_approach(contact.velocity_b, contact.velocity_a)) {
    return {};
  }
  return {contact.velocity_b, contact.velocity_a};
}

Contact_response_2 collide_elastically(const Contact_2& contact) {
  Vector_2 n = contact.separation;
  const double length = std::max(std::abs(n.x), std::abs(n.y));
  if (length == 0) return {};
  // Scaled by a power of two, which is exact: else the square might underflow.
  const int exponent = -std::ilogb(length);
  n = {std::scalbn(n.x, exponent), std::scalbn(n.y, exponent)};
  const auto size_of = [](const Vector_2& v) { return std::max(std::abs(v.x), std::abs(v.y)); };
  // Velocities whose differences might overflow are scaled as well.
  const double greatest = std::max({size_of(contact.velocity_a), size_of(contact.velocity_b),
                                    std::abs(contact.growth_a), std::abs(contact.growth_b)});
  const double scale = greatest > 0x1p1000 ? 0x1p10 : 1;
  const Vector_2 a = {contact.velocity_a.x / scale, contact.velocity_a.y / scale};
  const Vector_2 b = {contact.velocity_b.x / scale, contact.velocity_b.y / scale};
  const double growth = contact.growth_a / scale + contact.growth_b / scale;
  const double square = n.x * n.x + n.y * n.y;
  // For unit masses, as are the changes below. Without growth exactly 0 is subtracted.
  const double impulse =
      ((b.x - a.x) * n.x + (b.y - a.y) * n.y - growth * std::sqrt(square)) / square;
  // The parts of twice the impulse; exactly 1 and 1 if the masses are equal.
  const double part_a = 2 / (1 + contact.mass_a / contact.mass_b);
  const double part_b = 2 / (1 + contact.mass_b / contact.mass_a);
  const auto velocities = [&](double along) {
    const Vector_2 change = {along * n.x, along * n.y};
    return Contact_response_2{
        Vector_2{(a.x + part_a * change.x) * scale, (a.y + part_a * change.y) * scale},
        Vector_2{(b.x - part_b * change.x) * scale, (b.y - part_b * change.y) * scale}};
  };
  Contact_response_2 result = velocities(impulse);
  if (contact.is_pressed) return result;
  const double size = std::max({size_of(a), size_of(b), std::abs(growth)}) / size_of(n);
  for (double further =
           size * std::numeric_limits<double>::epsilon() + std::numeric_limits<double>::min();
       contact.would_approach(*result.velocity_a, *result.velocity_b); further *= 2) {
    if (further > size) return {};
    result = velocities(impulse - further);
  }
  return result;
}

Contact_response_2 stop_both(const Contact_2& /*contact*/) {
  return {.stops_a = true, .stops_b = true};
}

Contact_response_2 erase_both(const Contact_2& /*contact*/) {
  return {std::nullopt, std::nullopt, true, true};
}

namespace {

using Function = Contact_response_2 (*)(const Contact_2&);

// Whether a response is one of these.
bool is_one_of(const Collision_response& response, std::initializer_list<Function> functions) {
  const Function* const function = response.target<Function>();
  return function != nullptr && std::ranges::find(functions, *function) != functions.end();
}

}  // namespace

bool detail::is_pure(const Collision_response& response) {
  return is_one_of(response, {swap_velocities, collide_elastically, stop_both, erase_both});
}

bool detail::is_erase_both(const Collision_response& response) {
  return is_one_of(response, {erase_both});
}

bool detail::is_log_contact(const Collision_response& response) {
  return is_one_of(response, {log_contact});
}

Contact_response_2 detail::let_images_overlap(const Contact_2& /*contact*/) {
  return {};
}

bool detail::is_let_images_overlap(const Collision_response& response) {
  return is_one_of(response, {let_images_overlap});
}

}  // namespace kinetri
