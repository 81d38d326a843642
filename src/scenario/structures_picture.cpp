// The nodes, pairs and counts of a scene's structures, as a frame shows them.
#include <algorithm>
#include <type_traits>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/stop.hpp"
#include "scenario/structures.hpp"
#include "spatial/awake.hpp"
#include "spatial/pairs.hpp"

namespace lantern {
namespace {

Box<2> bounding_box_of(const Polygon& region, const Box<2>& fallback) {
  if (region.empty()) return fallback;
  Box<2> box{region[0], region[0]};
  for (const Vec<2>& corner : region) box = united(box, Box<2>{corner, corner});
  return box;
}

// The bodies of one frame, found by id.
template <int D>
class Register {
 public:
  explicit Register(std::span<const Resident<D>> residents) {
    for (const Resident<D>& r : residents) {
      if (r.item.id >= of_.size()) of_.resize(r.item.id + 1);
      of_[r.item.id] = &r;
    }
  }
  const Resident<D>& operator[](BodyId id) const { return *of_[id]; }
  bool awake(const Pair& pair) const { return of_[pair.a]->awake || of_[pair.b]->awake; }

 private:
  std::vector<const Resident<D>*> of_;
};

// Fills a frame with the nodes of one tree after another.
template <int D>
class TreePicture {
 public:
  TreePicture(const StructureSpec& spec, const Register<D>& bodies, bool only_awake, Frame& frame)
      : spec_(spec),
        bodies_(bodies),
        only_awake_(only_awake),
        shows_memory_(std::find(frame.panels.begin(), frame.panels.end(), Panel::memory) !=
                      frame.panels.end()),
        frame_(frame) {}

  template <class Tree>
  void add(const Tree& tree, const Touched& touched, bool of_static) {
    first_ = static_cast<std::uint32_t>(frame_.nodes.size());
    tree.visit([&](const NodeView<D>& view) {
      stop_if_asked();
      FrameNode node = frame_node(view);
      node.mark = touched.mark_of(view.handle);
      node.of_static = of_static;
      // The array of what moves is pictured; that of what does not is another one.
      if (shows_memory_ && !of_static) {
        node.first = view.first;
        node.room = view.room;
      }
      most_in_leaf = std::max<std::uint64_t>(most_in_leaf, node.bodies.size());
      frame_.nodes.push_back(std::move(node));
      return true;
    });
    if (only_awake_ && !of_static) mark_awake(tree);
    const Counters c = tree.counters();
    counters.nodes += c.nodes;
    counters.leaves += c.leaves;
    counters.depth = std::max(counters.depth, c.depth);
    counters.entries += c.entries;
    counters.box_tests += c.box_tests;
    counters.splits += c.splits;
    counters.nodes_reused += c.nodes_reused;
    counters.allocations += c.allocations;
    counters.places += c.places;
    counters.node_bytes += c.node_bytes;
    if (shows_memory_ && !of_static) frame_.array_size = static_cast<std::uint32_t>(c.places);
  }

  Counters counters;  // of all trees together
  std::uint64_t most_in_leaf = 0;
  std::int64_t nodes_asleep = 0;

 private:
  FrameNode frame_node(const NodeView<D>& view) const {
    const bool is_bsp = spec_.kind == StructureKind::bsp;
    FrameNode node;
    node.id = first_ + view.id;
    node.parent = view.parent == kNone ? kNone : first_ + view.parent;
    node.slot = view.slot;
    node.depth = view.depth;
    node.leaf = view.leaf;
    node.box = solid(view.box);
    node.bodies.assign(view.bodies.begin(), view.bodies.end());
    node.label = "root";
    const FrameNode* parent = node.parent == kNone ? nullptr : &frame_.nodes[node.parent];
    if (parent) node.label = child_label(spec_.kind, parent->label, view.slot);
    if (view.plane) node.plane = solid(*view.plane);
    if (is_bsp) place_in_bsp(node, parent);
    // Brute force and the sweep have no cells: their one node is the whole world.
    if (spec_.kind == StructureKind::brute_force || spec_.kind == StructureKind::sort_and_sweep)
      node.box = frame_.bounds;
    const bool has_capacity = !is_bsp && spec_.kind != StructureKind::brute_force &&
                              spec_.kind != StructureKind::sort_and_sweep;
    node.over_capacity = has_capacity && node.bodies.size() > spec_.capacity;
    return node;
  }

  // A flat BSP's region is cut from its parent's.
  void place_in_bsp(FrameNode& node, const FrameNode* parent) const {
    for (const PlaneSpec& p : spec_.planes)
      if (node.plane && p.at == node.label) node.plane_name = p.name;
    if constexpr (D == 2) {
      node.region = parent ? clipped(parent->region, flat(*parent->plane), node.slot == 1)
                           : polygon_of(flat(frame_.bounds));
      node.box = solid(bounding_box_of(node.region, flat(node.box)));
    }
  }

  // A node sleeps when nothing below it is awake.
  template <class Tree>
  void mark_awake(const Tree& tree) {
    const std::vector<bool> awake = awake_nodes(tree, [&](BodyId id) { return bodies_[id].awake; });
    for (std::size_t i = 0; i < awake.size(); ++i) {
      FrameNode& node = frame_.nodes[first_ + i];
      node.awake = awake[i];
      nodes_asleep += !node.awake && !node.bodies.empty();
    }
  }

