// `kind = "auto"`: the scenario has a structure of a kind that can be shown, and says why.
#include <gtest/gtest.h>

#include "scenario/directing.hpp"
#include "scenario/parsing.hpp"

namespace lantern::run {
namespace {

Scenario with_auto(int bodies) {
  std::string text = "[structure]\nkind = \"auto\"\n";
  for (int i = 0; i < bodies; ++i)
    text += fmt::format("[[body]]\nname = \"b{}\"\nradius = 0.1\nposition = [{}, {}]\n", i,
                        1 + i % 20, 1 + i / 20);
  return good(
      world_text("size = [32, 32]", text + "[[step]]\ndo = \"insert\"\nbodies = [\"b0\"]\n"));
}

TEST(StructureAuto, IsAKindThatSuitsTheBodies) {
  const Scenario few = with_auto(3);
  EXPECT_EQ(few.structure.kind, StructureKind::brute_force);
  EXPECT_NE(few.structure.why.find("3 bodies"), std::string::npos) << few.structure.why;
  EXPECT_EQ(frames_of(few).back().structure, StructureKind::brute_force);
  const Scenario many = with_auto(600);
  EXPECT_EQ(many.structure.kind, StructureKind::grid);
  EXPECT_NE(many.structure.why.find("600 bodies"), std::string::npos) << many.structure.why;
}

}  // namespace
}  // namespace lantern::run
