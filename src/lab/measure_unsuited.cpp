#include "lab/measure_unsuited.hpp"

#include <algorithm>
#include <memory>

#include <fmt/format.h>

#include "measure/peers.hpp"
#include "report/document.hpp"

namespace lantern::lab {
namespace {

using Names = std::vector<std::string>;

// Those who do not run some problems, for one and the same reason.
struct Group {
  Names problems, solvers;
  std::string reason;
};

// First solvers with one reason for a problem, then problems with the same solvers and reason.
std::vector<Group> grouped(std::span<const Unsuited> unsuited) {
  std::vector<Group> of_one, all;
  for (const Unsuited& one : unsuited) {
    const auto same = std::ranges::find_if(of_one, [&](const Group& group) {
      return group.problems[0] == one.problem && group.reason == one.reason;
    });
    if (same == of_one.end())
      of_one.push_back({{one.problem}, {one.solver}, one.reason});
    else
      same->solvers.push_back(one.solver);
  }
  for (Group& one : of_one) {
    const auto same = std::ranges::find_if(all, [&](const Group& group) {
      return group.solvers == one.solvers && group.reason == one.reason;
    });
    if (same == all.end())
      all.push_back(std::move(one));
    else
      same->problems.push_back(one.problems[0]);
  }
  return all;
}

std::string words_of(const Group& group) {
  return fmt::format("{} {} not run by {}: {}", listed(group.problems),
                     group.problems.size() > 1 ? "are" : "is", listed(group.solvers), group.reason);
}

// What a name is before its colon, in small letters: "bullet" of "Bullet:10".
std::string engine_of(const std::string& name) {
  std::string engine = name.substr(0, name.find(':'));
  for (char& c : engine)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return engine;
}

}  // namespace

std::vector<std::string> unsuited_words(std::span<const Unsuited> unsuited, bool with_peers) {
  std::vector<Unsuited> told(unsuited.begin(), unsuited.end());
  if (!with_peers) std::erase_if(told, [](const Unsuited& one) { return one.is_peer; });
  Names lines;
  for (const Group& group : grouped(told)) lines.push_back(words_of(group));
  return lines;
}

std::optional<std::string> about_peer(const std::string& name,
                                      const std::vector<Scenario>& scenarios) {
  Names missing;
  std::vector<std::unique_ptr<Solver>> same = load_peers(missing);
  std::erase_if(same, [&](const auto& peer) { return engine_of(peer->name()) != engine_of(name); });
  for (const std::string& line : missing)
    if (engine_of(line) == engine_of(name))
      return fmt::format("'{}' is no method but another engine. {}", name, line);
  if (same.empty()) return std::nullopt;
  std::vector<Unsuited> unsuited;
  for (const Scenario& scenario : scenarios)
    for (const auto& peer : same)
      if (const auto reason = why_not(*peer, scenario))
        unsuited.push_back({scenario.name, peer->name(), *reason, true});
  std::string text = fmt::format(
      "'{}' is no method but another engine: it is run beside the methods where it can", name);
  for (const Group& group : grouped(unsuited)) text += "; " + words_of(group);
  return text;
}

}  // namespace lantern::lab
