#include "render/band_deflate.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <utility>

#include "base/stop.hpp"
#include "render/block_writer.hpp"

namespace lantern::render {
namespace {

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
    for (; end + 16 <= width_; end += 16) {
      std::uint32_t differs = 0;
      for (int i = end; i < end + 16; ++i) differs |= at_[i] ^ above[i];
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

  // What follows the place, a pixel's number + 1, as far as it is what follows x.
  Match match(std::uint32_t place, int x) const {
    if (place == 0) return {};
    const auto from = static_cast<int>(place - 1);
    const int row = from / width_, column = from % width_;
    const int distance = (row_ - row) * stride_ + channels_ * (x - column);
    if (distance > kMostDistance) return {};
    const int most = width_ - std::max(x, column);
    int pixels = 0;
    while (pixels < most && pixels_[from + pixels] == at_[x + pixels]) ++pixels;
    return {pixels, distance};
  }

  void remember(int x) {
    const auto place = static_cast<std::uint32_t>(row_ * width_ + x + 1);
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

  static constexpr int kShort = 32;  // pixels: longer repetitions are of no use to later ones

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
