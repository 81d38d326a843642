// One step of the world while it is made. It works on copies, so that a step that is refused half
// way, or stopped (base/stop.hpp), leaves the world as it was.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "base/memory.hpp"
#include "base/stop.hpp"
#include "geometry/not_finite.hpp"
#include "physics/impact/impacts.hpp"
#include "physics/islands.hpp"
#include "physics/world.hpp"

namespace lantern::physics {
namespace {

// The numbers of a step, whatever the method.
struct StepSettings {
  int most_tries = 4;     // the last one counts even if a body went farther than was looked for
  double slack = 1e-3;    // of a body's thickness: nearer is looked at, too
  double fast = 0.5;      // of the thinner body's thickness in a step: may pass through
  double fast_quick = 2;  // the same where an error is wanted: rows hold what is slower
  std::size_t most_manifolds = 1 << 16;  // kept from the narrow phase; of more, made again
  double rounding = 1e-9;  // of a step's time, when a push ends; of a reach, whether it was kept
};
constexpr StepSettings kStepSettings;

template <int D>
double slack(const Body<D>& body) {
  const double t = thickness<D>(body.shape);
  return t < kEndless ? t * kStepSettings.slack : 0;
}

// How far a surface moves because its body turns.
template <int D>
double turning_way(const Body<D>& body, double h) {
  const double radius = turning_reach<D>(body.shape);
  if (radius == 0 || !body.moves() || body.asleep) return 0;
  const Spin<D> spin = angular_velocity(body);
  return radius * std::min(std::sqrt(dot(spin, spin)) * h, std::numbers::pi);
}

template <int D>
Vec<D> velocity_of(const Body<D>& body) {
  return body.moves() && !body.asleep ? body.velocity : Vec<D>(0.0);
}

// How far a surface may come if no force acts.
template <int D>
double coasting_reach(const Body<D>& body, double h) {
  return slack(body) + turning_way(body, h) + glm::length(velocity_of(body)) * h;
}

}  // namespace

template <int D>
struct World<D>::Step {
  // Two bodies that may touch. Of what an IslandPair holds only what is known before the island is
  // moved: there may be millions.
  struct NearPair {
    std::uint32_t a = 0, b = 0;  // places among all bodies
    double restitution = 0;
    double friction = 0;
    double reach = 0;
    const Touch<D>* touch = nullptr;  // of the step before, if they touched in it
    std::uint32_t manifold = kNone;   // as they were found to lie; none of too many
    bool located = false;
  };
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};
  // What a solver is given together: places of bodies, of near pairs, of joints, of what pulls and
  // pushes them; all ascending.
  struct Group {
    std::vector<std::uint32_t> bodies;
    std::vector<std::size_t> pairs, joints, springs, pushes;
  };

  World& world;
  double h;
  std::vector<double> reach;  // of each body: how far its surface may come; at least as given
  std::vector<Body<D>> moved = world.bodies_;
  std::vector<double> rested = world.rested_;
  std::vector<JointMemory<D>> joint_memories = world.joint_memories_;
  Forces<D> forces = world.forces_;
  std::vector<TimedPush> pushes = {};
  std::vector<Increment<D>> anew = {};  // increments anew, since bodies woke in this step
  std::vector<Proxy<D>> boxes = {};     // of bodies, enlarged by how far each may come
  std::uint64_t narrow_pairs = 0;       // of the broad phase's, looked at by the narrow phase
  std::vector<NearPair> near = {};      // in order of ids
  std::vector<Mat<D>> axes = {};        // of bodies, as the narrow phase sees them
  std::vector<Manifold<D>> manifolds = {};
  std::vector<std::uint32_t> root = {};         // of each body's island; static ones have their own
  std::vector<std::uint32_t> local_place = {};  // of each body in the island that was gathered last
  std::vector<Touch<D>> touching = {};
  std::vector<std::uint32_t> touch_of = {};  // of each near pair; kNone: it did not touch
  bool struck = false;                       // an impact was located
  Outcome outcome = {.impacts = {{}, {}, world.outcome_.impacts.keeps_looks}};

