// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/json/json_writer.h"

#include <gtest/gtest.h>
#include <rapidjson/document.h>

#include <cmath>
#include <limits>

namespace gnomon::report {
namespace {

TEST(JsonWriter, LinesAndInline) {
  StringSink sink;
  {
    JsonWriter json(sink);
    json.begin_object();
    json.member("a", 1);
    json.key("b");
    json.begin_array(JsonLayout::kInline);
    json.value(true);
    json.begin_object();
    json.end_object();
    json.null();
    json.end_array();
    json.key("c");
    json.begin_array();
    json.end_array();
    json.end_object();
    json.finish();
  }
  EXPECT_EQ(sink.text(), "{\n \"a\": 1,\n \"b\": [true, {}, null],\n \"c\": []\n}\n");
}

TEST(JsonWriter, StringsAreAlwaysValid) {
  const std::string nasty = std::string("a\"b\\c\n\t\x01\x7f") +
                            "\xff\xc3(\xe2\x82 é\xf0\x9f\x98\x80" + std::string("\xed\xa0\x80") +
                            std::string(1, '\0');
  StringSink sink;
  {
    JsonWriter json(sink);
    json.value(nasty);
    json.finish();
  }
  rapidjson::Document document;
  document.Parse<rapidjson::kParseValidateEncodingFlag>(sink.text().c_str());
  ASSERT_FALSE(document.HasParseError()) << sink.text();
  const std::string back(document.GetString(), document.GetStringLength());
  EXPECT_EQ(back.substr(0, 7), "a\"b\\c\n\t");
  EXPECT_NE(back.find("\xf0\x9f\x98\x80"), std::string::npos);
  EXPECT_NE(back.find("\xef\xbf\xbd"), std::string::npos);
}

TEST(JsonWriter, DoublesReadBackAndOthersAreNull) {
  for (const double value : {0.1, 1e-320, 1.7976931348623157e308, -0.0, 123456789.125, 1.0 / 3}) {
    StringSink sink;
    {
      JsonWriter json(sink);
      json.value(value);
    }
    EXPECT_EQ(std::strtod(sink.text().c_str(), nullptr), value) << sink.text();
  }
  StringSink sink;
  {
    JsonWriter json(sink);
    json.begin_array(JsonLayout::kInline);
    json.value(std::nan(""));
    json.value(-std::numeric_limits<double>::infinity());
    json.end_array();
  }
  EXPECT_EQ(sink.text(), "[null, null]");
}

}  // namespace
}  // namespace gnomon::report
