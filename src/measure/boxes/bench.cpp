#include "measure/boxes/bench.hpp"

#include <set>

#include <malloc.h>

#include "base/hash.hpp"
#include "base/memory.hpp"

namespace lantern::measure {
namespace {

constexpr double kLeastTurn = 0.02;  // what a turn should last at least
constexpr double kWarm = 0.3;        // what is long enough to be warm, and to know how boxes move
constexpr int kMostSteps = 64;       // of a turn
constexpr int kLeastRounds = 3;
constexpr double kLongStep = 0.1;  // seconds: one is enough to be warm

// Frames to and fro: 0 1 2 3 2 1 0 1 ...
std::size_t frame_at(std::size_t turn, std::size_t frames) {
  if (frames == 1) return 0;
  const std::size_t place = turn % (2 * (frames - 1));
  return place < frames ? place : 2 * (frames - 1) - place;
}

// Nothing where the allocator does not tell.
double bytes_in_use() {
  const struct mallinfo2 info = ::mallinfo2();
  return static_cast<double>(info.uordblks) + static_cast<double>(info.hblkhd);
}

// Of the processor, all threads together: what else the machine does is no part of it.
double seconds_of(BoxRun& run, std::size_t frame) {
  stop_if_asked();
  const CpuStopwatch watch;
  run.step(frame);
  return watch.seconds();
}

// Seconds of the processor for a step of a fresh run with this setting, warm; infinite if it is
// refused.
double tried(const BoxContestant& who, const BoxStage& stage, const BoxSetting& setting) {
  try {
    const auto run = who.start(stage, setting);
    const double first = seconds_of(*run, 0);
    // The same boxes again are no step.
    const bool stands = stage.task == BoxTask::pairs && stage.frames() == 1;
    if (first > kLongStep || stands) return first;
    const double second = seconds_of(*run, frame_at(1, stage.frames()));
    return std::min(second, seconds_of(*run, frame_at(2, stage.frames())));
  } catch (const Refused&) {
    return std::numeric_limits<double>::infinity();
  }
}

std::vector<BoxSetting> neighbours(const BoxContestant& who, const BoxSetting& s) {
  std::vector<BoxSetting> all = {{s.first + 1, s.second},
                                 {s.first - 1, s.second},
                                 {s.first, s.second + 1},
                                 {s.first, s.second - 1}};
  std::erase_if(all, [&](const BoxSetting& one) { return !who.has(one); });
  return all;
}

// Downhill from a likely setting to the quickest one around, as long as there is time.
BoxSetting quickest(const BoxContestant& who, const BoxStage& stage, BoxSetting best,
                    double seconds) {
  std::vector<BoxSetting> next = neighbours(who, best);
  if (next.empty()) return best;
  const CpuStopwatch watch;
  double least = tried(who, stage, best);
  std::set<BoxSetting> known = {best};
  while (!next.empty()) {
    const BoxSetting from = best;
    for (const BoxSetting& one : next) {
      if (!known.insert(one).second) continue;
      if (watch.seconds() + least > seconds && std::isfinite(least)) return best;
      const double needed = tried(who, stage, one);
      if (needed >= least) continue;
      least = needed;
      best = one;
    }
    next = best == from ? std::vector<BoxSetting>() : neighbours(who, best);
  }
  return best;
}

// The rounds of one stage: each contestant's best setting, its turns, and whether what it found is
// right.
class StageBench {
 public:
  // The settings that were best, and for how many bodies; by workload and contestant.
  using Known = std::map<std::pair<std::string, std::string>, std::pair<BoxSetting, std::size_t>>;

  // Both outlive this.
  StageBench(const BoxBenchConfig& config, const BoxStage& stage)
      : config_(config), stage_(stage), second_(stage, 1 % stage.frames()) {}

  // Looks for its best setting, from the one that was best for fewer bodies, and warms it up;
  // nothing of it if there is a reason to leave it out.
  void enter(const BoxContestant& who, const std::optional<std::string>& left_out, Known& known) {
    Entry& e = entries_.emplace_back();
    e.who = &who;
    e.row.workload = stage_.workload;
    e.row.dimension = stage_.dimension();
    e.row.bodies = stage_.bodies();
    e.row.frames = stage_.frames();
    e.row.contestant = who.name;
    e.row.version = who.version;
    if (left_out) return refuse(e, "left out", *left_out);
    const BoxSetting start = likely(who, known);
    const BoxSetting best = quickest(who, stage_, start, config_.search);
    known[{stage_.workload, who.name}] = {best, stage_.bodies()};
    warm_up(e, best);
  }

