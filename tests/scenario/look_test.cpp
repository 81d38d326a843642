// What a scenario says of its pictures: display, view, camera, orbit and notes.
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/work.hpp"
#include "geometry/flat.hpp"
#include "scenario/directing.hpp"
#include "scenario/parsing.hpp"

namespace lantern::run {
namespace {

const std::string kFlatWorld = "title = \"x\"\n[world]\nsize = [64, 32]\n" + kTree +
                               "[[body]]\nname = \"red\"\nradius = 1\nposition = [8, 8]\n"
                               "[[body]]\nname = \"pink\"\nradius = 1\nposition = [40, 20]\n";
const std::string kSolidWorld =
    "title = \"x\"\n[world]\nsize = [8, 8, 8]\n"
    "[[body]]\nname = \"red\"\nradius = 1\nposition = [4, 4, 4]\n";
const std::string kBoth = "do = \"insert\"\nbodies = [\"red\", \"pink\"]\n";
const std::string kOne = "do = \"insert\"\nbodies = [\"red\"]\n";

TEST(View, HoldsUntilAnotherOneAndKeepsTheWorldsProportions) {
  const auto frames = frames_of(
      good(kFlatWorld + steps({kBoth, "do = \"show\"\nview = { at = [40, 16], width = 16 }\n",
                               "do = \"show\"\n", "do = \"show\"\nview = {}\n"})));
  ASSERT_EQ(frames.size(), 4u);
  EXPECT_FALSE(frames[0].view || frames[3].view);
  ASSERT_TRUE(frames[1].view && frames[2].view);
  EXPECT_EQ(frames[1].view->lo, Vec<2>(32, 12));
  EXPECT_EQ(frames[1].view->hi, Vec<2>(48, 20));
  EXPECT_EQ(*frames[1].view, *frames[2].view);
  EXPECT_NE(to_json(frames[1]).find("\"view\""), std::string::npos);
}

TEST(View, StaysWithinTheWorld) {
  const auto frames =
      frames_of(good(kFlatWorld + steps({kBoth + "view = { at = [1, 31], width = 16 }\n"})));
  EXPECT_EQ(frames.at(0).view->lo, Vec<2>(0, 24));
  EXPECT_EQ(frames.at(0).view->hi, Vec<2>(16, 32));
}

TEST(View, WrongOnesAreToldAtTheirPlaces) {
  const auto in_step = [](const std::string& keys) {
    return kFlatWorld + steps({"do = \"show\"\n" + keys});
  };
  expect_mistakes(in_step("view = { @at = [1, 1] }\n"), {"no 'width'"});
  expect_mistakes(in_step("view = { @width = 3 }\n"), {"no 'at'"});
  expect_mistakes(in_step("view = { at = [1, 1], width = @0 }\n"), {"allowed is"});
  expect_mistakes(in_step("view = { at = @[-1, 1], width = 3 }\n"), {"outside the world"});
  expect_mistakes(in_step("view = { at = [1, 1], width = @65 }\n"), {"64 wide"});
  expect_mistakes(in_step("@camera = { eye = [1, 1], target = [2, 2] }\n"), {"view = {"});
  expect_mistakes(in_step("@orbit = 30\n"), {"view = {"});
  expect_mistakes(kSolidWorld + steps({"do = \"show\"\n@view = {}\n"}), {"camera = {"});
  expect_mistakes(
      kSolidWorld + steps({"do = \"show\"\ncamera = { eye = [1, 1, 1], target = @[1, 1, 1] }\n"}),
      {"looks at itself"});
}

TEST(Camera, GoesRoundItsTargetWhileTimePasses) {
  const auto frames = frames_of(
      good(kSolidWorld + steps({kOne + "camera = { eye = [12, 6, 4], target = [4, 4, 4] }\n",
                                "do = \"run\"\nseconds = 1\nevery = 15\norbit = 90\n",
                                "do = \"show\"\n", "do = \"show\"\norbit = 90\n"})));
  ASSERT_EQ(frames.size(), 7u);
  EXPECT_EQ(frames[0].camera->eye, Vec<3>(12, 6, 4)) << "an orbit begins where the camera stands";
  double before = 0;
  for (std::size_t i = 1; i <= 4; ++i) {
    const Vec<3> way = frames[i].camera->eye - Vec<3>(4, 4, 4);
    EXPECT_NEAR(std::hypot(way.x, way.z), 8, 1e-12);
    EXPECT_EQ(way.y, 2);
    const double angle = std::atan2(-way.z, way.x);
    EXPECT_GT(angle, before);
    before = angle;
  }
  EXPECT_LT(glm::length(frames[4].camera->eye - Vec<3>(4, 6, -4)), 1e-12);
  EXPECT_EQ(frames[5].camera->eye, frames[4].camera->eye) << "it stays where it has come to";
  EXPECT_LT(glm::length(frames[6].camera->eye - Vec<3>(-4, 6, 4)), 1e-12)
      << "without time it is there at once";
}

TEST(Display, OfAStepIsOfThatStepAlone) {
  const Scenario s = good(
      "title = \"x\"\n[display]\nnames = \"none\"\n[world]\nsize = [8, 8]\n"
      "show_boxes = true\n[[body]]\nname = \"red\"\nradius = 1\nposition = "
      "[1, 1]\n" +
      steps({kOne + "display = { legend = true }\n", "do = \"show\"\n"}));
  const auto frames = frames_of(s);
  EXPECT_TRUE(frames[0].display.legend);
  EXPECT_FALSE(frames[1].display.legend);
  for (const Frame& frame : frames) {
    EXPECT_EQ(frame.display.names, ShownNames::none);
    EXPECT_TRUE(frame.display.boxes) << "[world] and [display] fill the same";
  }
  expect_mistakes(
      "title = \"x\"\n[world]\nsize = [8, 8]\nshow_boxes = true\n[display]\n"
      "@boxes = false\n" +
          kShow,
      {"[world] has 'show_boxes'"});
  expect_mistakes("title = \"x\"\n[world]\nsize = [8, 8]\n[display]\n@depths = true\n" + kShow,
                  {"nothing touches"});
}

TEST(Note, IsOfWhatIsThere) {
  const std::string note =
      "note = [{ text = \"{bodies:body/bodies}\", body = \"red\" }, { text = \"b\", node = "
      "\"root\" "
      "}, { text = \"c\", point = [3, 4] }, { text = \"d\", pair = [\"red\", \"pink\"] }, { text = "
      "\"e\", count = \"pairs\" }]\n";
  const Frame frame = frames_of(good(kFlatWorld + steps({kBoth + note}))).at(0);
  ASSERT_EQ(frame.notes.size(), 5u);
  EXPECT_EQ(frame.notes[0].text, "2 bodies");
  EXPECT_EQ(frame.notes[0].bodies, std::vector{body(frame, "red").id});
  EXPECT_EQ(frame.notes[1].node, 0u);
  EXPECT_EQ(frame.notes[2].point, Vec<3>(3, 4, 0));
  EXPECT_EQ(frame.notes[3].bodies.size(), 2u);
  EXPECT_EQ(frame.notes[4].count, "pairs");
  EXPECT_NE(to_json(frame).find("\"text\": \"2 bodies\""), std::string::npos) << to_json(frame);
}

TEST(Note, OnWhatIsNotThereIsAMistake) {
  const auto with = [](const std::string& note) {
    return kFlatWorld + steps({kOne + "[[step.note]]\ntext = \"x\"\n" + note + "\n"});
  };
  expect_mistakes(with("body = @\"pink\""), {"not in the world at this step"});
  expect_mistakes(with("body = @\"rde\""), {"did you mean 'red'?"});
  expect_mistakes(with("pair = [\"red\", @\"pink\"]"), {"not in the world"});
  expect_mistakes(with("count = @\"hits\""), {"not counted here"});
  expect_mistakes(with("count = @\"pair\""), {"did you mean 'pairs'?"});
  expect_mistakes(with("point = @[99, 1]"), {"outside the world"});
  expect_mistakes(with("body = \"red\"\n@node = \"root\""), {"'node', too"});
  expect_mistakes(kSolidWorld + steps({kOne + "note = [{ text = \"x\", node = @\"1\" }]\n"}),
                  {"no structure"});
  expect_mistakes(kFlatWorld + steps({kOne + "note = [{ text = \"@{hits}\", body = \"red\" }]\n"}),
                  {"not counted here"});
}

std::string told_of(const std::string& text) {
  const Scenario scenario = good(text);
  Work work;
  const DirectorReport report =
      direct(scenario, Pace::step, work, [](const Frame&) { return true; });
  std::string all;
  for (const Diagnostic& d : report.unmet.told())
    all += fmt::format("{}:{}: {}\n", d.where.line, d.where.column, d.message);
  return all;
}

TEST(Note, WithoutItsNodeIsNotKept) {
  const std::string note = "note = [{ text = \"x\", node = \"1.3\" }]\n";
  EXPECT_NE(told_of(kFlatWorld + steps({kBoth + note})).find("there is no node '1.3'"),
            std::string::npos);
  const std::string view = "view = { at = [60, 30], width = 4 }\n";
  const std::string of_body = "note = [{ text = \"x\", body = \"red\" }]\n";
  EXPECT_NE(told_of(kFlatWorld + steps({kBoth + view + of_body})).find("outside the view"),
            std::string::npos);
  EXPECT_EQ(told_of(kFlatWorld + steps({kBoth + of_body})), "");
}

TEST(Note, OfAnEventStandsOnItsFramesAlone) {
  const auto with = [](const std::string& event) {
    return kFlatWorld + steps({kBoth +
                               "pace = \"event\"\nnote = [{ text = \"x\", body = \"red\", "
                               "event = \"" +
                               event + "\" }]\n"});
  };
  std::size_t on = 0;
  for (const Frame& frame : frames_of(good(with("store")))) {
    EXPECT_EQ(frame.notes.size(), frame.event == "store" ? 1u : 0u) << frame.event;
    on += frame.notes.size();
  }
  EXPECT_GT(on, 0u);
  EXPECT_NE(told_of(with("stroe")).find("no event 'stroe'"), std::string::npos);
}

}  // namespace
}  // namespace lantern::run
