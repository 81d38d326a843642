// The sets of textures that atlases are measured with, and those of a user's own file.
#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/number.hpp"
#include "base/random.hpp"
#include "base/suggest.hpp"
#include "language/text/problems.hpp"
#include "measure/atlas_bench.hpp"
#include "measure/csv_file.hpp"

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
  int value = 0;
  const char* end = cell.text.data() + cell.text.size();
  const auto [at, error] = std::from_chars(cell.text.data(), end, value);
  if (error != std::errc() || at != end)
    csv.fail(cell.column, fmt::format("{} is no whole number of pixels", in_quotes(cell.text)),
             kLineAdvice);
  if (value < 1 || value > kLongestSide)
    csv.fail(cell.column, fmt::format("{} pixels", value),
             fmt::format("a texture has 1 to {} pixels each way", kLongestSide));
  return value;
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

}  // namespace

const std::vector<std::string_view>& texture_set_names() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> all;
    for (const SetDoc& doc : kSets) all.push_back(doc.name);
    return all;
  }();
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

TextureSet read_texture_sizes(const std::filesystem::path& file) {
  const std::string text = read_input(file, kMostSizesBytes);
  TextureSet set{file.stem().string(), sizes_in(CsvFile(file.string(), text))};
  if (set.sizes.empty())
    throw Refused(fmt::format("{}: it has no texture; a line is WIDTH,HEIGHT", file.string()));
  return set;
}

}  // namespace lantern::measure
