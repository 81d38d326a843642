// [[side]]: the same script under other settings. What the file says to each side is made as a file
// of its own and read like any other, so that all checks of the language hold for every side.
#include <algorithm>
#include <array>
#include <set>

#include <fmt/format.h>

#include "language/counts.hpp"
#include "language/keys/key.hpp"
#include "language/tables/draft.hpp"

namespace lantern::language {
namespace {

constexpr std::size_t kLeastSides = 2;

// Of [world], what all sides share: one clock, and one look at one place.
constexpr std::array<std::string_view, 7> kShared = {
    "size", "min", "max", "time_step", "frame_every", "camera_eye", "camera_target"};

TomlEntry* entry(TomlTable& table, std::string_view key) {
  return const_cast<TomlEntry*>(entry_of(table, key));
}

void take_out(TomlTable& table, std::string_view key) {
  std::erase_if(table, [&](const TomlEntry& e) { return e.key == key; });
}

// Entries stay in order of their keys' letters.
void put(TomlTable& table, const TomlEntry& written) {
  if (TomlEntry* old = entry(table, written.key))
    *old = written;
  else
    table.insert(std::ranges::upper_bound(table, written.key, {}, &TomlEntry::key), written);
}

// The tables of a key; those that are none are a mistake, told elsewhere.
template <class Table, class F>
void for_each_table(Table& file, std::string_view key, F&& f) {
  auto* list = value_of<TomlArray>(file, key);
  if (!list) return;
  for (auto& element : *list)
    if (auto* table = std::get_if<TomlTable>(&element.data)) f(*table, element.where);
}

// What the file says to one of its sides.
class SideWriter {
 public:
  SideWriter(const TomlTable& file, const std::vector<std::string>& sides, const std::string& own)
      : file_(file), sides_(sides), own_(own) {
    take_out(file_, "side");
  }

  TomlTable written(const TomlTable& side) {
    for (const KeyDoc& key : language_table("side").keys)
      if (const TomlEntry* e = entry_of(side, key.key); e && key.type == KeyType::part)
        override_by(*e);
    for_each_table(file_, "step", [&](TomlTable& step, Place) {
      for (const std::string_view key : {"expect", "always", "code"})
        if (auto* table = value_of<TomlTable>(step, key))
          if (take_own(*table) && key == "code") take_out(step, key);
      keep_own(step, "lit", [&](TomlValue& name) { return take_own(name); });
      keep_own(step, "note", [&](TomlValue& note) { return take_own_note(note); });
    });
    narrow_chart();
    return std::move(file_);
  }

 private:
  void override_by(const TomlEntry& part) {
    const auto* with = std::get_if<TomlTable>(&part.value.data);
    TomlEntry* base = entry(file_, part.key);
    auto* table = base ? std::get_if<TomlTable>(&base->value.data) : nullptr;
    if (!with || (base && !table)) return;
    if (!base) return put(file_, part);
    // Planes of a BSP mean nothing to another kind.
    if (part.key == "structure" && entry_of(*with, "kind")) take_out(*table, "planes");
    for (const TomlEntry& e : *with) put(*table, e);
  }

  bool is_side(std::string_view name) const {
    return std::ranges::find(sides_, name) != sides_.end();
  }

  // `eager = { nodes = 9 }` holds on that side only, beside what is expected of all.
  // Is nothing left, as other sides have all of it?
  bool take_own(TomlTable& expect) const {
    std::vector<TomlEntry> of_sides;
    for (const TomlEntry& e : expect)
      if (is_side(e.key) && std::holds_alternative<TomlTable>(e.value.data)) of_sides.push_back(e);
    for (const TomlEntry& e : of_sides) {
      take_out(expect, e.key);
      if (e.key != own_) continue;
      for (const TomlEntry& own : std::get<TomlTable>(e.value.data)) put(expect, own);
    }
    return !of_sides.empty() && expect.empty();
  }

  // Does the name stand for this side, too? One that begins with its name loses that.
  bool take_own(TomlValue& name) const {
    auto* text = std::get_if<std::string>(&name.data);
    if (!text) return true;
    const std::string_view side = side_of(*text, sides_);
    if (side.empty()) return true;
    const bool is_own = side == own_;
    *text = std::string(within_side(*text, sides_));
    return is_own;
  }

