// `expect` and `always`: what must hold of a step's frames. The forms that have keys of their own,
// then every measure and count.
#include <algorithm>

#include <fmt/format.h>

#include "geometry/angle.hpp"
#include "scenario/key.hpp"
#include "scenario/script_reading.hpp"

namespace lantern::scenario {
namespace {

class ExpectationReader {
 public:
  using Kind = Expectation::Kind;

  ExpectationReader(const TableReader& table, Draft& draft, ScriptState& state)
      : table_(table),
        draft_(draft),
        state_(state),
        tolerance_(table.get<double>("tolerance").value_or(Expectation().tolerance)) {}

  std::vector<Expectation> read() {
    for (const CountDoc& count : known_counts()) read_number(count.name, Kind::count);
    for (const CountDoc& measure : known_measures()) read_number(measure.name, Kind::measure);
    read_bounds("at_most", Kind::at_most);
    read_bounds("at_least", Kind::at_least);
    read_leaves();
    read_pairs("pairs_are", "pairs", Kind::pairs);
    read_pairs("contacts_are", "contacts", Kind::contacts);
    read_hits();
    read_sleepers("asleep", Kind::asleep);
    read_sleepers("awake", Kind::awake);
    read_points("position", Kind::position);
    read_points("velocity", Kind::velocity);
    read_points("half_size", Kind::half_size);
    read_turns();
    read_work("build_work", Kind::build_work);
    read_work("step_work", Kind::step_work);
    read_fewest();
    check_tolerance();
    std::stable_sort(found_.begin(), found_.end(), [](const auto& a, const auto& b) {
      return Place{a.where.line, a.where.column} < Place{b.where.line, b.where.column};
    });
    return std::move(found_);
  }

 private:
  Expectation& add(Kind kind, std::string name, Place where) {
    Expectation e;
    e.kind = kind;
    e.name = std::move(name);
    e.where = draft_.position(where);
    return found_.emplace_back(std::move(e));
  }

  Expectation& add_of_body(Kind kind, const Named& body) {
    one_body(body, draft_);
    return add(kind, body.name, body.where);
  }

  std::vector<Named> bodies_in(std::string_view key) const {
    return without_ranges(table_.names(key), draft_.bodies, "body", draft_.problems);
  }

  // Adds a problem if `count`, which `key` needs, is not counted here.
  void require(std::string_view key, std::string_view count, Place where) {
    const std::string why = why_not_counted(count, draft_, state_);
    if (why.empty()) return;
    if (key == count)
      draft_.problems.add(where, fmt::format("'{}' is not counted here: {}", key, why));
    else
      draft_.problems.add(
          where, fmt::format("{}: nothing for '{}'", why, key),
          why == "there is no structure at this step" ? "give the scenario a [structure]" : "");
  }

  void read_number(std::string_view name, Kind kind) {
    if (!table_.has(name) || table_.is_list(name)) return;
    const Place where = table_.key_place(name);
    require(name, name, where);
    Expectation& e = add(kind, std::string(name), where);
    e.number = table_.get<double>(name).value_or(0);
    if (kind == Kind::measure) e.tolerance = tolerance_;
  }

  void read_bounds(std::string_view key, Kind kind) {
    for (const auto& [name, number] : table_.list<std::pair<Named, double>>(key)) {
      if (is_of_body(name.name))
        note_body_measure(name, draft_);
      else if (find_count(name.name))
        require(name.name, name.name, name.where);
      else
        draft_.problems.add(name.where,
                            fmt::format("there is no count or measure {}", in_quotes(name.name)),
                            [name = name.name] { return nearest(name, names_of_counts()); });
      add(kind, name.name, name.where).number = number;
    }
  }

  void read_leaves() {
    if (table_.has("in_leaves")) require("in_leaves", "leaves", table_.key_place("in_leaves"));
    for (const auto& [body, number] : table_.list<std::pair<Named, double>>("in_leaves"))
      add_of_body(Kind::leaves, body).number = number;
  }

  // A kind of structure, of the last `compare`.
  void require_kind(const Named& kind) {
    if (!structure_named(kind.name))
      draft_.problems.add(kind.where, fmt::format("there is no structure {}", in_quotes(kind.name)),
                          [name = kind.name] { return nearest(name, names(StructureKind())); });
  }

  void read_work(std::string_view key, Kind kind) {
    if (table_.has(key)) require(key, "least_work", table_.key_place(key));
    for (const auto& [structure, number] : table_.list<std::pair<Named, double>>(key)) {
      require_kind(structure);
      add(kind, structure.name, structure.where).number = number;
    }
  }

  void read_fewest() {
    if (!table_.has("fewest")) return;
    require("fewest", "least_work", table_.key_place("fewest"));
    Expectation& e = add(Kind::fewest, "", table_.key_place("fewest"));
    for (const Named& kind : table_.names("fewest")) {
      require_kind(kind);
      e.names.push_back(kind.name);
    }
  }

  void read_pairs(std::string_view key, std::string_view count, Kind kind) {
    if (!table_.has(key)) return;
    require(key, count, table_.key_place(key));
    Expectation& e = add(kind, "", table_.key_place(key));
    for (const auto& [a, b] : table_.list<std::pair<Named, Named>>(key)) {
      one_body(a, draft_);
      one_body(b, draft_);
      if (a.name == b.name)
        draft_.problems.add(b.where, fmt::format("{} is no pair with itself", in_quotes(b.name)));
      e.pairs.emplace_back(a.name, b.name);
    }
  }

