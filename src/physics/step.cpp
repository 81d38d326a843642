// One step of the world while it is made. It works on copies, so that a step that is refused half
// way, or stopped (base/stop.hpp), leaves the world as it was.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/memory.hpp"
#include "base/scratch.hpp"
#include "base/stop.hpp"
#include "geometry/not_finite.hpp"
#include "physics/step_islands.hpp"

namespace lantern::physics {
template <int D>
struct World<D>::Step : World<D>::StepIslands {
  using StepIslands::StepIslands;
  using StepIslands::world, StepIslands::h, StepIslands::moved, StepIslands::rested,
      StepIslands::farthest, StepIslands::joint_memories, StepIslands::forces, StepIslands::near,
      StepIslands::manifolds, StepIslands::joints, StepIslands::joint, StepIslands::wake,
      StepIslands::place_of, StepIslands::in_world, StepIslands::local, StepIslands::places,
      StepIslands::reach, StepIslands::increments, StepIslands::woke, StepIslands::take_part,
      StepIslands::root, StepIslands::touching, StepIslands::touch_of, StepIslands::kNone;
  using typename StepIslands::Group, typename StepIslands::NearPair;

  bool knows_forces = true;             // else boxes are those of bodies as they are
  Scratch<Box<D>> enlarged_boxes = {};  // of those that take part, by how far each may come
  Scratch<Proxy<D>> boxes = {};         // of those that moved
  std::uint64_t narrow_pairs = 0;       // of the broad phase's, looked at by the narrow phase
  Scratch<Look<D>> looks = {};          // at those that take part
  bool struck = false;                  // an impact was located
  decltype(world.roots_) roots = {};
  Outcome& outcome = world.cleared_outcome();

  // The phases, in their order: see World::step.
  void find_forces() {
    Scratch<std::uint32_t> released;
    for (const Push<D>& push : world.forces_.pushes)
      if (ends(push)) released.push_back(in_world(push.body));
    wake(std::move(released));
    find_pushes();
    // Once a step, by looking ahead or in the first of several tries: they follow from the world as
    // it was before.
    if (!world.ahead_ || world.ahead_->h != h) {
      Ahead found{h, places, {}, 0};
      if (flies_anywhere())
        find_increments_if_any<D>(world.config_, moved, forces, h, found.increments, world.work_);
      else
        found.increments.resize(moved.size());
      world.ahead_ = std::move(found);
    }
    increments = world.ahead_->increments;
    world.work_.force_evaluations += std::exchange(world.ahead_->force_evaluations, 0);
    if (collides()) find_reach();
  }

  void refresh_boxes() {
    if (!collides()) return;
    enlarged_boxes.clear();
    for (const std::uint32_t place : places) enlarged_boxes.push_back(enlarged(place));
    require_boxes();
    if (!looks_for_contacts()) return;
    if (!world.told_all_) {
      world.structure().tell(all_boxes());
      world.stirred_.clear();
    }
    boxes = boxes_that_changed();
  }

  void broad_phase() {
    if (!looks_for_contacts()) return;
    BroadPhase<D>& structure = world.structure();
    structure.follow(boxes);
    note_told();
    outcome.pairs.assign(structure.pairs().begin(), structure.pairs().end());
    if (structure.config().as_printed) lose_pairs(structure);
    ++world.work_.broad_phases;
    world.work_.pair_tests += structure.counters().pair_tests;
    world.work_.candidate_pairs += outcome.pairs.size();
  }

  void narrow_phase() {
    near.clear();
    narrow_pairs = 0;
    manifolds.clear();
    if (outcome.pairs.empty()) return;
    take_part_in_pairs();
    if (looks.size() != moved.size()) look();
    const Scratch<Pair> joined = joined_pairs();
    auto touch = world.touching_.begin();  // in order of ids, as the pairs are
    for (const Pair& pair : outcome.pairs) {
      stop_if_asked();
      if (std::ranges::binary_search(joined, pair)) continue;
      auto found = nearing(pair);
      if (!found) continue;
      while (touch != world.touching_.end() && touch->record.pair() < pair) ++touch;
      const bool touched = touch != world.touching_.end() && touch->record.pair() == pair;
      found->touch = touched ? &*touch : slept_touch(pair);
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
      if (moved[pair.a].asleep) woken.push_back(places[pair.a]);
      if (moved[pair.b].asleep) woken.push_back(places[pair.b]);
    }
    const auto tied = [&](BodyId first, BodyId second) {
      const std::uint32_t a = place_of(first), b = place_of(second);
      if (moved[a].asleep && moved[b].stirs()) woken.push_back(places[a]);
      if (moved[b].asleep && moved[a].stirs()) woken.push_back(places[b]);
    };
    for (std::size_t i = 0; i < joints.size(); ++i) tied(joint(i).a, joint(i).b);
    for (const Spring<D>& spring : forces.springs) tied(spring.a, spring.b);
    if (woken.empty()) return false;
    wake(std::move(woken));
    find_pushes();
    find_increments_if_any<D>(world.config_, moved, forces, h, increments, world.work_);
    find_reach();
    return true;
  }

