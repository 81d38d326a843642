#include "fuzz/generate.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace lantern::fuzz {
namespace {

Block made_block(std::string_view header, const TableDoc& table, const Document& document,
                 double fill, Dice& dice) {
  Block block{std::string(header), {}};
  fill_block(block, table, Surroundings(document, document.blocks.size()), fill, dice);
  return block;
}

class Maker {
 public:
  explicit Maker(Dice& dice) : dice_(dice) {}

  Document make() {
    add("", fill());
    document_.blocks[0].entries.erase(
        std::remove_if(document_.blocks[0].entries.begin(), document_.blocks[0].entries.end(),
                       [](const Entry& e) { return e.key == "name"; }),
        document_.blocks[0].entries.end());
    if (dice_.chance(0.88)) add_world();
    if (dice_.chance(document_.blocks.size() > 1 ? 0.01 : 0.95)) add_atlas();
    if (dice_.chance(0.12)) add("[chart]", 0.3);
    if (dice_.chance(0.03)) add("[problem]", 0.3);
    add_script();
    return std::move(document_);
  }

 private:
  double fill() { return dice_.pick({0.0, 0.05, 0.05, 0.15, 0.3}); }

  void add(std::string_view header, double fill) {
    const Block named{std::string(header), {}};
    document_.blocks.push_back(
        made_block(header, language_table(named.name()), document_, fill, dice_));
  }

  void add_some(std::string_view header, double more) {
    while (dice_.chance(more) && document_.blocks.size() < 24) {
      add(header, fill());
      name_apart(document_.blocks.back());
    }
  }

  // Names that nobody has yet, mostly.
  void name_apart(Block& block) {
    for (Entry& entry : block.entries)
      if (entry.key == "name" && dice_.chance(0.98))
        entry.value = in_toml(fmt::format("{}{}", dice_.pick({"a", "dot", "Q", "ball_"}),
                                          static_cast<char>('a' + document_.blocks.size() % 26)));
  }

  void add_world() {
    add("[world]", dice_.pick({0.0, 0.1, 0.25}));
    Block& world = document_.blocks.back();
    if (dice_.chance(0.3))
      for (Entry& entry : world.entries)
        if (entry.key == "size") entry.value = "[16, 12, 16]";
    // Without contacts and a pull, little of the physics would be seen.
    if (dice_.chance(0.6) && !world.find("contacts"))
      world.entries.push_back({"contacts", in_toml(dice_.pick({"soft", "impulse"}))});
    const bool solid = Surroundings(document_, 99).dimension == 3;
    if (dice_.chance(0.5) && !world.find("gravity"))
      world.entries.push_back({"gravity", solid ? "[0, -10, 0]" : "[0, -10]"});
    if (dice_.chance(0.6)) {
      add("[structure]", dice_.pick({0.1, 0.4}));
      std::erase_if(document_.blocks.back().entries,
                    [](const Entry& entry) { return entry.key == "planes"; });
      if (document_.blocks.back().value("kind") == "\"bsp\"") add_some("[[structure.planes]]", 0.6);
    }
    if (dice_.chance(0.2)) {
      add_some("[[prototype]]", 0.3);
      if (!solid) add("[map]", 0.2);
    }
    add_some("[[body]]", 0.7);
    add_some("[[pattern]]", 0.5);
    if (dice_.chance(0.25)) add_some("[[joint]]", 0.7);
    if (dice_.chance(0.2)) add_some("[[spring]]", 0.7);
    if (!solid && dice_.chance(0.12)) add("[level]", 0.3);
  }

  void add_atlas() {
    add("[atlas]", 0.2);
    add_some("[[texture]]", 0.7);
    add_some("[[texture_pattern]]", 0.5);
  }

  // Does the verb seem to have what it works on?
  static bool fits(const TableDoc& verb, const Surroundings& around) {
    const auto of_bodies = verb.find("bodies") || verb.find("body");
    if (verb.name == "insert" || verb.name == "emit") return !around.absent.empty();
    if (of_bodies) return !around.present.empty();
    if (verb.name == "draw") return false;  // it needs a screen
    if (verb.find("textures") || verb.name == "ask_room") return around.has_atlas;
    if (verb.name == "compile" || verb.name == "locate" || verb.name == "order")
      return around.has_level;
    return verb.name == "show" || (around.has_world && !around.bodies.empty());
  }

