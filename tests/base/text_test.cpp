// Suggestions, JSON, long numbers, hash, random numbers.
#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>

#include <gtest/gtest.h>

#include "base/hash.hpp"
#include "base/json_writer.hpp"
#include "base/number.hpp"
#include "base/printable.hpp"
#include "base/random.hpp"
#include "base/suggest.hpp"

namespace lantern {
namespace {

constexpr std::array<std::string_view, 4> kKeys = {"capacity", "max_depth", "kind", "at"};

TEST(Utf8, WritesWhatItReads) {
  for (const char32_t code : {U'a', U'\x7f', U'\x80', U'ß', U'\u07ff', U'\u0800', U'日', U'\uffff',
                              U'\U00010000', U'😀', U'\U0010ffff'}) {
    std::string text = "x";
    append_utf8(text, code);
    const Letter read = first_letter(std::string_view(text).substr(1));
    EXPECT_EQ(read.code, code);
    EXPECT_EQ(read.bytes, text.size() - 1);
  }
}

TEST(Suggest, FindsTheNearestName) {
  EXPECT_EQ(nearest_name("capcity", kKeys), "capacity");
  EXPECT_EQ(nearest_name("Kind", kKeys), "kind") << "case is not a difference";
  EXPECT_EQ(nearest_name("maxdepth", kKeys), "max_depth");
  static constexpr std::string_view kVerbs[] = {"wake", "wait", "like", "look"};
  EXPECT_EQ(nearest_name("wati", kVerbs), "wait") << "two that have changed places are one slip";
  EXPECT_EQ(nearest_name("loko", kVerbs), "look");
  EXPECT_EQ(nearest_name("it", kKeys), "at") << "one letter may differ in a short name";
  EXPECT_EQ(nearest_name("gravity_of_the_world", kKeys), std::nullopt);
  EXPECT_EQ(nearest_name("zz", kKeys), std::nullopt) << "nothing of 'at' is left";
  EXPECT_EQ(nearest_name("x", {}), std::nullopt);
  EXPECT_EQ(nearest_name(std::string(100'000, 'c'), kKeys), std::nullopt);
}

TEST(Suggest, TakesTheFirstOfEquals) {
  constexpr std::array<std::string_view, 2> kTwins = {"left", "lift"};
  EXPECT_EQ(nearest_name("loft", kTwins), "left");
}

TEST(Suggest, ListsWhatThereIsBesideTheNearest) {
  EXPECT_EQ(suggestion("capcity", kKeys),
            "did you mean 'capacity'? known here: capacity, max_depth, kind, at");
  EXPECT_EQ(suggestion("capcity", kKeys, 3), "did you mean 'capacity'?");
  constexpr std::array<std::string_view, 1> kOnly = {"one"};
  EXPECT_EQ(suggestion("on", kOnly), "did you mean 'one'?") << "there is no other";
  EXPECT_EQ(suggestion("zzzz", kOnly), "known here: one");
  EXPECT_EQ(suggestion("gravity_of_all", kKeys), "known here: capacity, max_depth, kind, at");
  EXPECT_EQ(suggestion("gravity_of_all", kKeys, 3), "") << "a long list is no help";
  EXPECT_EQ(suggestion("x", {}), "");
}

TEST(Grouped, PutsThousandsApart) {
  EXPECT_EQ(grouped(0), "0");
  EXPECT_EQ(grouped(9999, " "), "9999") << "four digits are read at a glance";
  EXPECT_EQ(grouped(-9999, " "), "-9999");
  EXPECT_EQ(grouped(12345, " "), "12 345");
  EXPECT_EQ(grouped(-123456, " "), "-123 456") << "no gap after the sign";
  EXPECT_EQ(grouped(1234567), "1\u2009234\u2009567");
  EXPECT_EQ(grouped(std::numeric_limits<std::int64_t>::min(), " "), "-9 223 372 036 854 775 808");
}

TEST(Json, NumbersComeBackBitForBit) {
  Random random(1);
  const auto round_trips = [](double d) {
    JsonWriter json;
    json.value(d);
    return std::bit_cast<std::uint64_t>(std::strtod(json.text().c_str(), nullptr)) ==
           std::bit_cast<std::uint64_t>(d == 0 ? 0.0 : d);
  };
  for (const double d : {0.0, -0.0, 0.1, 1.0 / 3, 1e-300, std::numeric_limits<double>::max(),
                         std::numeric_limits<double>::denorm_min(), -123456789.125})
    EXPECT_TRUE(round_trips(d)) << d;
  for (int i = 0; i < 20'000; ++i) {
    const double d = std::bit_cast<double>(random.bits());
    ASSERT_TRUE(!std::isfinite(d) || round_trips(d)) << d;
  }
}

TEST(Json, WholeNumbersKeepAllDigits) {
  JsonWriter json;
  json.begin_array()
      .value(std::numeric_limits<std::uint64_t>::max())
      .value(std::numeric_limits<std::int64_t>::min())
      .value(true)
      .null()
      .end_array();
  EXPECT_EQ(json.text(), "[18446744073709551615, -9223372036854775808, true, null]");
}

TEST(Json, NestsAndBreaksLines) {
  JsonWriter json;
  json.begin_object().member("a", 1).key("b").begin_array();
  for (int i = 0; i < 2; ++i) json.line().begin_object().member("i", i).end_object();
  json.line().end_array().key("c").begin_object().end_object().end_object();
  EXPECT_EQ(json.text(), "{\"a\": 1, \"b\": [\n{\"i\": 0},\n{\"i\": 1}\n], \"c\": {}}");
}

TEST(Json, EscapesText) {
  EXPECT_EQ(json_string("a\"b\\c\nd\te\x01"), "\"a\\\"b\\\\c\\nd\\u0009e\\u0001\"");
  EXPECT_EQ(json_string("Ä × 2"), "\"Ä × 2\"") << "UTF-8 passes through";
  EXPECT_EQ(json_string("a\xff\xc3z\xed\xa0\x80"), "\"a\ufffd\ufffdz\ufffd\ufffd\ufffd\"");
  EXPECT_EQ(json_string("\x7f\u009b\u202e\u2028"), R"("\u007f\u009b\u202e\u2028")")
      << "JSON is printed on terminals, too";
}

// Against the table of well-formed sequences: every code point there is, and every two bytes.
TEST(Utf8, FirstLetterIsWhatTheStandardSays) {
  for (char32_t code = 0; code < 0x110000; ++code) {
    std::string text;
    if (code < 0x80)
      text = {static_cast<char>(code)};
    else if (code < 0x800)
      text = {static_cast<char>(0xc0 | code >> 6), static_cast<char>(0x80 | (code & 63))};
    else if (code < 0x10000)
      text = {static_cast<char>(0xe0 | code >> 12), static_cast<char>(0x80 | (code >> 6 & 63)),
              static_cast<char>(0x80 | (code & 63))};
    else
      text = {static_cast<char>(0xf0 | code >> 18), static_cast<char>(0x80 | (code >> 12 & 63)),
              static_cast<char>(0x80 | (code >> 6 & 63)), static_cast<char>(0x80 | (code & 63))};
    const bool surrogate = code >= 0xd800 && code < 0xe000;
    const Letter letter = first_letter(text + "\x80");
    ASSERT_EQ(letter.code, surrogate ? std::nullopt : std::optional(code)) << std::size_t{code};
    ASSERT_EQ(letter.bytes, surrogate ? 1 : text.size()) << std::size_t{code};
    if (text.size() > 1) {
      ASSERT_FALSE(first_letter(std::string_view(text).substr(0, text.size() - 1)).code)
          << "cut off: " << std::size_t{code};
    }
  }
  for (const char* bad : {"\x80", "\xc0\xaf", "\xc1\xbf", "\xe0\x9f\xbf", "\xf0\x8f\xbf\xbf",
                          "\xf4\x90\x80\x80", "\xf5\x80\x80\x80", "\xff", "\xc3(", "\xe2\x82("})
    EXPECT_FALSE(first_letter(bad).code) << bad;
  EXPECT_EQ(letters(""), 0u);
  EXPECT_EQ(letters("aé漢\xff\xf0\x9f\x8d\xb0\xc3"), 6u);
}

TEST(Printable, ShowsWhatATerminalWouldObey) {
  EXPECT_EQ(printable("Ä × 2 \\ \"漢\""), "Ä × 2 \\ \"漢\"");
  EXPECT_EQ(printable("\x1b[31m\a\b\x7f\n\t\r"), "\\x1b[31m\\x07\\x08\\x7f\\n\\t\\r");
  EXPECT_EQ(printable(std::string_view("\0", 1)), "\\x00");
  EXPECT_EQ(printable("\u009b1m\u0080\u202e\u2066\u200f\u2028\u061c"),
            "\\u009b1m\\u0080\\u202e\\u2066\\u200f\\u2028\\u061c");
  EXPECT_EQ(printable("\x9b\xff\xe2\x80"), "\\x9b\\xff\\xe2\\x80");
  EXPECT_EQ(printable_lines("a\n\x1b\nb"), "a\n\\x1b\nb") << "our own line breaks stay";
}

// What comes out is printable itself, whatever went in.
TEST(Printable, IsPrintableForAnyBytes) {
  Random random(9);
  for (int round = 0; round < 2000; ++round) {
    std::string text;
    for (int i = 0; i < 20; ++i)
      text += random.unit() < 0.2 ? std::string("\u202e")
                                  : std::string(1, static_cast<char>(random.whole(0, 255)));
    EXPECT_TRUE(is_printable(printable(text)));
    EXPECT_EQ(printable(printable(text)), printable(text));
    EXPECT_EQ(is_printable(text), printable(text) == text);
  }
}

TEST(JsonDeathTest, NoNumberThatIsNone) {
  JsonWriter json;
  EXPECT_DEATH(json.value(std::nan("")), "broken invariant");
}

TEST(Hash, IsFnv1aOnAnyMachine) {
  EXPECT_EQ(Hash().value(), 0xcbf29ce484222325u);
  // FNV-1a of the eight bytes of 1, the least significant first, computed by its definition.
  std::uint64_t expected = 0xcbf29ce484222325u;
  for (int byte = 0; byte < 8; ++byte)
    expected = (expected ^ (byte == 0 ? 1u : 0u)) * 1099511628211u;
  EXPECT_EQ(Hash().add(std::uint64_t{1}).value(), expected);
}

TEST(Hash, TellsApartAndEqual) {
  EXPECT_EQ(Hash().add(0.0).value(), Hash().add(-0.0).value()) << "equal values";
  EXPECT_NE(Hash().add(1.0).value(), Hash().add(std::nextafter(1.0, 2.0)).value());
  EXPECT_NE(Hash().add(1.0).add(2.0).value(), Hash().add(2.0).add(1.0).value());
  EXPECT_NE(Hash().add(std::string_view("ab")).add(std::string_view("c")).value(),
            Hash().add(std::string_view("a")).add(std::string_view("bc")).value())
      << "texts run into one another";
}

TEST(Random, IsSplitMix64) {
  // The first numbers of seed 1234567, as published with the algorithm's reference code.
  Random random(1234567);
  EXPECT_EQ(random.bits(), 6457827717110365317u);
  EXPECT_EQ(random.bits(), 3203168211198807973u);
}

TEST(Random, StaysInItsRanges) {
  Random random(9);
  bool lowest = false, highest = false;
  for (int i = 0; i < 10'000; ++i) {
    const double u = random.unit();
    EXPECT_TRUE(u >= 0 && u < 1);
    EXPECT_EQ(random.between(3, 3), 3);
    const auto w = random.whole(-2, 2);
    EXPECT_TRUE(w >= -2 && w <= 2);
    lowest |= w == -2;
    highest |= w == 2;
  }
  EXPECT_TRUE(lowest && highest) << "both ends belong to the range";
}

TEST(CheckDeathTest, ABrokenInvariantShowsBothValues) {
  EXPECT_DEATH(LANTERN_CHECK(1 + 1, ==, 3), "left 2, right 3");
}

}  // namespace
}  // namespace lantern
