// The whole way of a step, from pairs met in leaves to impulses, worked out again from what each
// frame shows, bodies and nodes, and held against what the engine counted.
#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include <gtest/gtest.h>

#include "scenario/directing.hpp"
#include "spatial/query_walk.hpp"

namespace lantern::run {
namespace {

constexpr std::size_t kManyBodies = 150;

// Under the sanitizers, which take their time, the first frames of each run.
std::uint32_t most_frames([[maybe_unused]] const Scenario& scenario) {
#ifdef __SANITIZE_ADDRESS__
  return scenario.bodies.size() > kManyBodies ? 3 : 30;
#else
  return 4000;
#endif
}

// The same scenario with a frame after every step, so that each step's work can be foreseen.
Scenario frame_by_frame(const Scenario& scenario) {
  ScenarioSpec spec = scenario;
  spec.world.frame_every = 1;
  for (Step& step : spec.steps) {
    if (auto* run = std::get_if<Run>(&step.verb)) run->every = 1;
    if (auto* wait = std::get_if<Wait>(&step.verb)) wait->every = 1;
  }
  return Scenario(std::move(spec));
}

struct Expected {
  std::set<std::int64_t> met;  // of the sweep one of several: the frame does not say its axis
  std::vector<Pair> pairs;
  std::vector<Pair> overlapping;
};

class Chain {
 public:
  Chain(const Scenario& scenario, const Frame& frame) : frame_(frame) {
    std::map<std::string_view, const BodySpec*> spec_of;
    for (const BodySpec& spec : scenario.bodies) spec_of[spec.name] = &spec;
    for (const FrameBody& body : frame.bodies) {
      if (body.id >= known_.size()) known_.resize(body.id + 1);
      const BodySpec& spec = *spec_of.at(body.name);
      known_[body.id] = {&body, spec.kind, stirs(body, spec)};
    }
    for (const LinkSpec& link : scenario.links)
      if (link.kind != LinkSpec::Kind::spring && link.b)
        joined_.insert(std::minmax(scenario.bodies[link.a].name, scenario.bodies[*link.b].name));
  }

  const FrameBody& body(BodyId id) const { return *known_.at(id).body; }

  // Moves now.
  bool stirs(BodyId id) const { return known_.at(id).stirs; }

  // Does the narrow phase look at such a pair at all?
  bool is_tested(const Pair& pair) const {
    const bool dynamic = known_.at(pair.a).kind == BodyKind::dynamic_body ||
                         known_.at(pair.b).kind == BodyKind::dynamic_body;
    return dynamic && !joined_.contains(std::minmax(body(pair.a).name, body(pair.b).name));
  }

  Box<3> stored(BodyId id) const { return body(id).stored_box.value_or(body(id).box); }

  Expected expected() const {
    std::vector<Pair> met;  // as often as they meet
    const auto meet = [&](BodyId a, BodyId b) { met.push_back({std::min(a, b), std::max(a, b)}); };
    std::set<BodyId> of_static;
    for (const FrameNode& node : frame_.nodes)
      if (node.of_static) of_static.insert(node.bodies.begin(), node.bodies.end());
    if (frame_.structure == StructureKind::aabb_tree) {  // its leaves compare their boxes
      for (const FrameNode& a : frame_.nodes)
        for (const FrameNode& b : frame_.nodes) {
          if (!a.leaf || !b.leaf || a.bodies.empty() || b.bodies.empty() || a.id >= b.id) continue;
          if (overlap(a.box, b.box) && (stirs(a.bodies[0]) || stirs(b.bodies[0])))
            meet(a.bodies[0], b.bodies[0]);
        }
      return summed(met);
    }
    for (const FrameNode& node : frame_.nodes)
      if (node.leaf && node.of_static) {
        for (const FrameBody& b : frame_.bodies)
          if (!of_static.contains(b.id) && stirs(b.id) && reaches(stored(b.id), node))
            for (const BodyId id : node.bodies) meet(b.id, id);
      } else if (node.leaf) {
        for (std::size_t i = 0; i < node.bodies.size(); ++i)
          for (std::size_t j = i + 1; j < node.bodies.size(); ++j)
            if (stirs(node.bodies[i]) || stirs(node.bodies[j]))
              meet(node.bodies[i], node.bodies[j]);
      }
    return summed(met);
  }

