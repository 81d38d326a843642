// The lab is a guest: Lantern is built and works without it, and says what would build it.
#include <algorithm>
#include <regex>
#include <set>

#include <gtest/gtest.h>

#include "app/process.hpp"

namespace lantern::app {
namespace {

namespace fs = std::filesystem;

// What ninja would make a target of, as paths.
std::set<std::string> inputs_of(const std::string& target) {
  const Outcome o = shell("ninja -C " LANTERN_BUILD " -t inputs " + target);
  EXPECT_EQ(o.code, 0) << o.err;
  std::set<std::string> inputs;
  for (std::size_t from = 0, to; (to = o.out.find('\n', from)) != std::string::npos; from = to + 1)
    inputs.insert(o.out.substr(from, to - from));
  return inputs;
}

std::size_t count_of(const std::set<std::string>& inputs, const char* pattern) {
  const std::regex found(pattern);
  return static_cast<std::size_t>(std::ranges::count_if(
      inputs, [&](const std::string& one) { return std::regex_search(one, found); }));
}

TEST(Lab, IsNothingThatTheProgramIsMadeOf) {
  if (!fs::exists(LANTERN_BUILD "/build.ninja")) GTEST_SKIP() << "not built by ninja";
  constexpr const char* kLab = "/src/(lab|measure|report|peers)/|lantern_(lab|measure|report|peer)";
  const auto program = inputs_of("lantern");
  EXPECT_GT(count_of(program, "/src/app/"), 30u);
  for (const std::string& one : program)
    EXPECT_EQ(count_of({one}, kLab), 0u) << one << " is built for ./run demo";
  EXPECT_GT(count_of(inputs_of("lantern_lab.so"), kLab), 50u) << "is the pattern wrong?";
}

// A program alone in its folder, run by `words`.
class WithoutLab : public testing::Test {
 protected:
  WithoutLab() { fs::create_hard_link(LANTERN_BINARY, folder_ / "lantern"); }
  Outcome alone(const std::string& words) const {
    return shell("cd " + folder_.string() + "; ./lantern " + words);
  }
  fs::path folder_ = fresh_folder("without_lab");
};

TEST_F(WithoutLab, ItsCommandsSayWhatBuildsIt) {
  for (const char* words : {"measure", "measure kepler --quick", "bench pairs --only x",
                            "bench frames x.toml --rounds 1", "stress --list"}) {
    const Outcome o = alone(words);
    EXPECT_EQ(o.code, 2) << words;
    EXPECT_NE(o.err.find("the lab is not beside this program; './run lab'"), std::string::npos)
        << words << ": " << o.err;
    EXPECT_EQ(std::ranges::count(o.err, '\n'), 1) << o.err;
  }
  EXPECT_NE(alone("measure --json").out.find("\"exit_code\": 2"), std::string::npos);
}

TEST_F(WithoutLab, HelpNamesItsCommandsAndAllElseWorks) {
  const std::string help = alone("--help").out;
  for (const char* command : {"measure ", "bench ", "stress "})
    EXPECT_NE(help.find(command), std::string::npos) << help;
  EXPECT_NE(alone("measure --help").out.find("./run lab"), std::string::npos);
  EXPECT_NE(alone("man stress").out.find("limits of stability"), std::string::npos);
  EXPECT_NE(alone("completions fish").out.find("measure"), std::string::npos);
  EXPECT_NE(alone("doctor").out.find("./run lab"), std::string::npos);
  EXPECT_EQ(alone("structure bench quadtree --bodies 20 --rounds 1").code, 0);
  EXPECT_EQ(alone("structure check quadtree --worlds 5").code, 0);
  EXPECT_EQ(alone("check " + repository("scenarios/problems/kepler.toml").string()).code, 0);
}

TEST_F(WithoutLab, OneOfAnotherLanternIsNotTaken) {
  fs::create_symlink(LANTERN_FAKES "/of_another/lantern_lab.so", folder_ / "lantern_lab.so");
  const Outcome o = alone("stress --list");
  EXPECT_EQ(o.code, 2);
  EXPECT_NE(o.err.find("is of another Lantern; './run lab'"), std::string::npos) << o.err;
}

}  // namespace
}  // namespace lantern::app
