// Impacts: bodies that bounce or are fast meet at the very moment, not at the end of a step.
#include <algorithm>
#include <cmath>

#include "base/scratch.hpp"
#include "base/stop.hpp"
#include "physics/impact/depth_bound.hpp"
#include "physics/impact/jointed_blow.hpp"
#include "physics/impact/time_of_impact.hpp"

namespace lantern::physics {
namespace {

// When a pair next meets, as far as is known: not before `until`, seconds that are left of the
// step.
template <int D>
struct Foreseen {
  bool known = false;
  double until = 0;
  std::optional<TimeOfImpact<D>> met;
};

template <int D>
struct Impact {
  double time = 0;
  IslandPair<D>* pair = nullptr;
  Meeting meeting = Meeting::strikes;
};

// How fast a body's corners turn, at most, within so many seconds, not counting what turns about
// the normal, nor a capsule's spin about its length.
template <int D>
double turning_across(const Body<D>& body, [[maybe_unused]] const Vec<D>& normal,
                      [[maybe_unused]] double seconds) {
  if (turning_reach<D>(body.shape) == 0 || !body.moves() || body.asleep) return 0;
  const Spin<D> spin = angular_velocity(body);
  if constexpr (D == 2) {
    return std::abs(spin);
  } else {
    const bool round = std::holds_alternative<Capsule>(body.shape);
    const Vec<3> along = round ? matrix(body.orientation)[1] : Vec<3>(0.0);
    const double rolls = glm::dot(along, spin);
    const Vec<3> turns = spin - along * rolls;
    // It wanders by Euler's equation, I w' = L x w.
    Vec<3> wanders = glm::cross(turns, along) * -rolls;
    if (body.is_dynamic())
      wanders += world_inverse_inertia(body) * glm::cross(body.angular_momentum, spin);
    return std::min(glm::length(glm::cross(turns, normal)) + glm::length(wanders) * seconds,
                    glm::length(spin) * kWandering<D>);
  }
}

// How much a corner is accelerated along the normal, at most, because its body turns.
template <int D>
double swerve_along(const Body<D>& body, const Vec<D>& normal, double seconds) {
  const Whirl turns = whirl(body);
  return std::min(turns.swerve,
                  kWandering<D> * turns.speed * turning_across(body, normal, seconds));
}

// How far the body reaches from its centre, in this direction and in the opposite one.
template <int D>
double extent(const Body<D>& body, const Vec<D>& direction) {
  return visit_shape<D>(
      body.shape,
      [&](const Core<D>& core) {
        const Mat<D> axes = core.turns ? matrix(body.orientation) : Mat<D>(1.0);
        double reach = core.radius;
        for (int i = 0; i < D; ++i) reach += core.half[i] * std::abs(glm::dot(axes[i], direction));
        return reach;
      },
      [](const HalfSpace<D>&) { return 0.0; });
}

template <int D>
double gap_along(const Body<D>& a, const Body<D>& b, const Vec<D>& normal) {
  return glm::dot(b.position - a.position, normal) - extent(a, normal) - extent(b, normal);
}

// A bounce that would end within a small share of `step` seconds is none. So a ball that bounces
// lower and lower comes to rest after finitely many impacts. This is the speed of such a bounce.
template <int D>
double slowest_impact(const Trajectory<D>& a, const Trajectory<D>& b, double step) {
  const double pull = 2 * glm::length(b.bend - a.bend) + a.held + b.held;
  const double speeds = glm::length(a.velocity) + glm::length(b.velocity);
  const double turns = whirl(*a.body).speed + whirl(*b.body).speed;
  return std::max({pull * step * kImpactSettings.shortest_bounce,
                   kImpactSettings.speed_by_rounding * speeds,
                   kImpactSettings.speed_by_turning * turns});
}

template <int D>
class ImpactMotion {
 public:
  ImpactMotion(const IslandMove<D>& move, const ContactSolver& solver, int& budget,
               ImpactLog<D>& log)
      : move_(move), island_(move.island), solver_(solver), budget_(budget), log_(log) {
    island_.farthest.assign(begun_.size(), 0.0);
    if (move.config.wanted_error && !island_.pairs.empty())
      bound_.emplace(island_, *move.config.wanted_error, move.work);
  }

