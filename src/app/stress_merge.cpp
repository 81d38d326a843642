// The cases that shards have run, as one report.
#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "app/merge.hpp"
#include "app/report_folder.hpp"
#include "app/stress_files.hpp"
#include "app/terminal.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "embedded/version.hpp"

namespace lantern::app {
namespace {

constexpr std::size_t kMostCasesBytes = std::size_t{16} << 20;

StressReport cases_of(const ShardSet& set, const FoundShard& shard) {
  const auto path = shard.path / "stress.json";
  std::optional<StressReport> read;
  try {
    read = read_stress(read_file(path, kMostCasesBytes));
  } catch (const IoError&) {
    // told as one that cannot be read
  }
  std::vector<std::string> there, wanted;
  for (const ShardInput& input : shard.record.inputs)
    if (input.here > 0) wanted.push_back(input.name);
  if (read)
    for (const StressOutcome& outcome : read->outcomes) there.emplace_back(outcome.of.name);
  if (!read || !read->finished || there != wanted)
    throw UnfitShard(set, shard, fmt::format("'{}' is not what the shard wrote", path.string()));
  return std::move(*read);
}

}  // namespace

int merge_stress(const ShardSet& set, const MergeOptions& options, JsonWriter& json) {
  for (const ShardSet::Twins& twins : set.twins())
    if (to_json(cases_of(set, *twins.first)) != to_json(cases_of(set, *twins.second)))
      throw UsageError(fmt::format("'{}' and '{}' are both shard {}, but their results differ",
                                   twins.first->path.string(), twins.second->path.string(),
                                   twins.first->record.shard.text()));
  StressReport whole{std::string(kVersion), {}, true};
  for (const FoundShard* shard : set.shards())
    for (StressOutcome& outcome : cases_of(set, *shard).outcomes)
      whole.outcomes.push_back(std::move(outcome));
  std::ranges::sort(whole.outcomes, {}, [&](const StressOutcome& outcome) {
    return std::ranges::find(set.run().inputs, outcome.of.name, &ShardInput::name);
  });
  ReportFolder folder(options.output, "stress");
  save_stress_tables(folder, whole);
  draw_stress_map(folder, whole, set.run().settings.at("theme"), options.backend);
  folder.finish();
  json.line().member("cases", whole.outcomes.size());
  if (!options.json) print(to_table(whole));
  say(fmt::format("the report of {} shards is in {}", set.run().shard.of, options.output));
  return is_good(whole) ? kGood : kFailed;
}

}  // namespace lantern::app
