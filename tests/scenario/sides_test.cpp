// [[side]]: the same script under other settings, on one clock.
#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "counted_memory.hpp"
#include "frame/parts/level.hpp"
#include "frame/parts/panels.hpp"
#include "run/tally.hpp"
#include "run/warnings.hpp"
#include "scenario/directing.hpp"
#include "scenario/parsing.hpp"

namespace lantern::run {
namespace {

const std::string kEager = "[[side]]\nname = \"eager\"\nstructure = { children = \"eager\" }\n";
const std::string kLazy = "[[side]]\nname = \"lazy\"\ntitle = \"when entered\"\n";
const std::string kSides = kEager + kLazy;
const std::string kSideBodies =
    "[[body]]\nname = \"red\"\nradius = 2\nposition = [10, 50]\nvelocity = [9, 0]\n"
    "[[body]]\nname = \"pink\"\nradius = 2\nposition = [20, 40]\nvelocity = [0, 8]\n"
    "[[body]]\nname = \"blue\"\nradius = 2\nposition = [50, 10]\nvelocity = [-9, 3]\n";
const std::string kSideScript =
    "[[step]]\ndo = \"insert\"\nbodies = [\"red\", \"pink\", \"blue\"]\n"
    "[[step]]\ndo = \"run\"\nseconds = 0.5\nevery = 10\n";

// `structure` are further lines of the table; `sides` stand behind it.
std::string sided(const std::string& structure, const std::string& sides,
                  const std::string& script = kSideScript) {
  return "title = \"x\"\n[world]\nsize = [64, 64]\n" + kTree + structure + sides + kSideBodies +
         script;
}

DirectorReport sides_report(const Scenario& s) {
  Work work;
  return direct(s, s.pace, work, [](const Frame&) { return true; });
}

TEST(Sides, AreTheScenarioRunAloneWithTheOverride) {
  const auto both = frames_of(good(sided("", kSides)));
  const auto eager = frames_of(good(sided("children = \"eager\"\n", "")));
  const auto lazy = frames_of(good(sided("", "")));
  ASSERT_EQ(both.size(), eager.size());
  ASSERT_EQ(both.size(), lazy.size());
  for (std::size_t i = 0; i < both.size(); ++i) {
    ASSERT_EQ(both[i].sides.size(), 2u);
    for (const auto& [side, alone] :
         {std::pair{&both[i].sides[0], &eager[i]}, std::pair{&both[i].sides[1], &lazy[i]}}) {
      EXPECT_EQ(to_json(*side), to_json(*alone));
      EXPECT_EQ(side->hash, alone->hash);
    }
  }
  EXPECT_EQ(both[0].sides[0].nodes.size(), 5u);
  EXPECT_EQ(both[0].sides[1].nodes.size(), 3u);
  EXPECT_EQ(both[0].sides[0].get<FrameSide>().title, "eager") << "no title of its own: its name";
  EXPECT_EQ(both[0].sides[1].get<FrameSide>().title, "when entered");
}

TEST(Sides, ShareTheClockAndThePage) {
  const auto frames = frames_of(good(sided("", kSides)));
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_EQ(frames[i].index, i);
    EXPECT_TRUE(frames[i].bodies.empty() && frames[i].nodes.empty());
    for (const Frame& side : frames[i].sides) {
      EXPECT_EQ(side.time, frames[i].time);
      EXPECT_FALSE(side.get<FrameSide>().held);
    }
  }
  EXPECT_NE(frames[1].hash, frames[2].hash);
}

TEST(Sides, HaveTheirOwnLightsAndNotes) {
  const auto frames =
      frames_of(good(sided("", kSides,
                           "[[step]]\ndo = \"insert\"\n"
                           "bodies = [\"red\", \"pink\"]\n"
                           "lit = [\"red\", \"lazy.pink\"]\n"
                           "note = [{ text = \"here\", body = \"red\" },\n"
                           "{ text = \"late\", body = \"red\", side = \"lazy\" }]\n")));
  const std::vector<Frame>& sides = frames.back().sides;
  for (const Frame& side : sides) EXPECT_TRUE(side.bodies[0].lit);
  EXPECT_FALSE(sides[0].bodies[1].lit);
  EXPECT_TRUE(sides[1].bodies[1].lit);
  EXPECT_EQ(sides[0].notes.size(), 1u);
  ASSERT_EQ(sides[1].notes.size(), 2u);
  EXPECT_EQ(sides[1].notes[1].text, "late");
}

TEST(Sides, ANoteOfASideThatIsNotThereIsAMistake) {
  const std::string note =
      "[[step]]\ndo = \"insert\"\nbodies = [\"red\"]\n"
      "note = [{ text = \"late\", body = \"red\", side = @\"lasy\" }]\n";
  for (const std::string& sides : {kSides, std::string()})
    expect_mistakes(sided("", sides, note), {"there is no side 'lasy'"});
}

TEST(Sides, CodeOfNoFunctionIsAMistake) {
  expect_mistakes("panels = [\"world\", \"code\"]\n" +
                      sided("", kSides, "[[step]]\ndo = \"show\"\ncode = @{}\n"),
                  {"'code' has no 'function'"});
}

TEST(Sides, OfOwnCodeHaveItsPanelEach) {
  const auto showing = [](const std::string& code) {
    return frames_of(good("panels = [\"world\", \"code\"]\n" +
                          sided("", kSides, "[[step]]\ndo = \"show\"\n" + code)))
        .back();
  };
  const auto has_panel = [](const Frame& frame) {
    return std::ranges::count(frame.panels, panel_named("code")) == 1;
  };
  const Frame one = showing("code = { function = \"Insert\" }\n");
  EXPECT_TRUE(has_panel(one) && one.find<FrameCode>());
  for (const Frame& side : one.sides) EXPECT_FALSE(has_panel(side));
  const Frame two =
      showing("code = { eager = { function = \"Insert\" }, lazy = { function = \"Split\" } }\n");
  EXPECT_FALSE(has_panel(two) || two.find<FrameCode>());
  for (const Frame& side : two.sides) EXPECT_TRUE(has_panel(side));
  EXPECT_EQ(two.sides[0].get<FrameCode>().function, "QuadTreeNode::Insert");
  EXPECT_EQ(two.sides[1].get<FrameCode>().function, "QuadTreeNode::Split");
}

// What FRAME.md says of a frame with sides: no facts but those of all sides.
void expect_no_facts_of_its_own(const Frame& frame) {
  static const std::set<std::string> kOfAll = {
      "format", "scenario", "frame",    "time",  "step", "event", "caption", "seed",
      "ending", "headline", "question", "sides", "hash", "code",  "words"};
  const nlohmann::json facts = nlohmann::json::parse(to_json(frame));
  ASSERT_TRUE(facts.contains("sides"));
  for (const auto& [member, value] : facts.items())
    EXPECT_TRUE(kOfAll.contains(member) || value.empty())
        << member << " of frame " << frame.index << ": " << value;
  // What no file has.
  EXPECT_TRUE(frame.get<FrameIslands>().edges.empty() && frame.get<FrameFinding>().hits.empty() &&
              frame.tested.empty());
  EXPECT_TRUE(frame.get<FrameStructure>().grid_levels.empty() &&
              frame.get<FrameTrace>().points.empty() &&
              frame.get<FrameStructure>().settings.empty());
  EXPECT_FALSE(frame.get<FrameLevel>().eye || frame.get<FrameStructure>().swept_to ||
               frame.find<FrameSeparation>() || frame.find<FrameSearch>());
}

TEST(Sides, TheFrameOfAllHasNoFactsOfItsOwn) {
  std::size_t sided = 0;
  for (const std::string& name : all_scenarios()) {
    const Scenario scenario = shipped(name);
    if (scenario.sides.empty()) continue;
    ++sided;
    Work work;
    direct(scenario, scenario.pace, work, [&](const Frame& frame) {
      if (frame.index < 24 || frame.index % 29 == 0) expect_no_facts_of_its_own(frame);
      return !testing::Test::HasFailure();
    });
    EXPECT_FALSE(testing::Test::HasFailure()) << name;
  }
  EXPECT_GE(sided, 10u);
}

// What no shipped scenario with sides shows.
TEST(Sides, TheFrameOfAllHasNoIslandsForcesOrLinksOfItsOwn) {
  const auto frames =
      frames_of(good("panels = [\"world\", \"islands\"]\ntitle = \"x\"\n[world]\nsize = [64, 64]\n"
                     "contacts = \"soft\"\nshow_forces = true\n" +
                     kTree + kSides + kSideBodies +
                     "[[spring]]\na = \"red\"\nb = \"pink\"\nstiffness = 50\nrest_length = 2\n"
                     "[[step]]\ndo = \"insert\"\nbodies = [\"red\", \"pink\", \"blue\"]\n"
                     "[[step]]\ndo = \"force\"\nbody = \"blue\"\nforce = [0, 5]\n"
                     "[[step]]\ndo = \"run\"\nseconds = 0.5\nevery = 10\n"
                     "[[step]]\ndo = \"ray\"\nfrom = [0, 0]\nto = [64, 64]\n"
                     "ruler = [{ a = \"red\", b = \"pink\" }]\n"
                     "note = [{ body = \"red\", text = \"here\" }]\n"));
  for (const Frame& frame : frames) expect_no_facts_of_its_own(frame);
  const Frame& side = frames.back().sides[0];
  EXPECT_FALSE(side.get<FrameIslands>().islands.empty() || side.get<FrameForces>().forces.empty() ||
               side.get<FrameLinks>().links.empty() || side.get<FrameFinding>().rays.empty() ||
               side.get<FrameRulers>().rulers.empty() || side.notes.empty() ||
               side.get<FrameIslands>().edges.empty())
      << "the sides have them";
}

TEST(Sides, KeepTheirNamesInAChartWithLabels) {
  const auto frames = frames_of(good(sided("", kSides + "[chart]\nx = \"time\"\ny = [\"nodes\"]\n"
                                                        "labels = [\"nodes made\"]\n")));
  const auto& series = frames.back().get<FrameChart>().series;
  ASSERT_EQ(series.size(), 2u);
  EXPECT_EQ(series[0].name + series[0].label, "eager");
  EXPECT_EQ(series[1].name + series[1].label, "lazy");
}

TEST(Sides, OneThatHasFewerFramesHoldsItsLast) {
  const auto frames = frames_of(
      good(sided("", kSides,
                 "[[step]]\ndo = \"insert\"\nbodies = [\"red\", \"pink\", \"blue\"]\npace = "
                 "\"event\"\n" +
                     kShow)));
  const auto of_first = std::ranges::count(frames, 0u, &Frame::step);
  EXPECT_EQ(of_first + 1, std::ssize(frames));
  EXPECT_TRUE(
      std::ranges::any_of(frames,
                          [](const Frame& f) { return f.sides[0].get<FrameSide>().held; }) ||
      std::ranges::any_of(frames, [](const Frame& f) { return f.sides[1].get<FrameSide>().held; }));
  EXPECT_FALSE(frames.back().sides[0].get<FrameSide>().held ||
               frames.back().sides[1].get<FrameSide>().held)
      << "a step begins for all at once";
  for (const Frame& frame : frames) {
    EXPECT_FALSE(frame.sides[0].get<FrameSide>().held && frame.sides[1].get<FrameSide>().held);
    EXPECT_EQ(frame.event, frame.sides[frame.sides[0].get<FrameSide>().held ? 1 : 0].event);
    EXPECT_EQ(frame.time, std::max(frame.sides[0].time, frame.sides[1].time));
    for (const Frame& side : frame.sides) EXPECT_EQ(side.index, frame.index);
  }
}

TEST(Sides, CaptionsQuoteThem) {
  const auto frames = frames_of(good(sided(
      "", kSides,
      "[[step]]\ndo = \"insert\"\nbodies = [\"red\", \"pink\", \"blue\"]\ncaption = "
      "\"{eager.nodes:node}, {lazy.nodes}, red at {lazy.x.red}; {bodies} at {time} s {{\"\n")));
  EXPECT_EQ(frames[0].caption, "5 nodes, 3, red at 10; 3 at 0.00 s {");
  EXPECT_EQ(frames[0].sides[0].caption, "");
}

TEST(Sides, WithoutANameACaptionQuotesWhatTheyHaveInCommon) {
  const Scenario s = good(sided("", kSides,
                                "[[step]]\ndo = \"insert\"\nbodies = [\"red\", \"pink\", "
                                "\"blue\"]\ncaption = \"{nodes}\"\n"));
  const DirectorReport report = sides_report(s);
  ASSERT_EQ(report.unmet.count(), 1u);
  EXPECT_NE(report.unmet.told()[0].message.find("not the same on the sides 'eager' and 'lazy'"),
            std::string::npos);
  EXPECT_NE(report.unmet.told()[0].suggestion.find("{eager.nodes}"), std::string::npos);
}

TEST(Sides, WhatAllDoAlikeIsSaidOnceWhatOneDoesStaysWithIt) {
  const auto frames = frames_of(good(sided("", kSides,
                                           "[[step]]\ndo = \"insert\"\nbodies = [\"red\", "
                                           "\"pink\", \"blue\"]\npace = \"event\"\ncaption "
                                           "= \"Three.\"\n")));
  EXPECT_FALSE(frames[0].caption.empty());
  EXPECT_NE(frames[0].caption, "Three.");
  EXPECT_EQ(frames[0].sides[0].caption, "");
  EXPECT_TRUE(std::ranges::any_of(
      frames, [](const Frame& f) { return f.caption.empty() && !f.sides[1].caption.empty(); }));
  EXPECT_EQ(frames.back().caption, "Three.");
}

TEST(Sides, AfterIsSaidWhenAllAreDone) {
  const auto frames = frames_of(
      good(sided("", kSides,
                 "[[step]]\ndo = \"insert\"\nbodies = [\"red\", \"pink\", \"blue\"]\npace = "
                 "\"event\"\ncaption = \"Three.\"\nafter = \"{eager.nodes:node}\"\n"
                 "[[step]]\ndo = \"run\"\nseconds = 0.5\nevery = 10\ncaption = \"{time}\"\nafter = "
                 "\"{lazy.nodes}\"\n")));
  std::size_t last = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_NE(frames[i].caption, "Three.");
    if (frames[i].step == 0) last = i;
  }
  EXPECT_EQ(frames[last].caption, "5 nodes");
  EXPECT_NE(frames[last + 1].caption, frames.back().caption);
  EXPECT_EQ(frames.back().caption, std::to_string(*frames.back().count("lazy.nodes")));
}