  void run_rounds() {
    for (int round = 0; round < config_.rounds; ++round)
      for (std::size_t i = 0; i < entries_.size(); ++i) {
        // Who follows whom changes from round to round.
        Entry& e = entries_[(i + static_cast<std::size_t>(round)) % entries_.size()];
        if (!e.run) continue;
        const bool is_late = e.step_seconds * round > config_.seconds;
        if (round < kLeastRounds || !is_late) take_turn(e);
      }
  }

  // Judged; to be called once.
  std::vector<BoxBenchRow> rows() {
    check();
    std::vector<BoxBenchRow> all;
    for (Entry& e : entries_) {
      const double items = stage_.task == BoxTask::pairs ? 1 : static_cast<double>(kQuestions);
      for (double& s : e.seconds) s /= items;
      e.row.timing = timing_of(e.seconds);
      if (!e.wall.empty()) e.row.wall = quantile(e.wall, 0.5) / items;
      if (!e.calls.empty()) e.row.allocations = quantile(e.calls, 0.5);
      all.push_back(std::move(e.row));
    }
    return all;
  }

 private:
  // A contestant on its way.
  struct Entry {
    const BoxContestant* who = nullptr;
    BoxBenchRow row = {};
    std::unique_ptr<BoxRun> run = nullptr;
    double step_seconds = 0;  // about
    std::size_t turn = 0;
    std::vector<double> seconds = {};  // of the processor, a step
    std::vector<double> wall = {};     // by the clock
    std::vector<double> calls = {};    // for memory, a step
    std::uint64_t hash = 0;            // of what it found
  };

  static void refuse(Entry& e, const char* status, std::string reason) {
    e.row.status = status;
    e.row.reason = std::move(reason);
  }

  BoxSetting likely(const BoxContestant& who, const Known& known) const {
    BoxSetting start = who.likely(stage_);
    const auto found = known.find({stage_.workload, who.name});
    if (found == known.end()) return start;
    const auto& [setting, bodies] = found->second;
    if (setting.second == 0) return setting;
    const double growth = static_cast<double>(stage_.bodies()) / static_cast<double>(bodies);
    start = setting;
    start.second += static_cast<int>(
        std::lround(std::log2(growth) / halved_axes(who.name, stage_.dimension())));
    return who.has(start) ? start : setting;
  }

  void warm_up(Entry& e, const BoxSetting& setting) {
    e.row.setting = e.who->words(setting);
    try {
      const double before = bytes_in_use();
      e.run = e.who->start(stage_, setting);
      const CpuStopwatch watch;
      const std::size_t most = 2 * stage_.frames() + 2;
      while (e.turn < 2 || (e.step_seconds <= kLongStep && e.turn < 4) ||
             (e.turn < most && watch.seconds() < kWarm)) {
        e.step_seconds = step(e);
        if (e.turn == 2) judge(e, second_);
      }
      const double held = bytes_in_use() - before;
      if (held > 0) e.row.bytes = held / static_cast<double>(stage_.bodies());
    } catch (const Refused& refused) {
      e.run.reset();
      refuse(e, "refused", refused.what());
    } catch (const StructureFault& broken) {
      e.run.reset();
      refuse(e, "refused", broken.what());
    }
  }

  double step(Entry& e) { return seconds_of(*e.run, frame_at(e.turn++, stage_.frames())); }

  void take_turn(Entry& e) {
    const int steps = std::clamp(static_cast<int>(kLeastTurn / std::max(e.step_seconds, 1e-7)) + 1,
                                 1, kMostSteps);
    const auto calls = e.run->allocations();
    const Stopwatch clock;
    const CpuStopwatch watch;
    for (int i = 0; i < steps; ++i) step(e);
    e.seconds.push_back(watch.seconds() / steps);
    e.wall.push_back(clock.seconds() / steps);
    if (calls) e.calls.push_back(static_cast<double>(*e.run->allocations() - *calls) / steps);
  }

  static void judge(Entry& e, const BoxTruth& truth) {
    const BoxTruth::Verdict verdict = truth.judge(e.run->found());
    e.row.missed += verdict.missed;
    e.row.invented += verdict.invented;
  }