  // The phases, in their order: see World::step.
  void find_forces() {
    std::vector<std::uint32_t> released;
    for (const TimedPush& push : world.pushes_) {
      if (push.until && *push.until <= world.time_ + kStepSettings.rounding * h)
        released.push_back(place_of(push.push.body));
      else
        pushes.push_back(push);
    }
    forces.pushes.clear();
    for (const TimedPush& push : pushes) forces.pushes.push_back(push.push);
    wake(std::move(released));
    // Once a step, by looking ahead or in the first of several tries: they follow from the world as
    // it was before.
    if (!world.ahead_ || world.ahead_->h != h) {
      Ahead found{h, {}, 0};
      if (flies_anywhere())
        find_increments_if_any<D>(world.config_, moved, forces, h, found.increments, world.work_);
      else
        found.increments.resize(moved.size());
      world.ahead_ = std::move(found);
    }
    world.work_.force_evaluations += std::exchange(world.ahead_->force_evaluations, 0);
    find_reach();
  }

  void refresh_boxes() {
    require_boxes();
    if (looks_for_contacts()) boxes = enlarged_boxes();
  }

  void broad_phase() {
    if (!looks_for_contacts()) return;
    BroadPhase<D>& structure = world.structure();
    structure.update(boxes);
    outcome.pairs = structure.pairs();
    ++world.work_.broad_phases;
    world.work_.pair_tests += structure.counters().pair_tests;
    world.work_.candidate_pairs += outcome.pairs.size();
  }

  void narrow_phase() {
    near.clear();
    narrow_pairs = 0;
    manifolds.clear();
    axes.clear();
    for (const Body<D>& body : moved) axes.push_back(axes_of(body));
    const std::vector<Pair> joined = joined_pairs();
    auto touch = world.touching_.begin();  // in order of ids, as the pairs are
    for (const Pair& pair : outcome.pairs) {
      stop_if_asked();
      if (std::ranges::binary_search(joined, pair)) continue;
      auto found = nearing(pair);
      if (!found) continue;
      while (touch != world.touching_.end() && touch->record.pair() < pair) ++touch;
      if (touch != world.touching_.end() && touch->record.pair() == pair) found->touch = &*touch;
      near.push_back(*found);
    }
    // They are made when their islands are moved, and remembered for the next step.
    constexpr std::uint64_t kEach =
        sizeof(NearPair) + sizeof(IslandPair<D>) + 2 * (sizeof(Touch<D>) + sizeof(Contact<D>));
    require_memory(kEach * near.size(), fmt::format("{} pairs that may touch", near.size()),
                   "take fewer bodies that overlap");
  }

  // Whether any woke, who may touch others.
  bool wake_what_is_touched() {
    if (!looks_for_contacts()) return false;
    std::vector<std::uint32_t> woken;
    for (const NearPair& pair : near) {
      if (moved[pair.a].asleep) woken.push_back(pair.a);
      if (moved[pair.b].asleep) woken.push_back(pair.b);
    }
    const auto tied = [&](BodyId first, BodyId second) {
      const std::uint32_t a = place_of(first), b = place_of(second);
      if (moved[a].asleep && moved[b].stirs()) woken.push_back(a);
      if (moved[b].asleep && moved[a].stirs()) woken.push_back(b);
    };
    for (const auto& entry : world.joints_) tied(entry.second.a, entry.second.b);
    for (const Spring<D>& spring : forces.springs) tied(spring.a, spring.b);
    if (woken.empty()) return false;
    wake(std::move(woken));
    find_increments_if_any<D>(world.config_, moved, forces, h, anew, world.work_);
    find_reach();
    return true;
  }

