// Huffman codes as deflate wants them (RFC 1951, section 3.2), and bits in its order.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace lantern::render {

// The length of each symbol's code, 0 for symbols that do not occur, none above `most`. At least
// two symbols get a code, since a code of no bits cannot be written.
std::vector<std::uint8_t> code_lengths(std::span<const std::uint32_t> counts, int most);

// The canonical codes of these lengths, their bits in the order in which deflate sends them.
std::vector<std::uint32_t> codes_of(std::span<const std::uint8_t> lengths);

// Bits into bytes, least bit first.
class BitWriter {
 public:
  explicit BitWriter(std::string& to) : to_(to) {}

  // At most 32 bits at a time.
  void put(std::uint32_t bits, int count) {
    waiting_ |= std::uint64_t{bits} << waiting_count_;
    waiting_count_ += count;
    if (waiting_count_ < 32) return;
    const char four[4] = {static_cast<char>(waiting_), static_cast<char>(waiting_ >> 8),
                          static_cast<char>(waiting_ >> 16), static_cast<char>(waiting_ >> 24)};
    to_.append(four, 4);
    waiting_ >>= 32;
    waiting_count_ -= 32;
  }
  // Fills the last byte with zeros.
  void finish() {
    for (; waiting_count_ > 0; waiting_count_ -= 8, waiting_ >>= 8)
      to_ += static_cast<char>(waiting_);
    waiting_count_ = 0;
  }

 private:
  std::string& to_;
  std::uint64_t waiting_ = 0;
  int waiting_count_ = 0;
};

}  // namespace lantern::render
