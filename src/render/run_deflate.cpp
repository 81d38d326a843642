#include "render/run_deflate.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <functional>
#include <queue>
#include <utility>
#include <vector>

#include "base/stop.hpp"

namespace lantern::render {
namespace {

// The depth of each leaf in the tree that Huffman (1952) builds for these weights.
std::vector<std::uint8_t> depths(const std::vector<std::uint64_t>& weights) {
  const std::size_t leaves = weights.size();
  using Entry = std::pair<std::uint64_t, std::size_t>;  // weight, node: equal weights by number
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  for (std::size_t i = 0; i < leaves; ++i) open.push({weights[i], i});
  std::vector<std::size_t> parent(2 * leaves - 1);
  for (std::size_t made = leaves; made < parent.size(); ++made) {
    const Entry a = open.top();
    open.pop();
    const Entry b = open.top();
    open.pop();
    parent[a.second] = parent[b.second] = made;
    open.push({a.first + b.first, made});
  }
  std::vector<std::uint8_t> depth(parent.size());
  for (std::size_t i = parent.size() - 1; i-- > 0;)
    depth[i] = static_cast<std::uint8_t>(depth[parent[i]] + 1);
  depth.resize(leaves);
  return depth;
}

static_assert(std::endian::native == std::endian::little, "pixels are read as little-endian words");

constexpr std::uint32_t kModulus = 65521;  // of Adler-32
constexpr int kMostLength = 258, kEndOfBlock = 256, kSymbols = 286;
constexpr std::size_t kBlock = std::size_t{1} << 18;  // tokens that share one Huffman code

// Deflate's symbol for a length of 3 ... 258, and the bits that follow it.
struct LengthSymbol {
  int symbol = 0, extra_bits = 0, extra = 0;
};
LengthSymbol length_symbol(int length) {
  if (length == kMostLength) return {285, 0, 0};
  const int offset = length - 3;
  if (offset < 8) return {257 + offset, 0, 0};
  int bits = 1;  // groups of four symbols each: offsets 8 ... 15 have one bit more, 16 ... 31 two
  while (offset >= 8 << bits) ++bits;
  const int in_group = offset - (4 << bits);
  return {261 + 4 * bits + (in_group >> bits), bits, in_group & ((1 << bits) - 1)};
}

// A token is a byte, or 256 + the length of a repetition of the last pixel.
class Deflater {
 public:
  Deflater(int channels, std::string& to) : channels_(channels), bits_(to) {
    tokens_.reserve(kBlock + 8192);
  }

  void byte(std::uint8_t b) {
    push(b);
    low_ += b;
    high_ += low_;
  }
  // The last pixel again; it consisted of these bytes.
  void repeat(const std::uint8_t* pixel, int pixels) {
    if (pixels == 0) return;
    for (int left = pixels * channels_; left > 0;) {
      const int most = kMostLength / channels_ * channels_;
      const int length = std::min(left, most);
      push(static_cast<std::uint16_t>(256 + length));
      left -= length;
    }
    if (std::all_of(pixel, pixel + channels_, [](std::uint8_t b) { return b == 0; })) {
      high_ += low_ * static_cast<std::uint64_t>(pixels * channels_);
      return;
    }
    for (int i = 0; i < pixels; ++i)
      for (int c = 0; c < channels_; ++c) high_ += low_ += pixel[c];
  }
  // Within a row the sums of the checksum stay far below 2^64.
  void end_row() {
    low_ %= kModulus;
    high_ %= kModulus;
    if (tokens_.size() >= kBlock) write_block(false);
  }
  std::uint32_t finish() {
    write_block(true);
    bits_.finish();
    return static_cast<std::uint32_t>(high_ << 16 | low_);
  }

 private:
  void push(std::uint16_t token) {
    tokens_.push_back(token);
    ++counts_[token];
  }
  // The lengths of all codes, themselves Huffman-coded. Deflate's codes for runs of lengths are
  // left out: they would save some hundred bytes a block.
  void write_header(const std::vector<std::uint8_t>& lengths, bool last) {
    const int distance_symbol = channels_ - 1;  // of distance 3 or 4
    std::vector<std::uint8_t> all = lengths;
    all.resize(all.size() + static_cast<std::size_t>(distance_symbol));
    all.push_back(1);
    std::array<std::uint32_t, 19> counts{};
    for (const std::uint8_t length : all) ++counts[length];
    const std::vector<std::uint8_t> sizes = code_lengths(counts, 7);
    const std::vector<std::uint32_t> codes = codes_of(sizes);
    bits_.put(last ? 1 : 0, 1);
    bits_.put(2, 2);  // codes made for this block
    bits_.put(kSymbols - 257, 5);
    bits_.put(static_cast<std::uint32_t>(distance_symbol), 5);
    bits_.put(19 - 4, 4);
    for (const int i : {16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15})
      bits_.put(sizes[static_cast<std::size_t>(i)], 3);
    for (const std::uint8_t length : all) bits_.put(codes[length], sizes[length]);
  }

