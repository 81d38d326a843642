// Work in so many parts at the same time, for sums that are the same however many there are.
#pragma once

#include <exception>
#include <thread>
#include <vector>

namespace lantern {

// f(0), ..., f(parts - 1), the first on this thread, the others on threads of their own; returns
// when all have ended. What one of them throws is thrown again, of several that of the first part.
// With one part nothing is started.
template <class F>
void in_parallel(unsigned parts, F&& f) {
  if (parts <= 1) {
    f(0u);
    return;
  }
  std::vector<std::exception_ptr> errors(parts);
  const auto guarded = [&](unsigned part) {
    try {
      f(part);
    } catch (...) {
      errors[part] = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> others;
    for (unsigned part = 1; part < parts; ++part) others.emplace_back(guarded, part);
    guarded(0);
  }
  for (const std::exception_ptr& error : errors)
    if (error) std::rethrow_exception(error);
}

}  // namespace lantern
