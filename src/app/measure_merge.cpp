// The rows that shards have measured, as one report.
#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "app/measure_pages.hpp"
#include "app/merge.hpp"
#include "app/report_folder.hpp"
#include "app/terminal.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "report/measure_tables.hpp"

namespace lantern::app {
namespace {

constexpr std::size_t kMostRowsBytes = std::size_t{256} << 20;
constexpr const char* kRowsFile = "measure.json";

bool has_some(const FoundShard& shard) {
  return std::ranges::any_of(shard.record.inputs, [](const ShardInput& i) { return i.here > 0; });
}

// As the shard's record says it: so many rows of each problem, in order.
Measurement rows_of(const ShardSet& set, const FoundShard& shard) {
  std::optional<Measurement> read;
  try {
    read = read_measurement(read_file(shard.path / kRowsFile, kMostRowsBytes));
  } catch (const IoError&) {
    // told as one that cannot be read
  }
  std::size_t row = 0;
  bool fits = read.has_value();
  for (const ShardInput& input : shard.record.inputs)
    for (std::uint64_t i = 0; fits && i < input.here; ++i, ++row)
      fits = row < read->rows.size() && read->rows[row].problem == input.name;
  if (!fits || row != read->rows.size())
    throw UnfitShard(
        set, shard,
        fmt::format("'{}' is not what the shard wrote", (shard.path / kRowsFile).string()));
  return std::move(*read);
}

// Times differ from one measurement to the next: only a copy is equal.
void require_copies(const ShardSet::Twins& twins) {
  const auto bytes = [](const FoundShard* shard) {
    return has_some(*shard) ? read_file(shard->path / kRowsFile, kMostRowsBytes) : std::string();
  };
  if (bytes(twins.first) != bytes(twins.second))
    throw UsageError(fmt::format(
        "'{}' and '{}' are both shard {}, measured twice: their times differ; "
        "give one of them",
        twins.first->path.string(), twins.second->path.string(), twins.first->record.shard.text()));
}

// In the order in which engines are listed everywhere.
void add_peers(const std::string& engines, const std::vector<PeerRecord>& more,
               std::vector<PeerRecord>& peers) {
  for (const PeerRecord& peer : more)
    if (std::ranges::find(peers, peer) == peers.end()) peers.push_back(peer);
  std::ranges::stable_sort(peers, {}, [&](const PeerRecord& peer) {
    return engines.find(fmt::format("{} {}", peer.name, peer.version));
  });
}

Measurement merged(const ShardSet& set) {
  Measurement whole;
  std::map<const FoundShard*, Measurement> parts;
  for (const FoundShard* shard : set.shards()) {
    if (!has_some(*shard)) continue;
    Measurement part = rows_of(set, *shard);
    whole.circumstances = part.circumstances;
    add_peers(set.run().settings.at("engines"), part.peers, whole.peers);
    std::ranges::reverse(part.rows);  // the next one is the last
    parts.emplace(shard, std::move(part));
  }
  for (std::size_t i = 0; i < set.run().inputs.size(); ++i)
    for (auto& [shard, part] : parts)
      for (std::uint64_t k = 0; k < shard->record.inputs[i].here; ++k) {
        whole.rows.push_back(std::move(part.rows.back()));
        part.rows.pop_back();
      }
  return whole;
}

}  // namespace

int merge_measurements(const ShardSet& set, const MergeOptions& options, JsonWriter& json) {
  for (const ShardSet::Twins& twins : set.twins()) require_copies(twins);
  const Measurement whole = merged(set);
  if (std::ranges::none_of(whole.rows, &Row::was_run)) {
    complain("nothing was measured: no method applies, or every run is too long (--full)");
    return kFailed;
  }
  ReportFolder folder(options.output, "measure");
  folder.write(kRowsFile, report::to_json(whole));
  save_pages(folder, whole,
             {set.run().settings.at("all problems") == "yes", set.run().settings.at("theme"),
              options.backend});
  folder.finish();
  json.line().member("rows", whole.rows.size());
  if (!options.json) print(to_table(whole));
  say(fmt::format("the report of {} shards is in {}", set.run().shard.of, options.output));
  return kGood;
}

}  // namespace lantern::app
