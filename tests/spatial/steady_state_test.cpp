// No memory is asked for in the steady state: counted where memory is really asked for.
#include <gtest/gtest.h>

#include "base/random.hpp"
#include "counted_memory.hpp"
#include "spatial/broad_phase.hpp"
#include "spatial/planes.hpp"

namespace lantern::spatial {
namespace {

TEST(SteadyState, AnUpdateAsksForNoMemory) {
  Random random(9);
  for (std::size_t run = 0; run < 2 * kStructureKinds.size(); ++run) {
    const StructureKind kind = kStructureKinds[run / 2];
    BroadPhaseConfig<3> config;
    config.kind = kind;
    config.build = run % 2 == 0 ? Build::one_by_one : Build::at_once;
    config.bounds = testing::bounds_of<3>(testing::Sort::uniform);
    config.planes = testing::random_planes<3>(testing::Sort::uniform, 9, random);
    BroadPhase<3> phase(config);
    std::vector<Proxy<3>> proxies;
    for (BodyId id = 0; id < 300; ++id)
      proxies.push_back(
          {id, testing::random_box<3>(testing::Sort::uniform, random), id % 4 == 0, id % 7 != 0});
    const auto shake = [&](double by) {
      for (Proxy<3>& p : proxies)
        if (!p.is_static && p.awake) p.box = {p.box.lo + by, p.box.hi + by};
      phase.update(proxies);
    };
    for (const double by : {0.1, -0.1, 0.1, -0.1}) shake(by);
    const std::uint64_t before = counted_memory::calls, counted = phase.counters().allocations;
    EXPECT_GT(counted, 0u);
    for (int step = 0; step < 10; ++step) shake(step % 2 == 0 ? 0.1 : -0.1);
    const std::uint64_t asked = counted_memory::calls - before;
    EXPECT_EQ(asked == 0, !traits_of(kind).is_plain) << to_string(kind) << " asked for memory";
    EXPECT_EQ(phase.counters().allocations - counted, asked) << to_string(kind) << ": wrong count";
  }
}

}  // namespace
}  // namespace lantern::spatial
