#include "physics/waking.hpp"

#include <algorithm>

#include "base/stop.hpp"

namespace lantern {

template <int D>
void wake_together(std::vector<Body<D>>& bodies, std::vector<double>& rested,
                   std::vector<std::uint32_t> places, std::span<const Pair> links,
                   Disturbed disturbed) {
  if (places.empty()) return;
  const auto place_of = [&](BodyId id) {
    return static_cast<std::uint32_t>(std::ranges::lower_bound(bodies, id, {}, &Body<D>::id) -
                                      bodies.begin());
  };
  std::vector<std::vector<std::uint32_t>> linked(bodies.size());
  for (const Pair& link : links) {
    stop_if_asked();
    const std::uint32_t a = place_of(link.a), b = place_of(link.b);
    if (bodies[b].kind == BodyKind::dynamic_body) linked[a].push_back(b);
    if (bodies[a].kind == BodyKind::dynamic_body) linked[b].push_back(a);
  }
  std::vector<std::uint8_t> seen(bodies.size());
  while (!places.empty()) {
    stop_if_asked();
    const std::uint32_t place = places.back();
    places.pop_back();
    Body<D>& body = bodies[place];
    if (seen[place] || (disturbed == Disturbed::sleepers && !body.asleep)) continue;
    seen[place] = true;
    body.asleep = false;
    rested[place] = 0;
    places.insert(places.end(), linked[place].begin(), linked[place].end());
  }
}

template void wake_together(std::vector<Body<2>>&, std::vector<double>&, std::vector<std::uint32_t>,
                            std::span<const Pair>, Disturbed);
template void wake_together(std::vector<Body<3>>&, std::vector<double>&, std::vector<std::uint32_t>,
                            std::span<const Pair>, Disturbed);

}  // namespace lantern
