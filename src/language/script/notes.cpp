// What a step points at: [[step.note]]s, [[step.ruler]]s, and the lecture's `code`.
#include <algorithm>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "language/code_text.hpp"
#include "language/keys/key.hpp"
#include "language/script/script_reading.hpp"

namespace lantern::language {
namespace {

constexpr double kMostNoteLetters = 40;
constexpr double kMostNotes = 6;  // on a step: more are a text, not notes

class NoteReader {
 public:
  NoteReader(const TableReader& table, Draft& draft, const ScriptState& state)
      : table_(table), draft_(draft), state_(state) {}

  // Adds a problem if what it is about is not there.
  bool is_good(NoteSpec& note) {
    check_quotes(table_, "text", draft_, state_.past);
    // Where there are sides, each has been given its own notes already.
    if (const auto side = table_.named("side"))
      table_.bad_value("side", fmt::format("there is no side {}", in_quotes(side->name)),
                       "the name of a [[side]] of this file");
    return read_body(note) || read_pair(note) || read_node(note) || read_count(note) ||
           read_point(note);
  }

 private:
  bool add_body(const Named& name, NoteSpec& note) {
    const auto body = one_body(name, draft_);
    if (!body) return false;
    if (!state_.in_world[*body]) {
      draft_.problems.add(name.where,
                          fmt::format("'{}' is not in the world at this step", name.name),
                          "insert it first, or note it later");
      return false;
    }
    note.bodies.push_back(*body);
    return true;
  }

  bool read_body(NoteSpec& note) {
    const auto name = table_.named("body");
    note.of = NoteOf::body;
    return name && add_body(*name, note);
  }

  bool read_pair(NoteSpec& note) {
    const std::vector<Named> pair = table_.names("pair");
    if (pair.empty()) return false;
    note.of = NoteOf::pair;
    if (pair.size() != 2)
      table_.bad_value("pair", fmt::format("a pair has two names, not {}", pair.size()),
                       "as pair = [\"red\", \"pink\"]");
    else if (pair[0].name == pair[1].name)
      draft_.problems.add(pair[1].where,
                          fmt::format("{} is no pair with itself", in_quotes(pair[1].name)));
    else
      return add_body(pair[0], note) && add_body(pair[1], note);
    return false;
  }

  bool read_node(NoteSpec& note) {
    if (!table_.is_good("node")) return false;
    note.of = NoteOf::node;
    note.name = *table_.get<std::string>("node");
    return has_nodes(table_, "node", state_.past);
  }

  bool read_count(NoteSpec& note) {
    if (!table_.is_good("count")) return false;
    note.of = NoteOf::count;
    note.name = *table_.get<std::string>("count");
    if (const CountDoc* count = find_in(known_counts(), note.name)) {
      const std::string why = why_not_counted(*count, state_.past);
      if (!why.empty())
        table_.bad_value("count", fmt::format("'{}' is not counted here: {}", note.name, why));
      return why.empty();
    }
    const std::vector<std::string_view> known = mapped(known_counts(), &CountDoc::name);
    table_.bad_value("count", fmt::format("there is no count {}", in_quotes(note.name)),
                     nearest(note.name, known));
    return false;
  }

  bool read_point(NoteSpec& note) {
    const auto point = table_.get<Vec<3>>("point");
    if (!point || draft_.dimension == 0) return false;
    note.of = NoteOf::point;
    note.point = *point;
    if (contains(draft_.scenario.world.bounds, *point)) return true;
    table_.bad_value("point", "the point lies outside the world", "a note points at what is shown");
    return false;
  }

