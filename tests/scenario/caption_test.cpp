#include <string>

#include <gtest/gtest.h>

#include "base/random.hpp"
#include "language/counts.hpp"

namespace lantern::run {
namespace {

std::optional<std::int64_t> count(std::string_view name) {
  if (name == "none") return 0;
  if (name == "one") return 1;
  if (name == "two") return 2;
  return std::nullopt;
}

std::optional<std::string> text(std::string_view name) {
  if (name == "texture") return "A {two}";
  return std::nullopt;
}

std::string filled(std::string_view caption) { return fill_caption(caption, text, count); }

TEST(Caption, QuotesCountsWithTheirNouns) {
  EXPECT_EQ(filled("{two} and {one}."), "2 and 1.");
  EXPECT_EQ(filled("{none:pair}, {one:pair}, {two:pair}"), "0 pairs, 1 pair, 2 pairs");
  EXPECT_EQ(filled("{one:leaf/leaves}, {two:leaf/leaves}"), "1 leaf, 2 leaves");
  EXPECT_EQ(filled("{two:Ghost × 2/Geister ö}"), "2 Geister ö");
}

TEST(Caption, PartsTheThousandsOfLongNumbers) {
  const auto said = [](std::int64_t n) {
    return fill_caption("{n}", nullptr, [&](std::string_view) { return n; });
  };
  EXPECT_EQ(said(9999), "9999");
  EXPECT_EQ(said(10'000), "10\u2009000");
  EXPECT_EQ(said(4'498'500), "4\u2009498\u2009500");
  EXPECT_EQ(said(-123'456), "-123\u2009456");
}

TEST(Caption, QuotesTextsAsTheyAre) {
  EXPECT_EQ(filled("{texture}!"), "A {two}!") << "what is quoted is not filled in again";
}

TEST(Caption, DoubledBracesAreBraces) {
  EXPECT_EQ(filled("{{two}} = {two}"), "{two} = 2");
  EXPECT_EQ(filled("{{{two}}}"), "{2}");
}

TEST(Caption, LeavesWhatItCannotFillIn) {
  EXPECT_EQ(filled("{three} { } {two"), "{three} { } {two");
  EXPECT_EQ(filled(""), "");
  EXPECT_EQ(fill_caption("{two} {texture}", {}, {}), "{two} {texture}");
}

Placeholder kind_of(std::string_view name) {
  if (count(name)) return Placeholder::count;
  return text(name) ? Placeholder::text : Placeholder::unknown;
}

TEST(Caption, MistakesAreFoundWhereTheyAre) {
  const auto problems = caption_problems("a {tow} {texture:n} } {two:} {} {one:a/} {", kind_of);
  ASSERT_EQ(problems.size(), 7u);
  const std::size_t offsets[] = {2, 8, 20, 22, 29, 32, 41};
  for (std::size_t i = 0; i < problems.size(); ++i) EXPECT_EQ(problems[i].offset, offsets[i]) << i;
  EXPECT_EQ(problems[0].unknown, "tow");
  EXPECT_TRUE(problems[0].message.empty());
  EXPECT_TRUE(caption_problems("{{two}} {two:x/y} {texture}", kind_of).empty());
}

// A caption without mistakes has no brace left that was not doubled.
TEST(Caption, WhatHasNoMistakesIsFilledInWhole) {
  constexpr std::string_view kPieces[] = {"{", "}", "{{", "}}", "{two}", "{one:n}", "x", ":", "/"};
  Random random(3);
  int good = 0;
  for (int round = 0; round < 3000; ++round) {
    std::string caption, plain;
    for (std::int64_t n = random.whole(0, 8); n > 0; --n)
      caption += kPieces[static_cast<std::size_t>(random.whole(0, 8))];
    std::size_t doubled = 0;
    if (!caption_problems(caption, kind_of).empty()) continue;
    for (std::size_t i = 0; i + 1 < caption.size(); ++i)
      if ((caption[i] == '{' || caption[i] == '}') && caption[i] == caption[i + 1]) ++doubled, ++i;
    const std::string result = filled(caption);
    std::size_t braces = 0;
    for (const char c : result) braces += c == '{' || c == '}' ? 1u : 0u;
    EXPECT_EQ(braces, doubled) << caption << " -> " << result;
    ++good;
  }
  EXPECT_GT(good, 100);
}

}  // namespace
}  // namespace lantern::run
