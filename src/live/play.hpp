// A scenario that is run whole, and its frames as pictures of a lesson page.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "draw/page.hpp"
#include "draw/staging.hpp"
#include "language/scenario.hpp"
#include "publish/lesson_frames.hpp"
#include "rooms.hpp"
#include "run/director.hpp"

namespace lantern::live {

// Which frame of a script: as a text that was changed may have others.
struct Moment {
  std::uint32_t step = 0;
  std::uint32_t place = 0;  // among the step's frames
  bool is_last = true;      // of them: then wherever that is
};

// From this step on, a scenario's frames are so many of its world's steps apart while time passes.
void stop_every(int world_steps, std::size_t from, language::Scenario& scenario);

class Play {
 public:
  // Runs it whole. Throws ScenarioError, and Refused for too many frames.
  explicit Play(language::Scenario scenario);
  // Runs what is before the moment's step: it has scenario and frames, but neither warnings nor
  // pictures.
  Play(language::Scenario scenario, const Moment& before);
  // And that step up to the moment, once, as this scenario has it: the one that was begun, or one
  // that differs from it only in that step and those behind it, of as many.
  void go_on(const language::Scenario& as, const Moment& until);

  // To run so much again would take longer than to copy an engine's memory.
  bool is_long() const { return work_.world_steps * scenario_.bodies.size() > 500; }

  const language::Scenario& scenario() const { return scenario_; }
  const std::vector<frame::Frame>& frames() const { return frames_; }
  const std::vector<Diagnostic>& warnings() const { return warnings_; }
  const std::vector<Diagnostic>& unmet() const { return unmet_; }

  Moment moment_of(std::size_t index) const;
  // The nearest to it that there is.
  std::size_t index_of(const Moment& moment) const;

  // What stands on the lesson page of a frame; title, caption and counters stand beside it.
  draw::DrawList picture(std::size_t index);
  // The whole page of a frame, as a picture of this many pixels has it.
  draw::DrawList page(std::size_t index, int width, int height);
  // The picture of a frame of another run, in the places that this one's frames have.
  draw::DrawList picture(const frame::Frame& frame, std::size_t beside,
                         const language::Scenario& of);

  // The body that a hand holds, or held last; none: "". Where a step asks nothing, what is of it is
  // lit on all pictures, and nothing that the script lights.
  std::string held;

  // Of its pictures, in page units.
  Vec<2> sheet = publish::lesson_page();

  // That this one's text was made from; null: none. What a picture of it needs has room on this
  // one's pictures, too, where they show the same kinds of things.
  std::shared_ptr<const Play> lesson;

 private:
  draw::DrawList drawn(const frame::Frame& frame, const draw::Staging& staging,
                       const language::Scenario& of);
  const draw::Staging& staging_of(std::size_t index);

  struct Group {
    std::span<const frame::Frame> frames;
    std::unique_ptr<draw::Staging> staging;  // made when it is first asked for
  };
  Group& group_of(std::size_t index);
  // The lesson's before its own.
  std::vector<const frame::Frame*> frames_beside(const Group& group) const;

  // False if no more are wanted.
  bool keep(const frame::Frame& frame);

  language::Scenario scenario_;
  std::vector<frame::Frame> frames_;
  std::size_t bytes_ = 0;       // of what they list
  std::uint32_t place_ = 0;     // of the last one among those of its step
  std::optional<Moment> last_;  // of those wanted
  const std::function<bool(const frame::Frame&)> sink_ = [this](const frame::Frame& frame) {
    return keep(frame);
  };
  std::unique_ptr<run::Performance> begun_;
  std::vector<Diagnostic> warnings_, unmet_;
  draw::AxisRanges axes_;
  std::vector<Group> groups_;
  Work work_;
};

}  // namespace lantern::live
