// How many random cases a test tries.
#pragma once

#include <algorithm>
#include <cstdlib>

namespace lantern {

// As many as the environment's `variable` says; else the usual number, or the part 1 / `share` of
// it under the address sanitizer, where each takes ten times as long: the release build tries them
// all.
inline int how_many(const char* variable, int usual, [[maybe_unused]] int share = 4) {
  if (const char* const wanted = std::getenv(variable)) return std::atoi(wanted);
#ifdef __SANITIZE_ADDRESS__
  usual = std::max(usual / share, 1);
#endif
  return usual;
}

}  // namespace lantern
