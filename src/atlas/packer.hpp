// Packs many textures at once: the kD-tree of atlas.hpp, where leaves choose textures.
//
// By the taught rule a texture comes, and takes the first leaf that it fits. Here all textures are
// there, and each free leaf, in order of descent, asks for the texture that leaves least of it:
//
//   +--------------+    The tallest that fits, of these the widest. Above the leaf stay rows of one
//   | 9 | 9 |  9   |    height, which a class of equally high textures fills without any waste. Of
//   +--------------+    the last two of a row, those are taken that fill it best.
//   | 8 | 8 | 5|5|5|    Where a class is used up in the midst of a row (8), the rest is cut across
//   |   |   |------|    into two rows whose heights add up to it (5 + 3), if there are textures for
//   |   |   | 3| 3 |    both. What nobody fits is left.
//   +--------------+
//
// The same is tried by columns instead of rows, with other choices of the two rows, and with all
// textures lying or standing if they may be turned: a fixed list of trials, of which the first that
// packs all is taken, or else the one that packs the largest area. A trial is given up as soon as
// more is wasted than there is to spare, so that one which will fail costs little. Nothing is asked
// of a clock: equal input gives an equal atlas.
//
// Rows of one height come from the shelf algorithms (Coffman, Garey, Johnson, Tarjan, "Performance
// bounds for level-oriented two-dimensional packing algorithms", 1980), their exact filling from
// two-stage cutting (Gilmore, Gomory, "Multistage cutting stock problems", 1965).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace lantern::atlas {

// In pixels; the origin is the upper left corner, y points down, as in an image file.
struct Rect {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
  bool operator==(const Rect&) const = default;
};

struct TextureSize {
  int width = 0;
  int height = 0;
  bool operator==(const TextureSize&) const = default;
};

// What is done next with the leaf at hand, the first of those not done with. A cut goes on with its
// first half, and its second comes next.
struct PackStep {
  enum class Kind : std::uint8_t {
    cut_beside,  // its first half, on the left, is `value` pixels wide
    cut_below,   // its first half, above, is `value` pixels high
    store,       // it has exactly the size of texture `value`
    leave,       // no texture fits
  };
  Kind kind{};
  bool turned = false;  // of `store`: width and height are exchanged
  std::uint32_t value = 0;
};

struct Packing {
  bool complete = false;         // all textures have a place
  std::int64_t packed_area = 0;  // pixels
  std::vector<PackStep> steps;
  std::size_t trials = 0;        // made, those given up included
  std::uint64_t leaf_tests = 0;  // leaves that asked for a texture, in all trials
};

// Where a texture lies.
struct TexturePlace {
  Rect rect;  // as it lies: of a turned one, with width and height exchanged
  bool turned = false;
};

// How the textures are held: as they are, all lying, all standing. By columns, with x and y
// exchanged: whoever fills rows then fills columns.
struct Holding {
  enum class Hold : std::uint8_t { as_given, lying, standing };
  Hold hold = Hold::as_given;
  bool columns = false;
};

// Textures that are not packed yet, of equal sizes together, where the tallest that fits is found.
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

// All trials that there are, without and with turning.
std::size_t trial_count(bool turn);

class Packer {
 public:
  // Textures are named by their index. Throws Refused for a width or height that is not from 1 to
  // 65536. With `turn`, they may be turned by 90 degrees.
  explicit Packer(std::span<const TextureSize> textures, bool turn = false);

  // All of them into free leaves, which must lie apart and are filled in their order; by the first
  // `trials` of all trials, at least one. If it is not complete, it has no steps.
  Packing pack(std::span<const Rect> leaves, std::size_t trials = SIZE_MAX);
  // As many pixels of them as any of these trials packs.
  Packing pack_most(std::span<const Rect> leaves, std::size_t trials = SIZE_MAX);

  std::int64_t area() const { return area_; }  // of all textures, pixels
  std::uint64_t bytes() const;                 // that it holds

 private:
  Stock& stock(Holding holding);
  void try_one(std::size_t number, std::span<const Rect> leaves, std::int64_t spare, Packing& best);

  std::vector<TextureSize> textures_;
  bool turn_;
  std::int64_t area_ = 0;
  bool are_high_ = false;                           // rather than wide
  std::array<std::unique_ptr<Stock>, 6> stocks_{};  // made when first asked for
};

// Where each of `count` textures lies; nothing for one without place. `leaves` as given to pack.
std::vector<std::optional<TexturePlace>> places_of(const Packing& packing,
                                                   std::span<const Rect> leaves, std::size_t count);

}  // namespace lantern::atlas
