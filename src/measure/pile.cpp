#include "measure/pile.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <memory>
#include <numbers>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "base/random.hpp"
#include "physics/energy.hpp"
#include "physics/manifold.hpp"
#include "scenario/players.hpp"

namespace lantern::measure {
namespace {

constexpr double kHalfSize = 0.5;
constexpr double kSpacing = 1.22;  // tilted boxes do not touch
constexpr double kMostTilt = 0.15;
constexpr double kJitter = 0.02;
constexpr double kHalfWall = 5;  // thick: nothing gets through
constexpr double kFriction = 0.5;
constexpr double kGravity = 10;
constexpr double kNearly = 1e-3;  // bodies at most so far apart touch: solvers leave a gap or slop
constexpr std::size_t kMostBodies = 100'000;

struct Kind {
  std::string_view name;
  int dimension;
  bool balls;
};
constexpr Kind kKinds[] = {
    {"boxes2d", 2, false}, {"balls2d", 2, true}, {"boxes3d", 3, false}, {"balls3d", 3, true}};

double half_width(int dimension) { return dimension == 2 ? 50 : 6; }

class PileMaker {
 public:
  explicit PileMaker(const Pile& pile)
      : pile_(pile),
        half_(half_width(pile.dimension)),
        side_(static_cast<std::size_t>(2 * half_ / kSpacing) - 1),
        layer_(pile.dimension == 2 ? side_ : side_ * side_),
        height_(kSpacing * static_cast<double>((pile.bodies + layer_ - 1) / layer_) + kHalfWall) {}

  std::vector<BodySpec> bodies() {
    const double out = half_ + kHalfWall;
    wall("floor", {0, -kHalfWall, 0}, {out + kHalfWall, kHalfWall, out + kHalfWall});
    const Vec<3> across(kHalfWall, height_, out);
    wall("left", {-out, height_, 0}, across);
    wall("right", {out, height_, 0}, across);
    if (pile_.dimension == 3) {
      wall("back", {0, height_, -out}, {out, height_, kHalfWall});
      wall("front", {0, height_, out}, {out, height_, kHalfWall});
    }
    for (std::size_t i = 0; i < pile_.bodies; ++i) fall(i);
    return std::move(bodies_);
  }

  Box<3> bounds() const {
    const double out = half_ + 2 * kHalfWall;
    return {{-out, -2 * kHalfWall, -out}, {out, 2 * height_, out}};
  }

 private:
  BodySpec body(std::string name) const {
    BodySpec spec;
    spec.name = std::move(name);
    spec.material = {0, kFriction};
    return spec;
  }

  void wall(const char* name, const Vec<3>& at, Vec<3> half) {
    BodySpec spec = body(name);
    if (pile_.dimension == 2) half.z = 0;
    spec.shape = AxisBox<3>{half};
    spec.position = at;
    spec.kind = BodyKind::static_body;
    bodies_.push_back(std::move(spec));
  }

  void fall(std::size_t i) {
    BodySpec spec = body(fmt::format("b{}", i));
    const bool flat = pile_.dimension == 2;
    const std::size_t row = i / layer_, place = i % layer_;
    const double shift = row % 2 == 0 ? -kSpacing / 4 : kSpacing / 4;
    const auto across = [&](std::size_t column) {
      const double from_middle = static_cast<double>(column) - static_cast<double>(side_ - 1) / 2;
      return from_middle * kSpacing + shift + random_.between(-kJitter, kJitter);
    };
    spec.position.x = across(place % side_);
    spec.position.y = kSpacing * (static_cast<double>(row) + 0.5);
    if (!flat) spec.position.z = across(place / side_);
    if (pile_.balls) {
      spec.shape = Sphere{kHalfSize};
    } else {
      spec.shape = OrientedBox<3>{{kHalfSize, kHalfSize, flat ? 0 : kHalfSize}};
      spec.angle = random_.between(-kMostTilt, kMostTilt);
      if (!flat) {
        const double around = random_.between(0, 2 * std::numbers::pi);
        const double y = random_.between(-1, 1), r = std::sqrt(1 - y * y);
        spec.axis = {r * std::cos(around), y, r * std::sin(around)};
      }
    }
    bodies_.push_back(std::move(spec));
  }

  const Pile& pile_;
  double half_;
  std::size_t side_, layer_;  // bodies in a row, and in a layer
  double height_;             // of the bodies at the start, and half of the walls'
  Random random_{1};
  std::vector<BodySpec> bodies_;
};

template <int D>
class Gauge {
 public:
  Gauge(const Pile& pile, const Scenario& scenario)
      : half_(half_width(pile.dimension)), players_(scenario) {
    for (std::size_t i = 0; i < scenario.bodies.size(); ++i) players_.enter(i);
  }

