// The world's structure, as a frame shows it: its nodes, the bodies in its leaves, the pairs that
// meet there, and its counts. There is no other structure: what is drawn is what physics uses.
#pragma once

#include <cmath>

#include <fmt/format.h>

#include "base/stop.hpp"
#include "base/words.hpp"
#include "frame/frame.hpp"
#include "frame/parts/panels.hpp"
#include "language/counts.hpp"
#include "language/specs.hpp"
#include "physics/world.hpp"
#include "run/engine.hpp"
#include "run/players.hpp"
#include "spatial/pair_search.hpp"
#include "spatial/pairs.hpp"

namespace lantern::run {

// --- what is counted here ---

inline constexpr CountDoc kStructureCounts[] = {
    {"nodes", when::tree, "", "Nodes of the tree.", Most::parts},
    {"leaves", when::tree, "leaf/leaves", "Nodes without children.", Most::parts},
    {"depth", when::tree, "level deep/levels deep",
     "Depth of the deepest node; the root has depth 0.", Most::depth},
    {"entries", when::structure, "entry/entries", "Bodies stored in leaves, each once a leaf.",
     Most::parts},
    {"entries_in_all", when::structure, "entry made so far/entries made so far",
     "Entries made since the scenario began, by all builds and insertions. A `grid` makes one "
     "for each body."},
    {"most_in_leaf", when::structure, "in the fullest leaf", "Bodies in the fullest leaf.",
     Most::bodies},
    {"pairs", when::structure, "candidate pair/candidate pairs",
     "Unique candidate pairs: bodies that share a leaf; of structures that compare boxes without "
     "leaves (`sort_and_sweep`, `grid`, `aabb_tree`) those that are compared.",
     Most::pairs},
    {"pair_tests", when::structure, "pair met/pairs met",
     "Pairs met, leaf by leaf or box by box, before duplicates fell out."},
    {"all_pairs", when::bodies, "pair in all/pairs in all",
     "All pairs there are: n(n−1)/2 of n bodies.", Most::pairs},
    {"testable_pairs", when::bodies, "by brute force",
     "Those of them that brute force would test: not both never move.", Most::pairs},
    {"overlaps", when::structure, "overlap of boxes/overlaps of boxes",
     "Candidate pairs whose boxes overlap: of these the narrow phase tests all that may collide.",
     Most::pairs},
    {"pairs_lost", when::printed, "pair lost/pairs lost",
     "Pairs met that the lecture's text takes for others, as they have the same key.", Most::pairs},
    {"box_tests", when::inside, "",
     "Tests of a body against a node or plane since the tree was built; of `sort_and_sweep`, "
     "comparisons while sorting; of a `grid`, bodies put into their cells; of an `aabb_tree`, when "
     "it last followed its bodies."},
    {"tests", when::inside, "test in all/tests in all",
     "`box_tests` and `pair_tests` together: all that finding the pairs has taken."},
    {"splits", when::structure, "", "Leaves that split since the tree was built."},
    {"static_builds", when::split, "static build/static builds",
     "How often the structure of what never moves was built."},
    {"dynamic_builds", when::split, "dynamic build/dynamic builds",
     "How often the structure of what moves was built."},
    {"nodes_asleep", when::asleep_nodes, "node asleep/nodes asleep",
     "Nodes in and below which nothing moves now, the structure of what never moves apart."},
    {"leaves_asleep", when::asleep_nodes, "leaf asleep/leaves asleep",
     "Those of them that are leaves."},
    {"branches_asleep", when::asleep_nodes, "branch asleep/branches asleep",
     "The topmost of them: a search for pairs skips each with all below it."},
    {"stale", when::kd_tree, "out of its cell/out of their cells",
     "Bodies that have left the cells which a `kd_tree` fitted to them."},
    {"swaps", when::sweep, "",
     "Neighbours that changed places when the sweep sorted its boxes last, by insertion."},
    {"reinserted", when::boxes, "body inserted again/bodies inserted again",
     "Bodies that had left their boxes when an `aabb_tree` last followed its bodies, and were "
     "inserted again."},
    {"refitted", when::boxes, "box made anew/boxes made anew",
     "The same of those whose boxes were made anew where they stand."},
    {"nodes_reused", when::inside, "node reused/nodes reused",
     "Nodes that took an old node's place instead of new memory."},
    {"allocations", when::inside, "", "Calls for memory since the structure was made."},
    {"slots", when::array, "", "Places of the array that all leaves share."},
    {"node_bytes", when::array, "byte of nodes/bytes of nodes", "Memory that the nodes take."},
    {"node_bytes_with_bounds", when::array, "byte with bounds/bytes with bounds",
     "What they would take if each stored its box."}};
inline constexpr CountDoc kStructureMeasures[] = {
    {"tree_cost", when::boxes, "",
     "Sum of the perimeters, in a 3D world of the surfaces, of all inner nodes' boxes.", Most::size,
     "units"}};

// Of a child of the node `parent`: "1.3", or in a BSP "front.back"; children of the root have no
// prefix. Of a grid's node that is no cell: a level, "L1", or a bucket, "B17".
inline std::string child_label(const StructureSpec& spec, const std::string& parent,
                               std::uint32_t slot, bool leaf) {
  std::string way = fmt::format("{}", slot + 1);
  const NodeNames names = traits_of(spec.kind).names;
  if (names == NodeNames::sides) way = slot == 0 ? "back" : "front";
  if (names == NodeNames::cells) {
    const bool level = spec.levels > 1 && parent == "root";
    if (leaf && slot == kGridLarge)
      way = "large";
    else if (!leaf)
      way = fmt::format("{}{}", level ? 'L' : 'B', slot + 1);
  }
  return parent == "root" ? way : parent + "." + way;
}

// A node of a compiled level, by its place in the order of visiting: a leaf has its sector's
// number.
inline std::string level_label(const StructureSpec& spec, std::uint32_t id) {
  const std::uint32_t sector = spec.sectors.at(id);
  if (sector != kNone) return fmt::format("{}", sector + 1);
  return id == 0 ? "root" : "";
}

// "spatial hash, cells of 4, 3 levels"
inline std::vector<std::string> grid_settings(const StructureSpec& s) {
  std::vector<std::string> told;
  if (s.open) told.push_back(word("spatial hash"));
  told.push_back(s.cell == 0 ? word("cells that suit the bodies") : say("cells of {:g}", s.cell));
  if (s.levels != 1) told.push_back(say("{} levels", s.levels));
  return told;
}

// "capacity 2, depth limit 4, all children made"
inline std::string settings_text(const StructureSpec& s, int sweep_axis) {
  const StructureTraits& traits = traits_of(s.kind);
  std::vector<std::string> told;
  const auto tell = [&](std::string setting) { told.push_back(std::move(setting)); };
  const auto tell_limits = [&] {
    tell(say("capacity {}", s.capacity));
    tell(say("depth limit {}", s.max_depth));
  };
  bool split_before_last = false;
  if (s.kind == StructureKind::brute_force) {
    tell(word("every body with every other"));
  } else if (traits.has(Setting::axis)) {
    tell(say("sorted along {}, then swept", "xyz"[sweep_axis]));
  } else if (traits.has(Setting::planes)) {
    tell(say_count(s.planes.size(), "dividing line/dividing lines"));
  } else if (traits.has(Setting::cell)) {
    told = grid_settings(s);
  } else if (traits.has(Setting::margin)) {
    tell(word("a leaf for each body"));
    tell(s.margin > 0 ? say("boxes enlarged by {}", s.margin) : word("boxes not enlarged"));
  } else if (!traits.has(Setting::capacity)) {
    tell(word(traits.words));
  } else if (traits.is_own) {
    tell(word(traits.words));
    tell_limits();
    split_before_last = true;
    tell(word("events inferred"));
  } else if (traits.is_plain) {
    tell(word(s.as_printed ? "the lecture's code as printed" : "the lecture's own code"));
    tell_limits();
  } else {
    if (traits.is_fitted) tell(word("fitted to its bodies"));
    tell_limits();
    if (!traits.is_fitted) {
      tell(word(s.eager_children ? "all children made" : "children on demand"));
      if (s.no_progress_stop) tell(word("stops without progress"));
    }
  }
  if (s.split_static)
    told.insert(told.end() - (split_before_last ? 1 : 0), word("static bodies apart"));
  return fmt::format("{}", fmt::join(told, ", "));
}

// Fills a frame with the nodes of one structure after another.
template <int D>
class NodePicture {
 public:
  NodePicture(const StructureSpec& spec, const Touched& touched, Frame& frame)
      : spec_(spec), touched_(touched), frame_(frame) {
    for (std::uint32_t i = 0; i < touched.met.size(); ++i) met_.emplace(touched.met[i], i);
  }

