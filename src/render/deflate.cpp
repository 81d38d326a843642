#include "render/deflate.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <utility>

#include "base/stop.hpp"

namespace lantern::render {
namespace {

// The depth of each leaf in the tree that Huffman (1952) builds for these weights, which ascend.
// What is joined ascends, too, so that the two lightest are at the head of one list or the other.
std::vector<std::uint8_t> depths(const std::vector<std::uint64_t>& ascending) {
  const std::size_t leaves = ascending.size(), nodes = 2 * leaves - 1;
  std::vector<std::uint64_t> weights = ascending;
  weights.resize(nodes);
  std::vector<std::size_t> parent(nodes);
  std::size_t leaf = 0, joined = leaves;
  for (std::size_t made = leaves; made < nodes; ++made)
    for (int child = 0; child < 2; ++child) {
      const bool takes_leaf = leaf < leaves && (joined == made || weights[leaf] <= weights[joined]);
      const std::size_t lightest = takes_leaf ? leaf++ : joined++;
      weights[made] += weights[lightest];
      parent[lightest] = made;
    }
  std::vector<std::uint8_t> depth(nodes);
  for (std::size_t i = nodes - 1; i-- > 0;)
    depth[i] = static_cast<std::uint8_t>(depth[parent[i]] + 1);
  depth.resize(leaves);
  return depth;
}

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

void put_symbol(BitWriter& bits, const auto& code, const Symbol& s) {
  const auto i = static_cast<std::size_t>(s.symbol);
  bits.put(code.codes[i] | static_cast<std::uint32_t>(s.extra) << code.lengths[i],
           code.lengths[i] + s.extra_bits);
}

static_assert(std::endian::native == std::endian::little,
              "a pixel's first byte is its word's lowest");

constexpr std::uint32_t kModulus = 65521;  // of Adler-32

class BandPacker {
 public:
  BandPacker(const Band& band, int channels, std::string& to)
      : width_(band.width),
        channels_(channels),
        stride_(channels * band.width + 1),
        pixels_(band.pixels.data()),
        first_(band.has_above ? 1 : 0),
        rows_(band.rows + first_),
        writer_(to) {}

  std::uint32_t pack() {
    for (row_ = first_; row_ < rows_; ++row_) {
      stop_if_asked();
      at_ = pixels_ + static_cast<std::ptrdiff_t>(row_) * width_;
      has_up_ = row_ > 0 && stride_ <= kMostDistance;
      if (row_ == first_) sum_ = weighted_ = 0;
      writer_.literal(0);  // the filter "None"
      pack_row();
      end_row();
    }
    writer_.finish();
    return static_cast<std::uint32_t>(high_ << 16 | low_);
  }

 private:
  struct Match {
    int pixels = 0, distance = 0;
  };

  void pack_row() {
    for (int x = 0; x < width_;) {
      const int up = has_up_ ? same_as_above(x) : 0;
      Match best{up, stride_};
      if (up < width_ - x) improve(best, x);
      if (best.pixels > 0) {
        writer_.repeat(channels_ * best.pixels, best.distance, channels_);
      } else {
        best = {1, 0};
        for (int c = 0; c < channels_; ++c)
          writer_.literal(static_cast<std::uint8_t>(at_[x] >> (8 * c)));
      }
      if (best.pixels < kShort)
        for (int i = 0; i < best.pixels; ++i) remember(x + i);
      // The sums of a row are those of the row above but for what differs.
      if (best.distance != stride_ || row_ == first_) add_to_sums(x, x + best.pixels);
      x += best.pixels;
    }
  }

  int same_as_above(int x) const {
    const std::uint32_t* above = at_ - width_;
    int end = x;
    constexpr int kAtOnce = 32;  // so many that a compiler makes vectors of them
    for (; end + kAtOnce <= width_; end += kAtOnce) {
      std::uint32_t differs = 0;
      for (int i = 0; i < kAtOnce; ++i) differs |= at_[end + i] ^ above[end + i];
      if (differs != 0) break;
    }
    while (end < width_ && at_[end] == above[end]) ++end;
    return end - x;
  }

  // Looks for something longer than what the row above gives, which is cheapest to write.
  void improve(Match& best, int x) {
    if (x > 0 && at_[x] == at_[x - 1]) {
      int end = x;
      while (end < width_ && at_[end] == at_[x]) ++end;
      if (end - x > best.pixels) best = {end - x, channels_};
    }
    if (best.pixels >= kShort / 4) return;
    if (x + 1 < width_) {
      const Match pair = match(pairs_[hash_of_pair(x)], x);
      if (pair.pixels > std::max(1, best.pixels + (best.pixels > 0 ? 1 : 0))) best = pair;
    }
    if (best.pixels > 0) return;
    if (const Match single = match(singles_[hash_of_single(x)], x); single.pixels > 0)
      best = {1, single.distance};
  }

