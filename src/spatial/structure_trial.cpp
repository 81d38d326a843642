#include "spatial/structure_trial.hpp"

#include <iterator>
#include <sstream>

#include "base/json_writer.hpp"
#include "base/memory.hpp"
#include "base/random.hpp"
#include "geometry/random_vec.hpp"
#include "spatial/broad_phase.hpp"
#include "spatial/own_structure.hpp"
#include "spatial/pairs.hpp"
#include "spatial/query.hpp"

namespace lantern::spatial {
std::vector<Proxy<2>> proxies_of(const std::vector<TrialBody>& bodies) {
  std::vector<Proxy<2>> proxies;
  for (const TrialBody& body : bodies)
    proxies.push_back({.id = static_cast<BodyId>(proxies.size() + 1),
                       .box = Box<2>::around(body.center, body.half)});
  return proxies;
}

namespace {

// Of all that goes wrong what matters most.
bool misses_a_pair(std::string_view fault) {
  return fault.find("their pair is missed") != std::string_view::npos;
}

std::string trial_name(BodyId id) { return fmt::format("b{}", id); }
std::string bench_name(BodyId id) { return fmt::format("body {}", id); }

// The first, and the pair that is missed, which is told last.
std::optional<std::string> first_fault(const BroadPhase<2>& phase) {
  const std::vector<OwnFault> faults = phase.faults();
  if (faults.empty()) return std::nullopt;
  std::string text = text_of(faults.front(), trial_name);
  if (faults.size() > 1 && misses_a_pair(faults.back().text))
    text += "; " + text_of(faults.back(), trial_name);
  return text;
}

// Of what was found.
std::optional<std::string> wrong_pair(const std::vector<Pair>& found, std::span<const Pair> truth,
                                      std::string (*name)(BodyId)) {
  std::vector<Pair> missed, invented;
  std::ranges::set_difference(truth, found, std::back_inserter(missed));
  std::ranges::set_difference(found, truth, std::back_inserter(invented));
  if (missed.empty() && invented.empty()) return std::nullopt;
  const Pair& first = missed.empty() ? invented.front() : missed.front();
  return fmt::format("{} and {} {}", name(first.a), name(first.b),
                     missed.empty() ? "are told as a pair, but do not overlap"
                                    : "overlap, but their pair is missed");
}

// Of a user's own search for pairs, and along rays, if it has them: here from body to body. What a
// ray only touches may be rounded away.
std::optional<std::string> wrong_answer(const BroadPhase<2>& phase,
                                        std::span<const Proxy<2>> proxies,
                                        std::span<const Pair> truth, std::string (*name)(BodyId)) {
  if (!own_structure(phase.kind())) return std::nullopt;
  const auto all = [](BodyId) { return true; };
  if (const auto pair =
          wrong_pair(phase.pair_chain(all, phase.config().most_pairs).overlapping, truth, name))
    return fmt::format("structure '{}': its pair search: {}", to_string(phase.kind()), *pair);
  const double slack = 1e-6 * glm::length(phase.config().bounds.size());
  for (std::size_t i = 1; i < std::min<std::size_t>(proxies.size(), 9); ++i) {
    const Vec<2> from = proxies[i - 1].box.center(), way = proxies[i].box.center() - from;
    if (glm::length(way) < slack) continue;
    const Ray<2> ray{from, way, 1};
    const std::vector<RayHit> hits = raycast_all<2>(phase.dynamic(), ray).hits;
    for (const Proxy<2>& proxy : proxies) {
      const Box<2> core{proxy.box.lo + slack, proxy.box.hi - slack};
      if (is_valid(core) && overlap(ray, core) &&
          std::ranges::find(hits, proxy.id, &RayHit::id) == hits.end())
        return fmt::format(
            "structure '{}': its ray from [{}, {}] to [{}, {}] misses {}, which it meets",
            to_string(phase.kind()), from.x, from.y, ray.at(1).x, ray.at(1).y, name(proxy.id));
    }
  }
  return std::nullopt;
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
    const std::vector<Pair> truth = pairs_by_force<2>(proxies);
    if (const auto pair = wrong_pair(at_once.pairs(), truth, trial_name)) return pair;
    if (const auto answer = wrong_answer(at_once, proxies, truth, trial_name)) return answer;
  }
  return std::nullopt;
}

std::optional<std::string> fault_here(StructureKind kind, const TrialWorld& world) try {
  stop_if_asked();
  return fault_on_the_way(kind, world);
} catch (const StructureFault& broken) {
  return text_of(broken.fault(), trial_name);
} catch (const Refused& refused) {
  return refused.what();
}

// What came of one world.
struct TrialFault {
  std::string text = {};  // empty: all is well
  TrialEnd end = TrialEnd::fails;
  std::optional<BodyId> last = {};