  // Static and kinematic bodies do not join what touches them.
  void make_islands() {
    DisjointSets sets(moved.size());
    const auto unite = [&](std::uint32_t a, std::uint32_t b) {
      if (moved[a].kind == BodyKind::dynamic_body && moved[b].kind == BodyKind::dynamic_body)
        sets.unite(a, b);
    };
    for (const NearPair& pair : near) unite(pair.a, pair.b);
    // What sleeps is not looked at: it hangs together as when it fell asleep.
    for (const Touch<D>& touch : world.touching_) {
      const std::uint32_t a = place_of(touch.record.a), b = place_of(touch.record.b);
      if (moved[a].asleep && moved[b].asleep) unite(a, b);
    }
    for (const auto& entry : world.joints_)
      unite(place_of(entry.second.a), place_of(entry.second.b));
    for (const Spring<D>& spring : forces.springs) unite(place_of(spring.a), place_of(spring.b));
    // What attracts hangs together over any distance.
    std::optional<std::uint32_t> first;
    for (std::uint32_t i = 0; forces.gravitation > 0 && i < moved.size(); ++i) {
      if (moved[i].kind != BodyKind::dynamic_body) continue;
      if (!first) first = i;
      unite(*first, i);
    }
    root.clear();
    for (std::size_t i = 0; i < moved.size(); ++i)
      root.push_back(sets.root(static_cast<std::uint32_t>(i)));
    world.work_.islands = 0;
    for (std::size_t i = 0; i < moved.size(); ++i)
      world.work_.islands += root[i] == i && moved[i].is_pushed();
  }

  void solve_and_integrate() {
    const ContactSolver& solver = contact_solver(world.config_.contacts);
    std::vector<std::uint8_t> solved(moved.size());
    touch_of.assign(near.size(), kNone);
    touching.reserve(std::min(near.size(), world.touching_.size() + world.touching_.size() / 8));
    int budget = world.config_.impact_budget;
    const std::uint64_t located = world.work_.impacts_located;
    for (const Group& group : groups_to_solve(solver.whole_world)) {
      stop_if_asked();
      Island<D> island = gather(group);
      ++world.work_.islands_solved;
      const IslandMove<D> move{island, world.config_, h, h, world.work_};
      if (solver.whole_world)
        solver.solve.in<D>()(move);
      else
        move_through_impacts(move, solver, budget, outcome.impacts);
      bring_back(island, group);
      for (const std::uint32_t i : group.bodies) solved[i] = moved[i].is_pushed();
    }
    struck = world.work_.impacts_located != located;
    for (std::size_t i = 0; i < moved.size(); ++i)
      if (!solved[i]) fly(moved[i], increments()[i], h, world.config_.rotation, world.work_);
  }

  void require_no_overflow() const {
    const auto refuse = [&](const Body<D>& body, const char* field) {
      throw Refused(fmt::format("body '{}': {} overflows in step {}", body.name, field,
                                world.work_.steps + 1));
    };
    for (const Body<D>& body : moved) {
      if (!is_finite(body.velocity)) refuse(body, "velocity");
      if (!is_finite(body.angular_momentum)) refuse(body, "angular_momentum");
      if (!is_valid(body.box())) refuse(body, "position");
    }
  }

  // Whether all bodies were looked for where they have been; if not, `reach` has grown.
  bool stayed_within_reach() {
    if (!locates_impacts()) return true;
    // What is pushed apart goes no farther than it is allowed to; only an impact does.
    if (world.config_.wanted_error > 0 && !struck) return true;
    bool stayed = true;
    for (std::size_t i = 0; i < moved.size(); ++i) {
      if (!moved[i].is_pushed()) continue;
      const double way = glm::length(moved[i].position - world.bodies_[i].position);
      if (way <= reach[i] * (1 + kStepSettings.rounding)) continue;
      reach[i] = 2 * std::max(way, glm::length(moved[i].velocity) * h);
      stayed = false;
    }
    return stayed;
  }

