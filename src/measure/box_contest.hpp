// Who takes part in `bench pairs`, and how one is run: ours by kind of structure, other libraries
// by their modules.
#pragma once

#include <compare>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "measure/box_peer.hpp"
#include "measure/box_workloads.hpp"

namespace lantern::measure {

template <int D>
struct Questions {
  std::vector<Ray<D>> rays;
  std::vector<Box<D>> boxes;
  std::vector<Ball<D>> balls;
};

// A world that all contestants get: one workload with so many bodies.
struct BoxStage {
  std::string workload;
  BoxTask task = BoxTask::pairs;
  BoxScene scene;
  std::variant<Questions<2>, Questions<3>> questions;  // of what is asked

  int dimension() const { return scene.dimension(); }
  std::size_t bodies() const;
  std::size_t frames() const;
};
BoxStage stage_of(const BoxWorkload& workload, std::size_t bodies, std::uint64_t seed);
// The first frame of a stage of pairs, with only each `part`-th of its boxes.
BoxStage thinned(const BoxStage& stage, std::size_t part);

// How many questions one step asks.
inline constexpr std::size_t kQuestions = 400;

// What a contestant can be set to. Two numbers whose neighbours are like it: of our trees the
// capacity 2^first and the depth limit `second`, of others the place in a list.
struct BoxSetting {
  int first = 0, second = 0;
  auto operator<=>(const BoxSetting&) const = default;
};

// What was counted in the last step; nothing where nobody counts.
struct BoxCounts {
  std::optional<double> pair_tests, box_tests, nodes_visited, nodes, entries;
};

// A contestant with one setting on one stage.
class BoxRun {
 public:
  virtual ~BoxRun() = default;
  // Of pairs: the boxes of that frame become these, and all their pairs are found. Else all
  // questions are asked once. Throws Refused as the structure does.
  virtual void step(std::size_t frame) = 0;
  // Of the last step, in order: pairs, or (number of the question, body).
  virtual const std::vector<Pair>& found() const = 0;
  virtual std::optional<std::uint64_t> allocations() const { return std::nullopt; }  // so far
  virtual BoxCounts counts() const { return {}; }
};

class BoxContestant {
 public:
  virtual ~BoxContestant() = default;
  virtual std::string name() const = 0;
  virtual std::string version() const { return {}; }  // of another library; empty for ours
  virtual std::string how() const { return {}; }      // it is run, of another library
  virtual bool can(const BoxStage& stage) const = 0;
  // From which the quickest is looked for.
  virtual BoxSetting likely(const BoxStage& stage) const = 0;
  virtual bool has(const BoxSetting& setting) const = 0;
  virtual std::string words(const BoxSetting& setting) const = 0;  // may be empty
  // The stage outlives the run.
  virtual std::unique_ptr<BoxRun> start(const BoxStage& stage, const BoxSetting& setting) const = 0;
  bool is_peer() const { return !version().empty(); }
};

// Ours: each kind but those whose parts a designer gives (bsp), `auto` first where there is one.
std::vector<std::unique_ptr<BoxContestant>> own_box_contestants();

// The libraries whose modules are there; a line in `missing` for each other.
std::vector<std::unique_ptr<BoxContestant>> peer_box_contestants(std::vector<std::string>& missing);

// Brings pairs into the order of their ids; `bodies` is more than any of these. What others find is
// ordered by this within their time.
void into_order(std::vector<Pair>& pairs, std::uint32_t bodies);

}  // namespace lantern::measure