  // What follows the place, as far as it is what follows x.
  Match match(std::uint32_t place, int x) const {
    if (place == 0) return {};
    const int rows = row_ - static_cast<int>((place - 1) >> kColumnBits);
    const auto column = static_cast<int>((place - 1) & ((1u << kColumnBits) - 1));
    const int distance = rows * stride_ + channels_ * (x - column);
    if (distance > kMostDistance) return {};
    const std::uint32_t* from = at_ - static_cast<std::ptrdiff_t>(rows) * width_ + column;
    const int most = width_ - std::max(x, column);
    int pixels = 0;
    while (pixels < most && from[pixels] == at_[x + pixels]) ++pixels;
    return {pixels, distance};
  }

  void remember(int x) {
    const auto place = static_cast<std::uint32_t>((row_ << kColumnBits | x) + 1);
    if (x + 1 < width_) pairs_[hash_of_pair(x)] = place;
    singles_[hash_of_single(x)] = place;
  }
  std::size_t hash_of_pair(int x) const {
    return ((at_[x] * 0x9e3779b1u) ^ (at_[x + 1] * 0x85ebca6bu)) * 0xc2b2ae35u >> 20;
  }
  std::size_t hash_of_single(int x) const { return at_[x] * 0x9e3779b1u >> 22; }

  // Of a row its bytes' sum, and their sum with each as often as bytes are left from it on; both
  // grow by how these pixels differ from those above.
  void add_to_sums(int from, int to) {
    const std::uint32_t* above = row_ == first_ ? nullptr : at_ - width_;
    for (int x = from; x < to; ++x) {
      const std::uint32_t here = at_[x], there = above ? above[x] : 0;
      if (here == there) continue;
      const std::int64_t left = stride_ - 1 - std::int64_t{channels_} * x;
      for (int c = 0; c < channels_; ++c) {
        const int difference =
            static_cast<int>(here >> (8 * c) & 255) - static_cast<int>(there >> (8 * c) & 255);
        sum_ += difference;
        weighted_ += difference * (left - c);
      }
    }
  }

  void end_row() {
    high_ = (high_ + low_ * static_cast<std::uint64_t>(stride_) +
             static_cast<std::uint64_t>(weighted_)) %
            kModulus;
    low_ = (low_ + static_cast<std::uint64_t>(sum_)) % kModulus;
  }

  static constexpr int kColumnBits = 20;  // of a place, which is a row and a column, + 1
  static constexpr int kShort = 32;       // pixels: longer repetitions are of no use to later ones

  int width_, channels_, stride_;  // bytes a row
  const std::uint32_t* pixels_;
  int first_, rows_;
  BlockWriter writer_;
  int row_ = 0;                        // that is being packed,
  const std::uint32_t* at_ = nullptr;  // its pixels
  bool has_up_ = false;
  std::array<std::uint32_t, 4096> pairs_{};  // where such pixels stood last: number + 1
  std::array<std::uint32_t, 1024> singles_{};
  std::int64_t sum_ = 0, weighted_ = 0;  // of the row
  std::uint64_t low_ = 1, high_ = 0;     // the halves of Adler-32
};

}  // namespace

std::vector<std::uint8_t> code_lengths(std::span<const std::uint32_t> counts, int most) {
  std::vector<std::size_t> used;
  for (std::size_t i = 0; i < counts.size(); ++i)
    if (counts[i] > 0) used.push_back(i);
  for (std::size_t i = 0; used.size() < 2; ++i)
    if (counts[i] == 0) used.push_back(i);
  std::ranges::stable_sort(used, {}, [&](std::size_t i) { return counts[i]; });
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
  codes.reserve(lengths.size());
  for (const std::uint8_t length : lengths) {
    const std::uint32_t code = length == 0 ? 0 : next[length]++;
    std::uint32_t reversed = 0;  // Huffman codes are sent from their highest bit
    for (int i = 0; i < length; ++i) reversed |= (code >> i & 1) << (length - 1 - i);
    codes.push_back(reversed);
  }
  return codes;
}

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

PackedBand pack(const Band& band, int channels) {
  PackedBand packed;
  packed.adler = BandPacker(band, channels, packed.blocks).pack();
  packed.bytes =
      static_cast<std::uint64_t>(band.rows) *
      (1 + static_cast<std::uint64_t>(channels) * static_cast<std::uint64_t>(band.width));
  return packed;
}

std::uint32_t joined_adler(std::uint32_t first, std::uint32_t second, std::uint64_t length) {
  // Each of the further bytes counts with all bytes before it, and the initial 1 counts once.
  const std::uint64_t a = first & 0xffff, b = first >> 16, c = second & 0xffff, d = second >> 16;
  const std::uint64_t low = (a + c + kModulus - 1) % kModulus;
  const std::uint64_t high = (b + d + length % kModulus * (a + kModulus - 1)) % kModulus;
  return static_cast<std::uint32_t>(high << 16 | low);
}

void BandStream::add(const PackedBand& band) {
  bytes_ += band.blocks;
  adler_ = joined_adler(adler_, band.adler, band.bytes);
}

std::string BandStream::finish() {
  bytes_ += {3, 0};  // the last block, empty
  for (int shift = 24; shift >= 0; shift -= 8) bytes_ += static_cast<char>(adler_ >> shift & 255);
  return std::move(bytes_);
}

}  // namespace lantern::render
