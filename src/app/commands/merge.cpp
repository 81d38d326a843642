#include "app/merge.hpp"

#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "app/answer.hpp"
#include "app/commands/command.hpp"
#include "app/shard_set.hpp"
#include "app/terminal.hpp"
#include "base/file.hpp"
#include "base/json_writer.hpp"

namespace lantern::app {
namespace {

struct MergeOptions {
  std::string output;                // folder of the whole
  std::vector<std::string> folders;  // that shards wrote into; empty: the same
  bool json = false;
};

Options merge_options(MergeOptions& o) {
  return {{"OUT", &o.output, "folder of the whole", {.required = true}},
          {"IN", &o.folders, "folders that shards wrote into with -o; the default is OUT"},
          json_option(o.json)};
}

// The whole would stand where a part of it does.
void require_apart(const ShardSet& set, const std::string& output) {
  std::error_code none;
  if (!std::filesystem::is_directory(output, none)) return;
  const Folder whole(output);
  for (const FoundShard* shard : set.shards())
    if (shard != nullptr && shard->folder.is(whole))
      throw UsageError(fmt::format("'{}' is the folder of shard {}; give another one for the whole",
                                   output, shard->record.shard.text()));
}

int merge_parts(const MergeOptions& options) {
  const ShardSet set(options.folders.empty() ? std::vector{options.output} : options.folders);
  require_apart(set, options.output);
  const std::vector<std::string> missing = set.missing();
  for (const std::string& sentence : missing) complain(sentence);
  JsonWriter json = answer_of("merge");
  json.lines("command", "render", "shards", set.run().shard.of, "merged", missing.empty());
  json.line().key("missing").begin_array();
  for (std::uint32_t i = 0; i < set.shards().size(); ++i)
    if (set.shards()[i] == nullptr) json.value(i + 1);
  json.end_array();
  const int code = missing.empty() ? merge_frames(set, options.output, json) : int{kFailed};
  json.line().end_object();
  if (options.json) answer(json.text());
  return code;
}

}  // namespace

UnfitShard::UnfitShard(const ShardSet& set, const FoundShard& shard, const std::string& what)
    : runtime_error(fmt::format("shard {} in '{}': {}: {}", shard.record.shard.text(),
                                shard.folder.path().string(), what,
                                set.advice(shard.record.shard))) {}

Command merge_command() {
  return command("merge", "Make one folder of the parts that --shard has made", merge_parts,
                 merge_options);
}

}  // namespace lantern::app
