// The same scenario gives the same bytes, whatever draws it and however the work is cut up.
#include <csignal>
#include <map>

#include <gtest/gtest.h>

#include "app/process.hpp"

namespace lantern::app {
namespace {

namespace fs = std::filesystem;

const std::string kScenario = scenario("coincident_max_depth");
const std::string kName = "coincident_max_depth";

using Files = std::map<std::string, std::string>;

Files files_of(const fs::path& out) {
  Files files;
  for (const auto& entry : fs::directory_iterator(out / kName))
    files[entry.path().filename()] = read_text(entry.path());
  return files;
}

Files rendered(const std::string& folder, const std::string& before, const std::string& words) {
  const fs::path out = fresh_folder(folder);
  const Outcome o = shell(before + " lantern render " + kScenario + " --size 640x360 " + words +
                          " -o " + out.string());
  EXPECT_EQ(o.code, 0) << o.err;
  return files_of(out);
}

void expect_same(const Files& expected, const Files& actual, const std::string& what) {
  ASSERT_EQ(expected.size(), actual.size()) << what;
  for (const auto& [name, bytes] : expected)
    EXPECT_TRUE(actual.contains(name) && actual.at(name) == bytes) << what << " changes " << name;
}

class SameBytes : public testing::Test {
 protected:
  // Bytes are compared with bytes of the same program: those of the release build will do, and
  // other tests watch the program under sanitizers.
  void SetUp() override {
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "in the release build";
#endif
  }
  static const Files& reference() {
    static const Files files = rendered("same-reference", "", "-j 1 --backend osmesa");
    return files;
  }
};

TEST_F(SameBytes, WithEgl) {
  expect_same(reference(), rendered("same-egl", "", "--backend egl"), "EGL");
}

TEST_F(SameBytes, AfterAnotherScenarioAndItsAtlas) {
  const fs::path out = fresh_folder("same-after");
  const Outcome o = shell("lantern render " + scenario("kdtree_atlas") + " " + kScenario +
                          " --size 640x360 -o " + out.string());
  EXPECT_EQ(o.code, 0) << o.err;
  expect_same(reference(), files_of(out), "another scenario before it");
}

TEST_F(SameBytes, WithManyThreads) {
  expect_same(reference(), rendered("same-j", "", "-j 4"), "-j 4");
  expect_same(reference(), rendered("same-lp", "export LP_NUM_THREADS=2;", ""), "LP_NUM_THREADS=2");
}

TEST_F(SameBytes, WithOlderProcessors) {
  for (const std::string caps : {"sse2", "avx"})
    expect_same(reference(),
                rendered("same-" + caps, "export GALLIUM_OVERRIDE_CPU_CAPS=" + caps + ";", ""),
                caps);
}

TEST_F(SameBytes, AloneOrInARange) {
  const Files& all = reference();
  for (const std::string range : {"5", "3-7", "9-"}) {
    const Files some = rendered("same-range", "", "--frames " + range);
    EXPECT_GT(some.size(), 2u);
    for (const auto& [name, bytes] : some) {
      if (name == "manifest.json") continue;
      EXPECT_TRUE(all.contains(name) && all.at(name) == bytes)
          << "--frames " << range << " changes " << name;
    }
  }
}

// A killed run leaves whole frames only, and the next one goes on where it stopped. On a disk that
// knows no nameless files a temporary one may stay behind until then.
TEST_F(SameBytes, AfterARunThatWasKilled) {
  const Files& all = reference();
  bool cut_off = false;
  // Who is killed when it has written its first frames has rarely written its last.
  for (int attempt = 0; attempt < 100 && !cut_off; ++attempt) {
    const fs::path out = fresh_folder("same-killed");
    const std::string words = "render " + kScenario + " --size 640x360 -o " + out.string();
    shell("begin " + words + "; until_so 'ls " + (out / kName).string() + "/*" +
          std::to_string(2 + attempt % 10) + ".png >/dev/null 2>&1'; kill -KILL $program; wait");
    const Files left = fs::exists(out / kName) ? files_of(out) : Files();
    for (const auto& [name, bytes] : left) {
      if (name == "manifest.json" || name.starts_with(".lantern-part-")) continue;
      ASSERT_TRUE(all.contains(name)) << name << " was left behind by a killed run";
      EXPECT_EQ(all.at(name), bytes) << name << " was left half written";
    }
    cut_off = left.size() > 1 && left.size() < all.size();
    EXPECT_EQ(shell("lantern " + words).code, 0);
    expect_same(all, files_of(out), "a killed run");
  }
  EXPECT_TRUE(cut_off) << "no run was cut off in the midst";
}

// Solid worlds are drawn of the same shapes, and the engine's steps are the same in every run.
TEST_F(SameBytes, OfSolidAndMovingWorlds) {
  for (const std::string name : {"octree_split", "falling_boxes"}) {
    const auto files = [&](const std::string& folder, const std::string& before,
                           const std::string& words) {
      const fs::path out = fresh_folder(folder + "-" + name);
      const Outcome o = shell(before + " lantern render " + scenario(name) +
                              " --size 480x270 --frames 0-8 " + words + " -o " + out.string());
      EXPECT_EQ(o.code, 0) << o.err;
      Files found;
      for (const auto& entry : fs::directory_iterator(out / name))
        found[entry.path().filename()] = read_text(entry.path());
      return found;
    };
    const Files expected = files("moving", "", "-j 1 --backend osmesa");
    EXPECT_GE(expected.size(), 19u);
    expect_same(expected, files("moving-j", "", "-j 4"), name + " with -j 4");
    expect_same(expected, files("moving-egl", "", "--backend egl"), name + " with EGL");
    expect_same(expected, files("moving-sse2", "export GALLIUM_OVERRIDE_CPU_CAPS=sse2;", ""),
                name + " with sse2");
  }
}

TEST_F(SameBytes, AfterCtrlC) {
  const fs::path out = fresh_folder("same-interrupted");
  const std::string words =
      "render " + kScenario + " --size 7680x4320 --png small -o " + out.string();
  const Outcome o = shell("begin " + words + "; until_so 'ls " + (out / kName).string() +
                          "/*.png >/dev/null 2>&1'; interrupt");
  EXPECT_EQ(o.code, 130) << o.err;
}

}  // namespace
}  // namespace lantern::app
