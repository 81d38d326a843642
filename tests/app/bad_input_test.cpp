// Bad input: the right exit code, a message that tells what to change, nothing half-written.
#include <gtest/gtest.h>
#include <unistd.h>

#include "app/process.hpp"
#include "base/random.hpp"

namespace lantern::app {
namespace {

namespace fs = std::filesystem;

// Checks and renders `text` as a scenario: both must end with `code` and say `words`.
void expect_refused(const std::string& text, int code, const std::string& words) {
  const fs::path folder = fresh_folder("bad-input");
  write_text(folder / "bad.toml", text);
  for (const std::string& command :
       {std::string("check "), "render -o " + (folder / "out").string() + " "}) {
    const Outcome o = shell("lantern " + command + (folder / "bad.toml").string());
    EXPECT_EQ(o.code, code) << command << text.substr(0, 400) << "\n" << o.err.substr(0, 2000);
    EXPECT_NE(o.err.find(words), std::string::npos) << "no '" << words << "' in\n"
                                                    << o.err.substr(0, 2000);
    EXPECT_FALSE(fs::exists(folder / "out" / "bad" / "bad_0000.png"));
  }
}

std::string ghosts_with(const std::string& from, const std::string& to) {
  std::string text = read_text(kGhosts);
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(BadInput, FilesThatAreNoScenario) {
  expect_refused("", 3, "bad.toml");
  expect_refused("title = \"x", 3, "bad.toml:1:");
  expect_refused(std::string("\x00\x01\xff\xfe\x7f"
                             "ELF",
                             8),
                 3, "bad.toml");
  expect_refused(read_text(kGhosts).substr(0, 700), 3, "bad.toml:");
  expect_refused("x = " + std::string(100'000, '['), 3, "bad.toml");
}

TEST(BadInput, FilesThatCannotBeRead) {
  EXPECT_EQ(shell("lantern check no/such/file.toml").code, 1);
  EXPECT_EQ(shell("lantern render no/such/file.toml").code, 1);
  EXPECT_EQ(shell("lantern check /").code, 2) << "a folder without scenarios";
  EXPECT_EQ(shell("lantern check /dev/zero").code, 1) << "a device never ends";
  EXPECT_EQ(shell("lantern explain no/such/file.toml").code, 1);
}

TEST(BadInput, AHugeFileIsRefusedUnread) {
  const fs::path folder = fresh_folder("huge");
  const fs::path file = folder / "huge.toml";
  write_text(file, "");
  ASSERT_EQ(::truncate(file.c_str(), 100'000'000), 0);
  const Outcome o = shell("lantern check " + file.string());
  EXPECT_EQ(o.code, 3);
  EXPECT_NE(o.err.find("100000000"), std::string::npos) << o.err;
}

TEST(BadInput, ValuesThatMakeNoSense) {
  expect_refused(ghosts_with("capacity = 2", "capcity = 2"), 3, "did you mean 'capacity'?");
  expect_refused(ghosts_with("capacity = 2", "capacity = \"two\""), 3, "capacity");
  expect_refused(ghosts_with("max_depth = 4", "max_depth = 1000"), 3, "max_depth");
  expect_refused(ghosts_with("max_depth = 4", "max_depth = -1"), 3, "max_depth");
  expect_refused(ghosts_with("name = \"pink\"", "name = \"red\""), 3, "red");
  expect_refused(ghosts_with("bodies = [\"player\"]", "bodies = [\"plaver\"]"), 3,
                 "did you mean 'player'?");
  for (const char* size : {"[-4, 4]", "[0, 0]", "[nan, 4]", "[inf, 4]", "[4]", "[4, 4, 4]", "4"})
    expect_refused(ghosts_with("half_size = [4, 4]", std::string("half_size = ") + size), 3,
                   "half_size");
  for (const char* position : {"[nan, 0]", "[0, inf]", "[1e400, 0]"})
    expect_refused(ghosts_with("position = [24, 55]", std::string("position = ") + position), 3,
                   "bad.toml:");
}

TEST(BadInput, DepthLimitZeroIsLegal) {
  const fs::path folder = fresh_folder("depth-zero");
  write_text(folder / "zero.toml", R"(
title = "No splits at all"
[world]
size = [10, 10]
[structure]
kind = "quadtree"
capacity = 1
max_depth = 0
[[pattern]]
name = "dot"
count = 5
radius = 0.1
[[step]]
do = "insert"
bodies = ["dot"]
expect = { nodes = 1, depth = 0, pairs = 10 }
)");
  EXPECT_EQ(shell("lantern check " + (folder / "zero.toml").string()).code, 0);
}

std::string many_bodies(std::size_t count, const std::string& structure) {
  return "title = \"Many\"\n[world]\nsize = [100, 100]\n[structure]\n" + structure +
         "\n[[pattern]]\nname = \"dot\"\ncount = " + std::to_string(count) +
         "\nradius = 40\nmin = [50, 50]\nmax = [50, 50]\n[[step]]\ndo = \"insert\"\n"
         "bodies = [\"dot\"]\n";
}

TEST(BadInput, TooMuchIsRefusedByAStatedBudget) {
  expect_refused(many_bodies(1'000'000, "kind = \"quadtree\""), 3, "20000");
  expect_refused(many_bodies(15'000, "kind = \"quadtree\"\nno_progress_stop = true"), 3, "limit");
  expect_refused(many_bodies(15'000, "kind = \"quadtree\"\nmax_depth = 32"), 3, "raise capacity");
  expect_refused(many_bodies(15'000, "kind = \"brute_force\""), 3, "limit");
}

TEST(BadInput, ScenarioNamesCannotLeaveTheOutputFolder) {
  for (const char* name : {"../evil", "a/b", "..", "", ".", "/tmp/evil", "a b"})
    expect_refused("name = \"" + std::string(name) + "\"\n" + read_text(kGhosts), 3, "name");
}

TEST(BadInput, OutputThatCannotBeWritten) {
  const fs::path folder = fresh_folder("unwritable");
  write_text(folder / "file", "keep me");
  const std::string render = "lantern render " + kGhosts + " --size 320x180 ";
  const Outcome o = shell(render + "-o " + (folder / "file").string());
  EXPECT_EQ(o.code, 1);
  EXPECT_NE(o.err.find("file"), std::string::npos) << o.err;
  EXPECT_EQ(read_text(folder / "file"), "keep me");
  EXPECT_EQ(shell(render + "-o /proc/nowhere").code, 1);
  EXPECT_EQ(shell(render + "--frames 0 -o - >/dev/full").code, 1) << "a full disk";
  EXPECT_EQ(shell("lantern list >/dev/full").code, 1);
}

TEST(BadInput, AFileSizeLimitActsLikeAFullDisk) {
  const fs::path folder = fresh_folder("full-disk");
  const Outcome o = shell("trap '' XFSZ; ulimit -f 4; lantern render " + kGhosts +
                          " --size 1600x900 -o " + folder.string());
  EXPECT_EQ(o.code, 1) << o.err;
  if (fs::exists(folder / "ghost_quadtree")) {
    for (const auto& entry : fs::directory_iterator(folder / "ghost_quadtree"))
      EXPECT_EQ(entry.path().filename().string().find(".lantern-part"), std::string::npos)
          << "a part of a file was left behind";
  }
}

TEST(BadInput, SymbolicLinks) {
  const fs::path folder = fresh_folder("links");
  fs::create_directories(folder / "real");
  fs::create_directory_symlink(folder / "real", folder / "link");
  const std::string render = "lantern render " + kGhosts + " --size 320x180 --frames 0 -o ";
  EXPECT_EQ(shell(render + (folder / "link").string()).code, 0);
  EXPECT_TRUE(fs::exists(folder / "real" / "ghost_quadtree" / "ghost_quadtree_0000.png"))
      << "a folder behind a link is a folder";
  // A link where a frame goes is replaced; what it points to is left alone.
  write_text(folder / "precious", "keep me");
  const fs::path frame = folder / "real" / "ghost_quadtree" / "ghost_quadtree_0000.png";
  fs::remove(frame);
  fs::create_symlink(folder / "precious", frame);
  EXPECT_EQ(shell(render + (folder / "real").string()).code, 0);
  EXPECT_EQ(read_text(folder / "precious"), "keep me");
  EXPECT_FALSE(fs::is_symlink(frame));
}

TEST(BadInput, WithoutABackendTheExitCodeTellsSo) {
  const fs::path folder = fresh_folder("no-backend");
  // A library of this name that is no library stands before the real one in the search path.
  for (const char* name :
       {"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so", "libEGL.so.1", "libEGL.so"})
    write_text(folder / name, "not a library");
  const std::string path = "export LD_LIBRARY_PATH=" + folder.string() + "; ";
  const Outcome o = shell(path + "lantern render " + kGhosts + " -o " + folder.string());
  EXPECT_EQ(o.code, 4) << o.err;
  EXPECT_NE(o.err.find("libosmesa6"), std::string::npos) << "what to install: " << o.err;
  EXPECT_EQ(shell(path + "lantern doctor").code, 4);
  EXPECT_EQ(shell(path + "lantern render --format svg " + kGhosts + " -o " + folder.string()).code,
            0)
      << "SVG needs none";
}

// Whatever bytes stand in the file, the program ends by itself with 0, 1 or 3.
TEST(BadInput, MutatedScenariosNeverCrash) {
  const fs::path folder = fresh_folder("mutated");
  const std::string good = read_text(kGhosts);
  Random random(20);
  for (int round = 0; round < 40; ++round) {
    std::string text = good;
    for (int i = 0; i < 6; ++i) {
      const auto at =
          static_cast<std::size_t>(random.whole(0, static_cast<std::int64_t>(text.size()) - 1));
      if (random.unit() < 0.5)
        text[at] = static_cast<char>(random.whole(32, 126));
      else
        text.erase(at, static_cast<std::size_t>(random.whole(1, 20)));
    }
    write_text(folder / "mutated.toml", text);
    const Outcome o = shell("lantern check " + (folder / "mutated.toml").string());
    EXPECT_TRUE(o.code == 0 || o.code == 1 || o.code == 3) << o.code << "\n" << o.err << text;
  }
}

}  // namespace
}  // namespace lantern::app