  void solve_and_integrate() {
    const ContactSolver& solver = contact_solver(world.config_.contacts);
    Scratch<std::uint8_t> solved(moved.size());
    touch_of.assign(near.size(), kNone);
    for (const std::size_t i : joints) joint_memories.push_back(world.joint_memories_[i]);
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
      if (!solved[i]) fly(moved[i], increments[i], h, world.config_.rotation, world.work_);
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
      if (!moved[i].is_pushed() || !strayed(i)) continue;
      reach[i] = 2 * std::max(way_gone(i), glm::length(moved[i].velocity) * h);
      stayed = false;
    }
    return stayed;
  }

  // Contacts in order of ids, and what is new about them.
  void update_contact_events() {
    this->order_touches();
    for (const Touch<D>& touch : touching) outcome.contacts.push_back(touch.record);
    Scratch<Touch<D>> sleep;
    for (const Touch<D>& touch : world.touching_)
      if (this->slept_through(touch)) sleep.push_back(touch);
    this->keep_slept(sleep);
    // Of those that sleep nothing is new, nor of those that slept.
    if (woke) world.told_whole();
    const Scratch<Touch<D>>& slept_on = this->sleeps_anew ? this->slept : world.slept_;
    outcome.untold = slept_on.size();
    Scratch<ToldPair> old(world.outcome_.told.begin(), world.outcome_.told.end());
    if (!slept_on.empty())
      std::erase_if(old, [&](const ToldPair& told) {
        return this->is_in(slept_on, told.pair) && !this->is_in(touching, told.pair);
      });
    tell_events<D>(
        outcome.contacts, contact_solver(world.config_.contacts).frames_remembered,
        [&](BodyId id) -> const Body<D>& { return moved[place_of(id)]; },
        looks.empty() ? 0 : std::ranges::min(looks, {}, &Look<D>::thick).thick, old, outcome.told,
        outcome.events);
    auto event = outcome.events.begin();
    for (Touch<D>& touch : touching) {
      while (event->pair() != touch.record.pair()) ++event;
      touch.crushes = event->crushes;
    }
    // What has fallen asleep is looked at no more.
    if (world.work_.asleep == 0) return;
    const auto stirs = [&](BodyId id) { return moved[place_of(id)].stirs(); };
    sleep.clear();
    std::erase_if(touching, [&](const Touch<D>& touch) {
      if (stirs(touch.record.a) || stirs(touch.record.b)) return false;
      sleep.push_back(touch);
      return true;
    });
    this->keep_slept(sleep);
  }

  void commit() {
    for (std::size_t i = 0; i < root.size(); ++i) roots.emplace_back(places[i], places[root[i]]);
    std::erase_if(world.forces_.pushes, [&](const Push<D>& push) { return ends(push); });
    if (woke || world.work_.asleep != world.active().asleep) world.active_.reset();
    world.may_rest_ = world.work_.asleep > 0 ||
                      std::ranges::any_of(rested, [](double seconds) { return seconds > 0; });
    world.rests_ = rests();
    for (std::size_t i = 0; i < moved.size(); ++i) world.rested_[places[i]] = rested[i];
    if (moved.size() == world.bodies_.size())
      std::swap(world.bodies_, moved);
    else
      for (std::size_t i = 0; i < moved.size(); ++i) world.bodies_[places[i]] = moved[i];
    std::swap(world.roots_, roots);
    world.knows_islands_ = false;
    for (std::size_t i = 0; i < joints.size(); ++i)
      world.joint_memories_[joints[i]] = joint_memories[i];
    world.touching_ = std::move(touching);
    if (this->sleeps_anew) world.slept_ = std::move(this->slept);
    std::swap(world.outcome_, outcome);
    world.go_on(h);
    WorldWork& work = world.work_;
    work.narrow_pairs += narrow_pairs;
    work.constraint_rows =
        work.normal_rows + work.friction_rows + work.joint_rows + work.direct_rows;
  }

  // What looking ahead asks for.
  void require_boxes() const {
    const auto require = [&](std::uint32_t place) {
      if (!is_valid(enlarged(place)))
        throw Refused(fmt::format("body '{}': position overflows in step {}", body_at(place).name,
                                  world.work_.steps + 1));
    };
    if (world.told_all_)
      for (const std::uint32_t place : places) require(place);
    else
      for (std::uint32_t place = 0; place < world.bodies_.size(); ++place) require(place);
  }

