// [map]: bodies as letters of a drawing.
#include <algorithm>
#include <array>
#include <map>

#include <fmt/format.h>

#include "base/printable.hpp"
#include "language/keys/key.hpp"
#include "language/tables/draft.hpp"

namespace lantern::language {
namespace {

struct MapSpec {
  double cell = 1;
};

constexpr std::size_t kNobody = static_cast<std::size_t>(-1);

// One letter of the drawing, and where it stands in the file.
struct MapLetter {
  std::string_view text;
  Place where;
};
using Rows = std::vector<std::vector<MapLetter>>;

// Where the text of a value begins in the file, behind its quotes, if it stands there as it is:
// no \ sequences, no line breaks of another kind. `where` is the place of the quotes.
std::optional<std::size_t> offset_of(std::string_view value, Place where, std::string_view file) {
  std::size_t at = 0;
  for (int line = 1; line < where.line && at != file.npos; ++line) at = file.find('\n', at) + 1;
  for (int column = 1; column < where.column && at < file.size(); ++column)
    at += first_letter(file.substr(at)).bytes;
  if (at >= file.size()) return std::nullopt;
  const std::string_view rest = file.substr(at);
  const std::size_t quotes = rest.starts_with("\"\"\"") || rest.starts_with("'''") ? 3 : 1;
  std::size_t skipped = quotes;
  if (quotes == 3 && rest.substr(quotes).starts_with("\r\n"))
    skipped += 2;
  else if (quotes == 3 && rest.substr(quotes).starts_with('\n'))
    ++skipped;
  if (!rest.substr(std::min(skipped, rest.size())).starts_with(value)) return std::nullopt;
  return at + skipped;
}

// A last line of blanks is none: it indents the closing quotes.
Rows rows_of(std::string_view text, Place where, std::string_view file) {
  const auto offset = offset_of(text, where, file);
  const Place start = offset ? language::place_of(file, *offset) : where;
  Rows rows;
  for (int line = start.line; !text.empty(); ++line) {
    const std::size_t end = text.find('\n');
    std::string_view rest = text.substr(0, end);
    if (rest.ends_with('\r')) rest.remove_suffix(1);
    if (end == text.npos && rest.find_first_not_of(' ') == rest.npos) break;
    std::vector<MapLetter>& row = rows.emplace_back();
    for (int column = rows.size() == 1 ? start.column : 1; !rest.empty(); ++column) {
      const std::size_t bytes = first_letter(rest).bytes;
      row.push_back({rest.substr(0, bytes), offset ? Place{line, column} : where});
      rest.remove_prefix(bytes);
    }
    text.remove_prefix(end == text.npos ? text.size() : end + 1);
  }
  return rows;
}

bool has_any(const TomlTable& table, std::initializer_list<std::string_view> keys) {
  return std::ranges::any_of(keys, [&](std::string_view key) { return entry_of(table, key); });
}

// A prototype as the map uses it.
struct MapKind {
  std::string name;
  const TomlTable* keys = nullptr;
  bool fills = false;   // without a shape of its own it is a box that fills its cells
  bool merges = false;  // and of one that never moves or turns, several cells are one box

  MapKind(const std::string& called, const TomlTable& prototype) : name(called), keys(&prototype) {
    fills = !has_any(prototype, {"radius", "half_size", "capsule", "ground"});
    const auto* truth = value_of<bool>(prototype, "static");
    const auto* word = value_of<std::string>(prototype, "kind");
    merges = fills && ((truth && *truth) || (word && *word == "static")) &&
             !has_any(prototype, {"oriented", "turned", "heading", "spin"});
  }
};

// Cells of one body; rows count from the top.
struct Block {
  std::size_t row = 0, column = 0;
  std::size_t rows = 1, columns = 1;
};

class MapReader {
 public:
  MapReader(const TableReader& table, const MapSpec& spec, Draft& draft)
      : table_(table), draft_(draft), spec_(spec) {
    text_ = table.get<std::string>("rows").value_or("");
    rows_ = rows_of(text_, table.place("rows"), draft.text);
  }

  void read() {
    if (draft_.dimension == 3)
      return table_.bad_key("rows", "a map is for 2D worlds", "use [[pattern]] in a 3D one");
    if (!table_.is_good("legend")) return;
    read_legend();
    if (!table_.is_good("rows") || !is_rectangle() || !read_place()) stand_in();
    resolve();
    for (std::size_t kind = 0; kind < kinds_.size(); ++kind) add_bodies(kind);
  }

