#include "measure/box_stage_bench.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include <fmt/format.h>
#include <malloc.h>

#include "base/clock.hpp"
#include "base/error.hpp"
#include "base/hash.hpp"
#include "base/stop.hpp"
#include "measure/box_truth.hpp"
#include "measure/timed.hpp"

namespace lantern::measure {
namespace {

constexpr double kLeastTurn = 0.002;  // what a turn should last at least
constexpr int kMostSteps = 64;          // of a turn
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

}  // namespace

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

void StageBench::enter(const BoxContestant& who, const std::optional<std::string>& left_out,
                       Known& known) {
  Entry& e = entries_.emplace_back();
  e.who = &who;
  e.row.workload = stage_.workload;
  e.row.dimension = stage_.dimension();
  e.row.bodies = stage_.bodies();
  e.row.contestant = who.name();
  e.row.version = who.version();
  if (left_out) return refuse(e, "left out", *left_out);
  const BoxSetting start = likely(who, known);
  const BoxSetting best = quickest(who, stage_, start, config_.search);
  known[{stage_.workload, who.name()}] = {best, stage_.bodies()};
  warm_up(e, best);
}

void StageBench::warm_up(Entry& e, const BoxSetting& setting) {
  e.row.setting = e.who->words(setting);
  try {
    const double before = bytes_in_use();
    e.run = e.who->start(stage_, setting);
    for (int i = 0; i < (e.step_seconds > kLongStep ? 2 : 4); ++i) {
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

void StageBench::run_rounds() {
  for (int round = 0; round < config_.rounds; ++round)
    for (std::size_t i = 0; i < entries_.size(); ++i) {
      // Who follows whom changes from round to round.
      Entry& e = entries_[(i + static_cast<std::size_t>(round)) % entries_.size()];
      if (!e.run) continue;
      const bool is_late = e.step_seconds * round > config_.seconds;
      if (round < kLeastRounds || !is_late) take_turn(e);
    }
}

std::vector<BoxBenchRow> StageBench::rows() {
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

void StageBench::refuse(Entry& e, const char* status, std::string reason) {
  e.row.status = status;
  e.row.reason = std::move(reason);
}

BoxSetting StageBench::likely(const BoxContestant& who, const Known& known) const {
  BoxSetting start = who.likely(stage_);
  const auto found = known.find({stage_.workload, who.name()});
  if (found == known.end()) return start;
  const auto& [setting, bodies] = found->second;
  if (setting.second == 0) return setting;
  const double growth = static_cast<double>(stage_.bodies()) / static_cast<double>(bodies);
  const double children = who.name() == "kd_tree" ? 1 : stage_.dimension();
  start = setting;
  start.second += static_cast<int>(std::lround(std::log2(growth) / children));
  return who.has(start) ? start : setting;
}

double StageBench::step(Entry& e) {
  return seconds_of(*e.run, frame_at(e.turn++, stage_.frames()));
}

void StageBench::take_turn(Entry& e) {
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

void StageBench::judge(Entry& e, const BoxTruth& truth) {
  const BoxTruth::Verdict verdict = truth.judge(e.run->found());
  e.row.missed += verdict.missed;
  e.row.invented += verdict.invented;
}

// Each at the first frame once more, beside the truth.
void StageBench::check() {
  const BoxTruth truth(stage_, 0);
  std::map<std::uint64_t, int> how_many;
  for (Entry& e : entries_) {
    if (!e.run) continue;
    e.run->step(0);
    judge(e, truth);
    e.row.found = e.run->found().size();
    e.row.checked = truth.words();
    e.row.counts = e.run->counts();
    Hash hash;
    for (const Pair& pair : e.run->found()) hash.add((std::uint64_t{pair.a} << 32) | pair.b);
    e.hash = hash.value();
    ++how_many[e.hash];
  }
  if (truth.is_sample()) compare(how_many);
  for (Entry& e : entries_)
    if (e.row.missed + e.row.invented > 0)
      refuse(e, "wrong", fmt::format("{} missed, {} invented", e.row.missed, e.row.invented));
}

// Where only a sample is known: what most found, at least two of them, is right.
void StageBench::compare(const std::map<std::uint64_t, int>& how_many) {
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

}  // namespace lantern::measure
