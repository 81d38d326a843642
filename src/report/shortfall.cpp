#include "report/shortfall.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "report/sentences.hpp"

namespace lantern {

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

}  // namespace lantern
