// The sets of textures that atlases are measured with, and those of a user's own file.
#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include <fmt/format.h>

#include "base/counted.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "base/random.hpp"
#include "base/stop.hpp"
#include "base/suggest.hpp"
#include "measure/atlas_bench.hpp"
#include "scenario/source_text.hpp"

namespace lantern::measure {
namespace {

constexpr std::size_t kMostSizesBytes = std::size_t{256} << 20;
constexpr int kLongestSide = 65536;  // pixels

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

class SizesReader {
 public:
  SizesReader(std::string file, std::string_view text) : file_(std::move(file)), text_(text) {}

  std::vector<TextureSize> read() {
    std::vector<TextureSize> sizes;
    for (std::string_view rest = without_mark(text_); !rest.empty();) {
      stop_if_asked();
      const std::size_t end = rest.find('\n');
      read_line(rest.substr(0, end), sizes);
      rest = end == rest.npos ? std::string_view() : rest.substr(end + 1);
    }
    return sizes;
  }

 private:
  struct Cell {
    std::string_view text;
    int column = 1;
  };

  [[noreturn]] void fail(int column, std::string message, std::string advice) const {
    throw ScenarioError(Diagnostic{
        {file_, line_, column}, std::move(message), line_of(text_, line_), std::move(advice)});
  }

  static std::vector<Cell> cells_of(std::string_view line) {
    constexpr std::string_view kSpace = " \t\r\"";
    std::vector<Cell> cells;
    for (std::size_t at = 0;;) {
      const std::size_t end = std::min(line.find_first_of(",;", at), line.size());
      const std::string_view cell = line.substr(at, end - at);
      const std::size_t first = std::min(cell.find_first_not_of(kSpace), cell.size());
      const std::size_t last = cell.find_last_not_of(kSpace);
      cells.push_back(
          {first == cell.size() ? std::string_view() : cell.substr(first, last + 1 - first),
           static_cast<int>(at + first) + 1});
      if (end == line.size()) return cells;
      at = end + 1;
    }
  }

  void read_line(std::string_view line, std::vector<TextureSize>& sizes) {
    ++line_;
    const std::vector<Cell> cells = cells_of(line);
    if (cells.size() == 1 && (cells[0].text.empty() || cells[0].text[0] == '#')) return;
    if (!cells[0].text.empty() && cells[0].text[0] == '#') return;
    const bool first = !std::exchange(begun_, true);
    if (cells.size() != 2)
      fail(cells.back().column,
           fmt::format("{}, where 2 are expected", counted(cells.size(), "value")),
           "a texture is a line WIDTH,HEIGHT in pixels: 64,32");
    if (first && !cells[0].text.empty() && !is_digit(cells[0].text[0]) && cells[0].text[0] != '-')
      return name_columns(cells);
    const int one = number(cells[0]), other = number(cells[1]);
    sizes.push_back(height_first_ ? TextureSize{other, one} : TextureSize{one, other});
  }

  static bool is_digit(char c) { return c >= '0' && c <= '9'; }

  void name_columns(const std::vector<Cell>& cells) {
    constexpr std::array<std::string_view, 2> kColumns{"width", "height"};
    for (const Cell& cell : cells)
      if (std::ranges::find(kColumns, cell.text) == kColumns.end())
        fail(cell.column, fmt::format("unknown column {}", in_quotes(cell.text)),
             suggestion(cell.text, kColumns));
    if (cells[0].text == cells[1].text)
      fail(cells[1].column, fmt::format("column '{}' is there twice", cells[1].text),
           "the columns are width and height");
    height_first_ = cells[0].text == "height";
  }

  int number(const Cell& cell) const {
    int value = 0;
    const char* end = cell.text.data() + cell.text.size();
    const auto [at, error] = std::from_chars(cell.text.data(), end, value);
    if (error != std::errc() || at != end)
      fail(cell.column, fmt::format("{} is no whole number of pixels", in_quotes(cell.text)),
           "a texture is a line WIDTH,HEIGHT in pixels: 64,32");
    if (value < 1 || value > kLongestSide)
      fail(cell.column, fmt::format("{} pixels", value),
           fmt::format("a texture has 1 to {} pixels each way", kLongestSide));
    return value;
  }

  std::string file_;
  std::string_view text_;
  int line_ = 0;
  bool begun_ = false;
  bool height_first_ = false;
};

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
  TextureSet set{file.stem().string(), SizesReader(file.string(), text).read()};
  if (set.sizes.empty())
    throw Refused(fmt::format("{}: it has no texture; a line is WIDTH,HEIGHT", file.string()));
  return set;
}

}  // namespace lantern::measure
