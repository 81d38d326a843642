#include <algorithm>
#include <set>

#include "base/stop.hpp"
#include "language/counts.hpp"
#include "run/engine.hpp"
#include "run/players.hpp"

namespace lantern::run {

// --- what is counted here ---

namespace {

constexpr CountDoc kStepCounts[] = {
    {"pairs_tested", when::contacts, "pair tested/pairs tested",
     "Pairs whose shapes were tested in the last world step."},
    {"narrow_tests", when::contacts, "",
     "Tests made of them; a pair may be looked at several times in a step."},
    {"impact_looks", when::contacts, "look for the impact/looks for the impact",
     "Those of them that looked for the moment of an impact, in the midst of the step."},
    {"impacts_located", when::contacts, "impact located/impacts located",
     "Impacts whose moment the last world step found, so that they took place then."},
    {"contacts", when::contacts, "",
     "Pairs that really touch, as the last world step found; of sleepers, their last one.",
     Most::pairs},
    {"contact_points", when::contacts, "contact point/contact points", "Points at which they do."},
    {"impulses", when::contacts, "", "Those of them that passed on an impulse in that world step."},
    {"crushes", when::contacts, "crush/crushes",
     "Of these, those that crush: they press a body against another one, and the two lie in it "
     "deeper than a quarter of its smallest width."},
    {"begins", when::contacts, "contact begun/contacts begun",
     "Pairs that began to touch during the script's step."},
    {"ends", when::contacts, "contact ended/contacts ended",
     "Pairs that ceased to touch during the script's step."},
    {"constraint_rows", when::contacts, "",
     "Rows of contacts and joints solved in the last world step, once for each sweep."},
    {"friction_rows", when::contacts, "", "Those of them that are friction."},
    {"force_evaluations", when::physics, "",
     "Passes over forces in the last world step: of all bodies, then of each island's."},
    {"rotations", when::physics, "", "Bodies that were turned, in the last world step."}};
constexpr CountDoc kStepMeasures[] = {
    {"penetration", when::contacts, "",
     "How deep the deepest contact of the last world step overlaps.", Most::size, "units"},
    {"time_of_impact", when::contacts, "",
     "When the first of the last world step's impacts was, as a part of the step; 1 if it located "
     "none.",
     Most::part_of_step, "of a step"}};

template <int D>
FrameContact frame_contact(const Contact<D>& contact, std::span<const ContactEvent> events) {
  FrameContact c{.pair = {contact.a, contact.b}, .normal = solid(contact.manifold.normal)};
  // Events come in the order of their pairs, one a pair.
  const auto event = std::ranges::lower_bound(events, c.pair, {}, [](const ContactEvent& e) {
    return Pair{e.a, e.b};
  });
  if (event != events.end() && Pair{event->a, event->b} == c.pair) {
    c.begins = event->kind == ContactEvent::Kind::begin;
    c.crushes = event->crushes;
  }
  for (std::size_t i = 0; i < contact.manifold.points().size(); ++i) {
    const auto& point = contact.manifold.room[i];
    c.points.push_back({solid(point.position), point.separation, contact.normal_impulses[i]});
  }
  return c;
}

// Of the pairs that the broad phase handed on in the last step, those whose shapes were tested:
// not both are moved from outside, and no joint ties them together.
template <int D>
std::vector<Pair> tested_pairs(const Players<D>& players) {
  const World<D>& world = players.world();
  std::vector<Pair> tested;
  std::set<Pair> joined;
  for (const auto& [id, joint] : world.joints())
    if (!joint.collide) joined.insert({std::min(joint.a, joint.b), std::max(joint.a, joint.b)});
  for (const Pair& pair : world.pairs()) {
    const Body<D>*a = world.find(pair.a), *b = world.find(pair.b);
    if (!a || !b || !players.spec_of(pair.a) || !players.spec_of(pair.b)) continue;  // one has left
    const bool dynamic = a->kind == BodyKind::dynamic_body || b->kind == BodyKind::dynamic_body;
    if (dynamic && !joined.contains(pair)) tested.push_back(pair);
  }
  return tested;
}

// A number of this name, if there is one.
template <class V>
void set(std::vector<std::pair<std::string, V>>& numbers, std::string_view name, V value) {
  for (auto& [known, number] : numbers)
    if (known == name) number = value;
}

}  // namespace

std::span<const CountDoc> step_counts() { return kStepCounts; }
std::span<const CountDoc> step_measures() { return kStepMeasures; }

StepFindings::Counts StepFindings::contact_counts() const {
  std::uint64_t points = 0, impulses = 0, crushes = 0;
  for (const FrameContact& c : contacts) {
    points += c.points.size();
    for (const FrameContact::Point& p : c.points) impulses += p.impulse != 0;
    crushes += c.crushes;
  }
  return {{"contacts", contacts.size()}, {"contact_points", points}, {"impulses", impulses},
          {"crushes", crushes},          {"begins", begins},         {"ends", ends}};
}

StepFindings::Counts StepFindings::solver_counts() const {
  return {{"pairs_tested", work.narrow_pairs},       {"narrow_tests", work.narrow_tests},
          {"impact_looks", work.impact_looks},       {"impacts_located", work.impacts_located},
          {"constraint_rows", work.constraint_rows}, {"friction_rows", work.friction_rows}};
}

StepFindings::Counts StepFindings::motion_counts() const {
  return {{"force_evaluations", work.force_evaluations}, {"rotations", work.rotations_integrated}};
}

double StepFindings::penetration() const {
  double deepest = 0;
  for (const FrameContact& c : contacts)
    for (const FrameContact::Point& point : c.points)
      deepest = std::max(deepest, -point.separation);
  return deepest;
}

void StepFindings::put_on(Frame& frame) const {
  frame.contacts = contacts;
  frame.tested = tested;
  for (const Counts& counts : {contact_counts(), solver_counts(), motion_counts()})
    for (const auto& [name, n] : counts) set(frame.counts, name, static_cast<std::int64_t>(n));
  set(frame.measures, "penetration", penetration());
  set(frame.measures, "time_of_impact", time_of_impact);
}

template <int D>
StepFindings findings_of(const Players<D>& players, double h) {
  const World<D>& world = players.world();
  StepFindings found;
  for (const Contact<D>& contact : world.contacts()) {
    stop_if_asked();
    if (players.spec_of(contact.a) && players.spec_of(contact.b) && world.find(contact.a) &&
        world.find(contact.b))  // one may have left since the step
      found.contacts.push_back(frame_contact(contact, world.events()));
  }
  found.tested = tested_pairs(players);
  double first = h;
  for (const ImpactMoment<D>& moment : world.impacts().moments)
    first = std::min(first, moment.time);
  found.time_of_impact = first / h;
  return found;
}

template StepFindings findings_of(const Players<2>&, double);
template StepFindings findings_of(const Players<3>&, double);

}  // namespace lantern::run
