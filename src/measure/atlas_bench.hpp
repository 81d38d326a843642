// How full an atlas becomes and how long that takes: ours by its rules, and other packers, at the
// same textures in the same run, in turns.
#pragma once

#include <filesystem>

#include "measure/atlas_peer.hpp"
#include "measure/row.hpp"

namespace lantern::measure {

// A set of textures: widths and heights that are drawn one after the other, both seeded.
struct TextureSet {
  std::string name;
  std::vector<TextureSize> sizes;
};

// "square", "powers", "tall", "glyphs".
const std::vector<std::string_view>& texture_set_names();
std::string texture_set_words(std::string_view name);  // empty for one that is none of them
// Throws Refused for a name that is none. At least one texture.
TextureSet texture_set(std::string_view name, std::size_t count, std::uint64_t seed);

// CSV: a width and a height a line, in pixels from 1 to 65536. The first line may name the columns
// width and height, in any order. Empty lines and those that begin with # are passed over. Throws
// ScenarioError with file, line and column, IoError for what cannot be read, Refused for a file
// without sizes.
TextureSet read_texture_sizes(const std::filesystem::path& file);

struct AtlasBenchConfig {
  std::vector<std::string> sets;                 // names; empty for all
  std::vector<std::uint64_t> counts{500, 5000};  // textures of each set
  std::optional<TextureSet> own;                 // a user's own, measured instead of sets
  std::optional<TextureSize> atlas;              // of this size; else the smallest square
  std::vector<std::string> only;                 // contestants; empty for all
  bool peers = true;
  int rounds = 15;
  std::uint64_t seed = 1;
  // Processor seconds of a search for the smallest square: who needs more is left out.
  double longest = 10;
};

// One contestant at one set.
struct AtlasRow {
  std::string set;
  std::uint64_t textures = 0;
  std::string contestant;
  std::string version;        // of a peer; empty for ours
  std::string status = "ok";  // wrong, left out, refused
  std::string reason;         // of any other status
  int width = 0, height = 0;  // of the atlas: the smallest square that all fit, or as asked
  double fill = 0;            // share of it that lies under textures
  std::uint64_t packed = 0;   // textures
  std::uint64_t turned = 0;
  Timing timing;                 // seconds of one packing into that atlas
  Timing searching;              // of the whole search for the smallest square
  std::uint64_t sides = 0;       // that were tried in the search
  std::uint64_t leaf_tests = 0;  // in one packing into that atlas; ours alone
  std::uint64_t bytes = 0;       // that it holds then
  // Of the layout, each texture compared with each that is near: all 0, or the status is "wrong".
  std::uint64_t overlaps = 0, outside = 0, wrong_sizes = 0;

  bool is_peer() const { return !version.empty(); }
};

using AtlasBenchResult = BenchResult<AtlasBenchConfig, AtlasRow>;

// Told before each set.
using AtlasBenchWatch = std::function<void(std::size_t stage, const TextureSet& set)>;
std::size_t atlas_bench_stages(const AtlasBenchConfig& config);

// The smallest square: sides from the square root of the textures' area up, each 0.2 % longer than
// the last, at least by one, until all fit. Each contestant looks for its own. Then, in turns, one
// packing into that square and one search are timed, in seconds of the processor; each turn as many
// calls as fill some milliseconds. Throws Refused for names that are none, and Stopped.
void bench_atlases(AtlasBenchResult& result, const AtlasBenchWatch& watch);

// The fullest peer at the set of a row (of equally full ones the quickest), and null if there is
// none.
const AtlasRow* fullest_peer(const std::vector<AtlasRow>& rows, const AtlasRow& at);

// Counts overlaps, textures that lie outside, and sizes that are not theirs, and fills in what else
// is known of a layout.
void check_layout(std::span<const TextureSize> sizes,
                  std::span<const std::optional<TexturePlace>> places, AtlasRow& row);

}  // namespace lantern::measure
