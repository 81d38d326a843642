// Worlds drawn at random: none makes energy, none lets anything out, none takes for ever.
#include <string>

#include <gtest/gtest.h>

#include "how_many.hpp"
#include "wild_world.hpp"

namespace lantern::physics {
namespace {

constexpr std::uint64_t kWildSeed = 7;

// What is refused is told, and no more than one in a hundred.
template <int D>
void expect_tame(ContactMethod method, int usual) {
  const int count = how_many("LANTERN_WILD_WORLDS", usual);
  int refused = 0;
  for (int number = 0; number < count; ++number) {
    const WildReport report =
        WildWorld<D>(kWildSeed, static_cast<std::uint64_t>(number), method).run();
    refused += report.what == "refused";
    if (report.what.empty() || report.what == "refused") continue;
    ADD_FAILURE() << "seed " << kWildSeed << ", world " << number << ", after step " << report.step
                  << ": " << report.what << " by " << report.by << ": " << report.world;
  }
  EXPECT_LE(refused * 100, std::max(count, 100));
}

class EachMethod : public testing::TestWithParam<ContactMethod> {};

TEST_P(EachMethod, AreTameInThePlane) { expect_tame<2>(GetParam(), 140); }
TEST_P(EachMethod, AreTameInSpace) { expect_tame<3>(GetParam(), 60); }

INSTANTIATE_TEST_SUITE_P(WildWorlds, EachMethod,
                         testing::Values(ContactMethod::none, ContactMethod::impulse,
                                         ContactMethod::soft, ContactMethod::direct,
                                         ContactMethod::lecture),
                         [](const auto& of) { return std::string(to_string(of.param)); });

// A needle of 3e-4 units that drag brakes, at 200 units a second onto a wall of 5e-3: it went
// through. An elastic blow through a stack, at two points of which one had parted: it made 2e-2 of
// the energy.
TEST(WildWorlds, AreTameWhereTheyWereNot) {
  EXPECT_EQ((WildWorld<3>(kWildSeed, 1248, ContactMethod::direct).run().what), "");
  EXPECT_EQ((WildWorld<2>(kWildSeed, 1034, ContactMethod::soft).run().what), "");
}

}  // namespace
}  // namespace lantern::physics