  // Does the note stand on this side, too? One that names a side that is there loses that.
  bool take_own_note(TomlValue& note) const {
    auto* table = std::get_if<TomlTable>(&note.data);
    const auto* name = table ? value_of<std::string>(*table, "side") : nullptr;
    if (!name || !is_side(*name)) return true;
    const bool is_own = *name == own_;
    take_out(*table, "side");
    return is_own;
  }

  // Of a step's list, what is of this side.
  static void keep_own(TomlTable& step, std::string_view key, const auto& is_own) {
    if (auto* list = value_of<TomlArray>(step, key))
      std::erase_if(*list, [&](TomlValue& value) { return !is_own(value); });
  }

  // Only what this side counts is checked on it. A chart that shows nothing of it is not its own.
  void narrow_chart() {
    auto* table = value_of<TomlTable>(file_, "chart");
    if (!table) return;
    bool shown = true;
    if (TomlEntry* bars = entry(*table, "bars")) shown = take_own(bars->value);
    if (auto* list = value_of<TomlArray>(*table, "y"); list && !list->empty()) {
      std::erase_if(*list, [&](TomlValue& name) { return !take_own(name); });
      shown = !list->empty();
    }
    if (shown) return;
    take_out(file_, "chart");
    for_each_table(file_, "step", [](TomlTable& step, Place) { take_out(step, "plot"); });
  }

  TomlTable file_;
  const std::vector<std::string>& sides_;
  const std::string& own_;
};

class SidesReader {
 public:
  SidesReader(const TomlTable& file, Problems& problems) : file_(file), problems_(problems) {}

  std::vector<SideFile> read() {
    check_number();
    std::vector<SideFile> sides;
    for_each_table(file_, "side", [&](const TomlTable& written, Place where) {
      SideFile& side = sides.emplace_back();
      side.table = without_shared(written);
      const TableReader reader(side.table, where, language_table("side"), problems_, 0);
      if (const auto name = reader.named("name")) side.name = checked(*name);
      side.title = reader.get<std::string>("title").value_or(side.name);
    });
    check_parts();
    const std::vector<std::string> names = mapped(sides, &SideFile::name);
    if (sides.size() > kMostSides) sides.resize(kMostSides);  // each is the whole file once more
    for (SideFile& side : sides)
      side.file = SideWriter(file_, names, side.name).written(side.table);
    return sides;
  }

 private:
  void check_number() {
    const TomlEntry& all = *entry_of(file_, "side");
    if (!check_value(all.value, *language_table("").find("side"), 0, problems_)) return;
    std::size_t count = 0;
    Place last = all.where;
    for_each_table(file_, "side", [&](const TomlTable&, Place where) { ++count, last = where; });
    if (count < kLeastSides)
      problems_.add(last,
                    fmt::format("one side alone has nothing beside it: there must be {} to {}",
                                kLeastSides, kMostSides),
                    "add a second [[side]], or leave this one out");
  }

  // No two have one, and none is read as a count's in "eager.pairs".
  const std::string& checked(const Named& side) {
    if (!names_.insert(side.name).second)
      problems_.add(side.where, fmt::format("the name '{}' is taken", side.name),
                    "each side has a name of its own");
    else if (find_count(side.name) || find_in(known_body_measures(), side.name) ||
             find_in(known_texts(), side.name) || language_table("expect").find(side.name))
      problems_.add(
          side.where,
          fmt::format("a side cannot be called '{}': that is counted or expected", side.name),
          "give it another name");
    return side.name;
  }

  // What it may override; of the rest is said that it may not.
  TomlTable without_shared(const TomlTable& side) {
    TomlTable kept;
    for (const TomlEntry& e : side) {
      if (!language_table("side").find(e.key) && language_table("").find(e.key)) {
        refuse(e, "", fmt::format("it may override {}", parts()));
        continue;
      }
      TomlEntry& copy = kept.emplace_back(e);
      auto* world = e.key == "world" ? std::get_if<TomlTable>(&copy.value.data) : nullptr;
      if (world)
        std::erase_if(*world, [&](const TomlEntry& rule) {
          const bool bad = !may_differ("world", rule.key);
          if (bad) refuse(rule, " of [world]", "one clock and one place for all; rules may differ");
          return bad;
        });
    }
    return kept;
  }

