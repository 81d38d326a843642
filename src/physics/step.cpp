// One step of the world while it is made. It works on copies, so that a step that is refused half
// way, or stopped (base/stop.hpp), leaves the world as it was.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "base/memory.hpp"
#include "base/scratch.hpp"
#include "base/stop.hpp"
#include "geometry/not_finite.hpp"
#include "physics/step_islands.hpp"

namespace lantern::physics {
namespace {

// The numbers of a step, whatever the method.
struct StepSettings {
  int most_tries = 8;     // the last one counts even if a body went farther than was looked for
  double slack = 1e-3;    // of a body's thickness: nearer is looked at, too
  double fast = 0.5;      // of the thinner body's thickness in a step: may pass through
  double fast_quick = 2;  // the same where an error is wanted: rows hold what is slower
  std::size_t most_manifolds = 1 << 16;  // kept from the narrow phase; of more, made again
  double rounding = 1e-9;  // of a step's time, when a push ends; of a reach, whether it was kept
};
constexpr StepSettings kStepSettings;

// A body before the step, as each pair that it is in asks for it.
template <int D>
struct Look {
  Look(const Body<D>& body, double h)
      : axes(axes_of(body)),
        velocity(velocity_of(body)),
        turning(turning_way(body, h)),
        thick(thickness<D>(body.shape)) {}

  Mat<D> axes;
  Vec<D> velocity;
  double turning;  // how far its surface turns
  double thick;

  // How far its surface may come if no force acts.
  double coasting_reach(double h) const {
    const double slack = thick < kEndless ? thick * kStepSettings.slack : 0;
    return slack + turning + glm::length(velocity) * h;
  }
};

}  // namespace

template <int D>
struct World<D>::Step : World<D>::StepIslands {
  using StepIslands::farthest, StepIslands::joint_memories, StepIslands::forces, StepIslands::near,
      StepIslands::manifolds;
  using StepIslands::place_of;
  using StepIslands::root, StepIslands::touching, StepIslands::touch_of, StepIslands::kNone;
  using StepIslands::world, StepIslands::h, StepIslands::moved, StepIslands::rested;
  using typename StepIslands::Group, typename StepIslands::NearPair;

  Scratch<double> reach;            // of each body: how far its surface may come; at least as given
  Scratch<Increment<D>> anew = {};  // increments anew, since bodies woke in this step
  Scratch<Proxy<D>> boxes = {};     // of bodies, enlarged by how far each may come
  std::uint64_t narrow_pairs = 0;   // of the broad phase's, looked at by the narrow phase
  Scratch<Look<D>> looks = {};      // at bodies
  bool struck = false;              // an impact was located
  Outcome& outcome = world.cleared_outcome();

  // The phases, in their order: see World::step.
  void find_forces() {
    Scratch<std::uint32_t> released;
    std::erase_if(forces.pushes, [&](const Push<D>& push) {
      const bool ends = push.until && *push.until <= world.time_ + kStepSettings.rounding * h;
      if (ends) released.push_back(place_of(push.body));
      return ends;
    });
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
    if (collides()) find_reach();
  }

  void refresh_boxes() {
    if (collides()) boxes = enlarged_boxes(true);
  }

  void broad_phase() {
    if (!looks_for_contacts()) return;
    BroadPhase<D>& structure = world.structure();
    structure.update(boxes);
    outcome.pairs.assign(structure.pairs().begin(), structure.pairs().end());
    ++world.work_.broad_phases;
    world.work_.pair_tests += structure.counters().pair_tests;
    world.work_.candidate_pairs += outcome.pairs.size();
  }

  void narrow_phase() {
    near.clear();
    narrow_pairs = 0;
    manifolds.clear();
    if (outcome.pairs.empty()) return;
    const Scratch<Pair> joined = joined_pairs();
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
    if (const std::uint64_t bytes = kEach * near.size(); bytes > memory_budget())
      refuse_memory(bytes, fmt::format("{} pairs that may touch", near.size()),
                    "take fewer bodies that overlap");
  }

