#include "measure/box_bench.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/memory.hpp"
#include "measure/box_stage_bench.hpp"
#include "measure/box_truth.hpp"

namespace lantern::measure {
namespace {

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
      for (const std::uint64_t bodies : bodies_of(*workload))
        run(stage_of(*workload, bodies, config_.seed), workload);
  }

 private:
  const std::vector<std::uint64_t>& bodies_of(const BoxWorkload& workload) const {
    return !config_.bodies.empty() ? config_.bodies
           : config_.full          ? workload.full
                                   : workload.bodies;
  }

  bool is_asked_for(const BoxContestant& who) const {
    return config_.only.empty() ||
           std::ranges::find(config_.only, who.name()) != config_.only.end();
  }

  void gather() {
    std::set<std::string> names;
    const auto add = [&](std::unique_ptr<BoxContestant> who) {
      names.insert(who->name());
      if (is_asked_for(*who)) all_.push_back(std::move(who));
    };
    for (auto& who : own_box_contestants()) add(std::move(who));
    if (config_.peers)
      for (auto& who : peer_box_contestants(result_.missing)) add(std::move(who));
    for (const std::string& name : config_.only) {
      const auto is_it = [&](const std::string& line) { return line.starts_with(name + ":"); };
      const auto missing = std::ranges::find_if(result_.missing, is_it);
      if (missing != result_.missing.end()) throw Refused(*missing);
      if (!names.contains(name))
        throw Refused(fmt::format("there is no contestant '{}'; take some of {}", name,
                                  fmt::join(names, ", ")));
    }
    for (const auto& who : all_)
      if (who->is_peer()) result_.peers.push_back({who->name(), who->version(), who->how()});
  }

  // From two small worlds of its sort.
  double pairs_of(const BoxWorkload& workload, std::uint64_t bodies) const {
    if (workload.task != BoxTask::pairs) return 0;
    const auto count = [&](std::size_t n) {
      const BoxStage stage{"", BoxTask::pairs, boxes_of(workload, n, 1, config_.seed),
                           Questions<2>{}};
      for (const auto& who : own_box_contestants())
        if (who->name() == "sort_and_sweep") {
          const auto run = who->start(stage, {});
          run->step(0);
          return static_cast<double>(run->found().size() + 1);
        }
      return 1.0;
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
      for (const std::uint64_t bodies : bodies_of(*workload))
        require_room(workload->name, bodies, bodies < 8 ? 0 : pairs_of(*workload, bodies));
  }

  void require_room(std::string_view name, std::uint64_t bodies, double pairs) const {
    const std::string what =
        fmt::format("{} with {} bodies and about {:.2g} pairs", name, bodies, pairs);
    const auto most = static_cast<double>(BroadPhaseConfig<2>().most_pairs);
    if (pairs > most)
      throw Refused(fmt::format("{}: the limit is {:.2g} pairs; take fewer bodies", what, most));
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
      if (!who->can(stage)) continue;
      watch_(stage_number_, fmt::format("{}: {} looks for its best setting", words, who->name()));
      bench.enter(*who, too_slow(*who, stage, smaller, workload), known_);
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
  std::vector<std::unique_ptr<BoxContestant>> all_;
  StageBench::Known known_;
  std::size_t stage_number_ = 0;
};

}  // namespace

std::size_t box_stages(const BoxBenchConfig& config) {
  if (config.own) return 1;
  std::size_t stages = 0;
  for (const BoxWorkload* workload : config.workloads)
    stages += !config.bodies.empty() ? config.bodies.size()
              : config.full          ? workload->full.size()
                                     : workload->bodies.size();
  return stages;
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
