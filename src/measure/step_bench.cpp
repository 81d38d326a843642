#include "measure/step_bench.hpp"

#include <numeric>

#include "base/number.hpp"
#include "base/random.hpp"
#include "geometry/not_finite.hpp"
#include "measure/solvers.hpp"

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
  explicit PileMaker(const Pile& pile) : pile_(pile) {}

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
  double half_ = half_width(pile_.dimension);
  std::size_t side_ = static_cast<std::size_t>(2 * half_ / kSpacing) - 1;  // bodies in a row,
  std::size_t layer_ = pile_.dimension == 2 ? side_ : side_ * side_;       // and in a layer
  // Of the bodies at the start, and half of the walls'.
  double height_ = kSpacing * double((pile_.bodies + layer_ - 1) / layer_) + kHalfWall;
  Random random_{1};
  std::vector<BodySpec> bodies_;
};

constexpr double kStepSeconds = 1.0 / 60;
constexpr std::size_t kTurn = 15;         // steps that a solver makes at a time
constexpr std::size_t kTurnsASecond = 4;  // of simulated time
constexpr std::uint64_t kWarmSteps = 5;

// From quick to exact, names of language/method.hpp.
constexpr std::string_view kUsualEfforts[] = {"soft:0.01", "soft:0.001", "soft:0.0001", "soft:8",
                                              "impulse:10"};

// Null if there is no such method of contacts.
std::unique_ptr<Solver> own(std::string_view name) {
  const auto method = method_named(name);
  if (!method || !method->contacts || *method->contacts == ContactMethod::none) return nullptr;
  return std::make_unique<LanternSolver>(*method);
}

std::vector<std::unique_ptr<Solver>> contestants(StepBenchResult& result) {
  const StepBenchConfig& config = result.config;
  std::vector<std::unique_ptr<Solver>> all;
  std::vector<std::string_view> names(config.only.begin(), config.only.end());
  if (names.empty()) names.assign(usual_efforts().begin(), usual_efforts().end());
  for (const std::string_view name : names)
    if (auto mine = own(name)) all.push_back(std::move(mine));
  if (config.peers)
    for (auto& peer : load_peers(result.missing))
      if (is_asked_for(config.only, peer->name())) all.push_back(std::move(peer));
  for (const std::string& name : config.only)
    if (std::ranges::none_of(
            all, [&](const auto& solver) { return is_asked_for({name}, solver->name()); }))
      throw Refused("there is no method of contacts and no engine '{}'", name);
  for (const auto& solver : all)
    result.contestants.push_back({solver->name(), solver->version(), ""});
  return all;
}

bool is_finite_state(const BodyState& s) {
  return is_finite<3>(s.position) && is_finite<3>(s.velocity) && is_finite<3>(s.angular_momentum) &&
         std::isfinite(s.angle) && std::isfinite(s.orientation.q.w);
}

// A pile on its way in one solver.
class PileFall {
 public:
  PileFall(const Solver& solver, const Pile& pile, const StepBenchConfig& config)
      : longest_(config.longest), scenario_(pile_scene(pile, kStepSeconds, config.structure)) {
    row_.pile = pile.name();
    row_.solver = solver.name();
    row_.version = solver.version();
    guarded([&] {
      begun(solver)->advance(kWarmSteps);
      simulation_ = begun(solver);
      gauge_.emplace(pile, scenario_);
      for (std::size_t i = 0; i < scenario_.bodies.size(); ++i)
        skins_.push_back(simulation_->skin(i));
      look();
    });
  }

  bool goes_on() const { return row_.status == Status::ok && computed_ <= longest_; }

  void take_turn() {
    guarded([&] {
      for (std::size_t i = 0; i < kTurn; ++i) {
        stop_if_asked();
        const CpuStopwatch cpu;
        const Stopwatch watch;
        simulation_->advance(1);
        spent_ += watch.seconds();
        seconds_.push_back(cpu.seconds());
        computed_ += seconds_.back();
      }
      look();
    });
  }

