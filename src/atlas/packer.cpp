#include "atlas/packer.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "base/check.hpp"
#include "base/error.hpp"
#include "base/stop.hpp"

namespace lantern::atlas {
namespace {

constexpr int kLargestTexture = 65536;  // pixels on one side
constexpr std::size_t kSplitsTried = 48;
constexpr std::size_t kThin =
    6;  // textures of one height, on average: with fewer, rows mix heights

// Which two rows a leaf is cut into if its class is used up: none, the two most different heights,
// or the two most alike.
enum class Split : std::uint8_t { none, uneven, even };

struct Trial {
  Split split = Split::even;
  bool across = false;  // columns where the textures suggest rows, and the other way round
};

constexpr std::array<Trial, 6> kTrials{{{Split::even, false},
                                        {Split::uneven, false},
                                        {Split::none, false},
                                        {Split::even, true},
                                        {Split::uneven, true},
                                        {Split::none, true}}};
constexpr std::array<std::size_t, 6> kThinOrder{2, 5, 0, 1, 3, 4};  // in which they are tried
using Hold = Holding::Hold;
// Lying ones first: most of them have a height in common.
constexpr std::array<Hold, 3> kTurnedHolds{Hold::lying, Hold::as_given, Hold::standing};

// One trial: fills leaves with rows.
class Filling {
 public:
  Filling(Stock& stock, std::span<const TextureSize> textures, bool columns, Split split)
      : stock_(stock), textures_(textures), columns_(columns), split_(split) {}

  // False if more than `spare` pixels are wasted; the filling is then unfinished.
  bool fill(std::span<const Rect> leaves, std::int64_t spare) {
    spare_ = spare;
    for (std::size_t i = leaves.size(); i-- > 0;)
      open_.push_back(columns_ ? Leaf{leaves[i].height, leaves[i].width}
                               : Leaf{leaves[i].width, leaves[i].height});
    while (!open_.empty() && stock_.left() > 0) {
      const Leaf leaf = open_.back();
      open_.pop_back();
      if (!fill_leaf(leaf)) return false;
    }
    return true;
  }

  std::vector<PackStep> steps;
  std::int64_t packed_area = 0;
  std::uint64_t leaf_tests = 0;

 private:
  struct Leaf {
    int width, height;
  };

  bool fill_leaf(Leaf leaf) {
    while (stock_.left() > 0) {
      stop_if_asked();
      ++leaf_tests;
      const std::uint32_t found =
          leaf.height < stock_.lowest() ? Stock::kNone : stock_.tallest(leaf.width, leaf.height);
      if (found == Stock::kNone) return leave(leaf);
      const Stock::Kind& kind = stock_[found];
      const int gap = leaf.height - kind.height;
      if (gap == 0) {
        const bool ends = leaf.width < 2 * kind.width;
        if (!store(ends ? stock_.best_of_two(found, leaf.width) : found, leaf)) return true;
      } else if (gap >= stock_.lowest()) {
        const bool fills_row = stock_.classes()[kind.height_class].left >= leaf.width;
        if (gap > kind.height || fills_row)
          cut_below(leaf, kind.height);
        else
          store_above(found, leaf);
      } else if (!split(leaf)) {
        store_above(found, leaf);
      }
    }
    return true;
  }

  void step(PackStep::Kind kind, int pixels = 0) {
    steps.push_back({kind, false, static_cast<std::uint32_t>(pixels)});
  }
  // The leaf becomes the upper half, or the left one.
  void cut_below(Leaf& leaf, int height) {
    step(columns_ ? PackStep::Kind::cut_beside : PackStep::Kind::cut_below, height);
    open_.push_back({leaf.width, leaf.height - height});
    leaf.height = height;
  }
  void cut_beside(Leaf& leaf, int width) {
    step(columns_ ? PackStep::Kind::cut_below : PackStep::Kind::cut_beside, width);
    open_.push_back({leaf.width - width, leaf.height});
    leaf.width = width;
  }

  bool leave(Leaf leaf) {
    step(PackStep::Kind::leave);
    spare_ -= std::int64_t{leaf.width} * leaf.height;
    return spare_ >= 0;
  }

  // A texture as high as the leaf; what remains beside it is the leaf from now on. False if nothing
  // remains.
  bool store(std::uint32_t found, Leaf& leaf) {
    const int width = stock_[found].width;
    const bool cut = width < leaf.width;
    if (cut) cut_beside(leaf, width);
    take(found);
    if (!cut) return false;
    leaf = open_.back();
    open_.pop_back();
    return true;
  }

  void take(std::uint32_t found) {
    const std::uint32_t texture = stock_.take(found);
    const TextureSize size = textures_[texture];
    steps.push_back({PackStep::Kind::store, stock_.turns(size), texture});
    packed_area += std::int64_t{size.width} * size.height;
  }

  // The same of a texture that is not as high: the leaf is from now on what remains below it; what
  // remains beside it comes next.
  void store_above(std::uint32_t found, Leaf& leaf) {
    const auto [width, height] = std::pair(stock_[found].width, stock_[found].height);
    if (width < leaf.width) cut_beside(leaf, width);
    cut_below(leaf, height);
    take(found);
    leaf = open_.back();
    open_.pop_back();
  }