  void run() {
    move();
    if (bound_) bound_->end();
  }

 private:
  void move() {
    while (left_ > 0) {
      const auto next = next_event();
      const double until = next ? next->time : left_;
      const double gone = until > 0 ? advance(until) : 0;
      note_ways();
      fresh_ = fresh_ && !(gone > 0);
      left_ -= gone;
      if (gone < until) {
        if (!(gone > 0)) return;  // what is left of the step they wait
        look_again();
      } else if (next && next->meeting == Meeting::rests) {
        press(*next->pair);
      } else if (next && next->meeting == Meeting::apart) {
        --budget_;
      } else if (next) {
        strike_at(*next, gone > 0);
      }
    }
  }

  void strike_at(const Impact<D>& next, bool moved) {
    fresh_ = false;
    const ContactRows<D>& met = next.pair->rows;
    log_.moments.push_back(
        {move_.h - left_, pose(island_.bodies[met.a]), pose(island_.bodies[met.b])});
    const int impacts = resolve_impacts();
    move_.work.impacts_located += static_cast<std::uint64_t>(impacts);
    budget_ -= std::max(impacts, 1);
    // Others have moved its bodies off their way.
    if (impacts == 0 && !moved) next.pair->pressed = true;
    for (IslandPair<D>& pair : island_.pairs)  // what does not bounce stays
      if (pair.touched && pair.rows.restitution == 0 && holds(pair, pair.rows.normal))
        pair.pressed = true;
  }

  // Between two events bodies fly nearly straight, so that none was farther away than at its ends.
  void note_ways() {
    for (std::size_t i = 0; i < begun_.size(); ++i)
      island_.farthest[i] = std::max(
          island_.farthest[i],
          glm::length(island_.bodies[i].position - begun_[i].position) +
              std::max(turning_way(island_.bodies[i], left_) - turning_way(begun_[i], move_.h),
                       0.0));
  }

  static void press(IslandPair<D>& pair) {
    pair.pressed = true;
    ++pair.rests;
  }

  double turning(const IslandPair<D>& pair, const Vec<D>& normal, double seconds) const {
    return turning_across(island_.bodies[pair.rows.a], normal, seconds) +
           turning_across(island_.bodies[pair.rows.b], normal, seconds);
  }

  // A contact stays what it is as long as its bodies hardly turn.
  bool holds(const IslandPair<D>& pair, const Vec<D>& normal) const {
    return turning(pair, normal, left_) * left_ <= kImpactSettings.most_held_turn;
  }

  // After a part in which contacts held, those of bouncing and fast pairs are looked for anew.
  void look_again() {
    if (budget_ <= 0) return;
    for (IslandPair<D>& pair : island_.pairs)
      if (pair.located && !holds(pair, pair.rows.normal)) pair.pressed = false;
  }

  void solve(double seconds) { solve(seconds, solver_); }
  void solve(double seconds, const ContactSolver& solver) {
    solver.solve.in<D>()({island_, move_.config, seconds, move_.whole, move_.work});
  }

  // A pair of a body that is in a located one: the two must not come to lie deep in each other.
  struct Watched {
    std::uint32_t a = 0, b = 0;
    Vec<D> normal{0.0};
    Vec<D> offset{0.0};  // from a to b
    double gap = 0;      // along the normal
    double deep = 0;
  };

