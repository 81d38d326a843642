#include "measure/atlas_bench.hpp"

#include <numeric>

#include "atlas/atlas.hpp"
#include "base/file.hpp"
#include "base/number.hpp"
#include "base/random.hpp"
#include "measure/csv_file.hpp"
#include "measure/solvers.hpp"

namespace lantern::measure {
namespace {

constexpr std::size_t kMostSizesBytes = std::size_t{256} << 20;
constexpr int kLongestSide = 65536;  // pixels
constexpr const char* kLineAdvice = "a texture is a line WIDTH,HEIGHT in pixels: 64,32";

struct SetDoc {
  std::string_view name, words;
  TextureSize least, most;
  bool powers = false;  // of two, by exponents
};
constexpr SetDoc kSets[] = {
    {"square", "width and height 1 ... 64", {1, 1}, {64, 64}},
    {"powers", "width and height powers of two, 1 ... 64", {0, 0}, {6, 6}, true},
    {"tall", "width 2 ... 9, height 10 ... 209", {2, 10}, {9, 209}},
    {"glyphs", "width 6 ... 19, height 12 ... 21", {6, 12}, {19, 21}},
};

int pixels_in(const CsvFile& csv, const CsvCell& cell) {
  const auto value = number_in<int>(cell.text);
  if (!value)
    csv.fail(cell.column, fmt::format("{} is no whole number of pixels", in_quotes(cell.text)),
             kLineAdvice);
  if (*value < 1 || *value > kLongestSide)
    csv.fail(cell.column, fmt::format("{} pixels", *value),
             fmt::format("a texture has 1 to {} pixels each way", kLongestSide));
  return *value;
}

std::vector<TextureSize> sizes_in(CsvFile csv) {
  constexpr std::array<std::string_view, 2> kColumns{"width", "height"};
  std::vector<TextureSize> sizes;
  std::vector<std::size_t> columns;
  csv.each_line([&](const std::vector<CsvCell>& cells) {
    if (cells.size() != 2)
      csv.fail(cells.back().column,
               fmt::format("{}, where 2 are expected", counted(cells.size(), "value")),
               kLineAdvice);
    if (columns.empty()) {
      const char begins = cells[0].text.empty() ? '-' : cells[0].text[0];
      const bool is_number = begins == '-' || (begins >= '0' && begins <= '9');
      columns = is_number ? std::vector<std::size_t>{0, 1}
                          : csv.named(cells, kColumns, "the columns are width and height");
      if (!is_number) return;
    }
    std::array<int, 2> size{};
    for (std::size_t i = 0; i < 2; ++i) size[columns[i]] = pixels_in(csv, cells[i]);
    sizes.push_back({size[0], size[1]});
  });
  return sizes;
}

using Places = std::vector<std::optional<TexturePlace>>;

struct Packed {
  bool all = true;
  Places places;
  std::uint64_t leaf_tests = 0, bytes = 0;
};

// One of our rules, whatever it is.
class OwnPacker : public TexturePacker {
 public:
  using Rule = std::function<Packed(std::span<const TextureSize>, const Rect& atlas)>;
  OwnPacker(std::span<const TextureSize> sizes, Rule rule)
      : sizes_(sizes.begin(), sizes.end()), rule_(std::move(rule)) {}

  bool pack(int width, int height) override {
    last_ = rule_(sizes_, {0, 0, width, height});
    leaf_tests_ += last_.leaf_tests;
    return last_.all;
  }
  Places places() const override { return last_.places; }
  std::uint64_t leaf_tests() const override { return leaf_tests_; }
  std::uint64_t bytes() const override {
    return last_.bytes + last_.places.capacity() * sizeof(Places::value_type);
  }

