#include "run/engine.hpp"

#include <fmt/format.h>

#include "base/stop.hpp"
#include "language/counts.hpp"
#include "run/asked.hpp"
#include "run/step_by_step.hpp"
#include "run/structure_picture.hpp"
#include "run/world_picture.hpp"

namespace lantern::run {

// --- what is counted here ---

namespace {

constexpr CountDoc kEngineCounts[] = {
    {"bodies", when::bodies, "body/bodies", "Bodies in the world.", Most::bodies},
    {"tests_so_far", when::inside, "test so far/tests so far",
     "Tests made to find pairs since the script began: `box_tests` and `pair_tests` of every build "
     "that a frame shows, and of a compiled level its `side_tests`."},
    {"collisions_alive", when::contacts, "collision alive/collisions alive",
     "Pairs of which it has been told that they began to touch, and not yet that they ceased to."},
    {"begins_in_all", when::contacts, "begin/begins",
     "Pairs that began to touch since the scenario began."},
    {"touches_in_all", when::contacts, "touch/touches",
     "Pairs that touched since the scenario began, once for each world step."},
    {"asleep", when::sleep, "asleep", "Bodies asleep.", Most::bodies},
    {"awake", when::sleep, "awake",
     "Bodies that can move and are not asleep, whether they move now or not.", Most::bodies}};

template <int D>
class EngineOf : public Engine {
 public:
  EngineOf(const Scenario& scenario, Work& work)
      : scenario_(scenario), work_(work), players_(scenario) {
    if (scenario.shows_trails()) trails_.emplace();
    ++work_.worlds_created;
    count_structures();
    if (shows(scenario.panels, "collisions")) collision_log_.emplace();
  }

  void enter(std::size_t body) override {
    players_.enter(body);
    steered_ = false;
  }
  void apply(const Insert& insert) override {
    for (const std::size_t body : insert.bodies) enter(body);
  }
  void apply(const Emit& emit) override {
    emissions_.push_back({emit.bodies, emit.every, 0, 1});
    let_in();
  }
  void apply(const Remove& remove) override {
    stop_if_asked();
    players_.leave(remove.bodies);
  }

  void store(std::span<const std::size_t> bodies, const Watch& watch) override {
    if (!has_structure()) return;
    being_stored_ = true;
    world().store(ids_of(bodies), scenario_.world.time_step, watch);
    being_stored_ = false;
  }

  void apply(const Move& move) override {
    const Body<D> before = *players_.body(move.body);
    const Vec<D> to = move.to ? in_dimension<D>(*move.to) : before.position;
    const Vec<D> velocity = move.velocity ? in_dimension<D>(*move.velocity) : before.velocity;
    Rotation<D> orientation = before.orientation;
    const BodySpec& spec = scenario_.bodies[move.body];
    if (move.turned) orientation = turned(Rotation<D>(), spin_about<D>(spec.axis, *move.turned));
    world().place(before.id, to, velocity, orientation);
    if (trails_ && to != before.position) trails_->forget(before.id);
    if (move.spin)
      world().set_angular_velocity(before.id, spin_about<D>(spec.axis_of_spin(), *move.spin));
  }

  void apply(const ApplyForce& force) override {
    const Body<D>& pushed = *players_.body(force.body);
    world().clear_pushes(pushed.id);
    if (force.force != Vec<3>(0.0))
      world().push(pushed.id, in_dimension<D>(force.force),
                   pushed.position + in_dimension<D>(force.at));
  }

  void apply(const ApplyImpulse& impulse) override {
    const Body<D>& struck = *players_.body(impulse.body);
    world().apply_impulse(struck.id, in_dimension<D>(impulse.impulse),
                          struck.position + in_dimension<D>(impulse.at));
  }

  void apply(const Sleep& sleep) override {
    for (const BodyId id : ids_of(sleep.bodies)) world().sleep(id);
  }
  void apply(const Wake& wake) override { world().wake(ids_of(wake.bodies)); }

  void apply(const SolveBy& method) override {
    const WorldConfig<D>& now = world().config();
    world().switch_contacts(method.contacts,
                            method.sub_steps > 0 ? method.sub_steps : now.sub_steps,
                            method.iterations > 0 ? method.iterations : now.iterations,
                            method.wanted_error ? method.wanted_error : now.wanted_error);
  }

