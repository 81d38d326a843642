// What a browser or a build machine reads must be whole whatever stands in names and captions.
#include "publish/golden_report.hpp"

#include <gtest/gtest.h>

namespace lantern::publish {
namespace {

GoldenSuite sample() {
  GoldenSuite suite;
  suite.scenario = "ghosts";
  suite.file = "a & b/ghosts.toml";
  suite.cases.push_back({0, "two", {}, {}, false, {}, {}, {}});
  suite.cases.push_back({1, "a<b", {"counts.pairs: expected 1, found 2"}, {}, true, {}, {}, {}});
  suite.cases[1].facts = {{{"counts.pairs", "1", "\"\x1b[2J\"\xef\xbf\xbf"}}, 9};
  return suite;
}

TEST(GoldenReport, JunitEscapesWhatXmlDoesNotHave) {
  const std::string expected = R"xml(<?xml version="1.0" encoding="UTF-8"?>
<testsuites name="lantern golden" tests="2" failures="1" errors="0">
  <testsuite name="ghosts" file="a &amp; b/ghosts.toml" tests="2" failures="1" errors="0" skipped="0">
    <testcase name="frame 0 (two)" classname="golden.ghosts"/>
    <testcase name="frame 1 (a&lt;b)" classname="golden.ghosts">
      <failure type="golden" message="counts.pairs: expected 1, found 2">counts.pairs: expected 1, found 2
counts.pairs: expected 1, found &quot;\x1b[2J&quot;\uffff</failure>
    </testcase>
  </testsuite>
</testsuites>
)xml";
  EXPECT_EQ(golden_junit(std::vector{sample()}), expected);
}

TEST(GoldenReport, ThePageNamesWhatDiffersFirstAndHidesNothing) {
  const std::string page = golden_page(std::vector{sample()}, "Lantern 1");
  const auto has = [&](const char* text) { return page.find(text) != page.npos; };
  EXPECT_TRUE(has("<title>1 of 2 frames differs</title>"));
  EXPECT_TRUE(has("differs first in <a href=\"#s0f1\">frame 1 (a&lt;b)</a>"));
  EXPECT_TRUE(has("<p>8 more facts differ.</p>"));
  EXPECT_TRUE(has("Its pictures are not shown"));
  EXPECT_FALSE(has("\x1b"));
}

TEST(GoldenReport, OfVeryManyFramesTheFirstAreShown) {
  GoldenSuite suite = sample();
  for (std::uint32_t i = 2; i < 300; ++i)
    suite.cases.push_back({i, "", {"x"}, {}, false, {}, {}, {}});
  const std::string page = golden_page(std::vector{suite}, "Lantern 1");
  EXPECT_NE(page.find("<p>99 more frames differ.</p>"), page.npos);
  EXPECT_EQ(page.find("id=\"s0f250\""), page.npos);
}

TEST(GoldenReport, WhatConcernsAllFramesOrTheRunIsACaseOfItsOwn) {
  GoldenSuite suite;
  suite.scenario = "x";
  suite.error = "first line\nsecond";
  suite.findings = {"other size"};
  const std::string xml = golden_junit(std::vector{suite});
  EXPECT_NE(xml.find("tests=\"2\" failures=\"1\" errors=\"1\""), xml.npos) << xml;
  EXPECT_NE(xml.find("message=\"first line\">first line\nsecond</error>"), xml.npos) << xml;
  EXPECT_FALSE(suite.good());
}

}  // namespace
}  // namespace lantern::publish
