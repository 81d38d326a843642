// The marks that a world's picture may carry, for the legend: each has one meaning everywhere.
#pragma once

#include <cstdint>

namespace lantern::draw {

// In the order of the legend.
enum class MarkKind : std::uint8_t {
  lit,
  passed,
  not_made,
  sleeping_cell,
  static_body,
  sleeping_body,
  ruled_out,
  pair,
  meeting,
  contact,
  velocity,
  box,
  ray,
  hit,
  view,
  region,
  spring,
  rod,
  pin,
  count_,
};

inline constexpr auto kMarkKinds = static_cast<unsigned>(MarkKind::count_);

// Those that are on a picture.
class MarkSet {
 public:
  void add(MarkKind kind) { bits_ |= std::uint64_t{1} << static_cast<unsigned>(kind); }
  bool has(MarkKind kind) const { return (bits_ >> static_cast<unsigned>(kind) & 1u) != 0; }
  bool empty() const { return bits_ == 0; }
  bool operator==(const MarkSet&) const = default;

 private:
  std::uint64_t bits_ = 0;
};

}  // namespace lantern::draw
