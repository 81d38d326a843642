#include "language/words.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/hash.hpp"
#include "base/suggest.hpp"
#include "language/counts.hpp"
#include "language/language.hpp"
#include "language/scenario.hpp"
#include "language/text/problems.hpp"

namespace lantern::language {
namespace {

constexpr std::array<std::string_view, 6> kPlurals = {"one",     "up_to_one", "polish",
                                                      "russian", "czech",     "none"};

// A field of a format: "{}", "{2}", "{:.3g}".
constexpr std::size_t kNone = 99;  // not a place
struct Field {
  std::size_t index;
  std::string_view spec;
  std::string_view written;
  bool operator==(const Field& other) const { return index == other.index && spec == other.spec; }
};

std::vector<Field> fields_of(std::string_view text) {
  std::vector<Field> fields;
  std::size_t next = 0;
  for (std::size_t at = text.find('{'); at != text.npos; at = text.find('{', at + 1)) {
    const std::string_view inside = text.substr(at + 1, text.find('}', at) - at - 1);
    const std::size_t colon = std::min(inside.find(':'), inside.size());
    const std::string_view number = inside.substr(0, colon);
    const bool is_digit = number.size() == 1 && number[0] >= '0' && number[0] <= '9';
    fields.push_back({number.empty() ? next++
                      : is_digit     ? static_cast<std::size_t>(number[0] - '0')
                                     : kNone,
                      inside.substr(colon), inside});
  }
  return fields;
}

// Why the translation cannot be filled in as the English is; empty if it can.
std::string fault_of(std::string_view english, std::string_view said) {
  if (std::ranges::count(said, '{') != std::ranges::count(said, '}')) return "a brace stands alone";
  const std::vector<Field> own = fields_of(english), given = fields_of(said);
  std::size_t most = 0;
  for (const Field& field : own) most = std::max(most, field.index + 1);
  for (const Field& field : given)
    if (field.index >= most || (!field.spec.empty() && std::ranges::find(own, field) == own.end()))
      return fmt::format("the English has no '{{{}}}'",
                         field.index == kNone ? std::string(field.written)
                                              : fmt::format("{}{}", field.index, field.spec));
  const bool numbered = english.find("{0}") != english.npos || english.find("{2}") != english.npos;
  for (const Field& field : own)
    if (!numbered && std::ranges::find(given, field.index, &Field::index) == given.end())
      return fmt::format("'{{{}{}}}' is missing", field.index, field.spec);
  return "";
}

class WordsReader {
 public:
  WordsReader(const TomlTable& file, const WordTable& base, Problems& problems)
      : problems_(problems), words_(base) {
    for (const TomlEntry& entry : file) read(entry);
    for (const TomlEntry& entry : file)
      if (entry.key == "words") read_words(entry);
  }

  WordTable words() && { return std::move(words_); }

 private:
  void read(const TomlEntry& entry) {
    const auto* text = std::get_if<std::string>(&entry.value.data);
    const auto* table = std::get_if<TomlTable>(&entry.value.data);
    if (entry.key == "words" && table) return;
    if (entry.key == "texts" && table) return read_texts(*table);
    if (entry.key == "language" && text) {
      words_.language = *text;
    } else if (entry.key == "decimal" && text && text->size() == 1) {
      words_.decimal = text->front();
    } else if (entry.key == "plural" && text) {
      const auto rule = std::ranges::find(kPlurals, *text);
      if (rule == kPlurals.end())
        problems_.add(entry.value.where, fmt::format("there is no rule {}", in_quotes(*text)),
                      suggestion(*text, kPlurals));
      else
        words_.plural = static_cast<Plural>(rule - kPlurals.begin());
    } else {
      problems_.add(entry.where, fmt::format("{} is not read so", in_quotes(entry.key)),
                    "a table of words has language = \"sv\", plural = \"one\", decimal = \",\", "
                    "[words] and [texts]");
    }
  }

  void read_texts(const TomlTable& table) {
    for_each_text(table, [&](const TomlEntry& entry, const std::string& text) {
      if (text.empty()) return;
      words_.texts.insert_or_assign(entry.key, text);
      words_.idle.push_back(entry.key);
    });
  }