  int weight() const {
    if (text.empty()) return 0;
    return end != TrialEnd::fails ? 3 : misses_a_pair(text) ? 2 : 1;
  }
};

// What came of an attempt that did not come to its end.
TrialFault fault_of(StructureKind kind, const Attempt& tried, BodyId first_body) {
  TrialFault fault{.end = tried.hung ? TrialEnd::hangs : TrialEnd::crashes};
  if (tried.call.starts_with("insert")) fault.last = tried.body + first_body;
  const auto name = first_body == 1 ? trial_name : bench_name;
  fault.text =
      fmt::format("structure '{}': {} {}", to_string(kind),
                  text_of(OwnFault{tried.call, {tried.body + first_body}}, name), tried.end);
  return fault;
}

// Of worlds, as many as there are, or up to the first that does not come to its end.
std::vector<TrialFault> faults_in(StructureKind kind, std::uint64_t worlds,
                                  FunctionRef<TrialWorld(std::uint64_t)> world,
                                  const AttemptLimits& limits) {
  const auto try_all = [&](Tell tell) {
    for (std::uint64_t i = 0; i < worlds; ++i) tell(fault_here(kind, world(i)).value_or(""));
  };
  std::vector<TrialFault> faults;
  const auto take = [&](std::string_view text) { faults.push_back({std::string(text)}); };
  if (!own_structure(kind)) {
    try_all(take);
    return faults;
  }
  const Attempt tried = attempt(limits, try_all);
  for (const std::string& text : tried.told) take(text);
  if (!tried.end.empty()) faults.push_back(fault_of(kind, tried, 1));
  return faults;
}

TrialFault fault_of_world(StructureKind kind, const TrialWorld& world,
                          const AttemptLimits& limits) {
  return faults_in(
             kind, 1, [&](std::uint64_t) { return world; }, limits)
      .front();
}

// Makes a world on which something goes wrong smaller and rounder, as long as as much does.
struct Shrinking {
  StructureKind kind;
  TrialWorld world;
  AttemptLimits limits;
  int weight = fault_of_world(kind, world, limits).weight();

  bool try_instead(TrialWorld simpler) {
    if (fault_of_world(kind, simpler, limits).weight() < std::max(1, weight)) return false;
    world = std::move(simpler);
    return true;
  }

  // Without one body after another.
  bool drop_bodies() {
    bool dropped = false;
    for (std::size_t i = world.bodies.size(); i-- > 0;) {
      TrialWorld less = world;
      for (auto* list : {&less.bodies, &less.moved})
        if (!list->empty()) list->erase(list->begin() + static_cast<std::ptrdiff_t>(i));
      dropped |= try_instead(std::move(less));
    }
    return dropped;
  }

  // Into the world, where they can be seen.
  void come_inside() {
    for (auto list : {&TrialWorld::bodies, &TrialWorld::moved})
      for (std::size_t i = 0; i < (world.*list).size(); ++i) {
        TrialWorld inside = world;
        Vec<2>& center = (inside.*list)[i].center;
        const Vec<2> was = center;
        center = glm::clamp(center, world.bounds.lo, world.bounds.hi);
        if (center != was) try_instead(std::move(inside));
      }
  }

  void stand_still() {
    if (world.moved.empty()) return;
    TrialWorld before = world, after = world;
    before.moved.clear();
    after.bodies = std::exchange(after.moved, {});
    if (!try_instead(std::move(before))) try_instead(std::move(after));
  }

  // To whole numbers, halves, quarters, whichever is the roundest that still shows it.
  void round_bodies() {
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
              if (try_instead(std::move(rounder))) break;
            }
  }

  bool simplify_settings() {
    bool simpler = false;
    for (auto setting : {&TrialWorld::max_depth, &TrialWorld::capacity})
      while (world.*setting > 1) {
        TrialWorld less = world;
        --(less.*setting);
        if (!try_instead(std::move(less))) break;
        simpler = true;
      }
    return simpler;
  }
};

