// There is a count when its rule says so, and it is called as its row says.
#include "language/counts.hpp"

#include <string>

#include <gtest/gtest.h>

#include "base/words.hpp"
#include "scenario/directing.hpp"
#include "scenario/parsing.hpp"

namespace lantern::run {
namespace {

// Of the last frame of each step that has one.
void expect_as_ruled(const Scenario& scenario, const std::vector<Frame>& frames) {
  ScriptPast past(scenario, scenario.world.dimension);
  auto frame = frames.begin();
  for (std::size_t i = 0; i < scenario.steps.size(); ++i) {
    past.note(scenario.steps[i].verb);
    const auto is_of_step = [&] { return frame != frames.end() && frame->step == i; };
    if (!is_of_step()) continue;
    while (is_of_step()) ++frame;
    const Frame& last = *std::prev(frame);
    for (const auto docs : {known_counts(), known_measures()})
      for (const CountDoc& count : docs)
        EXPECT_EQ(last.number(std::string(count.name)).has_value(),
                  why_not_counted(count, past).empty())
            << count.name << " in step " << i + 1 << " of " << scenario.name;
    const auto is_of_one = [](const std::string& name, bool counted) {
      const CountDoc* row = find_in(known_body_measures(), name.substr(0, name.find('.')));
      return is_of_body(name) && row && is_counted(*row) == counted;
    };
    for (const auto& [name, n] : last.counts)
      EXPECT_TRUE(find_in(known_counts(), name) || is_of_one(name, true)) << name << " has no row";
    for (const auto& [name, n] : last.measures)
      EXPECT_TRUE(find_in(known_measures(), name) || is_of_one(name, false))
          << name << " has no row";
  }
}

void expect_as_ruled(const Scenario& scenario) {
  const std::vector<Frame> frames = frames_of(scenario);
  if (scenario.sides.empty()) return expect_as_ruled(scenario, frames);
  for (std::size_t side = 0; side < scenario.sides.size(); ++side) {
    std::vector<Frame> own;
    for (const Frame& frame : frames) own.push_back(frame.sides.at(side));
    expect_as_ruled(*scenario.sides[side], own);
  }
}

TEST(Counts, AreThereWhenTheirRulesSaySo) {
  for (const std::string& name : all_scenarios()) expect_as_ruled(shipped(name));
  for (const std::string& text : good_texts()) expect_as_ruled(good(text));
  for (const char* name : {"big_atlas", "galton"})
    expect_as_ruled(load_scenario(LANTERN_ROOT "/tests/cases/" + std::string(name) + ".toml"));
}

TEST(Counts, HaveNamesOfTheirOwn) {
  const std::size_t before = known_counts().size();
  for (const char* taken : {"pairs", "energy", "Pairs", ""}) {
    const CountDoc row{taken, when::bodies, "", "Taken, or no name."};
    EXPECT_THROW(add_counts(std::span(&row, 1)), Refused) << taken;
  }
  EXPECT_EQ(known_counts().size(), before);
}

TEST(Counts, HaveWordsForOneAndForMany) {
  const auto words = [](const char* name, bool one) {
    return noun(find_count(name)->forms(), one ? 1 : 2);
  };
  EXPECT_EQ(words("leaves", true), "leaf");
  EXPECT_EQ(words("leaves", false), "leaves");
  EXPECT_EQ(words("asleep", true), "asleep") << "one word for both";
  EXPECT_EQ(words("asleep", false), "asleep");
  EXPECT_EQ(words("narrow_tests", true), "narrow test") << "from its name";
  EXPECT_EQ(words("narrow_tests", false), "narrow tests");
}

}  // namespace
}  // namespace lantern::run
