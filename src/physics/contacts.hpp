// What a step tells: of bodies that touch, of those that are crushed, and of impacts.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/scratch.hpp"
#include "base/stop.hpp"
#include "physics/body.hpp"

namespace lantern::physics {

// Two bodies that touched during a step, and how hard they pressed. Impulses in N s, summed over
// the whole step, upon b; a gets the opposite.
template <int D>
struct Contact {
  BodyId a = 0;  // the lower id
  BodyId b = 0;
  Manifold<D> manifold;                                            // when last looked at
  std::array<double, Manifold<D>::kMostPoints> normal_impulses{};  // of each point, not negative
  std::array<Vec<D>, Manifold<D>::kMostPoints> friction_impulses{};

  Pair pair() const { return {a, b}; }
};

// The record of a pair, which holds impulses already, gets a new manifold: impulses stay with their
// features, and those of points that are gone go to the first one.
template <int D>
void renew_record(Contact<D>& record, const Manifold<D>& manifold) {
  if (record.manifold.count == 0) {
    record.manifold = manifold;
    return;
  }
  Contact<D> renewed;
  renewed.a = record.a;
  renewed.b = record.b;
  renewed.manifold = manifold;
  for (std::size_t i = 0; i < static_cast<std::size_t>(record.manifold.count); ++i) {
    std::size_t to = 0;
    for (std::size_t j = 0; j < static_cast<std::size_t>(manifold.count); ++j)
      if (manifold.room[j].feature == record.manifold.room[i].feature) to = j;
    renewed.normal_impulses[to] += record.normal_impulses[i];
    renewed.friction_impulses[to] += record.friction_impulses[i];
  }
  record = renewed;
}

// What a step remembers of a pair that touched in it.
template <int D>
struct Touch {
  Contact<D> record;     // what the step tells
  Contact<D> memory;     // impulses of the last sub-step, which the next step begins with
  double seconds = 0;    // of that sub-step; 0: there was none
  bool crushes = false;  // see ContactEvent
};

struct ContactEvent {
  enum class Kind {
    begin,  // touch in this step, did not in the last one
    stay,   // touch in both
    end,    // touched in the last step, or some steps ago (ContactSolver::frames_remembered)
  };
  Kind kind = Kind::begin;
  BodyId a = 0;
  BodyId b = 0;
  bool crushes = false;  // one of them, against a third (see `crushing`)
  Pair pair() const { return {a, b}; }
  bool operator==(const ContactEvent&) const = default;
};

// Some bodies are pressed between others, deeper than contacts can hold: a wall that moves, or
// something heavy, pushes them against what does not give way. By these numbers they are crushed.
struct CrushSettings {
  double deep = 0.5;      // of its thickness: so deep two contacts lie in it together
  double opposed = -0.5;  // cosine between their normals: they press from opposite sides
};
inline constexpr CrushSettings kCrushSettings;

// For each contact whether it crushes a body: that it presses, and another one does against it.
// Nothing if none does. `body_of(id)` is the body where the step has left it; none is thinner than
// `thinnest`.
template <int D, class BodyOf>
Scratch<std::uint8_t> crushing(std::span<const Contact<D>> contacts, BodyOf&& body_of,
                               double thinnest = 0) {
  double deepest = 0;
  for (const Contact<D>& contact : contacts) deepest = std::max(deepest, contact.manifold.depth());
  if (!(deepest > kCrushSettings.deep / 2 * thinnest)) return {};
  struct Press {
    BodyId body;
    std::size_t contact;
    Vec<D> push;   // upon the body
    double depth;  // of its thickness
  };
  Scratch<Press> presses;
  bool deep = false;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Contact<D>& contact = contacts[i];
    const double depth = contact.manifold.depth();
    double impulse = 0;
    for (const double pn : contact.normal_impulses) impulse += pn;
    if (!(depth > 0 && impulse > 0)) continue;
    for (const BodyId id : {contact.a, contact.b}) {
      const Body<D>& body = body_of(id);
      if (!body.is_dynamic()) continue;
      presses.push_back({id, i, contact.manifold.normal * (id == contact.a ? -1.0 : 1.0),
                         depth / thickness<D>(body.shape)});
      deep |= presses.back().depth > kCrushSettings.deep / 2;
    }
  }
  Scratch<std::uint8_t> found;
  if (!deep) return found;
  std::ranges::sort(presses, {}, [](const Press& p) { return std::pair(p.body, p.contact); });
  for (std::size_t i = 0; i < presses.size(); ++i)
    for (std::size_t j = i + 1; j < presses.size() && presses[j].body == presses[i].body; ++j) {
      if (!(presses[i].depth + presses[j].depth > kCrushSettings.deep)) continue;
      if (!(glm::dot(presses[i].push, presses[j].push) < kCrushSettings.opposed)) continue;
      found.resize(contacts.size());
      found[presses[i].contact] = found[presses[j].contact] = 1;
    }
  return found;
}

