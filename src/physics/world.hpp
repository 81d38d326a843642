// The bodies of a scene and how they move.
//
//   forces -> boxes -> broad phase -> narrow phase -> islands -> solve and integrate -> sleep
//
// A world without forces and contacts does nothing of this: bodies fly straight on.
#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "base/scratch.hpp"
#include "physics/body.hpp"
#include "physics/contacts.hpp"
#include "physics/integrate/integrator.hpp"
#include "physics/joint.hpp"
#include "physics/world_config.hpp"
#include "spatial/broad_phase.hpp"

namespace lantern::physics {

inline constexpr BodyId kNoIsland = ~BodyId{0};

// All functions that take a body, spring or joint throw Refused if it is not there, and for numbers
// that are not finite; the world is then as it was, and its hash the same. What changes a body
// wakes it and those that touch it.
template <int D>
class World {
 public:
  // No gravity, no contacts.
  World() : World(WorldConfig<D>{.contacts = ContactMethod::none}) {}
  // Throws Refused, naming the field, for a number that is out of its range.
  explicit World(const WorldConfig<D>& config);
  // All that `as` is, bit for bit, and by these settings from here on; a step by the same settings
  // does the same to both. Its structure is a new one, and its work its own.
  World(const World& as, const WorldConfig<D>& config);

  const WorldConfig<D>& config() const { return config_; }

  // Bodies. Ids are given in order of adding, from 0, and never used again. Derives mass and
  // inertia. Throws Refused, naming body and field, for a size, mass, density, drag, restitution or
  // friction that is negative or not finite, a pose, velocity or momentum that is not finite, a
  // dynamic body of no area (2D) or volume (3D) without an explicit mass, a dynamic half-space. It
  // turns at that angular velocity, as after `set_angular_velocity`.
  BodyId add(Body<D> body, const Spin<D>& angular_velocity = Spin<D>(0.0));
  // Their springs, joints and pushes go with them. Does nothing of bodies that are not there.
  void remove(std::span<const BodyId> ids);
  void remove(BodyId id) { remove(std::span(&id, 1)); }
  const Body<D>* find(BodyId id) const;                           // null if not there
  const std::vector<Body<D>>& bodies() const { return bodies_; }  // in order of ids

  // Only `place` moves a static body.
  void place(BodyId id, const Vec<D>& position, const Vec<D>& velocity,
             const std::optional<Rotation<D>>& orientation = std::nullopt);  // else as it is
  void set_velocities(std::span<const std::pair<BodyId, Vec<D>>> velocities);
  void set_velocity(BodyId id, const Vec<D>& velocity) {
    const std::pair one(id, velocity);
    set_velocities(std::span(&one, 1));
  }
  void set_angular_velocity(BodyId id, const Spin<D>& spin);  // radians a second, world's axes
  // In N s, at a point in the world. Moves only dynamic bodies.
  void apply_impulse(BodyId id, const Vec<D>& impulse, const Vec<D>& at);
  // A force in N at a point in the world; the lever stays as it is while the body moves. Acts until
  // `clear_pushes`, or for the steps that begin within `seconds` (above 0) from now.
  void push(BodyId id, const Vec<D>& force, const Vec<D>& at,
            std::optional<double> seconds = std::nullopt);
  void clear_pushes();
  void clear_pushes(BodyId id);
  void set_gravity(const Vec<D>& gravity);  // wakes all

  // Springs and joints. Both bodies must be there and differ. Ids are never used again. Removing
  // what is not there does nothing. A spring between two dynamic bodies of different integrators is
  // refused: each method would need the other's state within the step.
  SpringId add_spring(const Spring<D>& spring);
  JointId add_joint(const Joint<D>& joint);
  void remove_spring(SpringId id);
  void remove_joint(JointId id);
  const Forces<D>& forces() const { return forces_; }
  const std::vector<std::pair<JointId, Joint<D>>>& joints() const { return joints_; }

  // A sleeping body stands still and is skipped until something wakes it. Only dynamic bodies can
  // sleep; for others nothing happens. `wake` wakes all that touch or hang on them, too.
  void sleep(BodyId id);
  void wake(std::span<const BodyId> ids) {
    for (const BodyId id : ids) index_of(id);
    wake_from(ids);
  }
  void wake(BodyId id) { wake(std::span(&id, 1)); }