  // Each at the first frame once more, beside the truth.
  void check() {
    const BoxTruth truth(stage_, 0);
    std::map<std::uint64_t, int> how_many;
    for (Entry& e : entries_) {
      if (!e.run) continue;
      e.run->step(0);
      judge(e, truth);
      e.row.found = e.run->found().size();
      e.row.checked = truth.words() + (stage_.frames() > 1 ? " at the first two frames" : "");
      e.row.counts = e.run->counts();
      Hash hash;
      for (const Pair& pair : e.run->found()) hash.add((std::uint64_t{pair.a} << 32) | pair.b);
      e.hash = hash.value();
      ++how_many[e.hash];
      if (stage_.frames() == 1 || e.step_seconds > kLongStep) continue;
      e.row.found_in_all = static_cast<double>(e.row.found);
      for (std::size_t frame = 1; frame < stage_.frames(); ++frame) {
        seconds_of(*e.run, frame);
        *e.row.found_in_all += static_cast<double>(e.run->found().size());
      }
    }
    if (truth.is_sample()) compare(how_many);
    for (Entry& e : entries_)
      if (e.row.missed + e.row.invented > 0)
        refuse(e, "wrong", fmt::format("{} missed, {} invented", e.row.missed, e.row.invented));
  }

  // Where only a sample is known: what most found, at least two of them, is right.
  void compare(const std::map<std::uint64_t, int>& how_many) {
    const auto most =
        std::ranges::max_element(how_many, {}, [](const auto& one) { return one.second; });
    if (most == how_many.end()) return;
    for (Entry& e : entries_) {
      if (!e.run) continue;
      const int same = how_many.at(e.hash);
      if (e.hash != most->first || (same == 1 && how_many.size() > 1))
        refuse(e, "wrong", "it found other pairs than most did");
      e.row.checked += same > 1 ? fmt::format(", the same pairs as {} others", same - 1) : "";
    }
  }

  const BoxBenchConfig& config_;
  const BoxStage& stage_;
  BoxTruth second_;  // of the second frame, at which each is looked at on its way in
  std::vector<Entry> entries_;
};

const std::vector<std::uint64_t>& bodies_of(const BoxWorkload& workload,
                                            const BoxBenchConfig& config) {
  if (!config.bodies.empty()) return config.bodies;
  return config.full ? workload.full : workload.bodies;
}

class Bench {
 public:
  Bench(BoxBenchResult& result, const BoxBenchWatch& watch)
      : result_(result), config_(result.config), watch_(watch) {
    if (config_.own)
      own_ = BoxStage{config_.own->name, BoxTask::pairs, *config_.own, Questions<2>{}};
    gather();
    require_room();
  }

  void run() {
    if (own_) return run(*own_, nullptr);
    for (const BoxWorkload* workload : config_.workloads)
      for (const std::uint64_t bodies : bodies_of(*workload, config_))
        run(stage_of(*workload, bodies, config_.seed), workload);
  }

 private:
  void gather() {
    all_ = own_box_contestants();
    if (config_.peers)
      for (BoxContestant& who : peer_box_contestants(result_.missing))
        all_.push_back(std::move(who));
    keep_asked_for(all_, config_.only, result_.missing, [](const auto& who) { return who.name; });
    for (const auto& who : all_) result_.contestants.push_back({who.name, who.version, who.how});
  }

  // From two small worlds of its sort.
  double pairs_of(const BoxWorkload& workload, std::uint64_t bodies) const {
    if (workload.task != BoxTask::pairs) return 0;
    const auto count = [&](std::size_t n) {
      const BoxStage stage{"", BoxTask::pairs, boxes_of(workload, n, 1, config_.seed),
                           Questions<2>{}};
      return static_cast<double>(BoxTruth(stage, 0).judge({}).missed + 1);
    };
    const std::size_t large = std::min<std::uint64_t>(bodies, 2000), small = large / 4 + 1;
    const double at_large = count(large), at_small = count(small);
    const double power = std::log(at_large / at_small) /
                         std::log(static_cast<double>(large) / static_cast<double>(small));
    return at_large * std::pow(static_cast<double>(bodies) / static_cast<double>(large),
                               std::clamp(power, 1.0, 2.0));
  }

  void require_room() const {
    if (own_) {
      const std::size_t part = own_->bodies() / 2000 + 1;
      const auto sampled = BoxTruth(thinned(*own_, part), 0).judge({}).missed;
      const auto share = static_cast<double>(part);
      return require_room(own_->workload, own_->bodies(),
                          static_cast<double>(sampled) * share * share);
    }
    for (const BoxWorkload* workload : config_.workloads)
      for (const std::uint64_t bodies : bodies_of(*workload, config_))
        require_room(workload->name, bodies, bodies < 8 ? 0 : pairs_of(*workload, bodies));
  }

