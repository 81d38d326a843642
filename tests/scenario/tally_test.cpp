// What `explain` tells of a run is what ran: its numbers against others that were counted apart.
#include "run/tally.hpp"

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "frame/parts/atlas.hpp"
#include "frame/parts/level.hpp"
#include "language/language.hpp"
#include "language/scenario.hpp"
#include "physics/world_config.hpp"
#include "run/engine.hpp"
#include "scenario/directing.hpp"
#include "scenario/parsing.hpp"

namespace lantern::run {
namespace {

// One dry run of a scenario, tallied, and what its frames say by themselves.
struct DryRun {
  explicit DryRun(Scenario of) : scenario(std::move(of)) {
    report = direct(scenario, scenario.pace, work, [&](const Frame& frame) {
      tally.see(frame);
      see(frame);
      return true;
    });
    stages = tally.stages(report);
  }

  void see(const Frame& frame) {
    const bool stepped = frame.time > last.time;
    if (stepped) {
      ++moments;
      for (auto& [name, sum] : of_steps)
        sum += static_cast<std::uint64_t>(frame.count(name).value_or(0));
    }
    pictured += frame.structure != StructureKind::none;
    pairs += frame.pairs.size();
    for (const Panel panel : scenario.panels) shown[panel] += shows(panel, frame);
    most_bodies = std::max(most_bodies, frame.bodies.size());
    for (const FrameBody& body : frame.bodies) slept |= body.asleep;
    most_links = std::max(most_links, frame.get<FrameLinks>().links.size());
    last = frame;
  }

  static bool shows(Panel panel, const Frame& frame) {
    if (std::ranges::any_of(frame.sides, [&](const Frame& side) { return shows(panel, side); }))
      return true;
    if (panel == panel_named("world"))
      return !frame.bodies.empty() || !frame.get<FrameLevel>().walls.empty();
    if (panel == panel_named("tree")) return !frame.nodes.empty();
    if (panel == panel_named("atlas")) return frame.count("textures").value_or(0) > 0;
    if (panel == panel_named("memory")) return frame.get<FrameStructure>().array_size > 0;
    if (panel == panel_named("ledger")) return frame.bodies.size() > 1;
    if (panel == panel_named("pool")) return frame.get<FrameStructure>().pool_size > 0;
    if (panel == panel_named("bytes")) return frame.count("node_bytes").has_value();
    if (panel == panel_named("sparkline")) return !frame.get<FrameTrace>().points.empty();
    if (panel == panel_named("difference")) return frame.find<FrameDifference>() != nullptr;
    if (panel == panel_named("axes")) return frame.find<FrameSeparation>() != nullptr;
    if (panel == panel_named("islands")) return !frame.get<FrameIslands>().islands.empty();
    if (panel == panel_named("code")) return frame.find<FrameCode>() != nullptr;
    if (panel == panel_named("collisions"))
      return frame.find<FrameCollisions>() && !frame.find<FrameCollisions>()->rows.empty();
    if (panel == panel_named("matrix")) return !frame.get<FrameMatrix>().rows.empty();
    if (panel == panel_named("screen")) return !frame.get<FrameScreen>().ways.empty();
    return !frame.get<FrameChart>().bars.empty() ||
           std::any_of(frame.get<FrameChart>().series.begin(), frame.get<FrameChart>().series.end(),
                       [](const FrameSeries& series) { return !series.points.empty(); });
  }

  const StageTally& stage(std::string_view name) const {
    const auto found = std::find_if(stages.begin(), stages.end(),
                                    [&](const StageTally& s) { return s.stage == name; });
    EXPECT_NE(found, stages.end()) << name;
    return *found;
  }
  bool uses(std::string_view name) const { return stage(name).used(); }
  std::uint64_t count(std::string_view name, std::string_view many) const {
    for (const Amount& a : stage(name).amounts)
      if (a.many == many) return a.n;
    ADD_FAILURE() << name << " has no " << many;
    return 0;
  }
  template <class V>
  std::uint64_t steps_with() const {
    return static_cast<std::uint64_t>(
        std::count_if(scenario.steps.begin(), scenario.steps.end(),
                      [](const Step& s) { return std::holds_alternative<V>(s.verb); }));
  }

  Scenario scenario;
  Work work;
  Tally tally{scenario, work};
  DirectorReport report;
  std::vector<StageTally> stages;

