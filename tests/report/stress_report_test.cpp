// How stress cases are told, and how the stability map is drawn.
#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "draw/draw_list.hpp"
#include "report/pages.hpp"
#include "report/stress_tables.hpp"

namespace lantern::report {
namespace {

constexpr double kHair = 0.01;

StressReport sample() {
  StressReport report;
  report.version = "1.2.3";
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double endless = std::numeric_limits<double>::infinity();
  report.outcomes = {
      {{"first", "extreme input", "It holds."}, at_most(1e-6, 2.5e-7, "m", "one, \"two\"")},
      {{"second", "bars", "It does not."}, at_least(5, 4, "x the start", "")},
      {{"third", "bars", "It broke off."}, {nan, "", 0, false, false, "thrown"}},
      {{"fourth", "bars", "It flew away."}, at_most(1, endless, "m", "")}};
  return report;
}

TEST(StressTables, TheTableTellsVerdictsAndWhyOneFailed) {
  const std::string text = to_table(sample());
  EXPECT_NE(text.find("good    first"), std::string::npos) << text;
  EXPECT_NE(text.find("2.5e-07"), std::string::npos) << text;
  EXPECT_NE(text.find("<= 1.0e-06"), std::string::npos) << text;
  EXPECT_NE(text.find(">= 5"), std::string::npos) << text;
  EXPECT_NE(text.find("FAILED  third"), std::string::npos) << text;
  EXPECT_NE(text.find("thrown"), std::string::npos) << "the message is not told\n" << text;
  EXPECT_EQ(text.find("It holds."), std::string::npos) << "a good case needs no words";
  EXPECT_NE(text.find("1 of 4 cases good, failed: second, third, fourth\n"), std::string::npos)
      << text;
  EXPECT_LT(text.find("extreme input\n"), text.find("bars\n"));
  StressReport cut = sample();
  cut.finished = false;
  EXPECT_NE(to_table(cut).find("interrupted"), std::string::npos);
}

TEST(StressTables, CsvQuotesWhatNeedsIt) {
  const std::string text = to_csv(sample());
  EXPECT_EQ(text.substr(0, text.find("\r\n")),
            "name,group,verdict,figure,sense,bound,unit,what,detail");
  EXPECT_NE(text.find("first,extreme input,good,2.4999999999999999e-07,at most,"
                      "9.9999999999999995e-07,m,It holds.,\"one, \"\"two\"\"\"\r\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("third,bars,FAILED,,at most,0,,It broke off.,thrown\r\n"), std::string::npos)
      << text;
}

TEST(StressTables, JsonHasNullForWhatIsNoNumber) {
  const nlohmann::json report = nlohmann::json::parse(to_json(sample()));
  EXPECT_EQ(report["format"], "lantern.stress/1");
  EXPECT_EQ(report["version"], "1.2.3");
  EXPECT_TRUE(report["finished"]);
  ASSERT_EQ(report["cases"].size(), 4u);
  EXPECT_EQ(report["cases"][0]["figure"], 2.5e-7);
  EXPECT_TRUE(report["cases"][0]["good"]);
  EXPECT_EQ(report["cases"][1]["sense"], "at least");
  EXPECT_TRUE(report["cases"][2]["figure"].is_null());
  EXPECT_TRUE(report["cases"][3]["figure"].is_null());
  EXPECT_FALSE(report["cases"][3]["good"]);
}

TEST(StabilityPicture, NoLabelCoversAnotherOrLeavesThePage) {
  const DrawList list = draw_stability_map(make_stability_map());
  const Box<2> page{Vec<2>(0.0), list.page};
  EXPECT_GE(list.labels.size(), 40u) << "names, limits, ticks and the legend";
  for (std::size_t i = 0; i < list.labels.size(); ++i) {
    EXPECT_TRUE(holds(page, list.labels[i].box)) << list.labels[i].text;
    for (std::size_t j = i + 1; j < list.labels.size(); ++j)
      EXPECT_FALSE(overlap(shrunk(list.labels[i].box, kHair), shrunk(list.labels[j].box, kHair)))
          << "'" << list.labels[i].text << "' covers '" << list.labels[j].text << "'";
  }
  for (const DrawShape& shape : list.shapes) {
    if (const auto* text = std::get_if<TextShape>(&shape)) {
      EXPECT_GE(text->size, kLeastDeskLabel - kHair) << text->text;
    }
    if (const auto* rect = std::get_if<RectShape>(&shape)) {
      EXPECT_TRUE(is_valid(rect->box) && holds(page, rect->box)) << "a rectangle leaves the page";
    }
    if (const auto* line = std::get_if<LineShape>(&shape)) {
      EXPECT_TRUE(contains(page, line->from) && contains(page, line->to)) << "a line leaves it";
    }
  }
}

TEST(StabilityPicture, AMapThatEndedEarlyIsDrawnAsFarAsItGoes) {
  StabilityMap map = make_stability_map();
  map.panels.resize(1);
  EXPECT_NO_THROW(draw_stability_map(map));
  EXPECT_NO_THROW(draw_stability_map(StabilityMap{}));
}

}  // namespace
}  // namespace lantern::report