  void add_step(const TableDoc& verb) {
    Block block{"[[step]]", {{"do", in_toml(verb.name)}}};
    Surroundings around(document_, document_.blocks.size());
    if (verb.name == "insert") {
      std::string names;
      for (const std::string& name : around.absent)
        if (dice_.chance(0.85) || names.empty())
          names += (names.empty() ? "" : ", ") + in_toml(name);
      block.entries.push_back({"bodies", "[" + names + "]"});
    }
    if (verb.name == "wait" && !around.present.empty())
      block.entries.push_back(
          {"event", in_toml(dice_.pick({"touch", "part", "asleep", "asleep"}))});
    fill_block(block, verb, around, dice_.pick({0.0, 0.1, 0.3}), dice_);
    document_.blocks.push_back(std::move(block));
  }

  void add_script() {
    const auto verbs = language_verbs();
    const auto named = [&](std::string_view name) -> const TableDoc& {
      return *std::find_if(verbs.begin(), verbs.end(),
                           [&](const TableDoc& verb) { return verb.name == name; });
    };
    const std::size_t first = document_.blocks.size();
    const bool has_bodies = !Surroundings(document_, first).bodies.empty();
    if (has_bodies && dice_.chance(0.9)) add_step(named("insert"));
    if (has_bodies && dice_.chance(0.4)) add_step(named("run"));
    for (std::int64_t n = dice_.whole(0, 7); n > 0; --n) {
      const TableDoc& verb = dice_.pick(verbs);
      if (fits(verb, Surroundings(document_, document_.blocks.size())) || dice_.chance(0.02))
        add_step(verb);
    }
    if (document_.blocks.size() == first) add_step(named("show"));
  }