 private:
  void read_legend() {
    for (const TomlValue* legend : table_.tables("legend"))
      for (const TomlEntry& e : std::get<TomlTable>(legend->data)) {
        if (letters(e.key) != 1)
          draft_.problems.add(e.where,
                              fmt::format("{} in the legend is not one letter", in_quotes(e.key)),
                              "as legend = { \"#\" = \"wall\" }");
        const auto& name = std::get<std::string>(e.value.data);
        letters_[e.key] = e.where;
        legend_[e.key] = kNobody;
        if (const TomlTable* keys = draft_.prototypes.find(name))
          legend_[e.key] = kind_of(name, *keys);
        else
          draft_.problems.add_unknown(e.value.where, "prototype", name,
                                      [&known = draft_.prototypes] { return known.names(); });
      }
  }

  std::size_t kind_of(const std::string& name, const TomlTable& keys) {
    const auto found = std::ranges::find(kinds_, name, &MapKind::name);
    if (found != kinds_.end()) return static_cast<std::size_t>(found - kinds_.begin());
    kinds_.emplace_back(name, keys);
    return kinds_.size() - 1;
  }

  bool is_rectangle() {
    if (rows_.empty() || rows_[0].empty()) {
      table_.bad_value("rows", "the map is empty", "a letter a cell, a line a row");
      return false;
    }
    bool good = true;
    for (const auto& row : rows_) {
      if (row.size() == rows_[0].size()) continue;
      good = false;
      Place where = row.empty() ? table_.place("rows") : row[0].where;
      if (row.size() > rows_[0].size()) where = row[rows_[0].size()].where;
      draft_.problems.add(where,
                          fmt::format("this line of the map has {} letters, the first has {}",
                                      row.size(), rows_[0].size()),
                          "fill it up with '.'");
    }
    return good;
  }

  // Where its lower left corner is: in the world's, unless said otherwise.
  bool read_place() {
    const Box<3>& world = draft_.scenario.world.bounds;
    const Vec<3> size = spec_.cell * Vec<3>(static_cast<double>(rows_[0].size()),
                                            static_cast<double>(rows_.size()), 0);
    corner_ = table_.get<Vec<3>>("at").value_or(world.lo);
    if (draft_.dimension == 0) return true;
    const double least = 1e-9 * std::max(world.size().x, world.size().y);
    const auto fits = [&](const Vec<3>& room) {
      return size.x <= room.x + least && size.y <= room.y + least;
    };
    if (!fits(world.size())) {
      const double cell = spec_.cell * std::min(world.size().x / size.x, world.size().y / size.y);
      table_.bad_value("rows",
                       fmt::format("the map is {} x {} units, the world {} x {}", size.x, size.y,
                                   world.size().x, world.size().y),
                       fmt::format("it would fit with cell = {:.3g}", cell));
      return false;
    }
    if (corner_.x >= world.lo.x - least && corner_.y >= world.lo.y - least &&
        fits(world.hi - corner_))
      return true;
    table_.bad_value(
        "at", "from here, the map reaches beyond the world",
        fmt::format("it is {} x {} units; 'at' is its lower left corner", size.x, size.y));
    return false;
  }

  // A row of all letters for one that is wrong, so that its bodies are known to those that name
  // them.
  void stand_in() {
    rows_.assign(1, {});
    for (const auto& [letter, where] : letters_) rows_[0].push_back({letter, where});
  }

  // Who stands in each cell. '.' and ' ' are nobody, unless the legend has them.
  void resolve() {
    std::map<std::string_view, std::pair<Place, std::size_t>> unknown;
    for (const auto& row : rows_) {
      std::vector<std::size_t>& kinds = cells_.emplace_back();
      for (const MapLetter& letter : row) {
        const auto found = legend_.find(letter.text);
        kinds.push_back(found == legend_.end() ? kNobody : found->second);
        if (found == legend_.end() && letter.text != "." && letter.text != " ")
          ++unknown.try_emplace(letter.text, letter.where, 0).first->second.second;
      }
    }
    for (const auto& [letter, where] : letters_)
      if (std::ranges::none_of(rows_, [&](const auto& row) {
            return std::ranges::find(row, letter, &MapLetter::text) != row.end();
          }))
        draft_.notice(Warning::letters, draft_.position(where),
                      fmt::format("the letter '{}' stands nowhere in the map", letter),
                      "put it there, or take it out of the legend");
    const auto known =
        mapped(legend_, [](const auto& entry) { return std::string_view(entry.first); });
    for (const auto& [letter, place] : unknown)
      draft_.problems.add(
          place.first,
          fmt::format(
              "the letter '{}' has no prototype{}", letter,
              place.second > 1 ? fmt::format(", here and {} times more", place.second - 1) : ""),
          fmt::format("add it to the legend, or take '.' for nothing; known here: {}",
                      fmt::join(known, " ")));
  }