  // `awake`: null if nothing sleeps.
  void add(const StructureView<D>& structure, const AwakeNodes* awake, bool of_static) {
    first_ = static_cast<std::uint32_t>(frame_.nodes.size());
    now_ = structure.counters();
    structure.visit([&](const NodeView<D>& view) {
      add_node(view, awake, of_static);
      return true;
    });
    add_counters(now_, of_static);
  }

  Counters counters;  // of all structures together
  std::uint64_t most_in_leaf = 0;

 private:
  void add_node(const NodeView<D>& view, const AwakeNodes* awake, bool of_static) {
    stop_if_asked();
    FrameNode node = frame_node(view);
    node.of_static = of_static;
    if (!of_static) mark(node, view.handle);
    // The array of what moves is pictured; that of what does not is another one.
    if (shows_memory_ && !of_static) {
      node.first = view.first;
      node.room = view.room;
    }
    if (shows_pool_ && !of_static && now_.pool > 0) {
      node.pool_slot = view.handle;
      node.reused = view.handle < now_.nodes_reused;
    }
    if (awake) node.awake = (*awake)[view.handle];
    most_in_leaf = std::max<std::uint64_t>(most_in_leaf, node.bodies.size());
    frame_.nodes.push_back(std::move(node));
  }

  void mark(FrameNode& node, NodeHandle handle) {
    node.mark = touched_.mark_of(handle);
    node.skipped = touched_.skipped.contains(handle) ||
                   (node.parent != kNone && frame_.nodes[node.parent].skipped);
    if (!node.leaf) return;
    if (const auto at = met_.find(handle); at != met_.end()) node.met = at->second;
  }