 private:
  std::vector<TextureSize> sizes_;
  Rule rule_;
  Packed last_;
  std::uint64_t leaf_tests_ = 0;
};

Packed first_fit(std::span<const TextureSize> sizes, const Rect& leaf, bool partly) {
  std::vector<TextureId> order(sizes.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::sort(order, std::greater(), [&](TextureId id) {
    return std::tuple(sizes[id].height, sizes[id].width, ~id);
  });
  Packed packed;
  packed.places.resize(sizes.size());
  Atlas atlas(leaf.width, leaf.height);
  for (const TextureId id : order) {
    if (const auto rect = atlas.insert(id, sizes[id].width, sizes[id].height))
      packed.places[id] = TexturePlace{*rect, false};
    else
      packed.all = false;
    if (!packed.all && !partly) break;
  }
  packed.leaf_tests = atlas.leaf_tests();
  packed.bytes = atlas.bytes();
  return packed;
}

Packed best_texture(std::span<const TextureSize> sizes, const Rect& leaf, bool turn, bool partly) {
  Packer packer(sizes, turn);
  const Packing packing = partly ? packer.pack_most({&leaf, 1}) : packer.pack({&leaf, 1});
  Packed packed;
  packed.all = packing.complete;
  if (packed.all || partly) packed.places = places_of(packing, {&leaf, 1}, sizes.size());
  packed.leaf_tests = packing.leaf_tests;
  packed.bytes = packer.bytes() + packing.steps.capacity() * sizeof(PackStep);
  return packed;
}

constexpr PeerModule kAtlasModules[] = {
    {"stb_rect_pack", "lantern_peer_atlas_stb.so", "libstb-dev"},
};

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
  return static_cast<int>(std::ceil(std::sqrt(sum_of<double>(
      set.sizes, [](const TextureSize& s) { return static_cast<double>(s.width) * s.height; }))));
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

// Ours: the taught rule with the tallest texture first; leaves that choose; the same with textures
// turned. `partly`: what has no place is left out; otherwise packing ends as soon as it is known
// that not all have one.
std::vector<AtlasPeer> own_atlas_packers(bool partly) {
  const auto by = [](OwnPacker::Rule rule) {
    return [rule = std::move(rule)](std::span<const TextureSize> sizes) {
      return std::make_unique<OwnPacker>(sizes, rule);
    };
  };
  const auto choosing = [&](bool turn) {
    return by(
        [=](auto sizes, const Rect& atlas) { return best_texture(sizes, atlas, turn, partly); });
  };
  return {{"first_fit", "", "the taught rule: the tallest first, each into the first leaf it fits",
           by([=](auto sizes, const Rect& atlas) { return first_fit(sizes, atlas, partly); })},
          {"best_texture", "", "each free leaf chooses the texture that leaves least of it",
           choosing(false)},
          {"best_texture:turn", "", "the same, and textures may be turned by 90 degrees",
           choosing(true)}};
}

// Those that `config` asks for, ours first; a line in `missing` for each module that is not there.
// Throws Refused for names that are none.
std::vector<AtlasPeer> atlas_contestants(const AtlasBenchConfig& config,
                                         std::vector<std::string>& missing) {
  std::vector<AtlasPeer> all = own_atlas_packers(config.atlas.has_value());
  if (config.peers)
    for (AtlasPeer& peer : peers_of<AtlasPeer>(kAtlasModules, "lantern_atlas_peers", missing))
      all.push_back(std::move(peer));
  keep_asked_for(all, config.only, missing, [](const AtlasPeer& one) { return one.name; });
  return all;
}

}  // namespace

// The sets of textures that atlases are measured with, and those of a user's own file.

const std::vector<std::string_view>& texture_set_names() {
  static const std::vector<std::string_view> names = mapped(kSets, &SetDoc::name);
  return names;
}

std::string texture_set_words(std::string_view name) {
  const auto doc = std::ranges::find(kSets, name, &SetDoc::name);
  return doc == std::end(kSets) ? std::string() : std::string(doc->words) + ", evenly spread";
}

TextureSet texture_set(std::string_view name, std::size_t count, std::uint64_t seed) {
  const auto doc = std::ranges::find(kSets, name, &SetDoc::name);
  if (doc == std::end(kSets))
    throw Refused(
        with_suggestion(fmt::format("there is no set '{}'", name), name, texture_set_names()));
  TextureSet set{std::string(name), {}};
  Random random(seed);
  for (std::size_t i = 0; i < count; ++i) {
    const auto width = static_cast<int>(random.whole(doc->least.width, doc->most.width));
    const auto height = static_cast<int>(random.whole(doc->least.height, doc->most.height));
    set.sizes.push_back(doc->powers ? TextureSize{1 << width, 1 << height}
                                    : TextureSize{width, height});
  }
  return set;
}

TextureSet read_texture_sizes(const fs::path& file) {
  const std::string text = read_input(file, kMostSizesBytes);
  TextureSet set{file.stem().string(), sizes_in(CsvFile(file.string(), text))};
  if (set.sizes.empty())
    throw Refused("{}: it has no texture; a line is WIDTH,HEIGHT", file.string());
  return set;
}

// --- who packs, and what makes a layout right ---

void check_layout(std::span<const TextureSize> sizes,
                  std::span<const std::optional<TexturePlace>> places, AtlasRow& row) {
  std::vector<Rect> rects;
  std::int64_t area = 0;
  for (std::size_t i = 0; i < std::min(sizes.size(), places.size()); ++i) {
    if (!places[i]) continue;
    const auto& [r, turned] = *places[i];
    rects.push_back(r);
    area += std::int64_t{r.width} * r.height;
    row.turned += turned;
    row.wrong_sizes +=
        sizes[i] != (turned ? TextureSize{r.height, r.width} : TextureSize{r.width, r.height});
    row.outside += r.x < 0 || r.y < 0 || r.x + r.width > row.width || r.y + r.height > row.height;
  }
  row.packed = rects.size();
  row.fill = static_cast<double>(area) / (static_cast<double>(row.width) * row.height);
  // Sorted by x, only those that begin before a texture ends can lie over it.
  std::ranges::sort(rects, {}, &Rect::x);
  for (std::size_t i = 0; i < rects.size(); ++i) {
    stop_if_asked();
    const Rect& a = rects[i];
    for (std::size_t j = i + 1; j < rects.size() && rects[j].x < a.x + a.width; ++j)
      row.overlaps += rects[j].y < a.y + a.height && a.y < rects[j].y + rects[j].height;
  }
  if (row.overlaps + row.outside + row.wrong_sizes == 0) return;
  row.status = "wrong";
  row.reason = fmt::format("{} overlaps, {} outside, {} of another size", row.overlaps, row.outside,
                           row.wrong_sizes);
}

// --- the rounds ---

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
    std::vector<Entry> entries = mapped(
        contestants, [&](const AtlasPeer& contestant) { return entered(contestant, set, config); });
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
