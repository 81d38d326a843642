// From the pieces on the stage to finished frames: pictured, lit, captioned, verified and given on.
#pragma once

#include "run/director.hpp"
#include "run/shown.hpp"
#include "run/stage.hpp"

namespace lantern::run {

class FrameMaker {
 public:
  // Gives each frame that is looked at to `sink`, until it returns false.
  FrameMaker(const Scenario& scenario, Pace pace, const Stage& stage,
             const std::function<bool(const Frame&)>& sink, Wanted wants);

  // What follows belongs to this step.
  void begin(const Step& step, std::uint32_t index);
  // The next frame has this number: sides count together.
  void go_on_at(std::uint32_t frame) { report_.frames = frame; }
  const Step& step() const { return *step_; }
  bool by_event() const { return step_->pace.value_or(pace_) == Pace::event; }
  // In event pace: did the step ask for frames of this event?
  bool wanted(std::string_view event) const;
  // Is a frame of this event to be emitted, now? One that nobody looks at is counted instead.
  bool emits(std::string_view event);
  bool stopped() const { return stopped_; }

  // What the step is about, for all frames to come of it.
  Touched touched;
  std::optional<SweptSoFar> swept;  // a sweep is under way
  std::set<BodyId> focus;
  std::string texture;
  Vec<2> asked{0.0};  // the room that a texture is looking for
  void note_refused(const std::string& name);

  // What a ray, view or region has found, so far or in all: shown on this step's frames, counted
  // from now on.
  void show_finding(Finding finding);
  // One world more in the table of comparisons; what it says is filled in on the next frame.
  void add_row(FrameComparison::Row row, const std::string& answer);

  // The same of two bodies that are measured, or whose distance is searched for.
  NarrowShown narrow;

  // The state as it is, or `midst` the algorithm; with no caption, given to nobody.
  Frame picture(const Touched& touched, std::string_view event, bool midst = false);
  // A frame of a finished state, on which the step's promises are verified; its `expect` on the
  // last one of the step.
  void settle(std::string_view verb, bool last = true, const std::string& caption = {});
  // A frame in the midst of the algorithm, about one body if there is one. Of the lecture's code
  // that line is lit, or the one that the event is in.
  void emit(const Touched& touched, std::string_view event, std::string caption,
            std::optional<BodyId> about = {}, std::string_view line = {});
  void give(Frame frame, bool midst = false);
  // The frame is of this phase of a world step: the lecture's code is in that line.
  void show_phase(std::string_view phase, Frame& frame);
  // What a caption may quote beside counts, of a frame made now.
  std::optional<std::string> text_of(std::string_view name, const Frame& frame) const;
  // The step's promise is broken, whatever the frames say.
  void fail(std::string message);

  DirectorReport take_report() { return std::move(report_); }

 private:
  void add_finding(Frame& frame) const;
  void add_comparison(Frame& frame);
  void trace(Frame& frame);
  void begin_code();
  void light_code(std::string_view event, std::string_view line = {});
  void add_collisions(Frame& frame) const;
  std::uint32_t next_index();
  void tell_faults();
  void tell_splits(Frame& frame);
  void light_named(Frame& frame);
  void add_notes(Frame& frame);
  void require_notes(const Frame& frame);
  void dim(Frame& frame) const;
  void add_rulers(Frame& frame) const;
  void light_room(Frame& frame) const;
  void tell(const std::string& caption, Frame& frame) const;
  std::string fill(const std::string& text, const Frame& frame) const;
  std::string on_side() const;  // for a message; empty without sides
  void verify(const std::vector<Expectation>& expectations, const Frame& frame);

  struct QueryNumbers {
    QueryCounts counts;
    std::size_t hits = 0;
  };

  const Scenario& scenario_;
  Pace pace_;
  const Stage& stage_;
  const std::function<bool(const Frame&)>& sink_;
  Wanted wants_;
  std::optional<Plotter> plotter_;
  std::optional<FrameTrace> trace_;      // if a panel shows it
  double trace_begun_ = 0;               // when its part began
  std::optional<FrameCode> code_;        // the same
  std::optional<double> part_seconds_;   // of the script's part; none: it does not say
  std::uint64_t steps_before_part_ = 0;  // of the world
  DirectorReport report_;
  const Step* step_ = nullptr;
  std::uint32_t step_index_ = 0;
  std::string part_;
  std::string refused_names_;
  std::vector<std::string> headline_;
  std::vector<Panel> panels_;
  Lighting lighting_;
  std::vector<std::optional<double>> lengths_before_;  // of the step's rulers
  WorldWork last_work_;                                // at the last frame that was given
  std::optional<Finding> finding_;                     // of this step
  std::optional<QueryNumbers> counted_;                // of the last ray, view or region
  FrameComparison comparison_;
  std::string answer_;              // of its last row, until it is filled in
  std::set<const void*> reported_;  // what does not hold is reported once
  // Of the last frame that was given: its structure, time and divided nodes.
  StructureKind last_structure_ = StructureKind::none;
  double last_time_ = 0;
  std::set<std::string> divided_;
  Looks looks_;
  std::set<const NoteSpec*> noted_;  // of this step, on some frame
  std::set<std::string> faults_;     // of a structure that the program was given, once told
  bool stopped_ = false;
};

}  // namespace lantern::run
