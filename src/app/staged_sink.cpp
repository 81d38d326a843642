#include "app/staged_sink.hpp"

#include "base/stop.hpp"

namespace lantern::app {
namespace {

template <class T>
std::size_t bytes_of(const std::vector<T>& list) {
  return list.size() * sizeof(T);
}

// About what the frame takes in memory, by the lengths of its lists: the same on every machine.
std::size_t estimated_bytes(const Frame& frame) {
  std::size_t bytes = sizeof(Frame) + bytes_of(frame.bodies) + bytes_of(frame.pairs) +
                      bytes_of(frame.links) + bytes_of(frame.walls) + bytes_of(frame.textures) +
                      bytes_of(frame.counts) + bytes_of(frame.measures) +
                      bytes_of(frame.chart.bars);
  for (const FrameNode& node : frame.nodes)
    bytes += sizeof(FrameNode) + bytes_of(node.bodies) + bytes_of(node.region);
  for (const FrameContact& contact : frame.contacts)
    bytes += sizeof(FrameContact) + bytes_of(contact.points);
  for (const FrameSeries& series : frame.chart.series)
    bytes += sizeof(FrameSeries) + bytes_of(series.points);
  for (const Frame& side : frame.sides) bytes += estimated_bytes(side);
  return bytes;
}

}  // namespace

void StagedSink::frame(const Frame& frame) {
  const std::size_t bytes = estimated_bytes(frame);
  if (!waiting_.empty() && (waiting_.size() >= bound_.frames || bytes_ + bytes > bound_.bytes ||
                            !Staging::is_one_group(waiting_.back(), frame)))
    flush();
  waiting_.push_back(frame);
  bytes_ += bytes;
}

void StagedSink::finish(const DirectorReport& report) {
  flush();
  close(report);
}

void StagedSink::flush() {
  if (waiting_.empty()) return;
  const Staging staging{std::span<const Frame>(waiting_)};
  for (const Frame& frame : waiting_) {
    stop_if_asked();
    draw(frame, staging);
  }
  waiting_.clear();
  bytes_ = 0;
}

}  // namespace lantern::app
