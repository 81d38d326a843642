// A warning of bodies that fall into each other, in a world in which nothing touches.
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "geometry/shape.hpp"
#include "physics/manifold.hpp"
#include "run/watcher.hpp"
#include "spatial/structure.hpp"

namespace lantern::run {
namespace {

constexpr double kDeep = 0.01;  // of the thinner body's width

// Bodies that only fly straight on are not meant to collide.
bool anything_pushes(const Scenario& scenario) {
  return scenario.has_forces() || std::ranges::any_of(scenario.steps, [](const Step& step) {
           return std::holds_alternative<ApplyForce>(step.verb) ||
                  std::holds_alternative<ApplyImpulse>(step.verb);
         });
}

struct Overlapping {
  double depth = 0;
  double width = 0;  // of the thinner body
};

template <int D>
Overlapping overlapping(const FrameBody& a, const FrameBody& b) {
  const Shape<D> of_a = in_dimension<D>(a.shape), of_b = in_dimension<D>(b.shape);
  const auto placed = [](const Shape<D>& shape, const FrameBody& body) {
    Rotation<D> turn;
    if constexpr (D == 2)
      turn.angle = body.angle;
    else
      turn = body.orientation;
    return Placed<D>{shape, in_dimension<D>(body.position), turn};
  };
  Overlapping found;
  found.width = 2 * std::min(thickness<D>(of_a), thickness<D>(of_b));
  if (const auto manifold = collide(placed(of_a, a), placed(of_b, b), 0.0))
    found.depth = manifold->depth();
  return found;
}

class ContactsWatch : public Watcher {
 public:
  explicit ContactsWatch(const Scenario& scenario) : scenario_(scenario) {
    for (const LinkSpec& link : scenario.links)
      if (link.b)
        linked_.insert(std::minmax(scenario.bodies[link.a].name, scenario.bodies[*link.b].name));
  }

  // What a step puts somewhere has not fallen there.
  void begin(const Step& step) override {
    put_ = put_ || entering(step.verb) || std::holds_alternative<Move>(step.verb);
  }

  void see_frame(const Frame& frame) override {
    if (!(frame.time > time_)) return;
    time_ = frame.time;
    Depths depths;
    const auto look = [&](BodyId first, BodyId second) {
      const FrameBody& a = body(frame, first);
      const FrameBody& b = body(frame, second);
      if (!falls(a) && !falls(b)) return;
      const Overlapping now = frame.dimension == 2 ? overlapping<2>(a, b) : overlapping<3>(a, b);
      if (!(now.depth > 0)) return;
      const Pair pair{std::min(first, second), std::max(first, second)};
      depths.emplace_back(pair, now.depth);
      const double grown = now.depth - depth_before(pair);
      if (put_ || !(grown > kDeep * now.width) || told_.contains(pair)) return;
      if (linked_.contains(std::minmax(a.name, b.name))) return;
      told_.insert(pair);
      found_.add([&] { return falling(a, b, now.depth, frame); });
    };
    if (frame.structure != StructureKind::none)
      for (const FramePair& p : frame.pairs) look(p.pair.a, p.pair.b);
    else
      sweep(frame, look);
    std::ranges::sort(depths);
    depths_ = std::move(depths);
    put_ = false;
  }

  std::vector<Diagnostic> warnings() const override {
    return found_.list("pairs of bodies fall into each other");
  }

 private:
  using Depths = std::vector<std::pair<Pair, double>>;

  // 0 if they did not overlap.
  double depth_before(const Pair& pair) const {
    const auto found = std::ranges::lower_bound(depths_, pair, {}, &Depths::value_type::first);
    return found == depths_.end() || found->first != pair ? 0 : found->second;
  }

  static bool falls(const FrameBody& body) { return !body.is_static && !body.asleep; }

  // They lie in order of their ids.
  static const FrameBody& body(const Frame& frame, BodyId id) {
    return *std::ranges::lower_bound(frame.bodies, id, {}, &FrameBody::id);
  }