  const TableReader& table_;
  Draft& draft_;
  const ScriptState& state_;
};

// Exactly one of a body and a point.
bool has_one(const TableReader& table, const char* body, const char* point, Draft& draft) {
  if (table.has(body) != table.has(point)) return true;
  draft.problems.add(table.has(body) ? table.key_place(point) : table.where(),
                     fmt::format("a ruler has {} '{}' and '{}'",
                                 table.has(body) ? "only one of" : "one of", body, point),
                     fmt::format("'{}' is a body, '{}' a point of the world", body, point));
  return false;
}

// As it would be written: with its class if the name has one.
std::string nearest_function(const std::string& name) {
  const bool with_class = name.find("::") != name.npos;
  const std::vector<std::string> functions = code_functions();
  std::vector<std::string_view> known;
  for (const std::string_view function : functions) {
    const std::string_view own = function.substr(with_class ? 0 : function.rfind(':') + 1);
    if (std::ranges::count(known, own) == 0) known.push_back(own);
  }
  return nearest(name, known);
}

}  // namespace

TableDoc note_table() {
  TableDoc table = {
      "step.note", "[[step.note]]",
      "A few words beside what they are about, with a thin line to it, on this step's frames; or "
      "all at once as `note = [{ text = \"here\", body = \"red\" }]`."};
  table.keys = {
      key(&NoteSpec::text, "text", "The words. They may quote counts, as a caption does.", must(),
          range(1, kMostNoteLetters)),
      key(KeyType::text, "body", "A body's name.", range(1, 64)),
      key(KeyType::text, "node", "A node by its label: \"root\", \"1.3\".", range(1, 64)),
      key(KeyType::point, "point", "A point of the world.", range(-kFar, kFar)),
      key(KeyType::texts, "pair", "The names of two bodies, as `[\"red\", \"pink\"]`."),
      key(KeyType::text, "count", "A count, which then stands beside the caption.", range(1, 64)),
      key(&NoteSpec::event, "event", "The event on whose frames it stands, in event pace.",
          range(1, 64), or_else("all frames")),
      key(KeyType::text, "side", "The one [[side]] on which it stands.", range(1, 64),
          or_else("all sides")),
  };
  table.groups = {{{"body"}, {"node"}, {"point"}, {"pair"}, {"count"}}};
  return table;
}

KeyDoc note_key() {
  return key(KeyType::tables, "note", "Words beside what they are about.", at_most(kMostNotes),
             holds("step.note"));
}

void read_notes(const TableReader& step, Step& to, Draft& draft, const ScriptState& state) {
  const auto read = [&](const TableReader& table, NoteSpec& note) {
    if (NoteReader(table, draft, state).is_good(note)) to.notes.push_back(std::move(note));
  };
  for_each<NoteSpec>(step, "note", draft, read, "a note");
}

TableDoc ruler_table() {
  using R = RulerSpec;
  return {"step.ruler",
          "[[step.ruler]]",
          "A length, measured and drawn on every frame of the step, while both its ends are there: "
          "between the centres of two bodies, or points.",
          {key(KeyType::text, "a", "The body at which it begins.", range(1, 64),
               or_else("none: give `from`")),
           key(&R::from, "from", "A point of the world, instead of `a`.", range(-kFar, kFar),
               or_else("none: give `a`")),
           key(KeyType::text, "b", "The body at which it ends.", range(1, 64),
               or_else("none: give `to`")),
           key(&R::to, "to", "A point of the world, instead of `b`.", range(-kFar, kFar),
               or_else("none: give `b`")),
           key(&R::text, "text", "Stands before the length.", range(0, 24)),
           key(&R::change, "change",
               "Says how much longer or shorter it is than when the step began, beside a ghost of "
               "that length.")}};
}

std::vector<RulerSpec> read_rulers(const TableReader& step, ScriptReading& script) {
  std::vector<RulerSpec> rulers;
  Draft& draft = script.draft;
  for_each<RulerSpec>(step, "ruler", draft, [&](const TableReader& table, RulerSpec& ruler) {
    has_one(table, "a", "from", draft);
    has_one(table, "b", "to", draft);
    ruler.a = body_at(table, "a", draft);
    ruler.b = body_at(table, "b", draft);
    if (ruler.a && ruler.b && *ruler.a == *ruler.b)
      table.bad_value("b", "a ruler from a body to itself", "name another one");
    rulers.push_back(std::move(ruler));
  });
  return rulers;
}

TableDoc code_table() {
  TableDoc table{
      "code",
      "code",
      "Which function of the lecture's own source the panel `code` shows from this step on, "
      "and which of its lines the step is about. Without it the panel goes on with the "
      "function of the step before. Sides may each have their own, by their names, and then each "
      "has a panel of its own. In event pace a `lecture_quadtree` lights the line that it "
      "is in by itself, as do the phases of a step with `contacts = \"lecture\"`.",
      {key(&CodeSpec::function, "function",
           "Its name, with its class or without: \"QuadTreeNode::Insert\", \"Insert\".", must(),
           range(1, 80)),
       key(&CodeSpec::line, "line",
           "A text; each line of the function that has it is lit. It must be in one.", range(0, 80),
           or_else("none is lit"))}};
  table.by_side = true;
  return table;
}

void read_code(const TableReader& step, Step& to, Draft& draft) {
  const auto check = [&](const TableReader& table, const CodeSpec& spec) {
    to.code = spec;
    if (!shows(draft.scenario.panels, "code"))
      draft.problems.add(table.where(), "no panel shows 'code'",
                         "name it: panels = [\"world\", \"tree\", \"code\"]");
    if (!table.is_good("function")) return;
    std::optional<CodeText> code = code_of(spec.function);
    if (!code)
      return table.bad_value("function",
                             fmt::format("the lecture's source has no function {} of several lines",
                                         in_quotes(spec.function)),
                             [name = spec.function] { return nearest_function(name); });
    if (!spec.line.empty() && light_line(*code, spec.line) == 0) {
      table.bad_value(
          "line", fmt::format("no line of '{}' has {}", code->function, in_quotes(spec.line)),
          nearest(spec.line, mapped<std::string_view>(code->lines, &CodeText::Line::text)));
    }
  };
  for_each<CodeSpec>(step, "code", draft, check, "'code'");
}

}  // namespace lantern::language
