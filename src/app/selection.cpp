#include "app/selection.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <set>
#include <string_view>
#include <tuple>

#include <fmt/format.h>

#include "app/terminal.hpp"
#include "base/suggest.hpp"

namespace lantern {
namespace {

template <class T>
std::optional<T> number(std::string_view text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

// First and last frame of "A", "A-B", "A-" or "-B".
std::pair<std::uint32_t, std::uint32_t> frame_range(const std::string& text, std::uint32_t count) {
  const auto bad = [&]() -> UsageError {
    return UsageError(fmt::format(
        "--frames {}: give a frame or a range within 0-{}, as 7, 3-9, 3- or -9", text, count - 1));
  };
  const std::size_t dash = text.find('-');
  const std::string_view all = text;
  const std::string_view from = all.substr(0, dash);
  const std::string_view to = dash == std::string::npos ? from : all.substr(dash + 1);
  if (from.empty() && to.empty()) throw bad();
  const auto first = from.empty() ? std::optional<std::uint32_t>(0) : number<std::uint32_t>(from);
  const auto last = to.empty() ? std::optional(count - 1) : number<std::uint32_t>(to);
  if (!first || !last || *first > *last || *last >= count) throw bad();
  return {*first, *last};
}

bool any_of_event(const std::vector<PlannedFrame>& plan, const std::string& event) {
  return std::any_of(plan.begin(), plan.end(), [&](const auto& f) { return f.event == event; });
}

[[noreturn]] void no_such_event(const std::vector<PlannedFrame>& plan, const std::string& event) {
  std::set<std::string_view> names;
  for (const PlannedFrame& frame : plan) names.insert(frame.event);
  const std::vector<std::string_view> known(names.begin(), names.end());
  throw UsageError(
      fmt::format("--at {}: no frame has this event; {}", event, suggestion(event, known, 40)));
}

}  // namespace

std::pair<int, int> parse_size(const std::string& text, int most) {
  constexpr int kLeast = 16;
  const std::size_t x = text.find('x');
  const std::string_view all = text;
  const auto width = number<int>(all.substr(0, x));
  const auto height = x == std::string::npos ? std::nullopt : number<int>(all.substr(x + 1));
  if (!width || !height || std::min(*width, *height) < kLeast || std::max(*width, *height) > most)
    throw UsageError(
        fmt::format("--size {}: give width x height in pixels, {} to {} each, as "
                    "1280x720",
                    text, kLeast, most));
  return {*width, *height};
}

std::vector<std::uint32_t> select_frames(const std::vector<PlannedFrame>& plan,
                                         const std::string& frames, const std::string& at) {
  const auto count = static_cast<std::uint32_t>(plan.size());
  std::uint32_t first = 0;
  std::uint32_t last = count - 1;
  if (!frames.empty()) std::tie(first, last) = frame_range(frames, count);
  std::optional<double> time = number<double>(at);
  if (time && !std::isfinite(*time)) time.reset();
  if (!at.empty() && !time && !any_of_event(plan, at)) no_such_event(plan, at);
  std::vector<std::uint32_t> selected;
  for (std::uint32_t i = first; i <= last; ++i) {
    if (time) {
      // World time is a sum of steps, so a time as written may miss it by a rounding error.
      if (plan[i].time < *time - 1e-9) continue;
      return {i};
    }
    if (at.empty() || plan[i].event == at) selected.push_back(i);
  }
  if (selected.empty())
    throw UsageError(fmt::format("--at {}: no frame is chosen; the last one is at {:.6g} s", at,
                                 plan.back().time));
  return selected;
}

}  // namespace lantern
