#include "measure/step_bench.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "base/clock.hpp"
#include "base/error.hpp"
#include "base/stop.hpp"
#include "base/timing.hpp"
#include "geometry/not_finite.hpp"
#include "measure/lantern_solver.hpp"
#include "measure/peers.hpp"

namespace lantern::measure {
namespace {

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
      throw Refused(fmt::format("there is no method of contacts and no engine '{}'", name));
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
  std::ranges::sort(points, [](const OwnPoint& a, const OwnPoint& b) {
    return std::pair(a.ms, a.deepest) < std::pair(b.ms, b.deepest);
  });
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
