// What engines beside Lantern are called, and what they refuse. Without any installed all is
// skipped.
#include <algorithm>
#include <filesystem>
#include <map>

#include "measure/peer_scenes.hpp"

namespace lantern::measure {
namespace {

TEST_F(Peers, HaveNamesAndVersions) {
  std::vector<std::string> names;
  for (const auto& peer : found_) {
    EXPECT_TRUE(peer->is_peer()) << peer->name();
    EXPECT_EQ(std::count(names.begin(), names.end(), peer->name()), 0) << peer->name();
    names.push_back(peer->name());
  }
}

TEST_F(Peers, AreAllThereOrMissingWithAHint) {
  for (const std::string& line : missing_) EXPECT_NE(line.find(": "), std::string::npos) << line;
  EXPECT_LE(missing_.size(), 4u);
}

TEST_F(Peers, RefuseWhatTheyCannotDo) {
  for (const auto& peer : found_) {
    Scenario steered = scene(2, {ball({0, 0, 0})});
    steered.bodies[0].brain = Brain::follow;
    EXPECT_TRUE(peer->cannot(steered)) << peer->name();
    EXPECT_THROW(peer->start(steered, 0.01), Refused) << peer->name();
    Scenario level = scene(2, {ball({0, 0, 0})});
    level.level.emplace();
    EXPECT_TRUE(peer->cannot(level)) << peer->name();
    EXPECT_THROW(peer->start(scene(2, {ball({0, 0, 0})}), 0), Refused) << peer->name();
    if (peer->name().starts_with("Box2D")) {
      EXPECT_TRUE(peer->cannot(scene(3, {ball({0, 0, 0})}))) << peer->name();
    }
  }
}

// Where nothing touches and nothing is jointed, efforts make no difference, and only one is run.
TEST_F(Peers, AreRunOnceWhereTheirEffortsAreTheSame) {
  std::map<std::string, int> runs;
  for (const auto& peer : found_)
    if (!peer->cannot(scene(2, {ball({0, 0, 0})})))
      ++runs[peer->name().substr(0, peer->name().find(':'))];
  EXPECT_EQ(runs.size(), 3 - missing_.size());
  for (const auto& [engine, count] : runs)
    EXPECT_EQ(count, engine == "MuJoCo" ? 3 : 1) << engine << ": one for each integrator";
}

// What a module throws must be caught as what it is.
TEST_F(Peers, RefuseWhatTheirStepHasNoRoomFor) {
  for (const auto& peer : found_) {
    if (peer->name() != "Box2D:8,3") continue;
    const Scenario fast = scene(2, {ball({0, 0, 0}, {1e4, 0, 0})});
    EXPECT_THROW(peer->start(fast, 0.01), Refused);
    EXPECT_NO_THROW(peer->start(fast, 1e-4));
  }
}

// Engines that stop the program, or never end, on a state that is not a number.
TEST_F(Peers, RefuseToGoOnBeyondNumbers) {
  each([](const Solver& peer, int dimension) {
    Scenario s = scene(dimension, {ball({1, 0, 0}), ball({0, 0, 0})});
    LinkSpec spring;
    spring.rest_length = 0;
    spring.stiffness = 1e30;
    s.links = {spring};
    if (peer.cannot(s)) return;
    try {
      std::vector<BodyState> states;
      const auto simulation = peer.start(s, 0.5);
      simulation->advance(100);
      simulation->observe(states);
    } catch (const Refused& refused) {
      EXPECT_STRNE(refused.what(), "");
    }
  });
}

// The problems and scenarios that come with Lantern: run for a moment or refused with a reason. (Of
// many bodies MuJoCo takes seconds to make a model.)
TEST_F(Peers, RunOrRefuseEveryScenario) {
  namespace fs = std::filesystem;
  for (const char* folder : {"/scenarios", "/scenarios/problems"})
    for (const auto& entry : fs::directory_iterator(std::string(LANTERN_ROOT) + folder)) {
      if (entry.path().extension() != ".toml") continue;
      const Scenario s = load_scenario(entry.path());
      if (s.bodies.size() > 60) continue;  // more of the same, and slow
      for (const auto& peer : found_) {
        SCOPED_TRACE(s.name + " by " + peer->name());
        if (const auto reason = peer->cannot(s)) {
          EXPECT_FALSE(reason->empty());
          continue;
        }
        if (s.bodies.size() > 60) continue;
        try {
          const auto simulation = peer->start(s, s.problem ? s.problem->step : s.world.time_step);
          simulation->advance(3);
          std::vector<BodyState> states;
          simulation->observe(states);
          EXPECT_EQ(states.size(), s.bodies.size());
        } catch (const Refused& refused) {
          EXPECT_STRNE(refused.what(), "");
        }
      }
    }
}

}  // namespace
}  // namespace lantern::measure
