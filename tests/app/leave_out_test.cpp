// What a scene does not need is not there: counters at zero, libraries not loaded.
#include <CLI/CLI.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "app/commands/command.hpp"
#include "app/process.hpp"
#include "app/program.hpp"
#include "draw/font.hpp"
#include "rooms.hpp"

namespace lantern::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

json work_of(const std::string& words) {
  const Outcome o = shell("lantern " + words + " --json");
  EXPECT_EQ(o.code, 0) << o.err;
  return json::parse(o.out)["work"];
}

TEST(LeaveOut, AnAtlasHasNoWorld) {
  const json work = work_of("check " + scenario("kdtree_atlas"));
  EXPECT_EQ(work["worlds_created"], 0);
  EXPECT_EQ(work["world_steps"], 0);
  EXPECT_EQ(work["structures_created"], 0);
  EXPECT_EQ(work["atlases_created"], 1);
}

TEST(LeaveOut, ATreeHasNoAtlasAndAStandingSceneNoSteps) {
  const json work = work_of("check " + scenario("frustum_culling"));
  EXPECT_EQ(work["atlases_created"], 0);
  EXPECT_EQ(work["world_steps"], 0);
  EXPECT_EQ(work["worlds_created"], 1);
}

TEST(LeaveOut, CheckDrawsNothing) {
  const json work = work_of("check " + scenario("pong_bsp"));
  for (const char* stage :
       {"world_layouts", "tree_layouts", "graphics_contexts", "frames_drawn", "frames_encoded"})
    EXPECT_EQ(work[stage], 0) << stage;
  EXPECT_EQ(work["world_steps"], 64);
}

TEST(LeaveOut, WithoutATreePanelNoTreeIsLaidOut) {
  const fs::path out = fresh_folder("leave-out");
  write_text(out / "world_only.toml",
             "panels = [\"world\"]\n" + read_text(scenario("ghost_quadtree")));
  const std::string words = " --size 320x180 --format svg -o " + out.string();
  const json without = work_of("render " + (out / "world_only.toml").string() + words);
  EXPECT_EQ(without["tree_layouts"], 0);
  EXPECT_EQ(without["world_layouts"], 9);
  EXPECT_EQ(work_of("render " + scenario("ghost_quadtree") + words)["tree_layouts"], 9);
}

TEST(LeaveOut, SvgNeedsNoGraphicsContext) {
  const fs::path out = fresh_folder("leave-out-svg");
  const json work =
      work_of("render " + scenario("ghost_quadtree") + " --format svg -o " + out.string());
  EXPECT_EQ(work["graphics_contexts"], 0);
}

TEST(LeaveOut, ScenariosOfOneCommandShareTheirGraphics) {
  const json work = work_of("render " + scenario("ghost_quadtree") + " " + scenario("buckets") +
                            " --size 320x180 -o " + fresh_folder("leave-out-shared").string());
  EXPECT_EQ(work["frames_drawn"], 9 + 4);
  EXPECT_EQ(work["graphics_contexts"], 1);
}

// The dynamic loader tells each library that it opens.
bool loads_any(const std::string& words, std::initializer_list<const char*> libraries) {
  const Outcome o = shell("LD_DEBUG=files " LANTERN_BINARY " " + words);
  EXPECT_EQ(o.code, 0) << words;
  EXPECT_NE(o.err.find("libstdc++"), std::string::npos) << "the loader tells nothing";
  for (const char* library : libraries)
    if (o.err.find(library) != std::string::npos) return true;
  return false;
}

TEST(LeaveOut, CheckAndSvgLoadNoGraphicsLibrary) {
  const fs::path out = fresh_folder("leave-out-libraries");
  const auto loads_gl = [&](const std::string& words) {
    return loads_any(words, {"libOSMesa", "libEGL", "libGL.", "libgallium", "swrast"});
  };
  EXPECT_FALSE(loads_gl("check " + scenario("ghost_quadtree")));
  EXPECT_FALSE(loads_gl("explain " + scenario("ghost_quadtree")));
  EXPECT_FALSE(
      loads_gl("render --format svg -o " + out.string() + " " + scenario("ghost_quadtree")));
  EXPECT_TRUE(loads_gl("render --frames 0 -o " + out.string() + " " + scenario("ghost_quadtree")))
      << "PNG needs it: if this fails, the test above proves nothing";
}

