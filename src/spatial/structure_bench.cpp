#include "spatial/structure_bench.hpp"

#include <algorithm>
#include <exception>
#include <memory>

#include <fmt/format.h>

#include "base/clock.hpp"
#include "base/json_writer.hpp"
#include "base/stop.hpp"
#include "base/timing.hpp"
#include "spatial/box_worlds.hpp"
#include "spatial/own/own_tree.hpp"
#include "spatial/pairs.hpp"

namespace lantern::spatial {
namespace {

constexpr std::uint32_t kBenchCapacity = 8, kBenchDepth = 7;

// What there is to find, and what was found.
struct Finds {
  std::span<const Proxy<2>> boxes;
  std::vector<Pair> pairs;  // as often as they are met
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

// One structure on one scene, whoever wrote it.
class Contestant {
 public:
  virtual ~Contestant() = default;
  virtual void build() = 0;
  virtual void find(Finds& finds) = 0;
  virtual void count(StructureTime& row) = 0;
};

class OurContestant : public Contestant {
 public:
  OurContestant(StructureKind kind, const StructureConfig<2>& config,
                std::span<const Proxy<2>> boxes)
      : structure_(make_structure<2>(kind, config)), in_leaves_(traits_of(kind).meets_in_leaves) {
    for (const Proxy<2>& box : boxes) items_.push_back({box.id, box.box});
  }
  void build() override { structure_->build(items_); }
  void find(Finds& finds) override {
    if (in_leaves_)
      return structure_->visit([&](const NodeView<2>& node) {
        finds.add_leaf(node.bodies);
        return true;
      });
    const auto all = [](BodyId) { return true; };
    structure_->compare(all, [&](BodyId a, BodyId b) {
      ++finds.tests;
      finds.add(a, b);
    });
  }
  void count(StructureTime& row) override {
    const Counters counters = structure_->counters();
    row.nodes = counters.nodes;
    row.entries = counters.entries;
  }

 private:
  std::unique_ptr<Structure<2>> structure_;
  bool in_leaves_;
  std::vector<Item<2>> items_;
};

class OwnContestant : public Contestant {
 public:
  OwnContestant(const OwnKind& kind, const StructureConfig<2>& config,
                std::span<const Proxy<2>> boxes)
      : kind_(kind), config_(config), boxes_(boxes) {}
  void build() override {
    if (!tree_ || !tree_->clear())
      tree_ = kind_.make(config_.bounds, config_.capacity, config_.max_depth);
    for (const Proxy<2>& box : boxes_) {
      stop_if_asked();
      tree_->insert(box.id, box.box);
    }
  }
  void find(Finds& finds) override {
    tree_->visit([&](const OwnNode& node) {
      for (const BodyId id : node.bodies)
        if (id >= boxes_.size())
          throw StructureFault(
              {fmt::format("structure '{}': a node lists a body of number {}, "
                           "which was never inserted",
                           kind_.name, id)});
      finds.add_leaf(node.bodies);
    });
  }
  void count(StructureTime& row) override {
    row.nodes = row.entries = 0;
    tree_->visit([&](const OwnNode& node) {
      ++row.nodes;
      row.entries += node.bodies.size();
    });
  }

 private:
  const OwnKind& kind_;
  StructureConfig<2> config_;
  std::span<const Proxy<2>> boxes_;
  std::unique_ptr<OwnTree> tree_;
};

// Before its times mean anything: whether it can be read, and finds what there is.
void look_at(StructureKind kind, const StructureConfig<2>& config, std::span<const Proxy<2>> boxes,
             std::span<const Pair> truth, StructureTime& row) {
  BroadPhaseConfig<2> asked;
  static_cast<StructureConfig<2>&>(asked) = config;
  asked.kind = kind;
  asked.split_static = false;
  try {
    BroadPhase<2> broad_phase(asked);
    broad_phase.update(boxes);
    row.missed = count_missing(truth, broad_phase.pairs());
    row.invented = count_missing(broad_phase.pairs(), truth);
    const auto name = [](BodyId id) { return fmt::format("body {}", id); };
    if (const auto faults = broad_phase.faults(); !faults.empty())
      row.fault = text_of(faults.front(), name);
  } catch (const StructureFault& broken) {
    row.fault = broken.what();
  } catch (const Refused& refused) {
    row.fault = refused.what();
  }
}

struct Turn {
  std::unique_ptr<Contestant> contestant;
  std::vector<double> build, pairs;
};

void take_turn(Turn& turn, Finds& finds) {
  finds.pairs.clear();
  finds.tests = 0;
  const CpuStopwatch build;
  turn.contestant->build();
  turn.build.push_back(build.seconds());
  const CpuStopwatch pairs;
  turn.contestant->find(finds);
  turn.pairs.push_back(pairs.seconds());
}

class SceneBench {
 public:
  SceneBench(const StructureBench& bench, std::uint64_t bodies, BoxSort sort, const char* name)
      : bench_(bench),
        boxes_(seeded_boxes<2>(sort, bodies, bench.seed)),
        truth_(pairs_by_force<2>(boxes_.frames[0])),
        name_(name) {
    config_.bounds = boxes_.bounds;
    config_.capacity = kBenchCapacity;
    config_.max_depth = kBenchDepth;
  }

