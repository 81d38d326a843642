// What a source needs that is compiled once for each kind of processor, and chosen when it runs: it
// sets HWY_TARGET_INCLUDE to itself, includes this, and then Highway, which includes it again and
// again.
//
// Highway without its library: that is loaded before main() and measures a clock for milliseconds,
// whether boxes are scanned or not. All that is needed of it is which of the functions compiled for
// several kinds of processor suits this one.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <vector>

#define HWY_IS_DEBUG_BUILD 0  // what Highway asserts of itself would need the library
#ifdef __x86_64__
#define HWY_DISABLE_PCLMUL_AES  // not used here, so that a processor without them may take SSE4
#else
#define HWY_COMPILE_ONLY_STATIC  // elsewhere: what every such processor has
#endif
#include <hwy/targets.h>

// LANTERN_ALL(FUNCTION): pointers to those of the targets that suit this processor, the best first;
// LANTERN_BEST(FUNCTION): the best.
#if (HWY_TARGETS & (HWY_TARGETS - 1)) == 0
#define LANTERN_ALL(FUNCTION) \
  std::vector<decltype(&HWY_STATIC_DISPATCH(FUNCTION))> { &HWY_STATIC_DISPATCH(FUNCTION) }
#else
#define LANTERN_ALL(FUNCTION)                                          \
  lantern::spatial::suiting<decltype(&HWY_STATIC_DISPATCH(FUNCTION))>( \
      {nullptr, HWY_CHOOSE_TARGET_LIST(FUNCTION), HWY_CHOOSE_FALLBACK(FUNCTION)})

namespace lantern::spatial {

template <class Function>
std::vector<Function> suiting(std::initializer_list<Function> functions) {
  // What stands for a level beside these, such as LZCNT, every such processor has; both GCC and
  // Clang know these names.
  const bool sse4 = __builtin_cpu_supports("sse4.1") && __builtin_cpu_supports("sse4.2") &&
                    __builtin_cpu_supports("popcnt");
  const bool avx2 = sse4 && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                    __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2");
  const bool avx3 = avx2 && __builtin_cpu_supports("avx512f") &&
                    __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq") &&
                    __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512cd");
  std::int64_t targets = 0;
  if (__builtin_cpu_supports("ssse3")) targets |= HWY_SSSE3;
  if (sse4) targets |= HWY_SSE4;
  if (avx2) targets |= HWY_AVX2;
  if (avx3) targets |= HWY_AVX3;
  std::vector<Function> found;
  for (;; targets &= targets - 1) {  // the best is the lowest bit
    hwy::ChosenTarget chosen;
    chosen.Update(targets);
    const Function function = functions.begin()[chosen.GetIndex()];
    if (function != nullptr && (found.empty() || function != found.back()))
      found.push_back(function);
    if (targets == 0) return found;
  }
}

}  // namespace lantern::spatial
#endif
#define LANTERN_BEST(FUNCTION) (LANTERN_ALL(FUNCTION).front())
