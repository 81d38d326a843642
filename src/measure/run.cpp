#include "measure/run.hpp"

#include "base/memory.hpp"
#include "geometry/not_finite.hpp"
#include "measure/solvers.hpp"

namespace lantern::measure {
namespace {

constexpr double kBeyondSense = 100;  // times the scale: the run has diverged

// Other engines do not hear the wish to stop, so they are asked for few steps at a time.
constexpr std::uint64_t kStepsOfPeers = 64;
constexpr std::uint64_t kAllSteps = std::numeric_limits<std::uint64_t>::max();

bool all_finite(const BodyState& s) {
  const glm::dquat& q = s.orientation.q;
  return is_finite<3>(s.position) && is_finite<3>(s.velocity) && is_finite<3>(s.angular_momentum) &&
         std::isfinite(q.w) && is_finite<3>({q.x, q.y, q.z});
}

// --- a scenario without a known answer is held against a record of its own finer run ---

// Keeps every moment.
class Recorder : public ErrorMetric {
 public:
  void look(const Observation& now) override { record_->push_back(now); }
  std::shared_ptr<const std::vector<Observation>> record() const { return record_; }

 private:
  std::shared_ptr<std::vector<Observation>> record_ = std::make_shared<std::vector<Observation>>();
};

// The distance from a record: of places over the way that the body that moves most has gone from
// where it began, of velocities over the largest speed.
class OwnRun : public ErrorMetric {
 public:
  explicit OwnRun(std::shared_ptr<const std::vector<Observation>> record)
      : record_(std::move(record)) {
    const std::size_t bodies = record_->empty() ? 0 : record_->front().states.size();
    for (std::size_t i = 0; i < bodies; ++i) {
      const BodyState* first = nullptr;
      for (const Observation& moment : *record_) {
        const BodyState& state = moment.states[i];
        if (!state.there) continue;
        if (!first) first = &state;
        way_ = std::max(way_, glm::length(state.position - first->position));
        speed_ = std::max(speed_, glm::length(state.velocity));
      }
    }
    worst_ = &norm("traj", "1", trajectory_meaning(way_, speed_));
  }

  void look(const Observation& now) override {
    LANTERN_CHECK(next_, <, record_->size());
    const Observation& then = (*record_)[next_++];
    const auto against = [](double error, double scale) {
      if (error == 0) return 0.0;
      return scale > 0 ? error / scale : std::numeric_limits<double>::infinity();
    };
    for (std::size_t i = 0; i < now.states.size(); ++i) {
      const BodyState &a = now.states[i], &b = then.states[i];
      if (!a.there || !b.there) continue;
      worst_->meet(against(glm::length(a.position - b.position), way_));
      worst_->meet(against(glm::length(a.velocity - b.velocity), speed_));
    }
  }

 private:
  std::shared_ptr<const std::vector<Observation>> record_;
  double way_ = 0, speed_ = 0;
  std::size_t next_ = 0;
  Worst* worst_ = nullptr;
};

// Writes down how error and energy have gone, about a dozen times, further and further apart.
class Sampler : public ErrorMetric {
 public:
  Sampler(ErrorMetric& metric, const DriftMeter& meter, const Schedule& schedule)
      : metric_(metric), meter_(meter) {
    for (const Leg& leg : schedule.legs) looks_ += leg.looks;
    growth_ = std::max(1.0, std::pow(looks_, 1.0 / kSamples));
  }

  void look(const Observation& now) override {
    metric_.look(now);
    const double seen = seen_++;
    if (seen < next_ && seen < looks_) return;
    if (seen > 0)
      samples_.push_back({now.time, metric_.norms().front().value, meter_.energy_change()});
    next_ = std::max(seen + 1, std::floor(seen * growth_));
  }
  void interfere(const Observation& now, Simulation& simulation) override {
    metric_.interfere(now, simulation);
  }
  // All over the scale of the whole run: what has changed so far does not shrink.
  std::vector<DriftSample> samples() const {
    std::vector<DriftSample> all = samples_;
    const double scale = meter_.energy_scale();
    const bool keeps_energy = meter_.drift().energy.has_value();
    for (DriftSample& sample : all) {
      if (!keeps_energy) sample.energy.reset();
      if (sample.energy) *sample.energy = scale > 0 ? *sample.energy / scale : 0;
    }
    return all;
  }

 private:
  static constexpr double kSamples = 12;

