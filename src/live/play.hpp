// A scenario that is run whole, and its frames as pictures of a lesson page.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "draw/page.hpp"
#include "draw/staging.hpp"
#include "language/scenario.hpp"
#include "rooms.hpp"

namespace lantern::live {

// Which frame of a script: as a text that was changed may have others.
struct Moment {
  std::uint32_t step = 0;
  std::uint32_t place = 0;  // among the step's frames
  bool is_last = true;      // of them: then wherever that is
};

class Play {
 public:
  // Runs it, up to a moment if one is given: then it has scenario and frames, but neither warnings
  // nor pictures. Throws ScenarioError, and Refused for too many frames.
  Play(language::Scenario scenario, const std::optional<Moment>& until);

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
  draw::DrawList picture(const frame::Frame& frame, std::size_t beside);

 private:
  draw::DrawList drawn(const frame::Frame& frame, const draw::Staging& staging);
  const draw::Staging& staging_of(std::size_t index);

  struct Group {
    std::size_t first = 0, count = 0;
    std::unique_ptr<draw::Staging> staging;  // made when it is first asked for
  };
  Group& group_of(std::size_t index);

  language::Scenario scenario_;
  std::vector<frame::Frame> frames_;
  std::vector<Diagnostic> warnings_, unmet_;
  draw::AxisRanges axes_;
  std::vector<Group> groups_;
  Work work_;
};

}  // namespace lantern::live
