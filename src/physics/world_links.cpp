// What ties bodies of a world, and what pushes them.
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "geometry/not_finite.hpp"
#include "physics/world.hpp"

namespace lantern::physics {
namespace {

template <int D>
void check_spring(const Spring<D>& spring, const std::string& who) {
  if (spring.a == spring.b)
    throw Refused(fmt::format("{}: both ends are on body {}", who, spring.a));
  require_finite(spring.at_a, who, "at_a");
  require_finite(spring.at_b, who, "at_b");
  require_not_negative(spring.rest_length, who, "rest_length");
  require_not_negative(spring.stiffness, who, "stiffness");
  require_not_negative(spring.damping, who, "damping");
}

template <int D>
void check_same_integrator(const Body<D>& a, const Body<D>& b, const WorldConfig<D>& config) {
  const auto dynamic = BodyKind::dynamic_body;
  const Integrator of_a = a.integrator.value_or(config.integrator);
  const Integrator of_b = b.integrator.value_or(config.integrator);
  if (a.kind != dynamic || b.kind != dynamic || of_a == of_b) return;
  throw Refused(fmt::format("spring between '{}' and '{}': one is moved by {}, the other by {}",
                            a.name, b.name, to_string(of_a), to_string(of_b)));
}

}  // namespace

template <int D>
SpringId World<D>::add_spring(const Spring<D>& spring) {
  const Body<D>& a = bodies_[index_of(spring.a)];
  const Body<D>& b = bodies_[index_of(spring.b)];
  check_spring(spring, fmt::format("spring {}", next_spring_));
  check_same_integrator(a, b, config_);
  wake_from(std::array{spring.a, spring.b});
  forces_.springs.push_back(spring);
  spring_ids_.push_back(next_spring_);
  return next_spring_++;
}

template <int D>
JointId World<D>::add_joint(const Joint<D>& joint) {
  const std::string who = fmt::format("joint {}", next_joint_);
  const Body<D>& a = bodies_[index_of(joint.a)];
  const Body<D>& b = bodies_[index_of(joint.b)];
  if (joint.a == joint.b) throw Refused(fmt::format("{}: joins a body to itself", who));
  if (a.kind != BodyKind::dynamic_body && b.kind != BodyKind::dynamic_body)
    throw Refused(fmt::format("{}: neither of its bodies can be moved", who));
  require_finite<D>(joint.at_a, who, "at_a");
  require_finite<D>(joint.at_b, who, "at_b");
  if (joint.kind == JointKind::distance && !(std::isfinite(joint.length) && joint.length > 0))
    throw Refused(fmt::format("{}: length is {}, must be above 0", who, joint.length));
  wake_from(std::array{joint.a, joint.b});
  joints_.emplace_back(next_joint_, joint);
  joint_memories_.push_back({});
  return next_joint_++;
}

template <int D>
void World<D>::remove_spring(SpringId id) {
  const auto place = std::ranges::find(spring_ids_, id) - spring_ids_.begin();
  if (place == std::ssize(spring_ids_)) return;
  const auto spring = forces_.springs.begin() + place;
  wake_from(std::array{spring->a, spring->b});
  forces_.springs.erase(spring);
  spring_ids_.erase(spring_ids_.begin() + place);
  part_islands();
}

template <int D>
void World<D>::remove_joint(JointId id) {
  const auto entry = std::ranges::find(joints_, id, &std::pair<JointId, Joint<D>>::first);
  if (entry == joints_.end()) return;
  wake_from(std::array{entry->second.a, entry->second.b});
  joint_memories_.erase(joint_memories_.begin() + (entry - joints_.begin()));
  joints_.erase(entry);
  part_islands();
}

template <int D>
std::vector<Pair> World<D>::links() const {
  std::vector<Pair> all;
  for (const Touch& touch : touching_) all.push_back(touch.record.pair());
  for (const Spring<D>& spring : forces_.springs) all.push_back({spring.a, spring.b});
  for (const auto& entry : joints_) all.push_back({entry.second.a, entry.second.b});
  return all;
}

template <int D>
void World<D>::push(BodyId id, const Vec<D>& force, const Vec<D>& at,
                    std::optional<double> seconds) {
  const Body<D>& body = bodies_[index_of(id)];
  const std::string who = fmt::format("body '{}'", body.name);
  require_finite<D>(force, who, "force");
  require_finite<D>(at, who, "point of the force");
  const Vec<D> arm = at - body.position;
  require_finite<D>(arm, who, "lever of the force");
  if (seconds && !(std::isfinite(*seconds) && *seconds > 0))
    throw Refused(fmt::format("{}: a push of {} seconds is not allowed", who, *seconds));
  wake_from(id);
  TimedPush push{{id, arm, force}, std::nullopt};
  if (seconds) push.until = time_ + *seconds;
  pushes_.push_back(push);
  list_pushes();
}

template <int D>
void World<D>::list_pushes() {
  forces_.pushes.clear();
  for (const TimedPush& push : pushes_) forces_.pushes.push_back(push.push);
}

template <int D>
void World<D>::clear_pushes() {
  std::vector<BodyId> pushed;
  for (const TimedPush& push : pushes_) pushed.push_back(push.push.body);
  wake_from(pushed);
  pushes_.clear();
  list_pushes();
}

template <int D>
void World<D>::clear_pushes(BodyId id) {
  if (find(id) != nullptr) wake_from(id);
  std::erase_if(pushes_, [&](const TimedPush& push) { return push.push.body == id; });
  list_pushes();
}

#define LANTERN_INSTANTIATE(D)                                                               \
  template SpringId World<D>::add_spring(const Spring<D>&);                                  \
  template JointId World<D>::add_joint(const Joint<D>&);                                     \
  template void World<D>::remove_spring(SpringId);                                           \
  template void World<D>::remove_joint(JointId);                                             \
  template std::vector<Pair> World<D>::links() const;                                        \
  template void World<D>::push(BodyId, const Vec<D>&, const Vec<D>&, std::optional<double>); \
  template void World<D>::clear_pushes();                                                    \
  template void World<D>::clear_pushes(BodyId);

LANTERN_INSTANTIATE(2)
LANTERN_INSTANTIATE(3)
#undef LANTERN_INSTANTIATE

}  // namespace lantern::physics
