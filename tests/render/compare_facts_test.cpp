#include <gtest/gtest.h>

#include "render/compare.hpp"
#include "render/png.hpp"

namespace lantern::render {
namespace {

std::string first(const char* expected, const char* actual) {
  const auto compared = compare_facts(expected, actual);
  if (!compared) return "no facts";
  return compared->total == 0 ? "equal" : finding(*compared);
}

TEST(CompareFacts, NamesTheMemberThatDiffers) {
  EXPECT_EQ(first(R"({"a": [1, {"b": 2}]})", R"({"a": [1, {"b": 3}]})"),
            "a[1].b: expected 2, found 3");
  EXPECT_EQ(first(R"({"a": "x"})", R"({"a": 1})"), "a: expected \"x\", found 1");
  EXPECT_EQ(first(R"({"a": 1})", R"({"b": 1})"), "a: expected 1, found nothing, and 1 more");
  EXPECT_EQ(first(R"({"p": [[0, 1]]})", R"({"p": [[0, 1], [0, 2]]})"),
            "p: expected 1 element, found 2 elements");
}

TEST(CompareFacts, CountsComeFirstAndWhatFollowsFromOthersLast) {
  EXPECT_EQ(first(R"({"hash": "a", "pairs": [[0, 1]], "counts": {"pairs": 1}})",
                  R"({"hash": "b", "pairs": [], "counts": {"pairs": 0}})"),
            "counts.pairs: expected 1, found 0, and 2 more");
  const auto all = compare_facts(R"({"hash": 1, "x": 1})", R"({"hash": 2, "x": 2})");
  ASSERT_TRUE(all);
  EXPECT_EQ(all->differences.back().path, "hash");
}

TEST(CompareFacts, ElementsWithANameAreComparedByIt) {
  EXPECT_EQ(first(R"({"bodies": [{"id": 0, "name": "ann", "x": 1}, {"id": 1, "name": "bob"}]})",
                  R"({"bodies": [{"id": 1, "name": "bob"}, {"id": 0, "name": "ann", "x": 2}]})"),
            "bodies[ann].x: expected 1, found 2");
  EXPECT_EQ(first(R"({"nodes": [{"id": 0}]})", R"({"nodes": [{"id": 0}, {"id": 4}]})"),
            "nodes[4]: expected nothing, found {\"id\":4}");
  EXPECT_EQ(first(R"({"b": [{"name": "a", "x": 1}, {"name": "a", "x": 2}]})",
                  R"({"b": [{"name": "a", "x": 1}, {"name": "a", "x": 3}]})"),
            "b[1].x: expected 2, found 3")
      << "two of one name are compared by place";
}

TEST(CompareFacts, WhatAFileWasMadeFromIsNoFact) {
  EXPECT_EQ(first(R"({"a": 1, "made_from": "x", "checksum": "y"})", R"({"a": 1.0})"), "equal");
  EXPECT_EQ(first(R"({"format": "f/1", "a": 1})", R"({"format": "f/2", "b": [], "c": 2})"),
            "format: expected \"f/1\", found \"f/2\"");
}

TEST(CompareFacts, OfVeryManyTheFirstAreKept) {
  std::string a = "{", b = "{";
  for (int i = 0; i < 3000; ++i) {
    a += "\"m" + std::to_string(i) + "\": 1, ";
    b += "\"m" + std::to_string(i) + "\": 2, ";
  }
  const auto all =
      compare_facts(a + "\"counts\": {\"pairs\": 1}}", b + "\"counts\": {\"pairs\": 2}}");
  ASSERT_TRUE(all);
  EXPECT_EQ(all->total, 3001u);
  EXPECT_EQ(all->differences.size(), FactsComparison::kMost);
  EXPECT_EQ(all->differences[0].path, "counts.pairs");
}

TEST(CompareFacts, LongValuesAreShortenedBetweenLetters) {
  std::string text;
  for (int i = 0; i < 100; ++i) text += "é";
  const auto all = compare_facts("{\"a\": \"" + text + "\"}", "{\"a\": 1}");
  ASSERT_TRUE(all);
  EXPECT_EQ(all->differences[0].expected, "\"" + text.substr(0, 2 * 59) + " …");
  EXPECT_EQ(first(("{\"a\": \"" + text + "x\"}").c_str(), ("{\"a\": \"" + text + "y\"}").c_str()),
            "a: expected … éééééééééé"
            "x\", found … éééééééééé"
            "y\"")
      << "two long ones from where they differ";
}

TEST(CompareFacts, DamagedAndEndlessTextsAreRefused) {
  EXPECT_EQ(first("{\"a\": ", "{}"), "no facts");
  EXPECT_EQ(first("[]", "[]"), "no facts");
  const std::string deep = "{\"a\": " + std::string(100000, '[') + std::string(100000, ']') + "}";
  EXPECT_EQ(first(deep.c_str(), deep.c_str()), "no facts");
  EXPECT_FALSE(are_facts(deep));
  EXPECT_TRUE(are_facts("{}"));
}

TEST(BeforeSeal, IsTheSameWithASealWithoutOneAndWithABrokenOne) {
  const MadeFrom from{std::string(16, '1'), std::string(16, '2')};
  const std::string facts = "{\n\"a\": 1\n}\n";
  std::string file = sealed(FileKind::json, facts, from);
  EXPECT_EQ(before_seal(FileKind::json, file), "{\n\"a\": 1");
  EXPECT_EQ(before_seal(FileKind::json, facts), "{\n\"a\": 1");
  file.back() = ' ';
  EXPECT_EQ(before_seal(FileKind::json, file), "{\n\"a\": 1");
  EXPECT_EQ(before_seal(FileKind::svg, sealed(FileKind::svg, "<svg/>\n", from)), "<svg/>\n");
  EXPECT_EQ(before_seal(FileKind::svg, "<svg/>\n"), "<svg/>\n");
}

TEST(PixelHash, IsOfSizeAndPixels) {
  const Image wide{2, 1, {1, 2, 3, 4, 5, 6, 7, 8}}, high{1, 2, {1, 2, 3, 4, 5, 6, 7, 8}};
  EXPECT_EQ(pixel_hash(wide), pixel_hash(wide));
  EXPECT_NE(pixel_hash(wide), pixel_hash(high));
  EXPECT_EQ(pixel_hash(wide).size(), 16u);
}

}  // namespace
}  // namespace lantern::render