  // Two rows whose heights add up to that of the leaf, over all of its width or, if there are not
  // enough textures, over a part. The leaf becomes the upper one. False if there are no such rows.
  bool split(Leaf& leaf) {
    if (split_ == Split::none) return false;
    const auto classes = stock_.classes();
    std::int64_t width = 0;
    int height = 0;
    std::size_t tried = 0;
    for (std::uint32_t c = stock_.class_up_to(leaf.height - 1);
         c < classes.size() && 2 * classes[c].height >= leaf.height && tried < kSplitsTried; ++c) {
      if (classes[c].left == 0) continue;
      ++tried;
      const int low = leaf.height - classes[c].height;
      const std::uint32_t other = stock_.class_up_to(low);
      if (other == classes.size() || classes[other].height != low) continue;
      const std::int64_t both =
          other == c ? classes[c].left / 2 : std::min(classes[c].left, classes[other].left);
      const std::int64_t wide = std::min<std::int64_t>(both, leaf.width);
      if (wide < width || wide == 0 || (wide == width && split_ == Split::uneven)) continue;
      width = wide;
      height = classes[c].height;
      if (split_ == Split::uneven && width == leaf.width) break;
    }
    if (width < std::min(leaf.width, stock_.mean_width())) return false;
    if (width < leaf.width) cut_beside(leaf, static_cast<int>(width));
    cut_below(leaf, height);
    return true;
  }

  Stock& stock_;
  std::span<const TextureSize> textures_;
  bool columns_;
  Split split_;
  std::int64_t spare_ = 0;
  std::vector<Leaf> open_;  // the next one last
};

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

std::size_t trial_count(bool turn) { return kTrials.size() * (turn ? kTurnedHolds.size() : 1); }

Packer::Packer(std::span<const TextureSize> textures, bool turn)
    : textures_(textures.begin(), textures.end()), turn_(turn) {
  std::int64_t higher = 0;  // than wide, all together
  for (std::size_t i = 0; i < textures.size(); ++i) {
    const auto [width, height] = textures[i];
    if (std::min(width, height) < 1 || std::max(width, height) > kLargestTexture)
      throw Refused("texture {} of {} x {} pixels: both must be from 1 to {}", i, width, height,
                    kLargestTexture);
    area_ += std::int64_t{width} * height;
    higher += height - width;
  }
  are_high_ = higher > 0;
}

Stock& Packer::stock(Holding holding) {
  auto& stock = stocks_[2 * static_cast<std::size_t>(holding.hold) + holding.columns];
  if (!stock) stock = std::make_unique<Stock>(textures_, holding);
  return *stock;
}

std::uint64_t Packer::bytes() const {
  std::uint64_t sum = textures_.capacity() * sizeof(TextureSize);
  for (const auto& stock : stocks_)
    if (stock) sum += stock->bytes();
  return sum;
}

void Packer::try_one(std::size_t number, std::span<const Rect> leaves, std::int64_t spare,
                     Packing& best) {
  const Hold hold = turn_ ? kTurnedHolds[number / kTrials.size()] : Hold::as_given;
  const bool columns = hold == Hold::standing || (hold == Hold::as_given && are_high_);
  const bool thin = kThin * stock({hold, columns}).classes().size() > textures_.size();
  const std::size_t place = number % kTrials.size();
  const Trial& trial = kTrials[thin ? kThinOrder[place] : place];
  const Holding holding{hold, columns != trial.across};
  Stock& textures = stock(holding);
  textures.refill();
  Filling filling(textures, textures_, holding.columns, trial.split);
  const bool ended = filling.fill(leaves, spare);
  ++best.trials;
  best.leaf_tests += filling.leaf_tests;
  if (!ended || filling.packed_area <= best.packed_area) return;
  best.packed_area = filling.packed_area;
  best.steps = std::move(filling.steps);
  best.complete = textures.left() == 0;
}

Packing Packer::pack(std::span<const Rect> leaves, std::size_t trials) {
  Packing best;
  best.complete = textures_.empty();
  std::int64_t room = 0;
  for (const Rect& leaf : leaves) room += std::int64_t{leaf.width} * leaf.height;
  const std::size_t end = std::clamp<std::size_t>(trials, 1, trial_count(turn_));
  // What wastes more than this will not pack them all.
  for (std::size_t i = 0; i < end && area_ <= room && !best.complete; ++i)
    try_one(i, leaves, room - area_, best);
  return best;
}

Packing Packer::pack_most(std::span<const Rect> leaves, std::size_t trials) {
  Packing best = pack(leaves, trials);
  const std::size_t end = std::clamp<std::size_t>(trials, 1, trial_count(turn_));
  for (std::size_t i = 0; i < end && !best.complete; ++i)
    try_one(i, leaves, std::numeric_limits<std::int64_t>::max(), best);
  return best;
}

std::vector<std::optional<TexturePlace>> places_of(const Packing& packing,
                                                   std::span<const Rect> leaves,
                                                   std::size_t count) {
  std::vector<std::optional<TexturePlace>> places(count);
  std::vector<Rect> open(leaves.rbegin(), leaves.rend());
  for (const PackStep& step : packing.steps) {
    const auto [x, y, width, height] = open.back();
    const int value = static_cast<int>(step.value);
    if (step.kind == PackStep::Kind::cut_beside) {
      open.back() = {x + value, y, width - value, height};
      open.push_back({x, y, value, height});
    } else if (step.kind == PackStep::Kind::cut_below) {
      open.back() = {x, y + value, width, height - value};
      open.push_back({x, y, width, value});
    } else {
      if (step.kind == PackStep::Kind::store)
        places[step.value] = TexturePlace{open.back(), step.turned};
      open.pop_back();
    }
  }
  return places;
}

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