// The shell runs them all; `used` is told of no library, and none is loaded. Which libraries are
// loaded does not depend on the sanitizers, under which the problems take long.
TEST(LeaveOut, ExplainLoadsNoLibraryForAnyScenarioOrProblem) {
#ifdef __SANITIZE_ADDRESS__
#define LANTERN_TEST_FILES "*.toml"
#else
#define LANTERN_TEST_FILES "*.toml problems/*.toml"
#endif
  const Outcome o =
      shell("cd " LANTERN_ROOT "/scenarios && for f in " LANTERN_TEST_FILES
            "; do LD_DEBUG=files " LANTERN_BINARY
            " explain $f 2>&1 >/dev/null | grep -E 'libOSMesa|libEGL|libGL\\.|libgallium|swrast|"
            "lantern_peer'; done; true");
  EXPECT_EQ(o.code, 0);
  EXPECT_EQ(o.out, "");
}

// Highway's library measures a clock before main().
TEST(LeaveOut, BoxesAreScannedWithoutHighwaysLibrary) {
  EXPECT_FALSE(loads_any("check " + scenario("sweep_and_prune"), {"libhwy"}));
}

// In a process of its own, in which no other test has set a text: a weight is made when it is first
// asked for.
[[noreturn]] void check_and_count_faces() {
  std::vector<std::string> words = {"lantern", "check", "--quiet", kGhosts};
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  const bool good = run_program(static_cast<int>(argv.size()), argv.data()) == 0;
  const std::uint64_t before = draw::faces_made();
  draw::text_width("A", 1, draw::Weight::regular);
  ::_exit(good && before == 0 && draw::faces_made() == 1 ? 0 : 1);
}

TEST(LeaveOutDeathTest, CheckKernsNoTypeface) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(check_and_count_faces(), testing::ExitedWithCode(0), "");
}

TEST(LeaveOut, NoCommandHasOptionsButTheOneThatIsNamed) {
  CLI::App app;
  app::Run run;
  add_commands(app, run);
  app.parse("check " + kGhosts);
  const auto commands = app.get_subcommands(nullptr);
  EXPECT_GT(commands.size(), 10u);
  for (const CLI::App* c : commands)
    EXPECT_EQ(c->get_options().empty(), c->get_name() != "check") << c->get_name();
}

// The options of all commands would take 5,000 more.
TEST(LeaveOut, CheckOfASmallFileTakesFewAllocations) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizers allocate by themselves";
#endif
  const fs::path out = fresh_folder("leave-out-allocations");
  const std::string readme = read_text(repository("README.md"));
  const std::size_t at = readme.find("```toml\n") + 8;
  write_text(out / "first.toml", readme.substr(at, readme.find("```", at) - at));
  const Outcome o = shell("cd " + out.string() +
                          " && FAULT_KIND=new FAULT_LOG=calls LD_PRELOAD=" LANTERN_FAULTS
                          " " LANTERN_BINARY " check first.toml");
  EXPECT_EQ(o.code, 0) << o.err;
  const int calls = std::atoi(read_text(out / "calls").c_str());
  EXPECT_GT(calls, 100) << "they are not counted";
  EXPECT_LT(calls, 2500);
}

TEST(LeaveOut, OtherEnginesAreLoadedOnlyToBeMeasured) {
  const fs::path out = fresh_folder("leave-out-peers");
  const auto loads_peers = [&](const std::string& words) {
    return loads_any(words, {"lantern_peer", "libBullet", "libbox2d", "libode", "libmujoco"});
  };
  EXPECT_FALSE(loads_peers("check " + scenario("falling_boxes")));
  EXPECT_FALSE(loads_peers("render --frames 0 -o " + out.string() + " " + scenario("sleeping")));
  // A scenario without an answer is not run by others, nor is what is not flat by Box2D.
  const std::string to = " --quick --longest 1 -o " + out.string();
  EXPECT_FALSE(loads_peers("measure " + scenario("spring_rope") +
                           " --method explicit_euler --step 0.02" + to));
  EXPECT_FALSE(loads_any("measure free_top" + to, {"lantern_peer_box2d", "libbox2d"}));
  EXPECT_FALSE(loads_any("measure kepler" + to, {"lantern_peer_mujoco", "libmujoco"}));
  // Doctor loads those of engines and boxes; the packer's is built wherever stb is.
  std::error_code error;
  const fs::directory_iterator modules(fs::path(LANTERN_BINARY).parent_path() / "peers", error);
  const bool others = std::any_of(begin(modules), end(modules), [](const auto& module) {
    return module.path().filename() != "lantern_peer_atlas_stb.so";
  });
  if (others) {
    EXPECT_TRUE(loads_peers("doctor")) << "if this fails, the test above proves nothing";
  }
}

}  // namespace
}  // namespace lantern::app
