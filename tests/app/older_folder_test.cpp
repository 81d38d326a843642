// Whatever an earlier run has left in a folder, a run leaves what it would leave in an empty one.
#include <map>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/process.hpp"

namespace lantern::app {
namespace {

namespace fs = std::filesystem;

using Files = std::map<std::string, std::string>;

Files files_in(const fs::path& folder) {
  Files files;
  if (!fs::exists(folder)) return files;
  for (const auto& entry : fs::directory_iterator(folder))
    files[entry.path().filename()] = read_text(entry.path());
  return files;
}

// The frames of `then` over those of `before`, which were whole or cut off, are those of a clean
// run of `then`.
class OlderFolder : public testing::Test {
 protected:
  void SetUp() override { root_ = fresh_folder("older-folder"); }

  std::string write_scenario(const std::string& name, const std::string& seed,
                             const std::string& caption) {
    const fs::path file = root_ / name / "ghosts.toml";
    fs::create_directories(file.parent_path());
    std::string text = "title = \"Ghosts\"\nseed = " + seed +
                       "\n[world]\nsize = [16, 9]\n[structure]\nkind = \"quadtree\"\n"
                       "[[pattern]]\nname = \"g\"\ncount = 9\nradius = 0.4\nspeed = 2\n"
                       "[[step]]\ndo = \"insert\"\nbodies = [\"g\"]\ncaption = \"" +
                       caption + "\"\n[[step]]\ndo = \"run\"\nseconds = 0.2\n";
    write_text(file, text);
    return file.string();
  }

  static std::string with_size(const std::string& words) {
    return words + (words.find("--size") == std::string::npos ? " --size 160x90" : "");
  }

  Outcome render(const std::string& words, const fs::path& out) {
    return shell("lantern render " + with_size(words) + " -o " + out.string());
  }

  // Killed as soon as frame 5 is there, or over before.
  void cut_short(const std::string& words, const fs::path& out) {
    const std::string frames = (out / "ghosts").string();
    shell(LANTERN_BINARY " render -j 1 " + with_size(words) + " -o " + out.string() +
          " & p=$!; until grep -q '\"finished\": false' " + frames + "/manifest.json && test -e " +
          frames + "/ghosts_0005.json; do kill -0 $p || break; done; kill -KILL $p; wait $p");
  }

  void expect_clean(const std::string& words, const fs::path& out, const std::string& what) {
    const fs::path clean = root_ / fmt::format("clean-{}", std::hash<std::string>()(words));
    if (!fs::exists(clean)) {
      ASSERT_EQ(render(words, clean).code, 0);
    }
    const Outcome o = render(words, out);
    EXPECT_EQ(o.code, 0) << what << o.err;
    const Files expected = files_in(clean / "ghosts"), found = files_in(out / "ghosts");
    for (const auto& [name, bytes] : expected)
      EXPECT_TRUE(found.contains(name) && found.at(name) == bytes) << what << ": " << name;
    for (const auto& [name, bytes] : found)
      EXPECT_TRUE(expected.contains(name)) << what << ": " << name << " does not belong";
  }

