#include "app/shard_set.hpp"

#include <algorithm>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "app/json_members.hpp"
#include "app/terminal.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "embedded/version.hpp"

namespace lantern::app {
namespace {

constexpr std::size_t kMostRecordBytes = std::size_t{16} << 20;

// "shard-2-of-4", and not what somebody has written down beside it.
bool is_named_as_a_shard(std::string_view name) {
  constexpr std::string_view kStart = "shard-", kMiddle = "-of-", kDigits = "0123456789";
  if (!name.starts_with(kStart)) return false;
  name.remove_prefix(kStart.size());
  const std::size_t middle = std::min(name.find_first_not_of(kDigits), name.size());
  const std::string_view rest = name.substr(middle);
  return middle > 0 && rest.starts_with(kMiddle) && rest.size() > kMiddle.size() &&
         rest.find_first_not_of(kDigits, kMiddle.size()) == rest.npos;
}

}  // namespace

ShardSet::ShardSet(const std::vector<std::string>& folders) {
  for (const std::string& folder : folders) look_into(folder);
  require_one_run();
  sort_by_number();
}

void ShardSet::look_into(const std::string& path) {
  bool holds_some = false;
  const auto look = [&](const Folder& folder) {
    if (!folder.has(kShardFile)) return;
    take(folder);
    holds_some = true;
  };
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    const Folder folder(path);
    look(folder);
    for (const std::string& name : folder.names()) {
      if (!is_named_as_a_shard(name)) continue;
      const auto inside = folder.find(name);
      if (inside) look(*inside);
    }
  }
  if (!holds_some)
    throw UsageError(
        fmt::format("'{}' holds no shard; give folders that a run with --shard wrote into", path));
}

// A folder that is named twice counts once.
void ShardSet::take(const Folder& folder) {
  for (const FoundShard& one : found_)
    if (one.folder.is(folder)) return;
  try {
    found_.push_back({folder, read_record(*folder.read(kShardFile, kMostRecordBytes))});
  } catch (const RefusedFile& why) {
    throw UsageError(fmt::format("'{}' is no record of a shard that this Lantern can read: {}",
                                 folder.path(kShardFile).string(), why.what()));
  }
}

void ShardSet::require_one_run() const {
  const FoundShard& first = found_.front();
  for (const FoundShard& one : found_)
    if (const auto words = difference(first.record, one.record))
      throw UsageError(fmt::format("'{}' and '{}' are no parts of one run: {}",
                                   first.folder.path().string(), one.folder.path().string(),
                                   *words));
  const auto require_ours = [&](const char* what, std::string_view theirs, std::string_view ours) {
    if (theirs != ours)
      throw UsageError(
          fmt::format("'{}' was made by another Lantern: its {} is {}, this one's {}; "
                      "merge with the Lantern that made it, or make it again",
                      first.folder.path().string(), what, theirs, ours));
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
  if (inputs.empty()) return "a run";
  const std::string more =
      inputs.size() > 1 ? fmt::format(" and {} more", inputs.size() - 1) : std::string();
  return inputs.front().name.text() + more;
}

std::vector<std::string> ShardSet::missing() const {
  std::vector<std::string> sentences;
  for (std::uint32_t i = 0; i < shards_.size(); ++i) {
    if (shards_[i] != nullptr) continue;
    const Shard shard{i + 1, run().shard.of};
    const auto begun = std::ranges::find_if(
        found_, [&](const FoundShard& one) { return one.record.shard == shard; });
    const std::string what = begun == found_.end() ? std::string("is missing")
                                                   : fmt::format("in '{}' is not finished",
                                                                 begun->folder.path().string());
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