  void step() override {
    const double h = scenario_.world.time_step;
    looked_ahead_ = false;
    if (!steered_) steer();
    const WorldWork before = world().work();
    if (trails_) trails_->begin(world());
    world().step(h);
    if (trails_) trails_->end(world());
    steer();
    outdated_ = true;
    last_ = work_between(before, world().work());
    ++work_.world_steps;
    let_in();
    for (const ContactEvent& event : world().fresh_events()) {
      begins_ += event.kind == ContactEvent::Kind::begin;
      ends_ += event.kind == ContactEvent::Kind::end;
      all_begins_ += event.kind == ContactEvent::Kind::begin;
    }
    all_touches_ += world().touches();
    if (collision_log_) collision_log_->see(world());
  }

  std::vector<FrameLook> step_and_tell_looks() override {
    world().keep_impact_looks(true);
    step();
    world().keep_impact_looks(false);
    return looks_of(world().impacts(), scenario_.world.time_step);
  }

  void rebuild() override { outdated_ = true; }

  void follow(const Watch& watch) override {
    if (!has_structure()) return;
    being_stored_ = true;
    look_ahead(watch);
    being_stored_ = outdated_ = false;
  }

  void each_swept(const std::function<void(BodyId, BodyId)>& f) override {
    bring_up_to_date();
    world().broad_phase()->each_swept(f);
  }

  void rebuild_as(const StructureSpec& structure) override {
    count_builds();
    structure_ = structure;
    count_structures();
    world().switch_broad_phase(
        broad_phase_of<D>(structure, in_dimension<D>(scenario_.world.bounds)));
    builds_ = {};
    rebuild();
  }

  // Of a world without a structure of its own every body is asked.
  Finding ask(const Question& question) override {
    ++work_.queries;
    if (!has_structure()) outdated_ = true;
    bring_up_to_date();
    return asked<D>(question, players_.world());
  }

  FrameSeparation separate(std::size_t a, std::size_t b) const override {
    return axes_between(*players_.body(a), *players_.body(b));
  }
  FrameSearch search(std::size_t a, std::size_t b) const override {
    return distance_search(*players_.body(a), *players_.body(b));
  }
  ShapeTests test_shapes() override {
    bring_up_to_date();
    return tests_of_shapes(players_.world());
  }
  std::optional<FrameDifference> difference(BodyId a, BodyId b) const override {
    const Body<D>*first = players_.world().find(a), *second = players_.world().find(b);
    return first && second ? difference_of(*first, *second) : std::nullopt;
  }

  FrameComparison::Row compare(const std::vector<std::size_t>& bodies,
                               const std::vector<StructureKind>& kinds) const override {
    return compare_kinds<D>(scenario_, structure_, bodies, kinds);
  }

  std::optional<BodyId> id_of(std::size_t body) const override { return players_.id_of(body); }

  bool is_moving(std::size_t index) const override {
    const Body<D>* body = players_.body(index);
    return body && body->moves() && !body->asleep && body->velocity != Vec<D>(0.0);
  }

  bool is_asleep(std::size_t index) const override {
    const Body<D>* body = players_.body(index);
    return !body || body->asleep;
  }

  std::vector<Pair> told_of(Wait::Event event) const override {
    const auto kind =
        event == Wait::Event::touch ? ContactEvent::Kind::begin : ContactEvent::Kind::end;
    std::vector<Pair> pairs;
    for (const ContactEvent& told : players_.world().events())
      if (event == Wait::Event::crush ? told.crushes : told.kind == kind)
        pairs.push_back(told.pair());
    return pairs;
  }

  Members members_of_nodes() override {
    bring_up_to_date();
    looked_ahead_ = true;
    return members_of(structure_, *world().broad_phase());
  }