 private:
  struct Known {
    const FrameBody* body = nullptr;
    BodyKind kind{};
    bool stirs = false;
  };

  static bool stirs(const FrameBody& body, const BodySpec& spec) {
    if (body.is_static) return false;
    if (spec.kind == BodyKind::dynamic_body) return !body.asleep;
    return body.velocity != Vec<3>(0.0) || spec.spin != 0;
  }

  // A cell at the rim of a quadtree or octree reaches outward without end.
  bool reaches(const Box<3>& box, const FrameNode& leaf) const {
    const FrameNode* root = &leaf;
    while (root->parent != kNone) root = &frame_.nodes[root->parent];
    if (frame_.structure == StructureKind::kd_tree || frame_.structure == StructureKind::aabb_tree)
      return overlap(box, leaf.box);
    return overlap(box, endless_at_rim(leaf.box, root->box, 0));
  }

  Expected summed(std::vector<Pair>& met) const {
    if (frame_.structure == StructureKind::grid) return of_grid();
    const auto times = static_cast<std::int64_t>(met.size());
    std::ranges::sort(met);
    met.erase(std::unique(met.begin(), met.end()), met.end());
    if (frame_.structure == StructureKind::sort_and_sweep) return swept(met);
    Expected all;
    for (const Pair& pair : met) add(all, pair);
    all.met = {times};
    return all;
  }

  // A grid compares bodies of cells next to each other, each pair once: more than share a cell, but
  // all that overlap among them.
  Expected of_grid() const {
    Expected all;
    for (const FramePair& p : frame_.pairs) all.pairs.push_back(p.pair);
    all.met = {std::int64_t(all.pairs.size())};
    Expected brute;
    for (std::size_t i = 0; i < frame_.bodies.size(); ++i)
      for (std::size_t j = i + 1; j < frame_.bodies.size(); ++j)
        if (const Pair pair{frame_.bodies[i].id, frame_.bodies[j].id};
            stirs(pair.a) || stirs(pair.b))
          add(brute, pair);
    all.overlapping = brute.overlapping;
    return all;
  }

  // The sweep compares those that overlap on one axis.
  Expected swept(const std::vector<Pair>& met) const {
    Expected best;
    for (int axis = 0; axis < frame_.dimension; ++axis) {
      Expected all;
      for (const Pair& pair : met) {
        const Box<3> a = stored(pair.a), b = stored(pair.b);
        if (a.lo[axis] <= b.hi[axis] && b.lo[axis] <= a.hi[axis]) add(all, pair);
      }
      all.met = {std::int64_t(all.pairs.size())};
      std::set<Pair> shown;
      for (const FramePair& p : frame_.pairs) shown.insert(p.pair);
      if (axis == 0 || std::set<Pair>(all.pairs.begin(), all.pairs.end()) == shown) best = all;
    }
    return best;
  }

  void add(Expected& all, const Pair& pair) const {
    all.pairs.push_back(pair);
    Box<3> a = stored(pair.a), b = stored(pair.b);
    if (frame_.dimension == 2) a.lo.z = a.hi.z = b.lo.z = b.hi.z = 0;
    if (overlap(a, b)) all.overlapping.push_back(pair);
  }