  // Goes on with another broad phase; the trajectory is the same, bit for bit.
  void switch_broad_phase(const BroadPhaseConfig<D>& config) {
    broad_phase_.emplace(config);
    told_all_ = false;
    config_.broad_phase = config;
  }
  // Goes on with another way to part bodies. Whether they touch at all is settled when the world is
  // made: throws Refused if either method, the old or the new, is `none`, and for a number that is
  // out of its range. What presses goes on pressing: the next step begins with the old impulses.
  void switch_contacts(ContactMethod method, int sub_steps, int iterations,
                       std::optional<double> wanted_error = std::nullopt);

  // The structure (broad phase) as it will be used: with contacts that of the next step, if it is
  // one of `h` seconds, in which boxes are enlarged by how far bodies may come in it; without
  // contacts that of the bodies as they are, which no step needs. Built once: the step finds it
  // standing. A structure that goes on from where its bodies were tells `watch`, if there is one.
  void look_ahead(double h, const typename BroadPhase<D>::Watch& watch = {});
  // Puts these bodies into the structure, after all others (the lecture's Insert), as they will be
  // used if no force acts. Throws Refused for ids that are not ascending, and as BroadPhase does.
  void store(std::span<const BodyId> ids, double h,
             const typename BroadPhase<D>::Watch& watch = {});

  // The body as it will be after a step of `h` seconds, if it meets nothing. As the last
  // `look_ahead` found; without one, no force acts.
  Body<D> flown(BodyId id, double h) const;

  // One step of `h` seconds. A step of 0 does nothing. Throws Refused, naming body and step, when a
  // position or velocity would overflow, for a step that is negative or not finite, and for more
  // memory than the budget. Throws Stopped as soon as that is wished. The world stays as it was.
  void step(double h);
  double time() const { return time_; }

  // Of the last step, in order of ids; those of what sleeps, and islands, are written down when
  // somebody asks: not from several threads at a time.
  const std::vector<Contact<D>>& contacts() const { return told_whole().contacts; }
  const std::vector<ContactEvent>& events() const { return told_whole().events; }
  const std::vector<Pair>& pairs() const { return outcome_.pairs; }
  // What the broad phase finds in its structures as they stand, one that is as printed with what
  // the lecture's text loses.
  PairChain pair_chain(std::uint64_t most) const;
  // The same for who looks at each step: without those that sleep, of which nothing is new, unless
  // somebody asked for all; and how many touch in all.
  const std::vector<Contact<D>>& fresh_contacts() const { return outcome_.contacts; }
  const std::vector<ContactEvent>& fresh_events() const { return outcome_.events; }
  std::size_t touches() const {
    return outcome_.contacts.size() + (outcome_.whole ? 0 : outcome_.untold);
  }
  // The island of each body, in order of bodies(): the lowest id among those that the step moved
  // together, or that went on sleeping together. What has left or let go since has parted them.
  // kNoIsland of what only `place` or its own velocity moves, and of what no step has seen yet.
  const std::vector<BodyId>& islands() const {
    write_islands();
    return islands_;
  }
  const std::vector<ToldPair>& told() const { return told_whole().told; }  // by pair
  // Its impacts that were located; of the looks by which they were, nothing unless they are kept.
  const ImpactLog<D>& impacts() const { return outcome_.impacts; }
  // From now on the looks of a step are kept, or not. Without, nobody spends time on them.
  void keep_impact_looks(bool kept) { outcome_.impacts.keeps_looks = kept; }
  // Null if nobody has needed one.
  const BroadPhase<D>* broad_phase() const { return broad_phase_ ? &*broad_phase_ : nullptr; }

  const WorldWork& work() const { return work_; }
  // Of the state: bodies, springs, joints, pushes, contacts. The same over broad phases, compilers
  // and build types.
  std::uint64_t hash() const;

