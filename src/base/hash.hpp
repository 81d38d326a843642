// FNV-1a, 64 bits, over canonical values: the same state gives the same hash on every machine.
#pragma once

#include <bit>
#include <cstdint>
#include <string_view>

namespace lantern {

class Hash {
 public:
  Hash& add(std::uint64_t value) {
    for (int byte = 0; byte < 8; ++byte) step(static_cast<std::uint8_t>(value >> (8 * byte)));
    return *this;
  }
  // Minus zero counts as zero, so that equal values hash alike.
  Hash& add(double value) { return add(std::bit_cast<std::uint64_t>(value == 0 ? 0.0 : value)); }
  Hash& add(std::string_view text) {
    for (const char c : text) step(static_cast<std::uint8_t>(c));
    return add(static_cast<std::uint64_t>(text.size()));
  }
  std::uint64_t value() const { return value_; }

 private:
  void step(std::uint8_t byte) { value_ = (value_ ^ byte) * 0x100000001b3u; }
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

}  // namespace lantern
