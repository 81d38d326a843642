// What a world remembers of pairs that touch, written down step by step.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "frame/parts/panels.hpp"
#include "physics/contact/contact_solver.hpp"
#include "physics/world.hpp"

namespace lantern::run {

class CollisionLog {
 public:
  // The world has just made a step. Pairs come in the order in which they first touched.
  template <int D>
  void see(const World<D>& world) {
    remembered_ = contact_solver(world.config().contacts).frames_remembered;
    const std::uint64_t step = world.work().steps;
    for (const auto& told : world.told()) row_of(told.pair).push_back({step, told.frames_left});
    for (const ContactEvent& event : world.events()) {
      std::vector<FrameCollision::Moment>& row = row_of({event.a, event.b});
      if (event.kind == ContactEvent::Kind::end) {
        row.push_back({step, -1});
      } else {
        row.back().touches = true;
        row.back().begins = event.kind == ContactEvent::Kind::begin;
      }
    }
  }

  void list(FrameCollisions& collisions) const {
    collisions.rows = rows_;
    collisions.remembered = remembered_;
  }

 private:
  std::vector<FrameCollision::Moment>& row_of(const Pair& pair) {
    const auto [place, is_new] = places_.emplace(pair, rows_.size());
    if (is_new) rows_.push_back({pair, {}});
    return rows_[place->second].moments;
  }

  std::vector<FrameCollision> rows_;
  std::map<Pair, std::size_t> places_;  // in rows_
  int remembered_ = 0;
};

}  // namespace lantern::run
