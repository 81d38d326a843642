// What is to be found on a stage: by comparing all with all where that is possible, else by a
// sample and by each other.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "measure/box_contest.hpp"

namespace lantern::measure {

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
