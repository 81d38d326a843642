#include "report/claims.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "report/pareto.hpp"
#include "report/sentences.hpp"

namespace lantern::report {
namespace {

// The same run by two methods: did it end alike, with the same error?
bool agree(const Row& a, const Row& b) {
  constexpr double kRounding = 1e-9;
  if (a.status != b.status) return false;
  const auto p = a.error(), q = b.error();
  if (!p || !q) return !p && !q;
  return *p == *q || std::abs(*p - *q) <= kRounding * std::max(*p, *q);
}

bool are_equal(const MethodRows& a, const MethodRows& b) {
  std::size_t shared = 0;
  for (const Row& row : a.rows) {
    const auto same = std::ranges::find(b.rows, row.step, &Row::step);
    if (same == b.rows.end() || !row.was_run() || !same->was_run()) continue;
    if (!agree(row, *same)) return false;
    shared += row.error().has_value();
  }
  return shared >= 2;
}

}  // namespace

bool finest_run_made(const MethodRows& method, const ProblemRows& problem) {
  if (problem.rows.empty()) return false;
  const double finest = std::ranges::min(problem.rows, {}, &Row::step).step;
  return std::ranges::any_of(method.rows,
                             [&](const Row& row) { return row.step == finest && row.was_run(); });
}

std::vector<std::vector<std::string>> equal_methods(const ProblemRows& problem) {
  std::vector<std::vector<std::string>> groups;
  if (has_whole_errors(problem)) return groups;  // outcomes, which are right or wrong
  std::vector<MethodRows> left = by_method(problem);
  while (!left.empty()) {
    const MethodRows first = left.front();
    std::vector<std::string> group{first.method};
    std::erase_if(left, [&](const MethodRows& other) {
      if (other.method == first.method) return true;
      const bool equal = !first.is_peer && !other.is_peer && are_equal(first, other);
      if (equal) group.push_back(other.method);
      return equal;
    });
    if (group.size() > 1) groups.push_back(std::move(group));
  }
  return groups;
}

std::vector<PeerRange> peer_ranges(const ProblemRows& problem) {
  std::vector<PeerRange> ranges;
  double to = std::numeric_limits<double>::infinity();
  bool goes_on = false;  // the row before was a peer's
  for (const std::size_t i : pareto_front(problem.rows, seconds_of)) {  // ascending in time
    const Row& row = problem.rows[i];
    const double error = *row.error();
    if (row.is_peer()) {
      if (!goes_on) ranges.push_back({error, to, {}});
      PeerRange& range = ranges.back();
      range.from = error;
      std::erase(range.names, row.method);
      range.names.insert(range.names.begin(), row.method);
    }
    goes_on = row.is_peer();
    to = error;
  }
  std::ranges::reverse(ranges);
  return ranges;
}

std::string front_words(const ProblemRows& problem) {
  const auto is_timed = [&](bool peer) {
    return std::ranges::any_of(problem.rows, [&](const Row& row) {
      return row.is_peer() == peer && row.error() && seconds_of(row);
    });
  };
  if (!is_timed(true) || !is_timed(false) || has_whole_errors(problem)) return "";
  const std::vector<PeerRange> ranges = peer_ranges(problem);
  if (ranges.empty()) return "At every error the quickest run is one of Lantern's.";
  const auto stretch = [](double from, double to) {
    return figure(from) + (std::isfinite(to) ? " to " + figure(to) : " on");
  };
  constexpr std::size_t kMostStretches = 3;
  std::vector<std::string> words, names;
  for (const PeerRange& range : ranges) {
    words.push_back(fmt::format("{} ({})", stretch(range.from, range.to), listed(range.names)));
    for (const std::string& name : range.names)
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  }
  if (ranges.size() > kMostStretches)
    return fmt::format(
        "Peers' runs ({}) and Lantern's are the quickest by turns at errors from {}, a peer's in "
        "{} "
        "stretches.",
        listed(names), stretch(ranges.front().from, ranges.back().to), ranges.size());
  return fmt::format("A peer's run is the quickest at errors from {}.", listed(words));
}

std::vector<std::string> notes_on(const ProblemRows& problem) {
  std::vector<std::string> notes;
  if (std::string front = front_words(problem); !front.empty()) notes.push_back(std::move(front));
  double reference_error = 0;
  const Norm* norm = nullptr;
  bool adaptive = false;
  for (const Row& row : problem.rows) {
    reference_error = std::max(reference_error, row.reference_error);
    if (!norm && !row.norms.empty()) norm = &row.norms.front();
    adaptive = adaptive || is_adaptive(row.method);
  }
  if (norm && !norm->meaning.empty())
    notes.push_back(fmt::format("“{}”{}: {}.", norm->name,
                                norm->unit == "1" ? "" : " (" + norm->unit + ")", norm->meaning));
  if (reference_error > 0)
    notes.push_back(
        fmt::format("The reference is itself off by about {}, its distance from the same run at "
                    "twice its step; no smaller error is claimed.",
                    figure(reference_error)));
  if (adaptive)
    notes.push_back(
        "Dormand–Prince solves the bare equations of motion, without the world's step: its seconds "
        "buy less than those of the others.");
  return notes;
}

bool is_plural(const std::string& name) {
  return name.starts_with("impulses") || name.starts_with("soft contacts");
}

std::string shortfall_words(std::span<const Shortfall> all) {
  std::string text;
  using enum Shortfall::Kind;
  for (const Shortfall::Kind kind : {at_finest_step, within_runs_made, not_run}) {
    std::vector<std::string> names;
    for (const Shortfall& one : all)
      if (one.kind() == kind) names.push_back(one.name());
    if (names.empty()) continue;
    const bool many = names.size() > 1 || is_plural(names[0]);
    const std::string who =
        names.size() > 3 ? fmt::format("{} of Lantern's methods", names.size()) : listed(names);
    if (kind == not_run)
      text += fmt::format("; {} {} not run", who, many ? "were" : "was");
    else
      text +=
          fmt::format("; {} {} not get there {}", who, many ? "do" : "does",
                      kind == at_finest_step ? "even at the finest step" : "within the runs made");
  }
  return text;
}

std::string within_runs_made(std::span<const Shortfall> all) {
  return std::ranges::all_of(
             all,
             [](const Shortfall& one) { return one.kind() == Shortfall::Kind::at_finest_step; })
             ? ""
             : " within the runs made";
}

}  // namespace lantern::report
