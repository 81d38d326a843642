// Does a frame meet the expectations of its step?
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string_view>
#include <unordered_map>
#include <unordered_set>

#include <fmt/format.h>

#include "frame/frame.hpp"
#include "frame/parts/asked.hpp"
#include "frame/parts/panels.hpp"
#include "geometry/vec.hpp"
#include "language/scenario.hpp"

namespace lantern::frame {
namespace {

using Unmet = std::optional<std::string>;
using NamePair = std::pair<std::string, std::string>;

NamePair ordered(std::string a, std::string b) {
  return a < b ? NamePair{std::move(a), std::move(b)} : NamePair{std::move(b), std::move(a)};
}
std::set<NamePair> ordered(const std::vector<std::pair<std::string, std::string>>& pairs) {
  std::set<NamePair> all;
  for (const auto& [a, b] : pairs) all.insert(ordered(a, b));
  return all;
}

// Where a frame has what expectations name: found once for all of them, as each body may have one.
class Places {
 public:
  explicit Places(const Frame& frame) : frame_(frame) {}

  const FrameBody* body_named(std::string_view name) {
    if (bodies_.empty())
      for (const FrameBody& body : frame_.bodies) bodies_.emplace(body.name, &body);
    const auto found = bodies_.find(name);
    return found == bodies_.end() ? nullptr : found->second;
  }
  std::uint64_t leaves_with(BodyId body) {
    if (stored_.empty()) stored_ = stored_bodies(frame_);
    return stored_[body].leaves;
  }

