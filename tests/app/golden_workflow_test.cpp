// The files that a student copies, in a fresh repository of hers: tests/example/golden-workflow.yml
// and tests/example/pre-commit.
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "app/process.hpp"

namespace lantern::app {
namespace {

namespace fs = std::filesystem;

const std::string kDisc = R"(title = "A disc"
[world]
size = [16, 9]
[[body]]
name = "ann"
radius = 0.8
position = [3, 6]
[[step]]
do = "insert"
name = "one"
bodies = ["ann"]
)";

// A repository with one scenario and its golden frames, committed.
class GoldenRepository : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fresh_folder(testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder_ / "scenarios");
    fs::create_directories(folder_ / "bin");
    fs::create_symlink(LANTERN_BINARY, folder_ / "bin/lantern");
    write_text(folder_ / "scenarios/disc.toml", kDisc);
    const Outcome o =
        in("git init -q . && echo /bin/ >.gitignore && lantern golden "
           "scenarios/*.toml --update && git add . && git commit -q -m First");
    ASSERT_EQ(o.code, 0) << o.err;
  }

  // As a user of that repository, who has Lantern installed and no settings of Git.
  Outcome in(const std::string& commands) const {
    return shell("unset -f lantern; unset GIT_DIR GIT_INDEX_FILE; cd " + folder_.string() +
                 "; PATH=$PWD/bin:$PATH HOME=$PWD GIT_CONFIG_NOSYSTEM=1 GIT_AUTHOR_NAME=a "
                 "GIT_AUTHOR_EMAIL=a@b GIT_COMMITTER_NAME=a GIT_COMMITTER_EMAIL=a@b "
                 "GIT_CEILING_DIRECTORIES=$PWD/..; export PATH HOME GIT_CONFIG_NOSYSTEM "
                 "GIT_AUTHOR_NAME GIT_AUTHOR_EMAIL GIT_COMMITTER_NAME GIT_COMMITTER_EMAIL "
                 "GIT_CEILING_DIRECTORIES; " +
                 commands);
  }

  void change() const {
    std::string text = kDisc;
    write_text(folder_ / "scenarios/disc.toml", text.replace(text.find("[3, 6]"), 6, "[9, 3]"));
  }

  fs::path folder_;
};

// The commands of a workflow's steps, but for those that install.
std::vector<std::string> commands_of(const std::string& workflow) {
  std::vector<std::string> found;
  std::string step, line;
  for (std::istringstream lines(workflow); std::getline(lines, line);) {
    if (const auto at = line.find("- name: "); at != line.npos) step = line.substr(at + 8);
    const auto run = line.find("run: ");
    if (run == line.npos || line.find_first_not_of(' ') != run) continue;
    if (step.starts_with("Get ") || step.starts_with("Build ")) continue;
    found.push_back(line.substr(run + 5));
  }
  return found;
}

TEST_F(GoldenRepository, TheWorkflowPassesUntilAFrameDiffers) {
  const auto commands = commands_of(read_text(repository("tests/example/golden-workflow.yml")));
  ASSERT_EQ(commands.size(), 2u);
  const std::string texts = "mkdir scenarios/de && echo [texts] >scenarios/de/disc.toml && ";
  const Outcome good = in(texts + commands[0] + " && " + commands[1]);
  EXPECT_EQ(good.code, 0) << good.err << good.out;
  const Outcome below = in("mkdir -p scenarios/more && echo wrong >scenarios/more/b.toml && " +
                           commands[0] + "; code=$?; rm -r scenarios/more; exit $code");
  EXPECT_EQ(below.code, 1) << below.err << "folders below are looked into";
  const Outcome left = in("cp -r golden/disc golden/gone && " + commands[1]);
  EXPECT_EQ(left.code, 1);
  EXPECT_NE(left.out.find("no scenario has golden/gone"), std::string::npos) << left.out;
  change();
  const Outcome bad = in(commands[0]);
  EXPECT_EQ(bad.code, 1) << bad.err;
  for (const char* kept : {"golden.html", "golden.xml"})
    EXPECT_TRUE(fs::exists(folder_ / kept)) << kept;
}

TEST_F(GoldenRepository, TheHookRefusesACommitWithoutItsGoldenFrames) {
  const std::string hook = repository("tests/example/pre-commit").string();
  ASSERT_EQ(in("cp " + hook + " .git/hooks/ && chmod +x .git/hooks/pre-commit").code, 0);
  EXPECT_EQ(in("echo text >notes && git add notes && git commit -q -m Notes").code, 0);
  change();
  const Outcome refused = in("git add scenarios && git commit -q -m Second");
  EXPECT_NE(refused.code, 0);
  EXPECT_NE(refused.err.find("disc: 1 of 1 frame differs"), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find("--update && git add golden"), std::string::npos) << refused.err;
  EXPECT_TRUE(fs::exists(folder_ / ".git/golden.html"));
  const std::string update = "lantern golden scenarios/disc.toml --update && ";
  EXPECT_NE(in(update + "git commit -q -m Second").code, 0) << "they are made, but not added";
  const Outcome taken = in("git add golden && git commit -q -m Second && git status --porcelain");
  EXPECT_EQ(taken.code, 0) << taken.err;
  EXPECT_EQ(taken.out, "");
  EXPECT_NE(in("git rm -q golden/disc/disc_0000.png && git commit -q -m Third").code, 0)
      << "a golden frame belongs to its scenario";
  ASSERT_EQ(in("git reset -q --hard").code, 0);
  const Outcome renamed =
      in("git mv scenarios/disc.toml scenarios/circle.toml && lantern golden "
         "scenarios/circle.toml --update && git add golden && git commit -q -m Third");
  EXPECT_NE(renamed.code, 0);
  EXPECT_NE(renamed.err.find("git rm -r golden/disc"), std::string::npos) << renamed.err;
  ASSERT_EQ(in("git reset -q --hard").code, 0);
  const Outcome left = in("git rm -q scenarios/disc.toml && git commit -q -m Third");
  EXPECT_NE(left.code, 0);
  EXPECT_NE(left.err.find("git rm -r golden/disc"), std::string::npos) << left.err;
  EXPECT_EQ(in("git rm -q -r golden/disc && git commit -q -m Third").code, 0);
  const Outcome below =
      in("mkdir -p scenarios/week2 && echo wrong >scenarios/week2/b.toml && "
         "git add scenarios && git commit -q -m Fourth");
  EXPECT_NE(below.code, 0) << "folders below are looked into";
}

}  // namespace
}  // namespace lantern::app