  void read_words(const TomlEntry& all) {
    const auto known = words_in(languages().empty() ? "" : languages().front());
    const auto* table = std::get_if<TomlTable>(&all.value.data);
    if (!table) return;
    for_each_text(*table, [&](const TomlEntry& entry, const std::string& text) {
      if (text.empty()) return;  // still to be translated
      const auto forms = static_cast<std::size_t>(std::ranges::count(text, '/')) + 1;
      const bool is_noun =
          entry.key.find('/') != std::string::npos && entry.key.find('{') == std::string::npos;
      std::string fault = fault_of(entry.key, text);
      if (known && !known->said.contains(entry.key))
        problems_.add(entry.where, fmt::format("no picture says {}", in_quotes(entry.key)),
                      near(entry.key, *known));
      else if (is_noun && forms != 1 && forms != forms_of(words_.plural))
        problems_.add(
            entry.value.where,
            fmt::format("{} forms, and the rule '{}' has {}", forms,
                        kPlurals[static_cast<std::size_t>(words_.plural)], forms_of(words_.plural)),
            "between them stands a slash: \"leaf/leaves\"");
      else if (!fault.empty())
        problems_.add(entry.value.where, std::move(fault));
      words_.said.insert_or_assign(entry.key, text);
    });
    if (!known) return;
    words_.missing.clear();
    for (const auto& [english, said] : known->said)
      if (!words_.said.contains(english)) words_.missing.push_back(english);
  }

  void for_each_text(const TomlTable& table, auto&& f) {
    for (const TomlEntry& entry : table)
      if (const auto* text = std::get_if<std::string>(&entry.value.data))
        f(entry, *text);
      else
        problems_.add(entry.value.where, "a text is wanted, as \"root\" = \"rot\"");
  }

  static std::string near(std::string_view english, const WordTable& known) {
    const auto key = [](const auto& entry) -> std::string_view { return entry.first; };
    return suggestion(english, mapped(known.said, key));
  }

  Problems& problems_;
  WordTable words_;
};

// f(text) for each text of the scenario that is drawn or read out, empty ones too; not of its
// sides.
void for_each_text(ScenarioSpec& scenario, auto&& f) {
  for (std::string* text :
       {&scenario.title, &scenario.source, &scenario.idea, &scenario.side_title})
    f(*text);
  for (std::string& front : scenario.headline) f(front);
  if (scenario.chart)
    for (std::string& label : scenario.chart->labels) f(label);
  for (BodySpec& body : scenario.bodies) f(body.label);
  for (Step& step : scenario.steps) {
    for (std::string* text : {&step.part, &step.caption, &step.after, &step.speaker_notes,
                              &step.question, &step.answer})
      f(*text);
    if (step.plot) f(*step.plot);
    for (std::string& front : step.headline) f(front);
    for (NoteSpec& note : step.notes) f(note.text);
    for (RulerSpec& ruler : step.rulers) f(ruler.text);
    if (auto* pack = std::get_if<Pack>(&step.verb)) f(pack->free_name);
    if (auto* compare = std::get_if<Compare>(&step.verb)) f(compare->row), f(compare->verdict);
  }
}

// f(name, label) for each that is written on pictures; lines and textures have no label.
void for_each_name(ScenarioSpec& scenario, auto&& f) {
  for (BodySpec& body : scenario.bodies)
    if (body.label.empty()) f(body.name, &body.label);
  for (const TextureSpec& texture : scenario.textures) f(texture.name, nullptr);
  for (const StructureSpec* structure : scenario.structures())
    for (const PlaneSpec& plane : structure->planes) f(plane.name, nullptr);
}

// Is there anything to translate: more than a count's name and numbers?
bool is_text(const std::string& text) {
  return !find_count(text) && std::ranges::any_of(text, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c & 0x80) != 0;
  });
}

