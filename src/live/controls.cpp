#include "live/controls.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "language/language.hpp"
#include "live/edit.hpp"

namespace lantern::live {
namespace {

using Json = nlohmann::ordered_json;
using language::KeyDoc;
using language::KeyType;
using language::TomlArray;
using language::TomlTable;
using language::TomlValue;

constexpr std::size_t kMostControls = 12;

// Whose keys come first, where there are too many.
constexpr std::string_view kTables[] = {
    "structure", "side",      "level",   "atlas", "texture_pattern",
    "world",     "prototype", "pattern", "body"};

// What a page calls the types of which a hand turns keys.
constexpr std::pair<KeyType, std::string_view> kTypes[] = {{KeyType::whole, "whole"},
                                                           {KeyType::number, "number"},
                                                           {KeyType::truth, "truth"},
                                                           {KeyType::choice, "choice"},
                                                           {KeyType::point, "point"}};

// 1, 2 or 5 of some power of ten, no more than `x`, which is above 0 and finite.
double round_number(double x) {
  double ten = 1;
  for (; ten * 10 <= x; ten *= 10) {
  }
  for (; ten > x; ten /= 10) {
  }
  return ten * (x >= 5 * ten ? 5 : x >= 2 * ten ? 2 : 1);
}

Json json_of(const TomlValue& value) {
  if (const auto* list = std::get_if<TomlArray>(&value.data)) {
    Json all = Json::array();
    for (const TomlValue& one : *list) all.push_back(json_of(one));
    return all;
  }
  const auto plain = []<class T>(const T& of) -> Json {
    if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::string>) return of;
    return nullptr;
  };
  return std::visit(plain, value.data);
}

// Of a value as it is written.
Json json_of(const std::string& value) {
  language::Problems problems;
  const TomlTable table = language::read_toml("x = " + value, problems);
  return table.empty() ? Json() : json_of(table[0].value);
}

class Controls {
 public:
  Controls(std::string_view text, const language::Scenario& scenario)
      : text_(text), scenario_(scenario) {
    language::Problems problems;
    file_ = language::read_toml(language::without_mark(text), problems);
  }

  Json made() {
    for (const std::string_view name : kTables) {
      if (const auto* table = language::value_of<TomlTable>(file_, name))
        add_keys(std::string(name), language::language_table(name), *table, false);
      if (const auto* list = language::value_of<TomlArray>(file_, name))
        for (std::size_t i = 0; i < list->size(); ++i)
          if (const auto* table = std::get_if<TomlTable>(&(*list)[i].data))
            add_table(name, fmt::format("{}[{}]", name, i), *table);
    }
    return Json{{"controls", std::move(controls_)}};
  }

 private:
  // Of single bodies, which may be many, only what is written; of sides only what they override.
  void add_table(std::string_view name, const std::string& path, const TomlTable& table) {
    const language::TableDoc& doc = language::language_table(name);
    add_keys(path, doc, table, name == "body");
    for (const KeyDoc& key : doc.keys)
      if (const auto* part = language::value_of<TomlTable>(table, key.key);
          part && key.type == KeyType::part)
        add_keys(fmt::format("{}.{}", path, key.key), language::language_table(key.of), *part,
                 true);
  }

  void add_keys(const std::string& path, const language::TableDoc& doc, const TomlTable& table,
                bool only_written) {
    for (const KeyDoc& key : doc.keys) {
      const bool is_written = language::entry_of(table, key.key) != nullptr;
      if (!key.by_hand.may || (only_written && !is_written) || !has_use(doc.name, key.key) ||
          (path == doc.name && all_sides_override(doc.name, key.key)))
        continue;
      if (controls_.size() == kMostControls) return;
      if (auto control = control_of(fmt::format("{}.{}", path, key.key), doc.name, key))
        controls_.push_back(std::move(*control));
    }
  }

  // What reading the text cannot tell: the world's rules act while time passes, and so on.
  bool has_use(std::string_view table, std::string_view key) const {
    using language::BodyKind;
    const auto passes_time = [](const language::Step& step) {
      return traits_of(step.verb).passes_time;
    };
    if (key == "split_static") return scenario_.has_body_of(BodyKind::static_body);
    if (key == "integrator" && !scenario_.has_physics()) return false;
    return table != "world" || (scenario_.has_body_of(BodyKind::dynamic_body) &&
                                std::ranges::any_of(scenario_.steps, passes_time));
  }

  bool all_sides_override(std::string_view table, std::string_view key) const {
    const auto* sides = language::value_of<TomlArray>(file_, "side");
    return sides && std::ranges::all_of(*sides, [&](const TomlValue& side) {
             const auto* of_side = std::get_if<TomlTable>(&side.data);
             const auto* part = of_side ? language::value_of<TomlTable>(*of_side, table) : nullptr;
             return part && language::entry_of(*part, key);
           });
  }

