#include "app/shard_set.hpp"

#include <algorithm>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "app/terminal.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "embedded/version.hpp"

namespace lantern::app {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostRecordBytes = std::size_t{16} << 20;

bool is_named_as_a_shard(const fs::path& folder) {
  const std::string name = folder.filename().string();
  return name.starts_with("shard-") && name.find("-of-") != name.npos;
}

}  // namespace

ShardSet::ShardSet(const std::vector<std::string>& folders) {
  for (const std::string& folder : folders) look_into(folder);
  require_one_run();
  sort_by_number();
}

void ShardSet::look_into(const fs::path& folder) {
  const std::size_t before = found_.size();
  std::error_code error;
  if (fs::exists(folder / kShardFile, error)) take(folder);
  std::vector<fs::path> inside;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
    if (is_named_as_a_shard(it->path())) inside.push_back(it->path());
  std::ranges::sort(inside);
  for (const fs::path& path : inside)
    if (fs::exists(path / kShardFile, error)) take(path);
  if (found_.size() == before)
    throw UsageError(fmt::format(
        "'{}' holds no shard; give folders that a run with --shard wrote into", folder.string()));
}

// A folder that is named twice counts once.
void ShardSet::take(const fs::path& folder) {
  std::error_code error;
  for (const FoundShard& one : found_)
    if (fs::equivalent(one.path, folder, error)) return;
  auto record = read_record(read_file(folder / kShardFile, kMostRecordBytes));
  if (!record)
    throw UsageError(fmt::format("'{}' is no record of a shard that this Lantern can read",
                                 (folder / kShardFile).string()));
  found_.push_back({folder, std::move(*record)});
}

void ShardSet::require_one_run() const {
  const FoundShard& first = found_.front();
  for (const FoundShard& one : found_)
    if (const auto words = difference(first.record, one.record))
      throw UsageError(fmt::format("'{}' and '{}' are no parts of one run: {}", first.path.string(),
                                   one.path.string(), *words));
  const auto require_ours = [&](const char* what, std::string_view theirs, std::string_view ours) {
    if (theirs != ours)
      throw UsageError(
          fmt::format("'{}' was made by another Lantern: its {} is {}, this one's {}; "
                      "merge with the Lantern that made it, or make it again",
                      first.path.string(), what, theirs, ours));
  };
  require_ours("version", run().version, kVersion);
  require_ours("source hash", run().sources, kSourceHash);
}

void ShardSet::sort_by_number() {
  shards_.resize(run().shard.of);
  for (const FoundShard& one : found_) {
    if (!one.record.finished) continue;
    const FoundShard*& place = shards_[one.record.shard.number - 1];
    if (place != nullptr)
      twins_.push_back({place, &one});
    else
      place = &one;
  }
}

// Of what the shard is one: "pong_bsp", "pong_bsp and 3 more".
std::string ShardSet::names() const {
  const auto& inputs = run().inputs;
  if (inputs.empty()) return run().command;
  const std::string more =
      inputs.size() > 1 ? fmt::format(" and {} more", inputs.size() - 1) : std::string();
  return inputs.front().name + more;
}

std::vector<std::string> ShardSet::missing() const {
  std::vector<std::string> sentences;
  for (std::uint32_t i = 0; i < shards_.size(); ++i) {
    if (shards_[i] != nullptr) continue;
    const Shard shard{i + 1, run().shard.of};
    const auto begun = std::ranges::find_if(
        found_, [&](const FoundShard& one) { return one.record.shard == shard; });
    const std::string what = begun == found_.end()
                                 ? std::string("is missing")
                                 : fmt::format("in '{}' is not finished", begun->path.string());
    sentences.push_back(
        fmt::format("shard {} of {} {}: {}", shard.text(), names(), what, advice(shard)));
  }
  return sentences;
}

std::string ShardSet::advice(const Shard& shard) const {
  // Its own words, if it has begun: its output may be another.
  const auto begun = std::ranges::find_if(
      found_, [&](const FoundShard& one) { return one.record.shard == shard; });
  const ShardRecord& record = begun == found_.end() ? run() : begun->record;
  return "run " + command_for(record.words, shard);
}

}  // namespace lantern::app
