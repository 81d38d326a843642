// What mutants of the engine are judged by. Two things on standard output, a line each:
//
//   mutated_stress worlds FIRST COUNT   of each random world its number and a hash of its motion
//   mutated_stress stress [CASE...]     of each case its name, 1 if it is good, its processor time;
//                                       until_one_fails instead of stress: and no more after that
//
// and then "reached" with the numbers of the mutants that were reached.
#include <bit>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include <fmt/format.h>

#include "base/clock.hpp"
#include "measure/stress.hpp"
#include "physics/wild_world.hpp"

#if __has_include("base/mutant.hpp")
#include "base/mutant.hpp"
#endif

namespace lantern {
namespace {

void tell(const std::string& line) {
  std::fputs((line + "\n").c_str(), stdout);
  std::fflush(stdout);
}

// Of every body's state after every step; of what was refused, that it was.
template <int D>
std::uint64_t motion(std::uint64_t number, physics::ContactMethod method) {
  constexpr std::uint64_t kSeed = 20'000;  // no world of any test
  std::uint64_t hash = 0;
  const auto add = [&](std::uint64_t bits) { hash = (hash ^ bits) * 0x100000001b3u + 1; };
  try {
    physics::WildWorld<D> wild(kSeed, number, method);
    for (int i = 0; i < wild.steps(); ++i) {
      wild.world().step(wild.seconds());
      add(wild.world().hash());
    }
  } catch (const std::exception&) {
    add(1);
  }
  return hash;
}

void run_worlds(std::uint64_t first, std::uint64_t count) {
  using enum physics::ContactMethod;
  constexpr std::array kMethods = {none, impulse, soft, direct, lecture};
  for (std::uint64_t number = first; number < first + count; ++number) {
    const auto method = kMethods[number / 2 % kMethods.size()];
    const std::uint64_t hash = number % 2 == 0 ? motion<2>(number, method) : motion<3>(number, method);
    tell(fmt::format("{} {:016x}", number, hash));
  }
}

// Those named, in that order; without names all that are not slow.
void run_stress(std::span<char* const> names, bool until_one_fails) {
  std::vector<measure::StressCase> cases;
  for (const measure::StressCase& one : measure::stress_cases())
    if (names.empty() && !one.slow) cases.push_back(one);
  for (const std::string_view name : names)
    std::ranges::copy_if(measure::stress_cases(), std::back_inserter(cases),
                         [&](const auto& one) { return one.name == name; });
  for (const measure::StressCase& one : cases) {
    tell(fmt::format("begins {}", one.name));
    const CpuStopwatch watch;
    const measure::StressResult result = measure::run_case(one).result;
    tell(fmt::format("{} {} {:.3f}", one.name, int{result.good}, watch.seconds()));
    if (until_one_fails && !result.good) return;
  }
}

}  // namespace
}  // namespace lantern

int main(int count, char** words) {
  const std::span<char*> given(words + 1, static_cast<std::size_t>(count - 1));
  if (given.size() == 3 && std::string(given[0]) == "worlds")
    lantern::run_worlds(std::strtoull(given[1], nullptr, 10), std::strtoull(given[2], nullptr, 10));
  else if (!given.empty() && std::string(given[0]) == "stress")
    lantern::run_stress(given.subspan(1), false);
  else if (!given.empty() && std::string(given[0]) == "until_one_fails")
    lantern::run_stress(given.subspan(1), true);
  else
    return 2;
#if __has_include("base/mutant.hpp")
  std::string reached = "reached";
  for (int i = 0; i < lantern::mutant::kMost; ++i)
    if (lantern::mutant::reached[static_cast<std::size_t>(i)]) reached += fmt::format(" {}", i);
  lantern::tell(reached);
#endif
}