  fs::path root_;
};

TEST_F(OlderFolder, OfOtherSwitches) {
  const std::string now = write_scenario("now", "1", "Nine ghosts.");
  std::string before = now;
  for (const char* switches : {"--no-title", "--no-caption", "--no-counters", "--legend", ""}) {
    const fs::path out = root_ / "switched";
    ASSERT_EQ(render(before, out).code, 0);
    before = now + " " + switches;
    expect_clean(before, out, fmt::format("then '{}'", switches));
  }
}

TEST_F(OlderFolder, OfAnythingElse) {
  const std::string now = write_scenario("now", "1", "Nine ghosts.");
  const std::map<std::string, std::string> older = {
      {"another text", write_scenario("text", "1", "9 ghosts.")},
      {"another seed", write_scenario("seed", "2", "Nine ghosts.")},
      {"another theme", now + " --theme dark"},
      {"another size", now + " --size 200x90"},
      {"another format", now + " --format svg"},
      {"another effort", now + " --png small"},
      {"another pace", now + " --pace event"},
      {"no paper", now + " --transparent"},
      {"a range", now + " --frames 2-3"},
      {"the same", now},
  };
  for (const auto& [what, words] : older) {
    const fs::path out = root_ / "out";
    fs::remove_all(out);
    ASSERT_EQ(render(words, out).code, 0) << what;
    cut_short(now, out);
    expect_clean(now, out, what);
  }
  ASSERT_EQ(render(now, root_ / "pictures").code, 0);
  expect_clean(now + " --format svg", root_ / "pictures", "from png to svg");
}

TEST_F(OlderFolder, RangesOfOneRunAddUpToTheWhole) {
  const std::string now = write_scenario("now", "1", "Nine ghosts.");
  const fs::path out = root_ / "out", clean = root_ / "whole";
  ASSERT_EQ(render(now, clean).code, 0);
  for (const std::string range : {"4-6", "0-3", "7-"})
    ASSERT_EQ(render(now + " --frames " + range, out).code, 0);
  EXPECT_TRUE(files_in(out / "ghosts") == files_in(clean / "ghosts"));
}

TEST_F(OlderFolder, RangesThatCoverAllFramesWriteTheAtlas) {
  const fs::path out = root_ / "out", clean = root_ / "whole";
  const std::string atlas = scenario("kdtree_atlas");
  ASSERT_EQ(render(atlas, clean).code, 0);
  ASSERT_EQ(render(atlas + " --frames 0-9", out).code, 0);
  EXPECT_FALSE(fs::exists(out / "kdtree_atlas" / "kdtree_atlas_atlas.png"));
  ASSERT_EQ(render(atlas + " --frames 10-", out).code, 0);
  EXPECT_TRUE(files_in(out / "kdtree_atlas") == files_in(clean / "kdtree_atlas"));
}

TEST_F(OlderFolder, AnAtlasThatWasLostIsWrittenAgain) {
  const fs::path out = root_ / "out";
  const std::string atlas = scenario("kdtree_atlas");
  ASSERT_EQ(render(atlas, out).code, 0);
  const Files whole = files_in(out / "kdtree_atlas");
  for (const std::string ending : {"png", "json"})
    fs::remove(out / "kdtree_atlas" / ("kdtree_atlas_atlas." + ending));
  ASSERT_EQ(render(atlas, out).code, 0);
  EXPECT_TRUE(files_in(out / "kdtree_atlas") == whole);
}

TEST_F(OlderFolder, APictureOfTheSameFramesInAnotherFormatStaysBesideARange) {
  const std::string now = write_scenario("now", "1", "Nine ghosts.");
  const fs::path out = root_ / "out";
  ASSERT_EQ(render(now, out).code, 0);
  const std::size_t before = files_in(out / "ghosts").size();
  ASSERT_EQ(render(now + " --frames 2 --format svg", out).code, 0);
  EXPECT_EQ(files_in(out / "ghosts").size(), before + 1);
}

TEST_F(OlderFolder, ADamagedFrameIsDrawnAgain) {
  const std::string now = write_scenario("now", "1", "Nine ghosts.");
  const fs::path out = root_ / "out";
  ASSERT_EQ(render(now, out).code, 0);
  for (const std::string file : {"ghosts_0001.png", "ghosts_0002.json", "manifest.json"}) {
    std::string bytes = read_text(out / "ghosts" / file);
    bytes.resize(bytes.size() / 2);
    write_text(out / "ghosts" / file, bytes);
    expect_clean(now, out, file);
  }
}

TEST_F(OlderFolder, AnotherBuildsFramesDoNotStand) {
  const std::string now = write_scenario("now", "1", "Nine ghosts.");
  const fs::path out = root_ / "out", manifest = out / "ghosts" / "manifest.json";
  ASSERT_EQ(render(now, out).code, 0);
  EXPECT_NE(render(now, out).err.find("13 of them there already"), std::string::npos);
  std::string text = read_text(manifest);
  text.replace(text.find("\"sources\": \"") + 12, 4, "xxxx");
  write_text(manifest, text);
  const Outcome o = render(now, out);
  EXPECT_EQ(o.code, 0);
  EXPECT_EQ(o.err.find("there already"), std::string::npos) << o.err;
}

// A manifest is input like any other.
TEST_F(OlderFolder, AManifestOfNonsenseDoesNoHarm) {
  const std::string now = write_scenario("now", "1", "Nine ghosts.");
  const fs::path out = root_ / "out";
  for (const std::string& text : std::vector<std::string>{
           std::string("{\"sources\": 7, \"frames\": [{\"frame\": 4294967295}]}"),
           std::string("[[[["), std::string(100'000, '['), std::string("\xff\xfe")}) {
    ASSERT_EQ(render(now, out).code, 0);
    write_text(out / "ghosts" / "manifest.json", text);
    expect_clean(now, out, text.substr(0, 40));
  }
}

TEST_F(OlderFolder, OnlyWhatLanternMadeIsRemovedAndItIsNamed) {
  const std::string now = write_scenario("now", "1", "Nine ghosts.");
  const std::string old = write_scenario("old", "2", "Old ghosts.");
  const fs::path out = root_ / "out", folder = out / "ghosts";
  ASSERT_EQ(render(old + " --pace event", out).code, 0);
  const std::string frame = read_text(folder / "ghosts_0020.png");
  write_text(folder / "notes.txt", "mine");
  write_text(folder / "ghosts_0020_copy.png", frame);
  write_text(folder / "ghosts_0099.png", "no picture at all");
  write_text(folder / "ghosts_0021.png", frame + "changed");
  write_text(folder / "ghosts_0003.png", "in the way");
  fs::create_directory(folder / "ghosts_0098.png");
  const Outcome o = render(now, out);
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_NE(o.err.find("removed what an earlier run has left: ghosts_0000.json"), std::string::npos)
      << o.err;
  EXPECT_NE(o.err.find("left alone, since it is not as Lantern made it: ghosts_0021.png, "
                       "ghosts_0098.png, ghosts_0099.png\n"),
            std::string::npos)
      << o.err;
  EXPECT_NE(o.err.find("replaced, though it was not as Lantern made it: ghosts_0003.png\n"),
            std::string::npos)
      << o.err;
  EXPECT_EQ(read_text(folder / "notes.txt"), "mine");
  EXPECT_TRUE(read_text(folder / "ghosts_0020_copy.png") == frame);
  EXPECT_EQ(read_text(folder / "ghosts_0099.png"), "no picture at all");
  EXPECT_TRUE(read_text(folder / "ghosts_0021.png") == frame + "changed");
  EXPECT_FALSE(fs::exists(folder / "ghosts_0020.png"));
}

TEST_F(OlderFolder, NothingIsWrittenWhenNoFrameIsChosen) {
  const std::string now = write_scenario("now", "1", "Nine ghosts.");
  for (const std::string words : {"--frames 99", "--at nothing", "--at 99"}) {
    EXPECT_EQ(render(now + " " + words, root_ / "out").code, 2) << words;
    EXPECT_FALSE(fs::exists(root_ / "out" / "ghosts")) << words;
  }
}

TEST_F(OlderFolder, OneProcessAtATimeWritesIntoIt) {
  const std::string now = write_scenario("now", "1", "Nine ghosts.");
  const fs::path folder = root_ / "out" / "ghosts";
  fs::create_directories(folder);
  const Outcome o = shell("flock " + folder.string() + " " LANTERN_BINARY " render " + now +
                          " --size 160x90 -o " + (root_ / "out").string());
  EXPECT_EQ(o.code, 1);
  EXPECT_NE(o.err.find("another run is writing"), std::string::npos) << o.err;
  EXPECT_TRUE(files_in(folder).empty());
}

}  // namespace
}  // namespace lantern::app