  // Whether any woke, who may touch others.
  bool wake_what_is_touched() {
    if (!looks_for_contacts()) return false;
    Scratch<std::uint32_t> woken;
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

  void solve_and_integrate() {
    const ContactSolver& solver = contact_solver(world.config_.contacts);
    Scratch<std::uint8_t> solved(moved.size());
    touch_of.assign(near.size(), kNone);
    touching.reserve(std::min(near.size(), world.touching_.size() + world.touching_.size() / 8));
    int budget = world.config_.impact_budget;
    const std::uint64_t located = world.work_.impacts_located;
    for (const Group& group : this->groups_to_solve(solver.whole_world)) {
      stop_if_asked();
      Island<D> island = this->gather(group);
      ++world.work_.islands_solved;
      const IslandMove<D> move{island, world.config_, h, h, world.work_};
      if (solver.whole_world)
        solver.solve.in<D>()(move);
      else
        move_through_impacts(move, solver, budget, outcome.impacts);
      this->bring_back(island, group);
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
    // What is pushed apart goes no farther than it is allowed to; only an impact does, or a lever.
    if (world.config_.wanted_error > 0.0 && !struck && !met_unforeseen()) return true;
    bool stayed = true;
    for (std::size_t i = 0; i < moved.size(); ++i) {
      if (!moved[i].is_pushed()) continue;
      if (!strayed(i)) continue;
      reach[i] = 2 * std::max(way_gone(i), glm::length(moved[i].velocity) * h);
      stayed = false;
    }
    return stayed;
  }

  // Contacts in order of ids, and what is new about them.
  void update_contact_events() {
    this->order_touches();
    for (const Touch<D>& touch : touching) outcome.contacts.push_back(touch.record);
    tell_events<D>(
        outcome.contacts, contact_solver(world.config_.contacts).frames_remembered,
        [&](BodyId id) -> const Body<D>& { return moved[place_of(id)]; }, world.outcome_.told,
        outcome.told, outcome.events);
  }

  void commit() {
    std::swap(world.bodies_, moved);
    world.rested_ = std::move(rested);
    world.may_rest_ =
        world.work_.asleep > 0 ||
        std::ranges::any_of(world.rested_, [](double seconds) { return seconds > 0; });
    std::swap(world.roots_, root);
    world.joint_memories_ = std::move(joint_memories);
    world.forces_.pushes = std::move(forces.pushes);
    world.touching_ = std::move(touching);
    std::swap(world.outcome_, outcome);
    world.rests_ = rests();
    world.go_on(h);
    WorldWork& work = world.work_;
    work.narrow_pairs += narrow_pairs;
    work.constraint_rows =
        work.normal_rows + work.friction_rows + work.joint_rows + work.direct_rows;
  }

  // Over the whole step, if nothing touches.
  const Scratch<Increment<D>>& increments() const {
    return anew.empty() ? world.ahead_->increments : anew;
  }

  // If they are `required`, throws Refused for one that is beyond all numbers.
  Scratch<Proxy<D>> enlarged_boxes(bool required = false) const {
    Scratch<Proxy<D>> proxies;
    for (std::size_t i = 0; i < moved.size(); ++i) {
      const Body<D>& body = moved[i];
      const Box<D> box = enlarged_box(i);
      if (required && !is_valid(box))
        throw Refused(fmt::format("body '{}': position overflows in step {}", body.name,
                                  world.work_.steps + 1));
      if (body.collides) proxies.push_back({body.id, box, !body.moves(), body.stirs()});
    }
    return proxies;
  }

 private:
  // Whether nothing moves, nothing ends, and nothing is new: then the next step is as this one.
  bool rests() const {
    const Outcome& told = world.outcome_;
    return std::ranges::none_of(world.bodies_, &Body<D>::stirs) &&
           std::ranges::none_of(world.forces_.pushes,
                                [](const Push<D>& push) { return push.until.has_value(); }) &&
           told.pairs.empty() && told.impacts.moments.empty() &&
           told.told.size() == told.contacts.size() &&
           std::ranges::all_of(told.events, [](const ContactEvent& event) {
             return event.kind == ContactEvent::Kind::stay;
           });
  }
  bool collides() const { return world.config_.contacts != ContactMethod::none; }
  bool locates_impacts() const {
    return collides() && world.config_.continuous &&
           !contact_solver(world.config_.contacts).whole_world;
  }

  // Whether anything flies, or may be met, where it would fly: not if joints hold all that moves.
  bool flies_anywhere() const {
    if (collides()) return true;
    Scratch<std::uint8_t> held(moved.size());
    for (const auto& entry : world.joints_)
      for (const BodyId id : {entry.second.a, entry.second.b}) held[place_of(id)] = true;
    for (std::size_t i = 0; i < moved.size(); ++i)
      if (moved[i].is_dynamic() && !held[i]) return true;
    return false;
  }

  // Whether one that went farther than it was looked for touches what it was not tested against.
  bool met_unforeseen() const {
    const Scratch<Pair> joined = joined_pairs();
    const auto known = [&](std::uint32_t i, std::uint32_t j) {
      const std::pair<std::uint32_t, std::uint32_t> both = std::minmax(i, j);
      const Pair ids{moved[both.first].id, moved[both.second].id};
      const auto places = [](const NearPair& pair) { return std::pair(pair.a, pair.b); };
      return i == j || std::ranges::binary_search(joined, ids) ||
             std::ranges::binary_search(near, both, {}, places);
    };
    Scratch<Box<D>> now;  // if any went so far
    for (std::uint32_t i = 0; i < moved.size(); ++i) {
      if (!moved[i].is_pushed() || !moved[i].collides || !strayed(i)) continue;
      if (now.empty())
        for (const Body<D>& body : moved) now.push_back(body.box());
      for (std::uint32_t j = 0; j < moved.size(); ++j) {
        if (!overlap(now[i], now[j]) || !moved[j].collides || known(i, j)) continue;
        ++world.work_.narrow_tests;
        if (collide(placed(moved[i]), placed(moved[j]), 0)) return true;
      }
    }
    return false;
  }

  double way_gone(std::size_t i) const {
    return std::max(glm::length(moved[i].position - world.bodies_[i].position),
                    i < farthest.size() ? farthest[i] : 0);
  }
  bool strayed(std::size_t i) const {
    return way_gone(i) > reach[i] * (1 + kStepSettings.rounding);
  }

  void find_reach() {
    reach.resize(moved.size());
    looks.clear();
    for (std::size_t i = 0; i < moved.size(); ++i) {
      looks.emplace_back(moved[i], h);
      const Increment<D>& increment = increments()[i];
      const double way = looks[i].coasting_reach(h) + glm::length(increment.kick) * h +
                         glm::length(increment.drift);
      reach[i] = std::max(reach[i], way);
    }
  }

  Box<D> enlarged_box(std::size_t place) const {
    const Body<D>& body = moved[place];
    const Box<D> box = place < looks.size()
                           ? bounding_box(body.shape, body.position, looks[place].axes)
                           : body.box();
    return {box.lo - Vec<D>(reach[place]), box.hi + Vec<D>(reach[place])};
  }

  bool looks_for_contacts() const {
    return collides() && std::ranges::any_of(moved, &Body<D>::stirs);
  }

  // What a joint ties together without letting it touch; ascending.
  Scratch<Pair> joined_pairs() const {
    Scratch<Pair> joined;
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
    if (!a.is_dynamic() && !b.is_dynamic()) return std::nullopt;
    const Look<D>&look_a = looks[found.a], &look_b = looks[found.b];
    const double way =
        glm::length(look_b.velocity - look_a.velocity) * h + look_a.turning + look_b.turning;
    // An impact with a third body may turn either of them towards the other.
    found.reach = reach[found.a] + reach[found.b];
    ++narrow_pairs;
    ++world.work_.narrow_tests;
    const auto manifold =
        collide<D>({a.shape, a.position, a.orientation, look_a.axes},
                   {b.shape, b.position, b.orientation, look_b.axes}, found.reach);
    if (!manifold) return std::nullopt;
    found.restitution = std::max(a.material.restitution, b.material.restitution);
    found.friction = std::sqrt(a.material.friction * b.material.friction);
    const double thin = std::min(look_a.thick, look_b.thick);
    const bool held =
        world.config_.wanted_error > 0.0 && world.config_.contacts == ContactMethod::soft;
    const double fast = held ? kStepSettings.fast_quick : kStepSettings.fast;
    found.fast = !locates_impacts() ? HUGE_VAL : found.restitution > 0 ? -1 : fast * thin;
    found.located = way > found.fast;
    if (manifolds.size() < kStepSettings.most_manifolds) {
      found.manifold = static_cast<std::uint32_t>(manifolds.size());
      manifolds.push_back(*manifold);
    }
    return found;
  }

  void wake(Scratch<std::uint32_t> places) {
    wake_together<D>(moved, rested, std::move(places), world.links(), Disturbed::sleepers);
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
  if (rests_) return go_on(h);
  const WorldWork before = work_;
  Scratch<double> reach;
  try {
    for (int tries = 1;; ++tries) {
      Step step{{*this, h}, std::move(reach)};
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
        step.fall_asleep(step.increments());
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
  Scratch<Proxy<D>> proxies;
  for (const BodyId id : ids) {
    const Body<D>& body = bodies_[index_of(id)];
    const Vec<D> reach(
        config_.contacts == ContactMethod::none ? 0 : Look<D>(body, h).coasting_reach(h));
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
  Step step{{*this, h}, {}};
  step.reach.resize(bodies_.size());
  if (config_.contacts == ContactMethod::none)
    return broad_phase.build(step.enlarged_boxes(), watch);
  const WorldWork before = work_;
  try {
    step.find_forces();
    step.enlarged_boxes(true);
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