  ErrorMetric& metric_;
  const DriftMeter& meter_;
  double looks_ = 0, seen_ = 0, next_ = 1, growth_ = 1;
  std::vector<DriftSample> samples_;  // their energies in J
};

// --- the runs ---

struct NotANumber {};

// What the two clocks of a run tell of nothing, the least of many: some tenths of a microsecond, at
// each look of which a short run has many.
double seconds_of_looking() {
  static const double least = [] {
    double seconds = 1;
    for (int i = 0; i < 1000; ++i) {
      const CpuStopwatch processor;
      const Stopwatch clock;
      static_cast<void>(clock.seconds());
      seconds = std::min(seconds, processor.seconds());
    }
    return seconds;
  }();
  return least;
}

// One run. `look` sees each moment; only the steps between are timed.
class Runner {
 public:
  Runner(const Scenario& scenario, const Schedule& schedule, const Solver& solver, double h)
      : schedule_(schedule),
        h_(h),
        at_once_(solver.version().empty() ? kAllSteps : kStepsOfPeers),
        simulation_(solver.start(scenario, h)) {
    for (std::size_t i = 0; i < scenario.bodies.size(); ++i) {
      now_.skins.push_back(simulation_->skin(i));
      widest_skin_ = std::max(widest_skin_, now_.skins.back());
    }
    if (widest_skin_ == 0) now_.skins.clear();
  }

  void run(ErrorMetric& metric, auto&& look) {
    bool begun = false;
    const double looking = seconds_of_looking();
    for (const Leg& leg : schedule_.legs) {
      for (const Verb& verb : leg.before) simulation_->act(verb);
      if (!begun) observe(metric, look);
      begun = true;
      const std::uint64_t steps = schedule_.steps_in_part(leg, h_);
      for (std::uint32_t i = 0; i < leg.looks; ++i) {
        const CpuStopwatch processor;
        const Stopwatch clock;
        for (std::uint64_t left = steps; left > 0;) {
          const std::uint64_t now = std::min(left, at_once_);
          stop_if_asked();
          simulation_->advance(now);
          left -= now;
        }
        seconds_ += clock.seconds();
        processor_seconds_ += std::max(processor.seconds() - looking, 0.0);
        steps_ += steps;
        observe(metric, look);
      }
    }
  }

  const Simulation& simulation() const { return *simulation_; }
  double seconds() const { return seconds_; }  // by the clock
  double processor_seconds() const { return processor_seconds_; }
  double widest_skin() const { return widest_skin_; }

 private:
  void observe(ErrorMetric& metric, auto&& look) {
    now_.time = static_cast<double>(steps_) * h_;
    simulation_->observe(now_.states);
    now_.impacts = simulation_->impacts();
    if (!std::ranges::all_of(now_.states, all_finite)) throw NotANumber();
    look(now_);
    metric.look(now_);
    metric.interfere(now_, *simulation_);
  }

