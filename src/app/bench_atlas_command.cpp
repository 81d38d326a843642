#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "app/answer.hpp"
#include "app/commands.hpp"
#include "app/interrupts.hpp"
#include "app/progress.hpp"
#include "app/report_folder.hpp"
#include "app/selection.hpp"
#include "app/terminal.hpp"
#include "base/stop.hpp"
#include "embedded/version.hpp"
#include "report/bench_atlas.hpp"

namespace lantern::app {
namespace {

constexpr int kLargestAtlas = 65536;  // pixels on one side

AtlasBenchConfig config_of(const BenchAtlasOptions& options) {
  AtlasBenchConfig config;
  config.sets = options.sets;
  for (const std::string& name : options.sets) texture_set(name, 1, 1);  // is there one?
  if (!options.counts.empty()) config.counts = options.counts;
  if (!options.sizes.empty()) config.own = read_texture_sizes(options.sizes);
  if (!options.atlas.empty()) {
    const auto [width, height] = parse_size(options.atlas, kLargestAtlas);
    config.atlas = TextureSize{width, height};
  }
  config.only = options.only;
  config.peers = options.peers;
  config.rounds = options.rounds;
  config.seed = options.seed;
  return config;
}

// As it would be typed.
std::string command_text(const BenchAtlasOptions& options) {
  std::string text = "lantern bench atlas";
  for (const std::string& name : options.sets) text += " --set " + name;
  for (const std::uint64_t count : options.counts) text += fmt::format(" --count {}", count);
  if (!options.sizes.empty()) text += " --sizes " + options.sizes;
  if (!options.atlas.empty()) text += " --size " + options.atlas;
  for (const std::string& name : options.only) text += " --only " + name;
  if (!options.peers) text += " --no-peers";
  return text + fmt::format(" --rounds {} --seed {}", options.rounds, options.seed);
}

AtlasBenchResult prepared(const BenchAtlasOptions& options) {
  try {
    AtlasBenchResult result;
    result.config = config_of(options);
    result.command = command_text(options);
    result.circumstances = here(kVersion, kSourceHash);
    return result;
  } catch (const Refused& refused) {
    throw UsageError(refused.what());
  }
}

}  // namespace

int bench_atlas_command(const BenchAtlasOptions& options) {
  AtlasBenchResult result = prepared(options);
  ReportFolder folder(options.output, "bench_atlas");
  const std::size_t stages = atlas_bench_stages(result.config);
  try {
    Progress progress("bench atlas", stages, "sets");
    bench_atlases(result, [&](std::size_t stage, const TextureSet& set) {
      progress.tell(fmt::format("set {} of {}, {}: {} textures", stage + 1, stages, set.name,
                                set.sizes.size()));
    });
  } catch (const Stopped&) {
    give_time_to_save();  // sets that are done are reported
  } catch (const Refused& refused) {
    throw UsageError(refused.what());
  }
  for (const std::string& missing : result.missing) say(missing);
  folder.write("bench_atlas.html", to_html(result));
  folder.write("bench_atlas.csv", to_csv(result));
  folder.write("bench_atlas.json", to_json(result));
  options.json ? answer(to_json(result)) : print(to_table(result));
  if (interrupted()) {
    complain("interrupted; the sets that were done have been reported");
    return kInterrupted;
  }
  folder.finish();
  const bool good =
      std::ranges::none_of(result.rows, [](const AtlasRow& row) { return row.status == "wrong"; });
  return good ? kGood : kFailed;
}

}  // namespace lantern::app
