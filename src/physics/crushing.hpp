// Bodies that are pressed between others, deeper than contacts can hold: a wall that moves, or
// something heavy, pushes them against what does not give way.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "physics/body.hpp"
#include "physics/contacts.hpp"

namespace lantern::physics {

// The numbers by which a body is said to be crushed.
struct CrushSettings {
  double deep = 0.5;      // of its thickness: so deep two contacts lie in it together
  double opposed = -0.5;  // cosine between their normals: they press from opposite sides
};
inline constexpr CrushSettings kCrushSettings;

// For each contact whether it crushes a body: that it presses, and another one does against it.
// Nothing if none does. `body_of(id)` is the body where the step has left it.
template <int D, class BodyOf>
std::vector<std::uint8_t> crushing(const std::vector<Contact<D>>& contacts, BodyOf&& body_of) {
  struct Press {
    BodyId body;
    std::size_t contact;
    Vec<D> push;   // upon the body
    double depth;  // of its thickness
  };
  std::vector<Press> presses;
  bool deep = false;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Contact<D>& contact = contacts[i];
    double depth = 0, impulse = 0;
    for (const ManifoldPoint<D>& p : contact.manifold.points())
      depth = std::max(depth, -p.separation);
    for (const double pn : contact.normal_impulses) impulse += pn;
    if (!(depth > 0 && impulse > 0)) continue;
    for (const BodyId id : {contact.a, contact.b}) {
      const Body<D>& body = body_of(id);
      if (body.kind != BodyKind::dynamic_body) continue;
      presses.push_back({id, i, contact.manifold.normal * (id == contact.a ? -1.0 : 1.0),
                         depth / thickness<D>(body.shape)});
      deep |= presses.back().depth > kCrushSettings.deep / 2;
    }
  }
  std::vector<std::uint8_t> found;
  if (!deep) return found;
  std::stable_sort(presses.begin(), presses.end(),
                   [](const Press& x, const Press& y) { return x.body < y.body; });
  for (std::size_t i = 0; i < presses.size(); ++i)
    for (std::size_t j = i + 1; j < presses.size() && presses[j].body == presses[i].body; ++j) {
      if (!(presses[i].depth + presses[j].depth > kCrushSettings.deep)) continue;
      if (!(glm::dot(presses[i].push, presses[j].push) < kCrushSettings.opposed)) continue;
      found.resize(contacts.size());
      found[presses[i].contact] = found[presses[j].contact] = 1;
    }
  return found;
}

}  // namespace lantern::physics