  // When it has come to its end.
  StepRow row() {
    const std::size_t steps = seconds_.size();
    row_.simulated = static_cast<double>(steps) * kStepSeconds;
    if (row_.status == Status::ok && row_.end.outside > 0) {
      row_.status = Status::diverged;
      row_.reason = fmt::format("{} bodies left the container", row_.end.outside);
    }
    if (steps == 0) return row_;
    const auto ms = [&](double share) { return 1e3 * quantile(seconds_, share); };
    const auto mean_of = [&](std::size_t from) {
      const double sum = std::accumulate(seconds_.begin() + static_cast<std::ptrdiff_t>(from),
                                         seconds_.end(), 0.0);
      return 1e3 * sum / static_cast<double>(steps - from);
    };
    row_.mean = mean_of(0);
    row_.wall = 1e3 * spent_ / static_cast<double>(steps);
    row_.median = ms(0.5);
    row_.lower_quartile = ms(0.25);
    row_.upper_quartile = ms(0.75);
    row_.last_second = mean_of(steps - std::min(steps, kTurn * kTurnsASecond));
    if (const WorldWork* work = simulation_->world_work()) row_.work = *work;
    return row_;
  }

 private:
  std::unique_ptr<Simulation> begun(const Solver& solver) {
    auto simulation = solver.start(scenario_, kStepSeconds);
    Insert all;
    for (std::size_t i = 0; i < scenario_.bodies.size(); ++i) all.bodies.push_back(i);
    simulation->act(all);
    return simulation;
  }

  void guarded(const auto& act) {
    try {
      act();
    } catch (const Refused& refused) {
      row_.status = seconds_.empty() ? Status::refused : Status::diverged;
      row_.reason = refused.what();
    }
  }

  void look() {
    std::vector<BodyState> states;
    simulation_->observe(states);
    if (!std::ranges::all_of(states, is_finite_state)) {
      row_.status = Status::nan;
      row_.reason = "a state is not a number";
      return;
    }
    row_.end = gauge_->of(states, skins_);
    if (looks_.empty()) start_ = lowest_ = row_.end.energy;
    lowest_ = std::min(lowest_, row_.end.energy);
    row_.gained = std::max(row_.gained, (row_.end.energy - lowest_) / start_);
    row_.lost = 1 - row_.end.energy / start_;
    looks_.push_back(std::move(states));
    if (looks_.size() > kTurnsASecond + 1) looks_.pop_front();
    if (looks_.size() > kTurnsASecond) find_creep();
  }

  void find_creep() {
    double sum = 0;
    row_.most_creep = 0;
    std::size_t falling = 0;
    for (std::size_t i = 0; i < scenario_.bodies.size(); ++i) {
      if (scenario_.bodies[i].kind != BodyKind::dynamic_body) continue;
      const double way = glm::length(looks_.back()[i].position - looks_.front()[i].position);
      sum += way;
      ++falling;
      row_.most_creep = std::max(row_.most_creep, way);
    }
    row_.creep = sum / static_cast<double>(falling);
  }

  double longest_;
  std::vector<double> skins_;  // of each body
  Scenario scenario_;
  StepRow row_;
  std::unique_ptr<Simulation> simulation_;
  std::optional<PileGauge> gauge_;
  std::vector<double> seconds_;               // of the processor, each step
  double computed_ = 0;                       // their sum
  double spent_ = 0;                          // by the clock
  double start_ = 0, lowest_ = 0;             // energy
  std::deque<std::vector<BodyState>> looks_;  // of the last second
};

// Penetrations below this are none.
constexpr double kNoDepth = 1e-12;

struct OwnPoint {
  double deepest, ms;
  std::string_view solver;
};

