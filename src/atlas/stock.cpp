#include "atlas/stock.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "base/check.hpp"

namespace lantern::atlas {
namespace {

constexpr std::size_t kBlock = 16;  // kinds
constexpr int kUsedUp = std::numeric_limits<int>::max();

// By one of its bytes, the greatest first; equal ones stay in order.
void sort_by_byte(std::vector<std::uint64_t>& keys, std::vector<std::uint64_t>& other, int shift) {
  std::array<std::uint32_t, 257> at{};
  const auto byte = [&](std::uint64_t key) { return 255 - (key >> shift & 255); };
  for (const std::uint64_t key : keys) ++at[byte(key) + 1];
  for (std::size_t i = 1; i < at.size(); ++i) at[i] += at[i - 1];
  for (const std::uint64_t key : keys) other[at[byte(key)]++] = key;
  keys.swap(other);
}

}  // namespace

bool Stock::turns(TextureSize size) const {
  return holding_.hold == Holding::Hold::lying      ? size.width < size.height
         : holding_.hold == Holding::Hold::standing ? size.width > size.height
                                                    : false;
}

Stock::Stock(std::span<const TextureSize> textures, Holding holding) : holding_(holding) {
  sort(textures);
  gather();
  refill();
}

// Keys of height, width and index; only bytes that differ are sorted by.
void Stock::sort(std::span<const TextureSize> textures) {
  std::vector<std::uint64_t> keys(textures.size()), other(textures.size());
  std::uint64_t any = 0;
  for (std::size_t i = 0; i < textures.size(); ++i) {
    const bool swapped = turns(textures[i]) != holding_.columns;
    const auto [width, height] =
        swapped ? TextureSize{textures[i].height, textures[i].width} : textures[i];
    // Up to 65536 each: less by one, they have sixteen bits.
    keys[i] = static_cast<std::uint64_t>(height - 1) << 48 |
              static_cast<std::uint64_t>(width - 1) << 32 | i;
    any |= keys[i] ^ keys[0];
  }
  for (int shift = 32; shift < 64; shift += 8)
    if ((any >> shift & 255) != 0) sort_by_byte(keys, other, shift);
  order_.resize(keys.size());
  for (std::uint32_t i = 0; i < keys.size(); ++i) {
    order_[i] = static_cast<std::uint32_t>(keys[i]);
    if (i > 0 && keys[i] >> 32 == keys[i - 1] >> 32) {
      ++kinds_.back().count;
      continue;
    }
    const int width = static_cast<int>(keys[i] >> 32 & 0xffff) + 1;
    kinds_.push_back({width, static_cast<int>(keys[i] >> 48) + 1, i, 1, 0});
  }
}

void Stock::gather() {
  std::int64_t sum = 0;
  for (std::uint32_t k = 0; k < kinds_.size(); ++k) {
    Kind& kind = kinds_[k];
    if (classes_.empty() || classes_.back().height != kind.height)
      classes_.push_back({kind.height, k, k, 0, 0});
    kind.height_class = static_cast<std::uint32_t>(classes_.size() - 1);
    classes_.back().end = k + 1;
    classes_.back().all += std::int64_t{kind.width} * kind.count;
    sum += std::int64_t{kind.width} * kind.count;
  }
  mean_width_ = static_cast<int>(sum / static_cast<std::int64_t>(order_.size()));
  class_at_.resize(static_cast<std::size_t>(classes_[0].height) + 1);
  auto c = static_cast<std::uint32_t>(classes_.size());
  for (std::size_t height = 0; height < class_at_.size(); ++height) {
    if (c > 0 && classes_[c - 1].height == static_cast<int>(height)) --c;
    class_at_[height] = c;
  }
}

void Stock::refill() {
  const std::size_t blocks = (kinds_.size() + kBlock - 1) / kBlock;
  widths_.assign(blocks * kBlock, kUsedUp);
  counts_.resize(kinds_.size());
  for (std::size_t k = 0; k < kinds_.size(); ++k) {
    widths_[k] = kinds_[k].width;
    counts_[k] = kinds_[k].count;
  }
  narrowest_.resize(blocks);
  for (std::size_t b = 0; b < blocks; ++b) {
    const auto* block = &widths_[b * kBlock];
    narrowest_[b] = *std::min_element(block, block + kBlock);
  }
  for (HeightClass& c : classes_) c.left = c.all;
  lowest_class_ = static_cast<std::uint32_t>(classes_.size() - 1);
  left_ = order_.size();
}

std::uint32_t Stock::tallest(int width, int height) const {
  const std::uint32_t c = class_up_to(height);
  if (c == classes_.size()) return kNone;
  const auto fits = [&](int narrowest) { return narrowest <= width; };
  const auto first = widths_.begin() + classes_[c].first;
  std::size_t block = classes_[c].first / kBlock;
  const auto end = widths_.begin() + static_cast<std::ptrdiff_t>((block + 1) * kBlock);
  if (const auto at = std::find_if(first, end, fits); at != end)
    return static_cast<std::uint32_t>(at - widths_.begin());
  while (++block < narrowest_.size() && narrowest_[block] > width) continue;
  if (block == narrowest_.size()) return kNone;
  const auto at = std::find_if(widths_.begin() + static_cast<std::ptrdiff_t>(block * kBlock),
                               widths_.end(), fits);
  return static_cast<std::uint32_t>(at - widths_.begin());
}

// From both ends of the class, which is sorted by width.
std::uint32_t Stock::best_of_two(std::uint32_t widest, int width) const {
  std::uint32_t wide = widest, narrow = classes_[kinds_[widest].height_class].end - 1;
  std::uint32_t best = widest;
  int most = kinds_[widest].width;
  while (wide <= narrow && most < width) {
    if (counts_[wide] < 1u + (wide == narrow)) {
      ++wide;
    } else if (counts_[narrow] == 0 || kinds_[wide].width + kinds_[narrow].width > width) {
      // Either the narrow one is used up, or too wide for the wide one and all before it.
      counts_[narrow] == 0 ? --narrow : ++wide;
    } else {
      const int both = kinds_[wide].width + kinds_[narrow].width;
      if (both > most) most = both, best = wide;
      if (narrow == 0) break;
      --narrow;
    }
  }
  return best;
}

std::uint32_t Stock::take(std::uint32_t k) {
  LANTERN_CHECK(counts_[k], >, 0u);
  const Kind& kind = kinds_[k];
  classes_[kind.height_class].left -= kind.width;
  --left_;
  if (--counts_[k] == 0) {
    widths_[k] = kUsedUp;
    const auto* block = &widths_[k / kBlock * kBlock];
    narrowest_[k / kBlock] = *std::min_element(block, block + kBlock);
    while (lowest_class_ > 0 && classes_[lowest_class_].left == 0) --lowest_class_;
  }
  return order_[kind.first + kind.count - 1 - counts_[k]];
}

}  // namespace lantern::atlas