  void sweep(const Frame& frame, auto&& look) {
    sweep_->clear();
    for (const FrameBody& b : frame.bodies)
      if (!std::holds_alternative<HalfSpace<3>>(b.shape)) sweep_->insert({b.id, b.box});
    sweep_->sort();
    const auto all = [](BodyId) { return true; };
    sweep_->compare(all, [&](BodyId a, BodyId b) {
      if (overlap(body(frame, a).box, body(frame, b).box)) look(a, b);
    });
    // A half-space's box has no end, and would let no axis part anything.
    for (const FrameBody& ground : frame.bodies)
      if (std::holds_alternative<HalfSpace<3>>(ground.shape))
        for (const FrameBody& b : frame.bodies)
          if (b.id != ground.id && overlap(b.box, ground.box)) look(b.id, ground.id);
  }

  Diagnostic falling(const FrameBody& a, const FrameBody& b, double depth, const Frame& frame) {
    const FrameBody& one = falls(a) && (!falls(b) || a.position.y >= b.position.y) ? a : b;
    const FrameBody& other = &one == &a ? b : a;
    return warning(scenario_, scenario_.world.place_of({"contacts"}),
                   fmt::format("'{}' falls into '{}', {:.3g} deep in frame {} ({:.4g} s): contacts "
                               "are off",
                               one.name, other.name, depth, frame.index, frame.time),
                   "give [world] contacts = \"soft\"" + if_meant(scenario_, Warning::contacts));
  }

  const Scenario& scenario_;
  std::set<std::pair<std::string, std::string>> linked_;
  const std::unique_ptr<Structure<3>> sweep_ = make_structure<3>(StructureKind::sort_and_sweep);
  Depths depths_;  // of the frame before, by pair
  std::set<Pair> told_;
  Diagnostics found_;
  double time_ = 0;
  bool put_ = true;
};

class CrushWatch : public Watcher {
 public:
  explicit CrushWatch(const Scenario& scenario) : scenario_(scenario) {}

  void see_world(const Players<2>& players) override { look(players.world()); }
  void see_world(const Players<3>& players) override { look(players.world()); }

  std::vector<Diagnostic> warnings() const override {
    return found_.list("pairs of bodies crush one of them");
  }

 private:
  template <int D>
  void look(const World<D>& world) {
    for (const ContactEvent& event : world.fresh_events())
      if (event.crushes && told_.insert({event.a, event.b}).second)
        found_.add([&] { return crushed(world, {event.a, event.b}); });
  }

  template <int D>
  Diagnostic crushed(const World<D>& world, const Pair& pair) const {
    const auto contact =
        std::ranges::lower_bound(world.fresh_contacts(), pair, {}, &Contact<D>::pair);
    return warning(scenario_, place_of_firmness(scenario_.world),
                   fmt::format("'{}' and '{}' are pressed {:.3g} into each other at {:.4g} s: one "
                               "of them is crushed against a third",
                               world.find(pair.a)->name, world.find(pair.b)->name,
                               contact->manifold.depth(), world.time()),
                   "let what pushes it stop, or " + firmer(scenario_.world) +
                       if_meant(scenario_, Warning::crush));
  }

  const Scenario& scenario_;
  std::set<Pair> told_;
  Diagnostics found_;
};

// Half sizes of the box around a shape, along its own axes. Nothing for a half-space.
template <int D>
std::optional<Vec<D>> half_sizes(const Shape<D>& shape) {
  if (std::holds_alternative<HalfSpace<D>>(shape)) return std::nullopt;
  return bounding_box(shape, Vec<D>(0.0)).hi;
}

//      x from        Did the way of a centre lead through the middle of the static body, across the
//    ___\____        direction in which that is thinnest?
//   |____\___|
//         x to
template <int D>
bool crossed(const Body<D>& obstacle, const Vec<D>& from, const Vec<D>& to) {
  const std::optional<Vec<D>> half = half_sizes(obstacle.shape);
  if (!half) return false;
  Mat<D> axes(1.0);
  if (turns<D>(obstacle.shape)) axes = matrix(obstacle.orientation);
  const Vec<D> a = glm::transpose(axes) * (from - obstacle.position);
  const Vec<D> b = glm::transpose(axes) * (to - obstacle.position);
  int thin = 0;
  for (int i = 1; i < D; ++i)
    if ((*half)[i] < (*half)[thin]) thin = i;
  if (!(a[thin] * b[thin] < 0)) return false;
  const Vec<D> middle = a + (b - a) * (a[thin] / (a[thin] - b[thin]));
  for (int i = 0; i < D; ++i)
    if (i != thin && !(std::abs(middle[i]) < (*half)[i])) return false;
  return true;
}

class ThroughWatch : public Watcher {
 public:
  explicit ThroughWatch(const Scenario& scenario) : scenario_(scenario) {
    for (const LinkSpec& link : scenario.links)
      if (link.b) linked_.insert(std::minmax(link.a, *link.b));
  }