  Scratch<Proxy<D>> all_boxes() const {
    Scratch<Proxy<D>> proxies;
    for (std::uint32_t place = 0; place < world.bodies_.size(); ++place) add_box(place, proxies);
    return proxies;
  }

  void note_told() {
    world.told_all_ = knows_forces;
    world.stirred_ = stirring();
  }

 private:
  // As printed, the lecture takes some pairs for others.
  void lose_pairs(BroadPhase<D>& structure) {
    structure.build(all_boxes());
    const std::vector<Pair> kept = world.pair_chain(structure.config().most_pairs).pairs;
    std::erase_if(outcome.pairs,
                  [&](const Pair& pair) { return !std::ranges::binary_search(kept, pair); });
  }
  // Whether nothing moves, nothing ends, and nothing is new: then the next step is as this one.
  bool rests() const {
    return std::ranges::none_of(moved, &Body<D>::stirs) &&
           std::ranges::none_of(world.forces_.pushes,
                                [](const Push<D>& push) { return push.until.has_value(); }) &&
           outcome.pairs.empty() && outcome.impacts.moments.empty() && outcome.told.empty() &&
           outcome.events.empty();
  }
  bool ends(const Push<D>& push) const {
    return push.until && *push.until <= world.time_ + kStepSettings.rounding * h;
  }
  void find_pushes() {
    forces.pushes.clear();
    for (const Push<D>& push : world.forces_.pushes)
      if (!ends(push) && place_of(push.body) != kNone) forces.pushes.push_back(push);
  }

  Scratch<std::uint32_t> stirring() const {
    Scratch<std::uint32_t> stir;
    for (std::size_t i = 0; i < moved.size(); ++i)
      if (moved[i].stirs()) stir.push_back(places[i]);
    return stir;
  }
  // The box of a body of the world, if it meets others.
  void add_box(std::uint32_t place, Scratch<Proxy<D>>& proxies) const {
    const Body<D>& body = body_at(place);
    if (body.collides) proxies.push_back({body.id, enlarged(place), !body.moves(), body.stirs()});
  }
  const Body<D>& body_at(std::uint32_t place) const {
    const std::uint32_t i = local(place);
    return i == kNone ? world.bodies_[place] : moved[i];
  }
  Box<D> enlarged(std::uint32_t place) const {
    const std::uint32_t i = local(place);
    if (i < enlarged_boxes.size()) return enlarged_boxes[i];
    const Body<D>& body = body_at(place);
    const Look<D> look = i < looks.size() ? looks[i] : Look<D>(body, h);
    const Box<D> box = bounding_box(body.shape, body.position, look.axes);
    const double gone =
        i == kNone ? std::max(look.coasting_reach(h), this->reach_before(place)) : reach[i];
    const Vec<D> way(knows_forces ? gone : 0);
    return {box.lo - way, box.hi + way};
  }
  Scratch<Proxy<D>> boxes_that_changed() const {
    Scratch<std::uint32_t> changed;
    std::ranges::set_union(world.stirred_, stirring(), std::back_inserter(changed));
    Scratch<Proxy<D>> proxies;
    for (const std::uint32_t place : changed) add_box(place, proxies);
    return proxies;
  }

  void take_part_in_pairs() {
    if (places.size() == world.bodies_.size()) return;
    Scratch<std::uint32_t> met;
    for (const Pair& pair : outcome.pairs)
      met.insert(met.end(), {in_world(pair.a), in_world(pair.b)});
    take_part(std::move(met));
  }

