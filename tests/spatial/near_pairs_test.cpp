// Pairs that are mended where little moves: the same as if they were looked for, however bodies
// move, and for less work.
#include <functional>

#include <gtest/gtest.h>

#include "spatial/worlds.hpp"

namespace lantern::spatial {
namespace {

// Bodies with gaps between their ids, each as near to another as to overlap now and then.
template <int D>
struct Swarm {
  Random random;
  double width;
  std::vector<Proxy<D>> boxes = {};
  std::vector<Vec<D>> ways = {};

  Swarm(std::size_t bodies, std::uint64_t seed, bool some_static)
      : random(seed), width(2 * std::pow(static_cast<double>(bodies), 1.0 / D)) {
    for (BodyId i = 0; i < bodies; ++i) {
      const Vec<D> half = random_point<D>(random, 0.25, 0.75);
      boxes.push_back({some_static ? 3 * i + 5 : i,
                       Box<D>::around(random_point<D>(random, 0, width), half),
                       some_static && i % 7 == 3, true});
      ways.push_back(random_point<D>(random, -0.2, 0.2));
    }
  }

  void move(std::size_t i, const Vec<D>& by) {
    if (!boxes[i].is_static && boxes[i].awake)
      boxes[i].box = {boxes[i].box.lo + by, boxes[i].box.hi + by};
  }
};

template <int D>
struct Motion {
  const char* name;
  std::function<void(Swarm<D>&, std::size_t body, int step)> move;
};

template <int D>
std::vector<Motion<D>> motions() {
  using C = Swarm<D>;
  return {
      {"rest", [](C&, std::size_t, int) {}},
      {"jitter", [](C& c, std::size_t i, int) { c.move(i, random_point<D>(c.random, -0.1, 0.1)); }},
      {"fly on", [](C& c, std::size_t i, int) { c.move(i, c.ways[i]); }},
      {"fly faster", [](C& c, std::size_t i, int) { c.move(i, c.ways[i] *= 1.1); }},
      {"turn back",
       [](C& c, std::size_t i, int s) { c.move(i, c.ways[i] * (s % 9 < 5 ? 1. : -1.)); }},
      {"some far", [](C& c, std::size_t i, int) { c.move(i, Vec<D>(i % 50 == 0 ? 3. : 0.001)); }},
      {"jump",
       [](C& c, std::size_t i, int) { c.move(i, random_point<D>(c.random, -c.width, c.width)); }},
      {"start late",
       [](C& c, std::size_t i, int s) { c.move(i, s < 20 ? Vec<D>(0.0) : c.ways[i]); }},
      {"far out", [](C& c, std::size_t i, int s) { c.move(i, Vec<D>(s == 9 ? 1e12 : 0.01)); }},
      {"beyond all",
       [](C& c, std::size_t i, int s) { c.move(i, Vec<D>(i % 9 == 0 && s == 9 ? 1e307 : 0.)); }},
      {"around one",
       [](C& c, std::size_t i, int) {
         const Vec<D> to = c.boxes[1].box.lo + random_point<D>(c.random, -1, 1);
         if (i % 30 == 0) c.move(i, to - c.boxes[i].box.lo);
       }},
      {"sleep and wake",
       [](C& c, std::size_t i, int s) {
         c.boxes[i].awake = s % 4 == 0 || c.random.unit() < 0.9;
         c.move(i, c.ways[i]);
       }},
  };
}

template <int D>
BroadPhaseConfig<D> automatic(bool mends, unsigned threads = 1) {
  BroadPhaseConfig<D> config;
  config.kind = StructureKind::automatic;
  config.build = Build::at_once;
  config.mends = mends;
  config.threads = threads;
  return config;
}

template <int D>
void follows_every_motion(bool some_static, unsigned threads) {
  for (const Motion<D>& motion : motions<D>()) {
    Swarm<D> swarm(150, 11, some_static);
    BroadPhase<D> phase(automatic<D>(true, threads));
    phase.tell(swarm.boxes);
    for (int step = 0; step < 60; ++step) {
      for (std::size_t i = 0; i < swarm.boxes.size(); ++i) motion.move(swarm, i, step);
      phase.follow(swarm.boxes);
      ASSERT_EQ(phase.pairs(), testing::true_pairs(swarm.boxes))
          << motion.name << ", step " << step;
    }
  }
}
TEST(NearPairs, AreTheSameHoweverBodiesMove) {
  for (const bool some_static : {false, true}) {
    follows_every_motion<2>(some_static, 1);
    follows_every_motion<3>(some_static, 1);
  }
  follows_every_motion<2>(true, 3);
}

// Whatever happens in between, in any order.
TEST(NearPairs, AreTheSameWhenBodiesComeGoAndAreLookedAt) {
  Random random(5);
  for (int run = 0; run < 8; ++run) {
    Swarm<2> swarm(120, 100 + static_cast<std::uint64_t>(run), run % 2 == 0);
    BroadPhase<2> phase(automatic<2>(true));
    phase.tell(swarm.boxes);
    for (int step = 0; step < 80; ++step) {
      for (std::size_t i = 0; i < swarm.boxes.size(); ++i)
        swarm.move(i, random_point<2>(random, -0.05, 0.05));
      switch (random.whole(0, 30)) {
        case 0:  // one goes
          swarm.boxes.erase(swarm.boxes.begin() + random.whole(0, 60));
          phase.tell(swarm.boxes);
          break;
        case 1:  // a static one is pushed among others
          for (Proxy<2>& box : swarm.boxes)
            if (box.is_static) box.box = swarm.boxes[static_cast<std::size_t>(step)].box;
          break;
        case 2:  // somebody looks
          phase.build(swarm.boxes);
          EXPECT_EQ(phase.dynamic().counters().entries > 0, true);
          break;
        case 3:  // all as a whole
          phase.update(swarm.boxes);
          break;
        case 4:  // one becomes static, or no longer is
          swarm.boxes[7].is_static = !swarm.boxes[7].is_static;
          phase.tell(swarm.boxes);
          break;
        case 5: {  // one more
          const Proxy<2> more{swarm.boxes.back().id + 2, swarm.boxes[9].box, false, true};
          swarm.boxes.push_back(more);
          phase.insert(more, {});
          break;
        }
        case 6:  // all fall asleep, and wake
          for (const bool awake : {false, true}) {
            for (Proxy<2>& box : swarm.boxes) box.awake = awake;
            phase.update(swarm.boxes);
          }
          break;
        default:
          break;
      }
      phase.follow(swarm.boxes);
      ASSERT_EQ(phase.pairs(), testing::true_pairs(swarm.boxes))
          << "run " << run << ", step " << step;
    }
  }
}

// Who looks gets a structure of the boxes themselves: it must not be asked who comes near.
TEST(NearPairs, AreTheSameAfterALook) {
  for (std::uint64_t seed = 1; seed < 5; ++seed) {
    Swarm<2> swarm(400, seed, false);
    BroadPhase<2> phase(automatic<2>(true));
    phase.tell(swarm.boxes);
    for (int step = 0; step < 100; ++step) {
      for (std::size_t i = 0; i < swarm.boxes.size(); ++i)
        if (i % 80 != 0)
          swarm.move(i, swarm.ways[i]);
        else if (step % 7 == 1)
          swarm.move(i, swarm.boxes[i + 9].box.lo - swarm.boxes[i].box.lo + 1.5);
      if (step % 7 == 0) phase.build(swarm.boxes);
      phase.follow(swarm.boxes);
      ASSERT_EQ(phase.pairs(), testing::true_pairs(swarm.boxes))
          << "seed " << seed << ", step " << step;
    }
  }
}

// How often the structure is built in the steps from `from` to `to`.
template <int D>
std::uint64_t builds_of(const BroadPhaseConfig<D>& config, int motion, int from, int to,
                        double larger = 0) {
  Swarm<D> swarm(1000, 3, false);
  for (Proxy<D>& proxy : swarm.boxes) proxy.box.hi += larger;
  BroadPhase<D> phase(config);
  phase.tell(swarm.boxes);
  const auto move = motions<D>()[static_cast<std::size_t>(motion)].move;
  std::uint64_t before = 0;
  for (int step = 0; step < to; ++step) {
    if (step == from) before = phase.counters().dynamic_builds;
    for (std::size_t i = 0; i < swarm.boxes.size(); ++i) move(swarm, i, step);
    phase.follow(swarm.boxes);
  }
  return phase.counters().dynamic_builds - before;
}
TEST(NearPairs, NothingIsBuiltWhereLittleMoves) {
  constexpr int kJitter = 1, kFlyOn = 2, kJump = 6, kFrom = 40, kTo = 120, kSteps = kTo - kFrom;
  for (const int motion : {kJitter, kFlyOn}) {
    EXPECT_LE(builds_of(automatic<2>(true), motion, kFrom, kTo), kSteps / 4);
    EXPECT_LE(builds_of(automatic<3>(true), motion, kFrom, kTo), kSteps / 4);
    EXPECT_EQ(builds_of(automatic<2>(false), motion, kFrom, kTo), kSteps);
  }
  // Where all jump there is nothing to mend, and no more is done than before.
  EXPECT_EQ(builds_of(automatic<2>(true), kJump, kFrom, kTo), kSteps);
  // Nor where each overlaps many: to find them all anew costs less than to compare them one by one.
  EXPECT_EQ(builds_of(automatic<2>(true), kJitter, kFrom, kTo, 10), kSteps);
  EXPECT_LE(builds_of(automatic<2>(true), kJitter, kFrom, kTo, 1), kSteps / 4);
  // Who names a structure gets it in each step.
  BroadPhaseConfig<2> named = automatic<2>(true);
  named.kind = StructureKind::grid;
  EXPECT_EQ(builds_of(named, kJitter, kFrom, kTo), kSteps);
}

// Of pairs, that all are near each other, is no reason to refuse what few overlaps would not be.
TEST(NearPairs, AreNotKeptWhereTheyAreTooMany) {
  Swarm<2> swarm(200, 9, false);
  BroadPhaseConfig<2> config = automatic<2>(true);
  config.most_pairs = testing::true_pairs(swarm.boxes).size() + 20;
  BroadPhase<2> phase(config);
  phase.tell(swarm.boxes);
  for (int step = 0; step < 50; ++step) {
    for (std::size_t i = 0; i < swarm.boxes.size(); ++i)
      swarm.move(i, swarm.ways[i] * (step % 2 == 0 ? 1. : -1.));
    if (testing::true_pairs(swarm.boxes).size() > config.most_pairs) continue;
    phase.follow(swarm.boxes);
    ASSERT_EQ(phase.pairs(), testing::true_pairs(swarm.boxes)) << step;
  }
}

// Nor is a list taken for one of today's whose successor was refused.
TEST(NearPairs, AreForgottenWhereALongerListIsRefused) {
  for (double share = 1.2; share < 8; share *= 1.15) {
    Swarm<2> swarm(500, 9, false);
    BroadPhaseConfig<2> config = automatic<2>(true);
    config.most_pairs =
        static_cast<std::uint64_t>(share * double(testing::true_pairs(swarm.boxes).size()));
    BroadPhase<2> phase(config);
    phase.tell(swarm.boxes);
    for (int step = 0; step < 40; ++step) {
      for (std::size_t i = 0; i < swarm.boxes.size(); ++i) swarm.move(i, swarm.ways[i]);
      if (testing::true_pairs(swarm.boxes).size() > config.most_pairs) break;
      phase.follow(swarm.boxes);
      ASSERT_EQ(phase.pairs(), testing::true_pairs(swarm.boxes)) << share << ", step " << step;
    }
  }
}

}  // namespace
}  // namespace lantern::spatial
