// SPDX-License-Identifier: MIT
#include "io/bytes/json_reader.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
#include <string>

namespace loft::io {
namespace {

bool is_json(const std::string& text) {
  try {
    JsonReader json(text);
    json.skip();
    json.end();
  } catch (const JsonError&) {
    return false;
  }
  return true;
}

double number(const std::string& text) {
  JsonReader json(text);
  EXPECT_EQ(json.peek(), JsonKind::number) << text;
  const double result = json.number();
  json.end();
  return result;
}

std::string string(const std::string& text) {
  JsonReader json(text);
  EXPECT_EQ(json.peek(), JsonKind::string) << text;
  return json.string();
}

TEST(JsonReader, ReadsNumbersCorrectlyRounded) {
  for (const char* text :
       {"0", "-0", "1", "-17", "0.1", "1e3", "2.5E-3", "1e+2", "123456789012345678",
        "0.30000000000000004", "4.9e-324", "1.7976931348623157e308", "9007199254740993",
        "100000000000000000000000"}) {
    EXPECT_EQ(number(text), nlohmann::json::parse(text).get<double>()) << text;
  }
}

TEST(JsonReader, TellsTooSmallFromTooLarge) {
  EXPECT_EQ(number("1e-999"), 0.0);
  EXPECT_EQ(number("-0." + std::string(400, '0') + "1"), 0.0);
  EXPECT_EQ(number("1e999"), HUGE_VAL);
  EXPECT_EQ(number("-1e999"), -HUGE_VAL);
  EXPECT_EQ(number(std::string(400, '9')), HUGE_VAL);
}

TEST(JsonReader, ReadsStringsWithEscapes) {
  EXPECT_EQ(string(R"("plain")"), "plain");
  EXPECT_EQ(string(R"("\"\\\/\b\f\n\r\t")"), "\"\\/\b\f\n\r\t");
  EXPECT_EQ(string(R"("\u0041\u00e9\u20ac\ud83d\ude00")"), "A\xc3\xa9\xe2\x82\xac\xf0\x9f\x98\x80");
  EXPECT_EQ(string("\"\xc3\xa9\""), "\xc3\xa9");
}

TEST(JsonReader, NamesNumbersThatAreNone) {
  for (const std::string word : {"NaN", "nan", "Infinity", "-Infinity", "inf", "-inf"}) {
    JsonReader json(word);
    EXPECT_EQ(json.peek(), JsonKind::not_finite) << word;
    json.skip();
    EXPECT_EQ(json.last_word(), word);
  }
}

TEST(JsonReader, StringsComeBackFromTheirJson) {
  const std::string text = "a \"b\" \\ \n \x01 \xc3\xa9";
  std::string json;
  append_json_string(json, text);
  EXPECT_EQ(string(json), text);
  EXPECT_EQ(nlohmann::json::parse(json).get<std::string>(), text);
}

TEST(JsonReader, DepthIsNoDanger) {
  const std::string deep = std::string(1'000'000, '[') + std::string(1'000'000, ']');
  EXPECT_TRUE(is_json(deep));
  EXPECT_FALSE(is_json(std::string(1'000'000, '[')));
}

/// Oracle: nlohmann's parser accepts a text exactly if ours does. NaN is read by neither as JSON;
/// texts with a number too large for double are left out, since the two differ on purpose.
TEST(JsonReader, AcceptsWhatNlohmannAccepts) {
  const std::string seeds[] = {
      R"({"z": 1.25, "contours": [[[1, -2.5e-3], [0.5, 1E2]], []], "labels": ["h\u00e9", "\ud83d\ude00"]})",
      R"([true, false, null, {"a": {}, "b": []}, "", 0, -0.0])",
      "\"\xf0\x9f\x98\x80 \xc3\xa9 \xe2\x82\xac\""};
  const std::string alphabet =
      "{}[]\",:.0123456789-+eEtrufalsn\\ \t\x01\x80\xc3\xa9\xed\xa0\xf4\xff";
  std::mt19937 random(20240607);
  int accepted = 0;
  for (int round = 0; round < 60'000; ++round) {
    std::string text = seeds[random() % std::size(seeds)];
    for (auto edits = random() % 3; edits > 0; --edits) {
      const std::size_t place = random() % text.size();
      const char c = alphabet[random() % alphabet.size()];
      switch (random() % 3) {
        case 0:
          text[place] = c;
          break;
        case 1:
          text.insert(place, 1, c);
          break;
        default:
          text.erase(place, 1);
      }
    }
    bool expected = true;
    try {
      const auto parsed = nlohmann::json::parse(text);
    } catch (const nlohmann::json::out_of_range&) {
      continue;
    } catch (const nlohmann::json::parse_error&) {
      expected = false;
    }
    EXPECT_EQ(is_json(text), expected) << text;
    accepted += expected ? 1 : 0;
  }
  EXPECT_GT(accepted, 10'000);
}

}  // namespace
}  // namespace loft::io