  std::optional<Json> control_of(const std::string& path, std::string_view table,
                                 const KeyDoc& key) {
    std::string value = written_ = value_at(text_, path);
    const bool is_written = !value.empty();
    if (!is_written) value = key.fallback.empty() ? key.at_first : key.fallback;
    if (value.empty() && key.type == KeyType::point)
      value = scenario_.world.dimension == 3 ? "[0, 0, 0]" : "[0, 0]";
    if (value.empty() || !fits(path, key, value)) return std::nullopt;
    const auto type =
        std::ranges::find(kTypes, key.type, &std::pair<KeyType, std::string_view>::first);
    Json control{{"path", path},
                 {"table", table},
                 {"key", key.key},
                 {"means", key.doc},
                 {"unit", key.unit},
                 {"type", type->second},
                 {"value", json_of(value)},
                 {"written", is_written}};
    const bool has_room = key.type == KeyType::choice ? add_choices(path, key, control)
                          : key.type == KeyType::truth
                              ? fits(path, key, "true") && fits(path, key, "false")
                              : add_ends(path, key, control);
    return has_room ? std::optional(std::move(control)) : std::nullopt;
  }

  bool add_choices(const std::string& path, const KeyDoc& key, Json& control) const {
    Json& choices = control["choices"] = Json::array();
    for (const std::string_view choice : key.choices)
      if (fits(path, key, fmt::format("\"{}\"", choice))) choices.push_back(choice);
    return choices.size() > 1;
  }

  bool add_ends(const std::string& path, const KeyDoc& key, Json& control) const {
    const Json& value = control["value"];
    const Json list = value.is_array() ? value : Json::array({value});
    std::vector<double> numbers;
    for (const Json& one : list)
      if (one.is_number()) numbers.push_back(one);
    if (numbers.empty()) return false;
    const bool is_whole = key.type == KeyType::whole, is_point = key.type == KeyType::point;
    const auto& size = scenario_.world.bounds.size();
    const double side = scenario_.world.dimension == 3 ? std::min({size.x, size.y, size.z})
                                                       : std::min(size.x, size.y);
    const auto scaled = [&](double end) {
      return key.by_hand.of_world && end > 0 ? round_number(end * side) : end;
    };
    const auto [low, high] = std::ranges::minmax(numbers);
    const double first = std::min(scaled(key.by_hand.least), low);
    const double last = std::max(scaled(key.by_hand.most), high);
    // Where an end is refused, halfway to the value may be none the less good.
    const auto furthest = [&](double end) {
      const double home = is_point ? std::clamp(0.0, first, last) : numbers[0];
      const auto text = [&](double x) {
        const std::string number = fmt::format("{:.12g}", x);
        if (!is_point) return number;
        return fmt::format("[{}]", fmt::join(std::vector(numbers.size(), number), ", "));
      };
      while (end != home && !fits(path, key, text(end))) {
        const double half = (end - home) / 2;
        end = std::abs(half) < (last - first) / 64 ? home
                                                   : home + (is_whole ? std::trunc(half) : half);
      }
      return end;
    };
    const double least = furthest(first), most = furthest(last);
    if (!(least < most)) return false;
    const auto put = [&](const char* name, double x) {
      is_whole ? control[name] = static_cast<std::int64_t>(x) : control[name] = x;
    };
    put("least", least);
    put("most", most);
    put("step", is_whole ? 1 : round_number((most - least) / 50));
    return true;
  }

  // Is the text with this value a scenario, in which the key changes something?
  bool fits(const std::string& path, const KeyDoc& key, const std::string& value) const try {
    const auto is_idle = [&](const language::Noticed& one) {
      return one.kind == language::Warning::settings &&
             one.message.starts_with(fmt::format("'{}' ", key.key));
    };
    if (value == written_) return std::ranges::none_of(scenario_.noticed, is_idle);
    const std::string changed = with_value(text_, path, value);
    return std::ranges::none_of(language::parse_scenario(changed, scenario_.file).noticed, is_idle);
  } catch (const ScenarioError&) {
    return false;
  } catch (const Refused&) {
    return false;
  }

  std::string_view text_;
  const language::Scenario& scenario_;
  TomlTable file_;
  std::string written_;  // at the path of the control that is made
  Json controls_ = Json::array();
};

}  // namespace

std::string controls_json(std::string_view text, const language::Scenario& scenario) {
  return Controls(text, scenario).made().dump();
}

}  // namespace lantern::live
