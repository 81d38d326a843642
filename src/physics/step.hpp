// One step of the world while it is made. It works on copies, so that a step that is refused half
// way, or stopped (base/stop.hpp), leaves the world as it was.
#pragma once

#include "physics/contact_solver.hpp"
#include "physics/island.hpp"
#include "physics/islands.hpp"
#include "physics/world.hpp"

namespace lantern::physics {

// The numbers of a step, whatever the method.
struct StepSettings {
  int most_tries = 4;     // the last one counts even if a body went farther than was looked for
  double slack = 1e-3;    // of a body's thickness: nearer is looked at, too
  double fast = 0.5;      // of the thinner body's thickness in a step: may pass through
  double fast_quick = 2;  // the same where an error is wanted: rows hold what is slower
  std::size_t most_manifolds =
      1 << 16;             // kept from the narrow phase for the solver; else made again
  double rounding = 1e-9;  // of a step's time, when a push ends; of a reach, whether it was kept
};
inline constexpr StepSettings kStepSettings;

template <int D>
struct World<D>::Step {
  // Two bodies that may touch. Of what an IslandPair holds only what is known before the island is
  // moved: there may be millions.
  struct NearPair {
    std::uint32_t a = 0, b = 0;  // places among all bodies
    double restitution = 0;
    double friction = 0;
    double reach = 0;
    const Touch* touch = nullptr;    // of the step before, if they touched in it
    std::uint32_t manifold = kNone;  // as they were found to lie; none of too many
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
  std::vector<JointMemory> joint_memories = world.joint_memories_;
  Forces<D> forces = world.forces_;
  std::vector<TimedPush> pushes = {};
  std::vector<Increment<D>> anew = {};  // increments anew, since bodies woke in this step
  std::vector<Proxy<D>> boxes = {};     // of bodies, enlarged by how far each may come
  std::vector<Pair> pairs = {};         // of the broad phase
  std::uint64_t narrow_pairs = 0;       // of those, looked at by the narrow phase
  std::vector<NearPair> near = {};      // in order of ids
  std::vector<Mat<D>> axes = {};        // of bodies, as the narrow phase sees them
  std::vector<Manifold<D>> manifolds = {};
  std::vector<std::uint32_t> root = {};         // of each body's island; static ones have their own
  std::vector<std::uint32_t> local_place = {};  // of each body in the island that was gathered last
  std::vector<Touch> touching = {};
  std::vector<std::uint32_t> touch_of = {};  // of each near pair; kNone: it did not touch
  bool struck = false;                       // an impact was located
  std::vector<Contact<D>> contacts = {};
  std::vector<ContactEvent> events = {};
  std::vector<Told> told = {};
  ImpactLog<D> impacts = {{}, {}, world.impacts_.keeps_looks};

  // The phases, in their order (world_step.cpp).
  void find_forces();
  void refresh_boxes();
  void broad_phase();
  void narrow_phase();
  bool wake_what_is_touched();  // whether any woke, who may touch others
  void make_islands();
  void solve_and_integrate();
  void require_no_overflow() const;
  bool stayed_within_reach();
  void fall_asleep();
  void update_contact_events();
  void commit();

  // Over the whole step, if nothing touches.
  const std::vector<Increment<D>>& increments() const {
    return anew.empty() ? world.ahead_->increments : anew;
  }

  // What looking ahead asks for.
  void require_boxes() const;
  std::vector<Proxy<D>> enlarged_boxes() const;

 private:
  bool collides() const { return world.config_.contacts != ContactMethod::none; }
  bool locates_impacts() const {
    return collides() && world.config_.continuous &&
           !contact_solver<D>(world.config_.contacts).whole_world;
  }
  std::uint32_t place_of(BodyId id) const { return static_cast<std::uint32_t>(world.index_of(id)); }
  bool is_slow(std::size_t place) const;

  bool flies_anywhere() const;
  void find_reach();
  Box<D> enlarged_box(std::size_t place) const;
  bool looks_for_contacts() const;
  std::vector<Pair> joined_pairs() const;
  std::optional<NearPair> nearing(const Pair& pair);
  IslandPair<D> island_pair(const NearPair& from) const;
  void wake(std::vector<std::uint32_t> places);

  std::vector<Group> groups_to_solve(bool whole_world) const;
  Island<D> gather(const Group& group);
  void bring_back(Island<D>& island, const Group& group);
  void order_touches();
};

}  // namespace lantern::physics