TEST(Sides, ExpectationsHoldOnAllOrOnOne) {
  const std::string insert = "[[step]]\ndo = \"insert\"\nbodies = [\"red\", \"pink\", \"blue\"]\n";
  const auto expecting = [&](const std::string& expect) {
    return sides_report(good(sided("", kSides, insert + "expect = { " + expect + " }\n")));
  };
  const DirectorReport met =
      expecting("bodies = 3, eager = { nodes = 5 }, lazy = { nodes = 3, at_most = { pairs = 1 } }");
  EXPECT_TRUE(met.unmet.empty());
  EXPECT_EQ(met.expectations, 5u);
  const DirectorReport unmet = expecting("nodes = 5");
  ASSERT_EQ(unmet.unmet.count(), 1u);
  EXPECT_NE(unmet.unmet.told()[0].message.find("expected nodes = 5, found 3"), std::string::npos);
  EXPECT_NE(unmet.unmet.told()[0].message.find("side 'lazy'"), std::string::npos);
  EXPECT_EQ(expecting("eager = { nodes = 4 }").unmet.count(), 1u);
}

TEST(Sides, ShareAChart) {
  const auto frames = frames_of(
      good(sided("", kSides + "[chart]\nx = \"time\"\ny = [\"nodes\", \"lazy.speed.red\"]\n")));
  const FrameChart& chart = frames.back().get<FrameChart>();
  ASSERT_EQ(chart.series.size(), 3u);
  EXPECT_EQ(chart.series[0].name, "eager.nodes");
  EXPECT_EQ(chart.series[1].name, "lazy.nodes");
  EXPECT_EQ(chart.series[2].name, "lazy.speed.red");
  EXPECT_EQ(chart.series[0].points.size(), frames.size());
  EXPECT_EQ(chart.series[0].points[0], Vec<2>(0, 5));
  EXPECT_EQ(chart.series[1].points[0], Vec<2>(0, 3));
  EXPECT_TRUE(frames.back().sides[0].get<FrameChart>().series.empty());
  const auto same = frames_of(good(sided("", kSides + "[chart]\nx = \"time\"\ny = [\"nodes\"]\n")));
  EXPECT_EQ(same[0].get<FrameChart>().y_name, "nodes");
  EXPECT_EQ(same[0].get<FrameChart>().series[0].name, "eager");
}