void put(std::string& text, WordTable& words) {
  const auto found = words.texts.find(text);
  if (found == words.texts.end()) {
    if (!words.texts.empty() && is_text(text)) words.missing.push_back(text);
    return;
  }
  const std::vector<std::string> known = placeholders_of(text);
  for (const std::string& name : placeholders_of(found->second))
    if (std::ranges::find(known, name) == known.end()) {
      Diagnostic wrong;
      wrong.message = fmt::format("{} quotes '{}', and {} does not", in_quotes(found->second), name,
                                  in_quotes(text));
      throw ScenarioError(wrong);
    }
  std::erase(words.idle, text);
  text = found->second;
}

// What has a name that is among the table's texts is called so: a body by its label, others, whose
// names stay in facts, by a fixed word.
void put_names(ScenarioSpec& scenario, WordTable& words) {
  for_each_name(scenario, [&](const std::string& name, std::string* label) {
    const auto found = words.texts.find(name);
    if (found == words.texts.end()) return;
    std::erase(words.idle, name);
    (label ? *label : words.said[name]) = found->second;
  });
}

}  // namespace

WordTable read_words(std::string_view text, const std::string& path, const WordTable& base) {
  Problems problems;
  const std::string_view bare = without_mark(text);
  const TomlTable file = read_toml(bare, problems);
  problems.raise(path, bare);
  WordTable words = WordsReader(file, base, problems).words();
  problems.raise(path, bare);
  return words;
}

std::string to_json(const WordTable& words) {
  return nlohmann::json{{"language", words.language},
                        {"plural", kPlurals[static_cast<std::size_t>(words.plural)]},
                        {"decimal", std::string(1, words.decimal)},
                        {"said", words.said},
                        {"texts", words.texts}}
      .dump();
}

WordTable word_table(const std::string& json) {
  const auto value = nlohmann::json::parse(json);
  WordTable words;
  value.at("language").get_to(words.language);
  const auto plural = std::ranges::find(kPlurals, value.at("plural").get<std::string>());
  if (plural != kPlurals.end()) words.plural = static_cast<Plural>(plural - kPlurals.begin());
  words.decimal = value.at("decimal").get<std::string>().at(0);
  for (const auto& [english, said] : value.at("said").items()) words.said[english] = said;
  for (const auto& [own, said] : value.at("texts").items()) words.texts[own] = said;
  return words;
}

std::vector<std::string> texts_of(ScenarioSpec scenario) {
  std::vector<std::string> texts;
  const auto add = [&](const std::string& text) {
    if (is_text(text) && std::ranges::find(texts, text) == texts.end()) texts.push_back(text);
  };
  for_each_text(scenario, add);
  for (const auto& side : scenario.sides)
    for (const std::string& text : texts_of(*side)) add(text);
  for_each_name(scenario, [&](const std::string& name, const std::string* /*label*/) {
    if (name.find_last_of("0123456789") + 1 != name.size()) add(name);  // no pattern's
  });
  return texts;
}

const WordTable* ScenarioSpec::words_of(const std::string& own) const {
  if (!words || language == words->language) return words.get();
  const auto said = [&](const auto& one) { return one.second == own; };
  return std::ranges::any_of(words->texts, said) ? words.get() : words_in(language).get();
}

void translate(ScenarioSpec& scenario, const WordTable& table) {
  auto words = std::make_shared<WordTable>(table);
  const auto speak = [&](ScenarioSpec& it) {
    for_each_text(it, [&](std::string& text) { put(text, *words); });
    put_names(it, *words);
    it.words = words;
  };
  for (auto& side : scenario.sides) {
    ScenarioSpec own = *side;
    own.language = scenario.language;
    speak(own);
    side = std::make_shared<const Scenario>(Scenario(std::move(own)));
  }
  speak(scenario);
  std::ranges::sort(words->missing);
  words->missing.erase(std::ranges::unique(words->missing).begin(), words->missing.end());
  Hash hash;
  hash.add(scenario.text_hash).add(words->language);
  for (const auto* said : {&words->said, &words->texts})
    for (const auto& [english, other] : *said) hash.add(english).add(other);
  scenario.text_hash = hash.value();
}

}  // namespace lantern::language
