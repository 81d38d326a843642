// Which boxes of the bodies of one structure overlap: the search, and what it needs beside the
// structure. Compiled into each structure; see structure_of.hpp.
#pragma once

#include "base/stop.hpp"
#include "spatial/box_table.hpp"
#include "spatial/pairs.hpp"
#include "spatial/structure.hpp"

namespace lantern::spatial {

// Which nodes are awake (the lecture, "Sleeping Objects"): those below which an awake body lies.
class AwakeNodes {
 public:
  // Looks at all `nodes` of a structure, which walk(f) visits; `awake(id) -> bool`. Memory is used
  // again. Children are visited after their parents, so one way back through the list wakes all
  // that lie above.
  template <class Walk, class Awake>
  void find(std::uint64_t nodes, Walk&& walk, Awake&& awake) {
    parents_.clear();
    handles_.clear();
    awake_.assign(nodes, 0);
    walk([&](const auto& node) {
      parents_.push_back(node.parent);
      handles_.push_back(node.handle);
      // There are gaps while bodies are on their way from one place to another.
      if (node.handle >= awake_.size()) awake_.resize(node.handle + std::size_t{1});
      awake_[node.handle] = std::ranges::any_of(node.bodies, awake);
      return true;
    });
    for (std::size_t i = handles_.size(); i-- > 1;)
      if (awake_[handles_[i]] != 0) awake_[handles_[parents_[i]]] = 1;
  }

  bool operator[](NodeHandle node) const { return awake_[node] != 0; }
  std::size_t places() const {
    return awake_.capacity() + parents_.capacity() + handles_.capacity();
  }

 private:
  std::vector<std::uint8_t> awake_;               // by handle
  std::vector<std::uint32_t> parents_, handles_;  // in the order of visiting
};

template <int D>
class PairSearch {
 public:
  // What was found, by the bodies' places, each pair perhaps more than once.
  FoundPairs found;
  std::uint64_t tests = 0;          // pairs met in leaves: boxes compared with boxes
  std::uint64_t nodes_visited = 0;  // while pairing
  std::uint64_t nodes_skipped = 0;  // whole branches in which all sleep, each counted once

  // From now on it is about the bodies of these boxes, whose ids are their places; without states
  // all stir. Nothing is found yet.
  void begin(std::span<const Box<D>> boxes, std::span<const ProxyState> states) {
    boxes_ = boxes;
    states_ = states;
    const auto stirring = std::ranges::count_if(states, std::mem_fn(&ProxyState::stirs));
    stirring_ = states.empty() ? boxes.size() : static_cast<std::size_t>(stirring);
    tests = nodes_visited = nodes_skipped = 0;
    found.clear();
  }
  // Pairs are those of which at least one stirs; so many do.
  std::size_t stirring() const { return stirring_; }
  bool stirs(std::size_t place) const { return states_.empty() || states_[place].stirs(); }
  const Box<D>& box(std::size_t place) const { return boxes_[place]; }

  // Of a tree in which two bodies meet where they share a leaf.
  template <class Tree>
  void in_leaves(const Tree& tree) {
    const auto walk = [&](auto&& f) { tree.take(Tour<D>{ids_}, f); };
    awake_.find(tree.counters().nodes, walk, [&](BodyId i) { return stirs(i); });
    walk([&](const NodeView<D>& node) {
      if (!awake_[node.handle]) {
        ++nodes_skipped;
        return false;
      }
      ++nodes_visited;
      pair_bodies(node.bodies);
      return true;
    });
  }

  // Of one in which bodies need not share a leaf to meet. Where most of them sleep, or the tree has
  // no way of its own, each of the others asks alone.
  template <class Tree>
  void by_itself(Tree& tree) {
    nodes_visited = tree.work().nodes;
    constexpr std::size_t kFew = 8;
    if constexpr (!Tree::kAsksForPairs)
      if (stirring_ == boxes_.size() || kFew * stirring_ > boxes_.size()) {
        tests += tree.find_pairs(boxes_, found);
        return drop_still_pairs();
      }
    for (std::uint32_t i = 0; i < boxes_.size(); ++i)
      if (stirs(i)) ask(tree, i);
  }

  // Places for which there is memory.
  std::size_t places() const {
    return ids_.capacity() + here_.capacity() + awake_.places() + leaf_.places() + found.places();
  }

 private:
  template <class Tree>
  void ask(const Tree& tree, std::uint32_t place) {
    stop_if_asked();
    const Box<D>& box = boxes_[place];
    ids_.clear();
    tree.near(box, ids_);
    for (const BodyId other : ids_) {
      if (other == place || (other < place && stirs(other))) continue;
      ++tests;
      if (overlap(box, boxes_[other])) found.add(place, other);
    }
  }

  // Each that stirs with all behind it; those that do not stand last.
  void pair_bodies(std::span<const BodyId> bodies) {
    std::size_t stirring = bodies.size();
    if (stirring_ < boxes_.size()) {
      here_.assign(bodies.begin(), bodies.end());
      stirring -= std::ranges::partition(here_, [&](BodyId i) { return stirs(i); }).size();
      bodies = here_;
    }
    tests += all_pairs(bodies.size()) - all_pairs(bodies.size() - stirring);
    constexpr std::size_t kFew = 8;  // up to here it costs more to arrange than to compare them
    if (bodies.size() <= kFew) {
      for (std::size_t i = 0; i < stirring; ++i)
        for (std::size_t j = i + 1; j < bodies.size(); ++j)
          if (overlap(boxes_[bodies[i]], boxes_[bodies[j]])) found.add(bodies[i], bodies[j]);
      return;
    }
    leaf_.resize(bodies.size());
    for (std::size_t i = 0; i < bodies.size(); ++i) leaf_.set(i, bodies[i], boxes_[bodies[i]]);
    RunScanner<D> runs(leaf_, leaf_, boxes_, found);
    const auto end = static_cast<std::uint32_t>(bodies.size());
    for (std::uint32_t i = 0; i < stirring; ++i) runs.add(i, i + 1, end);
    runs.finish();
  }

  void drop_still_pairs() {
    if (stirring_ == boxes_.size()) return;
    const std::span<BodyId> first = found.first(), second = found.second();
    std::size_t size = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (!stirs(first[i]) && !stirs(second[i])) continue;
      first[size] = first[i];
      second[size++] = second[i];
    }
    found.resize(size);
  }

  std::span<const Box<D>> boxes_;
  std::span<const ProxyState> states_;
  std::size_t stirring_ = 0;

  // Scratch, kept for its memory.
  std::vector<BodyId> ids_, here_;
  AwakeNodes awake_;
  BoxTable<D> leaf_;
};

// By bodies' places, which are named by their ranks when pairs are put in order.
template <int D>
struct OrderedSearch : PairSearch<D> {
  PairOrder order;
};

}  // namespace lantern::spatial