TEST(Sides, PlotBarsOfEach) {
  const auto frames = frames_of(good(
      sided("", kSides + "[chart]\nbars = \"nodes\"\n",
            "[[step]]\ndo = \"insert\"\nbodies = [\"red\", \"pink\", \"blue\"]\nplot = \"3\"\n")));
  ASSERT_EQ(frames[0].get<FrameChart>().bars.size(), 2u);
  EXPECT_EQ(frames[0].get<FrameChart>().bars[1].label, "3, lazy");
  EXPECT_EQ(frames[0].get<FrameChart>().bars[1].value, 3);
}

TEST(Sides, MayWaitForDifferentTimes) {
  const std::string file =
      "title = \"x\"\n[world]\nsize = [64, 64]\ngravity = [0, -10]\ncontacts = \"soft\"\n"
      "[[side]]\nname = \"slow\"\nworld = { gravity = [0, -5] }\n[[side]]\nname = \"fast\"\n"
      "[[body]]\nname = \"ground\"\nground = [0, 1]\nposition = [0, 0]\n"
      "[[body]]\nname = \"ball\"\nradius = 1\nposition = [9, 3]\n"
      "[[step]]\ndo = \"insert\"\nbodies = [\"ground\", \"ball\"]\n"
      "[[step]]\ndo = \"wait\"\nevent = \"touch\"\nbodies = [\"ball\", \"ground\"]\nat_most = 3\n"
      "caption = \"{slow.time} and {fast.time}\"\n";
  const auto frames = frames_of(good(file));
  const Frame& last = frames.back();
  EXPECT_TRUE(last.sides[1].get<FrameSide>().held);
  EXPECT_GT(last.sides[0].time, last.sides[1].time);
  EXPECT_EQ(last.time, last.sides[0].time);
  EXPECT_FALSE(last.sides[1].since_last_frame) << "it did nothing since";
}