  Scratch<Watched> watched_pairs(double& seconds) {
    Scratch<Watched> all;
    Scratch<std::uint8_t> fast(island_.bodies.size());
    for (const IslandPair<D>& pair : island_.pairs)
      for (const std::uint32_t i : {pair.rows.a, pair.rows.b})
        fast[i] |= pair.located && island_.bodies[i].is_dynamic();
    for (IslandPair<D>& pair : island_.pairs) {
      if (!fast[pair.rows.a] && !fast[pair.rows.b]) continue;
      stop_if_asked();
      const Body<D>&a = island_.bodies[pair.rows.a], &b = island_.bodies[pair.rows.b];
      ++move_.work.narrow_tests;
      const auto seen = collide(placed(a), placed(b), std::max(pair.reach, way_of(a, b, seconds)));
      if (!seen) continue;
      const double gap = gap_along(a, b, seen->normal), thin = thinner(a, b);
      if (gap < -(thickness<D>(a.shape) + thickness<D>(b.shape)) / 4)
        continue;  // they lie in each other already: which side is which is not clear
      // Others press them together, though they part.
      if (gap < -thin * kImpactSettings.deep / 4) pair.pressed = true;
      all.push_back({pair.rows.a, pair.rows.b, seen->normal, b.position - a.position, gap,
                     kImpactSettings.deep * thin});
      if (const double turn = turning(pair, seen->normal, seconds); pair.pressed && turn > 0)
        seconds = std::min(seconds, kImpactSettings.most_held_turn / turn);
    }
    return all;
  }

  // How far apart the two are on the sides on which they were.
  double gap_now(const Watched& pair, double way) const {
    const Body<D>&a = island_.bodies[pair.a], &b = island_.bodies[pair.b];
    const double gap = gap_along(a, b, pair.normal);
    if (gap >= -pair.deep) return gap;
    ++move_.work.narrow_tests;
    const auto seen = collide(placed(a), placed(b), std::max(pair.gap, 0.0) + way);
    if (!seen || glm::dot(seen->normal, pair.normal) < kImpactSettings.same_side) return gap;
    return std::max(gap, gap_along(a, b, seen->normal));
  }

  // Whether the two have kept apart over so many seconds, in which corners flew on parabolas at
  // worst; or have hardly moved at all.
  bool kept_apart(const Watched& pair, double seconds) const {
    const Body<D>&a = island_.bodies[pair.a], &b = island_.bodies[pair.b];
    const double way = glm::length(b.position - a.position - pair.offset) +
                       (whirl(a).speed + whirl(b).speed) * seconds;
    if (way <= pair.deep / 8) return true;
    const double gap = std::min(pair.gap, gap_now(pair, way));
    const double bend =
        swerve_along(a, pair.normal, seconds) + swerve_along(b, pair.normal, seconds);
    return gap - bend * seconds * seconds / 8 >= -std::max(pair.deep, pair.deep / 8 - pair.gap);
  }

  // Moves the island on by so many seconds, or by less: what contacts hold, and joints, does not
  // fly as was foreseen. A part of the step after which a pair lies deeper in each other than a
  // contact can hold, or than is wanted, is made anew, half as long. Returns how many seconds went
  // by; 0 if the island has been moved often enough.
  double advance(double seconds) {
    if (island_.joints.empty() && std::ranges::none_of(island_.pairs, &IslandPair<D>::pressed)) {
      solve(seconds);
      return seconds;
    }
    double part = seconds;
    const Scratch<Watched> watched = watched_pairs(part);
    part = std::min(part, 2 * last_part_);
    const ContactSolver* solver = &solver_;
    for (; parts_ > 0; part /= 2) {
      parts_ -= part < seconds;
      const bool keeps = !watched.empty() || bound_;
      const Island<D> kept = keeps && !may_begin_again() ? island_ : Island<D>{};
      solve(part, *solver);
      last_part_ = part < seconds ? part : HUGE_VAL;
      if (!std::ranges::all_of(watched, [&](const Watched& p) { return kept_apart(p, part); }))
        solver = &contact_solver(ContactMethod::direct);
      else if (!bound_ ||
               bound_->keeps(parts_ <= 0 || part <= move_.whole * kDepthSettings.smallest_part))
        return part;
      if (may_begin_again())
        begin_again();
      else
        island_ = kept;
      if (part == seconds) --parts_;
      if (part < move_.whole * kImpactSettings.shortest_part) break;
    }
    return 0;
  }