  const Frame& frame_;
  std::vector<Known> known_;  // by id
  std::set<std::pair<std::string, std::string>> joined_;
};

std::vector<Pair> pairs_of(const Frame& frame, bool overlapping) {
  std::vector<Pair> pairs;
  for (const FramePair& p : frame.pairs)
    if (p.overlaps || !overlapping) pairs.push_back(p.pair);
  return pairs;
}

// The frame's own chain: leaves, pairs, overlaps; contacts, points, impulses.
void expect_chain_of(const Frame& frame, const Chain& chain) {
  // A body that an aabb_tree inserts again is in no leaf meanwhile, and a sweep under way has not
  // found all.
  const bool waits = frame.structure == StructureKind::aabb_tree &&
                     frame.count("entries") < std::int64_t(frame.bodies.size());
  const bool midst = frame.get<FrameStructure>().swept_to || waits;
  if (frame.structure != StructureKind::none && !midst) {
    const Expected expected = chain.expected();
    EXPECT_TRUE(expected.met.contains(*frame.count("pair_tests"))) << *frame.count("pair_tests");
    EXPECT_EQ(pairs_of(frame, false), expected.pairs);
    EXPECT_EQ(pairs_of(frame, true), expected.overlapping);
    EXPECT_EQ(frame.count("pairs"), std::int64_t(expected.pairs.size()));
    EXPECT_EQ(frame.count("overlaps"), std::int64_t(expected.overlapping.size()));
    for (const FrameBody& b : frame.bodies) {
      if (!b.stored_box || !frame.count("contacts")) continue;
      EXPECT_EQ(united(*b.stored_box, b.box), *b.stored_box) << b.name << " sticks out of its box";
    }
  }
  if (!frame.count("contacts")) return;
  std::int64_t points = 0, impulses = 0;
  for (const FrameContact& contact : frame.contacts)
    for (const FrameContact::Point& point : contact.points) {
      ++points;
      impulses += point.impulse != 0;
    }
  EXPECT_EQ(frame.count("contacts"), std::int64_t(frame.contacts.size()));
  EXPECT_EQ(frame.count("contact_points"), points);
  EXPECT_EQ(frame.count("impulses"), impulses);
  EXPECT_LE(frame.count("pairs_tested"), frame.count("narrow_tests"));
}

// What the frame before foresaw is what the step did, if it searched once.
void expect_step_from(const Frame& before, const Frame& after, const Chain& chain) {
  if (!after.since_last_frame) return;
  const WorldWork& did = *after.since_last_frame;
  if (!after.count("contacts")) {
    EXPECT_EQ(did.broad_phases + did.pair_tests + did.candidate_pairs + did.narrow_tests, 0u)
        << "nobody collides, so nobody may look for pairs";
    return;
  }
  if (did.steps != 1 || did.broad_phases != 1 || before.structure == StructureKind::none) return;
  // What follows is asked about those alone that have moved on, and by rows of boxes.
  if (!traits_of(before.structure).follows) {
    EXPECT_EQ(std::int64_t(did.pair_tests), before.count("pair_tests"));
  }
  EXPECT_EQ(std::int64_t(did.candidate_pairs), before.count("overlaps"));
  const std::vector<Pair> overlapping = pairs_of(before, true);
  const auto tested = std::count_if(overlapping.begin(), overlapping.end(),
                                    [&](const Pair& pair) { return chain.is_tested(pair); });
  EXPECT_EQ(std::int64_t(did.narrow_pairs), tested);
  EXPECT_EQ(after.count("pairs_tested"), tested);
  for (const FrameContact& contact : after.contacts) {
    if (!chain.stirs(contact.pair.a) && !chain.stirs(contact.pair.b)) continue;
    EXPECT_TRUE(std::ranges::binary_search(overlapping, contact.pair))
        << chain.body(contact.pair.a).name << " touches what the broad phase did not hand on";
  }
}

class EveryPairChain : public testing::TestWithParam<std::string> {};

TEST_P(EveryPairChain, IsTheEngines) {
  const Scenario scenario = frame_by_frame(shipped(GetParam()));
  Work work;
  std::optional<Frame> before;
  direct(scenario, Pace::step, work, [&](const Frame& frame) {
    SCOPED_TRACE("frame " + std::to_string(frame.index) + ", " + frame.event);
    const Chain chain(scenario, frame);
    expect_chain_of(frame, chain);
    if (before && before->bodies.size() == frame.bodies.size())
      expect_step_from(*before, frame, Chain(scenario, *before));
    before = frame;
    return !HasFailure() && frame.index + 1 < most_frames(scenario);
  });
}

TEST_P(EveryPairChain, OfEachFrameIsThatOfItsNodes) {
  const Scenario scenario = shipped(GetParam());
  for (const Pace pace : {Pace::step, Pace::event}) {
    // Each of a crowd's many events lists all pairs.
    if (pace == Pace::event && scenario.bodies.size() > kManyBodies) break;
    Work work;
    direct(scenario, pace, work, [&](const Frame& frame) {
      SCOPED_TRACE("frame " + std::to_string(frame.index) + ", " + frame.event);
      expect_chain_of(frame, Chain(scenario, frame));
      return !HasFailure() && frame.index + 1 < most_frames(scenario);
    });
  }
}

INSTANTIATE_TEST_SUITE_P(Files, EveryPairChain, testing::ValuesIn(all_files()), test_name_of_file);

}  // namespace
}  // namespace lantern::run
