// One file through all of Lantern, in this process: read, explained, run, written as JSON, SVG and
// pixels, measured. What must always hold is asked on the way.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "frame/frame.hpp"
#include "fuzz/sees_all.hpp"
#include "fuzz/values.hpp"
#include "fuzz/watch.hpp"
#include "render/renderer.hpp"

namespace lantern::fuzz {

// Something that must hold does not.
class Finding : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

enum class Stage { reading, running, explaining, repeating, writing, drawing, measuring };
std::string_view to_string(Stage stage);
inline constexpr int kStages = 7;

struct TrialResult {
  std::vector<Diagnostic> mistakes;  // none: the scenario is good, and ran
  bool good = false;                 // it is a scenario
  bool ran = false;                  // to its end, in time
  bool stopped = false;              // some stage took too long, and heard the wish
  bool drawn = false, measured = false;
  std::uint32_t frames = 0;
  double energy_growth = 0;          // of what moves by itself: in parts of what there was
  std::set<std::uint64_t> features;  // what it reached, as hashes of words
};

class Trial {
 public:
  // `entered` is told each stage; `used` each "table.key" and each verb of a good file.
  Trial(Watch& watch, std::function<void(Stage)> entered,
        std::function<void(std::string_view)> used);

  // Throws Finding, or whatever Lantern must not throw.
  TrialResult run(const std::string& text, Dice& dice);

 private:
  struct Shots;

  void read_it(const std::string& text);
  void run_it(Pace pace, Dice& dice);
  void show(const Frame& frame);
  void measure_it(Dice& dice);

  Watch& watch_;
  std::function<void(Stage)> entered_;
  std::function<void(std::string_view)> used_;
  Renderer renderer_;
  std::unique_ptr<Scenario> scenario_;
  std::vector<Frame> shots_;  // two frames of the run
  TrialResult result_;
};

// A message without its numbers and quoted words: what kind of thing it tells.
std::string kind_of(std::string_view message);

// Throws Finding unless it is well-formed, so far as Lantern writes SVG.
void require_well_formed(std::string_view svg);

}  // namespace lantern::fuzz