  // Those of one kind in reading order. Runs of letters in a row are one block, and equal runs in
  // rows one below the other, too.
  std::vector<Block> blocks_of(std::size_t kind) const {
    std::vector<Block> blocks;
    std::map<std::array<std::size_t, 3>, std::size_t> open;  // by column, columns and the row below
    for (std::size_t row = 0; row < cells_.size(); ++row)
      for (std::size_t column = 0; column < cells_[row].size(); ++column) {
        if (cells_[row][column] != kind) continue;
        Block block{row, column};
        while (kinds_[kind].merges && column + 1 < cells_[row].size() &&
               cells_[row][column + 1] == kind)
          ++column, ++block.columns;
        const auto above = open.find({block.column, block.columns, row});
        const bool goes_on = kinds_[kind].merges && above != open.end();
        const std::size_t index = goes_on ? above->second : blocks.size();
        goes_on ? static_cast<void>(++blocks[index].rows) : blocks.push_back(block);
        open[{block.column, block.columns, row + 1}] = index;
      }
    return blocks;
  }

  void add_bodies(std::size_t kind) {
    const std::vector<Block> blocks = blocks_of(kind);
    const std::size_t before = draft_.scenario.bodies.size();
    if (blocks.empty() ||
        !draft_.has_room_for(before + blocks.size(), kMostBodies, "bodies", table_.place("rows")))
      return;
    const MapKind& of = kinds_[kind];
    const NamedRange all{before, blocks.size(), table_.place("rows")};
    if (blocks.size() > 1) draft_.bodies.add(of.name, all, true, draft_.problems);
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      const std::string name = blocks.size() == 1 ? of.name : fmt::format("{}{}", of.name, i + 1);
      draft_.made.push_back(body_of(of, blocks[i], name, i));
      read_body(draft_.made.back(), draft_, blocks.size() == 1);
    }
  }

  // The keys of a body that stands there.
  TomlValue body_of(const MapKind& kind, const Block& block, const std::string& name,
                    std::size_t index) const {
    const Place where = rows_[block.row][block.column].where;
    const Vec<2> size =
        spec_.cell * Vec<2>(static_cast<double>(block.columns), static_cast<double>(block.rows));
    const auto above = static_cast<double>(cells_.size() - block.row - block.rows);
    const Vec<2> low = Vec<2>(corner_.x, corner_.y) +
                       spec_.cell * Vec<2>(static_cast<double>(block.column), above);
    const auto point = [&](const Vec<2>& p) {
      return TomlValue{where, TomlArray{{where, p.x}, {where, p.y}}};
    };
    TomlTable own = {{"name", where, {where, name}}};
    own.push_back({"position", where, point(low + size / 2.0)});
    if (kind.fills) own.push_back({"half_size", where, point(size / 2.0)});
    if (const auto* color = value_of<std::int64_t>(*kind.keys, "color"); color && *color == 0)
      own.push_back({"color", where, {where, std::int64_t{cycled_color(0, index)}}});
    return {where, with_prototype(std::move(own), *kind.keys)};
  }

  const TableReader& table_;
  Draft& draft_;
  MapSpec spec_;
  std::string text_;
  Rows rows_;  // views into the text
  Vec<3> corner_{0.0};
  std::map<std::string, std::size_t, std::less<>> legend_;  // the kind of each letter
  std::map<std::string, Place> letters_;                    // where the legend has it
  std::vector<MapKind> kinds_;
  std::vector<std::vector<std::size_t>> cells_;
};

}  // namespace

TableDoc map_table() {
  using M = MapSpec;
  TableDoc table = {
      "map", "[map]",
      "Bodies of a 2D world as letters of a drawing. Those of prototype `wall` are called `wall1`, "
      "`wall2`, … in reading order, or `wall` if there is only one. A prototype without a shape "
      "fills its cell; where it is static, neighbouring cells become one box."};
  table.keys = {
      key(KeyType::lines, "rows",
          "A letter a cell, a line a row, the highest row first. '.' and blanks are nothing, "
          "unless the legend has them.",
          must()),
      key(&M::cell, "cell", "Size of a letter.", above(0, kFar)),
      key(KeyType::point, "at", "Lower left corner of the drawing.", range(-kFar, kFar),
          or_else("the world's")),
      key(KeyType::name_texts, "legend", "Which prototype a letter stands for.", must()),
  };
  return table;
}

void read_map(const TableReader& file, Draft& draft) {
  for (const TomlValue* value : file.tables("map"))
    if (!file.has("world"))
      draft.problems.add(value->where, "a map needs a [world]", "add [world] with size = [64, 64]");
  for_each<MapSpec>(file, "map", draft, [&](const TableReader& table, const MapSpec& spec) {
    MapReader(table, spec, draft).read();
  });
}

}  // namespace lantern::language
