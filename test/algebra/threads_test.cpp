// SPDX-License-Identifier: GPL-3.0-or-later
//
// Several threads call const functions of the same numbers at once: what each of them finds is what
// one thread finds alone. ThreadSanitizer says whether they race (scripts/test.sh --preset tsan).
#include <gtest/gtest.h>

#include <latch>
#include <memory>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "algebra/rounded_quotient.h"
#include "kinetri/algebra/algebraic_number.h"
#include "kinetri/algebra/real_roots.h"

namespace kinetri::algebra_threads_test {
namespace {

constexpr int thread_count = 4;

// Calls work(i) in each of several threads i at the same time.
template <class Work>
void in_threads(const Work& work) {
  std::latch start(thread_count);
  std::vector<std::jthread> threads;
  threads.reserve(thread_count);
  for (int i = 0; i < thread_count; ++i) {
    threads.emplace_back([&start, &work, i] {
      start.arrive_and_wait();
      work(i);
    });
  }
}

// The root of t^2 - c between 1 and 3, of a polynomial that is made when it is needed.
class Square_root : public Root_source {
 public:
  explicit Square_root(int c) : c_(c) {}
  Polynomial polynomial() const override { return Polynomial{-c_, 0, 1}; }
  double certain_value_at(double high, double low) const override {
    // Too near to the root nothing is certain.
    const double value = (high + low) * (high + low) - c_;
    return value < -1e-9 || value > 1e-9 ? value : 0;
  }

 private:
  int c_;
};

// Numbers in no order. Some are equal and have different polynomials, some are rational and not
// known to be, some have no polynomial yet, some are copies of others.
std::vector<Algebraic_number> some_numbers() {
  const Double_interval bracket = {1, 3};
  const Polynomial two{-2, 0, 1};
  const Polynomial three{-3, 0, 1};
  std::vector<Algebraic_number> result = {
      {two, 1, 2},
      {two * three, Rational(4, 3), Rational(3, 2)},
      {std::make_shared<Square_root>(2), bracket},
      {std::make_shared<Square_root>(2), bracket},
      {std::make_shared<Square_root>(3), bracket},
      {three * Polynomial{-5, 0, 0, 1}, Rational(171, 100), Rational(9, 5)},
      {Polynomial{-9, 0, 4} * two, Rational(149, 100), Rational(2)},  // 3/2
      {std::make_shared<Square_root>(4), bracket},                    // 2
      1.5,
      Rational(3, 2),
      Rational(7, 5),
  };
  result.push_back(result[0]);
  result.push_back(result[3]);
  result.push_back(-result[0]);
  return result;
}

// What const functions say of a number and its order among the others, as far as that does not
// depend on what was asked before.
std::vector<std::string> findings(const std::vector<Algebraic_number>& numbers, std::size_t first) {
  const Polynomial p{-6, 0, 5, 0, -1};  // roots at the square roots of 2 and 3
  std::vector<std::string> result(numbers.size());
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const std::size_t i = (first + k) % numbers.size();  // each thread begins elsewhere
    const Algebraic_number& x = numbers[i];
    std::ostringstream out;
    out.precision(17);
    if (first % 2 == 0) x.refine_to(scaled_by_power_of_two(1, -static_cast<long>(20 * k)));
    for (const Algebraic_number& y : numbers) out << compare(x, y) << ' ';
    out << compare(x, Rational(7, 5)) << ' ' << x.to_double() << ' ' << x.tight_interval().lower
        << ' ' << x.tight_interval().upper << ' ' << sign_at(p, x) << ' ' << sign_just_before(p, x)
        << ' ' << sign_just_after(p, x) << ' ' << x.is_root_of(p) << ' ' << (-x).to_double() << ' '
        << x.detached().to_double() << ' '
        << rounded_quotient(Polynomial{1, 1}, Polynomial{5, 2}, x) << ' '
        << failure_time(p, x).has_value() << ' '
        << simplest_between(x, Rational(x.upper() + 1000)).str();
    x.refine();
    x.refine_to_bits(80);
    // These change as the number is refined; each must enclose it all the same.
    const Rational_interval interval = x.isolating_interval();
    const Double_interval rounded = x.interval();
    const bool is_enclosed = compare(x, interval.lower) != CGAL::SMALLER &&
                             compare(x, interval.upper) != CGAL::LARGER &&
                             compare(x, to_rational(rounded.lower)) != CGAL::SMALLER &&
                             compare(x, to_rational(rounded.upper)) != CGAL::LARGER;
    out << ' ' << is_enclosed << ' ' << x.is_root_of(x.polynomial());
    if (x.is_known_rational()) out << ' ' << x.rational().str();
    std::ostringstream printed;
    printed << x;
    out << ' ' << !printed.str().empty();
    result[i] = out.str();
  }
  return result;
}

TEST(Threads, find_of_shared_numbers_what_one_finds) {
  const std::vector<std::string> expected = findings(some_numbers(), 0);
  for (int round = 0; round < 20; ++round) {
    const std::vector<Algebraic_number> numbers = some_numbers();
    std::vector<std::vector<std::string>> found(thread_count);
    in_threads([&](int i) {
      // Handles of one's own of the same numbers, for every second thread.
      const std::vector<Algebraic_number> copies = numbers;
      const auto index = static_cast<std::size_t>(i);
      found[index] = findings(i < 2 ? numbers : copies, 3 * index);
    });
    for (const std::vector<std::string>& f : found) ASSERT_EQ(f, expected) << "round " << round;
  }
}

// The representation is made once, though all threads ask for it at once.
TEST(Threads, make_one_representation) {
  for (int round = 0; round < 200; ++round) {
    const Algebraic_number number(std::make_shared<Square_root>(2), Double_interval{1, 3});
    std::vector<Rational> squares(thread_count);
    in_threads([&](int i) {
      number.refine_to(Rational(1, 1 << i));
      const Rational lower = number.lower();
      squares[static_cast<std::size_t>(i)] = lower * lower;
    });
    for (const Rational& square : squares) {
      ASSERT_LT(square, 2);
      ASSERT_GE(square, 1);
    }
    EXPECT_LE(number.upper() - number.lower(), Rational(1, 1 << (thread_count - 1)));
  }
}

}  // namespace
}  // namespace kinetri::algebra_threads_test
