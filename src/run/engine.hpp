// The engine of one scenario: its world and structures, of two or three dimensions. The director
// drives it without knowing which.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <span>

#include "base/work.hpp"
#include "frame/body_state.hpp"
#include "frame/parts/asked.hpp"
#include "frame/parts/motion.hpp"
#include "frame/parts/panels.hpp"
#include "language/scenario.hpp"
#include "physics/world_config.hpp"
#include "spatial/query.hpp"

namespace lantern::run {

// What a ray, a view or a region found, and the walk that found it.
struct Finding {
  struct Met {
    double distance = 0;  // along the ray
    Vec<3> position{0.0};
  };

  std::vector<BodyId> hits;  // of a ray in order along it, else ascending
  QueryCounts counts;
  std::vector<QueryEvent> walk;  // all that happened, in order
  // Of the walk, what belongs to the structure of what never moves.
  std::size_t first_static = std::numeric_limits<std::size_t>::max();
  bool done = true;           // else the walk is still under way
  std::set<BodyId> missed;    // tested in vain
  bool nearest = false;       // a ray stops at its first hit
  Vec<3> asked{0.0};          // where the ray would end if nothing stopped it
  std::map<BodyId, Met> met;  // all that the ray's walk found, also behind the nearest
  std::optional<FrameRay> ray;
  std::optional<FrameView> view;
  std::optional<FrameQuery> region;
};

// How far a sweep has come. The state stays as it is; of its pairs those are told that were met.
struct SweptSoFar {
  std::uint64_t state = 0;  // its hash
  BodyId at = 0;            // at whose beginning it stands
  std::set<Pair> met;
};

// What a step of the world finds and does, beside how bodies lie: the record from which frames of
// its phases are made. Nothing found: a step that has not begun.
struct StepFindings {
  using Counts = std::vector<std::pair<std::string_view, std::uint64_t>>;

  std::vector<FrameContact> contacts;
  std::vector<Pair> tested;  // whose shapes were, in order of ids
  WorldWork work;
  std::uint64_t begins = 0, ends = 0;  // of contacts
  double time_of_impact = 1;           // of the first; a share of the step

  // Its counts, in the order in which frames have them.
  Counts contact_counts() const;
  Counts solver_counts() const;
  Counts motion_counts() const;
  double penetration() const;  // of the deepest contact

  // In place of what a frame tells of a step, of the numbers that it has.
  void put_on(Frame& frame) const;
};

template <int D>
class Players;

// Of the last step: contacts, tested pairs and the first impact; time steps have `h` seconds. Pairs
// of which a body has left since are not among them.
template <int D>
StepFindings findings_of(const Players<D>& players, double h);

class WorldWatch;

// Bodies are named by their index in the scenario. Each call throws Refused as world and trees do.
class Engine {
 public:
  using Watch = std::function<void(const Event&)>;
  virtual ~Engine() = default;

  virtual void enter(std::size_t body) = 0;  // into the world only
  // Into the structure as well, one after another.
  virtual void store(std::span<const std::size_t> bodies, const Watch& watch) = 0;
  // What a verb does to bodies, without frames.
  virtual void apply(const Insert& insert) = 0;  // into the world only
  virtual void apply(const Emit& emit) = 0;      // the first of them now, the others in later steps
  virtual void apply(const Remove& remove) = 0;
  virtual void apply(const Move& move) = 0;
  virtual void apply(const ApplyForce& force) = 0;
  virtual void apply(const ApplyImpulse& impulse) = 0;
  virtual void apply(const Sleep& sleep) = 0;
  virtual void apply(const Wake& wake) = 0;
  virtual void apply(const SolveBy& method) = 0;
  virtual void step() = 0;  // one world step
  // From now on the structure is that of the bodies as they are. It is built, its memory reused,
  // when a frame, a query or the next step of a world with contacts needs it.
  virtual void rebuild() = 0;
  // The same at once; a structure that goes on from where its bodies were tells what it does.
  virtual void follow(const Watch& watch) = 0;
  // f(id, id) for each pair that a sweep compares, in its order.
  virtual void each_swept(const std::function<void(BodyId, BodyId)>& f) = 0;
  // Another structure, all bodies anew; the world's broad phase becomes the same kind.
  virtual void rebuild_as(const StructureSpec& structure) = 0;

  virtual Finding ask(const Question& question) = 0;
  // Of these bodies alone, by each of these kinds with the settings that stand; without a name.
  virtual FrameComparison::Row compare(const std::vector<std::size_t>& bodies,
                                       const std::vector<StructureKind>& kinds) const = 0;

  // Two bodies of a flat world that are there, no half-spaces: what the narrow phase's test of them
  // measures, and how their distance is searched for.
  virtual FrameSeparation separate(std::size_t a, std::size_t b) const = 0;
  virtual FrameSearch search(std::size_t a, std::size_t b) const = 0;
  // The shapes of all pairs that the structure has, which there must be: each tested as it is.
  virtual ShapeTests test_shapes() = 0;
  // Their Minkowski difference; nothing unless both are there, and of half-spaces.
  virtual std::optional<FrameDifference> difference(BodyId a, BodyId b) const = 0;

  virtual std::optional<BodyId> id_of(std::size_t body) const = 0;
  virtual bool is_moving(std::size_t body) const = 0;
  virtual bool is_asleep(std::size_t body) const = 0;
  // The pairs that touched, parted or crushed in the last step.
  virtual std::vector<Pair> told_of(Wait::Event event) const = 0;
  // By the label of a node: the bodies that are stored in it or below it.
  using Members = std::map<std::string, std::set<BodyId>>;
  virtual Members members_of_nodes() = 0;
  virtual std::string label_of(NodeHandle node) const = 0;
  virtual const StructureSpec& structure() const = 0;
  virtual std::string name_of(BodyId id) const = 0;  // "'red'": for messages
  // What is not so of a structure that the program was given, as it stands.
  virtual std::vector<std::string> structure_faults() const = 0;

  // One state a body of the scenario, in its order; without pixels, and without structures.
  virtual void observe(std::vector<BodyState>& states) const = 0;
  virtual const WorldWork& world_work() const = 0;  // of the world since it was made
  virtual std::uint64_t world_hash() const = 0;
  virtual void show(WorldWatch& watch) const = 0;  // the world as it is now
  // What the world remembered of pairs that touch, step by step. It is written down only if the
  // scenario has a panel for it.
  virtual void list_collisions(FrameCollisions& collisions) const = 0;

  // One world step, and the looks by which it found its first impact; none if it found none.
  virtual std::vector<FrameLook> step_and_tell_looks() = 0;

  // What the last step found; its events as they are counted below.
  virtual StepFindings findings() const = 0;
  // Events of contacts are counted from here on.
  virtual void forget_events() = 0;
  // Bodies, nodes, pairs, contacts, links, counts and measures as they are; of pairs only what was
  // `swept`, unless it is null.
  virtual void picture(const Touched& touched, const SweptSoFar* swept, Frame& frame) = 0;
};

std::unique_ptr<Engine> make_engine(const Scenario& scenario, Work& work);

// What a verb does to an engine's bodies, without frames: one that only shows, asks or partitions
// does nothing, one that passes time takes its steps. Throws Refused as the engine does.
void carry_out(const Verb& verb, Engine& engine, double time_step);

}  // namespace lantern::run