  // An island sleeps when all of it has been slow for a while and something holds it, or drag
  // brakes it; a body that flies freely sleeps only if it does not move at all. What attracts each
  // other never rests: something far away may come nearer.
  void fall_asleep() {
    world.work_.asleep = 0;
    if (world.config_.may_sleep && !(forces.gravitation > 0)) {
      std::vector<std::uint8_t> restless(moved.size()), held(moved.size());
      for (const Touch<D>& touch : touching)
        for (const BodyId id : {touch.record.a, touch.record.b}) {
          held[root[place_of(id)]] = true;
          const BodyId other = id == touch.record.a ? touch.record.b : touch.record.a;
          if (moved[place_of(id)].kind != BodyKind::dynamic_body && moved[place_of(id)].stirs())
            restless[root[place_of(other)]] = true;
        }
      for (const auto& entry : world.joints_)
        for (const BodyId id : {entry.second.a, entry.second.b}) held[root[place_of(id)]] = true;
      for (std::size_t i = 0; i < moved.size(); ++i) {
        const Body<D>& body = moved[i];
        if (!body.is_pushed()) continue;
        ++world.work_.rest_checks;
        const bool still = body.velocity == Vec<D>(0.0) && body.angular_momentum == Spin<D>(0.0) &&
                           increments()[i].kick == Vec<D>(0.0);
        const bool braked = body.linear_drag > 0 && (body.angular_drag > 0 || !body.may_turn ||
                                                     body.angular_momentum == Spin<D>(0.0));
        rested[i] = (held[root[i]] || braked ? is_slow(i) : still) ? rested[i] + h : 0;
        if (!(rested[i] >= world.config_.sleep_after)) restless[root[i]] = true;
      }
      for (std::size_t i = 0; i < moved.size(); ++i) {
        Body<D>& body = moved[i];
        if (!body.is_pushed() || restless[root[i]]) continue;
        body.asleep = true;
        body.velocity = Vec<D>(0.0);
        body.angular_momentum = Spin<D>(0.0);
      }
    }
    for (const Body<D>& body : moved) world.work_.asleep += body.asleep;
  }

  // Contacts in order of ids, and what is new about them.
  void update_contact_events() {
    order_touches();
    for (const Touch<D>& touch : touching) outcome.contacts.push_back(touch.record);

    const std::vector<Contact<D>>& contacts = outcome.contacts;
    const std::vector<std::uint8_t> crush =
        crushing<D>(contacts, [&](BodyId id) -> const Body<D>& { return moved[place_of(id)]; });
    const int frames = contact_solver(world.config_.contacts).frames_remembered;
    const std::vector<Told>& old = world.outcome_.told;
    std::size_t i = 0, j = 0;
    while (i < old.size() || j < contacts.size()) {
      stop_if_asked();
      const bool parted =
          j == contacts.size() || (i < old.size() && old[i].pair < contacts[j].pair());
      const bool known = parted || (i < old.size() && old[i].pair == contacts[j].pair());
      const Told now = {parted ? old[i].pair : contacts[j].pair(),
                        (parted ? std::min(old[i].frames_left, frames) : frames) - 1};
      if (parted && now.frames_left < 0)
        outcome.events.push_back({ContactEvent::Kind::end, now.pair.a, now.pair.b});
      else
        outcome.told.push_back(now);
      if (!parted)
        outcome.events.push_back({known ? ContactEvent::Kind::stay : ContactEvent::Kind::begin,
                                  now.pair.a, now.pair.b, !crush.empty() && crush[j] != 0});
      if (known) ++i;
      if (!parted) ++j;
    }
  }

  void commit() {
    world.bodies_ = std::move(moved);
    world.rested_ = std::move(rested);
    world.may_rest_ =
        world.work_.asleep > 0 ||
        std::ranges::any_of(world.rested_, [](double seconds) { return seconds > 0; });
    for (std::size_t i = 0; i < world.bodies_.size(); ++i)
      world.islands_[i] =
          world.bodies_[i].kind == BodyKind::dynamic_body ? world.bodies_[root[i]].id : kNoIsland;
    world.joint_memories_ = std::move(joint_memories);
    world.pushes_ = std::move(pushes);
    world.forces_.pushes = std::move(forces.pushes);
    world.touching_ = std::move(touching);
    world.outcome_ = std::move(outcome);
    world.ahead_.reset();
    world.time_ += h;
    ++world.work_.steps;
    world.work_.narrow_pairs += narrow_pairs;
  }

  // Over the whole step, if nothing touches.
  const std::vector<Increment<D>>& increments() const {
    return anew.empty() ? world.ahead_->increments : anew;
  }

  // What looking ahead asks for.
  void require_boxes() const {
    for (std::size_t i = 0; i < moved.size(); ++i)
      if (!is_valid(enlarged_box(i)))
        throw Refused(fmt::format("body '{}': position overflows in step {}", moved[i].name,
                                  world.work_.steps + 1));
  }