  // What a step puts somewhere else has not been pushed there.
  void begin(const Step& step) override {
    if (std::holds_alternative<Move>(step.verb) || entering(step.verb)) before_.clear();
  }

  void see_world(const Players<2>& players) override { look(players); }
  void see_world(const Players<3>& players) override { look(players); }

  std::vector<Diagnostic> warnings() const override {
    return found_.list("bodies are pushed through a static one");
  }

 private:
  template <int D>
  void look(const Players<D>& players) {
    const World<D>& world = players.world();
    for (const Contact<D>& contact : world.fresh_contacts()) {
      const double depth = contact.manifold.depth();
      if (depth > 0)
        for_dynamic_and_static(
            players, {contact.a, contact.b}, [&](const auto& moved, const auto& obstacle) {
              const double width = 2 * thickness<D>(moved.shape);
              if (!(depth > width) || !(width > 0)) return;
              tell(players, moved, obstacle,
                   fmt::format("lies {:.3g} deep in '{}', more than its own thickness,", depth,
                               obstacle.name));
            });
    }
    for (const Pair& pair : world.pairs())
      for_dynamic_and_static(players, pair, [&](const auto& moved, const auto& obstacle) {
        if (moved.id < before_.size() && before_[moved.id] &&
            crossed<D>(obstacle, in_dimension<D>(*before_[moved.id]), moved.position))
          tell(players, moved, obstacle, fmt::format("is pushed through '{}'", obstacle.name));
      });
    for (const Body<D>& body : world.bodies()) {
      if (before_.size() <= body.id) before_.resize(body.id + std::size_t{1});
      if (body.kind == BodyKind::dynamic_body) before_[body.id] = solid(body.position);
    }
  }

  // f(dynamic, static), if the pair is one of these and not tied together.
  template <int D, class F>
  void for_dynamic_and_static(const Players<D>& players, const Pair& pair, F&& f) const {
    const Body<D>* a = players.world().find(pair.a);
    const Body<D>* b = players.world().find(pair.b);
    if (!a || !b) return;
    if (a->kind == BodyKind::static_body) std::swap(a, b);
    if (a->kind != BodyKind::dynamic_body || b->kind != BodyKind::static_body) return;
    const auto i = players.index_of(a->id), j = players.index_of(b->id);
    if (i && j && !linked_.contains(std::minmax(*i, *j))) f(*a, *b);
  }

  template <int D>
  void tell(const Players<D>& players, const Body<D>& moved, const Body<D>& obstacle,
            const std::string& what) {
    if (!told_.insert({moved.id, obstacle.id}).second) return;
    found_.add([&] {
      return warning(
          scenario_, place_of_firmness(scenario_.world),
          fmt::format("'{}' {} at {:.4g} s", moved.name, what, players.world().time()),
          firmer(scenario_.world) + fmt::format(", or '{}' a larger size", obstacle.name));
    });
  }

  const Scenario& scenario_;
  std::set<std::pair<std::size_t, std::size_t>> linked_;
  std::vector<std::optional<Vec<3>>> before_;  // centres of dynamic bodies a step ago, by id
  std::set<std::pair<BodyId, BodyId>> told_;
  Diagnostics found_;
};

}  // namespace

Watching watch_contacts(const Scenario& scenario) {
  if (scenario.has_contacts() || !anything_pushes(scenario) || scenario.bodies.size() < 2)
    return nullptr;
  return std::make_unique<ContactsWatch>(scenario);
}

// A warning of bodies that are crushed between others.

Watching watch_crush(const Scenario& scenario) {
  if (!scenario.has_contacts() || scenario.bodies.size() < 3) return nullptr;
  return std::make_unique<CrushWatch>(scenario);
}

// A warning of bodies that are pushed into or through one that never moves.

Watching watch_through(const Scenario& scenario) {
  if (!scenario.has_contacts() || !scenario.has_body_of(BodyKind::dynamic_body) ||
      !scenario.has_body_of(BodyKind::static_body))
    return nullptr;
  return std::make_unique<ThroughWatch>(scenario);
}

}  // namespace lantern::run
