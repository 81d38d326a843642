// Every command of the README, and of the pages that it leads to, works as it is written there.
#include <algorithm>
#include <cstdlib>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/process.hpp"
#include "render/png.hpp"
#include "rooms.hpp"

namespace lantern::app {
namespace {

namespace fs = std::filesystem;

// The texts between ```<language> and ```.
std::vector<std::string> blocks(const std::string& page, const std::string& language) {
  std::vector<std::string> found;
  const std::string fence = "```" + language + "\n";
  for (std::size_t at = page.find(fence); at != std::string::npos; at = page.find(fence, at)) {
    at += fence.size();
    found.push_back(page.substr(at, page.find("```", at) - at));
  }
  return found;
}

// `./run demo` draws with the release build whoever asks, and what is measured under sanitizers
// says nothing, and sanitized libraries are large to install: their tests need not. The measurement
// of everything takes a minute, every frame of the demo half of one, and two more of the lab some
// ten seconds each: these are run where LANTERN_ALL is set, as tests/deep/readme.sh does.
#ifdef __SANITIZE_ADDRESS__
constexpr bool kRunsAll = false;
#else
constexpr bool kRunsAll = true;
#endif
bool is_left_out(const std::string& line) {
  const bool is_for_deep = line == "./run demo" || line == "build/lantern measure --quick" ||
                           line.starts_with("build/lantern measure scenarios/spring_rope.toml") ||
                           line == "build/lantern stress --map -o output/stress";
  if (is_for_deep && std::getenv("LANTERN_ALL") == nullptr) return true;
  const bool is_live = line.find("--live") != line.npos || line.find("playground") != line.npos;
  if (is_live && !fs::exists(fs::path(LANTERN_BINARY).parent_path() / "lantern.wasm")) return true;
  const bool is_long = line == "./run demo" || line.find("lantern measure") != std::string::npos ||
                       line.find("lantern bench") != std::string::npos ||
                       line.find("lantern stress") != std::string::npos ||
                       line.find("install") != std::string::npos ||
                       line.find("build/example") != std::string::npos;
  return !kRunsAll && is_long;
}

// A folder that looks like the repository after a build.
fs::path look_alike() {
  const fs::path folder = fresh_folder("readme");
  fs::create_directories(folder / "build");
  fs::create_symlink(LANTERN_BINARY, folder / "build" / "lantern");
  fs::create_symlink(fs::path(LANTERN_BINARY).parent_path() / "cmake_install.cmake",
                     folder / "build" / "cmake_install.cmake");
  for (const char* name : {"scenarios", "tests"})
    fs::create_directory_symlink(repository(name), folder / name);
  return folder;
}

TEST(Readme, CommandsWork) {
  const fs::path folder = look_alike();
  const auto examples = blocks(read_text(repository("README.md")), "toml");
  ASSERT_EQ(examples.size(), 1u) << "the first scenario";
  write_text(folder / "first.toml", examples[0]);
  std::vector<std::string> all;
  for (const std::string& page : pages())  // the others use the scenario that the README writes
    for (std::string& block : blocks(read_text(repository(page)), "sh"))
      all.push_back(std::move(block));
  std::set<std::string> commands;  // the pages repeat some
  for (const std::string& block : all) {
    std::istringstream lines(block);
    for (std::string line; std::getline(lines, line);) {
      if (line.empty() || line == "./run test" || line == "./run lab" || line == "./run web")
        continue;  // it is built
      if (!commands.insert(line).second || is_left_out(line)) continue;
      // The demo must not build under this test's feet: it is run with the program as built.
      const std::string here = line == "./run demo" ? repository("").string() : folder.string();
      const Outcome o = shell("cd " + here + " && " + line);
      EXPECT_EQ(o.code, 0) << line << "\n" << o.out << o.err;
    }
  }
  EXPECT_GE(commands.size(), 30u);
  EXPECT_TRUE(fs::exists(folder / "output" / "first" / "first_0001.png"));
  if (!kRunsAll) return;
  if (std::getenv("LANTERN_ALL") != nullptr) {
    EXPECT_TRUE(fs::exists(repository("output/ghost_quadtree/ghost_quadtree_0002.png")));
  }
  for (const char* picture : {"measure/overview.png", "stress/stability_map.png"})
    EXPECT_EQ(fs::exists(folder / "output" / picture), std::getenv("LANTERN_ALL") != nullptr);
}

TEST(Readme, IsReadInOneSitting) {
  const std::string page = read_text(repository("README.md"));
  EXPECT_LE(std::count(page.begin(), page.end(), '\n'), 150);
}

TEST(Readme, ThePictureIsLanternsOwn) {
  const Outcome o = shell("lantern render -o - --at four --size 1600x900 --png small " +
                          scenario("ghost_quadtree"));
  const auto shown = decode_png(read_text(repository("scenarios/ghost_quadtree.png")));
  const auto drawn = decode_png(o.out);
  ASSERT_TRUE(shown && drawn);
  EXPECT_EQ(*shown, *drawn) << "draw it anew: ./run golden";
}

// A row a scenario, in the order of the lecture.
TEST(Readme, ListsTheScenariosAsLanternDoes) {
  const std::string page = read_text(repository("scenarios/README.md"));
  std::string table = "|---|---|---|---|---|\n";
  std::set<std::string> before;
  const Outcome listed = shell("lantern list --json " + repository("scenarios").string());
  const auto list = nlohmann::json::parse(listed.out);
  for (const auto& s : list["scenarios"]) {
    std::string needs;
    for (const std::string need : s["needs"]) {
      EXPECT_TRUE(before.contains(need)) << s["name"] << " needs " << need << ", which is later";
      needs += (needs.empty() ? "`" : " · `") + need + "`";
    }
    std::string asked;
    for (const std::string question : s["questions"])
      asked += (asked.empty() ? "" : " ") + question;
    EXPECT_FALSE(asked.empty()) << s["name"] << " asks nothing of the students";
    ASSERT_TRUE(s["lecture"].is_number()) << s["name"];
    EXPECT_EQ(s["lecture"], before.size() + 1) << s["name"];
    table += "| " + s["lecture"].dump() + " | `" + s["name"].get<std::string>() + "` | " +
             s["idea"].get<std::string>() + " | " + needs + " | " + asked + " |\n";
    before.insert(s["name"]);
  }
  EXPECT_NE(page.find(table), std::string::npos) << "write it anew:\n" << table;
}

TEST(Readme, TheCourseIsWhatListPrints) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "it runs every scenario: the release build's";
#endif
  const Outcome o = shell("lantern list --course " + repository("scenarios").string());
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(o.out, read_text(repository("scenarios/COURSE.md"))) << "print it anew: ./run golden";
}

// What `./run demo` does when all is built, with the first frame of each: that the others are drawn
// is what Golden.FramesAreAsExpected holds.
TEST(Readme, TheDemoDrawsEveryScenario) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "it is the release build's";
#endif
  const std::string command = "build/lantern render scenarios/*.toml -o output";
  EXPECT_NE(read_text(repository("run")).find("    " + command + "\n"), std::string::npos);
  const fs::path folder = look_alike();
  const Outcome o = shell("cd " + folder.string() + " && " + command + " --frames 1");
  EXPECT_EQ(o.code, 0) << o.out << o.err;
  for (const auto& file : fs::directory_iterator(repository("scenarios")))
    if (file.path().extension() == ".toml") {
      EXPECT_TRUE(fs::is_directory(folder / "output" / file.path().stem())) << file.path();
    }
}

TEST(Readme, RunTellsWhatItDoes) {
  const std::string run = repository("run").string();
  EXPECT_EQ(shell(run + " help").code, 0);
  EXPECT_EQ(shell(run).code, 2);
  EXPECT_EQ(shell(run + " nonsense").code, 2);
  EXPECT_NE(shell(run + " help").out.find("./run demo"), std::string::npos);
}

}  // namespace
}  // namespace lantern::app
