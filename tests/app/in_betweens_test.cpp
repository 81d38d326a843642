// --tween and --fps: pictures between the frames, and no trace of them where they are not wanted.
#include <algorithm>
#include <map>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/output/render_job.hpp"
#include "app/process.hpp"
#include "app/terminal.hpp"

namespace lantern::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using Files = std::map<std::string, std::string>;

Files pictures_in(const fs::path& folder) {
  Files files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() != ".lock")
      files[entry.path().filename()] = read_text(entry.path());
  return files;
}

std::size_t in_betweens_of(const Files& files) {
  return static_cast<std::size_t>(std::ranges::count_if(files, [](const auto& file) {
    return std::ranges::count(file.first, '_') == 3;  // ghost_quadtree_0007_03
  }));
}

Outcome render(const std::string& words, const fs::path& out) {
  return shell("lantern render " + kGhosts + " --size 160x90 -o " + out.string() + " " + words);
}

TEST(InBetweens, StandByNameBetweenTheFramesThatTheyLeadFromAndTo) {
  const fs::path out = fresh_folder("tween");
  const Outcome o = render("--tween 3 --json", out);
  ASSERT_EQ(o.code, 0) << o.err;
  const Files files = pictures_in(out / "ghost_quadtree");
  EXPECT_TRUE(files.contains("ghost_quadtree_0000_01.png"));
  EXPECT_TRUE(files.contains("ghost_quadtree_0006_03.png"));
  EXPECT_FALSE(files.contains("ghost_quadtree_0006_04.png"));
  EXPECT_FALSE(files.contains("ghost_quadtree_0007_01.png")) << "the last frame leads nowhere";
  EXPECT_FALSE(files.contains("ghost_quadtree_0000_01.json"));
  EXPECT_EQ(in_betweens_of(files), 21u);
  const json manifest = json::parse(files.at("manifest.json"));
  EXPECT_EQ(manifest["tween"], "3");
  EXPECT_EQ(manifest["frames"][0]["in_betweens"], 3);
  EXPECT_EQ(manifest["frames"][7]["in_betweens"], 0);
  const json said = json::parse(o.out);
  EXPECT_EQ(said["work"]["in_betweens"], 21);
  EXPECT_EQ(said["scenarios"][0]["in_betweens"], 21);
  EXPECT_NE(o.err.find("8 frames and 21 in-betweens in"), std::string::npos) << o.err;
}

TEST(InBetweens, FramesAreAsWithoutThem) {
  const fs::path out = fresh_folder("tween-frames");
  const Outcome o = render("--json", out / "without");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(json::parse(o.out)["work"]["in_betweens"], 0);
  ASSERT_EQ(render("--tween 2", out / "with").code, 0);
  const Files without = pictures_in(out / "without/ghost_quadtree");
  Files with = pictures_in(out / "with/ghost_quadtree");
  EXPECT_EQ(in_betweens_of(without), 0u);
  EXPECT_EQ(without.at("manifest.json").find("tween"), std::string::npos);
  for (const auto& [name, bytes] : without)
    if (name != "manifest.json") {
      EXPECT_EQ(with[name], bytes) << name;
    }
}

TEST(InBetweens, AreTheSameWhateverTheThreads) {
  const fs::path out = fresh_folder("tween-threads");
  for (const char* format : {"png", "svg"}) {
    const std::string words = std::string("--tween 2 --format ") + format + " -j ";
    ASSERT_EQ(render(words + "1", out / format / "one").code, 0);
    ASSERT_EQ(render(words + "5", out / format / "five").code, 0);
    const Files one = pictures_in(out / format / "one/ghost_quadtree");
    EXPECT_EQ(in_betweens_of(one), 14u);
    EXPECT_EQ(one, pictures_in(out / format / "five/ghost_quadtree"));
  }
}

