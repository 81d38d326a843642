// What it costs to insert bodies one after another, with somebody watching, grows as their number
// does. Counted, not timed.
#include <gtest/gtest.h>

#include "counted_memory.hpp"
#include "instructions.hpp"
#include "spatial/broad_phase.hpp"

namespace lantern::spatial {
namespace {

struct InsertionCost {
  double events = 0, box_tests = 0;
  double calls = 0, bytes = 0;  // for memory
  double instructions = 0;
};

// Of so many boxes as large as each other, each with as many neighbours however many there are, in
// an order that leaps from place to place.
template <int D>
InsertionCost cost_of(StructureKind kind, std::uint32_t bodies) {
  const auto side = static_cast<std::uint32_t>(std::ceil(std::pow(bodies, 1.0 / D)));
  BroadPhaseConfig<D> config;
  config.kind = kind;
  config.capacity = 8;
  config.max_depth = 12;
  config.in_proportion = false;
  config.bounds = {Vec<D>(0.0), Vec<D>(side * 2.0)};
  BroadPhase<D> broad(config);
  std::vector<Proxy<D>> proxies;
  for (BodyId id = 0; id < bodies; ++id) {
    std::uint32_t place = static_cast<std::uint32_t>(std::uint64_t{id} * 7919 % bodies);
    Vec<D> at{0.0};
    for (int i = 0; i < D; ++i, place /= side) at[i] = 2 * (place % side) + 1;
    proxies.push_back({id, Box<D>::around(at, Vec<D>(0.7))});
  }
  InsertionCost cost;
  Instructions instructions;
  const std::uint64_t calls = counted_memory::calls, bytes = counted_memory::bytes;
  const auto insert = [&] {
    for (const Proxy<D>& proxy : proxies) broad.insert(proxy, [&](const Event&) { ++cost.events; });
  };
  if (instructions.are_counted())
    cost.instructions = static_cast<double>(instructions.of(insert));
  else
    insert();
  cost.calls = static_cast<double>(counted_memory::calls - calls);
  cost.bytes = static_cast<double>(counted_memory::bytes - bytes);
  cost.box_tests = static_cast<double>(broad.dynamic().structure->work().box_tests);
  return cost;
}

template <int D>
void expect_linear(StructureKind kind) {
  SCOPED_TRACE(std::string(to_string(kind)) + (D == 2 ? " in 2D" : " in 3D"));
  // A tree is a level deeper at four or eight times as many, all leaves at once.
  constexpr std::uint32_t kFew = 4096, kTimes = 1 << D;
  const InsertionCost n = cost_of<D>(kind, kFew), more = cost_of<D>(kind, kTimes * kFew);
  for (const auto counted :
       {&InsertionCost::events, &InsertionCost::box_tests, &InsertionCost::calls,
        &InsertionCost::bytes, &InsertionCost::instructions})
    EXPECT_LE(more.*counted, 1.6 * kTimes * n.*counted + 1000);
}

TEST(InsertionCost, GrowsAsTheBodiesDo) {
  for (const StructureKind kind : kStructureKinds) {
    if (traits_of(kind).is_fitted || traits_of(kind).has(Setting::planes)) continue;
    if (is_possible(kind, 2)) expect_linear<2>(kind);
    // Seen from above there would be more bodies in a place, the more there are.
    if (!traits_of(kind).ignores_height) expect_linear<3>(kind);
  }
  expect_linear<2>(StructureKind::automatic);
}

}  // namespace
}  // namespace lantern::spatial