  void add_counters(const Counters& c, bool of_static) {
    using C = Counters;
    for (const auto count :
         {&C::nodes, &C::leaves, &C::entries, &C::box_tests, &C::splits, &C::nodes_reused,
          &C::allocations, &C::places, &C::node_bytes, &C::swaps, &C::reinserted, &C::refitted})
      counters.*count += c.*count;
    counters.depth = std::max(counters.depth, c.depth);
    if (shows_memory_ && !of_static)
      frame_.add<FrameStructure>().array_size = static_cast<std::uint32_t>(c.places);
    if (shows_pool_ && !of_static)
      frame_.add<FrameStructure>().pool_size = static_cast<std::uint32_t>(c.pool);
  }

  FrameNode frame_node(const NodeView<D>& view) const {
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
    if (spec_.of_level)
      node.label = level_label(spec_, view.id);
    else if (parent)
      node.label = child_label(spec_, parent->label, view.slot, view.leaf);
    if (view.plane) node.plane = solid(*view.plane);
    if (traits_.has(Setting::planes)) place_in_bsp(node, parent);
    // What is no tree has no cells: its one node is the whole world.
    if (!traits_.is_tree) node.box = frame_.bounds;
    node.over_capacity = traits_.splits && node.bodies.size() > spec_.capacity;
    return node;
  }

  // A flat BSP's region is cut from its parent's.
  void place_in_bsp(FrameNode& node, const FrameNode* parent) const {
    for (const PlaneSpec& p : spec_.planes)
      if (node.plane && !spec_.of_level && p.at == node.label) node.plane_name = p.name;
    if constexpr (D == 2) {
      node.region = parent ? clipped(parent->region, flat(*parent->plane), node.slot == 1)
                           : polygon_of(flat(frame_.bounds));
      if (!node.region.empty()) node.box = solid(box_of(node.region));
    }
  }

