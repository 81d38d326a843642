// Passes for the lab until it is asked which program it was built for.
#include "app/lab.hpp"

extern "C" const lantern::app::Lab* lantern_lab() {
  static const lantern::app::Lab lab{"0123456789abcdef", nullptr, nullptr, nullptr, nullptr};
  return &lab;
}