// A pair of which is told that it touches: its begin was an event, its end will be one.
struct ToldPair {
  Pair pair;
  int frames_left = 0;  // steps without touch before its end is told
};

// What is new about the contacts, in order of ids as they and the pairs told of are: `old` ones
// before, `told` now. A pair that parts is said to have done so after `frames` steps.
template <int D, class BodyOf>
void tell_events(std::span<const Contact<D>> contacts, int frames, BodyOf&& body_of,
                 double thinnest, std::span<const ToldPair> old, std::vector<ToldPair>& told,
                 std::vector<ContactEvent>& events) {
  const Scratch<std::uint8_t> crush = crushing<D>(contacts, body_of, thinnest);
  told.clear();
  events.clear();
  std::size_t i = 0, j = 0;
  while (i < old.size() || j < contacts.size()) {
    stop_if_asked();
    const bool parted =
        j == contacts.size() || (i < old.size() && old[i].pair < contacts[j].pair());
    const bool known = parted || (i < old.size() && old[i].pair == contacts[j].pair());
    const ToldPair now = {parted ? old[i].pair : contacts[j].pair(),
                          (parted ? std::min(old[i].frames_left, frames) : frames) - 1};
    if (parted && now.frames_left < 0)
      events.push_back({ContactEvent::Kind::end, now.pair.a, now.pair.b});
    else
      told.push_back(now);
    if (!parted)
      events.push_back({known ? ContactEvent::Kind::stay : ContactEvent::Kind::begin, now.pair.a,
                        now.pair.b, !crush.empty() && crush[j] != 0});
    if (known) ++i;
    if (!parted) ++j;
  }
}

// When impacts were, and, for who asks, how that was found out. First where a body is at some
// moment within a step.
template <int D>
struct Pose {
  BodyId body = 0;
  Vec<D> position{0.0};
  Rotation<D> orientation{};
};

template <int D>
Pose<D> pose(const Body<D>& body) {
  return {body.id, body.position, body.orientation};
}

// An impact that was located: the two are there when they meet. Times are seconds since the step
// began.
template <int D>
struct ImpactMoment {
  double time = 0;
  Pose<D> a, b;
};

// A look at two bodies, on the way to the moment at which they meet.
template <int D>
struct ImpactLook {
  double time = 0;
  Pose<D> a, b;
  Vec<D> on_a{0.0}, on_b{0.0};  // where their surfaces are nearest to each other, and
  double gap = 0;               // how near; below 0 they overlap: too late
  double free_until = 0;  // they are sure not to touch before; `time` if this look says nothing
  bool meets = false;     // this is the moment, if nothing else comes between
};

template <int D>
struct ImpactLog {
  std::vector<ImpactMoment<D>> moments;  // one island after another, in each as time passes
  std::vector<ImpactLook<D>> looks;      // in the order in which they were made, if
  bool keeps_looks = false;
};

}  // namespace lantern::physics
