// What a mutated source calls instead of its operators: each place has a number, and the program
// behaves as mutant N if the environment says LANTERN_MUTANT=N. So all mutants are one program.
// Nothing here is constexpr: a place that must be constant does not compile, and is left alone.
#pragma once

#include <algorithm>
#include <array>
#include <cstdlib>
#include <initializer_list>

#include <glm/common.hpp>

namespace lantern::mutant {

inline constexpr int kMost = 1 << 14;
inline std::array<bool, kMost> reached{};  // by what ran since it was last cleared
inline const int wanted = [] {
  const char* number = std::getenv("LANTERN_MUTANT");
  return number == nullptr ? -1 : std::atoi(number);
}();

template <int N>
bool on() {
  static_assert(N < kMost);
  reached[N] = true;
  return wanted == N;
}

#define LANTERN_OPERATOR(name, op, other) \
  template <int N, class A, class B>      \
  auto name(const A& a, const B& b) {     \
    return on<N>() ? a other b : a op b;  \
  }
LANTERN_OPERATOR(less, <, <=)
LANTERN_OPERATOR(less_equal, <=, <)
LANTERN_OPERATOR(greater, >, >=)
LANTERN_OPERATOR(greater_equal, >=, >)
LANTERN_OPERATOR(equal, ==, !=)
LANTERN_OPERATOR(unequal, !=, ==)
LANTERN_OPERATOR(plus, +, -)
LANTERN_OPERATOR(minus, -, +)
LANTERN_OPERATOR(times, *, /)
LANTERN_OPERATOR(over, /, *)
#undef LANTERN_OPERATOR

// One of two terms or factors is left out.
#define LANTERN_DROPPED(name, op)                             \
  template <int N, class A, class B>                          \
  auto first_of_##name(const A& a, const B& b) {              \
    return on<N>() ? static_cast<decltype(a op b)>(a) : a op b; \
  }                                                           \
  template <int N, class A, class B>                          \
  auto last_of_##name(const A& a, const B& b) {               \
    return on<N>() ? static_cast<decltype(a op b)>(b) : a op b; \
  }
LANTERN_DROPPED(plus, +)
LANTERN_DROPPED(minus, -)
LANTERN_DROPPED(times, *)
LANTERN_DROPPED(over, /)
#undef LANTERN_DROPPED

#define LANTERN_ASSIGNMENT(name, op, other) \
  template <int N, class A, class B>        \
  A& name(A& a, const B& b) {               \
    if (on<N>()) return a other b;          \
    return a op b;                          \
  }
LANTERN_ASSIGNMENT(plus_to, +=, -=)
LANTERN_ASSIGNMENT(minus_to, -=, +=)
LANTERN_ASSIGNMENT(times_to, *=, /=)
LANTERN_ASSIGNMENT(over_to, /=, *=)
#undef LANTERN_ASSIGNMENT

// A truth turned over: `!x` becomes `x`, `true` becomes `false`, a result its contrary. `a || b` is
// !(!a && !b), so that these three, around an operator that still skips what it may, swap the two.
template <int N, class A>
bool turned(const A& a) {
  return on<N>() ? !static_cast<bool>(a) : static_cast<bool>(a);
}

template <int N, class A>
auto negative(const A& a) {
  return on<N>() ? +a : -a;
}

template <int N, class A>
bool always(const A& a) {
  return on<N>() || static_cast<bool>(a);
}
template <int N, class A>
bool never(const A& a) {
  return !on<N>() && static_cast<bool>(a);
}

template <int N, class A>
A halved(A a) {
  return on<N>() ? a / 2 : a;
}
template <int N, class A>
A doubled(A a) {
  return on<N>() ? a * 2 : a;
}

template <int N, int By, class A>
A shifted(A a) {
  return on<N>() ? static_cast<A>(a + static_cast<A>(By)) : a;
}

#define LANTERN_EXTREME(name, from, call, other)           \
  template <int N, class A>                                \
  A name(const A& a, const A& b) {                         \
    return on<N>() ? from::other(a, b) : from::call(a, b); \
  }
LANTERN_EXTREME(least, std, min, max)
LANTERN_EXTREME(most, std, max, min)
LANTERN_EXTREME(least_parts, glm, min, max)
LANTERN_EXTREME(most_parts, glm, max, min)
#undef LANTERN_EXTREME

template <int N, class A>
A least(std::initializer_list<A> of) {
  return on<N>() ? std::max(of) : std::min(of);
}
template <int N, class A>
A most(std::initializer_list<A> of) {
  return on<N>() ? std::min(of) : std::max(of);
}

}  // namespace lantern::mutant
