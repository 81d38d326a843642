// Each metric is held against motion made by hand: right, it must say zero; wrong, by how much.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "measure/contact_runs.hpp"

namespace lantern::measure {
namespace {

constexpr double kRounding = 1e-12;

void expect_all_small(const Norms& norms, const std::string& what) {
  for (const auto& [name, value] : norms) EXPECT_LE(value, kRounding) << what << ": " << name;
}

// From 1.25 m at g = 10: 0.5 s to the ground, 5 m/s there.
void bounce(Observation& now, double e, double late = 0) {
  double t = now.time - late, speed = 5, since = t - 0.5;
  while (since > 2 * e * speed / 10 && speed > 1e-13) since -= 2 * (speed *= e) / 10;
  if (t < 0.5)
    speed = 5, since = t + 0.5;
  else
    speed *= e;
  if (speed < 1e-12) speed = since = 0;
  now.states[1].position.y = 0.5 + speed * since - 5 * since * since;
  now.states[1].velocity.y = speed - 10 * since;
}

TEST(BouncingBall, TellsExactBounces) {
  for (const std::string e : {"0.8", "0.3", "1", "0.999"})
    expect_all_small(
        looked_at(problem("bouncing_ball", {{"restitution = 0.8", "restitution = " + e}}),
                  [&](Observation& now) { bounce(now, std::stod(e)); }),
        "e = " + e);
}

TEST(BouncingBall, TellsHowLateAndHowHigh) {
  const Scenario scenario = problem("bouncing_ball", {{"samples = 50", "samples = 7"}});
  const Norms late = looked_at(scenario, [](Observation& now) { bounce(now, 0.8, 1e-3); });
  EXPECT_NEAR(late.at("times"), 1e-3, 1e-9) << "a millisecond of a first flight of one second";
  const Norms high = looked_at(scenario, [](Observation& now) {
    bounce(now, 0.8);
    now.states[1].position.y += 0.125;
  });
  EXPECT_NEAR(high.at("apex"), 0.1, 1e-12) << "0.125 of 1.25 units";
  const Norms sunk = looked_at(scenario, [](Observation& now) { now.states[1].position.y = 0; });
  EXPECT_GE(sunk.at("apex"), 0.4) << "what lies in the ground does not rest well";
}

TEST(BouncingBall, TellsNoNumber) {
  const Norms norms = looked_at(problem("bouncing_ball"), [](Observation& now) {
    now.states[1].velocity.y = std::numeric_limits<double>::quiet_NaN();
  });
  EXPECT_FALSE(std::isfinite(norms.at("times")) && std::isfinite(norms.at("apex")));
}

// The blocks from hit to hit, as one would by hand.
struct Hits {
  double light = 1, heavy = 2.5, v = 0, w = -1, ratio = 100;  // gaps to the wall, velocities
  std::uint64_t count = 0;
  void fly_to(double t, double& now) {
    for (;;) {
      const double to_wall = v < 0 ? light / -v : 1e300;
      const double to_hit = v > w ? (heavy - light) / (v - w) : 1e300;
      const double next = std::min({to_wall, to_hit, t - now});
      light += v * next;
      heavy += w * next;
      now += next;
      if (next == to_wall) {
        v = -v;
      } else if (next == to_hit) {
        const double middle = (v + ratio * w) / (1 + ratio);
        v = 2 * middle - v;
        w = 2 * middle - w;
      } else {
        return;
      }
      ++count;
    }
  }
};

Norms counted(int too_many, bool tells) {
  Hits hits;
  double reached = 0;
  return looked_at(problem("blocks_and_wall"), [&](Observation& now) {
    hits.fly_to(now.time, reached);
    now.states[1].velocity.x = hits.v;
    now.states[2].velocity.x = hits.w;
    if (tells) now.impacts = hits.count + static_cast<std::uint64_t>(too_many);
  });
}

TEST(BlocksAndWall, CountsHits) {
  expect_all_small(counted(0, true), "31 hits");
  EXPECT_EQ(counted(2, true).at("hits"), 2) << "two hits too many";
  EXPECT_EQ(counted(0, false).at("hits"), 0) << "the velocities alone say how many there were";
  const Norms none = looked_at(problem("blocks_and_wall"), [](Observation&) {});
  EXPECT_NEAR(none.at("hits"), 31, 0) << "the heavy one went through all";
}

TEST(Collisions, TellVelocities) {
  const Norms cradle = looked_at(problem("newtons_cradle"), [](Observation& now) {
    if (now.time < 1.1) return;  // the balls touch after 1.5 / 2 s, all at once
    for (BodyState& state : now.states) state.velocity.x = 0;
    now.states[5].velocity.x = now.states[6].velocity.x = 2;
  });
  expect_all_small(cradle, "as many go on as came");
  const Scenario scenario = problem("superball_stiff");
  const double m = 1000, v = 2;
  const auto after = [&](double off) {
    return looked_at(scenario, [&](Observation& now) {
      if (now.time < 1) return;
      now.states[0].velocity.x = v * (m - 1) / (m + 1);
      now.states[1].velocity.x = 2 * m * v / (m + 1) + off;
    });
  };
  expect_all_small(after(0), "v' = 2 m1 v / (m1 + m2)");
  EXPECT_NEAR(after(0.01).at("v"), 0.01 / (2 * m * v / (m + 1)), 1e-9);
  EXPECT_NEAR(after(0.01).at("p"), 0.01 / (m * v), 1e-9);
}

class Noting : public Simulation {
 public:
  void advance(std::uint64_t) override {}
  void act(const Verb& verb) override { moves.push_back(std::get<Move>(verb)); }
  void observe(std::vector<BodyState>&) const override {}
  std::vector<Move> moves;
};

TEST(Billiards, AreTurnedRoundOnceInTheMiddle) {
  const Scenario scenario = problem("billiards");
  const auto metric = metrics_of(scenario)();
  Noting simulation;
  for (std::uint32_t i = 0; i <= scenario.problem->samples; ++i) {
    const Observation now = at_start(scenario);
    metric->look(now);
    metric->interfere(now, simulation);
    EXPECT_EQ(simulation.moves.size(), i < 10 ? 0 : scenario.bodies.size()) << "after look " << i;
  }
  EXPECT_EQ(simulation.moves[0].velocity.value(), -scenario.bodies[0].velocity);
}

TEST(Billiards, TellHowFarFromTheStart) {
  const auto back = [](double off) {
    return looked_at(problem("billiards"), [&](Observation& now) {
      if (now.time < 3.01) return;
      for (BodyState& state : now.states) state.velocity = -state.velocity;
      now.states[2].position.y += off;
    });
  };
  expect_all_small(back(0), "they are back");
  EXPECT_NEAR(back(0.01).at("return"), 0.02, 1e-12) << "a hundredth, of a radius of a half";
}

TEST(Slide, TellsWhereAndWhen) {
  const auto slid = [](double mu, double aside) {
    return looked_at(problem("slide"), [&](Observation& now) {
      const double t = std::min(now.time, 5 / (10 * mu));
      now.states[1].position += Vec<3>(5 * t - 5 * mu * t * t, 0, aside);
      now.states[1].velocity.x = now.time < 5 / (10 * mu) ? 5 - 10 * mu * t : 0;
    });
  };
  expect_all_small(slid(0.5, 0), "it slides as it should");
  EXPECT_NEAR(slid(0.5, 0.025).at("distance"), 0.01, 1e-12) << "aside counts, too";
  EXPECT_NEAR(slid(0.4, 0).at("distance"), 0.25, 1e-12) << "too little friction";
  EXPECT_GE(slid(0.4, 0).at("time"), 0.2) << "too little friction";
  const Norms one_stays = looked_at(problem("slide_extreme"), [](Observation& now) {
    for (std::size_t i = 1; i < now.states.size(); ++i) {
      const Vec<3> v = now.states[i].velocity;
      const double t = std::min(now.time, 1.0);
      if (i > 1) now.states[i].position += v * (t - t * t / 2);
      now.states[i].velocity = i > 1 && t < 1 ? v * (1 - t) : Vec<3>(0.0);
    }
  });
  EXPECT_NEAR(one_stays.at("agree"), 1, 1e-9) << "one of 24 did not move";
}

TEST(SlipThenRoll, TellsWhenItRolls) {
  const auto thrown = [](double rolls) {
    return looked_at(problem("slip_then_roll"), [&](Observation& now) {
      const double t = std::min(now.time, rolls), rest = now.time - t, v = 7 - 2 * t;
      now.states[1].position.x = 7 * t - t * t + v * rest;
      now.states[1].velocity.x = v;
      now.states[1].angular_velocity.z = -2.5 * (7 - v) / 0.5;
    });
  };
  expect_all_small(thrown(1), "5/7 of its speed, after 2/7 v / (mu g)");
  EXPECT_NEAR(thrown(0.9).at("v"), 0.2 / 7, 1e-12) << "it stopped slipping too early";
  EXPECT_GE(thrown(0.9).at("time"), 0.1) << "it goes on slipping";
}

TEST(Incline, TellsAccelerationAndClass) {
  const double g = 10, s = 0.5, c = std::sqrt(0.75);
  const double exact[] = {0, g * (s - 0.3 * c), g * (s - 0.1 * c), g * s / 1.4};
  const double slipping[] = {0, 0, 2.5 * g * 0.1 * c, 1};  // spin times radius, per second
  const auto slid = [&](std::size_t body, double off) {
    return looked_at(problem("incline"), [&](Observation& now) {
      for (std::size_t i = 0; i < 4; ++i) {
        const double a = exact[i] + (i == body ? off : 0), t = now.time;
        now.states[i + 1].position += Vec<3>(c, -s, 0) * (a * t * t / 2);
        now.states[i + 1].velocity = Vec<3>(c, -s, 0) * (a * t);
        now.states[i + 1].angular_velocity.z = -t * (i == 3 ? a : slipping[i]) / 0.5;
      }
    });
  };
  expect_all_small(slid(0, 0), "all as they should");
  EXPECT_NEAR(slid(1, 0.5).at("a"), 0.05, 1e-12) << "half a unit a second too fast, of g = 10";
  EXPECT_EQ(slid(1, 0.5).at("class"), 0) << "but it slides";
  EXPECT_EQ(slid(0, 2).at("class"), 1) << "the one that should stay slides";
  EXPECT_EQ(slid(1, -exact[1]).at("class"), 1) << "the one that should slide stays";
}

TEST(Topple, TellsWhoStands) {
  const auto leaning = [](double cube, double tower) {
    return looked_at(problem("topple"), [&](Observation& now) {
      const double share = now.time / 2;
      now.states[1].orientation = turned(now.states[1].orientation, {0, 0, -cube * share});
      now.states[2].orientation = turned(now.states[2].orientation, {0, 0, -tower * share});
    });
  };
  EXPECT_EQ(leaning(0, 1.5).at("class"), 0);
  EXPECT_NEAR(leaning(0, 1.5).at("tilt"), 0, 1e-7);
  EXPECT_EQ(leaning(0, 0).at("class"), 1) << "the tower should have fallen";
  EXPECT_EQ(leaning(1.5, 1.5).at("class"), 1) << "the cube should stand";
  EXPECT_NEAR(leaning(0.05, 1.5).at("tilt"), 0.05, 1e-9);
}

TEST(Stack, TellsDepthAndImpulse) {
  const Scenario scenario = problem("stack");
  expect_all_small(looked_at(scenario, [](Observation&) {}), "it stands");
  const Norms deep =
      looked_at(scenario, [](Observation& now) { now.states[3].position.y -= 0.01; });
  EXPECT_NEAR(deep.at("depth"), 0.01, 1e-12);
  // The upper two of five fall at g: the contacts below carry three, two and one.
  const Norms falls = looked_at(scenario, [](Observation& now) {
    for (const int i : {4, 5}) now.states[i].velocity.y = -10 * now.time;
  });
  EXPECT_NEAR(falls.at("impulse"), 1, 1e-9) << "the fourth contact carries nothing";
  const Norms slow =
      looked_at(scenario, [](Observation& now) { now.states[5].velocity.y = -now.time; });
  EXPECT_NEAR(slow.at("impulse"), 0.1, 1e-9) << "a tenth of the uppermost box's weight";
}

TEST(Stack, TakesASkinForAPartOfTheShape) {
  const Norms hovering = looked_at(problem("stack"), [](Observation& now) {
    now.skins.assign(now.states.size(), 0.01);
    for (std::size_t i = 1; i < now.states.size(); ++i)
      now.states[i].position.y += 0.015 * static_cast<double>(i);
  });
  EXPECT_NEAR(hovering.at("depth"), 0.005, 1e-12) << "two skins of 0.01, 0.015 apart";
}

TEST(Stack, SaysThatItFell) {
  const Scenario scenario = problem("stack");
  const auto ends = [&](double down) {
    const auto metric = metrics_of(scenario)();
    metric->look(at_start(scenario));
    Observation now = at_start(scenario);
    now.time = 10;
    now.states.back().position.y -= down;
    metric->look(now);
    return metric->collapse();
  };
  EXPECT_EQ(ends(0.49), std::nullopt);
  ASSERT_TRUE(ends(0.51)) << "half a box";
  EXPECT_NE(ends(4)->find("below its place"), std::string::npos);
}

TEST(HangingChain, TellsStretchAndTension) {
  const Scenario scenario = problem("hanging_chain");
  expect_all_small(looked_at(scenario, [](Observation&) {}), "it hangs");
  const Norms grown =
      looked_at(scenario, [](Observation& now) { now.states[0].position.y -= 0.02; });
  EXPECT_NEAR(grown.at("stretch"), 0.02, 1e-12);
  const Norms torn =
      looked_at(scenario, [](Observation& now) { now.states[0].velocity.y = -5 * now.time; });
  EXPECT_NEAR(torn.at("tension"), 0.5, 1e-9) << "the last joint carries half of the end";
}

}  // namespace
}  // namespace lantern::measure
