#include "spatial/structure_trial.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "base/random.hpp"
#include "base/stop.hpp"
#include "geometry/random_vec.hpp"
#include "spatial/broad_phase.hpp"
#include "spatial/pairs.hpp"

namespace lantern::spatial {
namespace {

constexpr std::int64_t kMostBodies = 24;

struct TrialSort {
  std::string_view name;
  TrialBody (*body)(const Box<2>& bounds, Random& random);
};

Vec<2> somewhere(const Box<2>& bounds, Random& random) {
  return {random.between(bounds.lo.x, bounds.hi.x), random.between(bounds.lo.y, bounds.hi.y)};
}

constexpr TrialSort kTrialSorts[] = {
    {"uniform",
     [](const Box<2>& bounds, Random& random) {
       return TrialBody{somewhere(bounds, random), random_point<2>(random, 0, 6)};
     }},
    {"clustered",
     [](const Box<2>& bounds, Random& random) {
       const double at = random.bits() % 2 == 0 ? 0.15 : 0.64;
       return TrialBody{bounds.lo + bounds.size() * at + random_point<2>(random, 0, 2),
                        random_point<2>(random, 0, 1)};
     }},
    {"coincident",
     [](const Box<2>& bounds, Random&) {
       return TrialBody{bounds.lo + bounds.size() * 0.375, Vec<2>(1.5)};
     }},
    {"on borders",  // edges lie exactly on those of cells
     [](const Box<2>& bounds, Random& random) {
       TrialBody body;
       for (int i = 0; i < 2; ++i) {
         const double cell = bounds.size()[i] / 16;
         const auto from = static_cast<double>(random.whole(0, 14));
         const auto cells = static_cast<double>(random.whole(0, 2));
         body.half[i] = cell * cells / 2;
         body.center[i] = bounds.lo[i] + cell * from + body.half[i];
       }
       return body;
     }},
    {"large and small",
     [](const Box<2>& bounds, Random& random) {
       const double size = bounds.size().x * std::pow(10.0, random.between(-6, 1));
       return TrialBody{somewhere(bounds, random), random_point<2>(random, 0, size)};
     }},
    {"points",
     [](const Box<2>& bounds, Random& random) {
       return TrialBody{somewhere(bounds, random), Vec<2>(0.0)};
     }},
    {"outside",
     [](const Box<2>& bounds, Random& random) {
       const Vec<2> size = bounds.size();
       return TrialBody{somewhere({bounds.lo - size, bounds.hi + size}, random),
                        random_point<2>(random, 0, 30)};
     }},
};

constexpr std::array<Box<2>, 3> kTrialBounds = {
    Box<2>{Vec<2>(0.0), Vec<2>(64.0)}, Box<2>{{-32, -32}, {32, 32}}, Box<2>{{96, -16}, {224, 48}}};

std::vector<Proxy<2>> proxies_of(const std::vector<TrialBody>& bodies) {
  std::vector<Proxy<2>> proxies;
  for (const TrialBody& body : bodies)
    proxies.push_back({.id = static_cast<BodyId>(proxies.size() + 1),
                       .box = Box<2>::around(body.center, body.half)});
  return proxies;
}

// Of all that goes wrong what matters most.
bool misses_a_pair(std::string_view fault) {
  return fault.find("their pair is missed") != std::string_view::npos;
}

std::string trial_name(BodyId id) { return fmt::format("b{}", id); }

std::vector<Pair> true_pairs(const std::vector<Proxy<2>>& proxies) {
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < proxies.size(); ++i)
    for (std::size_t j = i + 1; j < proxies.size(); ++j)
      if (overlap(proxies[i].box, proxies[j].box)) pairs.push_back({proxies[i].id, proxies[j].id});
  return pairs;
}

// The first, and the pair that is missed, which is told last.
std::optional<std::string> first_fault(const BroadPhase<2>& phase) {
  const std::vector<OwnFault> faults = phase.faults();
  if (faults.empty()) return std::nullopt;
  std::string text = text_of(faults.front(), trial_name);
  if (faults.size() > 1 && misses_a_pair(faults.back().text))
    text += "; " + text_of(faults.back(), trial_name);
  return text;
}

// Of what an update found.
std::optional<std::string> wrong_pair(const BroadPhase<2>& phase,
                                      const std::vector<Proxy<2>>& proxies) {
  const std::vector<Pair> truth = true_pairs(proxies), &found = phase.pairs();
  std::vector<Pair> missed, invented;
  std::ranges::set_difference(truth, found, std::back_inserter(missed));
  std::ranges::set_difference(found, truth, std::back_inserter(invented));
  if (missed.empty() && invented.empty()) return std::nullopt;
  const Pair& first = missed.empty() ? invented.front() : missed.front();
  return fmt::format("{} and {} {}", trial_name(first.a), trial_name(first.b),
                     missed.empty() ? "are told as a pair, but do not overlap"
                                    : "overlap, but their pair is missed");
}

std::optional<std::string> fault_on_the_way(StructureKind kind, const TrialWorld& world) {
  BroadPhaseConfig<2> config;
  config.kind = kind;
  config.bounds = world.bounds;
  config.capacity = world.capacity;
  config.max_depth = world.max_depth;
  config.split_static = false;
  config.in_proportion = false;
  config.most_entries = 1 << 16;
  BroadPhase<2> one_by_one(config), at_once(config);
  for (const Proxy<2>& proxy : proxies_of(world.bodies)) {
    one_by_one.insert(proxy, {});
    if (const auto fault = first_fault(one_by_one)) return fault;
  }
  for (const auto* bodies : {&world.bodies, &world.moved}) {
    if (bodies->empty() && bodies == &world.moved) break;
    const std::vector<Proxy<2>> proxies = proxies_of(*bodies);
    at_once.update(proxies);
    if (const auto fault = first_fault(at_once)) return fault;
    if (const auto pair = wrong_pair(at_once, proxies)) return pair;
  }
  return std::nullopt;
}

// Does as much go wrong as before?
bool fails_alike(StructureKind kind, const TrialWorld& world, bool misses_pair) {
  const auto fault = fault_in(kind, world);
  return fault && (!misses_pair || misses_a_pair(*fault));
}

// Without one body after another, as long as something still goes wrong.
bool drop_bodies(StructureKind kind, TrialWorld& world, bool misses_pair) {
  bool dropped = false;
  for (std::size_t i = world.bodies.size(); i-- > 0;) {
    TrialWorld less = world;
    less.bodies.erase(less.bodies.begin() + static_cast<std::ptrdiff_t>(i));
    if (!less.moved.empty()) less.moved.erase(less.moved.begin() + static_cast<std::ptrdiff_t>(i));
    if (!fails_alike(kind, less, misses_pair)) continue;
    world = std::move(less);
    dropped = true;
  }
  return dropped;
}

bool try_instead(StructureKind kind, TrialWorld& world, TrialWorld simpler, bool misses_pair) {
  if (!fails_alike(kind, simpler, misses_pair)) return false;
  world = std::move(simpler);
  return true;
}

void stand_still(StructureKind kind, TrialWorld& world, bool misses_pair) {
  if (world.moved.empty()) return;
  TrialWorld before = world, after = world;
  before.moved.clear();
  after.bodies = std::exchange(after.moved, {});
  if (!try_instead(kind, world, before, misses_pair)) try_instead(kind, world, after, misses_pair);
}

// To whole numbers, halves, quarters, whichever is the roundest that still shows it.
void round_bodies(StructureKind kind, TrialWorld& world, bool misses_pair) {
  for (auto list : {&TrialWorld::bodies, &TrialWorld::moved})
    for (std::size_t i = 0; i < (world.*list).size(); ++i)
      for (auto part : {&TrialBody::center, &TrialBody::half})
        for (int axis = 0; axis < 2; ++axis)
          for (const double unit : {8.0, 1.0, 0.25}) {
            TrialWorld rounder = world;
            double& number = ((rounder.*list)[i].*part)[axis];
            const double round = std::round(number / unit) * unit;
            if (round == number) break;
            if (round == 0 && part == &TrialBody::half) continue;  // it shall be seen
            number = round;
            if (try_instead(kind, world, rounder, misses_pair)) break;
          }
}

bool simplify_settings(StructureKind kind, TrialWorld& world, bool misses_pair) {
  bool simpler = false;
  for (auto setting : {&TrialWorld::max_depth, &TrialWorld::capacity})
    while (world.*setting > 1) {
      TrialWorld less = world;
      --(less.*setting);
      if (!try_instead(kind, world, less, misses_pair)) break;
      simpler = true;
    }
  return simpler;
}

}  // namespace

