// What the search and its worker share: memory that outlives the worker.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "fuzz/sees_all.hpp"

namespace lantern::fuzz {

inline constexpr std::size_t kMostText = std::size_t{1} << 16;  // longer files are not tried

// How often one kind of finding was made.
struct Told {
  std::uint64_t kind = 0;
  std::atomic<std::uint64_t> times{0};
  std::array<char, 400> line{};
};

struct Desk {
  // Of the file that is being tried.
  std::atomic<std::uint64_t> number{0};
  std::atomic<int> stage{0};
  std::size_t size = 0;
  std::array<char, kMostText> text{};

  // Of the crash that ended the worker: places in the program, from its beginning.
  std::array<std::atomic<std::uint64_t>, 4> stack{};

  std::atomic<std::uint64_t> files{0}, good{0}, ran{0}, drawn{0}, measured{0}, stopped{0};
  std::atomic<std::uint64_t> crashes{0}, hangs{0}, broken{0}, energy{0};
  std::atomic<double> worst_energy{0}, slowest_stop{0};
  std::atomic<bool> finished{false};
  std::array<std::atomic<std::uint64_t>, 4096> used{};
  std::array<std::atomic<bool>, std::size_t{1} << 20> features{};
  std::array<Told, 200> told{};

  // Is it the first time?
  bool note(std::uint64_t feature) { return !features[feature % features.size()].exchange(true); }

  // True the first time that this kind is told.
  bool tell(std::string_view kind, std::string_view line);
};

// A desk in memory that forked processes share, there until the program ends.
Desk& shared_desk();

// Every "table.key", every choice as "table.key = choice", and every verb as "do = verb".
const std::vector<std::string>& all_uses();

}  // namespace lantern::fuzz