 private:
  const Frame& frame_;
  std::unordered_map<std::string_view, const FrameBody*> bodies_;
  std::unordered_map<BodyId, Stored> stored_;
};

// Bodies stand in order of ids.
const std::string& name_of(const Frame& frame, BodyId id) {
  return std::ranges::lower_bound(frame.bodies, id, {}, &FrameBody::id)->name;
}

std::string listed(const std::set<NamePair>& pairs) {
  if (pairs.empty()) return "none";
  std::string text;
  for (const auto& [a, b] : pairs) text += fmt::format("{}({}, {})", text.empty() ? "" : " ", a, b);
  return text;
}

std::string listed(const std::vector<std::string>& names) {
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

std::string point_text(const Vec<3>& p, int dimension) {
  return dimension == 2 ? fmt::format("[{}, {}]", p.x, p.y)
                        : fmt::format("[{}, {}, {}]", p.x, p.y, p.z);
}

Unmet unmet_number(const Expectation& e, const Frame& frame, Places&) {
  const std::optional<double> found = frame.number(e.name);
  const char* sign = "=";
  bool holds = found == e.number;
  if (e.kind == Expectation::Kind::at_most) {
    sign = "at most";
    holds = found && *found <= e.number;
  } else if (e.kind == Expectation::Kind::at_least) {
    sign = "at least";
    holds = found && *found >= e.number;
  } else if (e.kind == Expectation::Kind::measure) {
    holds = found && std::abs(*found - e.number) <= e.tolerance;
  }
  if (holds) return std::nullopt;
  return fmt::format("expected {} {} {}, found {}", e.name, sign, e.number,
                     found ? fmt::format("{}", *found) : "none");
}

Unmet unmet_leaves(const Expectation& e, const Frame&, Places& places) {
  const FrameBody* body = places.body_named(e.name);
  if (!body)
    return fmt::format("expected '{}' in {} leaves, but it is not there", e.name, e.number);
  const std::uint64_t leaves = places.leaves_with(body->id);
  if (static_cast<double>(leaves) == e.number) return std::nullopt;
  return fmt::format("expected '{}' in {} leaves, found it in {}", e.name, e.number, leaves);
}

Unmet unmet_pairs(const Expectation& e, const Frame& frame, Places&) {
  const bool of_contacts = e.kind == Expectation::Kind::contacts;
  std::set<NamePair> found;
  const std::set<NamePair> expected = ordered(e.pairs);
  const auto add = [&](const Pair& pair) {
    found.insert(ordered(name_of(frame, pair.a), name_of(frame, pair.b)));
  };
  if (of_contacts)
    for (const FrameContact& contact : frame.contacts) add(contact.pair);
  else
    for (const FramePair& p : frame.pairs) add(p.pair);
  if (found == expected) return std::nullopt;
  return fmt::format("expected the {} {}, found {}", of_contacts ? "contacts" : "pairs",
                     listed(expected), listed(found));
}

// In order along a ray; in any order of a view or region.
Unmet unmet_hits(const Expectation& e, const Frame& frame, Places&) {
  std::vector<std::string> found, expected = e.names;
  for (const BodyId id : frame.get<FrameFinding>().hits) found.push_back(name_of(frame, id));
  if (frame.get<FrameFinding>().rays.empty()) {
    std::ranges::sort(found);
    std::ranges::sort(expected);
  }
  if (found == expected) return std::nullopt;
  return fmt::format("expected the hits {}, found {}", listed(expected), listed(found));
}

Unmet unmet_sleep(const Expectation& e, const Frame& frame, Places&) {
  const bool asleep = e.kind == Expectation::Kind::asleep;
  std::unordered_set<std::string_view> as_wanted;
  for (const FrameBody& body : frame.bodies)
    if (body.asleep == asleep) as_wanted.insert(body.name);
  std::vector<std::string> others;
  for (const std::string& name : e.names)
    if (!as_wanted.contains(name)) others.push_back(name);
  if (others.empty()) return std::nullopt;
  return fmt::format("expected to be {}, but are not: {}", asleep ? "asleep" : "awake",
                     listed(others));
}

Unmet unmet_vector(const Expectation& e, const Frame& frame, Places& places) {
  const FrameBody* body = places.body_named(e.name);
  using Kind = Expectation::Kind;
  const char* what = e.kind == Kind::position   ? "at"
                     : e.kind == Kind::velocity ? "with velocity"
                                                : "with a box of half size";
  if (!body) return fmt::format("expected '{}' {} a value, but it is not there", e.name, what);
  const Vec<3> found = e.kind == Kind::position   ? body->position
                       : e.kind == Kind::velocity ? body->velocity
                                                  : body->box.size() * 0.5;
  bool holds = true;
  for (int i = 0; i < frame.dimension; ++i)
    holds = holds && std::abs(found[i] - e.position[i]) <= e.tolerance;
  if (holds) return std::nullopt;
  return fmt::format("expected '{}' {} {} within {}, found {}", e.name, what,
                     point_text(e.position, frame.dimension), e.tolerance,
                     point_text(found, frame.dimension));
}

Unmet unmet_turn(const Expectation& e, const Frame&, Places& places) {
  const FrameBody* body = places.body_named(e.name);
  if (body && std::abs(body->angle - e.number) <= e.tolerance) return std::nullopt;
  return fmt::format("expected '{}' turned by {} degrees, found {}", e.name, e.number / kDegree,
                     body ? fmt::format("{}", body->angle / kDegree) : "none");
}

std::vector<const Expectation*> all_of(const Step& step) {
  auto all = mapped(step.expect, [](const Expectation& e) { return &e; });
  for (const Expectation& e : step.always) all.push_back(&e);
  return all;
}

// The kind's cell in the row that was compared last; null if there is none.
const FrameComparison::Cell* cell_of(const Frame& frame, const std::string& kind) {
  const auto& rows = frame.get<FrameComparison>().rows;
  const auto named = structure_named(kind);
  return rows.empty() || !named ? nullptr : rows.back().cell(*named);
}

Unmet unmet_work(const Expectation& e, const Frame& frame, Places&) {
  const FrameComparison::Cell* cell = cell_of(frame, e.name);
  const bool of_build = e.kind == Expectation::Kind::build_work;
  const char* what = of_build ? "to build" : "in a step";
  if (!cell) return fmt::format("expected comparisons of a '{}', it was not compared", e.name);
  const std::uint64_t found = of_build ? cell->work.build : cell->work.step();
  if (static_cast<double>(found) == e.number) return std::nullopt;
  return fmt::format("expected {} comparisons {} of a '{}', found {}", e.number, what, e.name,
                     found);
}

Unmet unmet_fewest(const Expectation& e, const Frame& frame, Places&) {
  std::set<std::string> found;
  for (const FrameComparison::Cell& cell : frame.get<FrameComparison>().rows.back().cells)
    if (cell.work.step() == frame.get<FrameComparison>().rows.back().least())
      found.insert(std::string(to_string(cell.kind)));
  if (found == std::set(e.names.begin(), e.names.end())) return std::nullopt;
  return fmt::format("expected fewest comparisons of {}, found {}", listed(e.names),
                     fmt::join(found, ", "));
}

struct KindRow {
  Unmet (*check)(const Expectation&, const Frame&, Places&);
  const char* text;  // {0} is its name, {1} its number, {2} that in degrees, {3} what is listed
};
// In the order of Expectation::Kind.
constexpr KindRow kKinds[] = {{unmet_number, "{0} = {1:.9g}"},
                              {unmet_number, "{0} ≤ {1:.9g}"},
                              {unmet_number, "{0} ≥ {1:.9g}"},
                              {unmet_leaves, "leaves of {0} = {1}"},
                              {unmet_pairs, "pairs = {3}"},
                              {unmet_pairs, "contacts = {3}"},
                              {unmet_hits, "hits = {3}"},
                              {unmet_sleep, "asleep: {3}"},
                              {unmet_sleep, "awake: {3}"},
                              {unmet_vector, "position of {0} = {3}"},
                              {unmet_vector, "velocity of {0} = {3}"},
                              {unmet_vector, "half size of {0} = {3}"},
                              {unmet_turn, "{0} turned by {2:.9g}°"},
                              {unmet_number, "{0} = {1:.9g}"},
                              {unmet_work, "work of {0} to build = {1:.9g}"},
                              {unmet_work, "work of {0} = {1:.9g}"},
                              {unmet_fewest, "fewest = {3}"}};
const KindRow& row_of(const Expectation& e) { return kKinds[static_cast<std::size_t>(e.kind)]; }

std::string text_of(const Expectation& e, int dimension) {
  const KindRow& row = row_of(e);
  const std::string list = row.check == unmet_pairs    ? listed(ordered(e.pairs))
                           : row.check == unmet_vector ? point_text(e.position, dimension)
                                                       : listed(e.names);
  return fmt::format(fmt::runtime(row.text), e.name, e.number, e.number / kDegree, list);
}

}  // namespace

std::vector<Proof> proofs_of(const Scenario& scenario, std::size_t step) {
  std::vector<Proof> proofs;
  const auto text = [&](const Expectation& e) { return text_of(e, scenario.world.dimension); };
  if (scenario.sides.empty())
    for (const Expectation* e : all_of(scenario.steps.at(step)))
      proofs.push_back({text(*e), e->where});
  // What all sides expect stands in one place of the file.
  std::map<std::pair<int, int>, Proof> by_place;
  for (const auto& side : scenario.sides)
    for (const Expectation* e : all_of(side->steps.at(step))) {
      Proof& proof = by_place[{e->where.line, e->where.column}];
      proof = {(proof.text.empty() ? side->side + ": " : "") + text(*e), e->where};
    }
  for (auto& [place, proof] : by_place) proofs.push_back(std::move(proof));
  return proofs;
}

std::vector<Unmet> unmet(const std::vector<Expectation>& expectations, const Frame& frame) {
  Places places(frame);
  return mapped(expectations,
                [&](const Expectation& e) { return row_of(e).check(e, frame, places); });
}

}  // namespace lantern::frame
