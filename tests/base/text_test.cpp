// Suggestions, JSON, long numbers, hash, random numbers.
#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>

#include <gtest/gtest.h>

#include "base/grouped.hpp"
#include "base/hash.hpp"
#include "base/json_writer.hpp"
#include "base/random.hpp"
#include "base/suggest.hpp"

namespace lantern {
namespace {

constexpr std::array<std::string_view, 4> kKeys = {"capacity", "max_depth", "kind", "at"};

TEST(Suggest, FindsTheNearestName) {
  EXPECT_EQ(nearest_name("capcity", kKeys), "capacity");
  EXPECT_EQ(nearest_name("Kind", kKeys), "kind") << "case is not a difference";
  EXPECT_EQ(nearest_name("maxdepth", kKeys), "max_depth");
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

TEST(Suggest, ListsWhatThereIsWhenNothingIsNear) {
  EXPECT_EQ(suggestion("capcity", kKeys), "did you mean 'capacity'?");
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