TEST(Sides, AreCountedTogether) {
  const Scenario s = good(sided("", kSides));
  EXPECT_EQ(s.world_steps, 60u);
  Work work;
  Tally tally(s, work);
  const DirectorReport report = direct(s, s.pace, work, [&](const Frame& frame) {
    tally.see(frame);
    return true;
  });
  EXPECT_EQ(report.frames, 4u);
  EXPECT_EQ(report.world.steps, 60u);
  EXPECT_EQ(work.worlds_created, 2u);
  EXPECT_EQ(work.structures_created, 2u);
  EXPECT_EQ(tally.stages(report)[0].amounts[0].n, 6u) << "bodies of both";
}

TEST(Sides, AWarningSaysOnWhichOfThemItIs) {
  const Scenario s = good(
      "title = \"x\"\n[world]\nsize = [64, 64]\n"
      "[[side]]\nname = \"falls\"\nworld = { gravity = [0, -10] }\n[[side]]\nname = \"floats\"\n" +
      kSideBodies + "[[step]]\ndo = \"insert\"\nbodies = [\"red\"]\n" +
      "[[step]]\ndo = \"run\"\nseconds = 4\nevery = 30\n");
  Work work;
  RunWatch watch(s, [](const Frame&) { return true; });
  direct(
      s, Pace::step, work, [](const Frame&) { return true; }, &watch);
  ASSERT_EQ(watch.warnings().size(), 1u);
  EXPECT_NE(watch.warnings()[0].message.find("'red' leaves the world"), std::string::npos);
  EXPECT_NE(watch.warnings()[0].message.find("on the side 'falls'"), std::string::npos);
}

