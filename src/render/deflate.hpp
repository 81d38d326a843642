// Bands of an image as deflate streams that can be joined: RFC 1951.
#pragma once

#include <array>
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

// Rows of a picture without gaps between them, 4 bytes a pixel as in an Image.
struct Band {
  int width = 0;
  int rows = 0;  // that are packed
  // The row above stands before them; of a picture's first band there is none.
  bool has_above = false;
  bool is_opaque = true;  // all of the rows packed
  std::vector<std::uint32_t> pixels;
};

inline constexpr int kBandRows = 32;

// A band as a part of a zlib stream: blocks of deflate that end with a whole byte.
struct PackedBand {
  std::string blocks;
  std::uint32_t adler =
      1;  // Adler-32 of the bytes packed: for each row 0, the filter "None", pixels
  std::uint64_t bytes = 0;  // that were packed
};

// `channels` is 3 (without alpha) or 4.
PackedBand pack(const Band& band, int channels);

// A zlib stream of bands, from the uppermost down.
class BandStream {
 public:
  void add(const PackedBand& band);
  std::string finish();

 private:
  std::string bytes_{"\x78\x01", 2};  // zlib, fastest
  std::uint32_t adler_ = 1;
};

// Adler-32 of bytes and `length` more behind them.
std::uint32_t joined_adler(std::uint32_t first, std::uint32_t second, std::uint64_t length);

}  // namespace lantern::render