  PileState operator()(const std::vector<BodyState>& states,
                       const std::vector<double>& skins) const {
    std::vector<Body<D>> bodies = players_.world().bodies();
    PileState found;
    for (Body<D>& body : bodies) {
      put(body, states[*players_.index_of(body.id)]);
      found.outside += body.moves() && is_outside(body.position);
    }
    found.energy =
        physics::energy(std::span<const Body<D>>(bodies), players_.world().forces()).total() -
        at_rest(bodies);
    look_at_pairs(bodies, skins, found);
    return found;
  }

 private:
  struct Boxed {
    const Body<D>* body;
    double skin;
    Box<D> box;  // with its skin
  };

  static void put(Body<D>& body, const BodyState& state) {
    body.position = in_dimension<D>(state.position);
    body.velocity = in_dimension<D>(state.velocity);
    if constexpr (D == 2) {
      body.orientation.angle = state.angle;
      body.angular_momentum = state.angular_momentum.z;
    } else {
      body.orientation = state.orientation;
      body.angular_momentum = state.angular_momentum;
    }
  }

  bool is_outside(const Vec<D>& at) const {
    bool outside = at.y < 0 || std::abs(at.x) > half_;
    if constexpr (D == 3) outside = outside || std::abs(at.z) > half_;
    return outside;
  }

  // What they would have if all lay on the floor.
  static double at_rest(const std::vector<Body<D>>& bodies) {
    double sum = 0;
    for (const Body<D>& body : bodies)
      if (body.inverse_mass > 0) sum += kGravity * kHalfSize / body.inverse_mass;
    return sum;
  }

  // All pairs whose boxes overlap, by a sweep along x.
  void look_at_pairs(const std::vector<Body<D>>& bodies, const std::vector<double>& skins,
                     PileState& found) const {
    std::vector<Boxed> sorted;
    for (const Body<D>& body : bodies) {
      const Box<D> box = body.box();
      const double skin = skins[*players_.index_of(body.id)];
      sorted.push_back({&body, skin, {box.lo - (skin + kNearly), box.hi + (skin + kNearly)}});
    }
    std::ranges::sort(sorted, {}, [](const Boxed& b) { return b.box.lo.x; });
    double sum = 0;
    for (std::size_t i = 0; i < sorted.size(); ++i)
      for (std::size_t j = i + 1; j < sorted.size(); ++j) {
        const Boxed &a = sorted[i], &b = sorted[j];
        if (b.box.lo.x > a.box.hi.x) break;
        if ((!a.body->moves() && !b.body->moves()) || !overlap(a.box, b.box)) continue;
        const double skin = a.skin + b.skin, margin = skin + kNearly;
        const auto manifold = collide<D>(placed(*a.body), placed(*b.body), margin);
        if (!manifold) continue;
        double depth = 0;
        for (const ManifoldPoint<D>& point : manifold->points())
          depth = std::max(depth, skin - point.separation);
        ++found.touching;
        sum += depth;
        found.deepest = std::max(found.deepest, depth);
      }
    if (found.touching > 0) found.mean = sum / static_cast<double>(found.touching);
  }

  double half_;
  Players<D> players_;
};

}  // namespace

std::string Pile::name() const {
  const auto kind = std::ranges::find_if(
      kKinds, [&](const Kind& k) { return k.dimension == dimension && k.balls == balls; });
  return fmt::format("{}:{}", kind->name, bodies);
}

std::optional<Pile> pile_named(std::string_view name) {
  const std::size_t colon = name.find(':');
  const auto kind = std::ranges::find(kKinds, name.substr(0, colon), &Kind::name);
  if (colon == std::string_view::npos || kind == std::end(kKinds)) return std::nullopt;
  Pile pile{kind->dimension, kind->balls, 0};
  const char* end = name.data() + name.size();
  const auto [at, error] = std::from_chars(name.data() + colon + 1, end, pile.bodies);
  if (error != std::errc() || at != end || pile.bodies < 1 || pile.bodies > kMostBodies)
    return std::nullopt;
  return pile;
}

Scenario pile_scene(const Pile& pile, double step, StructureKind structure) {
  ScenarioSpec spec;
  spec.name = pile.name();
  spec.world.dimension = pile.dimension;
  spec.world.time_step = step;
  spec.world.gravity = {0, -kGravity, 0};
  spec.world.contacts = ContactMethod::soft;
  spec.structure.kind = structure;
  spec.structure.split_static = true;
  spec.structure.capacity = 8;  // of a tree; about a body in a cell
  spec.structure.max_depth = 8;
  PileMaker maker(pile);
  spec.world.bounds = maker.bounds();
  spec.bodies = maker.bodies();
  return Scenario(std::move(spec));
}

PileGauge::PileGauge(const Pile& pile, const Scenario& scenario) {
  const auto gauge = [&]<int D>(std::integral_constant<int, D>) {
    of_ = [g = std::make_shared<Gauge<D>>(pile, scenario)](const auto& states, const auto& skins) {
      return (*g)(states, skins);
    };
  };
  pile.dimension == 3 ? gauge(std::integral_constant<int, 3>())
                      : gauge(std::integral_constant<int, 2>());
}

}  // namespace lantern::measure