TEST(Sides, AKindOverridesWithItsPlanes) {
  const Scenario s = good(
      "title = \"x\"\n[world]\nsize = [64, 64]\n[structure]\nkind = \"bsp\"\nplanes = [{ point = "
      "[32, 0], normal = [1, 0] }]\n[[side]]\nname = \"planes\"\n[[side]]\nname = \"poor\"\n"
      "structure = { planes = [{ point = [2, 0], normal = [1, 0] }] }\n"
      "[[side]]\nname = \"tree\"\nstructure = { kind = \"quadtree\" }\n" +
      kSideBodies + kSideScript);
  EXPECT_EQ(s.sides[0]->structure.planes[0].point.x, 32);
  EXPECT_EQ(s.sides[1]->structure.planes[0].point.x, 2);
  EXPECT_TRUE(s.sides[2]->structure.planes.empty());
}

TEST(Sides, OverrideWhatTheFileDoesNotHave) {
  const Scenario s = good(
      "title = \"x\"\n[world]\nsize = [64, 64]\n[[side]]\nname = \"none\"\n"
      "[[side]]\nname = \"tree\"\nstructure = { kind = \"quadtree\" }\n" +
      kSideBodies + kSideScript);
  EXPECT_EQ(s.sides[0]->structure.kind, StructureKind::none);
  EXPECT_EQ(s.sides[1]->structure.kind, StructureKind::quadtree);
  EXPECT_EQ(s.panels, (std::vector{panel_named("world"), panel_named("tree")}))
      << "one page for all";
  EXPECT_EQ(s.sides[0]->panels, s.panels);
}

