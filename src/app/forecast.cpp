#include "app/forecast.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "base/grouped.hpp"
#include "base/memory.hpp"

namespace lantern::app {
namespace {

std::string grouped_plainly(std::uint64_t number) {
  return grouped(static_cast<std::int64_t>(number), " ");
}

std::string counted_plainly(std::uint64_t number, std::string_view noun) {
  return fmt::format("{} {}{}", grouped_plainly(number), noun, number == 1 ? "" : "s");
}

std::string left_text(const std::optional<TimeLeft>& left) {
  if (!left) return "";
  return fmt::format(", {} {} left", left->at_least ? "more than" : "about",
                     duration_text(left->seconds));
}

}  // namespace

RunExtent extent_of(const Scenario& scenario, Pace pace) {
  const bool by_event =
      pace == Pace::event || std::any_of(scenario.steps.begin(), scenario.steps.end(),
                                         [](const Step& s) { return s.pace == Pace::event; });
  return {by_event ? std::nullopt : std::optional(scenario.most_frames), scenario.world_steps};
}

namespace {

double share_left(std::uint64_t all, std::uint64_t done, double seconds) {
  return static_cast<double>(all - std::min(all, done)) * seconds / static_cast<double>(done);
}

// Of the run. World steps take the time where there are any.
std::optional<TimeLeft> run_left(const RunExtent& extent, const RunState& state) {
  if (extent.world_steps > 0) {
    if (state.world_steps > 0)
      return TimeLeft{share_left(extent.world_steps, state.world_steps, state.step_seconds), false};
    // Something is being inserted or compiled; only after a frame can it be a world step.
    if (state.frames == 0) return std::nullopt;
    const double least = state.step_seconds * static_cast<double>(extent.world_steps);
    return least < 1 ? std::nullopt : std::optional(TimeLeft{least, true});
  }
  if (!extent.frames || state.frames == 0) return std::nullopt;
  return TimeLeft{share_left(*extent.frames, state.frames, state.seconds), false};
}

}  // namespace

// Frames that wait are drawn after the run, or a part of it: how long that takes, only those show
// that are drawn.
std::optional<TimeLeft> time_left(const RunExtent& extent, const RunState& state) {
  std::optional<TimeLeft> left = run_left(extent, state);
  if (state.waiting == 0) return left;
  const std::uint64_t drawn = state.frames - state.waiting;
  if (drawn > 0 && extent.frames) {
    const double drawing = share_left(*extent.frames, drawn, state.draw_seconds);
    return TimeLeft{std::max(drawing, left ? left->seconds : 0), left && left->at_least};
  }
  if (left) left->at_least = true;
  return left && left->seconds >= 1 ? left : std::nullopt;
}

std::string forecast_text(const RunExtent& extent, const RunState& state) {
  std::string text = extent.frames ? "up to " + counted_plainly(*extent.frames, "frame")
                                   : "as many frames as there are events, not known beforehand";
  if (extent.world_steps > 0)
    text += fmt::format("{} {}", extent.frames ? " of" : "; up to",
                        counted_plainly(extent.world_steps, "world step"));
  const std::uint64_t written = extent.chosen.value_or(extent.frames.value_or(1));
  const std::uint64_t between =
      (written - std::min<std::uint64_t>(written, 1)) * extent.in_betweens;
  if (between > 0)
    text += " and " + counted_plainly(between, "in-between");
  else if (extent.in_betweens > 0)
    text += fmt::format(" and {} before each but the first",
                        counted_plainly(extent.in_betweens, "in-between"));
  const auto left = time_left(extent, state);
  text += left ? left_text(left) : ", how long cannot be told yet";
  if (state.files > 0 && extent.frames)
    text += fmt::format("; about {} on the disk",
                        memory_text(static_cast<std::uint64_t>(
                            static_cast<double>(state.bytes) / static_cast<double>(state.files) *
                            static_cast<double>(written + between))));
  if (state.memory) text += fmt::format("; {} of memory", memory_text(*state.memory));
  if (state.memory && state.budget) text += fmt::format(" (budget {})", memory_text(*state.budget));
  return text;
}

std::string progress_text(const RunExtent& extent, const RunState& state) {
  const std::uint64_t frames = state.frames - state.waiting;
  std::string text = extent.frames
                         ? fmt::format("{} of {}", frames, counted_plainly(*extent.frames, "frame"))
                         : counted_plainly(frames, "frame");
  if (extent.in_betweens > 0) text += ", " + counted_plainly(state.in_betweens, "in-between");
  if (extent.world_steps > 0)
    text += fmt::format(", {} of {}", grouped_plainly(state.world_steps),
                        counted_plainly(extent.world_steps, "world step"));
  if (state.files > 0) text += fmt::format(", {} on the disk", memory_text(state.bytes));
  if (extent.frames && frames >= *extent.frames && state.drawn > 0)
    return text + ", " + counted_plainly(state.drawn, "picture") + " drawn";
  return text + left_text(time_left(extent, state));
}

std::string duration_text(double seconds) {
  if (seconds < 100) return fmt::format("{:.0f} s", std::max(1.0, seconds));
  if (seconds < 6000) return fmt::format("{:.0f} min", seconds / 60);
  if (seconds < 100 * 3600) return fmt::format("{:.0f} h", seconds / 3600);
  return fmt::format("{:.0f} days", seconds / 86400);
}

}  // namespace lantern::app
