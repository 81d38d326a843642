// A warning of bodies that are pushed into or through one that never moves.
#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "geometry/shape.hpp"
#include "run/watcher.hpp"

namespace lantern::run {
namespace {

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

  bool sees_worlds() const override { return true; }
  void see_world(const Players<2>& players) override { look(players); }
  void see_world(const Players<3>& players) override { look(players); }

  std::vector<Diagnostic> warnings() const override {
    return found_.list("bodies are pushed through a static one");
  }

 private:
  template <int D>
  void look(const Players<D>& players) {
    const World<D>& world = players.world();
    for (const Contact<D>& contact : world.contacts()) {
      double depth = 0;
      for (const ManifoldPoint<D>& point : contact.manifold.points())
        depth = std::max(depth, -point.separation);
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
      return warning(scenario_, place_of_firmness(scenario_.world),
                     fmt::format("'{}' {} at {:.4g} s", moved.name, what, players.world().time()),
                     firmer(scenario_.world) + ", or '" + obstacle.name + "' a larger size");
    });
  }

  const Scenario& scenario_;
  std::set<std::pair<std::size_t, std::size_t>> linked_;
  std::vector<std::optional<Vec<3>>> before_;  // centres of dynamic bodies a step ago, by id
  std::set<std::pair<BodyId, BodyId>> told_;
  Diagnostics found_;
};

}  // namespace

Watching watch_through(const Scenario& scenario) {
  if (!scenario.has_contacts() || !scenario.has_body_of(BodyKind::dynamic_body) ||
      !scenario.has_body_of(BodyKind::static_body))
    return nullptr;
  return std::make_unique<ThroughWatch>(scenario);
}

}  // namespace lantern::run
