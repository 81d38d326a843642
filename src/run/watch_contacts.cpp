// A warning of bodies that fall into each other, in a world in which nothing touches.
#include <algorithm>
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
  return scenario.has_forces() ||
         std::any_of(scenario.steps.begin(), scenario.steps.end(), [](const Step& step) {
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
    for (const ManifoldPoint<D>& point : manifold->points())
      found.depth = std::max(found.depth, -point.separation);
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
    std::sort(depths.begin(), depths.end());
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
    const auto found = std::lower_bound(
        depths_.begin(), depths_.end(), pair,
        [](const auto& entry, const Pair& wanted) { return entry.first < wanted; });
    return found == depths_.end() || found->first != pair ? 0 : found->second;
  }

  static bool falls(const FrameBody& body) { return !body.is_static && !body.asleep; }

  // They lie in order of their ids.
  static const FrameBody& body(const Frame& frame, BodyId id) {
    return *std::lower_bound(frame.bodies.begin(), frame.bodies.end(), id,
                             [](const FrameBody& b, BodyId wanted) { return b.id < wanted; });
  }

  template <class F>
  void sweep(const Frame& frame, F&& look) {
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

}  // namespace

Watching watch_contacts(const Scenario& scenario) {
  if (scenario.has_contacts() || !anything_pushes(scenario) || scenario.bodies.size() < 2)
    return nullptr;
  return std::make_unique<ContactsWatch>(scenario);
}

}  // namespace lantern::run
