#include "language/keys/key.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/check.hpp"
#include "geometry/vec.hpp"
#include "language/language.hpp"
#include "language/scenario.hpp"

namespace lantern::language {

std::string Filled<double>::literal(double value) {
  std::string text = fmt::format("{:.12g}", value);
  if (const std::size_t zero = text.find("e-0"); zero != text.npos) text.erase(zero + 2, 1);
  return text;
}

namespace {

void add(const Note& note, KeyDoc& doc) {
  doc.required |= note.required;
  doc.above_least |= note.above_least;
  doc.may_be_empty |= note.may_be_empty;
  doc.least = std::max(doc.least, note.least);
  doc.most = std::min(doc.most, note.most);
  if (!note.fallback.empty()) doc.fallback = note.fallback;
  if (!note.otherwise.empty()) doc.otherwise = note.otherwise;
  if (!note.unit.empty()) doc.unit = note.unit;
  if (note.unit.starts_with("°")) doc.scale = kDegree;
  if (!note.of.empty()) doc.of = note.of;
  if (!note.form.empty()) doc.form = note.form;
  if (!note.advice.empty()) doc.advice = note.advice;
  if (note.by_hand.may) doc.by_hand = note.by_hand;
  if (note.pattern) doc.pattern = *note.pattern;
  if (note.choices.empty()) return;
  doc.choices.assign(note.choices.begin(), note.choices.end());
  if (doc.type == KeyType::texts) doc.type = KeyType::choices_list;
  if (doc.type == KeyType::truth) doc.type = KeyType::choice;
}

// What each panel shows, in its own words.
std::string_view panels_text() {
  static const std::string text = [] {
    std::string words = "What is drawn, from left to right";
    const char* before = ": ";
    for (const PanelKind& kind : panel_kinds())
      if (!kind.words.empty()) words += std::exchange(before, "; ") + std::string(kind.words);
    return words + ".";
  }();
  return text;
}

TableDoc file_table() {
  using S = ScenarioSpec;
  TableDoc table = {
      "", "The file's own keys",
      "A scenario of Lantern. These keys stand at the top, before the first [table]."};
  table.keys = {
      key(&S::title, "title", "The thin line above every frame.", must(), range(1, 80)),
      key(&S::source, "source", "The section of the lecture that the scenario shows.",
          range(0, 80)),
      key(&S::idea, "idea", "The one idea of the sequence, in a line.", range(0, kMostCaption)),
      key(&S::lecture, "lecture", "Its place in the order in which one would teach.",
          range(1, kMostInOrder), or_else("behind those that have one")),
      key(&S::needs, "needs", "Names of scenarios that should be seen before.", or_else("none")),
      key(&S::name, "name", "Names the output folder and its files.", like(kFilePattern),
          or_else("the file's name, made safe")),
      key(&S::seed, "seed",
          "Where random patterns begin; the same seed gives the same frames everywhere.",
          range(0, kMostWhole)),
      key(&S::pace, "pace", "One frame a step, or one for each thing that the algorithm does."),
      key(&S::panels, "panels", panels_text(), or_else("what the scenario uses")),
      key(KeyType::table, "display", "What frames show.", holds("display")),
      key(KeyType::texts, "headline",
          "Up to three counts and measures that stand at the foot of every frame, the first one "
          "large. Of sides they stand under each; one of a single side, as `eager.nodes`, is large "
          "at the ending's foot, too. Words of its own may follow, for one and for many or the "
          "same for both: `\"pairs: pair left/pairs left\"`, `\"all_pairs: by brute force\"`.",
          or_else("what the caption quotes, then what the scenario is about")),
      key(KeyType::table, "world", "Where bodies are.", holds("world")),
      key(KeyType::table, "structure", "How the world is partitioned.", holds("structure")),
      key(KeyType::tables, "prototype", "Keys that several bodies share.", at_most(kMostPrototypes),
          holds("prototype")),
      key(KeyType::tables, "body", "One body each.", at_most(kMostBodies), holds("body")),
      key(KeyType::tables, "pattern", "Many bodies each.", at_most(kMostBodies), holds("pattern")),
      key(KeyType::table, "map", "Bodies as letters of a drawing.", holds("map")),
      key(KeyType::tables, "spring", "One spring each.", at_most(kMostLinks), holds("spring")),
      key(KeyType::tables, "joint", "One joint each.", at_most(kMostLinks), holds("joint")),
      key(KeyType::table, "level", "Walls, to be compiled into a BSP.", holds("level")),
      key(KeyType::table, "chart", "Counts of steps as lines or bars.", holds("chart")),
      key(KeyType::table, "problem", "The known answer that it is measured against.",
          holds("problem")),
      key(KeyType::table, "atlas", "The image that textures are packed into.", holds("atlas")),
      key(KeyType::tables, "texture", "One texture each.", at_most(kMostTextures),
          holds("texture")),
      key(KeyType::tables, "texture_pattern", "Many textures each.", at_most(kMostTextures),
          holds("texture_pattern")),
      key(KeyType::tables, "element", "What the atlas's screen shows, from the back to the front.",
          at_most(kMostElements), holds("element")),
      key(KeyType::tables, "side", "The same under other settings, side by side.",
          at_most(kMostSides), holds("side")),
      key(&S::language, "language",
          "Of the fixed words on frames and pages, as `\"de\"`: German, Spanish, French, Japanese, "
          "Polish and Portuguese are there. Texts that stand for the file's own are read from a "
          "file of the same name in the folder `de` beside it.",
          range(2, 35), or_else("English")),
      key(&S::words_file, "words",
          "A file with a table of such words for another language, beside this one.", range(1, 200),
          or_else("none")),
      key(KeyType::tables, "step", "The script.", must(), at_most(kMostSteps), holds("step")),
  };
  return table;
}

TableDoc step_table() {
  TableDoc table = {
      "step", "[[step]]",
      "One step of the script. Each has a verb in `do`, the verb's own keys, and any of these."};
  table.keys = {
      key(KeyType::text, "do", "The verb, one of those below.", must()),
      key(&Step::name, "name", "To ask for this step's frames with `--at`.", like(kEventPattern),
          or_else("the verb")),
      key(&Step::repeat, "repeat",
          "So many of this step, one after the other, as if it stood there so often; what it says "
          "of the `ending` and asks is of the last.",
          range(1, 100)),
      key(&Step::part, "part", "Stands behind the title from here on.", range(1, 60),
          or_else("as before")),
      key(&Step::caption, "caption", "Explains the frame. It may quote counts.",
          range(0, kMostCaption)),
      key(&Step::after, "after",
          "Stands on the step's last frame in place of the `caption`, also if that is its only "
          "one, and may quote counts of that frame. In event pace the frames before it say what "
          "the algorithm does.",
          range(0, kMostCaption), or_else("the `caption`")),
      key(&Step::speaker_notes, "notes",
          "For whoever speaks: shown in the speaker's view of a lesson page, on no frame.",
          range(0, kMostNotesText)),
      key(&Step::question, "question",
          "For the students, once they have seen the sequence. What the step expects proves the "
          "answer.",
          range(1, kMostCaption), or_else("asks none")),
      key(&Step::answer, "answer",
          "To the `question`: what the step's last frame shows. It may quote counts.",
          range(1, kMostCaption), or_else("answers none")),
      key(&Step::predict, "predict",
          "A count of the step's last frame, which a live page asks for before it shows the "
          "`answer`; it then tells the engine's own count of the world as it is by then.",
          range(1, 64), or_else("asks for none")),
      key(&Step::plot, "plot", "Adds a point to the [chart], or a bar with this label.",
          range(1, 40), or_else("adds none")),
      key(KeyType::texts, "headline", "The scenario's `headline` from here on.",
          or_else("as before")),
      key(KeyType::texts, "lit",
          "What is lit on the step's frames, but for those of events: bodies by their names, nodes "
          "by their labels, with the way down to them. `[]` lights nothing.",
          empty_or_at_most(100), or_else("what the step does")),
      key(&Step::panels, "panels",
          "Those of the scenario's own `panels` that are shown from here on.",
          or_else("as before")),
      key(KeyType::tables, "ruler", "Lengths that are measured on the step's frames.",
          at_most(kMostRulers), holds("step.ruler")),
      key(KeyType::table, "code",
          "The function of the lecture's source that is shown from here on.", holds("code")),
      key(&Step::ending, "ending",
          "Of the last step: its last frame is what is to be kept in mind, with the headline's "
          "numbers large."),
      key(KeyType::table, "expect", "What must hold when the step is done.", holds("expect")),
      key(KeyType::table, "always", "What must hold on every frame of the step.", holds("expect")),
      key(KeyType::table, "display", "What this step's frames show.", holds("display")),
      key(KeyType::table, "view", "The part of a 2D world that is shown from here on.",
          holds("view")),
      key(KeyType::table, "camera", "From where a 3D world is seen from here on.", holds("camera")),
      key(&Step::orbit, "orbit",
          "How far the camera goes round its target while time passes in this step, "
          "counter-clockwise from above; in a step without time it is there at once.",
          range(-kMostTurn, kMostTurn), in("°"), or_else("it stands still")),
      note_key(),
  };
  return table;
}

bool in_group(char c, std::string_view group) {
  for (std::size_t i = 0; i < group.size(); ++i) {
    const bool is_range = i + 2 < group.size() && group[i + 1] == '-';
    if (is_range ? group[i] <= c && c <= group[i + 2] : c == group[i]) return true;
    if (is_range) i += 2;
  }
  return false;
}

}  // namespace

KeyDoc made(KeyType type, std::string_view name, std::string_view meaning,
            std::initializer_list<Note> notes) {
  KeyDoc doc{.key = name, .type = type, .doc = meaning};
  for (const Note& note : notes) add(note, doc);
  return doc;
}

KeyDoc made(const MemberKind& kind, const std::type_info& owner, std::size_t offset,
            const void* initial, std::string_view name, std::string_view meaning,
            std::initializer_list<Note> notes) {
  KeyDoc doc = made(kind.type, name, meaning, notes);
  if (kind.choices && doc.choices.empty()) doc.choices = kind.choices();
  doc.owner = &owner;
  doc.offset = offset;
  doc.fill = kind.fill;
  if (doc.by_hand.may) doc.at_first = kind.literal(initial, doc.scale);
  if (doc.required || !doc.otherwise.empty()) return doc;
  doc.fallback = kind.type == KeyType::truth && doc.type == KeyType::choice
                     ? fmt::format("\"{}\"", doc.choices[*static_cast<const bool*>(initial)])
                     : kind.literal(initial, doc.scale);
  if (doc.fallback == "\"\"" && doc.least > 0) doc.fallback.clear();  // no text may be empty here
  return doc;
}

std::string NamePattern::expression() const {
  return fmt::format("^[{}][{}]{{0,{}}}$", first, rest, most - 1);
}

bool matches(std::string_view text, const NamePattern& pattern) {
  return !text.empty() && text.size() <= pattern.most && in_group(text[0], pattern.first) &&
         std::ranges::all_of(text.substr(1), [&](char c) { return in_group(c, pattern.rest); });
}

std::string legal_name(std::string_view text, const NamePattern& pattern) {
  std::string name = "a";  // of all patterns' first letters
  for (const char c : text) {
    const char small = 'A' <= c && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    if (matches(name + c, pattern))
      name += c;
    else if (matches(name + small, pattern))
      name += small;
    else if (name.back() != '_' && matches(name + '_', pattern))
      name += '_';
  }
  while (name.ends_with('_')) name.pop_back();
  const std::string without = name.substr(1);
  return matches(without, pattern) ? without : name;
}

KeyDoc body_key() { return key(KeyType::text, "body", "Its name.", must(), range(1, 64)); }

KeyDoc bodies_key() {
  return key(KeyType::texts, "bodies",
             "Names of bodies, of patterns for all of theirs, or ranges as `dot2..dot9`.", must());
}

KeyDoc pace_key() {
  return key(&Step::pace, "pace", "Of this step alone.", or_else("the scenario's"));
}

KeyDoc events_key(std::initializer_list<std::string_view> names) {
  return key(&Step::events, "events", "When the pace is `event`, only these give frames.",
             one_of(names), or_else("all"));
}

const KeyDoc* TableDoc::find(std::string_view key) const {
  const auto found = std::ranges::find(keys, key, &KeyDoc::key);
  return found == keys.end() ? nullptr : &*found;
}

std::span<const TableDoc> language_tables() {
  static const std::vector<TableDoc> tables = {
      file_table(),      world_table(),   structure_table(), planes_table(),
      prototype_table(), body_table(),    pattern_table(),   map_table(),
      spring_table(),    joint_table(),   level_table(),     chart_table(),
      problem_table(),   atlas_table(),   texture_table(),   texture_pattern_table(),
      element_table(),   side_table(),    step_table(),      ruler_table(),
      expect_table(),    display_table(), view_table(),      camera_table(),
      note_table(),      code_table()};
  return tables;
}

const TableDoc& language_table(std::string_view name) {
  const auto tables = language_tables();
  const auto found = std::ranges::find(tables, name, &TableDoc::name);
  LANTERN_CHECK(found == tables.end(), ==, false);
  return *found;
}

// In the order of KeyType.
const TypeWords& words_of(KeyType type) {
  static constexpr TypeWords kWords[] = {
      {"text", "\"…\""},
      {"whole number", ""},
      {"number", "1.5"},
      {"true or false", "true"},
      {"one of", ""},
      {"point", "[1.5, 2]"},
      {"two numbers", "[0.5, 1]"},
      {"[width, height]", "[64, 32]"},
      {"list of texts", "[\"…\"]"},
      {"list of texts, or none", "[\"…\"]"},
      {"list of polygons", "[[[0, 0], [8, 0], [8, 6]]]"},
      {"whole number, or list of texts", "2, or a list of names"},
      {"list of", "[\"…\"]"},
      {"text of several lines", "\"\"\"…\"\"\""},
      {"number, or", ""},
      {"table", ""},
      {"tables", ""},
      {"keys of", ""},
      {"list of pairs", "[[\"red\", \"pink\"]]"},
      {"table: name → whole number", "{ pink = 2 }"},
      {"table: name → number", "{ pink = 2 }"},
      {"table: name → point", "{ ball = [12, 14] }"},
      {"table: letter → name", "{ \"#\" = \"wall\" }"},
  };
  return kWords[static_cast<std::size_t>(type)];
}

std::string form_of(const KeyDoc& key, int dimension) {
  std::string value(words_of(key.type).example);
  if (key.type == KeyType::tables) return fmt::format("a [[{}]]", key.of);
  if (key.type == KeyType::whole) value = fmt::format("{}", std::max(key.least, 1.0));
  if (key.type == KeyType::choice) value = fmt::format("\"{}\"", key.choices.back());
  if (key.type == KeyType::point && dimension == 3) value = "[1.5, 2, 0.5]";
  if (key.type == KeyType::turn) value = "45";
  if (key.type == KeyType::name_points && dimension == 3) value = "{ ball = [12, 14, 0] }";
  return fmt::format("{} = {}", key.key, value);
}

std::string range_text(const KeyDoc& doc) {
  const bool from = std::isfinite(doc.least), to = std::isfinite(doc.most);
  if (from && to && doc.above_least)
    return fmt::format("above {}, at most {}", doc.least, doc.most);
  if (from && to) return fmt::format("{} to {}", doc.least, doc.most);
  if (from) return fmt::format("{} {}", doc.above_least ? "above" : "at least", doc.least);
  return to ? fmt::format("at most {}", doc.most) : "";
}

}  // namespace lantern::language
