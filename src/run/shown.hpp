// What a frame shows beside the state: what is lit, its cause and no more; from where it is looked
// at; what the narrow phase was asked; rulers and the chart.
#pragma once

#include "frame/frame.hpp"
#include "frame/parts/panels.hpp"
#include "language/scenario.hpp"
#include "run/engine.hpp"

namespace lantern::run {

// Why there is a frame.
struct Cause {
  const VerbTraits& verb;
  const std::set<BodyId>& focus;  // the bodies that the step is about
  bool midst = false;             // in the midst of the algorithm; else what it has led to
};

// A step lights the bodies that it is about, the leaves that hold them and, as passed, the way to
// them. When it is about many, or about all that can move, only nodes and pairs are lit that are
// new. The first frame of a run lights nothing: all of it is new.
class Lighting {
 public:
  // Nodes that are marked already were watched at work and stay as they are.
  void light(const Cause& cause, Frame& frame) const;

  // The next frame's news are what this one does not have.
  void remember(const Frame& frame, bool midst);

 private:
  void light_nodes(const Cause& cause, bool few, Frame& frame) const;
  void light_pairs(bool few, Frame& frame) const;
  void light_edges(Frame& frame) const;

  std::vector<Pair> pairs_;            // of the last frame, ascending
  std::vector<Pair> edges_;            // the same
  std::vector<std::uint64_t> places_;  // of nodes, of the last frame that was not in the midst
};

// Lights these bodies and nodes, with the ways down to them, and nothing else. Gives the first name
// that the frame does not have.
const LitSpec* light_only(const std::vector<LitSpec>& lit, Frame& frame);

// Lights the body of that name, its pairs and the leaves that hold it, on all sides, and nothing
// else.
void light_held(std::string_view body, Frame& frame);

// Where frames are looked at from, and what of the world they show, from step to step.
class Looks {
 public:
  // The scenario must outlive this.
  explicit Looks(const Scenario& scenario);

  // What follows belongs to this step, which begins at that time of the world, in seconds.
  void begin(const Step& step, double time);

  // Fills the frame's display, view and camera; its time and bounds must be there.
  void show(Frame& frame) const;

 private:
  double angle_at(double time) const;
  void aim(Frame& frame) const;

  const Scenario& scenario_;
  const Step* step_ = nullptr;
  std::optional<Box<2>> view_;  // none: all
  std::optional<Camera> from_;  // before it goes round; none: as all is seen
  bool goes_round_ = false;     // somewhere in the script
  double angle_ = 0;            // radians that it went round before this step
  double began_ = 0;            // the step, seconds
  double seconds_ = 0;          // that the step may last
};

// What `test_shapes`, `separate` and `gjk` have told: shown in their own step, counted from then
// on.
class NarrowShown {
 public:
  // What a step before has shown is no longer drawn.
  void begin_step() { drawn_ = Drawn::nothing; }

  void show(ShapeTests tests);
  void show(FrameSeparation separation);
  void show(FrameSearch search);

  // Also the difference of the two that were searched last, or else of the first two bodies there.
  void add_to(Frame& frame, const Engine& engine) const;

 private:
  enum class Drawn { nothing, tests, separation, search };

  Drawn drawn_ = Drawn::nothing;
  std::optional<ShapeTests> tests_;
  std::optional<FrameSeparation> separation_;
  std::optional<FrameSearch> search_;
};

// Where a step's ruler begins and ends in the world; nothing while a body that it is laid to is not
// there. `engine` may be null if there are no bodies.
std::optional<std::pair<Vec<3>, Vec<3>>> ends_of(const RulerSpec& ruler, const Engine* engine);

// Seconds of world time that the whole script takes, or only its part `only`. Nothing if none
// passes, or if that depends on what happens.
std::optional<double> script_seconds(const Scenario& scenario, const std::string* only);

// The chart of a scenario: what steps with a `plot` counted, or what was measured as time went on.
class Plotter {
 public:
  explicit Plotter(const Scenario& scenario);

  bool over_time() const { return spec_.over_time(); }

  // What follows belongs to this part of the scenario, at this time.
  void begin_part(const std::string& part, double time);

  // A point on each line, or a bar of this label. A new part begins a new group of bars. What the
  // frame does not count is left out.
  void add(const std::string& label, const std::string& part, const Frame& frame);

  // A point on each line at the frame's time. Nothing where the same is said already.
  void add_moment(const Frame& frame);

  FrameChart chart() const { return chart_; }

 private:
  void name_series(const Scenario& scenario);
  bool name_by_sides(const Scenario& scenario);
  std::optional<double> x_of(const std::string& y, const Frame& frame) const;
  void add_pieces(const std::string& side, const Frame& frame);

  const Scenario& scenario_;
  const ChartSpec& spec_;
  FrameChart chart_;
  int group_ = 0;
  std::string part_;  // of the last bar, or that is going on
  double begun_ = 0;  // when the part's time began
};

}  // namespace lantern::run
