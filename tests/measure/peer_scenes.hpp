// Small scenes that every engine is asked to move.
#pragma once

#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "measure/solvers.hpp"

namespace lantern::measure {

inline BodySpec ball(const Vec<3>& position, const Vec<3>& velocity = Vec<3>(0.0)) {
  BodySpec body;
  body.name = "ball";
  body.shape = Sphere{0.5};
  body.mass = 2;
  body.position = position;
  body.velocity = velocity;
  return body;
}

inline BodySpec ground(const Vec<3>& normal) {
  BodySpec body;
  body.name = "ground";
  body.shape = HalfSpace<3>{normal};
  body.kind = BodyKind::static_body;
  return body;
}

inline Scenario scene(int dimension, std::vector<BodySpec> bodies) {
  ScenarioSpec s;
  s.world.dimension = dimension;
  s.world.bounds = {Vec<3>(-20.0), Vec<3>(20.0)};
  s.bodies = std::move(bodies);
  s.problem.emplace();
  return Scenario(std::move(s));
}

inline std::vector<BodyState> after(const Solver& peer, const Scenario& s, double h, int steps) {
  const auto simulation = peer.start(s, h);
  simulation->advance(static_cast<std::uint64_t>(steps));
  std::vector<BodyState> states;
  simulation->observe(states);
  EXPECT_EQ(simulation->counted().steps, static_cast<std::uint64_t>(steps));
  return states;
}

// With each engine that is there, in each dimension that it has.
class Peers : public testing::Test {
 protected:
  void SetUp() override {
    found_ = load_peers(missing_);
    if (!found_.empty()) return;
    for (const std::string& line : missing_) std::puts(line.c_str());
    GTEST_SKIP() << "no other engine is built in";
  }

  template <class F>
  void each(F&& f) {
    for (const auto& peer : found_)
      for (const int dimension : {2, 3}) {
        if (dimension == 3 && peer->name().starts_with("Box2D")) continue;
        SCOPED_TRACE(peer->name() + " in " + std::to_string(dimension) + " dimensions");
        f(*peer, dimension);
      }
  }

  std::vector<std::string> missing_;
  std::vector<std::unique_ptr<Solver>> found_;
};

}  // namespace lantern::measure