  Dice& dice_;
  Document document_;
};

// --- spoiling ---

const KeyDoc* doc_of(const Block& block, const Entry& entry) {
  const TableDoc* table = table_of(block);
  return table ? table->find(entry.key) : nullptr;
}

// The document's names that others refer to by, and all texts in quotes that look like one.
std::vector<std::string> names_of(const Document& document) {
  std::vector<std::string> names;
  for (const Block& block : document.blocks)
    for (const std::string& name : texts_in(block.value("name"))) names.push_back(name);
  return names;
}

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

// One number of a value by another, or by one that is nearly the same.
void change_number(std::string& value, Dice& dice) {
  std::vector<std::size_t> starts;
  for (std::size_t i = 0; i < value.size(); ++i)
    if (std::isdigit(static_cast<unsigned char>(value[i])) &&
        (i == 0 || !(std::isalnum(static_cast<unsigned char>(value[i - 1])) ||
                     value[i - 1] == '.' || value[i - 1] == '_')))
      starts.push_back(i);
  if (starts.empty()) return;
  const std::size_t at = dice.pick(starts);
  const std::size_t end = std::min(value.find_first_not_of("0123456789.", at), value.size());
  double x = 0;
  try {
    x = std::stod(value.substr(at, end - at));
  } catch (const std::exception&) {
    return;
  }
  const double changed[] = {0,        -x,    x / 2,   2 * x,   x + 1,   x - 1,
                            x + 1e-9, 1e-12, x * 100, x / 100, x * 1e6, std::nextafter(x, 1e9)};
  value.replace(at, end - at, fmt::format("{}", dice.pick(changed)));
}

void change_name(Document& document, Dice& dice) {
  const std::vector<std::string> names = names_of(document);
  if (names.empty()) return;
  const std::string from = dice.pick(names);
  // Of another thing, a pattern's member, one that differs by a letter, or none at all.
  const std::string to =
      dice.pick({dice.pick(names), dice.pick(names) + std::to_string(dice.whole(0, 3)),
                 from.substr(from.size() / 2), from + "x", std::string("\xc2\x9b")});
  const bool everywhere = dice.chance(0.2);
  std::vector<std::string*> uses;
  for (Block& block : document.blocks)
    for (Entry& entry : block.entries)
      if (entry.value.find(in_toml(from)) != std::string::npos) uses.push_back(&entry.value);
  if (uses.empty()) return;
  std::string* only = dice.pick(uses);
  for (std::string* use : uses)
    if (everywhere || use == only) replace_all(*use, in_toml(from), in_toml(to));
}

void change_value(Block& block, Entry& entry, const Document& document, std::size_t index,
                  Dice& dice) {
  const Surroundings around(document, index);
  const KeyDoc* key = doc_of(block, entry);
  const std::int64_t way = dice.whole(0, 9);
  if (way < 4) return change_number(entry.value, dice);
  if (way < 6 && key)
    entry.value = right_value(*key, around, dice);
  else if (way < 8 && key)
    entry.value = edge_value(*key, around, dice);
  else
    entry.value = wild_value(around, dice);
}

void change_keys(Block& block, const Document& document, std::size_t index, Dice& dice) {
  const Surroundings around(document, index);
  const TableDoc* own = table_of(block);
  const TableDoc& table = own && dice.chance(0.7) ? *own : dice.pick(language_tables());
  const KeyDoc& key = dice.pick(table.keys);
  switch (dice.whole(0, 4)) {
    case 0:
      if (!block.entries.empty())
        block.entries.erase(block.entries.begin() +
                            static_cast<std::ptrdiff_t>(dice.index(block.entries.size())));
      break;
    case 1:
      if (!block.entries.empty()) block.entries.push_back(dice.pick(block.entries));
      break;
    case 2:
      if (!block.entries.empty())
        block.entries[dice.index(block.entries.size())].key = std::string(key.key);
      break;
    default:
      block.entries.push_back({std::string(key.key), right_value(key, around, dice)});
  }
}

void change_blocks(Document& document, const Document& other, Dice& dice) {
  std::vector<Block>& blocks = document.blocks;
  const std::size_t a = dice.index(blocks.size()), b = dice.index(blocks.size());
  const auto at = [&](std::size_t i) { return blocks.begin() + static_cast<std::ptrdiff_t>(i); };
  switch (dice.whole(0, 4)) {
    case 0:
      if (blocks.size() > 1) blocks.erase(at(a));
      break;
    case 1:
      blocks.insert(at(b), Block(blocks[a]));
      break;
    case 2:
      std::swap(blocks[a], blocks[b]);
      break;
    case 3: {
      const Block& foreign = dice.pick(other.blocks);
      blocks.insert(foreign.header.empty() ? at(0) : at(b) + 1, foreign);
      break;
    }
    default:
      std::swap(blocks[a].header, blocks[b].header);
  }
}

void change_verb(Document& document, Dice& dice) {
  std::vector<Entry*> verbs;
  for (Block& block : document.blocks)
    for (Entry& entry : block.entries)
      if (block.name() == "step" && entry.key == "do") verbs.push_back(&entry);
  if (!verbs.empty()) dice.pick(verbs)->value = in_toml(dice.pick(language_verbs()).name);
}

// --- mending ---

// What stands between two letters, as the keys in "needs a 'speed'" or the table in "add [world]".
std::vector<std::string> between(std::string_view text, char first, char last) {
  std::vector<std::string> found;
  while (true) {
    const std::size_t from = text.find(first);
    const std::size_t to = from == text.npos ? from : text.find(last, from + 1);
    if (to == text.npos) return found;
    found.emplace_back(text.substr(from + 1, to - from - 1));
    text.remove_prefix(to + 1);
  }
}

// Adds a key of the block that the diagnostic speaks of and that is not there.
bool add_missing_key(Document& document, std::size_t index, const std::string& words, Dice& dice) {
  Block& block = document.blocks[index];
  if (const TableDoc* table = table_of(block))
    for (const std::string& word : between(words, '\'', '\''))
      if (const KeyDoc* key = table->find(word); key && !block.find(word)) {
        block.entries.push_back({word, right_value(*key, Surroundings(document, index), dice)});
        return true;
      }
  return false;
}

// The same of a table.
bool add_missing_table(Document& document, const std::string& words, Dice& dice) {
  for (const std::string& word : between(words, '[', ']'))
    for (const TableDoc& table : language_tables()) {
      const bool is_there = std::any_of(document.blocks.begin(), document.blocks.end(),
                                        [&](const Block& b) { return b.name() == word; });
      if (word.empty() || table.name != word || is_there) continue;
      Block added = made_block("[" + word + "]", table, document, 0.1, dice);
      document.blocks.insert(document.blocks.begin() + 1, std::move(added));
      return true;
    }
  return false;
}

}  // namespace

Document made_scenario(Dice& dice) { return Maker(dice).make(); }