// Whatever was there before, in the end there is what a clean run leaves.
TEST(InBetweens, OfAnEarlierRunStayOrGoAsFramesDo) {
  const fs::path out = fresh_folder("tween-older");
  const std::string wanted = "--tween 2";
  ASSERT_EQ(render(wanted, out / "clean").code, 0);
  const Files clean = pictures_in(out / "clean/ghost_quadtree");
  for (const char* before : {"", "--tween 5", "--fps 10", "--tween 2 --theme dark",
                             "--tween 2 --format svg", "--tween 2 --frames 2-4", "--tween 2"}) {
    const fs::path folder = out / std::to_string(std::hash<std::string>()(before));
    ASSERT_EQ(render(before, folder).code, 0) << before;
    ASSERT_EQ(render(wanted, folder).code, 0) << before;
    EXPECT_EQ(pictures_in(folder / "ghost_quadtree"), clean) << "after " << before;
  }
  ASSERT_EQ(render("", out / "clean").code, 0);
  EXPECT_EQ(in_betweens_of(pictures_in(out / "clean/ghost_quadtree")), 0u);
}

TEST(InBetweens, ThatStandAreNotMadeAgain) {
  const fs::path out = fresh_folder("tween-again");
  ASSERT_EQ(render("--tween 2", out).code, 0);
  fs::remove(out / "ghost_quadtree/ghost_quadtree_0003_02.png");
  const Outcome o = render("--tween 2 --json", out);
  EXPECT_EQ(json::parse(o.out)["work"]["in_betweens"], 1);
  EXPECT_EQ(json::parse(o.out)["scenarios"][0]["kept"], 8);
}

TEST(InBetweens, OfSomeFramesAreThoseBetweenThem) {
  const fs::path out = fresh_folder("tween-some");
  ASSERT_EQ(render("--tween 2 --frames 3-5", out).code, 0);
  const Files files = pictures_in(out / "ghost_quadtree");
  EXPECT_EQ(in_betweens_of(files), 4u);
  EXPECT_TRUE(files.contains("ghost_quadtree_0004_02.png"));
}

TEST(InBetweens, ThatCannotBeAreRefusedBeforeAnyWork) {
  const fs::path out = fresh_folder("tween-bad");
  const auto refused = [&](const std::string& words, const std::string& why) {
    const Outcome o = render(words, out);
    EXPECT_EQ(o.code, 2) << words;
    EXPECT_NE(o.err.find(why), std::string::npos) << o.err;
    EXPECT_FALSE(fs::exists(out / "ghost_quadtree"));
  };
  refused("--tween 1000000", "more than 100 000 pictures");
  refused("--pace event --tween 1000000", "more than 100 000 pictures");
  refused("--tween -3", "--tween");
  refused("--fps 1000", "--fps");
  refused("--fps nan", "--fps");
  refused("--tween 3 --fps 20", "give one of them");
  const Outcome o = shell("lantern render " + kGhosts + " -o - --frames 1 --tween 3");
  EXPECT_EQ(o.code, 2);
  EXPECT_NE(o.err.find("in-betweens"), std::string::npos) << o.err;
  EXPECT_TRUE(o.out.empty());
}

TEST(InBetweens, AreAsManyAsAChangeOfHalfASecondHas) {
  const InBetweens film(std::nullopt, 30.0);
  Frame a, b;
  EXPECT_EQ(film.between(a, b), 14u);  // 15 steps of a 30th
  EXPECT_EQ(motion_between(a, b), Motion::eased);
  b.time = 0.1;  // the world's own time: three steps of a 30th
  EXPECT_EQ(film.between(a, b), 2u);
  EXPECT_EQ(motion_between(a, b), Motion::steady);
  b.time = 1 / 60.0;
  EXPECT_EQ(film.between(a, b), 0u) << "denser than the film";
  b.time = 3;
  EXPECT_EQ(film.between(a, b), 14u);
  EXPECT_EQ(motion_between(a, b), Motion::eased) << "a leap";

  const InBetweens five(5, std::nullopt);
  EXPECT_EQ(five.between(a, b), 5u);
  EXPECT_NO_THROW(five.require_few(16667));
  EXPECT_THROW(five.require_few(16668), UsageError);
}

}  // namespace
}  // namespace lantern::app
