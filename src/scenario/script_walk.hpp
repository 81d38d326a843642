// What a script makes of its scene, as far as it can be told without running it.
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "scenario/scenario.hpp"

namespace lantern {

// Gathered in one walk over the steps. "Moving" and "turning" bodies are those that are in the
// world while time passes, and that move or may be made to.
class ScriptWalk {
 public:
  explicit ScriptWalk(const Scenario& scenario);

  std::vector<StructureKind> kinds;  // other than none, in order of use
  bool split_static = false;         // one of them is
  double seconds = 0;                // of world time
  double moving_seconds = 0;         // of these, with something moving
  std::string mover;                 // one that moves
  std::string turner;                // one that turns, or may
  std::vector<ContactMethod> methods;  // that part bodies, other than none, in order of use
  std::size_t promises = 0;
  std::size_t questions = 0;  // rays, culls, queries
  std::size_t plots = 0;
  bool pushes = false;    // a step applies a force
  bool sleeps = false;    // a step sends bodies to sleep
  bool compiles = false;  // the level

 private:
  void see(const auto&) {}  // most verbs change nothing of this
  void see(const Rebuild& rebuild) { add_structure(rebuild.structure); }
  void see(const Insert& insert);
  void see(const Remove& remove);
  void see(const Move& move);
  void see(const lantern::Run& run) { pass(run.seconds); }
  void see(const Wait& wait) { pass(wait.at_most); }
  void see(const Phases&);
  void see(const SolveBy& method) { add_method(method.contacts); }
  void see(const ApplyForce& force);
  void see(const ApplyImpulse& impulse);
  void see(const Sleep&) { sleeps = true; }
  void see(const CastRay&) { ++questions; }
  void see(const Cull&) { ++questions; }
  void see(const Query&) { ++questions; }
  void see(const CompileLevel&) { compiles = true; }

  void add_structure(const StructureSpec& structure);
  void add_method(ContactMethod method);
  void pass(double seconds);
  void push(std::size_t body, const Vec<3>& at);

  const Scenario& scenario_;
  std::vector<bool> linked_;      // by body
  std::set<std::size_t> movers_;  // that are in the world
  std::set<std::size_t> turners_;
};

// A shape whose body turns; others keep to the axes.
bool can_turn(const BodySpec& body);

}  // namespace lantern
