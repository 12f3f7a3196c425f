// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/impl/events/observer_list.h"

#include <gtest/gtest.h>

#include <functional>
#include <stdexcept>
#include <string>

namespace kinetri::observer_list_test {
namespace {

struct Named {
  char name;
};
using List = detail::Observer_list<Named>;

// The names of those that are called; after each, `then` is called.
std::string called(
    List& list, const std::function<void(const Named&)>& then = [](const Named&) {}) {
  std::string result;
  list.call([&](Named& named) {
    result += named.name;
    then(named);
  });
  return result;
}

TEST(Observer_list, calls_in_the_order_of_addition) {
  Named a{'a'};
  Named b{'b'};
  Named c{'c'};
  List list;
  EXPECT_TRUE(list.empty());
  list.add(b);
  list.add(a);
  EXPECT_EQ(called(list), "ba");
  list.remove(c);
  list.remove(b);
  EXPECT_EQ(called(list), "a");
  list.remove(a);
  EXPECT_TRUE(list.empty());
}

TEST(Observer_list, lets_observers_remove_themselves_and_others) {
  Named a{'a'};
  Named b{'b'};
  Named c{'c'};
  List list;
  for (Named* const named : {&a, &b, &c}) list.add(*named);
  EXPECT_EQ(called(list, [&](const Named& named) { list.remove(named); }), "abc");
  EXPECT_TRUE(list.empty());
  for (Named* const named : {&a, &b, &c}) list.add(*named);
  EXPECT_EQ(called(list,
                   [&](const Named& named) {
                     if (named.name == 'b') {
                       list.remove(a);
                       list.remove(c);
                       EXPECT_FALSE(list.any_of([](const Named& n) { return n.name == 'c'; }));
                     }
                   }),
            "ab");
  EXPECT_EQ(called(list), "b");
}

TEST(Observer_list, calls_those_that_are_added_from_the_next_call_on) {
  Named a{'a'};
  Named b{'b'};
  List list;
  list.add(a);
  EXPECT_EQ(called(list, [&](const Named&) { list.add(b); }), "a");
  EXPECT_EQ(called(list), "ab");
}

// A call within a call leaves what the outer one has yet to call.
TEST(Observer_list, may_be_called_within_a_call) {
  Named a{'a'};
  Named b{'b'};
  Named c{'c'};
  List list;
  for (Named* const named : {&a, &b, &c}) list.add(*named);
  std::string inner;
  EXPECT_EQ(called(list,
                   [&](const Named& named) {
                     if (named.name != 'a') return;
                     list.remove(a);
                     inner = called(list);
                   }),
            "abc");
  EXPECT_EQ(inner, "bc");
  EXPECT_EQ(called(list), "bc");
}

TEST(Observer_list, is_whole_after_an_observer_has_thrown) {
  Named a{'a'};
  Named b{'b'};
  List list;
  list.add(a);
  list.add(b);
  EXPECT_THROW(called(list,
                      [&](const Named&) {
                        list.remove(a);
                        throw std::runtime_error("enough");
                      }),
               std::runtime_error);
  EXPECT_EQ(called(list), "b");
  list.remove(b);
  EXPECT_TRUE(list.empty());
}

}  // namespace
}  // namespace kinetri::observer_list_test
