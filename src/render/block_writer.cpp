#include "render/block_writer.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <span>

namespace lantern::render {
namespace {

constexpr int kMostLength = 258, kEndOfBlock = 256;

// A symbol of deflate, and the bits that follow it.
struct Symbol {
  int symbol = 0, extra_bits = 0, extra = 0;
};

Symbol length_symbol(int length) {
  if (length == kMostLength) return {285, 0, 0};
  const int offset = length - 3;
  if (offset < 8) return {257 + offset, 0, 0};
  int bits = 1;  // groups of four symbols each: offsets 8 ... 15 have one bit more, 16 ... 31 two
  while (offset >= 8 << bits) ++bits;
  const int in_group = offset - (4 << bits);
  return {261 + 4 * bits + (in_group >> bits), bits, in_group & ((1 << bits) - 1)};
}

const std::array<Symbol, kMostLength + 1>& length_symbols() {
  static const std::array<Symbol, kMostLength + 1> all = [] {
    std::array<Symbol, kMostLength + 1> made{};
    for (int length = 3; length <= kMostLength; ++length)
      made[static_cast<std::size_t>(length)] = length_symbol(length);
    return made;
  }();
  return all;
}

// Two symbols to each doubling of the distance.
Symbol distance_symbol(int distance) {
  const auto offset = static_cast<std::uint32_t>(distance - 1);
  if (offset < 4) return {static_cast<int>(offset), 0, 0};
  const int bits = std::bit_width(offset) - 2;
  return {2 * bits + static_cast<int>(offset >> bits), bits,
          static_cast<int>(offset & ((1u << bits) - 1))};
}

// Of lengths of codes: runs of one length in short.
std::vector<Symbol> runs_of(const std::vector<std::uint8_t>& lengths) {
  std::vector<Symbol> runs;
  for (std::size_t i = 0; i < lengths.size();) {
    const std::uint8_t length = lengths[i];
    std::size_t end = i;
    while (end < lengths.size() && lengths[end] == length) ++end;
    int left = static_cast<int>(end - i);
    i = end;
    const auto take = [&](int symbol, int bits, int least, int most) {
      for (; left >= least; left -= std::min(left, most))
        runs.push_back({symbol, bits, std::min(left, most) - least});
    };
    if (length == 0) {
      take(18, 7, 11, 138);
      take(17, 3, 3, 10);
    } else {
      runs.push_back({length, 0, 0});
      --left;
      take(16, 2, 3, 6);
    }
    runs.insert(runs.end(), static_cast<std::size_t>(left), Symbol{length, 0, 0});
  }
  return runs;
}

template <class Code>
void put_symbol(BitWriter& bits, const Code& code, const Symbol& s) {
  const auto i = static_cast<std::size_t>(s.symbol);
  bits.put(code.codes[i] | static_cast<std::uint32_t>(s.extra) << code.lengths[i],
           code.lengths[i] + s.extra_bits);
}

}  // namespace

// The code of an alphabet.
struct BlockWriter::Code {
  std::vector<std::uint8_t> lengths;
  std::vector<std::uint32_t> codes;
  Code(std::span<const std::uint32_t> counts, int most)
      : lengths(code_lengths(counts, most)), codes(codes_of(lengths)) {}
  // Symbols up to the last that has a code.
  std::size_t used(std::size_t least) const {
    std::size_t size = lengths.size();
    while (size > least && lengths[size - 1] == 0) --size;
    return size;
  }
};
void BlockWriter::repeat(int length, int distance, int unit) {
  const int most = kMostLength / unit * unit;
  const auto symbol = static_cast<std::size_t>(distance_symbol(distance).symbol);
  for (; length > 0; length -= most) {
    const int part = std::min(length, most);
    tokens_.push_back(static_cast<std::uint32_t>(part) << 16 |
                      static_cast<std::uint32_t>(distance - 1));
    ++lengths_[static_cast<std::size_t>(length_symbols()[static_cast<std::size_t>(part)].symbol)];
    ++distances_[symbol];
  }
}
void BlockWriter::finish() {
  lengths_[kEndOfBlock] = 1;
  write_block();
  bits_.put(0, 3);
  bits_.finish();
  for (const std::uint32_t half : {0u, 0xffffu}) bits_.put(half, 16);
  bits_.finish();
}

// The lengths of all codes, themselves Huffman-coded.
void BlockWriter::write_header(const Code& length, const Code& distance) {
  const std::size_t first = length.used(257), second = distance.used(1);
  std::vector<std::uint8_t> all(length.lengths.begin(),
                                length.lengths.begin() + static_cast<std::ptrdiff_t>(first));
  all.insert(all.end(), distance.lengths.begin(),
             distance.lengths.begin() + static_cast<std::ptrdiff_t>(second));
  const std::vector<Symbol> runs = runs_of(all);
  std::array<std::uint32_t, 19> counts{};
  for (const Symbol& run : runs) ++counts[static_cast<std::size_t>(run.symbol)];
  const Code code(counts, 7);
  bits_.put(0, 1);  // not the last block
  bits_.put(2, 2);  // codes made for this block
  bits_.put(static_cast<std::uint32_t>(first - 257), 5);
  bits_.put(static_cast<std::uint32_t>(second - 1), 5);
  bits_.put(19 - 4, 4);
  for (const int i : {16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15})
    bits_.put(code.lengths[static_cast<std::size_t>(i)], 3);
  for (const Symbol& run : runs) put_symbol(bits_, code, run);
}

void BlockWriter::write_block() {
  const Code length(lengths_, 15), distance(distances_, 15);
  write_header(length, distance);
  for (const std::uint32_t token : tokens_) {
    if (token < 256) {
      bits_.put(length.codes[token], length.lengths[token]);
      continue;
    }
    put_symbol(bits_, length, length_symbols()[token >> 16]);
    put_symbol(bits_, distance, distance_symbol(static_cast<int>(token & 0xffff) + 1));
  }
  bits_.put(length.codes[kEndOfBlock], length.lengths[kEndOfBlock]);
}

}  // namespace lantern::render
