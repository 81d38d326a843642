#include "app/trial.hpp"

#include <algorithm>
#include <new>
#include <utility>

#include <fmt/format.h>

#include "app/terminal.hpp"

namespace lantern::app {

constexpr double kTriedError = 0.01;

std::string SettingTrial::text() const {
  if (quick.seconds >= 2.0 / 3 * as_is.seconds) return "";
  const std::uint64_t missed = quick.work.errors_missed;
  return fmt::format(
      "with wanted_error = {0} in [world] {1} step{2} from here took {3:.2g} s instead of "
      "{4:.2g} s; bodies then lie up to {0} deep in each other, or as deep as before ({5:.2g} here "
      "instead of {6:.2g}){7}",
      kTriedError, steps, steps == 1 ? "" : "s", quick.seconds, as_is.seconds, quick.deepest,
      as_is.deepest,
      missed > 0 ? fmt::format("; {} pair{} lay deeper", missed, missed == 1 ? "" : "s") : "");
}

// By a clock of the thread alone: others may be drawing meanwhile.
template <int D>
SettingTrial try_out(const World<D>& world, double h, double most_seconds) {
  WorldConfig<D> config = world.config();
  World<D> as_is(world, config);
  config.wanted_error = kTriedError;
  World<D> quick(world, config);
  SettingTrial trial;
  const auto step = [&](World<D>& tried, Tried& result) {
    const CpuStopwatch watch(CLOCK_THREAD_CPUTIME_ID);
    tried.step(h);
    result.seconds += watch.seconds();
    result.work = tried.work();
    result.deepest = 0;
    for (const Contact<D>& contact : tried.contacts())
      for (const ManifoldPoint<D>& point : contact.manifold.points())
        result.deepest = std::max(result.deepest, -point.separation);
  };
  const Stopwatch watch;
  for (; trial.steps == 0 || (trial.steps < 10 && watch.seconds() < most_seconds); ++trial.steps) {
    step(quick, trial.quick);
    step(as_is, trial.as_is);
  }
  return trial;
}

// A structure that the program was given is not ours to make another of.
template <int D>
void Trials::see(const Players<D>& players) {
  const double last = std::exchange(since_last_, {}).seconds(), most = 0.05 * left_();
  const WorldConfig<D>& config = players.world().config();
  const std::uint64_t steps = players.world().work().steps;
  if (done_ || steps < next_trial_ || 2 * last > most || config.contacts != ContactMethod::soft ||
      config.wanted_error || traits_of(config.broad_phase.kind).is_own)
    return;
  done_ = true;  // unless nothing is to be said
  work_.trial_worlds += 2;
  const Scenario& scenario = players.scenario();
  try {
    const SettingTrial trial =
        try_out(players.world(), scenario.world.time_step, std::min(1.0, most));
    next_trial_ = steps + 40 * static_cast<std::uint64_t>(trial.steps);
    const std::string text = trial.text();
    done_ = !text.empty();
    if (done_)
      say(fmt::format("{}{}{}: {}", scenario.name, scenario.side.empty() ? "" : ", ", scenario.side,
                      text));
  } catch (const Refused&) {  // the run will say so itself, if it comes as far
  } catch (const std::bad_alloc&) {
  }
}

template SettingTrial try_out(const World<2>&, double, double);
template SettingTrial try_out(const World<3>&, double, double);
template void Trials::see(const Players<2>&);
template void Trials::see(const Players<3>&);

}  // namespace lantern::app