constexpr std::uint32_t kBenchCapacity = 8, kBenchDepth = 7;

// What there is to find, and what was found.
struct Finds {
  std::span<const Proxy<2>> boxes;
  std::span<const Ray<2>> rays;
  std::uint64_t hits = 0;
  std::vector<Pair> pairs = {};  // as often as they are met
  std::uint64_t tests = 0;

  void add(BodyId a, BodyId b) {
    if (overlap(boxes[a].box, boxes[b].box)) pairs.push_back({std::min(a, b), std::max(a, b)});
  }
  void add_leaf(std::span<const BodyId> bodies) {
    stop_if_asked();
    for (std::size_t i = 0; i < bodies.size(); ++i)
      for (std::size_t j = i + 1; j < bodies.size(); ++j) add(bodies[i], bodies[j]);
    tests += all_pairs(bodies.size());
  }
};

// One structure on one scene, whoever wrote it; and what it took, turn by turn.
struct Contestant {
  std::function<void()> build;
  std::function<void(Finds&)> find;
  std::function<bool(Finds&)> look_along;  // all rays; false if it cannot
  std::function<void(StructureTime&)> count;
  std::vector<double> build_seconds = {}, pairs_seconds = {}, rays_seconds = {};

  void take_turn(Finds& finds) {
    finds.pairs.clear();
    finds.tests = 0;
    const CpuStopwatch building;
    build();
    build_seconds.push_back(building.seconds());
    const CpuStopwatch finding;
    find(finds);
    pairs_seconds.push_back(finding.seconds());
    const CpuStopwatch looking;
    if (look_along(finds)) rays_seconds.push_back(looking.seconds());
  }
  void forget_turns() {
    for (auto* seconds : {&build_seconds, &pairs_seconds, &rays_seconds}) seconds->clear();
  }
};

Contestant one_of_ours(StructureKind kind, const StructureConfig<2>& config,
                       std::span<const Proxy<2>> boxes) {
  std::vector<Item<2>> items;
  const auto stored = std::make_shared<std::vector<Box<2>>>();
  for (const Proxy<2>& box : boxes) {
    items.push_back({box.id, box.box});
    stored->push_back(box.box);
  }
  const std::shared_ptr<Structure<2>> structure = make_structure<2>(kind, config);
  const bool in_leaves = traits_of(kind).meets_in_leaves;
  return {[=] { structure->build(items); },
          [=](Finds& finds) {
            if (in_leaves)
              return structure->visit([&](const NodeView<2>& node) {
                finds.add_leaf(node.bodies);
                return true;
              });
            const auto all = [](BodyId) { return true; };
            structure->compare(all, [&](BodyId a, BodyId b) {
              ++finds.tests;
              finds.add(a, b);
            });
          },
          [=](Finds& finds) {
            for (const Ray<2>& ray : finds.rays)
              finds.hits += raycast_all<2>({*structure, {}, *stored}, ray).hits.size();
            return true;
          },
          [=](StructureTime& row) {
            const Counters counters = structure->counters();
            row.nodes = counters.nodes;
            row.entries = counters.entries;
          }};
}

Contestant one_of_yours(const OwnKind& kind, const StructureConfig<2>& config,
                        std::span<const Proxy<2>> boxes) {
  const auto tree = std::make_shared<std::unique_ptr<OwnTree>>();
  return {[=, &kind] {
            if (!*tree || !(*tree)->clear())
              *tree = kind.make(config.bounds, config.capacity, config.max_depth);
            for (const Proxy<2>& box : boxes) {
              stop_if_asked();
              (*tree)->insert(box.id, box.box);
            }
          },
          [=, &kind](Finds& finds) {
            const auto test = [&](BodyId a, BodyId b) {
              ++finds.tests;
              finds.add(a, b);
            };
            if ((*tree)->pairs(test)) return;
            (*tree)->visit([&](const OwnNode& node) {
              for (const BodyId id : node.bodies)
                if (id >= boxes.size())
                  throw StructureFault({fmt::format(
                      "structure '{}': a node lists a body of number {}, which was never inserted",
                      kind.name, id)});
              finds.add_leaf(node.bodies);
            });
          },
          [=](Finds& finds) {
            for (const Ray<2>& ray : finds.rays) {
              const auto test = [&](BodyId id) { finds.hits += overlap(ray, finds.boxes[id].box); };
              if (!(*tree)->ray(ray.origin, ray.at(1), test)) return false;
            }
            return true;
          },
          [=](StructureTime& row) {
            row.nodes = row.entries = 0;
            (*tree)->visit([&](const OwnNode& node) {
              ++row.nodes;
              row.entries += node.bodies.size();
            });
          }};
}