  // Whether the island is as it was given, or can be made so from what is known of it anyway.
  bool may_begin_again() const { return fresh_ && island_.joints.empty(); }
  void begin_again() {
    island_.bodies = begun_;
    for (IslandPair<D>& pair : island_.pairs) pair.begin();
  }

  // Newton's law of restitution at all points of a pair at once: those that approach will part with
  // the given part of their speed.
  void strike(ContactRows<D>& rows, SolverBody<D>& a, SolverBody<D>& b, double restitution) {
    for (ContactPoint<D>& p : rows.points()) {
      const double parting = glm::dot(relative_velocity(a, p.arm_a, b, p.arm_b), rows.normal);
      p.bounce = parting < 0 ? -restitution * parting : 0;
      p.pn = 0;
      p.pt = Vec<D>(0.0);
      p.separation = p.gap = 0;
    }
    for (int i = 0; i < kImpactSettings.most_point_sweeps; ++i) {
      Sweep sweep{&move_.work};
      rows.solve_velocities(a, b, 1, sweep);
      if (rows.count == 1 && rows.friction == 0) break;
      if (sweep.change <= kImpactSettings.change * sweep.largest) break;
    }
  }

  // The sum of impulse times relative velocity.
  static double power(const ContactRows<D>& rows, const SolverBody<D>& a, const SolverBody<D>& b) {
    double sum = 0;
    for (const ContactPoint<D>& p : rows.points())
      sum += glm::dot(rows.normal * p.pn + p.pt, relative_velocity(a, p.arm_a, b, p.arm_b));
    return sum;
  }

  static void blend(SolverBody<D>& to, const SolverBody<D>& from, double share) {
    to.velocity = from.velocity + (to.velocity - from.velocity) * share;
    to.spin = from.spin + (to.spin - from.spin) * share;
    to.twist = from.twist + (to.twist - from.twist) * share;
  }

  // With friction, Newton's law may give energy (Kane and Levinson, "Dynamics", 1985), and without
  // it to two points of which one parts until the other is struck. Without restitution it never
  // does. Between the two blows the energy is a parabola,
  //
  //   E(s) = E0 + s (p.v0) + s^2 (p.v1 - p.v0) / 2      p: the second blow's
  //   impulses less the first's
  //
  // and the pair gets as much of its restitution as leaves E no higher than before the blow.
  // Impulses stay within the cone of friction, which is convex.
  void take_back_gained_energy(ContactRows<D>& rows, SolverBody<D>& a, SolverBody<D>& b,
                               const SolverBody<D>& old_a, const SolverBody<D>& old_b) {
    const double size = std::abs(power(rows, old_a, old_b));
    const double gained = (power(rows, old_a, old_b) + power(rows, a, b)) / 2;
    if (!(gained > kImpactSettings.gain_by_rounding * size)) return;
    ContactRows<D> dead_rows = rows;
    SolverBody<D> dead_a = old_a, dead_b = old_b;
    strike(dead_rows, dead_a, dead_b, 0);
    const double lost = -(power(dead_rows, old_a, old_b) + power(dead_rows, dead_a, dead_b)) / 2;
    ContactRows<D> more = rows;
    for (std::size_t i = 0; i < static_cast<std::size_t>(rows.count); ++i) {
      more.room[i].pn -= dead_rows.room[i].pn;
      more.room[i].pt -= dead_rows.room[i].pt;
    }
    const double slope = power(more, dead_a, dead_b);
    const double bend = power(more, a, b) - slope;
    const double share = share_of_bounce(slope, bend, std::max(lost, 0.0));
    blend(a, dead_a, share);
    blend(b, dead_b, share);
    for (std::size_t i = 0; i < static_cast<std::size_t>(rows.count); ++i) {
      rows.room[i].pn = dead_rows.room[i].pn + more.room[i].pn * share;
      rows.room[i].pt = dead_rows.room[i].pt + more.room[i].pt * share;
    }
  }

