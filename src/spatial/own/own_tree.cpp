#include <exception>

#include "spatial/own/own_view.hpp"
#include "spatial/own_structure.hpp"
#include "spatial/structure_of.hpp"

namespace lantern::spatial {

// --- one view and the one before ---

// Nodes at the same place in the tree are the same node to who looks; others take what is free.
void OwnView::keep_handles(const OwnView& before) {
  std::vector<bool> taken(nodes_.size());
  std::vector<Node*> fresh;
  for (Node& node : nodes_) {
    if (node.parent == kNone) {
      node.before = 0;
    } else if (const std::uint32_t above = nodes_[node.parent].before; above != kNone) {
      before.each_child(above, [&](std::uint32_t c) {
        if (before.nodes_[c].slot == node.slot) node.before = c;
      });
    }
    if (node.before == kNone || before.nodes_[node.before].handle >= nodes_.size()) {
      fresh.push_back(&node);
      continue;
    }
    node.handle = before.nodes_[node.before].handle;
    taken[node.handle] = true;
  }
  NodeHandle free = 0;
  for (Node* node : fresh) {
    while (taken[free]) ++free;
    node->handle = free++;
  }
}

Counters OwnView::counters() const {
  Counters c{.nodes = nodes_.size(), .entries = bodies_.size()};
  for (const Node& node : nodes_) {
    ++(node.leaf ? c.leaves : c.splits);
    c.depth = std::max<std::uint64_t>(c.depth, node.depth);
  }
  return c;
}

std::vector<Event> OwnView::events_since(const OwnView& before, BodyId body,
                                         const OwnRules& rules) const {
  std::vector<Event> events;
  const auto tell = [&](Event::Kind kind, const Node& node, std::uint32_t count) {
    events.push_back({kind, node.handle, body, count, count > 0 ? rules.capacity : 0});
  };
  const auto holds = [&](const OwnView& view, const Node& node) {
    return std::ranges::binary_search(view.bodies(node), body);
  };
  for (const Node& node : nodes_) {
    const Node* old = node.before == kNone ? nullptr : &before.nodes_[node.before];
    if (!old) tell(Event::Kind::make_child, node, 0);
    if (old && old->leaf && !node.leaf) tell(Event::Kind::split, node, old->count + 1);
    if (!node.leaf || !holds(*this, node) || (old && old->leaf && holds(before, *old))) continue;
    tell(Event::Kind::store, node, node.count);
    if (node.count > rules.capacity && node.depth == rules.max_depth)
      tell(Event::Kind::depth_limit, node, node.count);
  }
  return events;
}

// --- the structure ---

namespace {

// What it holds is read from its OwnView; the tree itself is only called to insert, to clear, and
// for one visit after that.
class OwnFlat final : public StructureOf<OwnFlat, 2> {
 public:
  static constexpr Zones kZones = Zones::rounded_rim;

  OwnFlat(const StructureConfig<2>& config, const OwnKind& kind)
      : kind_(kind), rules_{config, kind.name}, view_(config.bounds) {
    clear();
  }
  ~OwnFlat() override {
    run_own(
        "its destructor", 0, [&] { tree_.reset(); }, [](const std::string&) {});
  }

