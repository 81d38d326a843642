// Warnings of what is legal in a scenario and surely not meant. Most are told from what the run
// did; of the file itself only that what stands there does nothing. Watching changes nothing of the
// run, and what a scene cannot show is not watched for.
#pragma once

#include <cstddef>
#include <utility>

#include "language/scenario.hpp"
#include "run/engine.hpp"

namespace lantern::run {

class Watcher;

// What was noticed in the file, by kind; of each kind only the first, and how many more there are.
std::vector<Diagnostic> warnings_of_file(const Scenario& scenario);

// Looks on while one scenario runs (see `direct`).
class RunWatch {
 public:
  // `shows_a_body` says whether the picture of a frame shows any of its bodies. The scenario is
  // the very one that runs, and must outlive the watch. The onlooker, if there is one, is shown the
  // world of every side after each step.
  RunWatch(const Scenario& scenario, std::function<bool(const Frame&)> shows_a_body,
           WorldWatch* onlooker = nullptr);
  explicit RunWatch(WorldWatch& onlooker);  // watches for nothing
  ~RunWatch();

  void begin(const Step& step);       // what follows belongs to this step
  void passed(const Engine& engine);  // a world step was made
  void see(const Frame& frame);

  // That of a scenario's `side`-th side; itself where there are none.
  RunWatch& of_side(std::size_t side) { return sides_.empty() ? *this : *sides_[side].second; }

  // What has been found so far, by kind; of each kind only the first, and how many more there are.
  std::vector<Diagnostic> warnings() const;

  // What is told of a run in any case, as "joints parted by at most 0.0012".
  std::vector<std::string> facts() const;

  // What is watched for, in the order of the kinds.
  std::vector<Warning> kinds() const;

 private:
  struct Watch {
    Warning kind;
    std::unique_ptr<Watcher> watcher;
    bool quiet = false;  // it warns of nothing
  };
  std::vector<Watch> watchers_;
  WorldWatch* onlooker_ = nullptr;
  std::vector<std::pair<std::string, std::unique_ptr<RunWatch>>> sides_;  // by their names
};

}  // namespace lantern::run
