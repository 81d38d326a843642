#include "app/staged_sink.hpp"

#include "base/stop.hpp"
#include "draw/axis_ranges.hpp"

namespace lantern::app {
void StagedSink::frame(const Frame& frame) {
  const std::size_t bytes = estimated_bytes(frame);
  if (!waiting_.empty() && (waiting_.size() >= bound_.frames || bytes_ + bytes > bound_.bytes))
    flush();
  waiting_.push_back(frame);
  ++undrawn_;
  bytes_ += bytes;
}

void StagedSink::finish(const DirectorReport& report) {
  flush();
  close(report);
}

void StagedSink::flush() {
  draw::AxisRanges axes;
  for (const Frame& frame : waiting_) axes.see(frame);
  std::size_t first = 0;
  for (std::size_t next = 1; next <= waiting_.size(); ++next) {
    if (next < waiting_.size() && Staging::is_one_group(waiting_[next - 1], waiting_[next]))
      continue;
    const std::span<const Frame> group = std::span(waiting_).subspan(first, next - first);
    const Staging staging(group, axes);
    for (const Frame& frame : group) {
      stop_if_asked();
      draw(frame, staging);
      --undrawn_;
    }
    first = next;
  }
  waiting_.clear();
  bytes_ = 0;
}

}  // namespace lantern::app