  void refuse(const TomlEntry& e, const char* of, const std::string& hint) {
    problems_.add(
        e.where,
        fmt::format("a side cannot override {}{}: all sides share it", in_quotes(e.key), of), hint);
  }

  static std::string parts() {
    std::string words;
    for (const KeyDoc& key : language_table("side").keys)
      if (key.type == KeyType::part)
        words += fmt::format("{}[{}]", words.empty() ? "" : ", ", key.of);
    return words;
  }

  // A table of the file that sides override is whole by itself.
  void check_parts() {
    for (const KeyDoc& key : language_table("side").keys) {
      const TomlEntry* e = key.type == KeyType::part ? entry_of(file_, key.key) : nullptr;
      if (const auto* table = e ? std::get_if<TomlTable>(&e->value.data) : nullptr)
        TableReader(*table, e->value.where, language_table(key.of), problems_, 0);
    }
  }

  const TomlTable& file_;
  Problems& problems_;
  std::set<std::string> names_;
};

}  // namespace

TableDoc side_table() {
  using S = ScenarioSpec;
  TableDoc table = {
      "side", "[[side]]",
      "The script runs under each side's settings, on one clock, and the page sets the sides "
      "beside each other: two to four of them. A side overrides single keys, as in `structure = { "
      "children = \"eager\" }`; what it does not override is as in the file. Captions and the "
      "chart quote a side by its name, as `{eager.pairs}`; without one, what all sides have in "
      "common. `expect` and `always` hold on every side, and `expect.eager = { nodes = 9 }` on "
      "that one; so do `code`, `lit = [\"eager.red\"]` and a note with its `side`."};
  table.keys = {
      key(&S::side, "name", "For captions, charts and expectations.", must(), like(kNamePattern)),
      key(&S::side_title, "title", "Stands over it.", range(1, 40), or_else("the name")),
      key(KeyType::part, "structure", "How the world is partitioned.", holds("structure")),
      key(KeyType::part, "world",
          "The world's rules. Its extent, clock and camera are the same on all sides.",
          holds("world")),
      key(KeyType::part, "level", "How walls are compiled.", holds("level")),
      key(KeyType::part, "atlas", "The image that textures are packed into.", holds("atlas")),
  };
  return table;
}

bool may_differ(std::string_view table, std::string_view key) {
  return table != "world" || std::ranges::find(kShared, key) == kShared.end();
}

std::string_view side_of(std::string_view name, const std::vector<std::string>& sides) {
  const std::size_t dot = name.find('.');
  if (dot == std::string_view::npos) return {};
  const auto found = std::ranges::find(sides, name.substr(0, dot));
  return found == sides.end() ? std::string_view() : std::string_view(*found);
}

std::string_view within_side(std::string_view name, const std::vector<std::string>& sides) {
  const std::string_view side = side_of(name, sides);
  return side.empty() ? name : name.substr(side.size() + 1);
}

std::vector<SideFile> files_of_sides(const TomlTable& file, Problems& problems) {
  return SidesReader(file, problems).read();
}

ChartSpec chart_of_sides(const TomlTable& file, const ChartSpec& of_one,
                         const std::vector<std::string>& sides) {
  ChartSpec chart = of_one;
  chart.y.clear();
  const auto add = [&](const TomlValue& name) {
    const std::string& written = std::get<std::string>(name.data);
    if (!side_of(written, sides).empty()) return chart.y.push_back(written);
    for (const std::string& side : sides) chart.y.push_back(side + "." + written);
  };
  const TomlTable& table = std::get<TomlTable>(entry_of(file, "chart")->value.data);
  if (const TomlEntry* bars = entry_of(table, "bars")) add(bars->value);
  if (const TomlEntry* y = entry_of(table, "y"))
    for (const TomlValue& name : std::get<TomlArray>(y->value.data)) add(name);
  return chart;
}

}  // namespace lantern::language