  bool approaches(const IslandPair<D>& pair) const {
    const SolverBody<D>& a = island_.solver_bodies[pair.rows.a];
    const SolverBody<D>& b = island_.solver_bodies[pair.rows.b];
    return std::ranges::any_of(pair.rows.points(), [&](const ContactPoint<D>& p) {
      return glm::dot(relative_velocity(a, p.arm_a, b, p.arm_b), pair.rows.normal) < -pair.slow;
    });
  }

  void resolve(ContactRows<D>& rows, SolverBody<D>& a, SolverBody<D>& b) {
    const SolverBody<D> old_a = a, old_b = b;
    strike(rows, a, b, rows.restitution);
    if (rows.restitution > 0 && (rows.friction > 0 || rows.count > 1))
      take_back_gained_energy(rows, a, b, old_a, old_b);
  }

  // Sets up the points of all pairs that touch now.
  Scratch<std::size_t> touching_pairs() {
    Scratch<std::size_t> touching;
    for (std::size_t i = 0; i < island_.pairs.size(); ++i) {
      stop_if_asked();
      IslandPair<D>& pair = island_.pairs[i];
      const Body<D>& a = island_.bodies[pair.rows.a];
      const Body<D>& b = island_.bodies[pair.rows.b];
      const double near = kImpactSettings.touching * thinner(a, b);
      if (!island_.find_points(pair, near, nullptr, 0, move_.work)) continue;
      pair.rows.refresh(a, b, island_.axes[pair.rows.a], island_.axes[pair.rows.b],
                        island_.solver_bodies[pair.rows.a], island_.solver_bodies[pair.rows.b], 0,
                        0);
      touching.push_back(i);
    }
    return touching;
  }

  // What had come to rest in this step, and was struck by a third body, may bounce again. (As a
  // contact it would stop the body that was sent back.)
  void let_struck_go() {
    const auto struck = [&](std::uint32_t i, double slow) {
      const Vec<D> change = island_.solver_bodies[i].velocity - island_.bodies[i].velocity;
      return island_.bodies[i].is_dynamic() && glm::length(change) > slow;
    };
    for (IslandPair<D>& pair : island_.pairs)
      if (pair.rests > 0 && pair.rests < kImpactSettings.most_rests && pair.rows.restitution > 0 &&
          (struck(pair.rows.a, pair.slow) || struck(pair.rows.b, pair.slow)))
        pair.pressed = false;
  }

  // All pairs that touch and approach get the impulses of an impact, one pair after another until
  // none approaches: so the blow runs through a row of balls. Those that joints hold, and that
  // approach in the same round, get theirs together. Pairs between which it does not come to an end
  // become contacts. Returns how many impacts there were.
  int resolve_impacts() {
    island_.set_solver_bodies();
    const Scratch<std::size_t> touching = touching_pairs();
    JointedBlow<D> jointed(island_, move_.work);
    int impacts = 0;
    bool any = true;
    for (int round = 0; any && round < kImpactSettings.most_rounds; ++round) {
      const int before = impacts;
      // A blow that does not come to its end is ended without restitution.
      const bool tired = round >= kImpactSettings.bouncing_rounds;
      for (const std::size_t i : touching) {
        stop_if_asked();
        IslandPair<D>& pair = island_.pairs[i];
        if (!approaches(pair)) continue;
        if (tired) {  // squeezed: nor may it bounce in the sub-steps that follow
          pair.pressed = true;
          pair.rows.restitution = 0;
        }
        pair.touched = true;
        ++impacts;
        if (jointed.holds(pair.rows)) {
          jointed.add(pair);
          continue;
        }
        resolve(pair.rows, island_.solver_bodies[pair.rows.a], island_.solver_bodies[pair.rows.b]);
        pair.record_impulses();
      }
      jointed.strike();
      any = impacts > before;
    }
    if (impacts > 0) let_struck_go();
    for (std::size_t i = 0; i < island_.bodies.size(); ++i) {
      if (!island_.bodies[i].is_dynamic()) continue;
      island_.bodies[i].velocity = island_.solver_bodies[i].velocity;
      island_.bodies[i].angular_momentum += island_.solver_bodies[i].twist;
    }
    return impacts;
  }

