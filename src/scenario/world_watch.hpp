// Whoever looks on while a world moves, whichever its dimension.
#pragma once

#include "scenario/players.hpp"

namespace lantern {

class WorldWatch {
 public:
  virtual ~WorldWatch() = default;
  virtual void see_world(const Players<2>& players) = 0;
  virtual void see_world(const Players<3>& players) = 0;
};

}  // namespace lantern
