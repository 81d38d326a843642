// A zlib stream (RFC 1950, 1951) of drawings, written fast. Drawings are flat: most rows equal the
// row above, most others differ from it in a few places. With the PNG filter "Up" what is equal
// becomes zeros, and the only repetition looked for is that of the last pixel. So equal rows cost
// one comparison, where a general deflate hashes each of their bytes.
//
// Why not a library: a frame of 1080p with 100 shapes took stb's own deflate 142 ms, libdeflate 16
// ms (files of 14 to 20 KB) and ISA-L, which is one more package, 1.0 to 1.5 ms (50 to 80 KB). This
// does as ISA-L does: with all of drawing and writing it came to 158 to 225 frames a second, its
// files 1.5 times as large as those of libdeflate (`lantern bench frames`).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "render/image.hpp"

namespace lantern::render {

// --- Huffman codes as deflate wants them (RFC 1951, section 3.2) ---

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

// --- the whole stream ---

// The pixels of a PNG as its IDAT chunk holds them; `channels` is 3 (without alpha) or 4. Nothing
// if there are 3 and a pixel is not opaque.
std::optional<std::string> run_deflate(const Image& image, int channels);

}  // namespace lantern::render