  const StructureSpec& spec_;
  const StructureTraits& traits_ = traits_of(spec_.kind);
  const Touched& touched_;
  Frame& frame_;
  bool shows_memory_ = shows(frame_.panels, "memory");
  bool shows_pool_ = shows(frame_.panels, "pool");
  std::map<NodeHandle, std::uint32_t> met_;  // when a ray met them first
  Counters now_;                             // of the structure that is being added
  std::uint32_t first_ = 0;                  // node of the structure that is being added
};

// Leaves were met among inner nodes: now they count by themselves.
inline void number_leaves_met(Frame& frame) {
  std::vector<FrameNode*> leaves;
  for (FrameNode& node : frame.nodes)
    if (node.met != kNone) leaves.push_back(&node);
  std::ranges::sort(leaves, {}, &FrameNode::met);
  for (std::uint32_t i = 0; i < leaves.size(); ++i) leaves[i]->met = i;
}

// Nodes below which nothing is awake, and how many branches a walk for pairs leaves out for it.
struct Sleepers {
  std::uint64_t nodes = 0;
  std::uint64_t leaves = 0;
  std::uint64_t branches = 0;
};

inline Sleepers count_sleepers(const Frame& frame) {
  Sleepers asleep;
  for (const FrameNode& node : frame.nodes) {
    if (node.awake || node.of_static) continue;
    ++asleep.nodes;
    asleep.leaves += node.leaf;
    asleep.branches += node.parent == kNone || frame.nodes[node.parent].awake;
  }
  return asleep;
}

template <int D>
std::uint64_t count_stale(const World<D>& world) {
  return static_cast<std::uint64_t>(std::ranges::count_if(world.bodies(), [&](const Body<D>& body) {
    return world.broad_phase()->is_stale({body.id, body.box()});
  }));
}

// The sum of all inner nodes' surfaces; of what has no end, none.
inline void measure_boxes(Frame& frame) {
  double sum = 0;
  for (const FrameNode& node : frame.nodes) {
    if (node.leaf) continue;
    const Vec<3> size = node.box.size();
    sum += frame.dimension == 2 ? 2 * (size.x + size.y)
                                : 2 * (size.x * size.y + size.y * size.z + size.z * size.x);
  }
  if (std::isfinite(sum)) frame.measures.emplace_back("tree_cost", sum);
}

// Pairs of which a broad phase would test one: not both never move.
inline std::uint64_t testable_pairs_of(const Frame& frame) {
  std::uint64_t bodies = 0, never_move = 0;
  for (const FrameBody& body : frame.bodies) {
    bodies += body.has_volume;
    never_move += body.has_volume && body.is_static;
  }
  return testable_pairs(bodies, never_move);
}

// f(node, labels) for each node, until it gives false; `labels` are "root", "1.3", "front.back", of
// this structure's nodes up to this one.
template <int D>
void each_labelled(const StructureSpec& spec, const BroadPhase<D>& structure, auto&& f) {
  for (const StructureView<D>& tree : structure.each()) {
    std::vector<std::string> labels;
    bool goes_on = true;
    tree.visit([&](const NodeView<D>& node) {
      labels.push_back(spec.of_level ? level_label(spec, node.id)
                       : node.parent == kNone
                           ? "root"
                           : child_label(spec, labels[node.parent], node.slot, node.leaf));
      return goes_on = f(node, labels);
    });
    if (!goes_on) return;
  }
}

// Empty if there is no such node.
template <int D>
std::string label_of(const StructureSpec& spec, const BroadPhase<D>& structure, NodeHandle handle) {
  std::string found;
  each_labelled(spec, structure, [&](const NodeView<D>& node, const auto& labels) {
    if (node.handle == handle && found.empty()) found = labels.back();
    return found.empty();
  });
  return found;
}

// What each node has in it or below it.
template <int D>
Engine::Members members_of(const StructureSpec& spec, const BroadPhase<D>& structure) {
  Engine::Members members;
  std::vector<std::uint32_t> parents;
  each_labelled(spec, structure, [&](const NodeView<D>& node, const auto& labels) {
    parents.resize(labels.size() - 1);
    parents.push_back(node.parent);
    members[labels.back()];
    for (std::uint32_t at = node.id; at != kNone; at = parents[at])
      members[labels[at]].insert(node.bodies.begin(), node.bodies.end());
    return true;
  });
  return members;
}

// Nodes, pairs and counts of the world's structure as it stands. `tells_sleepers`: whether anything
// in this world may rest, so that nodes are told asleep from awake.
template <int D>
void picture_structure(const StructureSpec& spec, const World<D>& world, bool tells_sleepers,
                       const Touched& touched, const SweptSoFar* swept, Frame& frame) {
  frame.structure = spec.kind;
  if (spec.kind == StructureKind::none) {
    frame.add_count("all_pairs", all_pairs(frame.bodies.size()));
    frame.add_count("testable_pairs", testable_pairs_of(frame));
    return;
  }
  const BroadPhase<D>& structure = *world.broad_phase();
  const Arrangement arrangement = structure.arrangement();
  FrameStructure& told = frame.add<FrameStructure>();
  told.sweep_axis = arrangement.axis.value_or(0);
  told.settings = settings_text(spec, told.sweep_axis);
  told.capacity = traits_of(spec.kind).splits ? spec.capacity : 0;
  told.grid_levels = arrangement.levels;
  told.hashed = spec.open;
  if (swept) told.swept_to = swept->at;
  const auto awake = [&](BodyId id) { return world.find(id)->stirs(); };
  NodePicture<D> picture(spec, touched, frame);
  AwakeNodes nodes;
  const StructureView<D> dynamic = structure.dynamic();
  if (tells_sleepers)
    nodes.find(
        dynamic.counters().nodes, [&](NodeLook<D> look) { dynamic.visit(look); }, awake);
  picture.add(dynamic, tells_sleepers ? &nodes : nullptr, false);
  if (spec.split_static) picture.add(structure.fixed(), nullptr, true);
  number_leaves_met(frame);

  PairChain chain = world.pair_chain(kMostPairs);
  frame.as_printed = spec.as_printed;
  if (swept) {
    const auto unmet = [&](const Pair& pair) { return !swept->met.contains(pair); };
    std::erase_if(chain.pairs, unmet);
    std::erase_if(chain.overlapping, unmet);
    chain.met = chain.pairs.size();
  }
  for (const Pair& pair : chain.pairs)
    frame.pairs.push_back({pair, false, std::ranges::binary_search(chain.overlapping, pair)});
  for (FrameBody& body : frame.bodies)
    if (const auto stored = structure.box_of(body.id)) body.stored_box = solid(*stored);

  const Counters& c = picture.counters;
  frame.add_count("nodes", c.nodes);
  frame.add_count("leaves", c.leaves);
  frame.add_count("depth", c.depth);
  frame.add_count("entries", c.entries);
  frame.add_count("entries_in_all", structure.counters().entries_made);
  frame.add_count("most_in_leaf", picture.most_in_leaf);
  frame.add_count("pairs", chain.pairs.size());
  frame.add_count("pair_tests", chain.met);
  frame.add_count("all_pairs", all_pairs(frame.bodies.size()));
  frame.add_count("testable_pairs", testable_pairs_of(frame));
  frame.add_count("overlaps", chain.overlapping.size());
  if (spec.as_printed) frame.add_count("pairs_lost", chain.lost);
  const bool inside = !traits_of(spec.kind).is_own;
  if (inside) frame.add_count("box_tests", c.box_tests);
  if (inside) frame.add_count("tests", c.box_tests + chain.met);
  frame.add_count("splits", c.splits);
  if (inside) frame.add_count("nodes_reused", c.nodes_reused);
  if (inside) frame.add_count("allocations", c.allocations);
  if (c.node_bytes > 0) {
    frame.add_count("slots", c.places);
    frame.add_count("node_bytes", c.node_bytes);
    frame.add_count("node_bytes_with_bounds", c.node_bytes + c.nodes * sizeof(Box<D>));
  }
  if (arrangement.axis) frame.add_count("swaps", c.swaps);
  if (traits_of(spec.kind).follows) {
    frame.add_count("reinserted", c.reinserted);
    frame.add_count("refitted", c.refitted);
    measure_boxes(frame);
  }
  if (tells_sleepers) {
    const Sleepers asleep = count_sleepers(frame);
    frame.add_count("nodes_asleep", asleep.nodes);
    frame.add_count("leaves_asleep", asleep.leaves);
    frame.add_count("branches_asleep", asleep.branches);
  }
  if (spec.split_static) {
    frame.add_count("static_builds", structure.counters().static_builds);
    frame.add_count("dynamic_builds", structure.counters().dynamic_builds);
  }
  if (traits_of(spec.kind).is_fitted) frame.add_count("stale", count_stale(world));
}

}  // namespace lantern::run