  std::uint64_t moments = 0, pictured = 0, pairs = 0;
  std::map<std::string, std::uint64_t> of_steps = {
      {"narrow_tests", 0}, {"friction_rows", 0}, {"force_evaluations", 0}, {"rotations", 0}};
  std::map<Panel, std::uint64_t> shown;
  std::size_t most_bodies = 0, most_links = 0;
  bool slept = false;
  Frame last;
};

// Of the same script, run without director and frames. It must not wait: how long, the director
// finds.
WorldWork without_frames(const DryRun& run) {
  if (run.scenario.bodies.empty()) return {};
  Work work;
  const auto engine = make_engine(run.scenario, work);
  for (const Step& step : run.scenario.steps)
    carry_out(step.verb, *engine, run.scenario.world.time_step);
  return engine->world_work();
}

void expect_world(const DryRun& run) {
  const Scenario& s = run.scenario;
  EXPECT_EQ(run.count("world", "worlds"), s.bodies.empty() ? 0u : 1u);
  EXPECT_EQ(run.count("world", "bodies"), run.most_bodies);
  EXPECT_EQ(run.count("springs and joints", "springs") + run.count("springs and joints", "joints"),
            run.most_links);
  const std::uint64_t steps = run.count("motion", "steps");
  if (!s.bodies.empty()) {
    EXPECT_NEAR(run.last.time, static_cast<double>(steps) * s.world.time_step, 1e-9);
  }
  EXPECT_EQ(run.uses("motion"), !s.bodies.empty() && run.last.time > 0);
  if (steps > 0) {
    EXPECT_EQ(run.stage("motion").note, fmt::format("{:.6g} s passed", run.last.time));
  }
  EXPECT_EQ(run.uses("3D camera"), s.world.dimension == 3);
}

void expect_physics(const DryRun& run) {
  if (run.steps_with<Wait>() == 0) {
    const WorldWork other = without_frames(run);
    for (const WorldCounter& c : kWorldCounters) {
      if (c.name == "pair_tests") continue;  // of the structure, which only the director rebuilds
      EXPECT_EQ(run.report.world.*c.count, other.*c.count) << c.name;
    }
  }
  const WorldWork& w = run.report.world;
  EXPECT_EQ(run.count("rotation", "rotations"), w.rotations_integrated);
  EXPECT_EQ(run.count("forces", "evaluations"), w.force_evaluations);
  EXPECT_EQ(run.count("narrow phase", "tests"), w.narrow_tests);
  EXPECT_EQ(run.count("narrow phase", "pairs"), w.narrow_pairs);
  EXPECT_EQ(run.count("contact solver", "rows swept") +
                run.count("contact solver", "rows solved at once"),
            w.constraint_rows);
  EXPECT_EQ(run.count("contact solver", "direct solves"), w.direct_solves);
  EXPECT_EQ(run.count("contact solver", "sub-steps"), w.sub_steps);
  EXPECT_EQ(run.count("contact solver", "islands"), w.islands_solved);
  EXPECT_EQ(run.count("friction", "rows"), w.friction_rows);
  EXPECT_EQ(run.uses("sleeping"), run.slept || w.rest_checks > 0);
  if (run.scenario.world.contacts == ContactMethod::none) {
    EXPECT_FALSE(run.uses("narrow phase") || run.uses("friction"));
  }
  // Where each step has a frame, frames tell of all that was done.
  if (run.moments != run.work.world_steps) return;
  const auto sum = [&](const char* name) { return run.of_steps.at(name); };
  if (run.last.count("narrow_tests")) {
    EXPECT_EQ(run.count("narrow phase", "tests"), sum("narrow_tests"));
    EXPECT_EQ(run.count("friction", "rows"), sum("friction_rows"));
  }
  if (run.last.count("rotations")) {
    EXPECT_EQ(run.count("forces", "evaluations"), sum("force_evaluations"));
    EXPECT_EQ(run.count("rotation", "rotations"), sum("rotations"));
  }
}

void expect_structures(const DryRun& run) {
  const bool any = run.pictured > 0;
  std::uint64_t builds = 0;
  for (const Amount& a : run.stage("structure").amounts) builds += a.n;
  EXPECT_EQ(builds, run.work.structure_builds);
  // Without one of its own, a world whose bodies collide compares each with each.
  if (any) {
    EXPECT_EQ(builds > 0, run.most_bodies > 0);
  } else if (run.scenario.world.contacts == ContactMethod::none) {
    EXPECT_EQ(builds, 0u);
  }
  EXPECT_EQ(run.work.structures_created > 0, any);
  if (run.steps_with<Rebuild>() == 0 && run.last.count("static_builds")) {
    EXPECT_EQ(builds, run.last.count("dynamic_builds"));
    EXPECT_EQ(run.count("static structure", "builds"), run.last.count("static_builds"));
  }
  // Phases look before they show, and a sweep shows what it has not found yet.
  if (run.steps_with<Phases>() + run.steps_with<Sweep>() == 0) {
    EXPECT_EQ(run.work.pair_searches, run.pictured);
    EXPECT_EQ(run.work.pairs_found, run.pairs);
  }
  EXPECT_EQ(run.count("broad phase", "searches in steps"), run.report.world.broad_phases);
  EXPECT_EQ(run.count("broad phase", "searches for frames"), run.work.pair_searches);
  EXPECT_EQ(run.count("broad phase", "pairs handed on"), run.report.world.candidate_pairs);
  EXPECT_EQ(run.count("broad phase", "pairs listed"), run.work.pairs_found);
  EXPECT_EQ(run.count("queries", "rays, culls or queries"),
            run.steps_with<CastRay>() + run.steps_with<Cull>() + run.steps_with<Query>());
}

void expect_rest(const DryRun& run) {
  const Scenario& s = run.scenario;
  const auto of_last = [&](const char* name) {
    return static_cast<std::uint64_t>(run.last.count(name).value_or(0));
  };
  EXPECT_EQ(run.uses("level"), s.level && run.steps_with<CompileLevel>() > 0);
  EXPECT_EQ(run.count("level", "sectors"), of_last("sectors"));
  EXPECT_EQ(run.count("atlas", "atlases"), s.atlas ? 1u : 0u);
  EXPECT_EQ(run.count("atlas", "textures packed"), of_last("textures"));
  EXPECT_EQ(run.count("expectations", "checks"), run.report.expectations);
  EXPECT_EQ(run.uses("chart"), s.chart.has_value());
  const std::pair<Panel, const char*> panels[] = {
      {panel_named("world"), "world panel"},   {panel_named("tree"), "tree panel"},
      {panel_named("atlas"), "atlas panel"},   {panel_named("chart"), "chart panel"},
      {panel_named("memory"), "memory panel"}, {panel_named("ledger"), "ledger panel"},
      {panel_named("pool"), "pool panel"},     {panel_named("bytes"), "bytes panel"},
      {panel_named("sparkline"), "sparkline"}, {panel_named("difference"), "difference panel"},
      {panel_named("axes"), "axes panel"},     {panel_named("islands"), "islands panel"},
      {panel_named("code"), "code panel"},     {panel_named("collisions"), "collisions"},
      {panel_named("matrix"), "matrix panel"}, {panel_named("screen"), "screen panel"}};
  for (const auto& [panel, name] : panels) {
    const bool wanted = std::find(s.panels.begin(), s.panels.end(), panel) != s.panels.end();
    EXPECT_EQ(run.uses(name), wanted) << name << ": each panel that there is shows something";
    std::uint64_t frames = 0;
    for (const Amount& a : run.stage(name).amounts) frames = std::max(frames, a.n);
    if (wanted) {
      EXPECT_EQ(frames, run.shown.at(panel)) << name;
    }
  }
}

// Each side does its own work, the same as if it ran alone.
void expect_sum_of_sides(const DryRun& run) {
  WorldWork sum;
  for (const auto& side : run.scenario.sides) {
    Work work;
    const DirectorReport alone = direct(*side, side->pace, work, [](const Frame&) { return true; });
    for (const WorldCounter& c : kWorldCounters) sum.*c.count += alone.world.*c.count;
  }
  for (const WorldCounter& c : kWorldCounters)
    EXPECT_EQ(run.report.world.*c.count, sum.*c.count) << c.name;
}

class EveryTally : public testing::TestWithParam<std::string> {};

TEST_P(EveryTally, IsWhatTheCountersSay) {
  const DryRun run(shipped(GetParam()));
  if (!run.scenario.sides.empty()) return expect_sum_of_sides(run);
  expect_world(run);
  expect_physics(run);
  expect_structures(run);
  expect_rest(run);
  EXPECT_FALSE(run.uses("OpenGL"));
  std::ifstream maps("/proc/self/maps");
  std::stringstream libraries;
  libraries << maps.rdbuf();
  EXPECT_NE(libraries.str().find("libstdc++"), std::string::npos);
  for (const char* library : {"OSMesa", "libEGL", "libGL.", "gallium", "lantern_peer"})
    EXPECT_EQ(libraries.str().find(library), std::string::npos) << library;
}

std::vector<std::string> tallied_files() {
  std::vector<std::string> files = all_files();
#ifdef __SANITIZE_ADDRESS__
  // More of the same, and half of the time of all.
  for (const char* more : {"pyramid_stiff", "pile_solid", "chain_extreme"})
    EXPECT_EQ(std::erase(files, std::string("problems/") + more), 1u) << more;
#endif
  EXPECT_GT(files.size(), 80u);
  return files;
}

INSTANTIATE_TEST_SUITE_P(Files, EveryTally, testing::ValuesIn(tallied_files()), test_name_of_file);

std::string moving(const std::string& velocity, const std::string& steps) {
  return "title = \"x\"\n[world]\nsize = [9, 9]\n[[body]]\nname = \"a\"\nradius = 1\n"
         "position = [1, 1]\nvelocity = " +
         velocity + "\n" + steps;
}

TEST(Tally, OfEveryExampleOfTheReference) {
  for (const std::string& text : good_texts()) {
    const DryRun run(good(text));
    if (!run.scenario.sides.empty()) continue;  // above
    expect_world(run);
    expect_physics(run);
  }
}

// What a scene has and what it makes of it are two things.
TEST(Tally, CountsWhatRan) {
  const std::string insert = "[[step]]\ndo = \"insert\"\nbodies = [\"a\"]\n";
  const std::string run = "[[step]]\ndo = \"run\"\nseconds = 1\n";
  const DryRun late(good(moving("[1, 0]", run + insert)));
  EXPECT_EQ(late.count("motion", "steps"), 60u) << "of an empty world";
  const DryRun standing(good(moving("[1, 0]", insert)));
  EXPECT_FALSE(standing.uses("motion"));
  EXPECT_EQ(standing.stage("motion").note, "no time passed");
  const DryRun everything(good(std::string(kSolid)));
  for (const char* stage : {"world", "motion", "rotation", "forces", "springs and joints",
                            "structure", "static structure", "broad phase", "narrow phase",
                            "contact solver", "friction", "sleeping", "queries", "3D camera"})
    EXPECT_TRUE(everything.uses(stage)) << stage;
}

TEST(Tally, OfALevelThatIsNotCompiled) {
  const DryRun run(
      good("title = \"x\"\n[world]\nsize = [12, 8]\n"
           "[level]\nloops = [[[1, 1], [11, 1], [11, 7]]]\n[[step]]\ndo = \"show\"\n"));
  EXPECT_FALSE(run.uses("level"));
  EXPECT_EQ(run.stage("level").note, "no step compiles it");
  EXPECT_EQ(run.count("world panel", "frames with walls"), 1u);
  EXPECT_EQ(run.count("world panel", "frames with bodies"), 0u);
}

TEST(Tally, TellsAKindOfStructureByItsBuilds) {
  const DryRun run(shipped("pong_bsp"));
  EXPECT_EQ(run.count("structure", "brute_force builds"), 1u);
  EXPECT_EQ(run.count("structure", "bsp builds"), 7u);
}

TEST(Panels, AreDerivedUnlessGiven) {
  using Panels = std::vector<Panel>;
  const auto of = [](const std::string& text) { return good(text).panels; };
  const std::string ghosts = read_text(LANTERN_ROOT "/scenarios/ghost_quadtree.toml");
  EXPECT_EQ(of(ghosts), (Panels{panel_named("world"), panel_named("tree")}));
  EXPECT_EQ(of(read_text(LANTERN_ROOT "/scenarios/kdtree_atlas.toml")),
            (Panels{panel_named("atlas"), panel_named("tree")}));
  EXPECT_EQ(of(std::string(example("level"))), (Panels{panel_named("world"), panel_named("tree")}));
  const DryRun given(good("panels = [\"tree\"]\n" + ghosts));
  EXPECT_EQ(given.scenario.panels, (Panels{panel_named("tree")}));
  EXPECT_FALSE(given.uses("world panel"));
  EXPECT_EQ(given.stage("world panel").note, "none of the scenario's panels");
  EXPECT_EQ(of(moving("[0, 0]", "[structure]\nkind = \"brute_force\"\n[[step]]\ndo = \"show\"\n")),
            (Panels{panel_named("world")}))
      << "brute force has no tree";
}

}  // namespace
}  // namespace lantern::run