bool mend(Document& document, std::vector<Diagnostic> diagnostics, int round, Dice& dice) {
  const double hope = round < 3 ? 0.6 : 0.1;  // that a thing can be put right, not left out
  // From the end, so that earlier places stay where they are; of a line the first mistake.
  std::stable_sort(diagnostics.begin(), diagnostics.end(),
                   [](const auto& a, const auto& b) { return a.where.line > b.where.line; });
  bool mended = false;
  int line = 0;
  for (const Diagnostic& diagnostic : diagnostics) {
    if (diagnostic.where.line == line) continue;
    line = diagnostic.where.line;
    const Document::Spot spot = document.at_line(line);
    if (spot.block < 0) continue;
    const auto index = static_cast<std::size_t>(spot.block);
    const std::string words = diagnostic.message + " " + diagnostic.suggestion;
    const bool must = words.find("has no") != words.npos;
    mended = true;
    if (dice.chance(must ? 0.9 : hope)) {
      if (add_missing_key(document, index, words, dice)) continue;
      if (add_missing_table(document, words, dice)) return true;  // lines have moved
    }
    Block& block = document.blocks[index];
    const auto which = block.entries.begin() + std::max(spot.entry, 0);
    const KeyDoc* key = spot.entry < 0 ? nullptr : doc_of(block, *which);
    if (spot.entry < 0 || which->key == "do" || (round > 4 && index > 0)) {
      if (!block.header.empty()) document.blocks.erase(document.blocks.begin() + spot.block);
    } else if (key && dice.chance(key->required ? 0.8 : 0.6 * hope)) {
      which->value = right_value(*key, Surroundings(document, index), dice);
    } else {
      block.entries.erase(which);
    }
  }
  return mended;
}

void shrink(Document& document, Dice& dice) {
  const Surroundings around(document, document.blocks.size());
  for (Block& block : document.blocks)
    for (Entry& entry : block.entries) {
      if (entry.key == "count") {
        const int least = static_cast<int>(dice.whole(2, 9));
        if (entry.value.size() > 1) entry.value = std::to_string(least);
      }
      if ((entry.key == "seconds" || entry.key == "at_most") && block.name() == "step")
        entry.value = fmt::format("{}", around.time_step * static_cast<double>(dice.whole(1, 20)));
    }
}

void spoil(Document& document, const Document& other, Dice& dice) {
  if (document.blocks.empty()) document.blocks.emplace_back();
  const std::size_t index = dice.index(document.blocks.size());
  Block& block = document.blocks[index];
  const std::int64_t way = dice.whole(0, 9);
  if (way < 5 && !block.entries.empty())
    change_value(block, block.entries[dice.index(block.entries.size())], document, index, dice);
  else if (way < 6)
    change_keys(block, document, index, dice);
  else if (way < 7)
    change_blocks(document, other, dice);
  else if (way < 9)
    change_name(document, dice);
  else
    change_verb(document, dice);
}

void spoil_bytes(std::string& text, Dice& dice) {
  static constexpr std::string_view kParts[] = {"[",
                                                "]",
                                                "{",
                                                "}",
                                                "=",
                                                ",",
                                                "\"",
                                                "'",
                                                "\"\"\"",
                                                "'''",
                                                "#",
                                                "\n",
                                                "\r\n",
                                                "\\u",
                                                ".",
                                                "a.b.",
                                                "\t",
                                                "[[body]]",
                                                "\xef\xbb\xbf",
                                                "\xff",
                                                "\\",
                                                "0",
                                                "\xc3",
                                                "\\x",
                                                "_",
                                                "1e9",
                                                "-",
                                                "\x01",
                                                "\xc2\x9b",
                                                "[[step]]",
                                                "\xed\xa0\x80",
                                                "\\U0010FFFF"};
  const std::size_t at = dice.index(text.size() + 1);
  const auto length = static_cast<std::size_t>(dice.whole(1, 40));
  switch (dice.whole(0, 5)) {
    case 0:
      if (at < text.size()) text[at] = static_cast<char>(dice.whole(0, 255));
      break;
    case 1:
      text.erase(at, length);
      break;
    case 2:
      text.insert(at, dice.pick(kParts));
      break;
    case 3:
      text.insert(at, text.substr(dice.index(text.size() + 1), 4 * length));
      break;
    case 4:
      if (dice.chance(0.2)) text.resize(at);
      break;
    default:
      if (at < text.size()) text[at] = static_cast<char>(dice.whole(32, 126));
  }
}

}  // namespace lantern::fuzz
