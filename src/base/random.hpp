// Seeded random numbers, equal on every machine and library: SplitMix64 (Steele, Lea, Flood 2014).
#pragma once

#include <cstdint>

namespace lantern {

class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t bits() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }

  // Uniform in [0, 1), a multiple of 2^-53.
  double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }

  // Uniform in [lo, hi); lo when both are equal.
  double between(double lo, double hi) { return lo + (hi - lo) * unit(); }

  // Uniform in {lo, ..., hi}, lo <= hi; the bias of the remainder is below 2^-32 for small ranges.
  std::int64_t whole(std::int64_t lo, std::int64_t hi) {
    const auto from = static_cast<std::uint64_t>(lo);
    const std::uint64_t range = static_cast<std::uint64_t>(hi) - from + 1;  // 0: all 64 bits
    return static_cast<std::int64_t>(from + (range == 0 ? bits() : bits() % range));
  }

 private:
  std::uint64_t state_;
};

}  // namespace lantern