  template <class Observer>
  void add(const Item<2>& item, Observer&& observer) {
    put(item);
    if constexpr (!std::is_same_v<std::remove_cvref_t<Observer>, NoObserver>) {
      const OwnView before = looked();
      const auto place = static_cast<BodyId>(ids_.size() - 1);
      for (Event event : view_.events_since(before, place, rules_)) {
        event.body = item.id;
        observer(event);
      }
    }
  }
  void look() override {
    if (!seen_) looked();
  }
  // Nobody wants to hear of what goes wrong while forgetting.
  void clear() override {
    ids_.clear();
    boxes_.clear();
    clamped_.clear();
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

  template <class F>
  void take(Tour<2> tour, F&& f) const {
    visit_from(0, kNone, tour, f);
  }
  std::uint64_t near(const Box<2>& box, std::vector<BodyId>& ids) const override {
    const auto& nodes = view_.nodes();
    const Box<2> cut = grown(clamped(box, nodes[0].box), view_.slack());
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
  // By its own search, if it has one.
  bool tells_pairs(FunctionRef<bool(BodyId)> awake, FunctionRef<void(BodyId, BodyId)> f) const {
    std::vector<Pair> told;
    bool has = false;
    if (broken_) std::rethrow_exception(broken_);
    const PairSink sink = [&](BodyId a, BodyId b) {
      require_known(std::max(a, b), told.size());
      if (a == b)
        throw std::invalid_argument(fmt::format("body number {} is no pair with itself", a));
      told.push_back({ids_[a], ids_[b]});
    };
    call("pairs", [&] { has = tree_->pairs(sink); });
    for (const Pair& pair : told)
      if (awake(pair.a) || awake(pair.b)) f(pair.a, pair.b);
    return has;
  }
  // Who lies outside the world is somewhere else to it.
  void narrow(RayQuery<2>& query) const {
    if (broken_) std::rethrow_exception(broken_);
    const Ray<2>& ray = query.ray;
    const Box<2> all = united(rules_.bounds, {ray.origin, ray.origin});
    const double across = glm::length(all.size()) / glm::length(ray.direction);
    std::vector<BodyId> told;
    const BodySink sink = [&](BodyId id) {
      require_known(id, told.size());
      told.push_back(ids_[id]);
    };
    bool has = false;
    call("ray", [&] { has = tree_->ray(ray.origin, ray.at(std::min(ray.length, across)), sink); });
    if (!has) return;
    for (std::size_t i = 0; i < ids_.size(); ++i)
      if (clamped_[i]) told.push_back(ids_[i]);
    std::ranges::sort(told);
    query.only = std::move(told);
  }
  Counters counters() const override { return view_.counters(); }
  std::span<const OwnFault> faults() const override { return faults_; }

 private:
  void call(const char* during, FunctionRef<void()> f, std::vector<BodyId> bodies = {}) const {
    run_own(during, bodies.empty() ? 0 : bodies[0], f, [&](const std::string& words) {
      throw StructureFault(
          {fmt::format("structure '{}': {} threw: {}", kind_.name, during, words), bodies});
    });
  }

  // What is thrown here is told as its own.
  void require_known(BodyId id, std::size_t told) const {
    if (id >= ids_.size())
      throw std::out_of_range(fmt::format("body number {} was never inserted", id));
    if (told >= rules_.most_entries)
      throw std::length_error(fmt::format("more than {}; does it come to an end?", told));
  }

  void renew() {
    bool cleared = false;
    if (tree_) call("clear", [&] { cleared = tree_->clear(); });
    if (cleared) return;
    call("its destructor", [&] { tree_.reset(); });
    call("its constructor",
         [&] { tree_ = kind_.make(rules_.bounds, rules_.capacity, rules_.max_depth); });
  }

  // Returns what was seen before.
  OwnView looked() {
    if (broken_) std::rethrow_exception(broken_);
    OwnView before = std::exchange(view_, OwnView(*tree_, rules_, boxes_, view_));
    faults_ = view_.faults();
    for (OwnFault& fault : faults_)
      for (std::size_t i = 0; i < fault.bodies.size(); ++i) {
        BodyId& body = fault.bodies[i];
        if (clamped_[body])
          fault.text += fmt::format("; the box of {{{}}} is clamped to the world", i);
        body = ids_[body];
      }
    seen_ = true;
    return before;
  }

  void put(const Item<2>& item) {
    if (broken_) std::rethrow_exception(broken_);
    stop_if_asked();
    seen_ = false;
    const auto place = static_cast<BodyId>(boxes_.size());
    ids_.push_back(item.id);
    boxes_.push_back(clamped(item.box, rules_.bounds));
    clamped_.push_back(boxes_.back() != item.box);
    call("insert of {0}", [&] { tree_->insert(place, boxes_[place]); }, {item.id});
  }

  template <class F>
  void visit_from(std::uint32_t index, std::uint32_t parent, Tour<2>& tour, F& f) const {
    const OwnView::Node& node = view_.nodes()[index];
    tour.ids.clear();
    for (const BodyId place : view_.bodies(node)) tour.ids.push_back(ids_[place]);
    std::ranges::sort(tour.ids);
    NodeView<2> view = tour.view(node.handle, parent, node.slot, node.depth, node.leaf, node.box);
    view.slack = view_.slack();
    view.bodies = tour.ids;
    if (!f(std::as_const(view))) return;
    for (const std::uint32_t child : children_of(index, tour.toward))
      visit_from(child, view.id, tour, f);
  }

  // By how soon a ray along the direction comes to their middles.
  std::vector<std::uint32_t> children_of(std::uint32_t node, const Vec<2>& toward) const {
    std::vector<std::uint32_t> children;
    view_.each_child(node, [&](std::uint32_t c) { children.push_back(c); });
    if (toward != Vec<2>(0.0))
      std::ranges::stable_sort(children, {}, [&](std::uint32_t c) {
        return glm::dot(view_.nodes()[c].box.center(), toward);
      });
    return children;
  }

  OwnKind kind_;
  OwnRules rules_;
  std::unique_ptr<OwnTree> tree_;
  std::vector<BodyId> ids_;    // of the bodies, in the order of their insertion: the tree is told
  std::vector<Box<2>> boxes_;  // their places in it, and their boxes, cut to the bounds
  std::vector<bool> clamped_;  // which of them were
  OwnView view_;
  bool seen_ = false;  // it shows what the tree holds
  std::vector<OwnFault> faults_;
  std::exception_ptr broken_;  // the tree could not be made or cleared
};

}  // namespace

template <>
std::unique_ptr<Structure<2>> own_tree(const OwnKind& kind, const StructureConfig<2>& config) {
  return std::make_unique<OwnFlat>(config, kind);
}
template <>
std::unique_ptr<Structure<3>> own_tree(const OwnKind& kind, const StructureConfig<3>& config) {
  return std::make_unique<Upright<OwnFlat>>(config, kind);
}

}  // namespace lantern::spatial
