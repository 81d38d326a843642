// [[step.note]]: a few words, and what they are about.
#include <fmt/format.h>

#include "scenario/key.hpp"
#include "scenario/script_reading.hpp"

namespace lantern::scenario {
namespace {

constexpr double kMostNoteLetters = 40;
constexpr double kMostNotes = 6;  // on a step: more are a text, not notes

class NoteReader {
 public:
  NoteReader(const TableReader& table, Draft& draft, const ScriptState& state)
      : table_(table), draft_(draft), state_(state) {}

  // Nothing, and a problem, if what it is about is not there.
  std::optional<NoteSpec> read(Place where) {
    NoteSpec note;
    table_.fill(note);
    note.where = draft_.position(where);
    check_quotes(table_, "text", draft_, state_);
    const bool good = read_body(note) || read_pair(note) || read_node(note) || read_count(note) ||
                      read_point(note);
    return good ? std::optional(note) : std::nullopt;
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
    const std::string why = why_not_counted("nodes", draft_, state_);
    if (why.empty()) return true;
    table_.bad_value("node", fmt::format("there is no node here: {}", why),
                     "a structure makes nodes");
    return false;
  }

  bool read_count(NoteSpec& note) {
    if (!table_.is_good("count")) return false;
    note.of = NoteOf::count;
    note.name = *table_.get<std::string>("count");
    std::vector<std::string_view> known;
    for (const CountDoc& count : known_counts()) {
      if (count.name == note.name) {
        const std::string why = why_not_counted(note.name, draft_, state_);
        if (!why.empty())
          table_.bad_value("count", fmt::format("'{}' is not counted here: {}", note.name, why));
        return why.empty();
      }
      known.push_back(count.name);
    }
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

}  // namespace

TableDoc note_table() {
  using namespace keys;
  TableDoc table = {
      "step.note", "[[step.note]]",
      "A few words beside what they are about, with a thin line to it, on this step's frames; or "
      "all "
      "at once as `note = [{ text = \"here\", body = \"red\" }]`."};
  table.keys = {
      key(&NoteSpec::text, "text", "The words. They may quote counts, as a caption does.", must(),
          range(1, kMostNoteLetters)),
      key(KeyType::text, "body", "A body's name.", range(1, 64)),
      key(KeyType::text, "node", "A node by its label: \"root\", \"1.3\".", range(1, 64)),
      key(KeyType::point, "point", "A point of the world.", range(-kFar, kFar)),
      key(KeyType::texts, "pair", "The names of two bodies, as `[\"red\", \"pink\"]`."),
      key(KeyType::text, "count", "A count, which then stands beside the caption.", range(1, 64)),
  };
  table.groups = {{{"body"}, {"node"}, {"point"}, {"pair"}, {"count"}}};
  return table;
}

KeyDoc note_key() {
  using namespace keys;
  return key(KeyType::tables, "note", "Words beside what they are about.", at_most(kMostNotes),
             holds("step.note"));
}

void read_notes(const TableReader& step, Step& to, Draft& draft, const ScriptState& state) {
  for (const TomlValue* value : step.tables("note")) {
    const TableReader table = open(*value, language_table("step.note"), draft, "a note");
    if (auto note = NoteReader(table, draft, state).read(value->where))
      to.notes.push_back(std::move(*note));
  }
}

}  // namespace lantern::scenario
