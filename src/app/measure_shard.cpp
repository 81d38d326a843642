#include "app/measure_shard.hpp"

#include <utility>

#include <fmt/format.h>

namespace lantern::app {
namespace {

std::string joined(const auto& list) { return fmt::format("{}", fmt::join(list, " ")); }

}  // namespace

MeasureShard::MeasureShard(const MeasureOptions& options, PlanOptions& plan)
    : options_(options), shard_(parse_shard(options.shard)) {
  if (!shard_) return;
  std::vector<Scenario> kept;
  for (std::size_t i = 0; i < plan.scenarios.size(); ++i) {
    Scenario& scenario = plan.scenarios[i];
    all_.push_back({scenario.name, fmt::format("{:016x}", scenario.text_hash)});
    if (!shard_->has(i)) continue;
    kept.push_back(std::move(scenario));
    places_.push_back(i);
  }
  plan.scenarios = std::move(kept);
}

std::string MeasureShard::folder() const {
  return shard_ ? shard_->folder_in(options_.output).string() : options_.output;
}

void MeasureShard::begin(const Plan& plan, const Circumstances& here) {
  if (!shard_) return;
  ShardRecord record = new_record("measure", *shard_);
  record.inputs = all_;
  record.settings = {{"effort", here.effort},
                     {"method", joined(options_.methods)},
                     {"step", joined(options_.steps)},
                     {"longest", options_.longest ? fmt::format("{}", *options_.longest) : ""},
                     {"engines", fmt::format("{}", fmt::join(plan.peers_there(), "; "))},
                     {"theme", options_.theme},
                     {"all problems", options_.problems.empty() ? "yes" : "no"},
                     {"compiler", here.compiler},
                     {"flags", here.flags},
                     {"processor", here.processor}};
  folder_.emplace(folder(), std::move(record));
}

void MeasureShard::finish(const Plan& plan) {
  if (!folder_) return;
  for (const Job& job : plan.jobs()) ++folder_->input(places_[job.scenario]).here;
  folder_->finish();
}

}  // namespace lantern::app
