#include "scenario/problems.hpp"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/suggest.hpp"

namespace lantern::scenario {
namespace {

constexpr std::size_t kMostShown = 50;
constexpr std::size_t kMostKept = 2000;  // a file of nothing but mistakes must not fill the memory

}  // namespace

void Problems::add(Place where, std::string message, Hint hint) {
  found_.push_back({where, std::move(message), std::move(hint)});
  if (found_.size() > kMostKept) drop_the_latest();
}

void Problems::add(Place where, std::string message, std::string hint) {
  add(where, std::move(message), Hint([text = std::move(hint)] { return text; }));
}

void Problems::add(Place where, std::string message, const char* hint) {
  add(where, std::move(message), std::string(hint));
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
          f.hint);
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

void Problems::raise(const std::string& file, std::string_view text) {
  if (found_.empty()) return;
  std::stable_sort(found_.begin(), found_.end(),
                   [](const Found& a, const Found& b) { return a.where < b.where; });
  // A mistake in a prototype is found again in each body that is like it.
  const auto repeats = std::ranges::unique(found_, [](const Found& a, const Found& b) {
    return a.where == b.where && a.message == b.message;
  });
  found_.erase(repeats.begin(), repeats.end());
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

}  // namespace lantern::scenario
