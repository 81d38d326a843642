// The bodies of a scene and how they move. Bodies fly freely until forces and contacts are asked
// for.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/error.hpp"
#include "physics/body.hpp"

namespace lantern {

template <int D>
class World {
 public:
  // Ids are given in order of adding, from 0, and never used again. Throws Refused, naming body and
  // field, for a size that is negative or not finite, a pose or velocity that is not finite; the
  // world stays as it was.
  BodyId add(Body<D> body) {
    check(body);
    body.id = next_id_;
    bodies_.push_back(std::move(body));
    return next_id_++;
  }

  // Does nothing if there is no such body.
  void remove(BodyId id) {
    std::erase_if(bodies_, [&](const Body<D>& body) { return body.id == id; });
  }

  // Throws Refused as `add` does, and for a body that is not there.
  void place(BodyId id, const Vec<D>& position, const Vec<D>& velocity) {
    const auto body =
        std::find_if(bodies_.begin(), bodies_.end(), [&](const auto& b) { return b.id == id; });
    if (body == bodies_.end()) throw Refused(fmt::format("there is no body {}", id));
    Body<D> moved = *body;
    moved.position = position;
    moved.velocity = velocity;
    check(moved);
    *body = std::move(moved);
  }

  // One step of `h` seconds. A step of 0 does nothing. Throws Refused, naming the body, for a
  // negative or non-finite step and when a position would overflow; the world stays as it was.
  void step(double h) {
    if (!std::isfinite(h) || h < 0) throw Refused(fmt::format("time step {} is not allowed", h));
    if (h == 0) return;  // else -0.0 + 0.0 would change the sign of a zero
    std::vector<Vec<D>> moved;
    moved.reserve(bodies_.size());
    for (const Body<D>& body : bodies_) {
      moved.push_back(!body.moves() ? body.position : body.position + body.velocity * h);
      const Box<D> box = bounding_box(body.shape, moved.back(), body.orientation);
      if (!is_valid(box)) throw Refused(fmt::format("body '{}': position overflows", body.name));
    }
    for (std::size_t i = 0; i < moved.size(); ++i) bodies_[i].position = moved[i];
  }

  // In order of ids.
  const std::vector<Body<D>>& bodies() const { return bodies_; }

 private:
  static void check(const Body<D>& body) {
    const auto finite = [&](const Vec<D>& v, const char* field) {
      for (int i = 0; i < D; ++i)
        if (!std::isfinite(v[i]))
          throw Refused(fmt::format("body '{}': {} is not finite", body.name, field));
    };
    const auto size = [&](double s, const char* field) {
      if (!std::isfinite(s) || s < 0)
        throw Refused(fmt::format("body '{}': {} is {}, must be finite and not negative", body.name,
                                  field, s));
    };
    finite(body.position, "position");
    finite(body.velocity, "velocity");
    if (const auto* sphere = std::get_if<Sphere>(&body.shape)) {
      size(sphere->radius, "radius");
    } else if (std::holds_alternative<AxisBox<D>>(body.shape)) {
      for (int i = 0; i < D; ++i) size(std::get<AxisBox<D>>(body.shape).half_size[i], "half_size");
    }
    if (!is_valid(body.box()))
      throw Refused(fmt::format("body '{}': its box is not finite", body.name));
  }

  std::vector<Body<D>> bodies_;
  BodyId next_id_ = 0;
};

}  // namespace lantern
