#include "app/staged_sink.hpp"

#include "base/stop.hpp"
#include "draw/axis_ranges.hpp"

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
  if (!waiting_.empty() && (waiting_.size() >= bound_.frames || bytes_ + bytes > bound_.bytes))
    flush();
  waiting_.push_back(frame);
  bytes_ += bytes;
}

void StagedSink::finish(const DirectorReport& report) {
  flush();
  close(report);
}

void StagedSink::flush() {
  draw::AxisRanges axes;
  for (const Frame& frame : waiting_) axes.see(frame);
  for (Frame& frame : waiting_) axes.settle(frame);
  std::size_t first = 0;
  for (std::size_t next = 1; next <= waiting_.size(); ++next) {
    if (next < waiting_.size() && Staging::is_one_group(waiting_[next - 1], waiting_[next]))
      continue;
    const std::span<const Frame> group = std::span(waiting_).subspan(first, next - first);
    const Staging staging{group};
    for (const Frame& frame : group) {
      stop_if_asked();
      draw(frame, staging);
    }
    first = next;
  }
  waiting_.clear();
  bytes_ = 0;
}

}  // namespace lantern::app
