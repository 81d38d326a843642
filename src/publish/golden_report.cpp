#include "publish/golden_report.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace lantern::publish {

std::size_t GoldenSuite::differing() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(cases, [](const GoldenCase& c) { return !c.findings.empty(); }));
}

bool GoldenSuite::good() const {
  return error.empty() && findings.empty() && unmet_count == 0 && first() == nullptr;
}

const GoldenCase* GoldenSuite::first() const {
  const auto it = std::ranges::find_if(cases, [](const auto& c) { return !c.findings.empty(); });
  return it == cases.end() ? nullptr : &*it;
}

std::string name_of(const GoldenCase& one) {
  return one.event.empty() ? fmt::format("frame {}", one.frame)
                           : fmt::format("frame {} ({})", one.frame, one.event);
}

std::string counted_frames(std::size_t count) {
  return fmt::format("{} {}", count, count == 1 ? "frame" : "frames");
}

std::string differing_of(std::size_t differing, std::size_t frames) {
  return fmt::format("{} of {} {}", differing, counted_frames(frames),
                     differing == 1 ? "differs" : "differ");
}

}  // namespace lantern::publish
