#include "fuzz/values.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "language/counts.hpp"

namespace lantern::fuzz {
namespace {

constexpr double kNice[] = {0, 0.25, 0.5, 0.5, 1, 1, 1, 1.5, 2, 2, 3, 4, 5, 8, 10, 16};
constexpr std::string_view kWords[] = {
    "red",  "pink",     "Boxes fall",   "é × ∞",          "a",    "A long line of words, and on",
    "x\tx", "<&>\\\"'", "{pairs:pair}", "{time} s",       "日本", "{bodies} of {all_pairs}",
    " ",    "{energy}", "{nodes:node}", "{energy.ball1}", "…",    "\u202e\u0301\U0001F47B"};
constexpr std::string_view kNames[] = {"ball", "dot",  "box", "a",       "Ghost 1", "t",
                                       "wall", "dot2", "b-1", "floor_1", "Q"};
constexpr double kAllowed = 20;  // what a small world's numbers mostly stay below

bool is(std::string_view key, std::initializer_list<std::string_view> keys) {
  return std::find(keys.begin(), keys.end(), key) != keys.end();
}

bool has(std::string_view key, std::initializer_list<std::string_view> parts) {
  return std::any_of(parts.begin(), parts.end(),
                     [&](std::string_view part) { return key.find(part) != key.npos; });
}

double as_number(std::string_view value, double otherwise) {
  try {
    const double number = std::stod(std::string(value.substr(value.find_first_not_of("[ "))));
    return std::isfinite(number) ? number : otherwise;
  } catch (const std::exception&) {
    return otherwise;
  }
}

std::string listed(const std::vector<std::string>& values) {
  return fmt::format("[{}]", fmt::join(values, ", "));
}

double in_range(const KeyDoc& key, Dice& dice) {
  const double least = std::isfinite(key.least) ? key.least : -1e9;
  const double most = std::isfinite(key.most) ? key.most : 1e9;
  if (dice.chance(0.03)) return dice.chance(0.5) ? least : most;
  if (dice.chance(0.04)) {  // any size
    const double x = std::exp(dice.between(-20, std::log(std::max(most, 1e-8))));
    return least < 0 && dice.chance(0.5) ? -x : std::max(x, least);
  }
  for (int i = 0; i < 20; ++i) {
    double x = dice.pick(kNice);
    if (dice.chance(0.2)) x = dice.between(0, kAllowed);
    if (least < 0 && dice.chance(0.4)) x = -x;
    if (x >= least && x <= most && !(key.above_least && x == least)) return x;
  }
  return dice.between(std::max(least, -kAllowed), std::min(most, std::max(least, kAllowed)));
}

std::int64_t whole_in_range(const KeyDoc& key, Dice& dice) {
  const double least = std::isfinite(key.least) ? key.least : -9e15;
  const double most = std::isfinite(key.most) ? key.most : 9e15;
  if (dice.chance(0.01)) return static_cast<std::int64_t>(dice.chance(0.5) ? least : most);
  if (dice.chance(0.03))
    return dice.whole(static_cast<std::int64_t>(least),
                      static_cast<std::int64_t>(std::min(most, 300.0)));
  const double low = std::max(least, 0.0);
  return dice.whole(static_cast<std::int64_t>(std::min(low, most)),
                    static_cast<std::int64_t>(std::min(most, low + dice.pick({2.0, 5.0, 12.0}))));
}

std::string name_like(const KeyDoc& key, Dice& dice) {
  const std::string name(dice.pick(kNames));
  if (!key.pattern) return name;
  return legal_name(dice.chance(0.3) ? fmt::format("{}{}", name, dice.whole(0, 9)) : name,
                    *key.pattern);
}

std::string text_within(const KeyDoc& key, Dice& dice) {
  std::string text(dice.pick(kWords));
  while (dice.chance(0.3)) text += dice.pick(kWords);
  if (dice.chance(0.02) && std::isfinite(key.most))
    text = std::string(static_cast<std::size_t>(std::min(key.most, 300.0)), 'm');
  return text;
}

template <class List>
std::string any_name(const List& names, Dice& dice) {
  return names.empty() ? std::string(dice.pick(kNames)) : std::string(dice.pick(names));
}

std::string count_name(const Surroundings& around, Dice& dice) {
  if (dice.chance(0.25))
    return fmt::format("{}.{}", dice.pick(known_body_measures()).name,
                       any_name(around.bodies, dice));
  if (dice.chance(0.4)) return std::string(dice.pick(known_measures()).name);
  return std::string(dice.pick(known_counts()).name);
}

std::string text_value(const KeyDoc& key, const Surroundings& around, Dice& dice) {
  if (is(key.key, {"body", "a", "b", "follow"})) {
    const auto& names =
        key.key == "body" && !around.present.empty() ? around.present : around.bodies;
    return any_name(names, dice);
  }
  if (key.key == "like") return any_name(around.prototypes, dice);
  if (key.key == "do") return std::string(dice.pick(language_verbs()).name);
  if (key.key == "along") return any_name(around.patterns, dice);
  if (key.key == "x" && dice.chance(0.6)) return "time";
  if (is(key.key, {"x", "bars"})) return count_name(around, dice);
  if (key.key == "at")
    return dice.chance(0.4)   ? "root"
           : dice.chance(0.6) ? dice.chance(0.5) ? "back" : "front"
                              : "front.back";
  if (key.pattern || key.key == "name") return name_like(key, dice);
  return text_within(key, dice);
}

// Different names, of those that fit the key best.
std::vector<std::string> names_for(const KeyDoc& key, const Surroundings& around, Dice& dice) {
  if (key.key == "methods")
    return {dice.pick({"velocity_verlet", "runge_kutta_4", "soft:4", "impulse:10", "splitting_2"})};
  std::vector<std::string> from = key.key == "textures" ? around.textures : around.present;
  if (key.key == "y") from = {count_name(around, dice), count_name(around, dice)};
  if (from.empty() || dice.chance(0.05)) from = around.bodies;
  if (from.empty()) from = {name_like(key, dice)};
  std::vector<std::string> chosen;
  for (const std::string& name : from)
    if (dice.chance(0.6) && std::find(chosen.begin(), chosen.end(), name) == chosen.end())
      chosen.push_back(name);
  if (chosen.empty()) chosen.push_back(dice.pick(from));
  return chosen;
}

std::string names_value(const std::vector<std::string>& names) {
  std::vector<std::string> written;
  for (const std::string& name : names) written.push_back(in_toml(name));
  return listed(written);
}

double coordinate(const KeyDoc& key, const Surroundings& around, Dice& dice) {
  const bool is_direction = has(key.key, {"velocity", "gravity", "normal", "axis", "axes", "at_",
                                          "force", "impulse", "ground", "spin"});
  if (key.key == "size" && !dice.chance(0.05)) return dice.pick({4.0, 8.0, 16.0, 16.0, 32.0, 60.0});
  if (key.key == "min" && dice.chance(0.9)) return dice.between(0, around.extent / 3);
  if (key.key == "max" && dice.chance(0.9)) return dice.between(around.extent / 2, around.extent);
  if (is_direction && dice.chance(0.5)) return dice.pick({0.0, 0.0, 1.0, -1.0, -9.81, 3.0});
  if (key.least >= 0 || is_direction || dice.chance(0.06)) return in_range(key, dice);
  const double x = dice.between(0, around.extent);
  return dice.chance(0.7) ? std::round(2 * x) / 2 : x;
}

std::string point_value(const KeyDoc& key, int numbers, const Surroundings& around, Dice& dice) {
  std::vector<std::string> written;
  for (int i = 0; i < numbers; ++i)
    written.push_back(fmt::format("{}", coordinate(key, around, dice)));
  return listed(written);
}

std::string loops_value(const Surroundings& around, Dice& dice) {
  std::vector<std::string> loops;
  do {
    const double x = dice.between(0, around.extent), y = dice.between(0, around.extent);
    const double r = dice.between(0.2, around.extent / 2);
    const int corners = static_cast<int>(dice.whole(3, 7));
    const double way = dice.chance(0.5) ? 1 : -1;
    std::vector<std::string> points;
    for (int i = 0; i < corners; ++i) {
      const double a = way * 6.283 * i / corners, far = r * dice.pick({1.0, 1.0, 0.5});
      points.push_back(
          fmt::format("[{:.2f}, {:.2f}]", x + far * std::cos(a), y + far * std::sin(a)));
    }
    loops.push_back(listed(points));
  } while (dice.chance(0.5));
  return listed(loops);
}

std::string inline_table(std::string_view name, const Surroundings& around, Dice& dice) {
  const TableDoc& table = language_table(name);
  Block block;
  fill_block(block, table, around, std::min(0.3, 2.0 / static_cast<double>(table.keys.size())),
             dice);
  std::vector<std::string> members;
  for (const Entry& e : block.entries) members.push_back(e.key + " = " + e.value);
  return fmt::format("{{ {} }}", fmt::join(members, ", "));
}

std::string by_name(const KeyDoc& key, const Surroundings& around, Dice& dice, KeyType of) {
  KeyDoc member = key;
  member.type = of;
  const bool of_counts = is(key.key, {"at_most", "at_least"});
  const std::string name = of_counts ? count_name(around, dice) : any_name(around.bodies, dice);
  return fmt::format("{{ {} = {} }}", in_toml(name), right_value(member, around, dice));
}

// A map's rows, as texts on one line.
std::string drawing(Dice& dice) {
  const std::int64_t columns = dice.whole(1, 6);
  std::string rows;
  do {
    if (!rows.empty()) rows += "\\n";
    for (std::int64_t i = 0; i < columns; ++i) rows += dice.chance(0.4) ? '#' : '.';
  } while (dice.chance(0.6));
  return "\"" + rows + "\"";
}

std::string number_value(const KeyDoc& key, const Surroundings& around, Dice& dice) {
  if (is(key.key, {"seconds", "at_most"}))  // in steps
    return fmt::format("{}", around.time_step * static_cast<double>(dice.whole(1, 30)));
  if (key.key == "time_step" || key.key == "step")
    return dice.pick({"0.01", "0.05", "0.1", "0.5", "0.016666666666666666"});
  return fmt::format("{}", in_range(key, dice));
}

}  // namespace

Surroundings::Surroundings(const Document& document, std::size_t block) {
  for (std::size_t b = 0; b < document.blocks.size(); ++b) {
    const Block& now = document.blocks[b];
    const std::string kind = now.name();
    const std::vector<std::string> names = texts_in(now.value("name"));
    if (kind == "world") {
      has_world = true;
      const std::string_view far = now.find("size") ? now.value("size") : now.value("max");
      dimension = std::count(far.begin(), far.end(), ',') == 2 ? 3 : 2;
      extent = std::clamp(as_number(far, 16), 1e-3, 1e9);
      time_step = as_number(now.value("time_step"), 1.0 / 60);
    }
    has_atlas = has_atlas || kind == "atlas";
    has_level = has_level || kind == "level";
    has_structure = has_structure || kind == "structure";
    if (kind == "step") {
      if (b >= block) break;
      const std::vector<std::string> verb = texts_in(now.value("do"));
      for (const std::string& name : texts_in(now.value("bodies"))) {
        if (verb.empty() || !is(verb[0], {"insert", "emit", "remove"})) continue;
        std::vector<std::string>&from = verb[0] == "remove" ? present : absent,
        &to = verb[0] == "remove" ? absent : present;
        std::erase(from, name);
        to.push_back(name);
      }
    }
    if (names.empty()) continue;
    if (kind == "body" || kind == "pattern") absent.push_back(names[0]);
    if (kind == "body") bodies.push_back(names[0]);
    if (kind == "prototype") prototypes.push_back(names[0]);
    if (kind == "pattern") {
      patterns.push_back(names[0]);
      bodies.push_back(names[0] + "1");
    }
    if (kind == "texture" || kind == "texture_pattern") textures.push_back(names[0]);
  }
}

std::string right_value(const KeyDoc& key, const Surroundings& around, Dice& dice) {
  switch (key.type) {
    case KeyType::text:
      return in_toml(text_value(key, around, dice));
    case KeyType::whole:
      return fmt::format("{}", whole_in_range(key, dice));
    case KeyType::number:
      return number_value(key, around, dice);
    case KeyType::truth:
      return dice.chance(0.7) ? "true" : "false";
    case KeyType::choice:
      return in_toml(dice.pick(key.choices));
    case KeyType::point:
      return point_value(key, around.dimension, around, dice);
    case KeyType::two_numbers:
      return point_value(key, 2, around, dice);
    case KeyType::size: {
      const auto length = [&] {
        if (key.key == "min") return dice.whole(1, 8);
        return dice.whole(key.key == "max" ? 8 : 1, dice.pick({8, 64, 64, 300}));
      };
      return fmt::format("[{}, {}]", length(), length());
    }
    case KeyType::texts:
    case KeyType::names:
      return names_value(names_for(key, around, dice));
    case KeyType::loops:
      return loops_value(around, dice);
    case KeyType::whole_or_names:
      return dice.chance(0.5) ? names_value(names_for(key, around, dice))
                              : fmt::format("{}", whole_in_range(key, dice));
    case KeyType::choices_list: {
      std::vector<std::string> chosen;
      for (const std::string_view choice : key.choices)
        if (dice.chance(0.5)) chosen.push_back(in_toml(choice));
      if (chosen.empty()) chosen.push_back(in_toml(dice.pick(key.choices)));
      return listed(chosen);
    }
    case KeyType::lines:
      return drawing(dice);
    case KeyType::turn: {
      const std::string amount = number_value(key, around, dice);
      if (around.dimension != 3 || dice.chance(0.5)) return amount;
      return fmt::format("{{ {} = {}, axis = [0, {}, 1] }}", key.of, amount, dice.whole(-2, 2));
    }
    case KeyType::part:
    case KeyType::table:
      return inline_table(key.of, around, dice);
    case KeyType::tables: {
      std::vector<std::string> tables;
      do tables.push_back(inline_table(key.of, around, dice));
      while (dice.chance(0.4));
      return listed(tables);
    }
    case KeyType::name_pairs: {
      std::vector<std::string> pairs;
      while (dice.chance(0.6))
        pairs.push_back(
            names_value({any_name(around.bodies, dice), any_name(around.bodies, dice)}));
      return listed(pairs);
    }
    case KeyType::name_wholes:
      return by_name(key, around, dice, KeyType::whole);
    case KeyType::name_numbers:
      return by_name(key, around, dice, KeyType::number);
    case KeyType::name_points:
      return by_name(key, around, dice, KeyType::point);
    case KeyType::name_texts:
      return fmt::format("{{ \"#\" = {} }}", in_toml(any_name(around.prototypes, dice)));
  }
  return "0";
}

std::string edge_value(const KeyDoc& key, const Surroundings& around, Dice& dice) {
  const bool is_text = key.type == KeyType::text || key.type == KeyType::choice;
  const double end = dice.chance(0.5) ? key.least : key.most;
  if (!std::isfinite(end)) return right_value(key, around, dice);
  if (is_text) {
    const auto letters = static_cast<std::size_t>(std::clamp(end, 0.0, 3000.0));
    return in_toml(std::string(letters + dice.index(2), 'n'));
  }
  if (key.type == KeyType::whole)
    return fmt::format("{}", static_cast<std::int64_t>(end) + dice.whole(-1, 1));
  const double far = dice.pick({-1e300, -1.0, 1.0, 1e300});
  const double number = dice.chance(0.5) ? end : std::nextafter(end, far);
  if (key.type == KeyType::number) return fmt::format("{}", number);
  if (key.type == KeyType::point || key.type == KeyType::two_numbers) {
    const int numbers = key.type == KeyType::point ? around.dimension : 2;
    std::vector<std::string> written;
    for (int i = 0; i < numbers; ++i)
      written.push_back(
          fmt::format("{}", dice.chance(0.6) ? number : coordinate(key, around, dice)));
    return listed(written);
  }
  if (key.type == KeyType::size)
    return fmt::format("[{}, {}]", static_cast<std::int64_t>(end) + dice.whole(-1, 1),
                       dice.whole(1, 64));
  return right_value(key, around, dice);
}

std::string wild_value(const Surroundings& around, Dice& dice) {
  static constexpr std::string_view kWild[] = {"[]",
                                               "{}",
                                               "\"\"",
                                               "nan",
                                               "inf",
                                               "-inf",
                                               "-0.0",
                                               "1e308",
                                               "5e-324",
                                               "0",
                                               "-1",
                                               "true",
                                               "[[]]",
                                               "[[], []]",
                                               "1",
                                               "[0, 0]",
                                               "1e999",
                                               "0x7f",
                                               "[1, 2, 3]",
                                               "[\"a\"]",
                                               "9223372036854775807",
                                               "-9223372036854775808",
                                               "2.5",
                                               "[nan, 0]",
                                               "[[1, 2]]",
                                               "{ a = 1 }",
                                               "1979-05-27T07:32:00Z",
                                               "4294967296",
                                               "2147483648",
                                               "[1e-300, 1e-300]",
                                               "[true]",
                                               "\"\\u0000\"",
                                               "\"\\u009b\""};
  if (dice.chance(0.7)) return std::string(dice.pick(kWild));
  const TableDoc& table = dice.pick(language_tables());
  return right_value(dice.pick(table.keys), around, dice);
}

void fill_block(Block& block, const TableDoc& table, const Surroundings& around, double fill,
                Dice& dice) {
  const auto contains = [](const auto& group, std::string_view key) {
    return std::find(group.begin(), group.end(), key) != group.end();
  };
  const auto& groups = table.groups.groups;
  const std::size_t chosen = groups.empty() ? 0 : dice.index(groups.size());
  for (const KeyDoc& key : table.keys) {
    if (block.find(key.key)) continue;
    bool wanted = key.required || dice.chance(fill);
    for (std::size_t g = 0; g < groups.size(); ++g)
      if (contains(groups[g], key.key)) wanted = g == chosen;
    // What has blocks of its own is not written inline.
    if (block.header.empty() && table.name.empty() && key.type == KeyType::table) wanted = false;
    if (table.name.empty() && key.type == KeyType::tables) wanted = false;
    if (key.key == "like" && around.prototypes.empty()) wanted = false;
    if (wanted) block.entries.push_back({std::string(key.key), right_value(key, around, dice)});
  }
}

}  // namespace lantern::fuzz