  const Schedule& schedule_;
  double h_;
  std::uint64_t at_once_;
  std::unique_ptr<Simulation> simulation_;
  Observation now_;
  double widest_skin_ = 0;
  double seconds_ = 0, processor_seconds_ = 0;
  std::uint64_t steps_ = 0;
};

void judge(Row& row, std::optional<std::string> collapse) {
  if (row.status != Status::ok) return;
  if (collapse) {
    row.status = Status::collapsed;
    row.reason = std::move(*collapse);
  }
  for (const Norm& norm : row.norms)
    if (!std::isfinite(norm.value) || (norm.name == "traj" && norm.value > kBeyondSense)) {
      row.status = Status::diverged;
      row.reason = fmt::format("the error '{}' grew to {:.3g}", norm.name, norm.value);
    }
  if (row.status == Status::ok && row.drift.energy && !(*row.drift.energy < kBeyondSense)) {
    row.status = Status::diverged;
    row.reason = fmt::format("the energy changed by {:.3g} times its scale", *row.drift.energy);
  }
}

void ignore(const Observation&) {}

std::uint64_t looks_of(const Schedule& schedule) {
  std::uint64_t looks = 1;
  for (const Leg& leg : schedule.legs) looks += leg.looks;
  return looks;
}

std::string looks_words(const Schedule& schedule) {
  return fmt::format("; looked at {} times in {:.4g} s, whose intervals the steps divide",
                     looks_of(schedule), schedule.seconds);
}

}  // namespace

Reference reference_for(const Scenario& scenario, const Schedule& schedule, double step) {
  if (scenario.problem) {
    const MetricMaker make = metrics_of(scenario);
    const auto first = make();  // tells at once if it is not that problem
    return {first->reference() + looks_words(schedule), make, first->reference_error()};
  }
  Method method;
  method.name = "as written";
  if (scenario.world.contacts == ContactMethod::none) method = *method_named("runge_kutta_4");
  const double h = schedule.fitted_step(step);
  const std::uint64_t looks = looks_of(schedule);
  require_memory(looks * scenario.bodies.size() * sizeof(BodyState),
                 fmt::format("the states of {} bodies at {} times", scenario.bodies.size(), looks),
                 "take fewer bodies, or fewer steps that wait or run");
  const auto run = [&](double of, ErrorMetric& metric) {
    try {
      Runner(scenario, schedule, LanternSolver(method), of).run(metric, ignore);
    } catch (const NotANumber&) {
      throw Refused("its own run ends in states that are no numbers");
    }
  };
  Recorder fine;
  run(h, fine);
  const auto make = [record = fine.record()] { return std::make_unique<OwnRun>(record); };
  const auto coarser = make();
  run(schedule.fitted_step(2 * h), *coarser);
  return {fmt::format("own run, {} at {:.3g} s", method.name, h) + looks_words(schedule), make,
          coarser->norms().front().value};
}

Row blank_row(const Scenario& scenario, const Solver& solver, double h) {
  Row row;
  row.problem = scenario.name;
  row.file = scenario.file;
  row.text_hash = scenario.text_hash;
  row.family = scenario.problem ? to_string(scenario.problem->solution) : scenario.name;
  row.variant = scenario.problem ? to_string(scenario.problem->variant) : "own";
  row.method = solver.name();
  row.version = solver.version();
  row.step = h;
  return row;
}

Row evaluated(const Trials& trials, const Solver& solver, double h, double* processor_seconds) {
  Row row = blank_row(trials.scenario, solver, h);
  row.reference = trials.reference.text;
  row.reference_error = trials.reference.error;
  const std::unique_ptr<ErrorMetric> metric = trials.reference.make();
  DriftMeter meter(trials.invariants);
  Sampler sampler(*metric, meter, trials.schedule);
  std::optional<Runner> runner;
  const auto failed = [&](Status status, const char* reason) {
    row.status = status;
    row.reason = reason;
  };
  try {
    runner.emplace(trials.scenario, trials.schedule, solver, h);
    runner->run(sampler, [&](const Observation& now) { meter.look(now.states); });
    row.norms = metric->norms();
    if (processor_seconds) *processor_seconds = runner->processor_seconds();
  } catch (const Refused& refused) {
    failed(runner ? Status::diverged : Status::refused, refused.what());
  } catch (const NotANumber&) {
    failed(Status::nan, "a state is not a number");
  }
  if (!runner) return row;
  row.drift = meter.drift();
  if (row.drift.energy || row.drift.momentum || row.drift.angular_momentum)
    row.samples = sampler.samples();
  row.penetration = meter.penetration();
  row.skin = runner->widest_skin();
  row.counted = runner->simulation().counted();
  row.hash = runner->simulation().hash();
  judge(row, metric->collapse());
  return row;
}

void time_in_turn(const Trials& trials, std::span<const TimedRun> runs,
                  const std::function<void(std::size_t)>& told) {
  std::vector<std::vector<double>> clock(runs.size()), processor(runs.size());
  bool any = true;
  for (int round = 0; any; ++round) {
    any = false;
    for (std::size_t i = 0; i < runs.size(); ++i) {
      const auto& [solver, row, rule] = runs[i];
      if (round >= rule.repeats && (round >= rule.most || timing_of(processor[i]).is_narrow()))
        continue;
      any = true;
      double spent = 0, passed = 0;
      int times = 0;
      for (; times == 0 || spent < rule.least_seconds; ++times) {
        Runner runner(trials.scenario, trials.schedule, *solver, row->step);
        runner.run(*trials.reference.make(), ignore);
        if (!row->is_peer()) LANTERN_CHECK(runner.simulation().hash(), ==, row->hash);
        spent += runner.processor_seconds();
        passed += runner.seconds();
      }
      processor[i].push_back(spent / times);
      clock[i].push_back(passed / times);
      told(i);
    }
  }
  for (std::size_t i = 0; i < runs.size(); ++i) {
    runs[i].row->timing = timing_of(clock[i]);
    runs[i].row->processor = timing_of(processor[i]);
  }
}

double estimated_seconds(const Scenario& scenario, const Schedule& schedule, const Solver& solver,
                         double h) {
  constexpr double kLook = 0.004;  // seconds
  const auto all = static_cast<double>(schedule.steps(h));
  try {
    const std::unique_ptr<Simulation> simulation = solver.start(scenario, h);
    for (const Verb& verb : schedule.legs.front().before) simulation->act(verb);
    // The quickest batch: the first steps are cold.
    double spent = 0, steps = 0, per_step = std::numeric_limits<double>::infinity();
    for (double batch = 1; spent < kLook && steps < all; batch *= 2) {
      const double n = std::min(batch, all - steps);
      const CpuStopwatch watch;
      simulation->advance(static_cast<std::uint64_t>(n));
      const double seconds = watch.seconds();
      spent += seconds;
      steps += n;
      per_step = std::min(per_step, seconds / n);
    }
    return per_step * all;
  } catch (const Refused&) {
    return 0;
  }
}

}  // namespace lantern::measure
