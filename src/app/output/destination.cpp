#include "app/output/destination.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "app/terminal.hpp"
#include "base/file.hpp"
#include "base/number.hpp"
#include "base/suggest.hpp"

namespace lantern::app {

namespace {

namespace fs = std::filesystem;

struct Ending {
  std::string_view name;
  OutputKind kind;
};
constexpr std::array kEndings = {
    Ending{"png", OutputKind::picture},  Ending{"svg", OutputKind::picture},
    Ending{"pdf", OutputKind::document}, Ending{"html", OutputKind::page},
    Ending{"mp4", OutputKind::film},     Ending{"webm", OutputKind::film},
    Ending{"gif", OutputKind::film},     Ending{"apng", OutputKind::film},
    Ending{"webp", OutputKind::film},
};
constexpr std::array<std::string_view, 3> kPlaceholders = {"scenario", "step", "frame"};

// "mp4" of "talk.mp4"; empty where a folder is meant: no ending, or a folder that stands there.
std::string ending_of(const std::string& words) {
  std::error_code error;
  std::string ending = fs::path(words).extension().string();
  if (ending.size() < 2 || fs::is_directory(words, error)) return {};
  ending.erase(0, 1);
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return ending;
}

OutputKind kind_of(const std::string& words, const std::string& ending) {
  if (words == "-") return OutputKind::standard_output;
  if (ending.empty()) return OutputKind::folder;
  std::vector<std::string_view> names;
  for (const Ending& e : kEndings) {
    if (e.name == ending) return e.kind;
    names.push_back(e.name);
  }
  throw UsageError(with_suggestion(
      fmt::format("-o {}: there is no output '.{}', and a folder's name that has a dot ends with /",
                  words, ending),
      ending, names, names.size()));
}

// f(text) for what stands between placeholders, g(name) for each of them.
template <class F, class G>
void for_each_part(std::string_view words, const F& f, const G& g) {
  for (std::size_t at = 0; at < words.size();) {
    const std::size_t open = std::min(words.find('{', at), words.size());
    f(words.substr(at, open - at));
    if (open == words.size()) return;
    const std::size_t close = words.find('}', open);
    if (close == std::string_view::npos)
      throw UsageError(fmt::format("-o {}: a {{ without its }}", words));
    g(words.substr(open + 1, close - open - 1));
    at = close + 1;
  }
}

}  // namespace

Destination::Destination(const std::string& words, bool sheet)
    : words_(words), ending_(words == "-" ? "" : ending_of(words)), kind_(kind_of(words, ending_)) {
  for_each_part(
      words_, [](std::string_view) {},
      [&](std::string_view name) {
        if (std::find(kPlaceholders.begin(), kPlaceholders.end(), name) == kPlaceholders.end())
          throw UsageError(
              with_suggestion(fmt::format("-o {}: there is no placeholder {{{}}}", words_, name),
                              name, {kPlaceholders.begin(), kPlaceholders.end()}));
        if (kind_ == OutputKind::folder)
          throw UsageError(fmt::format(
              "-o {}: a placeholder stands in the name of a file, such as {{frame}}.png", words_));
      });
  if (!sheet) return;
  if (ending_ != "pdf" && ending_ != "png")
    throw UsageError("--sheet makes a .pdf or a .png: name one after -o, such as sheet.pdf");
  kind_ = OutputKind::sheet;
}

bool Destination::is_by(std::string_view placeholder) const {
  return words_.find(fmt::format("{{{}}}", placeholder)) != std::string::npos;
}

fs::path Destination::users_folder() const { return folder_of(words_.substr(0, words_.find('{'))); }

fs::path Destination::file(const NameParts& parts) const {
  std::string name;
  for_each_part(
      words_, [&](std::string_view text) { name += text; },
      [&](std::string_view part) {
        if (part == "scenario")
          name += parts.scenario;
        else
          name += fmt::format("{:04}", part == "step" ? parts.step : parts.frame);
      });
  return name;
}

std::pair<int, int> parse_size(const std::string& text, int most) {
  constexpr int kLeast = 16;
  const auto size = two_numbers_in<int>(text, 'x');
  if (!size || std::min(size->first, size->second) < kLeast ||
      std::max(size->first, size->second) > most)
    throw UsageError(
        fmt::format("--size {}: give width x height in pixels, {} to {} each, as 1280x720", text,
                    kLeast, most));
  return *size;
}

Selection::Selection(const std::string& frames, const std::string& at,
                     std::optional<std::uint64_t> most_frames)
    : frames_(frames), at_(at), time_(number_in<double>(at)) {
  if (time_ && !std::isfinite(*time_)) time_.reset();
  if (frames.empty()) return;
  const std::size_t dash = frames.find('-');
  const std::string_view from = std::string_view(frames).substr(0, dash);
  const std::string_view to =
      dash == std::string::npos ? from : std::string_view(frames).substr(dash + 1);
  const auto read = [&](std::string_view word) {
    const auto index = number_in<std::uint32_t>(word);
    if (!index)
      throw UsageError(
          fmt::format("--frames {}: give a frame or a range, as 7, 3-9, 3- or -9", frames));
    return *index;
  };
  if (!from.empty() || to.empty()) first_ = read(from);
  if (!to.empty()) last_ = read(to);
  if (last_ && first_ > *last_)
    throw UsageError(fmt::format("--frames {}: the range ends before it begins", frames));
  if (most_frames && std::max(first_, last_.value_or(0)) >= *most_frames)
    refuse_range(*most_frames);
}

void Selection::refuse_range(std::uint64_t count) const {
  throw UsageError(fmt::format(
      "--frames {}: give a frame or a range within 0-{}, as 7, 3-9, 3- or -9", frames_, count - 1));
}

bool Selection::takes(const Frame& frame) {
  ++asked_;
  end_ = frame.time;
  if (!at_.empty()) events_.insert(frame.event);
  if (frame.index < first_ || (last_ && frame.index > *last_)) return false;
  // World time is a sum of steps, so a time as written may miss it by a rounding error.
  if (time_ && (taken_ > 0 || frame.time < *time_ - 1e-9)) return false;
  if (!at_.empty() && !time_ && frame.event != at_) return false;
  ++taken_;
  return true;
}

void Selection::require_some() const {
  if (std::max(first_, last_.value_or(0)) >= asked_ && !frames_.empty()) refuse_range(asked_);
  if (taken_ > 0) return;
  if (!at_.empty() && !time_ && !events_.contains(at_)) {
    const std::vector<std::string_view> known(events_.begin(), events_.end());
    throw UsageError(
        with_suggestion(fmt::format("--at {}: no frame has this event", at_), at_, known, 40));
  }
  throw UsageError(
      fmt::format("--at {}: no frame is chosen; the last one is at {:.6g} s", at_, end_));
}

}  // namespace lantern::app