// Before its times mean anything: whether it can be read, and finds what there is. Twice, since it
// is cleared in between.
void look_at(StructureKind kind, const StructureConfig<2>& config, std::span<const Proxy<2>> boxes,
             std::span<const Pair> truth, StructureTime& row) {
  try {
    BroadPhase<2> broad_phase({config, kind, false});
    for (int turn = 0; turn < 2; ++turn) {
      broad_phase.update({});
      broad_phase.update(boxes);
    }
    row.missed = count_missing(truth, broad_phase.pairs());
    row.invented = count_missing(broad_phase.pairs(), truth);
    if (const auto faults = broad_phase.faults(); !faults.empty())
      row.fault = text_of(faults.front(), bench_name);
    else if (const auto answer = wrong_answer(broad_phase, boxes, truth, bench_name))
      row.fault = *answer;
  } catch (const StructureFault& broken) {
    row.fault = broken.what();
  } catch (const Refused& refused) {
    row.fault = refused.what();
  }
}

// A user's own in a process of its own.
void try_first(StructureKind kind, const StructureConfig<2>& config,
               std::span<const Proxy<2>> boxes, std::span<const Pair> truth, double limit,
               StructureTime& row) {
  if (!own_structure(kind)) return look_at(kind, config, boxes, truth, row);
  const Attempt tried = attempt({limit, memory_budget()}, [&](Tell tell) {
    look_at(kind, config, boxes, truth, row);
    tell(row.fault);
    tell(fmt::format("{}", row.missed));
    tell(fmt::format("{}", row.invented));
  });
  if (!tried.end.empty()) {
    row.fault = fault_of(kind, tried, 0).text;
    return;
  }
  row.fault = tried.told[0];
  row.missed = std::stoull(tried.told[1]);
  row.invented = std::stoull(tried.told[2]);
}

// All that can be timed, turn about; the first turn is for warmth. `begins` is told whose it is.
std::vector<Contestant> take_turns(const StructureBench& bench, const StructureConfig<2>& config,
                                   Finds finds, std::span<StructureTime> rows,
                                   FunctionRef<void(std::size_t)> begins) {
  std::vector<Contestant> contestants;
  for (const StructureTime& row : rows) {
    const OwnKind* yours = own_structure(row.kind);
    contestants.push_back(yours ? one_of_yours(*yours, config, finds.boxes)
                                : one_of_ours(row.kind, config, finds.boxes));
  }
  for (int round = 0; round <= bench.rounds; ++round)
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (!rows[i].fault.empty()) continue;
      begins(i);
      const AttemptedCall tried("a timed turn", 0);
      Contestant& one = contestants[i];
      one.take_turn(finds);
      if (round > 0) continue;
      rows[i].pair_tests = finds.tests;
      one.count(rows[i]);
      if (const double both = one.build_seconds[0] + one.pairs_seconds[0]; both > bench.longest)
        rows[i].fault = fmt::format("one build and search takes {:.1f} s, more than {:g} s", both,
                                    bench.longest);
      one.forget_turns();
    }
  return contestants;
}

// The same in a process of its own: what ends that is at fault, and the others begin anew.
std::vector<Contestant> try_turns(const StructureBench& bench, const StructureConfig<2>& config,
                                  const Finds& finds, std::span<StructureTime> rows) {
  const AttemptLimits limits{.seconds = bench.longest, .bytes = memory_budget(), .by_clock = true};
  const Attempt tried = attempt(limits, [&](Tell tell) {
    const auto begins = [&](std::size_t i) { tell(fmt::format("{}", i)); };
    const auto contestants = take_turns(bench, config, finds, rows, begins);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const StructureTime& row = rows[i];
      tell(row.fault);
      tell(fmt::format("{} {} {}", row.nodes, row.entries, row.pair_tests));
      for (const auto& seconds : {contestants[i].build_seconds, contestants[i].pairs_seconds,
                                  contestants[i].rays_seconds})
        tell(fmt::format("{}", fmt::join(seconds, " ")));
    }
  });
  if (!tried.end.empty()) {
    StructureTime& row = rows[std::stoull(tried.told.back())];
    row.fault = fault_of(row.kind, tried, 0).text;
    return try_turns(bench, config, finds, rows);
  }
  std::vector<Contestant> contestants(rows.size());
  auto told = tried.told.end() - static_cast<std::ptrdiff_t>(5 * rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].fault = *told++;
    std::istringstream(*told++) >> rows[i].nodes >> rows[i].entries >> rows[i].pair_tests;
    Contestant& one = contestants[i];
    for (auto* seconds : {&one.build_seconds, &one.pairs_seconds, &one.rays_seconds}) {
      std::istringstream text(*told++);
      seconds->assign(std::istream_iterator<double>(text), {});
    }
  }
  return contestants;
}

