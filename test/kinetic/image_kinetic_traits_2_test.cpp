// SPDX-License-Identifier: GPL-3.0-or-later
//
// Certificates of images of points in a periodic box, and the predicates at an instant.
#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "kinetri/algebra/real_roots.h"
#include "kinetri/kinetic/basic_kinetic_traits_2.h"
#include "kinetri/kinetic/image_motion_2.h"
#include "support/images.h"
#include "support/on_failure.h"
#include "support/precondition_error.h"

namespace kinetri::image_kinetic_traits_2_test {
namespace {

using Kind = Certificate::Kind;
using Time = Algebraic_number;
using Traits = Basic_kinetic_traits_2<Image_motion_2>;

constexpr Double_interval for_ever = {-std::numeric_limits<double>::infinity(),
                                      std::numeric_limits<double>::infinity()};

std::array<Moving_image_2, 4> points(const std::array<Image_motion_2, 4>& m) {
  return {Moving_image_2(m[0]), Moving_image_2(m[1]), Moving_image_2(m[2]), Moving_image_2(m[3])};
}

std::vector<Time> times_of(const Polynomial& p, double t) {
  std::vector<Time> result = {t};
  if (p.degree() < 1) return result;
  for (const Real_root& root : real_roots(p)) result.push_back(root.value);
  return result;
}

class Image_traits : public testing::TestWithParam<int> {};

// The certificate says when the polynomial fails, from t on, or less.
template <class Failure>
void expect_failure(const Certificate& certificate, const Polynomial& p, const Time& t,
                    const Failure& failure) {
  const std::optional<Time> expected = failure_time(p, t);
  switch (certificate.kind) {
    case Kind::never_fails:
      EXPECT_FALSE(expected);
      break;
    case Kind::holds:
      EXPECT_TRUE(!expected || *expected >= Time(certificate.bounds.lower));
      break;
    case Kind::fails:
      ASSERT_TRUE(expected);
      EXPECT_EQ(certificate.failure ? *certificate.failure : failure(certificate.bounds),
                *expected);
      break;
    default:
      FAIL() << "unknown";
  }
}

TEST_P(Image_traits, decide_as_polynomials_by_definition) {
  test::Images source(61);
  for (int i = 0; i < test::cases(15); ++i) {
    const auto m = source.next(GetParam());
    const test::On_failure trace([&] { return test::describe(m); });
    const auto all = points(m);
    const auto& p = all[0];
    const auto& q = all[1];
    const auto& r = all[2];
    const auto& s = all[3];
    const Polynomial outside = -test::perturbed_determinant(m);
    const auto paths = test::paths_of(m);
    const Polynomial turn = test::turn_of(paths[0], paths[1], paths[2]);
    for (const Arithmetic arithmetic : {Arithmetic::filtered, Arithmetic::exact_only}) {
      const Traits traits(arithmetic);
      for (const Time& t : times_of(test::lifted_determinant(0, m), source.time())) {
        const Instant after = {t, Time_side::after};
        EXPECT_EQ(traits.instantaneous_traits(after).side_of_oriented_circle_2_object()(p, q, r, s),
                  -sign_just_after(outside, t));
        EXPECT_EQ(traits.instantaneous_traits(Instant{t, Time_side::at})
                      .side_of_oriented_circle_2_object()(p, q, r, s),
                  sign_at(test::lifted_determinant(0, m), t));
        expect_failure(traits.in_circle_certificate(p, q, r, s, t, Certificate_state::any), outside,
                       t, [&](const auto& in) { return traits.in_circle_failure(p, q, r, s, in); });
        EXPECT_EQ(traits.instantaneous_traits(after).orientation_2_object()(p, q, r),
                  sign_just_after(turn, t));
        if (HasFailure()) return;
      }
      for (const Time& t : times_of(turn, source.time())) {
        expect_failure(traits.orientation_certificate(p, q, r, t, Certificate_state::any), turn, t,
                       [&](const auto& in) { return traits.orientation_failure(p, q, r, in); });
        EXPECT_EQ(
            traits.instantaneous_traits(Instant{t, Time_side::at}).orientation_2_object()(p, q, r),
            sign_at(turn, t));
      }
      // Distances, with a range that is reached at a time or not.
      const double range = static_cast<double>(i % 4);
      const auto [a, b, c, d, e] = test::paths_of(std::array<Image_motion_2, 5>{
          m[0], m[1], m[2], m[3], Image_motion_2{{{range, 0}, {0, 0}, 0}, {}, m[0].box}});
      const auto square = [](const auto& u, const auto& v) {
        return (u[0] - v[0]) * (u[0] - v[0]) + (u[1] - v[1]) * (u[1] - v[1]);
      };
      const Polynomial gap = square(a, b) - e[0] * e[0];
      const Polynomial closer = square(c, d) - square(a, b);
      const auto contact = [&](const auto& in) { return traits.contact_failure(p, q, range, in); };
      for (const Time& t : times_of(gap, source.time())) {
        EXPECT_EQ(traits.do_touch(p, q, range, t), sign_at(gap, t) != CGAL::POSITIVE);
        expect_failure(traits.near_certificate(p, q, range, t), -gap, t, contact);
        // Apart until the first time, `t` included, at which the gap is not positive.
        const Certificate apart = traits.apart_certificate(p, q, range, t);
        std::optional<Time> touch;
        if (sign_at(gap, t) != CGAL::POSITIVE) {
          touch = t;
        } else if (const auto root = first_root_after(gap, t)) {
          touch = root->value;
        }
        ASSERT_EQ(apart.kind, touch ? Kind::fails : Kind::never_fails);
        if (touch) {
          EXPECT_EQ(apart.failure ? *apart.failure : contact(apart.bounds), *touch);
        }
        if (HasFailure()) return;
      }
      for (const Time& t : times_of(closer, source.time())) {
        expect_failure(traits.closer_certificate(p, q, r, s, t), closer, t,
                       [&](const auto& in) { return traits.closer_failure(p, q, r, s, in); });
        if (HasFailure()) return;
      }
      // A coincidence is a common root.
      const Time t = source.time();
      const Certificate apart = traits.coincidence_certificate(p, q, t, for_ever);
      const Polynomial both = gcd(paths[0][0] - paths[1][0], paths[0][1] - paths[1][1]);
      std::optional<Real_root> meeting;
      if (both.degree() > 0) meeting = first_root_after(both, t);
      EXPECT_EQ(apart.kind, meeting ? Kind::fails : Kind::never_fails);
      if (meeting) {
        ASSERT_NE(apart.failure, nullptr);
        EXPECT_EQ(*apart.failure, meeting->value);
      }
      if (HasFailure()) return;
    }
    // In batches, if the filter decides; `beyond` are images of the same box.
    const Traits traits;
    const Time t = source.time();
    const Flip_neighborhood<Moving_image_2> around = {{&p, &q, &r, &s}, {&s, &r, &q, &p}};
    const auto five = traits.certificates_after_flip(around, t.interval());
    const auto two = traits.in_circle_certificates({{{&p, &q, &r, &s}, {&q, &p, &r, &s}}}, t);
    const auto expect_same = [&](const Certificate& certificate, const Polynomial& polynomial) {
      if (certificate.kind == Kind::unknown) return;
      expect_failure(certificate, polynomial, t, [&](const Double_interval& in) {
        return Time(odd_part(polynomial), to_rational(in.lower), to_rational(in.upper));
      });
    };
    const Polynomial unperturbed = -test::lifted_determinant(0, m);
    expect_same(two[0], unperturbed);
    expect_same(two[1], -unperturbed);
    for (const std::size_t k : {0U, 1U}) {
      const auto [a, b, c, d] = around.certificate(k);
      expect_same(five[k], -test::lifted_determinant(
                               0, {a->motion(), b->motion(), c->motion(), d->motion()}));
    }
    if (HasFailure()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, Image_traits, testing::Range(0, test::Images::kinds),
                         test::kind_name);

// The lattice of one point.
struct Lattice {
  explicit Lattice(const Periodic_box_2& of) : box(of) {}
  Moving_image_2 at(int x, int y) const {
    return Moving_image_2({{{0.3, 0.7}, {5, -3}, 1}, {x, y}, &box}, 0);
  }
  // The sign of the diagonal from (0, 0) to (1, 1), just after a time: positive if the other image
  // is inside of the circle of a triangle at this diagonal.
  Sign diagonal(double t) const {
    return Traits()
        .instantaneous_traits(Instant{Time(t), Time_side::after})
        .side_of_oriented_circle_2_object()(at(0, 0), at(1, 0), at(1, 1), at(0, 1));
  }
  Periodic_box_2 box;
};

TEST(Image_traits, decide_one_diagonal_of_a_box_that_stays_a_rectangle) {
  // By x y, which favors one diagonal of an upright rectangle.
  const Lattice square(Periodic_box_2({{1, 0}, {0, 0}, 0}, {{0, 1}, {0, 0}, 0}));
  const Sign upright = square.diagonal(0);
  EXPECT_NE(upright, CGAL::ZERO);
  // The same while it grows, wherever its corner is.
  const Lattice growing(Periodic_box_2({{1, 0}, {1, 0}, 0}, {{0, 3}, {0, 0.5}, 0}));
  EXPECT_EQ(growing.diagonal(0), upright);
  EXPECT_EQ(growing.diagonal(7), upright);
  const Traits traits;
  const Time start = 0.0;
  const auto certificate = [&](const Lattice& l, int x, int y) {
    return traits.in_circle_certificate(l.at(x, y), l.at(x + 1, y), l.at(x + 1, y + 1),
                                        l.at(x, y + 1), start, Certificate_state::any);
  };
  for (const int far : {0, 1, -1000, 2147483646}) {
    EXPECT_EQ(certificate(square, far, 1 - far).kind,
              upright == CGAL::POSITIVE ? Kind::fails : Kind::never_fails);
  }
  // A square on its corner: x y is zero too, and x^2 decides.
  const Lattice on_corner(Periodic_box_2({{1, -1}, {0, 0}, 0}, {{1, 1}, {0, 0}, 0}));
  EXPECT_NE(on_corner.diagonal(0), CGAL::ZERO);
}

TEST(Image_traits, fail_when_a_sheared_lattice_passes_a_rectangle) {
  // The diagonal from (0, 0) to (1, 1) is the longer one from then on.
  const Lattice sheared(Periodic_box_2({{2, 0}, {0, 0}, 0}, {{-0.5, 1}, {0.25, 0}, 0}));
  EXPECT_EQ(sheared.diagonal(0), CGAL::NEGATIVE);
  EXPECT_EQ(sheared.diagonal(2.5), CGAL::POSITIVE);
  const Traits traits = Traits::exact();
  const Certificate certificate =
      traits.in_circle_certificate(sheared.at(0, 0), sheared.at(1, 0), sheared.at(1, 1),
                                   sheared.at(0, 1), Time(0.0), Certificate_state::any);
  ASSERT_EQ(certificate.kind, Kind::fails);
  EXPECT_EQ(certificate.failure
                ? *certificate.failure
                : traits.in_circle_failure(sheared.at(0, 0), sheared.at(1, 0), sheared.at(1, 1),
                                           sheared.at(0, 1), certificate.bounds),
            Time(2.0));
}

// Discs coincide if their weights are equal, too; also with one center for ever.
TEST(Image_traits, of_discs_coincide_at_the_time_of_equal_weights) {
  const Basic_kinetic_traits_2<Image_disc_motion_2> traits;
  const auto disc = [](const Linear_motion_2& motion, const Lattice_offset_2& offset,
                       const Periodic_box_2& box, double radius, double growth) {
    return Moving_image_disc_2(image_of(Disc_motion_2{motion, radius, growth, 0}, offset, &box));
  };
  const auto failure = [&](const Moving_image_disc_2& p, const Moving_image_disc_2& q) {
    const Certificate apart = traits.coincidence_certificate(p, q, Time(0.0), for_ever);
    return apart.kind == Kind::fails ? std::optional(*apart.failure) : std::nullopt;
  };
  const Periodic_box_2 box({{3, 0}, {0, 0}, 0}, {{0, 3}, {0, 0}, 0});
  const Periodic_box_2 sheared({{3, 0}, {0, 0}, 0}, {{0, 3}, {1, 0}, 0});
  const Linear_motion_2 at_rest = {{0.5, 1}, {0, 0}, 0};
  const Moving_image_disc_2 p = disc(at_rest, {0, 0}, box, 1, 1);
  EXPECT_EQ(failure(p, disc({{3.5, 1}, {0, 0}, 0}, {-1, 0}, box, 2, 0)), Time(1.0));
  EXPECT_EQ(failure(p, disc({{3.5, 1}, {0, 0}, 0}, {0, 0}, box, 2, 0)), std::nullopt);
  EXPECT_EQ(failure(p, disc({{3.5, 1}, {0, 0}, 0}, {-1, 1}, box, 2, 0)), std::nullopt);
  // The velocity of the disc cancels the rate of the box.
  EXPECT_EQ(failure(disc(at_rest, {0, 0}, sheared, 1, 1),
                    disc({{0.5, -2}, {-1, 0}, 0}, {0, 1}, sheared, 2, 0)),
            Time(1.0));
  // They meet at the time 1, with equal weights or not.
  for (const double radius : {1.0, 2.0}) {
    const auto meeting = failure(disc(at_rest, {0, 0}, sheared, 1, 0),
                                 disc({{-0.5, -2}, {0, 0}, 0}, {0, 1}, sheared, radius, 0));
    EXPECT_EQ(meeting, radius == 1 ? std::optional(Time(1.0)) : std::nullopt);
  }
  EXPECT_TRUE(
      same_trajectory(p.motion(), disc({{3.5, 1}, {0, 0}, 0}, {-1, 0}, box, 1, 1).motion()));
  EXPECT_FALSE(
      same_trajectory(p.motion(), disc({{3.5, 1}, {0, 0}, 0}, {-1, 0}, box, 1, 0).motion()));
}

TEST(Image_traits, coincide_across_the_border_at_an_exact_time) {
  const Periodic_box_2 box({{3, 0}, {0, 0}, 0}, {{0, 3}, {0, 0}, 0});
  const Moving_image_2 p({{{0.5, 1}, {-1, 0}, 0}, {0, 0}, &box}, 0);
  const Moving_image_2 q({{{2.5, 1}, {2, 0}, 0}, {-1, 0}, &box}, 1);
  const Traits traits;
  const Certificate meet = traits.coincidence_certificate(p, q, Time(0.0), for_ever);
  ASSERT_EQ(meet.kind, Kind::fails);
  ASSERT_NE(meet.failure, nullptr);
  EXPECT_EQ(*meet.failure, Time(Rational(1, 3)));
  // A point never meets its own image.
  const Moving_image_2 image({p.motion().motion, {0, 1}, &box}, 0);
  EXPECT_EQ(traits.coincidence_certificate(p, image, Time(0.0), for_ever).kind, Kind::never_fails);
}

TEST(Image_traits, have_failure_times_that_outlive_the_box_and_the_points) {
  const auto failure = [](bool is_turn) {
    const auto box = std::make_unique<Periodic_box_2>(Linear_motion_2{{2, 0}, {0, 0}, 0},
                                                      Linear_motion_2{{-0.5, 1}, {0.25, 0.125}, 0});
    const auto at = [&](int x, int y) {
      return Moving_image_2({{{0.1, 0.2}, {0, 0}, 0}, {x, y}, box.get()});
    };
    const Moving_image_2 other({{{0.1, 1.5}, {0, 0}, 0}, {0, 0}, nullptr});
    return is_turn ? Traits().orientation_failure(at(0, 0), at(0, 1), other, {0.5, 5.0})
                   : Traits().in_circle_failure(at(0, 0), at(1, 0), at(1, 1), at(0, 1), {0.5, 5.0});
  };
  const Time circle = failure(false);
  const Time turn = failure(true);
  EXPECT_EQ(circle, Time(2.0)) << "at which the second vector is upright";
  EXPECT_EQ(circle.to_double(), 2.0);
  EXPECT_EQ(turn, Time(2.0));
}

TEST(Image_traits, of_the_offset_zero_need_no_box_beside_one_that_grows) {
  // The images p and q are 1 + t apart, r and s are 3 apart.
  const Periodic_box_2 box({{1, 0}, {1, 0}}, {{0, 1}, {0, 0}});
  const Moving_image_2 p({{{0, 0}, {0, 0}}, {}, nullptr});
  const Moving_image_2 q({{{0, 0}, {0, 0}}, {1, 0}, &box});
  const Moving_image_2 s({{{3, 0}, {0, 0}}, {}, nullptr});
  for (const Arithmetic arithmetic : {Arithmetic::filtered, Arithmetic::exact_only}) {
    const Traits traits(arithmetic);
    const Certificate closer = traits.closer_certificate(p, q, p, s, Time(0));
    ASSERT_EQ(closer.kind, Kind::fails);
    EXPECT_EQ(closer.failure ? *closer.failure : traits.closer_failure(p, q, p, s, closer.bounds),
              Time(2));
  }
}

TEST(Image_traits, refuse_images_of_different_boxes) {
  const Periodic_box_2 box({{3, 0}, {0, 0}, 0}, {{0, 3}, {0, 0}, 0});
  const Periodic_box_2 other({{3, 0}, {0, 0}, 0}, {{0, 4}, {0, 0}, 0});
  const auto at = [](const Periodic_box_2& of, int x) { return Moving_image_2({{}, {x, 0}, &of}); };
  EXPECT_PRECONDITION_ERROR(
      Traits().orientation_failure(at(box, 0), at(box, 1), at(other, 2), {0.0, 1.0}),
      "the images of a certificate have different boxes");
}

}  // namespace
}  // namespace kinetri::image_kinetic_traits_2_test