  void read_hits() {
    if (!table_.has("hits_are")) return;
    require("hits_are", "hits", table_.key_place("hits_are"));
    Expectation& e = add(Kind::hits, "", table_.key_place("hits_are"));
    for (const Named& body : bodies_in("hits_are")) {
      one_body(body, draft_);
      e.names.push_back(body.name);
    }
  }

  // Bodies, or patterns for all of theirs.
  void read_sleepers(std::string_view key, Kind kind) {
    if (!table_.is_list(key)) return;
    Expectation& e = add(kind, "", table_.key_place(key));
    for (const Named& name : bodies_in(key)) {
      const NamedRange* range = draft_.bodies.find(name.name);
      if (!range) {
        one_body(name, draft_);  // says what is wrong
        continue;
      }
      if (!may_name(range->count, "bodies", name.where, state_, draft_.problems)) continue;
      const auto& bodies = draft_.scenario.bodies;
      for (std::size_t i = range->first; i < range->first + range->count; ++i)
        e.names.push_back(bodies[i].name);
    }
  }

  void read_points(std::string_view key, Kind kind) {
    for (const auto& [body, point] : table_.list<std::pair<Named, Vec<3>>>(key)) {
      Expectation& e = add_of_body(kind, body);
      e.position = point;
      e.tolerance = tolerance_;
    }
  }

  void read_turns() {
    if (table_.has("turned") && draft_.dimension == 3)
      table_.bad_key("turned", "'turned' is for 2D worlds",
                     "in a 3D one, expect an angular_momentum");
    for (const auto& [body, degrees] : table_.list<std::pair<Named, double>>("turned")) {
      Expectation& e = add_of_body(Kind::turned, body);
      e.number = degrees * kDegree;
      e.tolerance = tolerance_ * kDegree;
    }
  }

  void check_tolerance() {
    if (!table_.has("tolerance")) return;
    for (const char* key : {"position", "velocity", "half_size", "turned"})
      if (table_.has(key)) return;
    for (const CountDoc& measure : known_measures())
      if (table_.has(measure.name)) return;
    table_.bad_key("tolerance", "a 'tolerance' without a 'position' or anything else measured",
                   "counts are exact; leave it out");
  }

  const TableReader& table_;
  Draft& draft_;
  ScriptState& state_;
  double tolerance_;
  std::vector<Expectation> found_;
};

}  // namespace

TableDoc expect_table() {
  using namespace keys;
  using enum KeyType;
  TableDoc expect = {
      "expect",
      "expect and always",
      "Expectations that `lantern check` verifies. Any count may be a key, as in "
      "`expect = { nodes = 5, pairs = 1 }`.",
      {
          key(name_numbers, "at_most",
              "Upper limits of counts and measures, as `{ contacts = 3 }`."),
          key(name_numbers, "at_least", "Lower limits of counts and measures."),
          key(name_wholes, "in_leaves", "How many leaves store a body, as `{ pink = 2 }`.",
              range(0, kMostWhole)),
          key(name_pairs, "pairs_are",
              "The candidate pairs, these and no others, as `[[\"red\", \"pink\"]]`."),
          key(name_pairs, "contacts_are", "The pairs that touch, these and no others."),
          key(KeyType::names, "hits_are",
              "What the last ray hit, in order, or what the last cull or query found, in any "
              "order; "
              "these and no others."),
          key(whole_or_names, "asleep",
              "How many bodies are asleep; or names of bodies, all of which are.",
              range(0, kMostWhole)),
          key(whole_or_names, "awake",
              "How many bodies are awake; or names of bodies, all of which are.",
              range(0, kMostWhole)),
          key(name_points, "position", "Where a body's centre is, as `{ ball = [12, 14] }`.",
              range(-kFar, kFar)),
          key(name_points, "velocity", "A body's velocity, in units a second.", range(-kFar, kFar)),
          key(name_points, "half_size", "Of a body's box in the broad phase.", range(0, kFar)),
          key(name_numbers, "turned", "How far a body of a 2D world is turned, in degrees.",
              range(-1e9, 1e9)),
          key(name_wholes, "build_work",
              "Comparisons by which kinds of structures were built in the last `compare`, as "
              "`{ grid = 80 }`.",
              range(0, kMostWhole)),
          key(name_wholes, "step_work",
              "Comparisons that they made in its step, to be ready and to find pairs.",
              range(0, kMostWhole)),
          key(KeyType::names, "fewest",
              "The kinds that made fewest in its step, these and no others; in any order."),
      }};
  expect.by_side = true;
  for (const CountDoc& measure : known_measures())
    expect.keys.push_back(key(number, measure.name, measure.doc));
  expect.keys.push_back(
      key(&Expectation::tolerance, "tolerance",
          "How far off a measure, a turn, or a point on each axis may be. Counts are exact.",
          range(0, kFar)));
  for (const CountDoc& count : known_counts())
    if (!expect.find(count.name))  // asleep and awake are above
      expect.keys.push_back(key(whole, count.name, count.doc, range(0, kMostWhole)));
  return expect;
}

std::vector<Expectation> read_expectations(const TomlValue& value, std::string_view called,
                                           Draft& draft, ScriptState& state) {
  const TableReader table =
      open(value, language_table("expect"), draft, fmt::format("'{}'", called));
  return ExpectationReader(table, draft, state).read();
}

}  // namespace lantern::scenario
