// A wish to end that is heard in the midst of any long work: whoever runs a loop that may take long
// asks here now and then. One wish for the whole process, since it comes from outside (Ctrl-C).
#pragma once

#include <atomic>
#include <exception>

namespace lantern {

// Thrown where the wish is heard. Each object that is left behind by it is as it was before the
// call, or fit only to be destroyed; its call says which.
class Stopped : public std::exception {
 public:
  const char* what() const noexcept override { return "interrupted"; }
};

namespace detail {
inline std::atomic<bool> stop_wish{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler sets it");
}  // namespace detail

// Safe in a signal handler, and from any thread.
inline void ask_to_stop() noexcept { detail::stop_wish.store(true, std::memory_order_relaxed); }
inline bool stop_asked() noexcept { return detail::stop_wish.load(std::memory_order_relaxed); }
// For tests, which go on afterwards.
inline void forget_stop() noexcept { detail::stop_wish.store(false, std::memory_order_relaxed); }

// Throws Stopped if somebody wishes so. Costs one load: ask once for each pair, row, node, frame.
inline void stop_if_asked() {
  if (stop_asked()) [[unlikely]]
    throw Stopped();
}

}  // namespace lantern
