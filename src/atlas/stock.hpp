// Textures that are not packed yet, of equal sizes together, where the tallest that fits is found.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "atlas/packer.hpp"

namespace lantern::atlas {

// How the textures are held: as they are, all lying, all standing. By columns, with x and y
// exchanged: whoever fills rows then fills columns.
struct Holding {
  enum class Hold : std::uint8_t { as_given, lying, standing };
  Hold hold = Hold::as_given;
  bool columns = false;
};

class Stock {
 public:
  // Textures of one size. Kinds stand in order, the tallest first, of these the widest.
  struct Kind {
    int width = 0;
    int height = 0;
    std::uint32_t first = 0;  // of its textures in `order_`
    std::uint32_t count = 0;
    std::uint32_t height_class = 0;
  };
  // Kinds of one height.
  struct HeightClass {
    int height = 0;
    std::uint32_t first = 0, end = 0;  // of its kinds
    std::int64_t all = 0;              // width of all its textures side by side
    std::int64_t left = 0;             // of those that are left
  };
  static constexpr std::uint32_t kNone = 0xffffffff;

  // At least one texture; widths and heights from 1 to 65536.
  Stock(std::span<const TextureSize> textures, Holding holding);

  void refill();
  std::size_t left() const { return left_; }
  std::uint64_t bytes() const {
    return kinds_.capacity() * sizeof(Kind) + classes_.capacity() * sizeof(HeightClass) +
           class_at_.capacity() * sizeof class_at_[0] + order_.capacity() * sizeof order_[0] +
           widths_.capacity() * sizeof widths_[0] + narrowest_.capacity() * sizeof narrowest_[0] +
           counts_.capacity() * sizeof counts_[0];
  }

  // The tallest kind that is left and fits, of these the widest; kNone if there is none.
  std::uint32_t tallest(int width, int height) const;
  // Of the kinds as high as `widest`, which is the widest of them that fits: the first of the two
  // that together fill most of `width`.
  std::uint32_t best_of_two(std::uint32_t widest, int width) const;
  // Gives the texture taken.
  std::uint32_t take(std::uint32_t kind);
  bool turns(TextureSize size) const;  // is a texture of this size held turned?

  const Kind& operator[](std::uint32_t kind) const { return kinds_[kind]; }
  int lowest() const { return classes_[lowest_class_].height; }  // that is left
  int mean_width() const { return mean_width_; }
  std::span<const HeightClass> classes() const { return classes_; }
  // The class of the greatest height up to this one; the number of classes if there is none.
  std::uint32_t class_up_to(int height) const {
    const auto at = static_cast<std::size_t>(height);
    return at < class_at_.size() ? class_at_[at] : 0;
  }

 private:
  void sort(std::span<const TextureSize> textures);
  void gather();

  Holding holding_;
  std::vector<Kind> kinds_;
  std::vector<HeightClass> classes_;
  std::vector<std::uint32_t> class_at_;  // by height
  std::vector<std::uint32_t> order_;     // textures, by kind
  std::vector<int> widths_;              // of kinds that are left, else kUsedUp; full blocks
  std::vector<int> narrowest_;           // of each block of kinds
  std::vector<std::uint32_t> counts_;    // left, of each kind
  std::size_t left_ = 0;
  int mean_width_ = 1;
  std::uint32_t lowest_class_ = 0;
};

}  // namespace lantern::atlas
