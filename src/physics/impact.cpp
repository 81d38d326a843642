#include "physics/impact.hpp"

#include <algorithm>
#include <cmath>

namespace lantern {
namespace {

constexpr int kBouncingRounds = 64;    // through all touching pairs, in one impact
constexpr int kMostRounds = 96;        // the last ones without restitution
constexpr int kMostPointSweeps = 200;  // over the points of one pair
constexpr double kTouching = 1e-9;     // of the sizes: so near is touching

// Newton's law of restitution at all points of a pair at once: those that approach will part with
// the given part of their speed.
template <int D>
bool resolve(ContactRows<D>& rows, Mover<D>& a, Mover<D>& b, double restitution, double slow,
             WorldWork& work) {
  bool approaches = false;
  for (ContactPoint<D>& p : rows.points()) {
    const double parting = glm::dot(relative_velocity(a, p.arm_a, b, p.arm_b), rows.normal);
    if (parting < -slow) approaches = true;
    p.bounce = parting < 0 ? -restitution * parting : 0;
    p.pn = 0;
    p.pt = Vec<D>(0.0);
    p.separation = 0;
  }
  if (!approaches) return false;
  for (int i = 0; i < kMostPointSweeps; ++i) {
    Sweep sweep;
    sweep_velocities(rows, a, b, 1, sweep);
    work.constraint_rows += sweep.rows;
    work.friction_rows += sweep.friction_rows;
    if (rows.count == 1 && rows.friction == 0) break;
    if (sweep.change <= 1e-15 * sweep.largest) break;
  }
  return true;
}

template <int D>
void record_impulses(IslandPair<D>& pair) {
  pair.touched = true;
  for (int i = 0; i < pair.rows.count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    pair.record.normal_impulses[at] += pair.rows.room[at].pn;
    pair.record.friction_impulses[at] += pair.rows.room[at].pt;
  }
}

// Sets up the points of all pairs that touch now.
template <int D>
std::vector<std::size_t> touching_pairs(Island<D>& island, WorldWork& work) {
  std::vector<std::size_t> touching;
  for (std::size_t i = 0; i < island.pairs.size(); ++i) {
    IslandPair<D>& pair = island.pairs[i];
    const Body<D>& a = island.bodies[pair.rows.a];
    const Body<D>& b = island.bodies[pair.rows.b];
    const double size = std::min(thickness<D>(a.shape), thickness<D>(b.shape));
    pair.rows.count = 0;
    ++work.narrow_tests;
    const auto manifold = collide(Placed<D>{a.shape, a.position, a.orientation},
                                  Placed<D>{b.shape, b.position, b.orientation}, kTouching * size);
    if (!manifold) continue;
    set_points<D>(pair.rows, *manifold, a, b, nullptr, 0);
    refresh(pair.rows, a, b, island.movers[pair.rows.a], island.movers[pair.rows.b], 0);
    renew_record(pair.record, *manifold);
    work.contact_points += static_cast<std::uint64_t>(pair.rows.count);
    touching.push_back(i);
  }
  return touching;
}

}  // namespace

template <int D>
int resolve_impacts(Island<D>& island, WorldWork& work) {
  island.movers.clear();
  for (const Body<D>& body : island.bodies) island.movers.push_back(mover_of(body));
  const std::vector<std::size_t> touching = touching_pairs(island, work);
  int impacts = 0;
  bool any = true;
  for (int round = 0; any && round < kMostRounds; ++round) {
    any = false;
    // A blow that does not come to its end is ended without restitution.
    const bool tired = round >= kBouncingRounds;
    for (const std::size_t i : touching) {
      IslandPair<D>& pair = island.pairs[i];
      const double restitution = tired ? 0 : pair.rows.restitution;
      if (!resolve(pair.rows, island.movers[pair.rows.a], island.movers[pair.rows.b], restitution,
                   pair.slow, work))
        continue;
      record_impulses(pair);
      pair.pressed |= tired;
      ++impacts;
      any = true;
    }
  }
  for (std::size_t i = 0; i < island.bodies.size(); ++i) {
    if (island.bodies[i].kind != BodyKind::dynamic_body) continue;
    island.bodies[i].velocity = island.movers[i].velocity;
    island.bodies[i].angular_momentum += island.movers[i].twist;
  }
  return impacts;
}

namespace {

// Bodies that rest on others do not fall while something comes: only the free ones are accelerated.
template <int D>
std::vector<Course<D>> courses(const Island<D>& island, double within) {
  std::vector<Course<D>> all;
  for (std::size_t i = 0; i < island.bodies.size(); ++i) {
    const Body<D>& body = island.bodies[i];
    const Increment<D>& free = island.increments[i];
    Course<D> course{&body, body.moves() ? body.velocity : Vec<D>(0.0), Vec<D>(0.0)};
    if (body.asleep) course.velocity = Vec<D>(0.0);
    course.bend = free.kick / within + free.drift / (within * within);
    all.push_back(course);
  }
  for (const IslandPair<D>& pair : island.pairs)
    if (pair.pressed)
      for (const std::uint32_t i : {pair.rows.a, pair.rows.b}) {
        all[i].held = glm::length(island.increments[i].kick) / within;
        all[i].bend = Vec<D>(0.0);
      }
  return all;
}

template <int D>
struct Impact {
  double time = 0;
  IslandPair<D>* pair = nullptr;
};

// The next impact. Pairs that meet too slowly become contacts on the way.
template <int D>
std::optional<Impact<D>> next_impact(Island<D>& island, double within, double step,
                                     WorldWork& work) {
  const std::vector<Course<D>> flying = courses(island, within);
  std::optional<Impact<D>> first;
  for (IslandPair<D>& pair : island.pairs) {
    const Course<D>& a = flying[pair.rows.a];
    const Course<D>& b = flying[pair.rows.b];
    pair.slow = slowest_impact(a, b, step);
    if (!pair.located || pair.pressed) continue;
    const auto met = meeting(a, b, within, pair.slow, pair.reach, work.narrow_tests);
    if (!met) continue;
    if (met->rests)
      pair.pressed = true;
    else if (!first || met->time < first->time)
      first = Impact<D>{met->time, &pair};
  }
  return first;
}

}  // namespace

template <int D>
void advance_island(Island<D>& island, const WorldConfig<D>& config, double h, int& budget,
                    WorldWork& work) {
  double left = h;
  const bool any_located = std::any_of(island.pairs.begin(), island.pairs.end(),
                                       [](const auto& pair) { return pair.located; });
  while (any_located) {
    find_increments_if_any<D>(config, island.bodies, island.forces, left, island.increments, work);
    const auto next = next_impact(island, left, h, work);
    if (!next) break;
    if (budget <= 0) {  // the rest of the step is soft for all
      for (IslandPair<D>& pair : island.pairs) pair.pressed = true;
      break;
    }
    if (next->time > 0) move_island(island, config, next->time, h, work);
    left -= next->time;
    const int impacts = resolve_impacts(island, work);
    work.impacts_located += static_cast<std::uint64_t>(impacts);
    budget -= std::max(impacts, 1);
    if (impacts == 0) next->pair->pressed = true;  // others have moved its bodies off their course
    for (IslandPair<D>& pair : island.pairs)       // what does not bounce stays
      if (pair.touched && pair.rows.restitution == 0) pair.pressed = true;
    if (!(left > 0)) return;
  }
  move_island(island, config, left, h, work);
}

#define LANTERN_INSTANTIATE(D)                          \
  template int resolve_impacts(Island<D>&, WorldWork&); \
  template void advance_island(Island<D>&, const WorldConfig<D>&, double, int&, WorldWork&);

LANTERN_INSTANTIATE(2)
LANTERN_INSTANTIATE(3)
#undef LANTERN_INSTANTIATE

}  // namespace lantern
