// libc++ for WebAssembly has no threads. What of them the rooms name, for the one that there is.
#pragma once

#ifdef __cplusplus
#include <utility>

namespace std {

struct mutex {
  void lock() {}
  void unlock() {}
};
struct jthread {  // has ended when it is made
  template <class F, class... Args>
  explicit jthread(F&& f, Args&&... args) {
    f(std::forward<Args>(args)...);
  }
};

}  // namespace std
#endif
