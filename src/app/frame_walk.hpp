// The way through the chosen frames of a run, for all that show what lies between them.
#pragma once

#include <optional>

#include "app/render_job.hpp"
#include "base/work.hpp"
#include "draw/draw_list.hpp"
#include "draw/staging.hpp"
#include "scenario/frame.hpp"

namespace lantern::app {

// Stands on a frame and knows the one before it. A page is laid out when it is first asked for.
class FrameWalk {
 public:
  FrameWalk(const RenderJob& job, Work& work) : job_(job), work_(work) {}

  // On to the next chosen frame. The staging is that of the frame and must outlive the stay there.
  void go_on(const Frame& frame, const Staging& staging);

  const Frame& here() const { return here_->frame; }
  const DrawList& page() { return page_of(*here_); }
  // The one that was chosen before; null on the first.
  const Frame* before() const { return before_ ? &before_->frame : nullptr; }
  const DrawList& page_before() { return page_of(*before_); }
  // No frame lies between the two: something may be shown that does.
  bool goes_on() const { return before_ && before_->frame.index + 1 == here_->frame.index; }
  // What is seen at `t` of the way, from 0, the frame before, to 1, this one.
  DrawList in_between(double t);

 private:
  struct Stop {
    Frame frame;
    std::optional<DrawList> page = std::nullopt;
  };
  const DrawList& page_of(Stop& stop);

  const RenderJob& job_;
  Work& work_;
  const Staging* staging_ = nullptr;
  std::optional<Stop> before_, here_;
};

}  // namespace lantern::app
