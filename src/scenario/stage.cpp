#include "scenario/stage.hpp"

#include <algorithm>
#include <map>
#include <type_traits>

#include <fmt/format.h>

#include "base/check.hpp"
#include "spatial/pairs.hpp"

namespace lantern {
namespace {

// "front.back" of the BSP node that lies behind the plane in front of the root's plane.
std::string bsp_label(const std::string& parent, std::uint32_t slot) {
  const std::string side = slot == 0 ? "back" : "front";
  return parent == "root" ? side : parent + "." + side;
}

std::string child_label(const std::string& parent, std::uint32_t slot) {
  const std::string number = fmt::format("{}", slot + 1);
  return parent == "root" ? number : parent + "." + number;
}

std::vector<BspPlane<2>> planes_of(const StructureSpec& spec) {
  std::vector<BspPlane<2>> planes;
  std::map<std::string, std::uint32_t> node_at;  // way from the root -> index
  for (const PlaneSpec& p : spec.planes) {
    BspPlane<2> plane{Plane<2>::through(p.point, p.normal), kNone, false};
    if (p.at != "root") {
      const std::size_t dot = p.at.rfind('.');
      const std::string parent = dot == std::string::npos ? "root" : p.at.substr(0, dot);
      plane.parent = node_at.at(parent);
      plane.front = p.at.substr(dot == std::string::npos ? 0 : dot + 1) == "front";
    }
    node_at[p.at] = static_cast<std::uint32_t>(planes.size());
    planes.push_back(plane);
  }
  return planes;
}

Mark mark_of(const Touched& touched, NodeHandle node) {
  if (touched.lit.contains(node)) return Mark::lit;
  return touched.passed.contains(node) ? Mark::passed : Mark::quiet;
}

Box<2> bounding_box_of(const Polygon& region, const Box<2>& fallback) {
  if (region.empty()) return fallback;
  Box<2> box{region[0], region[0]};
  for (const Vec<2>& corner : region) box = united(box, Box<2>{corner, corner});
  return box;
}

}  // namespace

std::string settings_text(const StructureSpec& s) {
  switch (s.kind) {
    case StructureKind::none:
      return "";
    case StructureKind::brute_force:
      return "every body with every other";
    case StructureKind::bsp:
      return fmt::format("{} dividing line{}", s.planes.size(), s.planes.size() == 1 ? "" : "s");
    default:
      break;
  }
  return fmt::format("capacity {}, depth limit {}, {}{}", s.capacity, s.max_depth,
                     s.children == Children::eager ? "all children made" : "children on demand",
                     s.no_progress_stop ? ", stops without progress" : "");
}

Stage::Stage(const Scenario& scenario, Work& work)
    : scenario_(scenario), work_(work), spec_(scenario.structure), ids_(scenario.bodies.size()) {
  if (!scenario.bodies.empty()) {
    world_.emplace();
    ++work_.worlds_created;
  }
  make_structure();
  if (!scenario.atlas) return;
  atlas_.emplace(scenario.atlas->width, scenario.atlas->height);
  ++work_.atlases_created;
  for (std::size_t i = 0; i < scenario.textures.size(); ++i) {
    const TextureSpec& t = scenario.textures[i];
    FrameTexture texture;
    texture.id = static_cast<std::uint32_t>(i);
    texture.name = t.name;
    texture.color = t.color;
    texture.width = t.width;
    texture.height = t.height;
    textures_.push_back(texture);
  }
}

void Stage::make_structure() {
  switch (spec_.kind) {
    case StructureKind::none:
      tree_.emplace<std::monostate>();
      return;
    case StructureKind::brute_force:
      tree_.emplace<BruteForce<2>>();
      break;
    case StructureKind::quadtree: {
      Quadtree::Config config;
      config.bounds = scenario_.bounds;
      config.capacity = spec_.capacity;
      config.max_depth = spec_.max_depth;
      config.eager_children = spec_.children == Children::eager;
      config.no_progress_stop = spec_.no_progress_stop;
      config.most_entries = kMostEntries;
      tree_.emplace<Quadtree>(config);
      break;
    }
    case StructureKind::bsp:
      tree_.emplace<Bsp<2>>(planes_of(spec_), scenario_.bounds);
      break;
    default:
      break;
  }
  ++work_.structures_created;
}

template <class F>
void Stage::with_structure(F&& f) const {
  std::visit(
      [&](const auto& tree) {
        if constexpr (!std::is_same_v<std::decay_t<decltype(tree)>, std::monostate>) f(tree);
      },
      tree_);
}

const Body<2>* Stage::body(std::size_t index) const {
  if (!ids_[index]) return nullptr;
  for (const Body<2>& body : world_->bodies())
    if (body.id == *ids_[index]) return &body;
  return nullptr;
}

void Stage::enter(std::size_t index) {
  const BodySpec& spec = scenario_.bodies[index];
  Body<2> body;
  body.name = spec.name;
  body.shape = spec.shape;
  body.position = spec.position;
  body.velocity = spec.velocity;
  if (spec.is_static) body.kind = BodyKind::static_body;
  ids_[index] = world_->add(std::move(body));
  index_of_.push_back(index);
}

void Stage::store(std::size_t index, const Watch& watch) {
  const Body<2>* entered = body(index);
  LANTERN_CHECK(entered != nullptr, ==, true);
  const Item<2> item{entered->id, entered->box()};
  std::visit(
      [&](auto& tree) {
        if constexpr (!std::is_same_v<std::decay_t<decltype(tree)>, std::monostate>) {
          if (watch)
            tree.insert(item, watch);
          else
            tree.insert(item);
        }
      },
      tree_);
}

void Stage::leave(std::size_t index) {
  world_->remove(*ids_[index]);
  ids_[index].reset();
}

void Stage::place(std::size_t index, const Vec<2>& position, const Vec<2>& velocity) {
  world_->place(*ids_[index], position, velocity);
}

void Stage::let_time_pass() {
  if (world_) {
    world_->step(scenario_.time_step);
    ++work_.world_steps;
  }
  time_ += scenario_.time_step;
}

void Stage::rebuild() {
  std::visit(
      [&](auto& tree) {
        if constexpr (!std::is_same_v<std::decay_t<decltype(tree)>, std::monostate>) {
          tree.clear();
          for (const Body<2>& body : world_->bodies()) tree.insert({body.id, body.box()});
        }
      },
      tree_);
}

void Stage::rebuild_as(const StructureSpec& structure) {
  spec_ = structure;
  make_structure();
  rebuild();
}

std::optional<Rect> Stage::pack(std::size_t index, const AtlasWatch& watch) {
  FrameTexture& texture = textures_[index];
  const auto rect = watch ? atlas_->insert(texture.id, texture.width, texture.height, watch)
                          : atlas_->insert(texture.id, texture.width, texture.height);
  texture.refused = !rect;
  return rect;
}

std::vector<std::uint32_t> Stage::free_leaves() const {
  std::vector<std::uint32_t> handles;
  atlas_->visit([&](const AtlasNodeView& node) {
    if (node.leaf && !node.texture) handles.push_back(node.handle);
    return true;
  });
  return handles;
}

void Stage::name_free_leaf(const std::string& name, const std::vector<std::uint32_t>& before) {
  std::int64_t largest = 0;
  std::uint32_t handle = 0;
  atlas_->visit([&](const AtlasNodeView& node) {
    const std::int64_t area = std::int64_t{node.rect.width} * node.rect.height;
    const bool is_new = std::find(before.begin(), before.end(), node.handle) == before.end();
    if (node.leaf && !node.texture && is_new && area > largest) {
      largest = area;
      handle = node.handle;
    }
    return true;
  });
  if (largest > 0) free_names_[handle] = name;
}

bool Stage::ask_room(int width, int height) {
  room_ = atlas_->has_room(width, height);
  return *room_;
}

std::string Stage::label_of(NodeHandle handle) const {
  std::vector<std::string> labels;
  std::string found;
  const bool is_bsp = std::holds_alternative<Bsp<2>>(tree_);
  with_structure([&](const auto& tree) {
    tree.visit([&](const NodeView<2>& node) {
      labels.push_back(node.parent == kNone
                           ? "root"
                           : (is_bsp ? bsp_label : child_label)(labels[node.parent], node.slot));
      if (node.handle == handle) found = labels.back();
      return found.empty();
    });
  });
  return found;
}

std::string Stage::atlas_label_of(std::uint32_t handle) const {
  std::string found;
  atlas_->visit([&](const AtlasNodeView& node) {
    if (node.handle != handle) return true;
    const auto name = free_names_.find(handle);
    if (node.texture)
      found = textures_[*node.texture].name;
    else if (name != free_names_.end())
      found = name->second;
    else
      found = fmt::format("of {} × {}", node.rect.width, node.rect.height);
    return true;
  });
  return found;
}

void Stage::picture_bodies(Frame& frame) const {
  for (const Body<2>& body : world_->bodies()) {
    const BodySpec& spec = scenario_.bodies[index_of_[body.id]];
    FrameBody b;
    b.id = body.id;
    b.name = body.name;
    b.look = spec.look;
    b.color = spec.color;
    b.shape = in_dimension<3>(body.shape);
    b.position = solid(body.position);
    b.velocity = solid(body.velocity);
    b.box = solid(body.box());
    b.is_static = !body.moves();
    frame.bodies.push_back(std::move(b));
  }
  frame.counts.emplace_back("bodies", frame.bodies.size());
}

void Stage::picture_tree(const Touched& touched, Frame& frame) const {
  with_structure([&](const auto& tree) {
    constexpr bool is_bsp = std::is_same_v<std::decay_t<decltype(tree)>, Bsp<2>>;
    std::size_t most_in_leaf = 0;
    tree.visit([&](const NodeView<2>& view) {
      FrameNode node;
      node.id = view.id;
      node.parent = view.parent;
      node.slot = view.slot;
      node.depth = view.depth;
      node.leaf = view.leaf;
      node.box = solid(view.box);
      node.bodies.assign(view.bodies.begin(), view.bodies.end());
      node.mark = mark_of(touched, view.handle);
      node.label = "root";
      if (view.parent != kNone) {
        const FrameNode& parent = frame.nodes[view.parent];
        node.label = (is_bsp ? bsp_label : child_label)(parent.label, view.slot);
        if (is_bsp) node.region = clipped(parent.region, flat(*parent.plane), view.slot == 1);
      } else if (is_bsp) {
        node.region = polygon_of(flat(frame.bounds));
      }
      // Brute force has no cells: its one node is the whole world.
      if (spec_.kind == StructureKind::brute_force) node.box = frame.bounds;
      if (is_bsp) {
        node.box = solid(bounding_box_of(node.region, view.box));
        if (view.plane) {
          node.plane = solid(*view.plane);
          for (const PlaneSpec& p : spec_.planes)
            if (p.at == node.label) node.plane_name = p.name;
        }
      }
      node.over_capacity =
          spec_.kind == StructureKind::quadtree && node.bodies.size() > spec_.capacity;
      most_in_leaf = std::max(most_in_leaf, node.bodies.size());
      frame.nodes.push_back(std::move(node));
      return true;
    });
    const CandidatePairs candidates = candidate_pairs(tree, kMostPairs);
    std::uint64_t overlaps = 0;
    const auto box_of = [&](BodyId id) {
      return std::lower_bound(frame.bodies.begin(), frame.bodies.end(), id,
                              [](const FrameBody& b, BodyId wanted) { return b.id < wanted; })
          ->box;
    };
    for (const Pair& pair : candidates.pairs) {
      frame.pairs.push_back({pair, false});
      if (overlap(box_of(pair.a), box_of(pair.b))) ++overlaps;
    }
    const Counters c = tree.counters();
    const auto count = [&](const char* name, std::uint64_t n) {
      frame.counts.emplace_back(name, static_cast<std::int64_t>(n));
    };
    count("nodes", c.nodes);
    count("leaves", c.leaves);
    count("depth", c.depth);
    count("entries", c.entries);
    count("most_in_leaf", most_in_leaf);
    count("pairs", candidates.pairs.size());
    count("pair_tests", candidates.pair_tests);
    count("all_pairs", all_pairs(frame.bodies.size()));
    count("overlaps", overlaps);
    count("contacts", 0);
    count("box_tests", c.box_tests);
    count("splits", c.splits);
    count("nodes_reused", c.nodes_reused);
    count("allocations", c.allocations);
  });
}

void Stage::picture_atlas(const Touched& touched, Frame& frame) const {
  std::int64_t free_leaves = 0, leaves = 0, depth = 0, packed = 0, refused = 0;
  frame.textures = textures_;
  atlas_->visit([&](const AtlasNodeView& view) {
    FrameNode node;
    node.id = view.id;
    node.parent = view.parent;
    node.slot = view.slot;
    node.depth = view.depth;
    node.leaf = view.leaf;
    const Rect& r = view.rect;
    node.box = {{r.x, r.y, 0}, {double(r.x) + r.width, double(r.y) + r.height, 0}};
    node.cut_vertically = view.cut_vertically;
    if (view.texture) {
      FrameTexture& texture = frame.textures[*view.texture];
      texture.packed = true;
      texture.x = r.x;
      texture.y = r.y;
      node.bodies = {*view.texture};
      node.label = texture.name;
    } else if (view.leaf) {
      const auto name = free_names_.find(view.handle);
      if (name != free_names_.end()) node.label = name->second;
      ++free_leaves;
    } else if (view.parent == kNone) {
      node.label = "root";
    }
    node.mark = mark_of(touched, view.handle);
    leaves += view.leaf;
    depth = std::max<std::int64_t>(depth, view.depth);
    frame.nodes.push_back(std::move(node));
    return true;
  });
  for (const FrameTexture& t : frame.textures) {
    packed += t.packed;
    refused += t.refused;
  }
  frame.counts.insert(frame.counts.end(),
                      {{"nodes", std::int64_t(frame.nodes.size())},
                       {"leaves", leaves},
                       {"depth", depth},
                       {"textures", packed},
                       {"refused", refused},
                       {"used_area", atlas_->used_area()},
                       {"free_area", atlas_->free_area()},
                       {"atlas_area", std::int64_t{atlas_->width()} * atlas_->height()},
                       {"free_leaves", free_leaves},
                       {"leaf_tests", static_cast<std::int64_t>(atlas_->leaf_tests())}});
  if (room_) frame.counts.emplace_back("room", *room_);
}

void Stage::picture(const Touched& touched, Frame& frame) const {
  frame.time = time_;
  frame.bounds = solid(scenario_.bounds);
  frame.structure = spec_.kind;
  frame.settings = settings_text(spec_);
  if (world_) picture_bodies(frame);
  if (world_ && spec_.kind == StructureKind::none)
    frame.counts.emplace_back("all_pairs", all_pairs(frame.bodies.size()));
  picture_tree(touched, frame);
  if (atlas_) picture_atlas(touched, frame);
  frame.hash = state_hash(frame);
}

}  // namespace lantern