TEST(Sides, JsonHasTheFactsOfEach) {
  const auto frames = frames_of(good(sided("", kSides)));
  const std::string facts = to_json(frames[0]);
  EXPECT_NE(facts.find("\"sides\": ["), std::string::npos);
  EXPECT_NE(facts.find("\"name\": \"eager\""), std::string::npos);
  EXPECT_EQ(to_json(frames_of(good(sided("", "")))[0]).find("\"sides\""), std::string::npos);
}

TEST(Sides, AreTheSameEachTimeAndWithoutAWatch) {
  const Scenario s = good(sided("", kSides));
  const auto once = frames_of(s);
  std::vector<Frame> watched;
  Work work;
  RunWatch watch(s, [](const Frame&) { return true; });
  direct(
      s, Pace::step, work,
      [&](const Frame& frame) {
        watched.push_back(frame);
        return true;
      },
      &watch);
  ASSERT_EQ(once.size(), watched.size());
  for (std::size_t i = 0; i < once.size(); ++i) EXPECT_EQ(to_json(once[i]), to_json(watched[i]));
}

TEST(Sides, EndWhereNobodyLooksAnyMore) {
  Work work;
  int seen = 0;
  const DirectorReport report =
      direct(good(sided("", kSides)), Pace::step, work, [&](const Frame&) { return ++seen < 2; });
  EXPECT_EQ(report.frames, 2u);
}

TEST(Sides, LeaveOutWhatTheyDoNotNeed) {
  Work work;
  direct(good(sided("", kSides)), Pace::step, work, [](const Frame&) { return true; });
  EXPECT_EQ(work.atlases_created + work.static_builds + work.queries, 0u);
  EXPECT_EQ(work.worlds_created, 2u) << "one for each side, none for the file itself";
}