// Those of our efforts at a pile that no other beats in both, from the least exact, quickest one.
std::vector<OwnPoint> own_front(const StepBenchResult& result, const std::string& pile) {
  std::vector<OwnPoint> points, front;
  for (const StepRow& row : result.rows)
    if (row.pile == pile && !row.is_peer() && row.is_whole(result.config.seconds))
      points.push_back({std::max(row.end.deepest, kNoDepth), row.mean, row.solver});
  std::ranges::sort(points, {}, [](const OwnPoint& p) { return std::pair(p.ms, p.deepest); });
  for (const OwnPoint& point : points)
    if (front.empty() || point.deepest < front.back().deepest) front.push_back(point);
  return front;
}

StepComparison compared_at(double deepest, const std::vector<OwnPoint>& front) {
  StepComparison c;
  c.deepest = deepest;
  const double wanted = std::max(deepest, kNoDepth);
  const auto exact =
      std::ranges::find_if(front, [&](const OwnPoint& point) { return point.deepest <= wanted; });
  if (exact == front.end()) return c;
  c.our_ms = exact->ms;
  c.by = exact->solver;
  if (exact == front.begin()) return c;
  const OwnPoint& rough = *std::prev(exact);
  const double share = std::log(rough.deepest / wanted) / std::log(rough.deepest / exact->deepest);
  c.our_ms = rough.ms * std::pow(exact->ms / rough.ms, share);
  if (share < 1) c.by = fmt::format("between {} and {}", rough.solver, exact->solver);
  return c;
}

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
  const auto bodies = number_in<std::size_t>(name.substr(colon + 1));
  if (!bodies || *bodies < 1 || *bodies > kMostBodies) return std::nullopt;
  return Pile{kind->dimension, kind->balls, *bodies};
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

std::vector<Pile> usual_piles() {
  return {{2, false, 500}, {2, true, 500},  {2, false, 2000},
          {2, true, 2000}, {3, false, 500}, {3, true, 500}};
}

std::vector<Pile> all_piles() {
  std::vector<Pile> piles;
  for (const int dimension : {2, 3})
    for (const std::size_t bodies : {500, 2000, 5000})
      for (const bool balls : {false, true}) piles.push_back({dimension, balls, bodies});
  return piles;
}

std::span<const std::string_view> usual_efforts() { return kUsualEfforts; }

void bench_steps(StepBenchResult& result, const StepBenchWatch& watch) {
  const std::vector<std::unique_ptr<Solver>> all = contestants(result);
  const auto turns = static_cast<std::size_t>(
      std::ceil(result.config.seconds * static_cast<double>(kTurnsASecond)));
  result.config.seconds = static_cast<double>(turns * kTurn) * kStepSeconds;
  for (const Pile& pile : result.config.piles) {
    const Scenario scenario = pile_scene(pile, kStepSeconds, result.config.structure);
    std::deque<PileFall> falls;
    for (const auto& solver : all)
      if (!solver->cannot(scenario)) falls.emplace_back(*solver, pile, result.config);
    for (std::size_t turn = 0; turn < turns; ++turn) {
      watch(pile, static_cast<double>(turn) / static_cast<double>(turns));
      for (PileFall& fall : falls)
        if (fall.goes_on()) fall.take_turn();
    }
    for (PileFall& fall : falls) result.rows.push_back(fall.row());
  }
}

std::vector<StepComparison> compared(const StepBenchResult& result) {
  std::vector<StepComparison> all;
  for (const StepRow& peer : result.rows) {
    if (!peer.is_peer() || !peer.is_whole(result.config.seconds)) continue;
    const std::vector<OwnPoint> front = own_front(result, peer.pile);
    if (front.empty()) continue;
    for (const double share : {1.0, 0.01}) {
      StepComparison c = compared_at(share * peer.end.deepest, front);
      c.pile = peer.pile;
      c.peer = peer.solver;
      c.of = share;
      c.peer_ms = peer.mean;
      all.push_back(std::move(c));
    }
  }
  return all;
}

}  // namespace lantern::measure
