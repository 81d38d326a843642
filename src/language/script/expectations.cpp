// `expect` and `always`: what must hold of a step's frames. The forms that have keys of their own,
// then every measure and count.
#include <algorithm>

#include <fmt/format.h>

#include "geometry/vec.hpp"
#include "language/keys/key.hpp"
#include "language/script/script_reading.hpp"

namespace lantern::language {
namespace {

using Kind = Expectation::Kind;

// What a form is about, and which count must be there for it.
enum class About { counts, bodies, structures };
struct Form {
  std::string_view key;
  Kind kind;
  About about = About::bodies;
  std::string_view needs = {};
};

constexpr Form kForms[] = {
    {"equal", Kind::count, About::counts},
    {"at_most", Kind::at_most, About::counts},
    {"at_least", Kind::at_least, About::counts},
    {"in_leaves", Kind::leaves, About::bodies, "leaves"},
    {"pairs_are", Kind::pairs, About::bodies, "pairs"},
    {"contacts_are", Kind::contacts, About::bodies, "contacts"},
    {"hits_are", Kind::hits, About::bodies, "hits"},
    {"asleep", Kind::asleep},
    {"awake", Kind::awake},
    {"position", Kind::position},
    {"velocity", Kind::velocity},
    {"half_size", Kind::half_size},
    {"turned", Kind::turned},
    {"build_work", Kind::build_work, About::structures, "least_work"},
    {"step_work", Kind::step_work, About::structures, "least_work"},
    {"fewest", Kind::fewest, About::structures, "least_work"},
};

bool is_measured(const std::string& name) {
  const CountDoc* of_body = find_in(known_body_measures(), name.substr(0, name.find('.')));
  return is_of_body(name) ? of_body && !is_counted(*of_body)
                          : find_in(known_measures(), name) != nullptr;
}

bool is_measured(Kind kind) {
  return kind == Kind::measure || kind == Kind::position || kind == Kind::velocity ||
         kind == Kind::half_size || kind == Kind::turned;
}

class ExpectationReader {
 public:
  ExpectationReader(const TableReader& table, Draft& draft, ScriptState& state)
      : table_(table), draft_(draft), state_(state) {
    table_.fill(blank_);  // the tolerance
  }

  std::vector<Expectation> read() {
    for (const CountDoc& count : known_counts()) read_number(count.name, Kind::count);
    for (const CountDoc& measure : known_measures()) read_number(measure.name, Kind::measure);
    for (const Form& form : kForms)
      if (table_.has(form.key)) read(form);
    if (table_.has("tolerance") &&
        std::ranges::none_of(found_, [](const Expectation& e) { return is_measured(e.kind); }) &&
        std::ranges::none_of(kForms, [&](const Form& form) {
          return is_measured(form.kind) && table_.has(form.key);
        }))
      table_.bad_key("tolerance", "a 'tolerance' without a 'position' or anything else measured",
                     "counts are exact; leave it out");
    std::ranges::stable_sort(found_, {}, [](const Expectation& e) {
      return Place{e.where.line, e.where.column};
    });
    return std::move(found_);
  }

 private:
  Expectation& add(Kind kind, std::string name, Place where) {
    Expectation& e = found_.emplace_back(blank_);
    e.kind = kind;
    e.name = std::move(name);
    e.where = draft_.position(where);
    if (kind == Kind::turned) e.tolerance *= kDegree;
    return e;
  }

  // Adds a problem if `count`, which `key` needs, is not counted here.
  void require(std::string_view key, std::string_view count, Place where) {
    const std::string why = why_not_counted(*find_count(count), state_.past);
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
    add(kind, std::string(name), where).number = table_.get<double>(name).value_or(0);
  }

  void read(const Form& form) {
    const KeyType type = table_.doc().find(form.key)->type;
    if (type == KeyType::whole_or_names && !table_.is_list(form.key)) return;  // a count
    const Place where = table_.key_place(form.key);
    if (!form.needs.empty()) require(form.key, form.needs, where);
    if (form.kind == Kind::turned && draft_.dimension == 3)
      table_.bad_key("turned", "'turned' is for 2D worlds",
                     "in a 3D one, expect an angular_momentum");
    if (type == KeyType::name_numbers || type == KeyType::name_wholes) {
      const double unit = form.kind == Kind::turned ? kDegree : 1;
      for (const auto& [name, number] : table_.list<std::pair<Named, double>>(form.key))
        add_about(form, name).number = number * unit;
    } else if (type == KeyType::name_points) {
      for (const auto& [name, point] : table_.list<std::pair<Named, Vec<3>>>(form.key))
        add_about(form, name).position = point;
    } else if (type == KeyType::name_pairs) {
      read_pairs(form.key, add(form.kind, "", where));
    } else {
      read_names(form, add(form.kind, "", where));
    }
  }

  Expectation& add_about(const Form& form, const Named& name) {
    check(form.about, name);
    const bool measures = form.kind == Kind::count && is_measured(name.name);
    return add(measures ? Kind::measure : form.kind, name.name, name.where);
  }

  void check(About about, const Named& name) {
    if (about == About::counts)
      check_counted(name, draft_, &state_);
    else if (about == About::bodies)
      one_body(name, draft_);
    else if (!structure_named(name.name))
      draft_.problems.add_unknown(name.where, "structure", name.name,
                                  [] { return names(StructureKind()); });
  }

  void read_pairs(std::string_view key, Expectation& e) {
    for (const auto& [a, b] : table_.list<std::pair<Named, Named>>(key)) {
      check(About::bodies, a);
      check(About::bodies, b);
      if (a.name == b.name)
        draft_.problems.add(b.where, fmt::format("{} is no pair with itself", in_quotes(b.name)));
      e.pairs.emplace_back(a.name, b.name);
    }
  }

  void read_names(const Form& form, Expectation& e) {
    std::vector<Named> all = table_.names(form.key);
    if (form.about == About::bodies)
      all = without_ranges(all, draft_.bodies, "body", draft_.problems);
    const bool takes_patterns = form.kind == Kind::asleep || form.kind == Kind::awake;
    for (const Named& name : all) {
      const NamedRange* range = takes_patterns ? draft_.bodies.find(name.name) : nullptr;
      if (!range) {
        check(form.about, name);
        if (!takes_patterns) e.names.push_back(name.name);
      } else if (may_name(range->count, "bodies", name.where, state_, draft_.problems)) {
        for (std::size_t i = range->first; i < range->first + range->count; ++i)
          e.names.push_back(draft_.scenario.bodies[i].name);
      }
    }
  }

  const TableReader& table_;
  Draft& draft_;
  ScriptState& state_;
  Expectation blank_;
  std::vector<Expectation> found_;
};

}  // namespace

TableDoc expect_table() {
  using enum KeyType;
  TableDoc expect = {
      "expect",
      "expect and always",
      "Expectations that `lantern check` verifies. Any count may be a key, as in `expect = { nodes "
      "= 5, pairs = 1 }`.",
      {
          key(name_numbers, "equal",
              "Counts and measures of single bodies, as `{ \"leaves.taxi\" = 2 }`."),
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
              "order; these and no others."),
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
              "Comparisons by which kinds of structures were built in the last `compare`, as `{ "
              "grid = 80 }`.",
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

}  // namespace lantern::language