 private:
  struct Outcome {  // what a step tells
    std::vector<Contact<D>> contacts = {};
    std::vector<ContactEvent> events = {};
    std::vector<ToldPair> told = {};  // by pair
    std::vector<Pair> pairs = {};
    ImpactLog<D> impacts = {};
    bool whole = true;       // the first three tell of those that sleep, too; else
    std::size_t untold = 0;  // so many contacts more would be told
    void clear(bool keeps_looks) {
      contacts.clear(), events.clear(), told.clear(), pairs.clear(), whole = false;
      impacts.moments.clear(), impacts.looks.clear();
      impacts.keeps_looks = keeps_looks;
    }
  };
  struct StepIslands;  // its part that is of islands (step_islands.hpp)
  struct Step;         // one step while it is made (step.cpp)
  // What a step must look at before it knows who meets whom: what is awake and not static, and what
  // is tied to that; or all, unless that is few of all.
  struct Active {
    Scratch<std::uint32_t> bodies;         // places
    Scratch<std::size_t> joints, springs;  // places of those that tie one which moves(place)
    std::size_t asleep = 0;                // bodies in all
  };
  template <class F>
  void find_ties(Active& active, F&& moves) const;
  // What looking ahead found out for the next step.
  struct Ahead {
    double h = 0;
    Scratch<std::uint32_t> places;  // of those that have increments
    Scratch<Increment<D>> increments;
    std::uint64_t force_evaluations = 0;
  };

  std::size_t index_of(BodyId id) const;
  Scratch<Pair> links() const;  // of what wakes together
  Scratch<Pair> ties() const;   // those that are no contacts
  void wake_from(std::span<const BodyId> ids);
  // With those beside them that came asleep: what these touch has never been looked at.
  Scratch<BodyId> with_untold_sleepers(std::span<const BodyId> ids) const;
  void wake_from(BodyId id) { wake_from(std::span(&id, 1)); }
  void disturb() {
    ahead_.reset();
    active_.reset();
    rests_ = false;
  }
  const Active& active();
  void rouse_touches();
  const Outcome& told_whole() const;
  template <class F>
  void each_touch(F&& f) const;
  void write_islands() const;
  void part_islands();
  void forget_contacts_of(std::span<const BodyId> ids);
  static void spin(Body<D>& body, const Spin<D>& angular_velocity);
  void go_on(double h) {
    ahead_.reset();
    time_ += h;
    ++work_.steps;
  }
  Outcome& cleared_outcome() {
    next_outcome_.clear(outcome_.impacts.keeps_looks);
    return next_outcome_;
  }
  BroadPhase<D>& structure() {  // made when it is first needed
    if (!broad_phase_) broad_phase_.emplace(config_.broad_phase);
    return *broad_phase_;
  }

  WorldConfig<D> config_;
  std::vector<Body<D>> bodies_;
  Scratch<double> rested_;  // seconds that each body has been slow
  bool may_rest_ = false;   // one of them is above 0, or a body sleeps: there may be who wakes
  bool rests_ = false;      // nothing moves: a step would tell what the last one told
  // Of each body; and of the last step, until that is written down: places of those that took part
  // in it, each with that of the lowest of its island.
  mutable std::vector<BodyId> islands_;
  mutable Scratch<std::pair<std::uint32_t, std::uint32_t>> roots_;
  mutable bool knows_islands_ = true;
  Forces<D> forces_;
  std::vector<std::pair<JointId, Joint<D>>> joints_;
  Scratch<JointMemory<D>> joint_memories_;
  BodyId next_id_ = 0;
  SpringId next_spring_ = 0;
  JointId next_joint_ = 0;
  double time_ = 0;

  std::optional<Active> active_;  // until anything wakes or falls asleep, comes or goes
  Scratch<Touch<D>> touching_;    // by pair, of the last step: of what is awake
  Scratch<Touch<D>> slept_;       // by pair: of two that have not moved since
  mutable Outcome outcome_;
  // Where the next step writes its own, kept for their memory.
  std::vector<Body<D>> next_bodies_;
  Outcome next_outcome_;
  std::optional<BroadPhase<D>> broad_phase_;
  bool told_all_ = false;           // it holds each body as it is, but for
  Scratch<std::uint32_t> stirred_;  // those that moved then, or were placed: places here
  std::optional<Ahead> ahead_;      // until anything changes
  WorldWork work_;
};

}  // namespace lantern::physics