std::vector<StructureTime> bench_scene(const StructureBench& bench, std::uint64_t bodies,
                                       BoxSort sort, const char* name,
                                       const std::function<void()>& told) {
  const BoxUpdates<2> scene = seeded_boxes<2>(sort, bodies, bench.seed);
  const std::span<const Proxy<2>> boxes = scene.frames[0];
  const std::vector<Pair> truth = pairs_by_force<2>(boxes);
  const StructureConfig<2> config{
      .bounds = scene.bounds, .capacity = kBenchCapacity, .max_depth = kBenchDepth};
  std::vector<Ray<2>> rays;
  Random random(bench.seed);
  for (int i = 0; i < 64; ++i) {
    const Vec<2> from = random_point<2>(random, scene.bounds.lo.x, scene.bounds.hi.x);
    rays.push_back({from, random_point<2>(random, scene.bounds.lo.x, scene.bounds.hi.x) - from, 1});
  }
  const Finds finds{.boxes = boxes, .rays = rays};
  std::vector<StructureTime> rows;
  bool yours = false;
  for (const StructureKind kind : bench.kinds) {
    StructureTime& row =
        rows.emplace_back(StructureTime{.kind = kind, .scene = name, .bodies = boxes.size()});
    try_first(kind, config, boxes, truth, bench.limit, row);
    yours |= own_structure(kind) != nullptr && row.fault.empty();
  }
  const auto contestants = yours ? try_turns(bench, config, finds, rows)
                                 : take_turns(bench, config, finds, rows, [](std::size_t) {});
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].build = timing_of(contestants[i].build_seconds);
    rows[i].pairs = timing_of(contestants[i].pairs_seconds);
    rows[i].rays = timing_of(contestants[i].rays_seconds);
    told();
  }
  return rows;
}

std::string microseconds(const Timing& time) {
  return time.repeats == 0 ? "–" : fmt::format("{:.1f}", 1e6 * time.median);
}

}  // namespace

std::optional<std::string> fault_in(StructureKind kind, const TrialWorld& world) {
  const TrialFault fault = fault_of_world(kind, world, {});
  return fault.text.empty() ? std::nullopt : std::optional(fault.text);
}

// What hangs is waited for many times, so not as long each time.
TrialWorld shrunk(StructureKind kind, TrialWorld world, const AttemptLimits& limits) {
  Shrinking shrinking{kind, std::move(world), {limits.seconds / 10, limits.bytes, false}};
  shrinking.stand_still();
  while (shrinking.drop_bodies() || shrinking.simplify_settings()) {
  }
  shrinking.stand_still();
  shrinking.come_inside();
  shrinking.round_bodies();
  return std::move(shrinking.world);
}

Trial try_structure(StructureKind kind, std::uint64_t worlds, std::uint64_t seed,
                    const AttemptLimits& limits) {
  Trial trial{.kind = kind};
  const auto world_of = [&](std::uint64_t i) { return trial_world(seed, i); };
  const auto faults = faults_in(kind, worlds, world_of, limits);
  trial.worlds = faults.size();
  std::optional<TrialWorld> least;
  const TrialFault* worst = nullptr;
  int weight = 0;
  for (std::uint64_t i = 0; i < faults.size(); ++i) {
    if (faults[i].text.empty()) continue;
    ++trial.failed;
    const int here = faults[i].weight();
    if (here < weight) continue;
    TrialWorld world = world_of(i);
    if (here == weight && world.bodies.size() >= least->bodies.size()) continue;
    least = std::move(world);
    worst = &faults[i];
    weight = here;
  }
  if (!least) return trial;
  const AttemptLimits silent{limits.seconds, limits.bytes, false};  // it has been heard already
  trial.smallest = shrunk(kind, *least, limits);
  TrialFault fault = fault_of_world(kind, trial.smallest, silent);
  if (fault.weight() < weight) {  // slow, not without end; or it differs from run to run
    fault = fault_of_world(kind, *least, silent);
    trial.smallest = std::move(*least);
  }
  if (fault.text.empty()) {
    fault = *worst;
    fault.text += ", but not in this world alone: what it does hangs on what went before";
  }
  trial.fault = fault.text;
  trial.end = fault.end;
  trial.last = fault.last;
  return trial;
}

