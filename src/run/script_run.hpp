// A script while it runs: what its verbs act on.
#pragma once

#include "run/frame_maker.hpp"
#include "run/warnings.hpp"

namespace lantern::run {

struct ScriptRun : Performance {
  ScriptRun(const Scenario& of, Pace pace, Work& work,
            const std::function<bool(const Frame&)>& sink, RunWatch* watched_by,
            Wanted wants = Wanted::all)
      : scenario(of),
        stage(of, work),
        watch(watched_by),
        given([this, &sink](const Frame& frame) {
          if (watch) watch->see(frame);
          return sink(frame);
        }),
        frames(of, pace, stage, given, wants) {}
  ScriptRun& operator=(ScriptRun&&) = delete;  // nor any other copy or move

  const Scenario& scenario;
  Stage stage;
  RunWatch* watch;  // null if nobody looks for warnings
  const std::function<bool(const Frame&)> given;
  FrameMaker frames;

  // Of the bodies, which the scenario must have.
  Engine& engine() { return *stage.engine; }

  std::uint32_t ticks_in(double seconds) const;
  std::uint32_t frame_every(int of_step) const;  // 0: the world's
  // One world step, and the structure anew. The looks by which it found its first impact, if they
  // are asked for.
  std::vector<FrameLook> let_time_pass(bool with_looks = false);

  // The step is about this body, or about all that move.
  void focus(std::size_t body);
  void watch_movers();
  // An insertion into the structure, as it happens.
  void witness(const Event& event);
  // Does that; empty if the step has no frame of anything that the structure tells of one.
  EventWatch watch_of_insertion();
  std::string name_of(BodyId body) const;

  void play(const Scenario& as, std::size_t index) override;
  bool stopped() const override { return frames.stopped(); }
  DirectorReport report() override;
};

// What a verb does, with its frames. One that is not here is one change, shown when it is done.
void act(const Insert& insert, ScriptRun& run);
void act(const Emit& emit, ScriptRun& run);
void act(const Remove& remove, ScriptRun& run);
void act(const Move& move, ScriptRun& run);
void act(const Run& verb, ScriptRun& run);
void act(const Wait& wait, ScriptRun& run);
void act(const Phases& phases, ScriptRun& run);
void act(const Rebuild& rebuild, ScriptRun& run);
void act(const language::Sweep& sweep, ScriptRun& run);
void act(const Compare& compare, ScriptRun& run);
void act(const CastRay& ray, ScriptRun& run);
void act(const Cull& cull, ScriptRun& run);
void act(const Query& query, ScriptRun& run);
void act(const TestShapes& test, ScriptRun& run);
void act(const Separate& of, ScriptRun& run);
void act(const SearchDistance& of, ScriptRun& run);
void act(const CompileLevel& compile, ScriptRun& run);
void act(const Locate& locate, ScriptRun& run);
void act(const OrderFrom& order, ScriptRun& run);
void act(const See& see, ScriptRun& run);
void act(const Pack& pack, ScriptRun& run);
void act(const AskRoom& ask, ScriptRun& run);
void act(const DrawScreen& draw, ScriptRun& run);

// Of a scenario with sides: the k-th frame of a step has the k-th of each side. A side that has
// fewer holds its last. A step throws ScenarioError, at its place, too, when its frames need more
// memory than there is.
std::unique_ptr<Performance> perform_sides(const Scenario& scenario, Pace pace, Work& work,
                                           const std::function<bool(const Frame&)>& sink,
                                           RunWatch* watch);

}  // namespace lantern::run
