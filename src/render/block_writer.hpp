// One block of deflate (RFC 1951): literals and repetitions, gathered, then written with codes made
// for them.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "render/huffman.hpp"

namespace lantern::render {

inline constexpr int kMostDistance = 32768;  // that a repetition reaches back, bytes

class BlockWriter {
 public:
  explicit BlockWriter(std::string& to) : bits_(to) {}

  void literal(std::uint8_t byte) {
    tokens_.push_back(byte);
    ++lengths_[byte];
  }
  // So many bytes as stood `distance` before, a multiple of `unit`, 3 or 4.
  void repeat(int length, int distance, int unit);
  // Writes the block, which is not the stream's last, and ends on a whole byte, by an empty stored
  // one.
  void finish();

 private:
  struct Code;
  void write_header(const Code& length, const Code& distance);
  void write_block();

  BitWriter bits_;
  std::vector<std::uint32_t> tokens_;  // a byte, or a length << 16 | distance - 1
  std::array<std::uint32_t, 286> lengths_{};
  std::array<std::uint32_t, 30> distances_{};
};

}  // namespace lantern::render
