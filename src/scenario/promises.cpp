// What a step promises.
#include <algorithm>

#include <fmt/format.h>

#include "geometry/angle.hpp"
#include "scenario/script.hpp"

namespace lantern {
namespace {

using Kind = Expectation::Kind;

bool is_counted_or_measured(std::string_view name) {
  for (const auto docs : {known_counts(), known_measures()})
    for (const CountDoc& doc : docs)
      if (doc.name == name) return true;
  return false;
}

class Promises {
 public:
  Promises(const TableReader& table, Draft& draft, ScriptState& state)
      : table_(table), draft_(draft), state_(state) {}

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
    if (kind == Kind::measure) {
      e.number = table_.number(name).value_or(0);
      e.tolerance = tolerance();
    } else {
      e.number = static_cast<double>(table_.whole(name).value_or(0));
    }
  }

  void read_bounds(std::string_view key, Kind kind) {
    for (const auto& [name, number] : table_.name_numbers(key)) {
      if (is_of_body(name.name))
        note_body_measure(name, draft_);
      else if (is_counted_or_measured(name.name))
        require(name.name, name.name, name.where);
      else
        draft_.problems.add(name.where,
                            fmt::format("there is no count or measure {}", in_quotes(name.name)),
                            [name = name.name] {
                              std::vector<std::string_view> known;
                              for (const auto docs : {known_counts(), known_measures()})
                                for (const CountDoc& doc : docs) known.push_back(doc.name);
                              return nearest(name, known);
                            });
      add(kind, name.name, name.where).number = number;
    }
  }

  void read_leaves() {
    if (table_.has("in_leaves")) require("in_leaves", "leaves", table_.key_place("in_leaves"));
    for (const auto& [body, number] : table_.name_wholes("in_leaves")) {
      one_body(body, draft_);
      add(Kind::leaves, body.name, body.where).number = static_cast<double>(number);
    }
  }

  void read_pairs(std::string_view key, std::string_view count, Kind kind) {
    if (!table_.has(key)) return;
    require(key, count, table_.key_place(key));
    Expectation& e = add(kind, "", table_.key_place(key));
    for (const auto& [a, b] : table_.name_pairs(key)) {
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
    for (const Named& body : table_.texts("hits_are")) {
      one_body(body, draft_);
      e.names.push_back(body.name);
    }
  }

  // Bodies, or patterns for all of theirs.
  void read_sleepers(std::string_view key, Kind kind) {
    if (!table_.is_list(key)) return;
    Expectation& e = add(kind, "", table_.key_place(key));
    for (const Named& name : table_.texts(key)) {
      const NamedRange* range = draft_.bodies.find(name.name);
      if (!range) {
        one_body(name, draft_);  // says what is wrong
        continue;
      }
      const bool had_room = state_.named <= kMostNamed;
      state_.named += range->count;
      if (state_.named > kMostNamed) {
        if (had_room)
          draft_.problems.add(name.where,
                              fmt::format("the steps name more than {} bodies in all", kMostNamed));
        continue;
      }
      const auto& bodies = draft_.scenario.bodies;
      for (std::size_t i = range->first; i < range->first + range->count; ++i)
        e.names.push_back(bodies[i].name);
    }
  }

  void read_points(std::string_view key, Kind kind) {
    for (const auto& [body, point] : table_.name_points(key)) {
      one_body(body, draft_);
      Expectation& e = add(kind, body.name, body.where);
      e.position = point;
      e.tolerance = tolerance();
    }
  }

  void read_turns() {
    if (table_.has("turned") && draft_.dimension == 3)
      draft_.problems.add(table_.key_place("turned"), "'turned' is of a flat world",
                          "in a solid one, promise angular_momentum");
    for (const auto& [body, degrees] : table_.name_numbers("turned")) {
      one_body(body, draft_);
      Expectation& e = add(Kind::turned, body.name, body.where);
      e.number = degrees * kDegree;
      e.tolerance = tolerance() * kDegree;
    }
  }

  void check_tolerance() {
    if (!table_.has("tolerance")) return;
    for (const char* key : {"position", "velocity", "half_size", "turned"})
      if (table_.has(key)) return;
    for (const CountDoc& measure : known_measures())
      if (table_.has(measure.name)) return;
    draft_.problems.add(table_.key_place("tolerance"),
                        "a 'tolerance' without a 'position' or another thing that is measured",
                        "counts are exact; leave it out");
  }

  double tolerance() const { return table_.number("tolerance").value_or(1e-9); }

  const TableReader& table_;
  Draft& draft_;
  ScriptState& state_;
  std::vector<Expectation> found_;
};

}  // namespace

std::vector<Expectation> read_expectations(const TomlValue& value, std::string_view called,
                                           Draft& draft, ScriptState& state) {
  const TableReader table =
      open(value, language_table("expect"), draft, fmt::format("'{}'", called));
  return Promises(table, draft, state).read();
}

}  // namespace lantern