  void write_block(bool last) {
    std::array<std::uint32_t, kSymbols> counts{};
    std::copy_n(counts_.begin(), 256, counts.begin());
    counts[kEndOfBlock] = 1;
    for (int length = 3; length <= kMostLength; ++length)
      counts[static_cast<std::size_t>(length_symbol(length).symbol)] += counts_[256 + length];
    const std::vector<std::uint8_t> lengths = code_lengths(counts, 15);
    const std::vector<std::uint32_t> codes = codes_of(lengths);
    write_header(lengths, last);

    // What each token sends: its code, and for a repetition the extra bits of its length and one
    // bit, 0, for the only distance.
    struct Sent {
      std::uint32_t bits = 0;
      int count = 0;
    };
    std::array<Sent, 256 + kMostLength + 1> sent{};
    for (std::size_t b = 0; b < 256; ++b) sent[b] = {codes[b], lengths[b]};
    for (int length = 3; length <= kMostLength; ++length) {
      const LengthSymbol s = length_symbol(length);
      const auto symbol = static_cast<std::size_t>(s.symbol);
      sent[256 + length] = {codes[symbol] | static_cast<std::uint32_t>(s.extra) << lengths[symbol],
                            lengths[symbol] + s.extra_bits + 1};
    }
    for (const std::uint16_t token : tokens_) bits_.put(sent[token].bits, sent[token].count);
    bits_.put(codes[kEndOfBlock], lengths[kEndOfBlock]);
    tokens_.clear();
    counts_ = {};
  }

  int channels_;
  BitWriter bits_;
  std::vector<std::uint16_t> tokens_;
  std::array<std::uint32_t, 256 + kMostLength + 1> counts_{};
  std::uint64_t low_ = 1, high_ = 0;  // the halves of Adler-32
};

// What one row is after the filter: each pixel less the one above it, byte by byte. The first byte
// of a pixel is the lowest.
class Row {
 public:
  Row(const std::uint8_t* row, const std::uint8_t* above, int width)
      : row_(row), above_(above), width_(width) {}

  std::uint32_t difference(int x) const {
    std::uint32_t a = 0, b = 0;
    std::memcpy(&a, row_ + 4 * x, 4);
    std::memcpy(&b, above_ + 4 * x, 4);
    // All four bytes at once; the highest bit of each is kept from borrowing.
    constexpr std::uint32_t kHigh = 0x80808080u;
    return ((a | kHigh) - (b & ~kHigh)) ^ ((a ^ ~b) & kHigh);
  }
  // The first pixel after x whose difference is not `d`.
  int end_of_run(int x, std::uint32_t d) const {
    ++x;
    if (d == 0)
      while (x + 16 <= width_ && std::memcmp(row_ + 4 * x, above_ + 4 * x, 64) == 0) x += 16;
    while (x < width_ && difference(x) == d) ++x;
    return x;
  }

 private:
  const std::uint8_t* row_;
  const std::uint8_t* above_;
  int width_;
};

}  // namespace

std::vector<std::uint8_t> code_lengths(std::span<const std::uint32_t> counts, int most) {
  std::vector<std::size_t> used;
  for (std::size_t i = 0; i < counts.size(); ++i)
    if (counts[i] > 0) used.push_back(i);
  for (std::size_t i = 0; used.size() < 2; ++i)
    if (counts[i] == 0) used.push_back(i);
  std::vector<std::uint64_t> weights;
  for (const std::size_t i : used) weights.push_back(std::max<std::uint64_t>(counts[i], 1));
  std::vector<std::uint8_t> depth = depths(weights);
  // Flatter weights make a flatter tree: little is lost, since what is rare counts for little.
  while (*std::ranges::max_element(depth) > most) {
    for (std::uint64_t& w : weights) w = w / 2 + 1;
    depth = depths(weights);
  }
  std::vector<std::uint8_t> lengths(counts.size());
  for (std::size_t i = 0; i < used.size(); ++i) lengths[used[i]] = depth[i];
  return lengths;
}

std::vector<std::uint32_t> codes_of(std::span<const std::uint8_t> lengths) {
  constexpr int kMostBits = 15;
  std::uint32_t count[kMostBits + 1] = {}, next[kMostBits + 1] = {};
  for (const std::uint8_t length : lengths) ++count[length];
  count[0] = 0;
  for (int bits = 1; bits <= kMostBits; ++bits)
    next[bits] = (next[bits - 1] + count[bits - 1]) << 1;
  std::vector<std::uint32_t> codes;
  for (const std::uint8_t length : lengths) {
    const std::uint32_t code = length == 0 ? 0 : next[length]++;
    std::uint32_t reversed = 0;  // Huffman codes are sent from their highest bit
    for (int i = 0; i < length; ++i) reversed |= (code >> i & 1) << (length - 1 - i);
    codes.push_back(reversed);
  }
  return codes;
}

std::optional<std::string> run_deflate(const Image& image, int channels) {
  std::string stream("\x78\x01", 2);  // zlib, fastest
  Deflater deflater(channels, stream);
  const std::size_t stride = std::size_t{4} * image.width;
  // Above the first row PNG sees zeros; where alpha is left out, it is as opaque as all others.
  std::vector<std::uint8_t> zeros(stride);
  if (channels == 3)
    for (std::size_t i = 3; i < stride; i += 4) zeros[i] = 255;
  for (int y = 0; y < image.height; ++y) {
    stop_if_asked();
    const std::uint8_t* row = image.rgba.data() + stride * y;
    const Row filtered(row, y == 0 ? zeros.data() : row - stride, image.width);
    deflater.byte(2);  // the filter "Up"
    for (int x = 0; x < image.width;) {
      const std::uint32_t d = filtered.difference(x);
      if (channels == 3 && d >> 24 != 0) return std::nullopt;
      std::array<std::uint8_t, 4> pixel{};
      std::memcpy(pixel.data(), &d, 4);
      for (int c = 0; c < channels; ++c) deflater.byte(pixel[static_cast<std::size_t>(c)]);
      const int end = filtered.end_of_run(x, d);
      deflater.repeat(pixel.data(), end - x - 1);
      x = end;
    }
    deflater.end_row();
  }
  const std::uint32_t checksum = deflater.finish();
  for (int shift = 24; shift >= 0; shift -= 8) stream += static_cast<char>(checksum >> shift & 255);
  return stream;
}

}  // namespace lantern::render
