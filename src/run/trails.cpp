#include "run/trails.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/flat.hpp"

namespace lantern::run {
namespace {

double angle_of(const Rotation<2>& rotation) { return rotation.angle; }
double angle_of(const Rotation<3>&) { return 0; }

template <int D>
FramePlace place_of(const Vec<D>& position, const Rotation<D>& orientation) {
  return {solid(position), angle_of(orientation)};
}
template <int D>
FramePlace place_of(const Pose<D>& pose) {
  return place_of<D>(pose.position, pose.orientation);
}

// The last `steps` ends of steps, and what lies between them.
void keep_last(std::vector<FrameStop>& way, int steps) {
  int ends = 0;
  for (std::size_t i = way.size(); i-- > 0;) {
    ends += !way[i].impact;
    if (ends < steps) continue;
    way.erase(way.begin(), way.begin() + static_cast<std::ptrdiff_t>(i));
    return;
  }
}

}  // namespace

template <int D>
void Trails<D>::begin(const World<D>& world) {
  for (const Body<D>& body : world.bodies()) {
    if (!body.moves() || body.asleep) continue;
    std::vector<FrameStop>& way = ways_[body.id];
    way.push_back({place_of<D>(body.position, body.orientation), false});
    keep_last(way, kMostTrail);
  }
}

template <int D>
void Trails<D>::end(const World<D>& world) {
  std::vector<const ImpactMoment<D>*> moments;
  for (const ImpactMoment<D>& moment : world.impacts().moments) moments.push_back(&moment);
  std::ranges::stable_sort(moments, {}, &ImpactMoment<D>::time);
  for (const ImpactMoment<D>* moment : moments)
    for (const Pose<D>& pose : {moment->a, moment->b})
      if (const auto way = ways_.find(pose.body); way != ways_.end() && world.find(pose.body))
        way->second.push_back({place_of<D>(pose), true});
}

template <int D>
void Trails<D>::picture(const World<D>& world, double h, Frame& frame) const {
  for (FrameBody& body : frame.bodies) {
    const Body<D>* now = world.find(body.id);
    if (!now || !now->moves() || now->asleep) continue;
    if (const auto way = ways_.find(body.id); way != ways_.end()) {
      body.trail = way->second;
      keep_last(body.trail, frame.display.trail);
    }
    const Body<D> flown = world.flown(body.id, h);
    if (flown.position != now->position)
      body.ahead = place_of<D>(flown.position, flown.orientation);
  }
}

template <int D>
std::vector<FrameLook> looks_of(const ImpactLog<D>& log, double h) {
  constexpr double kSameMoment = 0.004;  // of the step
  std::vector<FrameLook> looks;
  if (log.moments.empty()) return looks;
  const ImpactMoment<D>* first = &log.moments.front();
  for (const ImpactMoment<D>& moment : log.moments)
    if (moment.time < first->time) first = &moment;
  const ImpactLook<D>* last = nullptr;
  for (const ImpactLook<D>& look : log.looks) {
    if (look.a.body != first->a.body || look.b.body != first->b.body) continue;
    if (look.meets && std::abs(look.time - first->time) <= kSameMoment * h) {
      last = &look;
      break;
    }
  }
  if (last == nullptr) return looks;
  const auto add = [&](const ImpactLook<D>& look, int number) {
    looks.push_back({{look.a.body, look.b.body},
                     place_of<D>(look.a),
                     place_of<D>(look.b),
                     solid(look.on_a),
                     solid(look.on_b),
                     look.time / h,
                     look.gap,
                     look.free_until / h,
                     look.meets,
                     number});
  };
  int number = 0;
  for (const ImpactLook<D>& look : log.looks) {
    if (look.a.body != last->a.body || look.b.body != last->b.body) continue;
    if (look.time > last->time && look.gap >= 0) break;  // for what comes after the impact
    ++number;
    if (std::abs(look.time - last->time) > kSameMoment * h && looks.size() + 1 < kMostLooks)
      add(look, number);
  }
  add(*last, number);
  return looks;
}

template class Trails<2>;
template class Trails<3>;
template std::vector<FrameLook> looks_of(const ImpactLog<2>&, double);
template std::vector<FrameLook> looks_of(const ImpactLog<3>&, double);

}  // namespace lantern::run
