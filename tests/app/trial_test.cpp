// What a long run tries out beside itself, and that a short one does not.
#include "app/trial.hpp"

#include <gtest/gtest.h>

#include "app/process.hpp"
#include "app/run_scenario.hpp"
#include "run/warnings.hpp"

namespace lantern::app {
namespace {

// So many boxes in layers on a floor between walls.
template <int D>
World<D> pile(int count) {
  WorldConfig<D> config;
  config.gravity.y = -10;
  World<D> world(config);
  for (int axis = 0; axis < D; ++axis)
    for (const double side : {-1.0, 1.0}) {
      Body<D> wall;
      Vec<D> normal(0.0);
      normal[axis] = -side;
      wall.shape = HalfSpace<D>{normal};
      wall.kind = BodyKind::static_body;
      wall.position[axis] = side * (axis == 1 ? 40.0 : 2.7);
      if (axis == 1 && side > 0) continue;
      if (axis == 1) wall.position[axis] = 0;
      world.add(wall);
    }
  const int row = 4, layer = D == 2 ? row : row * row;
  for (int i = 0; i < count; ++i) {
    Body<D> box;
    box.shape = OrientedBox<D>{Vec<D>(0.5)};
    const double first = i / layer % 2 == 0 ? -1.85 : -1.35;  // each rests on its neighbours
    box.position = Vec<D>(first + 1.05 * (i % row));
    if (D == 3) box.position[D - 1] = first + 1.05 * (i / row % row);
    box.position.y = 0.52 + 1.02 * (i / layer);
    world.add(box);
  }
  for (int i = 0; i < 10; ++i) world.step(1.0 / 60);
  return world;
}

template <int D>
void tries_beside(int count) {
  const World<D> world = pile<D>(count);
  const std::uint64_t hash = world.hash(), rows = world.work().constraint_rows;
  const SettingTrial trial = try_out(world, 1.0 / 60, 100);
  EXPECT_EQ(trial.steps, 10);
  EXPECT_EQ(trial.as_is.work.steps, 10u);
  EXPECT_EQ(trial.quick.work.steps, 10u);
  EXPECT_GT(trial.quick.work.normal_rows, 0u);
  EXPECT_LT(trial.quick.work.sub_steps, trial.as_is.work.sub_steps);
  EXPECT_EQ(trial.quick.work.direct_rows, 0u);
  EXPECT_GT(trial.quick.seconds, 0);
  EXPECT_LE(trial.quick.deepest, 0.02);
  EXPECT_EQ(world.hash(), hash);
  EXPECT_EQ(world.work().steps, 10u);
  EXPECT_EQ(world.work().constraint_rows, rows);
  EXPECT_EQ(try_out(world, 1.0 / 60, 0).steps, 1);
}

TEST(Trial, LeavesTheWorldAsItIs2D) { tries_beside<2>(60); }
TEST(Trial, LeavesTheWorldAsItIs3D) { tries_beside<3>(64); }

TEST(Trial, SaysWhatWasMeasured) {
  const SettingTrial trial{10, {1.4, 0.0002}, {0.11, 0.0031}};
  EXPECT_EQ(trial.text(),
            "with wanted_error = 0.01 in [world] 10 steps from here took 0.11 s instead of 1.4 s; "
            "bodies then lie up to 0.01 deep in each other, or as deep as before (0.0031 here "
            "instead of 0.0002)");
  EXPECT_EQ((SettingTrial{10, {0.3, 0}, {0.2, 0}}.text()), "");
}

TEST(Trial, SaysHowOftenTheErrorWasMissed) {
  SettingTrial trial{10, {1.4, 0.0002}, {0.11, 0.02}};
  trial.as_is.work.errors_missed = 7;  // of no concern: there none is wanted
  EXPECT_TRUE(trial.text().ends_with("(0.02 here instead of 0.0002)"));
  trial.quick.work.errors_missed = 1;
  EXPECT_TRUE(trial.text().ends_with("(0.02 here instead of 0.0002); 1 pair lay deeper"));
  trial.quick.work.errors_missed = 3;
  EXPECT_TRUE(trial.text().ends_with("; 3 pairs lay deeper"));
}

std::string pile_of(int count, const std::string& world, double seconds) {
  return R"(title = "A pile"
[world]
min = [-30, 0]
max = [30, 80]
gravity = [0, -10]
quiet = ["outside"]
)" + world +
         R"(
[structure]
kind = "sort_and_sweep"
[[body]]
name = "floor"
ground = [0, 1]
position = [0, 0]
static = true
[[pattern]]
name = "box"
arrange = "grid"
count = )" +
         std::to_string(count) + R"(
min = [-20, 1]
max = [20, 40]
half_size = [0.5, 0.5]
oriented = true
[[step]]
do = "insert"
bodies = ["floor", "box"]
[[step]]
do = "run"
seconds = )" +
         std::to_string(seconds) + "\nevery = 60\n";
}

// How many worlds a run of so many steps makes beside its own if `left` seconds are said to be
// left.
std::uint64_t trial_worlds(const std::string& world, double left, std::uint64_t steps = 12) {
  const Scenario scenario =
      parse_scenario(pile_of(4, world, static_cast<double>(steps) / 60), "pile.toml");
  Work work;
  Trials trials([&] { return left; }, work);
  RunWatch watch(trials);
  direct(
      scenario, Pace::step, work, [](const Frame&) { return true; }, &watch);
  EXPECT_EQ(work.worlds_created, 1u);
  EXPECT_EQ(work.world_steps, steps);
  return work.trial_worlds;
}

TEST(Trial, IsMadeOnlyWhereItMayHelp) {
  EXPECT_EQ(trial_worlds("contacts = \"soft\"", 1000), 2u);
  EXPECT_EQ(trial_worlds("contacts = \"soft\"", 0), 0u);
  EXPECT_EQ(trial_worlds("contacts = \"soft\"\nwanted_error = 0.1", 1000), 0u);
  EXPECT_EQ(trial_worlds("contacts = \"direct\"", 1000), 0u);
  EXPECT_EQ(trial_worlds("contacts = \"impulse\"", 1000), 0u);
}

TEST(Trial, IsMadeAgainWhileNothingIsToBeSaid) {
  testing::internal::CaptureStderr();
  const std::uint64_t worlds = trial_worlds("contacts = \"soft\"", 1e6, 900);
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_TRUE(worlds == 6 || !said.empty()) << worlds << said;
}

TEST(Trial, IsNotMadeInAShortRun) {
  const Scenario scenario = parse_scenario(pile_of(40, "contacts = \"soft\"", 0.5), "pile.toml");
  FrameSink nobody;
  Work work;
  run_scenario(scenario, Pace::step, nobody, work);
  EXPECT_EQ(work.world_steps, 30u);
  EXPECT_EQ(work.trial_worlds, 0u);
}

TEST(Trial, IsToldOfALongRun) {
  const auto folder = fresh_folder("trial");
  write_text(folder / "pile.toml", pile_of(1500, "contacts = \"soft\"", 600));
  const std::string said = (folder / "said").string();
  const Outcome o =
      shell("begin check " + (folder / "pile.toml").string() + " 2>" + said +
            "; until_so 'grep -q \"^pile: with wanted_error\" " + said + "'; interrupt");
  EXPECT_EQ(o.code, 130) << read_text(said);
  EXPECT_NE(read_text(said).find("steps from here took"), std::string::npos) << read_text(said);
}

}  // namespace
}  // namespace lantern::app
