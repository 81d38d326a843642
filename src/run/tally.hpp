// What one run did, stage by stage, counted while it ran: nothing is guessed from the file.
#pragma once

#include <map>
#include <string>

#include "base/work.hpp"
#include "language/scenario.hpp"
#include "run/director.hpp"

namespace lantern::run {

struct Amount {
  std::uint64_t n = 0;
  std::string name;  // of one: "evaluation"
  std::string many;  // "evaluations"
};

struct StageTally {
  std::string stage;  // "world", "motion", "structure", "tree panel", ...
  std::vector<Amount> amounts;
  std::string note;  // a fact of the file or of the run: "10.3 s passed"; may be empty

  // Nothing of what is left out ran: all its counters stand at zero.
  bool used() const;
};

// Sees all frames of one run, whose director counts into `work`, new for it. Both must outlive it.
class Tally {
 public:
  Tally(const Scenario& scenario, const Work& work) : scenario_(scenario), work_(work) {}

  void see(const Frame& frame);
  // All stages that there are, in the order of a run.
  std::vector<StageTally> stages(const DirectorReport& report) const;

 private:
  using Stages = std::vector<StageTally>;
  void count_builds(const Frame& frame);
  void list_motion(const WorldWork& world, Stages& all) const;
  void list_structures(const WorldWork& world, Stages& all) const;
  void list_contacts(const WorldWork& world, Stages& all) const;
  void list_others(const DirectorReport& report, Stages& all) const;
  void list_pictures(Stages& all) const;

  const Scenario& scenario_;
  const Work& work_;
  double seconds_ = 0;  // that passed
  // What there is on a frame, on all sides together; walls and sectors once a level is compiled.
  struct Seen {
    std::uint64_t bodies = 0, asleep = 0, springs = 0, joints = 0, textures = 0, walls = 0;
    std::uint64_t sectors = 0, points = 0;
    void add(const Frame& frame);
  };
  Seen most_;
  std::uint64_t solid_ = 0;  // 3D frames
  // Frames with what a panel shows, by its place in the list.
  std::map<std::pair<std::size_t, std::string_view>, std::uint64_t> with_;
  std::map<StructureKind, std::uint64_t> builds_;
  std::uint64_t builds_of_several_ = 0;  // kinds, in one step
  std::uint64_t builds_before_ = 0;      // of the frame that is seen
};

}  // namespace lantern::run
