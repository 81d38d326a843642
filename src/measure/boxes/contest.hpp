// Who takes part in `bench pairs`, and what is to be found.
#pragma once

#include <compare>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "measure/box_peer.hpp"
#include "measure/boxes/worlds.hpp"

namespace lantern::measure {

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

// --- what is to be found on a stage: by comparing all with all where that is possible, else by a
// sample and by each other ---

// Up to so many bodies all pairs are compared; beyond, those of a sample.
inline constexpr std::size_t kMostForced = 20000, kSample = 2000;

class BoxTruth {
 public:
  // Of the stage as it is at the frame.
  BoxTruth(const BoxStage& stage, std::size_t frame);

  struct Verdict {
    std::uint64_t missed = 0, invented = 0;
  };
  // `found` in order and without repeats.
  Verdict judge(std::span<const Pair> found) const;

  // Whether only the pairs of a sample are known.
  bool is_sample() const { return is_sample_; }
  std::string words() const;  // "brute force"

 private:
  template <int D>
  void force(const BoxStage& stage, std::size_t frame);
  template <int D>
  void force_sample(Boxes<D> boxes);
  template <int D>
  void answer(const BoxStage& stage);

  bool is_sample_ = false;
  std::size_t stride_ = 1;  // each such body is in the sample
  std::vector<Pair> truth_;
};

}  // namespace lantern::measure
