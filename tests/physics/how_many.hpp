// How many random worlds a test tries.
#pragma once

#include <algorithm>
#include <cstdlib>

namespace lantern::physics {

// As many as the environment's `variable` says; else the usual number, or a quarter of it under the
// address sanitizer, where each takes ten times as long: the release build tries them all.
inline int how_many(const char* variable, int usual) {
  if (const char* const wanted = std::getenv(variable)) return std::atoi(wanted);
#ifdef __SANITIZE_ADDRESS__
  usual = std::max(usual / 4, 1);
#endif
  return usual;
}

}  // namespace lantern::physics