  // Bodies that rest on others do not fall while something comes: only the free ones are
  // accelerated.
  Scratch<Trajectory<D>> trajectories(double within) const {
    Scratch<Trajectory<D>> all;
    for (std::size_t i = 0; i < island_.bodies.size(); ++i) {
      const Body<D>& body = island_.bodies[i];
      const Increment<D>& free = island_.increments[i];
      Trajectory<D> path{&body, body.moves() ? body.velocity : Vec<D>(0.0), Vec<D>(0.0)};
      path.rotation = body.rotation.value_or(move_.config.rotation);
      if (body.asleep) path.velocity = Vec<D>(0.0);
      path.bend = free.kick / within + free.drift / (within * within);
      all.push_back(path);
    }
    for (const IslandPair<D>& pair : island_.pairs)
      if (pair.pressed)
        for (const std::uint32_t i : {pair.rows.a, pair.rows.b}) {
          all[i].held = glm::length(island_.increments[i].kick) / within;
          all[i].bend = Vec<D>(0.0);
        }
    return all;
  }

  // What was struck may come from farther than the pair was looked for when the step began.
  double reach_of(const IslandPair<D>& pair, const Trajectory<D>& a, const Trajectory<D>& b) const {
    const double bends = glm::length(b.bend) + glm::length(a.bend);
    return std::max(pair.reach, way_of(*a.body, *b.body, left_) + bends * left_ * left_);
  }

  // What is known of a pair stays so as long as both bodies fly on as was foreseen.
  void forget_what_left_its_way(const Scratch<Trajectory<D>>& flying) {
    foreseen_.resize(island_.pairs.size());
    Scratch<std::uint8_t> strayed(flying.size());
    for (std::size_t i = 0; i < flying.size(); ++i)
      strayed[i] = ways_.empty() || !goes_on(ways_[i], ways_begun_ - left_, flying[i]);
    for (std::size_t i = 0; i < foreseen_.size(); ++i) {
      const IslandPair<D>& pair = island_.pairs[i];
      if (pair.pressed || strayed[pair.rows.a] || strayed[pair.rows.b]) foreseen_[i] = {};
    }
    seen_bodies_ = island_.bodies;
    ways_ = flying;
    ways_begun_ = left_;
    for (std::size_t i = 0; i < ways_.size(); ++i) ways_[i].body = &seen_bodies_[i];
  }

  static bool goes_on(const Trajectory<D>& way, double t, const Trajectory<D>& now) {
    if (!way.body->moves()) return true;
    const Body<D> there = flown(way, t);
    const double speed = glm::length(there.velocity), bend = glm::length(way.bend);
    double turned = 0;
    for (int i = 0; i < D; ++i)
      turned += glm::length(matrix(there.orientation)[i] - matrix(now.body->orientation)[i]);
    const double same = kImpactSettings.same_way;
    return there.angular_momentum == now.body->angular_momentum && turned <= same &&
           glm::length(there.velocity - now.velocity) <= same * speed &&
           glm::length(way.bend - now.bend) <= same * bend &&
           glm::length(there.position - now.body->position) <=
               2 * std::numeric_limits<double>::epsilon() * glm::length(there.position) +
                   same * (speed + bend * t) * t;
  }

