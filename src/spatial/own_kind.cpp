#include "spatial/own_kind.hpp"

#include <utility>

#include <fmt/format.h>

#include "base/stop.hpp"

namespace lantern::spatial {
namespace {

// Runs code that is not ours: what it throws is its fault, and says during what.
template <class F>
void call(const std::string& name, F&& f, const std::string& during,
          const std::vector<BodyId>& bodies = {}) {
  std::string words = "something that is no std::exception";
  try {
    return f();
  } catch (const std::exception& e) {
    words = e.what();
  } catch (...) {
  }
  throw StructureFault({fmt::format("structure '{}': {} threw: {}", name, during, words), bodies});
}

StructureConfig<2> flattened(const StructureConfig<3>& config) {
  return {.bounds = {{config.bounds.lo.x, config.bounds.lo.z},
                     {config.bounds.hi.x, config.bounds.hi.z}},
          .capacity = config.capacity,
          .max_depth = config.max_depth,
          .most_entries = config.most_entries};
}

}  // namespace

OwnFlat::OwnFlat(const OwnKind& kind, const StructureConfig<2>& config)
    : kind_(kind),
      rules_{kind.name, config.bounds, config.capacity, config.max_depth, config.most_entries},
      view_(config.bounds) {
  clear();
}

// Nobody wants to hear of it while forgetting.
void OwnFlat::clear() {
  ids_.clear();
  boxes_.clear();
  broken_ = nullptr;
  seen_ = false;
  try {
    renew();
    look();
  } catch (const StructureFault&) {
    broken_ = std::current_exception();
    view_ = OwnView(rules_.bounds);
    faults_.clear();
  }
}

void OwnFlat::renew() {
  bool cleared = false;
  if (tree_)
    call(
        rules_.name, [&] { cleared = tree_->clear(); }, "clear");
  if (cleared) return;
  tree_.reset();
  call(
      rules_.name, [&] { tree_ = kind_.make(rules_.bounds, rules_.capacity, rules_.max_depth); },
      "its constructor");
}

OwnView OwnFlat::looked() {
  if (broken_) std::rethrow_exception(broken_);
  OwnView before = std::exchange(view_, OwnView(*tree_, rules_, boxes_, view_));
  faults_ = view_.faults();
  for (OwnFault& fault : faults_)
    for (BodyId& body : fault.bodies) body = ids_[body];
  seen_ = true;
  return before;
}

void OwnFlat::put(const Item<2>& item) {
  if (broken_) std::rethrow_exception(broken_);
  require_valid(item);
  stop_if_asked();
  Box<2> cut;
  for (int i = 0; i < 2; ++i) {
    cut.lo[i] = std::clamp(item.box.lo[i], rules_.bounds.lo[i], rules_.bounds.hi[i]);
    cut.hi[i] = std::clamp(item.box.hi[i], rules_.bounds.lo[i], rules_.bounds.hi[i]);
  }
  seen_ = false;
  const auto place = static_cast<BodyId>(boxes_.size());
  ids_.push_back(item.id);
  boxes_.push_back(cut);
  call(rules_.name, [&] { tree_->insert(place, cut); }, "insert of {0}", {item.id});
}

std::uint64_t OwnFlat::near(const Box<2>& box, std::vector<BodyId>& ids) const {
  const auto& nodes = view_.nodes();
  const Box<2>& root = nodes[0].box;
  Box<2> cut;
  for (int i = 0; i < 2; ++i) {
    cut.lo[i] = std::clamp(box.lo[i], root.lo[i], root.hi[i]);
    cut.hi[i] = std::clamp(box.hi[i], root.lo[i], root.hi[i]);
  }
  cut = grown(cut, view_.slack());
  for (std::uint32_t i = 0; i < nodes.size();) {
    if (!overlap(nodes[i].box, cut)) {
      i = nodes[i].end;
      continue;
    }
    for (const BodyId place : view_.bodies(nodes[i])) ids.push_back(ids_[place]);
    ++i;
  }
  return 0;
}

// By how soon a ray along the direction comes to their middles.
std::vector<std::uint32_t> OwnFlat::children_of(std::uint32_t node, const Vec<2>& toward) const {
  const auto& nodes = view_.nodes();
  std::vector<std::uint32_t> children;
  for (std::uint32_t c = node + 1; c < nodes[node].end; c = nodes[c].end) children.push_back(c);
  if (toward != Vec<2>(0.0))
    std::ranges::stable_sort(
        children, {}, [&](std::uint32_t c) { return glm::dot(nodes[c].box.center(), toward); });
  return children;
}

OwnUpright::OwnUpright(const OwnKind& kind, const StructureConfig<3>& config)
    : flat_(kind, flattened(config)), bounds_(config.bounds) {}

NodeView<3> OwnUpright::risen(const NodeView<2>& view) const {
  return {.handle = view.handle,
          .id = view.id,
          .parent = view.parent,
          .slot = view.slot,
          .depth = view.depth,
          .leaf = view.leaf,
          .box = {{view.box.lo.x, bounds_.lo.y, view.box.lo.y},
                  {view.box.hi.x, bounds_.hi.y, view.box.hi.y}},
          .slack = view.slack,
          .bodies = view.bodies};
}

}  // namespace lantern::spatial