TEST(Sides, Mistakes) {
  const auto said = [](const std::string& sides, const std::vector<std::string>& words,
                       const std::string& script = kSideScript) {
    expect_mistakes(sided("", sides, script), words);
  };
  said("@" + kEager, {"there must be 2 to 4"});
  said("@" + kSides + "[[side]]\nname = \"c\"\n[[side]]\nname = \"d\"\n[[side]]\nname = \"e\"\n",
       {"5 of [[side]], the limit is 4"});
  said(kEager + "[[side]]\nname = @\"eager\"\n", {"the name 'eager' is taken"});
  said(kEager + "@[[side]]\ntitle = \"b\"\n", {"[[side]] has no 'name'"});
  said(kEager + "[[side]]\nname = @\"pairs\"\n", {"cannot be called 'pairs'"});
  said(kEager + "[[side]]\nname = @\"energy\"\n", {"cannot be called 'energy'"});
  said(kLazy + "[[side]]\nname = \"b\"\nstructure = { @childrn = \"eager\" }\n",
       {"did you mean 'children'?"});
  said(kLazy + "[[side]]\nname = \"b\"\nstructure = { children = @\"eagr\" }\n",
       {"did you mean 'eager'?"});
  said(kLazy + "[[side]]\nname = \"b\"\nstructure = @3\n", {"'structure' must be a table"});
  said(kLazy + "[[side]]\nname = \"b\"\n@structre = { }\n", {"did you mean 'structure'?"});
  said(kLazy + "[[side]]\nname = \"b\"\n@seed = 3\n",
       {"it may override [structure], [world], [level], [atlas]"});
  said(kLazy + "[[side]]\nname = \"b\"\nworld = { @time_step = 0.1, @size = [9, 9] }\n",
       {"cannot override 'time_step' of [world]", "cannot override 'size' of [world]"});
  said(kLazy + "[[side]]\nname = \"b\"\nworld = { @contcts = \"soft\" }\n",
       {"did you mean 'contacts'?"});
}

TEST(Sides, MistakesInWhatIsSaidOfThem) {
  const auto said = [](const std::string& step, const std::vector<std::string>& words) {
    expect_mistakes(sided("", kSides, kShow + step), words);
  };
  said("caption = \"@{egaer.pairs}\"\n", {"did you mean 'eager'?"});
  said("caption = \"@{eager.piars}\"\n", {"did you mean 'pairs'?"});
  said("caption = \"@{lazy.contacts}\"\n", {"'contacts' is not counted here"});
  said("headline = [@\"egaer.pairs\"]\n", {"did you mean 'eager'?"});
  said("headline = [@\"eager.piars\"]\n", {"did you mean 'pairs'?"});
  said("headline = [@\"lazy.contacts\"]\n", {"'contacts' is not counted here"});
  said("expect = { @egaer = { nodes = 3 } }\n", {"unknown key 'egaer'"});
  said("expect = { eager = { @nods = 3 } }\n", {"did you mean 'nodes'?"});
  said("@sed = 3\n", {"unknown key 'sed'"});
}

TEST(Sides, AHeadlineMayNameACountOfOne) {
  const auto frames = frames_of(
      good(sided("", kSides, kSideScript + "headline = [\"eager.nodes\", \"lazy.nodes\"]\n")));
  EXPECT_EQ(frames.back().headline, (std::vector<std::string>{"eager.nodes", "lazy.nodes"}));
  EXPECT_TRUE(frames.back().count("lazy.nodes").has_value());
}

TEST(Sides, AMistakeOfOneSideSaysOfWhich) {
  expect_mistakes(
      "title = \"x\"\n[world]\nsize = [64, 64]\n[[side]]\nname = \"none\"\n[[side]]\n"
      "name = \"tree\"\nstructure = { kind = \"quadtree\" }\n" +
          kSideBodies + kShow + "caption = \"@{pairs}\"\n",
      {"there is no structure at this step, on the side 'none'"});
}

// Each side that is read is the whole file once more.
TEST(Sides, FarTooManyAreRefusedInLinearWork) {
  const auto bytes_for = [](int count) {
    std::string sides;
    for (int i = 0; i < count; ++i) sides += fmt::format("[[side]]\nname = \"s{}\"\n", i);
    const std::string text = sided("", sides);
    const std::uint64_t before = counted_memory::bytes;
    EXPECT_EQ(mistakes(text).size(), 1u);
    return static_cast<double>(counted_memory::bytes - before);
  };
  EXPECT_LT(bytes_for(400), 2.3 * bytes_for(200));
}

}  // namespace
}  // namespace lantern::run
