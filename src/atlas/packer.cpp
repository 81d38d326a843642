#include "atlas/packer.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "atlas/stock.hpp"
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
constexpr std::array<Trial, 6> kThinTrials{{{Split::none, false},
                                            {Split::none, true},
                                            {Split::even, false},
                                            {Split::uneven, false},
                                            {Split::even, true},
                                            {Split::uneven, true}}};
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

}  // namespace

std::size_t trial_count(bool turn) { return kTrials.size() * (turn ? kTurnedHolds.size() : 1); }

Packer::Packer(std::span<const TextureSize> textures, bool turn)
    : textures_(textures.begin(), textures.end()), turn_(turn) {
  std::int64_t higher = 0;  // than wide, all together
  for (std::size_t i = 0; i < textures.size(); ++i) {
    const auto [width, height] = textures[i];
    if (std::min(width, height) < 1 || std::max(width, height) > kLargestTexture)
      throw Refused(fmt::format("texture {} of {} x {} pixels: both must be from 1 to {}", i, width,
                                height, kLargestTexture));
    area_ += std::int64_t{width} * height;
    higher += height - width;
  }
  are_high_ = higher > 0;
}

Packer::~Packer() = default;
Packer::Packer(Packer&&) noexcept = default;
Packer& Packer::operator=(Packer&&) noexcept = default;

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

bool Packer::try_one(std::size_t number, std::span<const Rect> leaves, std::int64_t spare,
                     Packing& best) {
  const Hold hold = turn_ ? kTurnedHolds[number / kTrials.size()] : Hold::as_given;
  const bool columns = hold == Hold::standing || (hold == Hold::as_given && are_high_);
  const bool thin = kThin * stock({hold, columns}).classes().size() > textures_.size();
  const Trial& trial = (thin ? kThinTrials : kTrials)[number % kTrials.size()];
  const Holding holding{hold, columns != trial.across};
  Stock& textures = stock(holding);
  textures.refill();
  Filling filling(textures, textures_, holding.columns, trial.split);
  const bool ended = filling.fill(leaves, spare);
  ++best.trials;
  best.leaf_tests += filling.leaf_tests;
  if (!ended || filling.packed_area <= best.packed_area) return false;
  best.packed_area = filling.packed_area;
  best.steps = std::move(filling.steps);
  best.complete = textures.left() == 0;
  return best.complete;
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
    Rect& leaf = open.back();
    const int value = static_cast<int>(step.value);
    switch (step.kind) {
      case PackStep::Kind::cut_beside: {
        const Rect first{leaf.x, leaf.y, value, leaf.height};
        leaf.x += value, leaf.width -= value;
        open.push_back(first);
        break;
      }
      case PackStep::Kind::cut_below: {
        const Rect first{leaf.x, leaf.y, leaf.width, value};
        leaf.y += value, leaf.height -= value;
        open.push_back(first);
        break;
      }
      case PackStep::Kind::store:
        places[step.value] = TexturePlace{leaf, step.turned};
        open.pop_back();
        break;
      case PackStep::Kind::leave:
        open.pop_back();
        break;
    }
  }
  return places;
}

}  // namespace lantern::atlas
