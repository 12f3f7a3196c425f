// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/impl/io/json_writer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

namespace kinetri::json_writer_test {
namespace {

void write_sample(Json_writer& json) {
  json.begin_object();
  json.member("n", 1);
  json.key("list");
  json.begin_list();
  json.value(-2);
  json.value(2.0);
  json.begin_object();
  json.end_object();
  json.begin_list();
  json.null();
  json.end_list();
  json.end_list();
  json.member("is", true);
  json.end_object();
}

TEST(Json_writer, writes_on_one_line_or_with_indentation) {
  std::string text = "before ";
  Json_writer json(text);
  write_sample(json);
  EXPECT_EQ(text, R"(before {"n":1,"list":[-2,2.0,{},[null]],"is":true})");
  std::string lines;
  Json_writer indented(lines, 2);
  write_sample(indented);
  EXPECT_EQ(
      lines,
      "{\n  \"n\": 1,\n  \"list\": [\n    -2,\n    2.0,\n    {},\n    [\n      null\n    ]\n  "
      "],\n  \"is\": true\n}");
}

template <class Value>
std::string written(const Value& value) {
  std::string text;
  Json_writer(text).value(value);
  return text;
}

TEST(Json_writer, writes_numbers_that_read_back_and_texts_in_ascii) {
  EXPECT_EQ(written(0.1), "0.1");
  EXPECT_EQ(written(-0.0), "-0.0");
  EXPECT_EQ(written(5e-324), "5e-324");
  EXPECT_EQ(written(std::numeric_limits<double>::infinity()), "null");
  EXPECT_EQ(written(std::numeric_limits<std::uint64_t>::max()), "18446744073709551615");
  EXPECT_EQ(written(std::numeric_limits<std::int64_t>::min()), "-9223372036854775808");
  EXPECT_EQ(written("a\"\\\n\xC3\xA4"), R"("a\"\\\n\u00e4")");
  EXPECT_EQ(written("\xFF"), R"("\ufffd")");
}

}  // namespace
}  // namespace kinetri::json_writer_test