  void require_room(std::string_view name, std::uint64_t bodies, double pairs) const {
    const std::string what =
        fmt::format("{} with {} bodies and about {:.2g} pairs", name, bodies, pairs);
    const auto most = static_cast<double>(BroadPhaseConfig<2>().most_pairs);
    if (pairs > most) throw Refused("{}: the limit is {:.2g} pairs; take fewer bodies", what, most);
    const auto n = static_cast<double>(bodies), runs = static_cast<double>(all_.size() + 1);
    const double bytes =
        64 * n * static_cast<double>(frames_for(bodies)) + runs * (500 * n + 40 * pairs);
    require_memory(static_cast<std::uint64_t>(bytes), what,
                   "take fewer bodies, or some of the contestants with --only");
  }

  // Felt for on worlds an eighth and a 64th as large: the seconds that a step would take.
  std::optional<std::string> too_slow(const BoxContestant& who, const BoxStage& stage,
                                      std::vector<BoxStage>& smaller,
                                      const BoxWorkload* workload) const {
    if (stage.bodies() <= 8000) return std::nullopt;
    if (smaller.empty())
      for (const std::size_t part : {64, 8})
        smaller.push_back(workload ? stage_of(*workload, stage.bodies() / part, config_.seed)
                                   : thinned(stage, part));
    double last = 0, growth = 8;
    for (const BoxStage& one : smaller) {
      const double now = tried(who, one, who.likely(one));
      if (last > 0) growth = std::clamp(now / last, 8.0, 80.0);
      last = now;
      const double expected = now * (&one == &smaller.back() ? growth : 64);
      if (expected > config_.longest)
        return fmt::format("a step would take about {:.2g} s", expected);
    }
    return std::nullopt;
  }

  void run(const BoxStage& stage, const BoxWorkload* workload) {
    const std::string words = fmt::format("{} {}", stage.workload, stage.bodies());
    StageBench bench(config_, stage);
    std::vector<BoxStage> smaller;
    for (const auto& who : all_) {
      const bool can = who.can(stage);
      if (!can && config_.only.empty()) continue;  // who is asked for by name has a row
      watch_(stage_number_, fmt::format("{}: {} looks for its best setting", words, who.name));
      bench.enter(who,
                  can ? too_slow(who, stage, smaller, workload)
                      : fmt::format("it does not do this in {} dimensions", stage.dimension()),
                  known_);
    }
    watch_(stage_number_++, words + ": rounds");
    bench.run_rounds();
    for (BoxBenchRow& row : bench.rows()) result_.rows.push_back(std::move(row));
    add_missing(stage);
  }

  void add_missing(const BoxStage& stage) {
    for (const std::string& line : result_.missing) {
      BoxBenchRow& row = result_.rows.emplace_back();
      row.workload = stage.workload;
      row.dimension = stage.dimension();
      row.bodies = stage.bodies();
      row.contestant = line.substr(0, line.find(':'));
      row.version = "?";
      row.status = "missing";
      row.reason = line.substr(line.find(':') + 2);
    }
  }

  BoxBenchResult& result_;
  const BoxBenchConfig& config_;
  const BoxBenchWatch& watch_;
  std::optional<BoxStage> own_;  // of a user's own boxes
  std::vector<BoxContestant> all_;
  StageBench::Known known_;
  std::size_t stage_number_ = 0;
};

}  // namespace

std::size_t box_stages(const BoxBenchConfig& config) {
  if (config.own) return 1;
  return sum_of<std::size_t>(config.workloads, [&](const BoxWorkload* workload) {
    return bodies_of(*workload, config).size();
  });
}

void bench_boxes(BoxBenchResult& result, const BoxBenchWatch& watch) { Bench(result, watch).run(); }

const BoxBenchRow* fastest_peer(const std::vector<BoxBenchRow>& rows, const BoxBenchRow& at) {
  const BoxBenchRow* best = nullptr;
  for (const BoxBenchRow& row : rows)
    if (row.is_peer() && row.status == "ok" && row.workload == at.workload &&
        row.bodies == at.bodies && (!best || row.timing.median < best->timing.median))
      best = &row;
  return best;
}

}  // namespace lantern::measure