  std::vector<Proxy<D>> enlarged_boxes() const {
    std::vector<Proxy<D>> proxies;
    for (std::size_t i = 0; i < moved.size(); ++i)
      if (moved[i].collides)
        proxies.push_back({moved[i].id, enlarged_box(i), !moved[i].moves(), moved[i].stirs()});
    return proxies;
  }

 private:
  bool collides() const { return world.config_.contacts != ContactMethod::none; }
  bool locates_impacts() const {
    return collides() && world.config_.continuous &&
           !contact_solver(world.config_.contacts).whole_world;
  }
  std::uint32_t place_of(BodyId id) const { return static_cast<std::uint32_t>(world.index_of(id)); }

  // Slow, and slow for another second if it is accelerated as in this step: a pendulum at its
  // turning point is not at rest.
  bool is_slow(std::size_t place) const {
    const Body<D>& body = moved[place];
    const Body<D>& before = world.bodies_[place];
    const double gained = glm::length(body.velocity - before.velocity) / h;
    const Spin<D> spin = angular_velocity(body), spin_before = angular_velocity(before);
    const Spin<D> turned_faster = spin - spin_before;
    const double spun = std::sqrt(dot(turned_faster, turned_faster)) / h;
    // What is pushed out of another one moves, too, though it has no velocity.
    const double way = glm::length(body.position - before.position) / h;
    return std::max(glm::length(body.velocity), way) + gained <= world.config_.sleep_speed &&
           std::sqrt(dot(spin, spin)) + spun <= world.config_.sleep_spin;
  }

  // Whether anything flies, or may be met, where it would fly: not if joints hold all that moves.
  bool flies_anywhere() const {
    if (collides()) return true;
    std::vector<std::uint8_t> held(moved.size());
    for (const auto& entry : world.joints_)
      for (const BodyId id : {entry.second.a, entry.second.b}) held[place_of(id)] = true;
    for (std::size_t i = 0; i < moved.size(); ++i)
      if (moved[i].kind == BodyKind::dynamic_body && !held[i]) return true;
    return false;
  }

  void find_reach() {
    reach.resize(moved.size());
    for (std::size_t i = 0; i < moved.size(); ++i) {
      const Body<D>& body = moved[i];
      const Increment<D>& increment = increments()[i];
      const double way =
          coasting_reach(body, h) + glm::length(increment.kick) * h + glm::length(increment.drift);
      reach[i] = std::max(reach[i], way);
    }
  }

  Box<D> enlarged_box(std::size_t place) const {
    const Box<D> box = moved[place].box();
    return {box.lo - Vec<D>(reach[place]), box.hi + Vec<D>(reach[place])};
  }

  bool looks_for_contacts() const {
    return collides() && std::ranges::any_of(moved, &Body<D>::stirs);
  }

  // What a joint ties together without letting it touch; ascending.
  std::vector<Pair> joined_pairs() const {
    std::vector<Pair> joined;
    for (const auto& [id, joint] : world.joints_)
      if (!joint.collide)
        joined.push_back({std::min(joint.a, joint.b), std::max(joint.a, joint.b)});
    std::ranges::sort(joined);
    return joined;
  }

  // The pair, if the two may come to touch in this step.
  std::optional<NearPair> nearing(const Pair& pair) {
    NearPair found;
    found.a = place_of(pair.a);
    found.b = place_of(pair.b);
    const Body<D>& a = moved[found.a];
    const Body<D>& b = moved[found.b];
    if (a.kind != BodyKind::dynamic_body && b.kind != BodyKind::dynamic_body) return std::nullopt;
    const double way =
        glm::length(velocity_of(b) - velocity_of(a)) * h + turning_way(a, h) + turning_way(b, h);
    // An impact with a third body may turn either of them towards the other.
    found.reach = reach[found.a] + reach[found.b];
    ++narrow_pairs;
    ++world.work_.narrow_tests;
    const auto manifold =
        collide<D>({a.shape, a.position, a.orientation, axes[found.a]},
                   {b.shape, b.position, b.orientation, axes[found.b]}, found.reach);
    if (!manifold) return std::nullopt;
    found.restitution = std::max(a.material.restitution, b.material.restitution);
    found.friction = std::sqrt(a.material.friction * b.material.friction);
    const double thin = std::min(thickness<D>(a.shape), thickness<D>(b.shape));
    const double fast =
        world.config_.wanted_error > 0 ? kStepSettings.fast_quick : kStepSettings.fast;
    found.located = locates_impacts() && (found.restitution > 0 || way > fast * thin);
    if (manifolds.size() < kStepSettings.most_manifolds) {
      found.manifold = static_cast<std::uint32_t>(manifolds.size());
      manifolds.push_back(*manifold);
    }
    return found;
  }

