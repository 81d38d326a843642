#include "app/measure_unsuited.hpp"

#include <algorithm>
#include <memory>

#include <fmt/format.h>

#include "measure/dormand_prince_solver.hpp"
#include "measure/lantern_solver.hpp"
#include "measure/peers.hpp"
#include "report/sentences.hpp"
#include "scenario/method.hpp"

namespace lantern {
namespace {

using Solvers = std::vector<std::unique_ptr<Solver>>;
using Names = std::vector<std::string>;

// Those who cannot do some scenarios, for one and the same reason.
struct LeftOut {
  Names who, scenarios;
  std::string reason;
};

std::unique_ptr<Solver> solver_named(const std::string& name) {
  if (const auto method = method_named(name)) return std::make_unique<LanternSolver>(*method);
  return std::make_unique<DormandPrinceSolver>();
}

// Engines are run beside problems only: without a known answer there is nothing to hold them to.
std::optional<std::string> reason_of(const Solver& solver, const Scenario& scenario) {
  if (solver.is_peer() && !scenario.problem) return "it has no [problem]";
  return solver.cannot(scenario);
}

std::vector<LeftOut> left_out_of(const Scenario& scenario, const Solvers& solvers) {
  std::vector<LeftOut> all;
  for (const auto& solver : solvers) {
    const auto reason = reason_of(*solver, scenario);
    if (!reason) continue;
    const auto known = std::ranges::find(all, *reason, &LeftOut::reason);
    if (known == all.end())
      all.push_back({{solver->name()}, {scenario.name}, *reason});
    else
      known->who.push_back(solver->name());
  }
  return all;
}

// What a name is before its colon, in small letters: "bullet" of "Bullet:10".
std::string engine_of(const std::string& name) {
  std::string engine = name.substr(0, name.find(':'));
  for (char& c : engine)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return engine;
}

}  // namespace

std::vector<std::string> unsuited(const std::vector<Scenario>& scenarios,
                                  const std::vector<std::string>& methods, bool with_peers) {
  Solvers solvers;
  for (const std::string& name : methods) solvers.push_back(solver_named(name));
  Names missing;
  if (with_peers)
    for (auto& peer : peers(missing)) solvers.push_back(std::move(peer));
  std::vector<LeftOut> all;
  for (const Scenario& scenario : scenarios)
    for (LeftOut& one : left_out_of(scenario, solvers)) {
      const auto known = std::ranges::find_if(
          all, [&](const LeftOut& l) { return l.who == one.who && l.reason == one.reason; });
      if (known == all.end())
        all.push_back(std::move(one));
      else
        known->scenarios.push_back(scenario.name);
    }
  std::vector<std::string> lines;
  for (const LeftOut& one : all)
    lines.push_back(fmt::format("{} {} not run by {}: {}", listed(one.scenarios),
                                one.scenarios.size() > 1 ? "are" : "is", listed(one.who),
                                one.reason));
  return lines;
}

std::optional<std::string> about_peer(const std::string& name,
                                      const std::vector<Scenario>& scenarios) {
  Names missing;
  Solvers same = peers(missing);
  std::erase_if(same, [&](const auto& peer) { return engine_of(peer->name()) != engine_of(name); });
  for (const std::string& line : missing)
    if (engine_of(line) == engine_of(name))
      return fmt::format("'{}' is no method but another engine. {}", name, line);
  if (same.empty()) return std::nullopt;
  std::string text = fmt::format(
      "'{}' is no method but another engine: it is run beside the methods where it can", name);
  for (const Scenario& scenario : scenarios)
    for (const LeftOut& one : left_out_of(scenario, same))
      text += fmt::format("; {} is not run by {}: {}", scenario.name, listed(one.who), one.reason);
  return text;
}

}  // namespace lantern
