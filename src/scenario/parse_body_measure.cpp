// Names of what is measured of single bodies, as "energy.bob".
#include <algorithm>

#include <fmt/format.h>

#include "scenario/draft.hpp"

namespace lantern {
namespace {

constexpr std::size_t kMostNoted = 64;  // each costs time on every frame

// Empty if a body of this world has it.
std::string why_not_measured(const CountDoc& doc, const Draft& draft) {
  if (doc.need == CountNeed::contacts && draft.scenario.world.contacts == ContactMethod::none)
    return "this world has no contacts";
  const bool is_3d = doc.name == "z" || doc.name.starts_with("own_spin");
  return is_3d && draft.dimension == 2 ? "this world is 2D" : "";
}

}  // namespace

bool note_body_measure(const Named& name, Draft& draft) {
  const std::size_t dot = name.name.find('.');
  const std::string measure = name.name.substr(0, dot);
  const CountDoc* doc = find_in(known_body_measures(), measure);
  if (!doc) {
    draft.problems.add(
        name.where, fmt::format("there is no measure {} of a body", in_quotes(measure)), [measure] {
          std::vector<std::string_view> known;
          for (const CountDoc& k : known_body_measures()) known.push_back(k.name);
          return nearest(measure, known);
        });
    return false;
  }
  if (const std::string why = why_not_measured(*doc, draft); !why.empty()) {
    draft.problems.add(name.where, fmt::format("'{}' is not measured here: {}", name.name, why));
    return false;
  }
  const auto body = one_body({name.name.substr(dot + 1), name.where}, draft);
  if (!body) return false;
  std::vector<BodyMeasureSpec>& noted = draft.scenario.body_measures;
  if (std::any_of(noted.begin(), noted.end(), [&](const auto& n) { return n.name == name.name; }))
    return true;
  if (noted.size() == kMostNoted) {
    draft.problems.add(name.where,
                       fmt::format("more than {} measures of single bodies", kMostNoted));
    return false;
  }
  const auto what = static_cast<BodyMeasure>(doc - known_body_measures().data());
  noted.push_back({name.name, what, *body});
  return true;
}

}  // namespace lantern