std::uint64_t structure_bench_rows(const StructureBench& bench) {
  return 3 * bench.kinds.size() * bench.bodies.size();
}

std::vector<StructureTime> bench_structures(const StructureBench& bench,
                                            const std::function<void()>& told) {
  std::vector<StructureTime> all;
  for (const std::uint64_t bodies : bench.bodies)
    for (const auto& [sort, name] :
         {std::pair(BoxSort::uniform, "uniform_2d"), std::pair(BoxSort::clustered, "clustered_2d"),
          std::pair(BoxSort::coincident, "coincident_2d")}) {
      const std::vector<StructureTime> rows = bench_scene(bench, bodies, sort, name, told);
      all.insert(all.end(), rows.begin(), rows.end());
    }
  return all;
}

std::string to_table(std::span<const StructureTime> rows) {
  std::string text = fmt::format(
      "Microseconds, medians of turns; capacity {}, depth limit {}. Of your own structures insert "
      "and visit are timed, pairs "
      "and ray if they have them.\n{:<14}{:>7}  {:<18}{:>10}{:>10}{:>10}{:>10}{:>8}{:>9}{:>11}\n",
      kBenchCapacity, kBenchDepth, "scene", "bodies", "structure", "build", "pairs", "both",
      "64 rays", "nodes", "entries", "pair tests");
  for (const StructureTime& row : rows) {
    text += fmt::format("{:<14}{:>7}  {:<18}", row.scene, row.bodies, to_string(row.kind));
    if (!row.fault.empty()) {
      text += fmt::format("not timed: {}\n", row.fault);
      continue;
    }
    text += fmt::format("{:>10}{:>10}{:>10.1f}{:>10}{:>8}{:>9}{:>11}\n", microseconds(row.build),
                        microseconds(row.pairs), 1e6 * (row.build.median + row.pairs.median),
                        microseconds(row.rays), row.nodes, row.entries, row.pair_tests);
  }
  return text;
}

std::string to_csv(std::span<const StructureTime> rows) {
  std::string text =
      "scene,bodies,structure,build_s,pairs_s,nodes,entries,pair_tests,missed,invented,rays_s\n";
  for (const StructureTime& row : rows)
    if (row.fault.empty())
      text += fmt::format("{},{},{},{:.9g},{:.9g},{},{},{},{},{},{}\n", row.scene, row.bodies,
                          to_string(row.kind), row.build.median, row.pairs.median, row.nodes,
                          row.entries, row.pair_tests, row.missed, row.invented,
                          row.rays.repeats == 0 ? "" : fmt::format("{:.9g}", row.rays.median));
  return text;
}

std::string to_json(std::span<const StructureTime> rows, std::uint64_t seed) {
  JsonWriter json;
  json.begin_object().line().members("format", "lantern.structure.bench/1", "seed", seed,
                                     "capacity", kBenchCapacity, "max_depth", kBenchDepth);
  json.line().key("rows").begin_array();
  for (const StructureTime& row : rows) {
    json.line().begin_object().members("scene", row.scene, "bodies", row.bodies, "structure",
                                       to_string(row.kind));
    if (row.fault.empty())
      json.members("build_s", row.build.median, "pairs_s", row.pairs.median, "nodes", row.nodes,
                   "entries", row.entries, "pair_tests", row.pair_tests, "missed", row.missed,
                   "invented", row.invented);
    else
      json.member("fault", row.fault);
    if (row.rays.repeats > 0) json.member("rays_s", row.rays.median);
    json.end_object();
  }
  json.line().end_array().line().end_object();
  return json.text() + "\n";
}

}  // namespace lantern::spatial
