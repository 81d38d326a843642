#include "language/text/problems.hpp"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/number.hpp"
#include "base/printable.hpp"
#include "base/suggest.hpp"
#include "language/scenario.hpp"

namespace lantern::language {
namespace {

constexpr std::string_view kMark = "\xef\xbb\xbf";  // U+FEFF, the byte order mark

// A letter that may stand in a scenario.
bool is_good(const Letter& letter) { return letter.code && *letter.code != 0; }

}  // namespace

std::optional<std::size_t> first_bad_byte(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const Letter letter = first_letter(text.substr(i));
    if (!is_good(letter)) return i;
    i += letter.bytes;
  }
  return std::nullopt;
}

Place place_of(std::string_view text, std::size_t offset) {
  const std::string_view before = text.substr(0, offset);
  const std::size_t line_break = before.rfind('\n');
  const std::size_t start = line_break == std::string_view::npos ? 0 : line_break + 1;
  return {1 + static_cast<int>(std::count(before.begin(), before.end(), '\n')),
          1 + static_cast<int>(letters(before.substr(start)))};
}

std::string line_of(std::string_view text, int line) {
  if (line < 1) return {};
  text = without_mark(text);
  for (int i = 1; i < line; ++i) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) return {};
    text.remove_prefix(end + 1);
  }
  text = text.substr(0, text.find('\n'));
  if (text.ends_with('\r')) text.remove_suffix(1);
  std::string clean;
  while (!text.empty()) {
    const Letter letter = first_letter(text);
    clean += is_good(letter) ? text.substr(0, letter.bytes) : "?";
    text.remove_prefix(letter.bytes);
  }
  return clean;
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kMostBytes = 60;
  std::size_t end = 0;
  while (end < text.size() && end + first_letter(text.substr(end)).bytes <= kMostBytes)
    end += first_letter(text.substr(end)).bytes;
  return "'" + printable(text.substr(0, end)) + (end < text.size() ? "…'" : "'");
}

std::string_view without_mark(std::string_view text) {
  if (text.starts_with(kMark)) text.remove_prefix(kMark.size());
  return text;
}

Diagnostic diagnose(const Scenario& scenario, const SourcePosition& where, std::string message,
                    std::string suggestion) {
  return {where, std::move(message), line_of(scenario.text, where.line), std::move(suggestion),
          Severity::error};
}

namespace {

constexpr std::size_t kMostShown = 50;
constexpr std::size_t kMostKept = 2000;  // a file of nothing but mistakes must not fill the memory

}  // namespace

void Problems::add(Place where, std::string message, Hint hint, bool once) {
  found_.push_back({where, std::move(message), std::move(hint), once});
  if (found_.size() > kMostKept) drop_the_latest();
}

void Problems::add(Place where, std::string message, std::string hint) {
  add(where, std::move(message), Hint([text = std::move(hint)] { return text; }));
}

void Problems::add(Place where, std::string message, const char* hint) {
  add(where, std::move(message), std::string(hint));
}

void Problems::add_unknown(Place where, std::string_view kind, const std::string& name,
                           Known known) {
  add(
      where, fmt::format("there is no {} {}", kind, in_quotes(name)),
      [name, known = std::move(known)] { return nearest(name, known()); }, true);
}

void Problems::add_readings(const std::vector<std::pair<std::string, const Problems*>>& readings) {
  using Key = std::pair<Place, std::string>;
  std::map<Key, std::set<const Problems*>> finders;
  for (const auto& [name, problems] : readings)
    for (const Found& f : problems->found_) finders[{f.where, f.message}].insert(problems);
  for (const Found& f : found_) finders.erase({f.where, f.message});
  for (const auto& [name, problems] : readings) {
    dropped_ += problems->dropped_;
    for (const Found& f : problems->found_) {
      const auto at = finders.find({f.where, f.message});
      if (at == finders.end()) continue;
      const bool by_all = at->second.size() == readings.size();
      if (by_all) finders.erase(at);
      add(f.where, by_all ? f.message : fmt::format("{}, on the side '{}'", f.message, name),
          f.hint, f.once);
    }
  }
}

// Keeps those that will be shown, and the one after them.
void Problems::drop_the_latest() {
  std::stable_sort(found_.begin(), found_.end(),
                   [](const Found& a, const Found& b) { return a.where < b.where; });
  dropped_ += found_.size() - (kMostShown + 1);
  found_.resize(kMostShown + 1);
}

void Problems::tell_unknown_once() {
  std::map<std::string, std::size_t> times;
  for (const Found& f : found_) times[f.message] += f.once;
  std::set<std::string> told;
  std::erase_if(found_, [&](const Found& f) { return f.once && !told.insert(f.message).second; });
  for (Found& f : found_)
    if (const std::size_t others = times[f.message]; f.once && others > 1)
      f.message += fmt::format(", here and {} more", counted(others - 1, "time"));
}

void Problems::raise(const std::string& file, std::string_view text) {
  if (found_.empty()) return;
  std::stable_sort(found_.begin(), found_.end(),
                   [](const Found& a, const Found& b) { return a.where < b.where; });
  // A mistake in a prototype is found again in each body that is like it.
  const auto repeats = std::ranges::unique(found_, [](const Found& a, const Found& b) {
    return a.where == b.where && a.message == b.message;
  });
  found_.erase(repeats.begin(), repeats.end());
  tell_unknown_once();
  std::vector<Diagnostic> diagnostics;
  for (const Found& f : found_) {
    const SourcePosition where{file, f.where.line, f.where.column};
    if (diagnostics.size() == kMostShown) {
      const std::size_t more = found_.size() - kMostShown + dropped_;
      diagnostics.push_back(
          {where, fmt::format("and {} more mistake{}", more, more == 1 ? "" : "s"), "", ""});
      break;
    }
    diagnostics.push_back({where, f.message, line_of(text, f.where.line), f.hint ? f.hint() : ""});
  }
  throw ScenarioError(std::move(diagnostics));
}

std::string nearest(std::string_view name, std::vector<std::string_view> candidates) {
  constexpr std::size_t kMostCompared = 1000;
  if (candidates.size() > kMostCompared) candidates.resize(kMostCompared);
  return suggestion(name, candidates, 40);
}

}  // namespace lantern::language