  IslandPair<D> island_pair(const NearPair& from) const {
    IslandPair<D> pair;
    pair.rows.a = from.a;
    pair.rows.b = from.b;
    pair.rows.restitution = from.restitution;
    pair.rows.friction = from.friction;
    pair.reach = from.reach;
    pair.located = from.located;
    pair.pressed = !from.located;
    if (from.touch != nullptr) pair.touch = *from.touch;
    pair.touch.record = {moved[from.a].id, moved[from.b].id, {}, {}, {}};
    if (from.manifold != kNone) pair.seen = &manifolds[from.manifold];
    return pair;
  }

  void wake(std::vector<std::uint32_t> places) {
    wake_together<D>(moved, rested, std::move(places), world.links(), Disturbed::sleepers);
  }

  // Which bodies, pairs and joints the solver is given together: those of each island, or of the
  // whole world. What neither touches nor is joined is in none of them, but flies.
  std::vector<Group> groups_to_solve(bool whole_world) const {
    const auto dynamic = [&](std::uint32_t i) { return moved[i].kind == BodyKind::dynamic_body; };
    const auto own = [&](std::uint32_t i) { return whole_world ? 0 : root[i]; };
    const auto owner = [&](std::uint32_t a, std::uint32_t b) { return own(dynamic(a) ? a : b); };
    const auto places = [&](const auto& tie) {
      return std::pair(place_of(tie.a), place_of(tie.b));
    };
    // Of each root the number of its group, if pairs or joints are to be solved in it.
    std::vector<std::uint32_t> number(moved.size(), kNone);
    for (const NearPair& pair : near) number[owner(pair.a, pair.b)] = 0;
    for (const auto& [id, joint] : world.joints_) number[std::apply(owner, places(joint))] = 0;
    std::vector<Group> groups;
    for (std::uint32_t& n : number) {
      if (n == kNone) continue;
      n = static_cast<std::uint32_t>(groups.size());
      groups.emplace_back();
    }
    const auto add = [&](std::uint32_t to, auto list, auto what) {
      if (number[to] != kNone) (groups[number[to]].*list).push_back(what);
    };
    for (std::size_t i = 0; i < near.size(); ++i)
      add(owner(near[i].a, near[i].b), &Group::pairs, i);
    for (std::size_t i = 0; i < world.joints_.size(); ++i)
      add(std::apply(owner, places(world.joints_[i].second)), &Group::joints, i);
    for (std::size_t i = 0; i < forces.springs.size(); ++i) {
      const auto [a, b] = places(forces.springs[i]);
      if (whole_world || dynamic(a) || dynamic(b)) add(owner(a, b), &Group::springs, i);
    }
    for (std::size_t i = 0; i < forces.pushes.size(); ++i) {
      const std::uint32_t pushed = place_of(forces.pushes[i].body);
      if (whole_world || dynamic(pushed)) add(own(pushed), &Group::pushes, i);
    }
    for (std::uint32_t i = 0; i < moved.size(); ++i)
      if (whole_world || dynamic(i)) add(own(i), &Group::bodies, i);
    std::erase_if(groups, [&](const Group& group) {
      return std::ranges::all_of(group.bodies, [&](std::uint32_t i) { return moved[i].asleep; });
    });
    return groups;
  }