  const StructureSpec& spec_;
  const Register<D>& bodies_;
  bool only_awake_;
  bool shows_memory_;
  Frame& frame_;
  std::uint32_t first_ = 0;  // node of the tree that is being added
};

// Pairs that share a leaf and of which one is awake; sleeping leaves are skipped.
template <int D, class Tree>
CandidatePairs awake_pairs(const Tree& tree, const Register<D>& bodies) {
  CandidatePairs found =
      pairs_where(tree, kMostPairs, [&](const Pair& p) { return bodies.awake(p); });
  found.pair_tests = 0;
  tree.visit([&](const NodeView<D>& node) {
    std::uint64_t resting = 0;
    for (const BodyId id : node.bodies) resting += !bodies[id].awake;
    found.pair_tests += all_pairs(node.bodies.size()) - all_pairs(resting);
    return true;
  });
  return found;
}

void add_pair(CandidatePairs& found, const Pair& pair) {
  if (found.pairs.size() == kMostPairs)
    throw Refused(fmt::format("more than {} candidate pairs; take fewer bodies", kMostPairs));
  found.pairs.push_back(pair);
}

// The sweep compares boxes itself: its pairs overlap, and its tests are those comparisons.
template <int D>
CandidatePairs swept_pairs(SortAndSweep<D> sweep, const Register<D>& bodies, bool only_awake) {
  CandidatePairs found;
  found.pair_tests = sweep.sweep([&](BodyId id) { return !only_awake || bodies[id].awake; },
                                 [&](BodyId a, BodyId b) {
                                   add_pair(found, {std::min(a, b), std::max(a, b)});
                                 });
  return found;
}

}  // namespace

template <int D>
void Structures<D>::picture(const Touched& touched, std::span<const Resident<D>> residents,
                            Frame& frame) const {
  frame.structure = spec_.kind;
  frame.settings = settings_text(spec_);
  if (!any()) return;
  const Register<D> bodies(residents);
  TreePicture<D> picture(spec_, bodies, only_awake_, frame);
  CandidatePairs candidates;
  std::uint64_t stale = 0;
  bool is_static = false;
  with_each([&](const auto& tree) {
    picture.add(tree, is_static ? Touched() : touched, is_static);
    using T = std::decay_t<decltype(tree)>;
    if (is_static) {
      // Who moves asks the structure of what does not.
      for (const Resident<D>& r : residents) {
        stop_if_asked();
        if (!r.is_static && r.awake)
          tree.query(r.item.box, [&](BodyId id) {
            add_pair(candidates, {std::min(id, r.item.id), std::max(id, r.item.id)});
            ++candidates.pair_tests;
          });
      }
    } else if constexpr (std::is_same_v<T, SortAndSweep<D>>) {
      candidates = swept_pairs(tree, bodies, only_awake_);
    } else {
      candidates = only_awake_ ? awake_pairs(tree, bodies) : candidate_pairs(tree, kMostPairs);
    }
    if constexpr (std::is_same_v<T, KdTree<D>>)
      for (const Resident<D>& r : residents)
        stale += is_for_static(r) == is_static && !tree.fits(r.item);
    is_static = true;
  });
  sort_pairs(candidates.pairs);
  std::uint64_t overlaps = 0;
  for (const Pair& pair : candidates.pairs) {
    frame.pairs.push_back({pair, false});
    overlaps += overlap(bodies[pair.a].item.box, bodies[pair.b].item.box);
  }
  const auto count = [&](const char* name, std::uint64_t n) {
    frame.counts.emplace_back(name, static_cast<std::int64_t>(n));
  };
  const Counters& c = picture.counters;
  count("nodes", c.nodes);
  count("leaves", c.leaves);
  count("depth", c.depth);
  count("entries", c.entries);
  count("most_in_leaf", picture.most_in_leaf);
  count("pairs", candidates.pairs.size());
  count("pair_tests", candidates.pair_tests);
  count("all_pairs", all_pairs(residents.size()));
  count("overlaps", overlaps);
  frame.counts.emplace_back("contacts", static_cast<std::int64_t>(frame.contacts.size()));
  count("box_tests", c.box_tests);
  count("splits", c.splits);
  count("nodes_reused", c.nodes_reused);
  count("allocations", c.allocations);
  if (c.node_bytes > 0) {
    count("slots", c.places);
    count("node_bytes", c.node_bytes);
    count("node_bytes_with_bounds", c.node_bytes + c.nodes * sizeof(Box<D>));
  }
  if (only_awake_) count("nodes_asleep", static_cast<std::uint64_t>(picture.nodes_asleep));
  if (spec_.split_static) {
    count("static_builds", static_builds_);
    count("dynamic_builds", dynamic_builds_);
  }
  if (spec_.kind == StructureKind::kd_tree) count("stale", stale);
}

template void Structures<2>::picture(const Touched&, std::span<const Resident<2>>, Frame&) const;
template void Structures<3>::picture(const Touched&, std::span<const Resident<3>>, Frame&) const;

}  // namespace lantern
