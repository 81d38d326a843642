#include "measure/schedule.hpp"

#include "run/waiting.hpp"

namespace lantern::measure {
namespace {

constexpr std::uint32_t kMostLooks = 20;  // at one step of a script

// As many parts as can be, of equally many world steps.
std::uint32_t parts_of(std::uint64_t steps) {
  std::uint32_t parts = static_cast<std::uint32_t>(std::min<std::uint64_t>(kMostLooks, steps));
  while (parts > 1 && steps % parts != 0) --parts;
  return parts;
}

Schedule script_of(const Scenario& scenario) {
  const double h = scenario.world.time_step;
  const bool waits = std::ranges::any_of(
      scenario.steps, [](const Step& s) { return std::holds_alternative<Wait>(s.verb); });
  // The file's own run, for as far as it is needed to learn how long a step waits.
  Work work;
  const std::unique_ptr<Engine> own = waits ? make_engine(scenario, work) : nullptr;
  const auto steps_in = [h](double seconds) {
    return static_cast<std::uint64_t>(std::llround(seconds / h));
  };
  const auto waited = [&](const Wait& wait) {
    run::Waiting waiting(wait, scenario, *own);
    for (std::uint64_t i = 1; i <= steps_in(wait.at_most); ++i) {
      own->step();
      if (waiting.is_over()) return i;
    }
    throw Refused("{}", waiting.in_vain());
  };
  Schedule schedule;
  Leg leg;
  const auto pass = [&](std::uint64_t steps) {
    if (steps == 0) return;
    leg.seconds = static_cast<double>(steps) * h;
    leg.looks = parts_of(steps);
    schedule.seconds += leg.seconds;
    schedule.legs.push_back(std::move(leg));
    leg = {};
  };
  for (const Step& step : scenario.steps) try {
      const auto* wait = std::get_if<Wait>(&step.verb);
      if (own && !wait) carry_out(step.verb, *own, h);
      if (const auto* run = std::get_if<Run>(&step.verb))
        pass(steps_in(run->seconds));
      else if (wait)
        pass(waited(*wait));
      else if (std::holds_alternative<Phases>(step.verb))
        pass(1);
      else
        leg.before.push_back(step.verb);
    } catch (const Refused& refused) {
      throw ScenarioError(diagnose(scenario, step.where, refused.what()));
    }
  return schedule;
}

// A problem's bodies are all there at first, and so are the forces that its script begins with.
Schedule problem_of(const Scenario& scenario) {
  const ProblemSpec& problem = *scenario.problem;
  Schedule schedule{{{{}, problem.seconds, problem.samples}}, problem.seconds};
  for (const Step& step : scenario.steps) {
    if (traits_of(step.verb).passes_time) break;
    if (std::holds_alternative<ApplyForce>(step.verb))
      schedule.legs.front().before.push_back(step.verb);
  }
  return schedule;
}

double part_of(const Leg& leg) { return leg.seconds / leg.looks; }

}  // namespace

Schedule Schedule::of(const Scenario& scenario) {
  if (scenario.bodies.empty()) throw Refused("it has no bodies: there is nothing to measure");
  Schedule schedule = scenario.problem ? problem_of(scenario) : script_of(scenario);
  if (schedule.legs.empty())
    throw Refused(
        "no time passes in it: there is nothing to measure; a step with do = \"run\" would");
  return schedule;
}

double Schedule::fitted_step(double wished) const {
  if (!std::isfinite(wished) || wished <= 0)
    throw Refused("a time step of {} s is not allowed; it must be above 0", wished);
  if (seconds + wished == seconds || seconds / wished > 0x1p53)
    throw Refused("a time step of {} s is too small to move a clock that shows {} s", wished,
                  seconds);
  if (legs.size() == 1) {
    const double part = part_of(legs[0]);
    return part / std::max(1.0, std::round(part / wished));
  }
  for (const Leg& leg : legs) {
    const double parts = part_of(leg) / wished;
    if (parts < 0.5 || std::abs(parts - std::round(parts)) > 1e-6 * parts)
      throw Refused("a time step of {} s does not divide the {} s between two looks at the run",
                    wished, part_of(leg));
  }
  return wished;
}

std::uint64_t Schedule::steps_in_part(const Leg& leg, double h) const {
  return static_cast<std::uint64_t>(std::llround(part_of(leg) / h));
}

std::uint64_t Schedule::steps(double h) const {
  return sum_of<std::uint64_t>(legs,
                               [&](const Leg& leg) { return leg.looks * steps_in_part(leg, h); });
}

}  // namespace lantern::measure