  Island<D> gather(const Group& group) {
    Island<D> island;
    std::vector<std::uint32_t> others;  // static bodies, and ends of springs
    const auto add = [&](BodyId id) { others.push_back(place_of(id)); };
    for (const std::size_t i : group.pairs)
      for (const std::uint32_t place : {near[i].a, near[i].b})
        if (moved[place].kind != BodyKind::dynamic_body) others.push_back(place);
    for (const std::size_t i : group.joints) {
      add(world.joints_[i].second.a);
      add(world.joints_[i].second.b);
    }
    island.forces.gravity = forces.gravity;
    island.forces.gravitation = forces.gravitation;
    if (forces.gravitation > 0)
      for (const Body<D>& body : moved) add(body.id);
    for (const std::size_t i : group.springs) {
      const Spring<D>& spring = forces.springs[i];
      island.forces.springs.push_back(spring);
      add(spring.a);
      add(spring.b);
    }
    for (const std::size_t i : group.pushes) island.forces.pushes.push_back(forces.pushes[i]);
    // Once each, in their order.
    std::ranges::sort(others);
    others.erase(std::unique(others.begin(), others.end()), others.end());
    island.places.reserve(group.bodies.size() + others.size());
    std::ranges::set_union(group.bodies, others, std::back_inserter(island.places));
    for (const std::uint32_t place : island.places) island.bodies.push_back(moved[place]);

    local_place.resize(moved.size());
    for (std::uint32_t i = 0; i < island.places.size(); ++i) local_place[island.places[i]] = i;
    const auto local = [&](std::uint32_t place) { return local_place[place]; };
    island.pairs.reserve(group.pairs.size());
    for (const std::size_t i : group.pairs) {
      stop_if_asked();
      island.pairs.push_back(island_pair(near[i]));
      ContactRows<D>& rows = island.pairs.back().rows;
      rows.a = local(rows.a);
      rows.b = local(rows.b);
    }
    for (const std::size_t i : group.joints) {
      JointRows<D> rows{.joint = world.joints_[i].second, .place = static_cast<std::uint32_t>(i)};
      rows.a = local(place_of(rows.joint.a));
      rows.b = local(place_of(rows.joint.b));
      const JointMemory<D>& memory = world.joint_memories_[i];
      rows.seconds = memory.seconds;
      rows.backoff = memory.backoff;
      if (memory.seconds > 0) rows.impulse = memory.impulse;
      island.joints.push_back(rows);
    }
    return island;
  }

  void bring_back(Island<D>& island, const Group& group) {
    for (std::size_t i = 0; i < island.places.size(); ++i)
      if (island.bodies[i].kind == BodyKind::dynamic_body)
        moved[island.places[i]] = std::move(island.bodies[i]);
    for (const JointRows<D>& rows : island.joints)
      joint_memories[rows.place] = {rows.impulse, island.joint_seconds, rows.backoff};
    for (std::size_t i = 0; i < island.pairs.size(); ++i) {
      stop_if_asked();
      const IslandPair<D>& pair = island.pairs[i];
      if (!pair.touched) continue;
      touch_of[group.pairs[i]] = static_cast<std::uint32_t>(touching.size());
      touching.push_back(pair.touch);
    }
  }

  // In order of ids, as the near pairs are, with those of bodies that slept through.
  void order_touches() {
    std::vector<Touch<D>> slept, ordered;
    const auto rests = [&](BodyId id) {
      return !world.bodies_[place_of(id)].stirs() && !moved[place_of(id)].stirs();
    };
    for (const Touch<D>& touch : world.touching_)
      if (rests(touch.record.a) && rests(touch.record.b)) slept.push_back(touch);
    ordered.reserve(touching.size() + slept.size());
    auto next = slept.begin();
    for (std::size_t i = 0; i < near.size(); ++i) {
      stop_if_asked();
      if (touch_of[i] == kNone) continue;
      Touch<D>& touch = touching[touch_of[i]];
      while (next != slept.end() && next->record.pair() < touch.record.pair())
        ordered.push_back(std::move(*next++));
      if (next != slept.end() && next->record.pair() == touch.record.pair()) ++next;
      ordered.push_back(std::move(touch));
    }
    ordered.insert(ordered.end(), next, slept.end());
    touching = std::move(ordered);
  }
};