  std::vector<StructureTime> rows(const std::function<void()>& told) {
    Finds finds{boxes_.frames[0], {}, 0};
    for (const StructureKind kind : bench_.kinds) enter(kind, finds);
    for (int round = 0; round < bench_.rounds; ++round)
      for (std::size_t i = 0; i < rows_.size(); ++i)
        if (rows_[i].fault.empty()) take_turn(turns_[i], finds);
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      rows_[i].build = timing_of(turns_[i].build);
      rows_[i].pairs = timing_of(turns_[i].pairs);
      told();
    }
    return std::move(rows_);
  }

 private:
  void enter(StructureKind kind, Finds& finds) {
    StructureTime& row = rows_.emplace_back();
    row.kind = kind;
    row.scene = name_;
    row.bodies = boxes_.frames[0].size();
    Turn& turn = turns_.emplace_back();
    look_at(kind, config_, boxes_.frames[0], truth_, row);
    if (!row.fault.empty()) return;
    if (const OwnKind* own = own_structure(kind))
      turn.contestant = std::make_unique<OwnContestant>(*own, config_, boxes_.frames[0]);
    else
      turn.contestant = std::make_unique<OurContestant>(kind, config_, boxes_.frames[0]);
    take_turn(turn, finds);  // for warmth
    row.pair_tests = finds.tests;
    turn.contestant->count(row);
    if (turn.build[0] + turn.pairs[0] > bench_.longest)
      row.fault = fmt::format("one build and search takes {:.1f} s, more than {:g} s",
                              turn.build[0] + turn.pairs[0], bench_.longest);
    turn.build.clear();
    turn.pairs.clear();
  }

  const StructureBench& bench_;
  BoxUpdates<2> boxes_;
  std::vector<Pair> truth_;
  std::string name_;
  StructureConfig<2> config_;
  std::vector<StructureTime> rows_;
  std::vector<Turn> turns_;
};

std::string microseconds(const Timing& time) {
  return time.repeats == 0 ? "–" : fmt::format("{:.1f}", 1e6 * time.median);
}

}  // namespace

std::uint64_t structure_bench_rows(const StructureBench& bench) {
  return 2 * bench.kinds.size() * bench.bodies.size();
}

std::vector<StructureTime> bench_structures(const StructureBench& bench,
                                            const std::function<void()>& told) {
  std::vector<StructureTime> all;
  for (const std::uint64_t bodies : bench.bodies)
    for (const auto& [sort, name] : {std::pair(BoxSort::uniform, "uniform_2d"),
                                     std::pair(BoxSort::clustered, "clustered_2d")}) {
      const std::vector<StructureTime> rows = SceneBench(bench, bodies, sort, name).rows(told);
      all.insert(all.end(), rows.begin(), rows.end());
    }
  return all;
}

std::string to_table(std::span<const StructureTime> rows) {
  std::string text = fmt::format(
      "Microseconds, medians of turns; capacity {}, depth limit {}. Of your own structures insert "
      "and visit are timed.\n{:<14}{:>7}  {:<18}{:>10}{:>10}{:>10}{:>8}{:>9}{:>11}\n",
      kBenchCapacity, kBenchDepth, "scene", "bodies", "structure", "build", "pairs", "both",
      "nodes", "entries", "pair tests");
  for (const StructureTime& row : rows) {
    text += fmt::format("{:<14}{:>7}  {:<18}", row.scene, row.bodies, to_string(row.kind));
    if (!row.fault.empty()) {
      text += fmt::format("not timed: {}\n", row.fault);
      continue;
    }
    text += fmt::format("{:>10}{:>10}{:>10.1f}{:>8}{:>9}{:>11}\n", microseconds(row.build),
                        microseconds(row.pairs), 1e6 * (row.build.median + row.pairs.median),
                        row.nodes, row.entries, row.pair_tests);
  }
  return text;
}

std::string to_csv(std::span<const StructureTime> rows) {
  std::string text =
      "scene,bodies,structure,build_s,pairs_s,nodes,entries,pair_tests,missed,invented\n";
  for (const StructureTime& row : rows)
    if (row.fault.empty())
      text += fmt::format("{},{},{},{:.9g},{:.9g},{},{},{},{},{}\n", row.scene, row.bodies,
                          to_string(row.kind), row.build.median, row.pairs.median, row.nodes,
                          row.entries, row.pair_tests, row.missed, row.invented);
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
    json.end_object();
  }
  json.line().end_array().line().end_object();
  return json.text() + "\n";
}

}  // namespace lantern::spatial