  // Of two of which one has been woken in this step; null if they did not touch.
  const Touch<D>* slept_touch(const Pair& pair) const {
    const auto touch = std::ranges::lower_bound(world.slept_, pair, {}, this->pair_of);
    return touch != world.slept_.end() && touch->record.pair() == pair ? &*touch : nullptr;
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
    for (std::size_t i = 0; i < joints.size(); ++i)
      for (const BodyId id : {joint(i).a, joint(i).b}) held[place_of(id)] = true;
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
      const auto both_of = [](const NearPair& pair) { return std::pair(pair.a, pair.b); };
      return i == j || std::ranges::binary_search(joined, ids) ||
             std::ranges::binary_search(near, both, {}, both_of);
    };
    Scratch<Box<D>> now;  // if any went so far
    for (std::uint32_t i = 0; i < moved.size(); ++i) {
      if (!moved[i].is_pushed() || !moved[i].collides || !strayed(i)) continue;
      if (now.empty())
        for (std::uint32_t place = 0; place < world.bodies_.size(); ++place)
          now.push_back(body_at(place).box());
      for (std::uint32_t place = 0; place < world.bodies_.size(); ++place) {
        const std::uint32_t j = local(place);
        const Body<D>& other = body_at(place);
        if (!overlap(now[places[i]], now[place]) || !other.collides || (j != kNone && known(i, j)))
          continue;
        ++world.work_.narrow_tests;
        if (collide(placed(moved[i]), placed(other), 0)) return true;
      }
    }
    return false;
  }

  double way_gone(std::size_t i) const {
    return std::max(glm::length(moved[i].position - world.bodies_[places[i]].position),
                    i < farthest.size() ? farthest[i] : 0);
  }
  bool strayed(std::size_t i) const {
    return way_gone(i) > reach[i] * (1 + kStepSettings.rounding);
  }

  void look() {
    looks.clear();
    for (const Body<D>& body : moved) looks.emplace_back(body, h);
  }

  void find_reach() {
    look();
    for (std::size_t i = 0; i < moved.size(); ++i) {
      const Increment<D>& increment = increments[i];
      const double way = looks[i].coasting_reach(h) + glm::length(increment.kick) * h +
                         glm::length(increment.drift);
      reach[i] = std::max(reach[i], way);
    }
  }

  bool looks_for_contacts() const {
    return collides() && std::ranges::any_of(moved, &Body<D>::stirs);
  }

  // What a joint ties together without letting it touch; ascending.
  Scratch<Pair> joined_pairs() const {
    Scratch<Pair> joined;
    for (std::size_t i = 0; i < joints.size(); ++i)
      if (!joint(i).collide)
        joined.push_back({std::min(joint(i).a, joint(i).b), std::max(joint(i).a, joint(i).b)});
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
  typename Step::Reached reached;
  try {
    for (int tries = 1;; ++tries) {
      Step step(*this, h, std::move(reached));
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
      reached = {std::move(step.places), std::move(step.reach)};
      ++work_.retries;
      work_.impacts_located = before.impacts_located;  // they did not take place
    }
  } catch (...) {
    ahead_.reset();
    told_all_ = false;
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
    if (!body.collides) continue;
    const Look<D> look(body, h);
    const Vec<D> reach(config_.contacts == ContactMethod::none ? 0 : look.coasting_reach(h));
    const Box<D> box = bounding_box(body.shape, body.position, look.axes);
    proxies.push_back({id, {box.lo - reach, box.hi + reach}, !body.moves(), body.stirs()});
  }
  structure().insert(proxies, watch);
}

// How all would fly on, and the structure in which the next step looks for pairs. A step that would
// be refused is not foreseen: it will say so itself.
template <int D>
void World<D>::look_ahead(double h, const typename BroadPhase<D>::Watch& watch) {
  BroadPhase<D>& broad_phase = structure();
  Step step(*this, h, {});
  told_all_ = step.knows_forces = false;
  if (config_.contacts == ContactMethod::none) return broad_phase.build(step.all_boxes(), watch);
  const WorldWork before = work_;
  try {
    step.find_forces();
    step.knows_forces = true;
    step.require_boxes();
    ahead_->force_evaluations = work_.force_evaluations - before.force_evaluations;
  } catch (const Refused&) {
    ahead_.reset();
    step.knows_forces = false;
  }
  work_ = before;
  broad_phase.build(step.all_boxes(), watch);
  step.note_told();
}

template <int D>
Body<D> World<D>::flown(BodyId id, double h) const {
  const std::size_t place = index_of(id);
  Body<D> body = bodies_[place];
  Increment<D> increment;
  if (ahead_ && ahead_->h == h) {
    const auto& places = ahead_->places;
    const auto known = std::ranges::lower_bound(places, place);
    if (known != places.end() && *known == place)
      increment = ahead_->increments[static_cast<std::size_t>(known - places.begin())];
  }
  WorldWork nobody_counts;
  fly(body, increment, h, config_.rotation, nobody_counts);
  return body;
}

template <int D>
PairChain World<D>::pair_chain(std::uint64_t most) const {
  const auto stirs = [&](BodyId id) { return find(id)->stirs(); };
  if (!broad_phase_->config().as_printed) return broad_phase_->pair_chain(stirs, most);
  return broad_phase_->pair_chain(stirs, most, [&](BodyId id) { return find(id)->address; });
}

#define LANTERN_INSTANTIATE(D)                                                      \
  template void World<D>::step(double);                                             \
  template void World<D>::look_ahead(double, const typename BroadPhase<D>::Watch&); \
  template Body<D> World<D>::flown(BodyId, double) const;                           \
  template PairChain World<D>::pair_chain(std::uint64_t) const;                     \
  template void World<D>::store(std::span<const BodyId>, double,                    \
                                const typename BroadPhase<D>::Watch&);

LANTERN_INSTANTIATE(2)
LANTERN_INSTANTIATE(3)
#undef LANTERN_INSTANTIATE

}  // namespace lantern::physics
