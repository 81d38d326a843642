// The state of a world in one number.
#include "base/hash.hpp"
#include "physics/world.hpp"

namespace lantern::physics {
namespace {

void add_to(Hash& hash, double value) { hash.add(value); }
template <int D>
void add_to(Hash& hash, const glm::vec<D, double>& value) {
  for (int i = 0; i < D; ++i) hash.add(value[i]);
}
void add_to(Hash& hash, const Rotation<2>& r) { hash.add(r.angle); }
void add_to(Hash& hash, const Rotation<3>& r) { hash.add(r.q.w).add(r.q.x).add(r.q.y).add(r.q.z); }

template <int D>
void add_to(Hash& hash, const Contact<D>& contact) {
  add_to(hash, contact.manifold.normal);
  for (std::size_t i = 0; i < static_cast<std::size_t>(contact.manifold.count); ++i) {
    hash.add(std::uint64_t{contact.manifold.room[i].feature}).add(contact.normal_impulses[i]);
    add_to(hash, contact.friction_impulses[i]);
  }
}

}  // namespace

template <int D>
std::uint64_t World<D>::hash() const {
  Hash hash;
  hash.add(time_);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Body<D>& body = bodies_[i];
    hash.add(std::uint64_t{body.id}).add(std::uint64_t{body.asleep});
    add_to(hash, body.position);
    add_to(hash, body.orientation);
    add_to(hash, body.velocity);
    add_to(hash, body.angular_momentum);
    add_to(hash, body.kinematic_spin);
    hash.add(body.inverse_mass).add(rested_[i]);
  }
  add_to(hash, forces_.gravity);
  if (forces_.gravitation > 0) hash.add(forces_.gravitation);
  for (const Spring<D>& spring : forces_.springs) {
    hash.add(std::uint64_t{spring.a}).add(std::uint64_t{spring.b});
    add_to(hash, spring.at_a);
    add_to(hash, spring.at_b);
    hash.add(spring.rest_length).add(spring.stiffness).add(spring.damping);
  }
  for (const Push<D>& push : forces_.pushes) {
    hash.add(std::uint64_t{push.body});
    add_to(hash, push.at);
    add_to(hash, push.force);
  }
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    hash.add(std::uint64_t{joints_[i].first});
    add_to(hash, joint_memories_[i].impulse);
  }
  for (const Touch& touch : touching_) {
    hash.add(std::uint64_t{touch.record.a}).add(std::uint64_t{touch.record.b});
    add_to(hash, touch.memory);
  }
  return hash.value();
}

template std::uint64_t World<2>::hash() const;
template std::uint64_t World<3>::hash() const;

}  // namespace lantern::physics
