// What a step says and promises: its caption and its expectations.
#include <algorithm>

#include <fmt/format.h>

#include "scenario/caption.hpp"
#include "scenario/script.hpp"

namespace lantern {
namespace {

const CountDoc* find_in(std::span<const CountDoc> docs, std::string_view name) {
  const auto found =
      std::find_if(docs.begin(), docs.end(), [&](const CountDoc& doc) { return doc.name == name; });
  return found == docs.end() ? nullptr : &*found;
}

// Names that can be counted or quoted here, for suggestions.
std::vector<std::string_view> quotable(const Draft& draft, const ScriptState& state) {
  std::vector<std::string_view> names;
  for (const auto docs : {known_counts(), known_texts()})
    for (const CountDoc& doc : docs)
      if (why_not_counted(doc.name, draft, state).empty()) names.push_back(doc.name);
  return names;
}

// The place of a byte of a text that is written on one line without escapes; otherwise the place of
// the text.
Place place_within(std::string_view file, Place where, std::string_view text, std::size_t offset) {
  const std::string line = line_of(file, where.line);
  std::size_t at = 0;
  for (int column = 1; column < where.column && at < line.size(); ++column) do
      ++at;
    while (at < line.size() && (line[at] & 0xc0) == 0x80);
  const std::string_view before = text.substr(0, offset);
  if (at + 1 >= line.size() || !std::string_view(line).substr(at + 1).starts_with(before))
    return where;
  return {where.line, where.column + 1 + static_cast<int>(letters(before))};
}

class Promises {
 public:
  Promises(const TableReader& table, Draft& draft, const ScriptState& state)
      : table_(table), draft_(draft), state_(state) {}

  std::vector<Expectation> read() {
    for (const CountDoc& count : known_counts()) read_count(count);
    const bool has_tree = state_.structure.kind != StructureKind::none;
    for (const char* key : {"in_leaves", "pairs_are"})
      if (table_.has(key) && !has_tree)
        draft_.problems.add(
            table_.key_place(key),
            fmt::format("there is no structure at this step: nothing for '{}'", key),
            "give the scenario a [structure]");
    read_leaves();
    read_pairs();
    read_positions();
    std::stable_sort(found_.begin(), found_.end(), [](const auto& a, const auto& b) {
      return Place{a.where.line, a.where.column} < Place{b.where.line, b.where.column};
    });
    return std::move(found_);
  }

 private:
  Expectation& add(Expectation::Kind kind, std::string name, Place where) {
    Expectation e;
    e.kind = kind;
    e.name = std::move(name);
    e.where = draft_.position(where);
    return found_.emplace_back(std::move(e));
  }

  // Exactly one body, by name.
  void check_body(const Named& body) {
    const NamedRange* range = draft_.bodies.find(body.name);
    if (!range)
      draft_.problems.add(
          body.where, fmt::format("there is no body {}", in_quotes(body.name)),
          [&known = draft_.bodies, name = body.name] { return nearest(name, known.declared()); });
    else if (range->count > 1)
      draft_.problems.add(
          body.where, fmt::format("'{}' is a pattern, not a body", body.name),
          fmt::format("its bodies are '{}1' to '{}{}'", body.name, body.name, range->count));
  }

  void read_count(const CountDoc& count) {
    if (!table_.has(count.name)) return;
    const Place where = table_.key_place(count.name);
    const std::string why = why_not_counted(count.name, draft_, state_);
    if (!why.empty())
      draft_.problems.add(where, fmt::format("'{}' is not counted here: {}", count.name, why));
    add(Expectation::Kind::count, std::string(count.name), where).number =
        table_.whole(count.name).value_or(0);
  }

  void read_leaves() {
    for (const auto& [body, number] : table_.name_wholes("in_leaves")) {
      check_body(body);
      add(Expectation::Kind::leaves, body.name, body.where).number = number;
    }
  }

  void read_pairs() {
    if (!table_.has("pairs_are")) return;
    Expectation& e = add(Expectation::Kind::pairs, "", table_.key_place("pairs_are"));
    for (const auto& [a, b] : table_.name_pairs("pairs_are")) {
      check_body(a);
      check_body(b);
      if (a.name == b.name)
        draft_.problems.add(b.where, fmt::format("{} is no pair with itself", in_quotes(b.name)));
      e.pairs.emplace_back(a.name, b.name);
    }
  }

  void read_positions() {
    if (table_.has("tolerance") && !table_.has("position"))
      draft_.problems.add(table_.key_place("tolerance"), "a 'tolerance' without a 'position'",
                          "counts are exact; leave it out");
    for (const auto& [body, position] : table_.name_points("position")) {
      check_body(body);
      Expectation& e = add(Expectation::Kind::position, body.name, body.where);
      e.position = position;
      e.tolerance = table_.number("tolerance").value_or(e.tolerance);
    }
  }

  const TableReader& table_;
  Draft& draft_;
  const ScriptState& state_;
  std::vector<Expectation> found_;
};

}  // namespace

std::string why_not_counted(std::string_view name, const Draft& draft, const ScriptState& state) {
  const CountDoc* doc = find_in(known_counts(), name);
  if (!doc) doc = find_in(known_texts(), name);
  const bool has_bodies = draft.has_world && !draft.bodies.empty();
  const bool has_atlas = draft.scenario.atlas.has_value();
  if (name == "room" && has_atlas && !state.asked_for_room) return "no step has asked for room yet";
  if (doc->for_atlas && has_atlas) return {};
  if (!doc->for_world) return "the scenario has no [atlas]";
  if (name == "time" && draft.has_world) return {};
  if (!has_bodies) return has_atlas ? "an atlas has none" : "the scenario has no bodies";
  if (doc->needs_structure && state.structure.kind == StructureKind::none)
    return "there is no structure at this step";
  return {};
}

std::vector<Expectation> read_expectations(const TomlValue& value, std::string_view called,
                                           Draft& draft, const ScriptState& state) {
  const TableReader table(std::get<TomlTable>(value.data), value.where, language_table("expect"),
                          draft.problems, fmt::format("'{}'", called));
  return Promises(table, draft, state).read();
}

void check_caption(const TableReader& step, Draft& draft, const ScriptState& state) {
  const std::string caption = step.text("caption").value_or("");
  const auto kind_of = [](std::string_view name) {
    if (find_in(known_counts(), name)) return Placeholder::count;
    return find_in(known_texts(), name) ? Placeholder::text : Placeholder::unknown;
  };
  const auto can_be_quoted = [&](std::string_view name) {
    return kind_of(name) != Placeholder::unknown && why_not_counted(name, draft, state).empty();
  };
  const auto known_here = [&](std::string_view name) {
    return can_be_quoted(name) ? kind_of(name) : Placeholder::unknown;
  };
  for (const CaptionProblem& p : caption_problems(caption, known_here)) {
    const Place where = place_within(draft.text, step.place("caption"), caption, p.offset);
    if (!p.message.empty())
      draft.problems.add(where, "in the caption: " + p.message,
                         "write {{ and }} for the braces themselves");
    else if (kind_of(p.unknown) == Placeholder::unknown)
      draft.problems.add(
          where, fmt::format("a caption cannot quote {}", in_quotes(p.unknown)),
          [name = p.unknown, known = quotable(draft, state)] { return nearest(name, known); });
    else
      draft.problems.add(where, fmt::format("'{}' is not counted here: {}", p.unknown,
                                            why_not_counted(p.unknown, draft, state)));
  }
}

}  // namespace lantern