// The lecture's update has four of these phases: it refreshes the boxes, finds pairs in the broad
// phase, tests them in the narrow phase, and resolves each pair that touches as it is found. An
// engine must do more. It looks not where bodies are, but as far as they may come in the step, so
// that none passes through another; what the pairs tie together it solves together, as islands; it
// lets islands sleep that rest, and wakes them; and it tells who began to touch and who ceased to.
// (The lecture's own solver is given the world as one, and does no more than the lecture.)
template <int D>
void World<D>::step(double h) {
  if (!std::isfinite(h) || h < 0) throw Refused(fmt::format("time step {} is not allowed", h));
  stop_if_asked();
  if (h == 0) return;  // else -0.0 + 0.0 would change the sign of a zero
  const WorldWork before = work_;
  std::vector<double> reach;
  try {
    for (int tries = 1;; ++tries) {
      Step step{*this, h, std::move(reach)};
      step.find_forces();  // how all would fly on, and so how far each may come
      do {
        step.refresh_boxes();
        step.broad_phase();
        step.narrow_phase();
      } while (step.wake_what_is_touched());
      step.make_islands();
      step.solve_and_integrate();  // from impact to impact, islands by the contact solver
      step.require_no_overflow();
      // An impact may send a body farther than it was looked for. Then the step is made anew,
      // looking farther.
      if (tries == kStepSettings.most_tries || step.stayed_within_reach()) {
        step.fall_asleep();
        step.update_contact_events();
        step.commit();
        return;
      }
      reach = std::move(step.reach);
      ++work_.retries;
      work_.impacts_located = before.impacts_located;  // they did not take place
    }
  } catch (...) {
    ahead_.reset();
    work_ = before;
    throw;
  }
}

template <int D>
void World<D>::store(std::span<const BodyId> ids, double h,
                     const typename BroadPhase<D>::Watch& watch) {
  std::vector<Proxy<D>> proxies;
  for (const BodyId id : ids) {
    const Body<D>& body = bodies_[index_of(id)];
    const Vec<D> reach(config_.contacts == ContactMethod::none ? 0 : coasting_reach(body, h));
    const Box<D> box = body.box();
    proxies.push_back({id, {box.lo - reach, box.hi + reach}, !body.moves(), body.stirs()});
  }
  structure().insert(proxies, watch);
}

// How all would fly on, and the structure in which the next step looks for pairs. A step that would
// be refused is not foreseen: it will say so itself.
template <int D>
void World<D>::look_ahead(double h, const typename BroadPhase<D>::Watch& watch) {
  BroadPhase<D>& broad_phase = structure();
  Step step{*this, h, {}};
  step.reach.resize(bodies_.size());
  if (config_.contacts == ContactMethod::none)
    return broad_phase.build(step.enlarged_boxes(), watch);
  const WorldWork before = work_;
  try {
    step.find_forces();
    step.require_boxes();
    ahead_->force_evaluations = work_.force_evaluations - before.force_evaluations;
  } catch (const Refused&) {
    ahead_.reset();
    step.reach.assign(bodies_.size(), 0);
  }
  work_ = before;
  broad_phase.build(step.enlarged_boxes(), watch);
}

template <int D>
Body<D> World<D>::flown(BodyId id, double h) const {
  const std::size_t place = index_of(id);
  Body<D> body = bodies_[place];
  const bool known = ahead_ && ahead_->h == h && place < ahead_->increments.size();
  WorldWork nobody_counts;
  fly(body, known ? ahead_->increments[place] : Increment<D>(), h, config_.rotation, nobody_counts);
  return body;
}

#define LANTERN_INSTANTIATE(D)                                                      \
  template void World<D>::step(double);                                             \
  template void World<D>::look_ahead(double, const typename BroadPhase<D>::Watch&); \
  template Body<D> World<D>::flown(BodyId, double) const;                           \
  template void World<D>::store(std::span<const BodyId>, double,                    \
                                const typename BroadPhase<D>::Watch&);

LANTERN_INSTANTIATE(2)
LANTERN_INSTANTIATE(3)
#undef LANTERN_INSTANTIATE

}  // namespace lantern::physics
