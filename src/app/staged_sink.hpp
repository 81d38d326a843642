// Frames that are drawn wait until all are there that share a layout with them.
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "app/run_scenario.hpp"
#include "draw/staging.hpp"

namespace lantern::app {

// Keeps the frames of a sequence, at most `Bound` of them, and then gives each with what its group
// shares; the axes of charts are those of all that were kept. A frame's picture depends on the
// scenario alone: the bound is counted in frames and in bytes estimated from what a frame lists.
// When a run is stopped before its end, frames that were waiting are not drawn.
class StagedSink : public FrameSink {
 public:
  struct Bound {
    std::size_t frames = 1000;
    std::size_t bytes = std::size_t{64} << 20;
  };
  StagedSink() = default;
  explicit StagedSink(const Bound& bound) : bound_(bound) {}

  void frame(const Frame& frame) final;
  void finish(const DirectorReport& report) final;
  std::uint64_t waiting() const final { return undrawn_; }

 protected:
  // Every frame of the run, in order.
  virtual void draw(const Frame& frame, const Staging& staging) = 0;
  // After the last one.
  virtual void close(const DirectorReport& report) = 0;

 private:
  void flush();

  Bound bound_;
  std::vector<Frame> waiting_;
  std::size_t bytes_ = 0;  // of those
  std::atomic<std::uint64_t> undrawn_{0};
};

}  // namespace lantern::app