  std::string label_of(NodeHandle node) const override {
    return run::label_of(structure_, *players_.world().broad_phase(), node);
  }
  const StructureSpec& structure() const override { return structure_; }
  std::string name_of(BodyId id) const override {
    const Body<D>* body = players_.world().find(id);
    return fmt::format("'{}'", body ? body->name : "");
  }
  std::vector<std::string> structure_faults() const override {
    std::vector<std::string> texts;
    if (!players_.world().broad_phase()) return texts;
    for (const OwnFault& fault : players_.world().broad_phase()->faults())
      texts.push_back(text_of(fault, [&](BodyId id) { return name_of(id); }));
    return texts;
  }
  void observe(std::vector<BodyState>& states) const override {
    states.resize(scenario_.bodies.size());
    for (std::size_t i = 0; i < states.size(); ++i) {
      const Body<D>* body = players_.body(i);
      states[i] = body ? state_of(*body) : BodyState{};
    }
  }
  const WorldWork& world_work() const override { return players_.world().work(); }
  std::uint64_t world_hash() const override { return players_.world().hash(); }

  void show(WorldWatch& watch) const override { watch.see_world(players_); }

  void list_collisions(FrameCollisions& collisions) const override {
    if (collision_log_) collision_log_->list(collisions);
  }

  void forget_events() override { begins_ = ends_ = 0; }

  StepFindings findings() const override {
    StepFindings found = findings_of(players_, scenario_.world.time_step);
    found.work = last_;
    found.begins = begins_;
    found.ends = ends_;
    return found;
  }

  void picture(const Touched& touched, const SweptSoFar* swept, Frame& frame) override {
    if (has_structure()) bring_up_to_date();
    picture_world(players_, frame);
    const StepFindings found = findings();
    frame.contacts = found.contacts;
    frame.tested = found.tested;
    if (shows(frame.panels, "islands")) picture_islands(players_, island_numbers_, frame);
    if (trails_ && frame.display.trail > 0)
      trails_->picture(world(), scenario_.world.time_step, frame);
    if (frame.display.forces) picture_forces(players_, frame);
    frame.counts.emplace_back("bodies", frame.bodies.size());
    frame.add<FrameStructure>().may_sleep = scenario_.world.may_sleep;
    picture_structure(structure_, players_.world(), scenario_.tells_sleepers(), touched, swept,
                      frame);
    count_tests(frame);
    if (!being_stored_) light_those_that_left(frame);
    work_.pair_searches += has_structure();
    work_.pairs_found += frame.pairs.size();
    count_builds();
    count(found, frame);
    if (scenario_.has_physics()) measure_world(players_, scenario_, frame);
    if (scenario_.has_contacts()) {
      frame.measures.emplace_back("penetration", found.penetration());
      frame.measures.emplace_back("time_of_impact", found.time_of_impact);
    }
    measure_bodies(players_, scenario_, frame);
  }

 private:
  World<D>& world() { return players_.world(); }

  // Of bodies that are there.
  std::vector<BodyId> ids_of(std::span<const std::size_t> bodies) const {
    return mapped(bodies, [&](std::size_t body) { return *players_.id_of(body); });
  }

  // The leaves of bodies that had left their boxes when the structure last followed them.
  void light_those_that_left(Frame& frame) const {
    for (FrameNode& node : frame.nodes)
      if (node.leaf &&
          std::ranges::any_of(node.bodies, [&](BodyId id) { return left_.contains(id); }))
        node.mark = Mark::lit;
  }

  // Bodies that enter one after another, `every` so many world steps.
  struct Emission {
    std::vector<std::size_t> bodies;
    std::uint64_t every = 1;
    std::size_t next = 0;    // of `bodies`
    std::uint64_t wait = 0;  // world steps until it enters
  };

  // Those whose time has come.
  void let_in() {
    for (Emission& emission : emissions_) {
      if (--emission.wait > 0) continue;
      enter(emission.bodies[emission.next++]);
      emission.wait = emission.every;
    }
    std::erase_if(emissions_, [](const Emission& e) { return e.next == e.bodies.size(); });
  }

  bool has_structure() const { return structure_.kind != StructureKind::none; }

  void count_structures() {
    if (has_structure()) work_.structures_created += structure_.split_static ? 2 : 1;
  }

  // Those of the world's structure since it was last asked.
  void count_builds() {
    if (!world().broad_phase()) return;
    const BroadPhaseCounters& now = world().broad_phase()->counters();
    work_.structure_builds += now.dynamic_builds - builds_.dynamic_builds;
    work_.static_builds += now.static_builds - builds_.static_builds;
    builds_ = now;
  }

