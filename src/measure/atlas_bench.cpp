#include "measure/atlas_bench.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "base/clock.hpp"
#include "base/error.hpp"
#include "base/stop.hpp"
#include "measure/atlas_contest.hpp"
#include "measure/timed.hpp"

namespace lantern::measure {
namespace {

constexpr double kTurnSeconds = 0.004;  // of calls in one turn
constexpr double kSearchSeconds = 1.0;  // that searches of one contestant are timed at a set
constexpr std::size_t kLeastSearches = 3;
constexpr int kLargestSide = 65536;

// One contestant at one set, on its way.
struct Entry {
  AtlasRow row;
  std::unique_ptr<TexturePacker> packer;
  std::size_t calls = 1;  // of a turn
  std::vector<double> packing, searching;
  double searched = 0;  // seconds, all together
};

int first_side(const TextureSet& set) {
  double area = 0;
  for (const TextureSize& size : set.sizes) area += static_cast<double>(size.width) * size.height;
  return static_cast<int>(std::ceil(std::sqrt(area)));
}
int next_side(int side) { return std::max(side + 1, static_cast<int>(std::ceil(1.002 * side))); }

// The smallest square's side; 0 if there is none, or if it takes more seconds than `longest`.
int search(TexturePacker& packer, int side, double longest, std::uint64_t& tried) {
  const CpuStopwatch watch;
  for (tried = 1; side <= kLargestSide; side = next_side(side), ++tried) {
    if (packer.pack(side, side)) return side;
    stop_if_asked();
    if (watch.seconds() > longest) return 0;
  }
  return 0;
}

Entry entered(const AtlasPeer& contestant, const TextureSet& set, const AtlasBenchConfig& config) {
  Entry e;
  e.row.set = set.name;
  e.row.textures = set.sizes.size();
  e.row.contestant = contestant.name;
  e.row.version = contestant.version;
  e.packer = contestant.start(set.sizes);
  if (config.atlas) {
    e.row.width = config.atlas->width;
    e.row.height = config.atlas->height;
  } else {
    e.row.width = e.row.height = search(*e.packer, first_side(set), config.longest, e.row.sides);
    if (e.row.width == 0) {
      e.row.status = "left out";
      e.row.reason = fmt::format("no square of up to {} pixels each way after {:g} s", kLargestSide,
                                 config.longest);
      return e;
    }
  }
  const std::uint64_t before = e.packer->leaf_tests();
  const CpuStopwatch watch;
  e.packer->pack(e.row.width, e.row.height);
  e.calls = static_cast<std::size_t>(
      std::clamp(kTurnSeconds / std::max(watch.seconds(), 1e-7), 1.0, 1e4));
  e.row.leaf_tests = e.packer->leaf_tests() - before;
  e.row.bytes = e.packer->bytes();
  check_layout(set.sizes, e.packer->places(), e.row);
  return e;
}

void take_turn(Entry& e, const TextureSet& set, const AtlasBenchConfig& config) {
  if (e.row.status != "ok") return;
  const CpuStopwatch watch;
  for (std::size_t call = 0; call < e.calls; ++call) {
    stop_if_asked();
    e.packer->pack(e.row.width, e.row.height);
  }
  e.packing.push_back(watch.seconds() / static_cast<double>(e.calls));
  if (config.atlas || (e.searched > kSearchSeconds && e.searching.size() >= kLeastSearches)) return;
  const CpuStopwatch all;
  search(*e.packer, first_side(set), config.longest, e.row.sides);
  e.searching.push_back(all.seconds());
  e.searched += e.searching.back();
}

std::vector<TextureSet> sets_of(const AtlasBenchConfig& config) {
  if (config.own) return {*config.own};
  std::vector<std::string_view> names(config.sets.begin(), config.sets.end());
  if (names.empty()) names = texture_set_names();
  std::vector<TextureSet> sets;
  for (const std::string_view name : names)
    for (const std::uint64_t count : config.counts)
      sets.push_back(texture_set(name, count, config.seed));
  return sets;
}

}  // namespace

std::size_t atlas_bench_stages(const AtlasBenchConfig& config) {
  if (config.own) return 1;
  return (config.sets.empty() ? texture_set_names().size() : config.sets.size()) *
         config.counts.size();
}

void bench_atlases(AtlasBenchResult& result, const AtlasBenchWatch& watch) {
  const AtlasBenchConfig& config = result.config;
  const std::vector<AtlasPeer> contestants = atlas_contestants(config, result.missing);
  for (const AtlasPeer& c : contestants) result.contestants.push_back({c.name, c.version, c.how});
  std::size_t stage = 0;
  for (const TextureSet& set : sets_of(config)) {
    watch(stage++, set);
    std::vector<Entry> entries;
    for (const AtlasPeer& contestant : contestants)
      entries.push_back(entered(contestant, set, config));
    for (int round = 0; round < config.rounds; ++round)
      for (Entry& e : entries) take_turn(e, set, config);
    for (Entry& e : entries) {
      e.row.timing = timing_of(e.packing);
      e.row.searching = timing_of(e.searching);
      result.rows.push_back(std::move(e.row));
    }
  }
}

const AtlasRow* fullest_peer(const std::vector<AtlasRow>& rows, const AtlasRow& at) {
  const AtlasRow* best = nullptr;
  for (const AtlasRow& row : rows) {
    if (!row.is_peer() || row.status != "ok" || row.set != at.set || row.textures != at.textures)
      continue;
    if (!best ||
        std::pair(-row.fill, row.timing.median) < std::pair(-best->fill, best->timing.median))
      best = &row;
  }
  return best;
}

}  // namespace lantern::measure