TrialWorld trial_world(std::uint64_t seed, std::uint64_t number) {
  Random random(seed * 0x9e3779b97f4a7c15u + number);
  const TrialSort& sort = kTrialSorts[number % std::size(kTrialSorts)];
  TrialWorld world{sort.name, kTrialBounds[static_cast<std::size_t>(random.whole(0, 2))], 1, 1, {},
                   {}};
  world.capacity = static_cast<std::uint32_t>(random.whole(1, 4));
  world.max_depth = static_cast<std::uint32_t>(random.whole(1, 5));
  const std::int64_t bodies = random.whole(0, kMostBodies);
  for (std::int64_t i = 0; i < bodies; ++i) world.bodies.push_back(sort.body(world.bounds, random));
  const bool moves = random.bits() % 4 == 0;
  for (std::int64_t i = 0; moves && i < bodies; ++i)
    world.moved.push_back(sort.body(world.bounds, random));
  return world;
}

std::optional<std::string> fault_in(StructureKind kind, const TrialWorld& world) try {
  stop_if_asked();
  return fault_on_the_way(kind, world);
} catch (const StructureFault& broken) {
  return text_of(broken.fault(), trial_name);
} catch (const Refused& refused) {
  return refused.what();
}

TrialWorld shrunk(StructureKind kind, TrialWorld world) {
  const bool pair = misses_a_pair(fault_in(kind, world).value_or(""));
  stand_still(kind, world, pair);
  while (drop_bodies(kind, world, pair) || simplify_settings(kind, world, pair)) {
  }
  stand_still(kind, world, pair);
  round_bodies(kind, world, pair);
  return world;
}

Trial try_structure(StructureKind kind, std::uint64_t worlds, std::uint64_t seed) {
  Trial trial;
  trial.kind = kind;
  trial.worlds = worlds;
  std::optional<TrialWorld> least;
  bool least_misses = false;
  for (std::uint64_t i = 0; i < worlds; ++i) {
    TrialWorld world = trial_world(seed, i);
    const auto fault = fault_in(kind, world);
    if (!fault) continue;
    ++trial.failed;
    const bool misses = misses_a_pair(*fault);
    if (least && (misses < least_misses ||
                  (misses == least_misses && world.bodies.size() >= least->bodies.size())))
      continue;
    least = std::move(world);
    least_misses = misses;
  }
  if (!least) return trial;
  trial.smallest = shrunk(kind, std::move(*least));
  trial.fault = fault_in(kind, trial.smallest)
                    .value_or(
                        "it fails now and then: its results differ "
                        "from one run to the next");
  return trial;
}

}  // namespace lantern::spatial
