// What a step waits for, and what happened instead.
#pragma once

#include "run/engine.hpp"

namespace lantern::run {

class Waiting {
 public:
  // From now on. All three must outlive this.
  Waiting(const Wait& wait, const Scenario& scenario, Engine& engine);

  // To be asked after each world step: has it happened?
  bool is_over();
  // It has not: what has, and when; if it can be, what the same bodies did.
  std::string in_vain() const;

 private:
  struct Happened {
    bool near = false;  // to one of the bodies that are waited for
    std::string what;
    double time = 0;
  };

  bool saw_pair();
  bool saw_node();
  void note(bool near, std::string what);

  const Wait& wait_;
  const Scenario& scenario_;
  Engine& engine_;
  std::set<BodyId> bodies_, others_;
  std::vector<Happened> instead_;  // each thing once
  Engine::Members before_;         // of nodes, if it waits for one
  bool was_there_ = false;         // that node
};

}  // namespace lantern::run