  // Of the builds since the frame before, the one that this frame shows; while bodies are on
  // their way into it, it is not done.
  void count_tests(Frame& frame) {
    if (!has_structure() || !frame.count("box_tests")) return;
    const BroadPhaseCounters& now = world().broad_phase()->counters();
    untold_build_ |=
        now.dynamic_builds != builds_.dynamic_builds || now.static_builds != builds_.static_builds;
    if (untold_build_ && !being_stored_) {
      tests_so_far_ +=
          static_cast<std::uint64_t>(*frame.count("box_tests") + *frame.count("pair_tests"));
      untold_build_ = false;
    }
    frame.add_count("tests_so_far", tests_so_far_);
  }

  // For the next step; what looks ahead must know where bodies are going.
  void steer() {
    brains_.steer(world(), scenario_.world.time_step,
                  [&](std::size_t i) { return players_.id_of(i); });
    steered_ = true;
  }

  // What is drawn or asked is the structure of the bodies as they are. Without contacts nobody
  // else needs it: it is built only then.
  void bring_up_to_date() {
    if (being_stored_ || std::exchange(looked_ahead_, false)) return;
    if (outdated_ || scenario_.has_contacts() || !world().broad_phase()) look_ahead();
    outdated_ = false;
  }

  void look_ahead(const Watch& watch = {}) {
    if (!steered_) steer();
    left_.clear();
    if (!traits_of(structure_.kind).follows)
      return world().look_ahead(scenario_.world.time_step, watch);
    world().look_ahead(scenario_.world.time_step, [&](const Event& event) {
      if (event.kind == Event::Kind::leave) left_.insert(event.body);
      if (watch) watch(event);
    });
  }

  void count(const StepFindings& found, Frame& frame) const {
    const auto add = [&](const StepFindings::Counts& counts) {
      for (const auto& [name, n] : counts) frame.add_count(name, n);
    };
    if (scenario_.has_contacts()) {
      add(found.contact_counts());
      frame.add_count("collisions_alive", players_.world().told().size());
      frame.add_count("begins_in_all", all_begins_);
      frame.add_count("touches_in_all", all_touches_);
      add(found.solver_counts());
    }
    if (scenario_.tells_sleepers()) {
      std::uint64_t asleep = 0, awake = 0;
      for (const FrameBody& body : frame.bodies)
        if (!body.is_static) ++(body.asleep ? asleep : awake);
      frame.add_count("asleep", asleep);
      frame.add_count("awake", awake);
    }
    if (shows(frame.panels, "islands")) count_islands(frame);
    if (scenario_.has_physics()) add(found.motion_counts());
  }

  const Scenario& scenario_;
  Work& work_;
  Players<D> players_;
  StructureSpec structure_ = scenario_.structure;
  bool steered_ = false;       // who has a brain has made up its mind about the next step
  bool being_stored_ = false;  // a body is on its way down the structure
  bool outdated_ = false;      // bodies have moved on since it was built
  bool looked_ahead_ = false;  // since the last step, before any frame
  Brains<D> brains_{scenario_};
  std::vector<Emission> emissions_;
  IslandNumbers island_numbers_;
  WorldWork last_;                             // what the last step did
  std::optional<CollisionLog> collision_log_;  // if a panel shows it
  BroadPhaseCounters builds_;                  // of them, what is counted
  std::uint64_t tests_so_far_ = 0;             // to find pairs
  bool untold_build_ = false;                  // its tests are not among them yet
  std::optional<Trails<D>> trails_;            // if any frame shows them
  std::set<BodyId> left_;  // their boxes, when an aabb_tree last followed its bodies
  std::uint64_t begins_ = 0;
  std::uint64_t ends_ = 0;
  std::uint64_t all_begins_ = 0;  // since the world began
  std::uint64_t all_touches_ = 0;
};

}  // namespace

std::span<const CountDoc> engine_counts() { return kEngineCounts; }

std::unique_ptr<Engine> make_engine(const Scenario& scenario, Work& work) {
  if (scenario.world.dimension == 3) return std::make_unique<EngineOf<3>>(scenario, work);
  return std::make_unique<EngineOf<2>>(scenario, work);
}

}  // namespace lantern::run
