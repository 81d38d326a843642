#include "measure/pile.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "base/random.hpp"

namespace lantern::measure {
namespace {

constexpr double kHalfSize = 0.5;
constexpr double kSpacing = 1.22;  // tilted boxes do not touch
constexpr double kMostTilt = 0.15;
constexpr double kJitter = 0.02;
constexpr double kHalfWall = 5;  // thick: nothing gets through
constexpr double kFriction = 0.5;
constexpr double kPileGravity = 10;
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
  spec.world.gravity = {0, -kPileGravity, 0};
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

PileGauge::PileGauge(const Pile& pile, const Scenario& scenario)
    : half_(half_width(pile.dimension)), scenario_(scenario), invariants_(scenario) {
  std::vector<BodyState> lying(scenario.bodies.size());
  for (std::size_t i = 0; i < lying.size(); ++i) {
    lying[i].there = true;
    const Vec<3> apart(3 * static_cast<double>(i), kHalfSize, 0);
    lying[i].position = falls(i) ? apart : scenario.bodies[i].position;
  }
  at_rest_ = invariants_.of(lying).energy;
}

bool PileGauge::falls(std::size_t body) const {
  return scenario_.bodies[body].kind == BodyKind::dynamic_body;
}

PileState PileGauge::of(const std::vector<BodyState>& states,
                        const std::vector<double>& skins) const {
  const Kept kept = invariants_.of(states, {skins, kNearly});
  PileState found{kept.penetration, 0, kept.touching, kept.energy - at_rest_, 0};
  if (kept.touching > 0) found.mean = kept.penetrations / static_cast<double>(kept.touching);
  for (std::size_t i = 0; i < states.size(); ++i) {
    const Vec<3>& at = states[i].position;
    const bool is_flat = scenario_.world.dimension == 2;
    found.outside +=
        falls(i) && (at.y < 0 || std::abs(at.x) > half_ || (!is_flat && std::abs(at.z) > half_));
  }
  return found;
}

}  // namespace lantern::measure