  // The next impact, or the next contact of what turns. Pairs that meet too slowly become contacts
  // on the way: since they stand from then on, others may meet them, and all are looked at anew.
  // When the budget is used up all others are contacts, too.
  std::optional<Impact<D>> next_event() {
    if (std::ranges::none_of(island_.pairs, &IslandPair<D>::located)) return std::nullopt;
    if (budget_ <= 0) {
      for (IslandPair<D>& pair : island_.pairs) pair.pressed = true;
      return std::nullopt;
    }
    const double within = left_;
    find_increments_if_any<D>(move_.config, island_.bodies, island_.forces, within,
                              island_.increments, move_.work);
    std::vector<ImpactLook<D>>* const looks = log_.keeps_looks ? &log_.looks : nullptr;
    const Scratch<Trajectory<D>> flying = trajectories(within);
    forget_what_left_its_way(flying);
    std::optional<Impact<D>> first;
    bool pressed = false;
    for (std::size_t i = 0; i < island_.pairs.size(); ++i) {
      stop_if_asked();
      IslandPair<D>& pair = island_.pairs[i];
      const Trajectory<D>& a = flying[pair.rows.a];
      const Trajectory<D>& b = flying[pair.rows.b];
      pair.slow = slowest_impact(a, b, move_.h);
      if (!pair.located && way_of(*a.body, *b.body, within) > pair.fast) {
        pair.located = true;  // since it was struck
        pair.pressed = false;
      }
      if (!pair.located || pair.pressed) continue;
      Foreseen<D>& seen = foreseen_[i];
      if (!seen.known || (!seen.met && seen.until > left_ - (first ? first->time : within))) {
        // What turns fast is looked at no further than to the first impact.
        const bool whole = !first || holds(pair, Vec<D>(0.0));
        const double ahead = whole ? within : first->time;
        const double since = move_.h - within;
        seen = {true, within - ahead,
                time_of_impact<D>(
                    {a, b, ahead, pair.slow, reach_of(pair, a, b), move_.work, looks, since})};
        if (seen.met) seen.until = within - seen.met->seconds;
      }
      if (!seen.met) continue;
      const double time = std::max(within - seen.until, 0.0);
      if (seen.met->meeting == Meeting::rests && holds(pair, seen.met->normal)) {
        press(pair);
        pressed = true;
      } else if (!first || time < first->time) {
        first = Impact<D>{time, &pair, seen.met->meeting};
      }
    }
    if (first) foreseen_[static_cast<std::size_t>(first->pair - island_.pairs.data())] = {};
    return pressed ? next_event() : first;
  }

  const IslandMove<D>& move_;
  Island<D>& island_;
  const ContactSolver& solver_;
  int& budget_;
  ImpactLog<D>& log_;
  Scratch<Body<D>> begun_ = island_.bodies;
  double left_ = move_.h;
  bool fresh_ = true;              // nothing of the step has been yet
  Scratch<Foreseen<D>> foreseen_;  // of each pair
  Scratch<Trajectory<D>> ways_;    // by which that was foreseen, of
  Scratch<Body<D>> seen_bodies_;
  double ways_begun_ = 0;
  int parts_ = kImpactSettings.most_parts;
  double last_part_ = HUGE_VAL;
  std::optional<DepthBound<D>> bound_;
};

}  // namespace

template <int D>
void move_through_impacts(const IslandMove<D>& move, const ContactSolver& solver, int& budget,
                          ImpactLog<D>& log) {
  ImpactMotion<D>(move, solver, budget, log).run();
}

template void move_through_impacts(const IslandMove<2>&, const ContactSolver&, int&, ImpactLog<2>&);
template void move_through_impacts(const IslandMove<3>&, const ContactSolver&, int&, ImpactLog<3>&);

}  // namespace lantern::physics
