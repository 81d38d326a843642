// What the GPU draws: quads, each with the data of one shape, in batches of one program each, and
// the coverage masks that some of them read.
#pragma once

#include <algorithm>
#include <vector>

#include "draw/theme.hpp"

namespace lantern::render {

// A rectangle of whole pixels, hi excluded.
struct PixelRect {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  bool empty() const { return x0 >= x1 || y0 >= y1; }
  bool operator==(const PixelRect&) const = default;
  std::int64_t area() const { return empty() ? 0 : std::int64_t(x1 - x0) * (y1 - y0); }
};

// The pixels of both; empty if there are none.
inline PixelRect common(const PixelRect& a, const PixelRect& b) {
  return {std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
}

// Laid out as the vertex shader reads it: shape.vert tells what each value means.
struct Instance {
  std::array<float, 4> quad{};
  std::array<float, 4> frame{0, 0, 1, 0};
  std::array<float, 4> box{};
  std::array<std::int32_t, 4> data{};
  std::array<std::uint8_t, 4> fill{};
  std::array<std::uint8_t, 4> stroke{};
};

// One fragment shader each. All draw the same pixels where they may stand for each other: a solid
// or a mask is a box that covers everything.
enum class Program { solid, mask, box };
inline constexpr std::size_t kPrograms = 3;

// An instance and where it goes.
struct Quad {
  Program program = Program::solid;
  Instance instance;
  PixelRect bounds;     // holds every pixel that it may touch, all within the image
  bool turned = false;  // else its quad is its bounds
};

struct Batch {
  Program program = Program::solid;
  std::vector<Instance> instances;
  std::int64_t pixels = 0;  // that they touch, together
  bool erases = false;      // lets nothing through of what is below, though it is no colour
};

// Collects instances in painting order. To change the program costs the GPU's driver far more than
// to draw one more quad, so a quad joins an earlier batch of its own program whenever nothing that
// it overlaps was painted in between.
class BatchList {
 public:
  void start(int width, int height) {
    width_ = width;
    height_ = height;
    used_ = 0;
  }
  // `bounds` holds every pixel that the instance may touch.
  void add(Program program, const Instance& instance, const PixelRect& bounds) {
    const Cells cells = cells_of(bounds);
    std::size_t home = used_;
    for (std::size_t i = used_; i-- > 0;) {
      if (batches_[i].program == program) home = i;
      bool met = false;
      for (std::size_t y = 0; y < cells.size() && !met; ++y) met = (touched_[i][y] & cells[y]) != 0;
      if (met) break;
    }
    if (home == used_) {
      if (used_ == batches_.size()) {
        batches_.emplace_back();
        touched_.emplace_back();
      }
      batches_[used_].program = program;
      batches_[used_].instances.clear();
      batches_[used_].pixels = 0;
      batches_[used_].erases = false;
      touched_[used_] = {};
      ++used_;
    }
    batches_[home].instances.push_back(instance);
    batches_[home].pixels += bounds.area();
    for (std::size_t y = 0; y < cells.size(); ++y) touched_[home][y] |= cells[y];
  }

  // The first batch takes away what is there, instead of painting upon it.
  void first_erases() { batches_[0].erases = true; }

  const std::vector<Batch>& batches() const { return batches_; }
  std::size_t size() const { return used_; }  // batches in use; the rest is kept for its memory

 private:
  // The image in 64 x 32 cells: which of them a batch touches, a bit a cell.
  using Cells = std::array<std::uint64_t, 32>;

  Cells cells_of(const PixelRect& bounds) const {
    const int rows = static_cast<int>(Cells{}.size());
    const auto cell = [](int pixel, int size, int cells) {
      return std::clamp(static_cast<int>(std::int64_t(pixel) * cells / size), 0, cells - 1);
    };
    const int x0 = cell(bounds.x0, width_, 64), x1 = cell(bounds.x1 - 1, width_, 64);
    const int y0 = cell(bounds.y0, height_, rows), y1 = cell(bounds.y1 - 1, height_, rows);
    const std::uint64_t row = (~0ull >> (63 - (x1 - x0))) << x0;
    Cells cells{};
    for (int y = y0; y <= y1; ++y) cells[static_cast<std::size_t>(y)] = row;
    return cells;
  }

  int width_ = 1, height_ = 1;
  std::vector<Batch> batches_;
  std::vector<Cells> touched_;
  std::size_t used_ = 0;
};

// Coverage masks in one array of bytes, as the GPU reads them.
class MaskStore {
 public:
  // Byte 0 is 255: the mask of whatever has none.
  MaskStore() : bytes_{255} {}

  // To be called before each frame: forgets everything once the store is large. The masks of one
  // frame stay together, however large they are. True if it forgot.
  bool start_frame() {
    if (bytes_.size() <= kMostKept) return false;
    bytes_.assign(1, 255);
    ++generation_;
    return true;
  }

  // Room for a mask of so many bytes, all 0; gives its first index.
  std::int32_t add(std::size_t size) {
    const std::size_t first = bytes_.size();
    bytes_.resize(first + size);
    return static_cast<std::int32_t>(first);
  }
  std::uint8_t* at(std::int32_t index) { return bytes_.data() + index; }

  const std::vector<std::uint8_t>& bytes() const { return bytes_; }
  // Counts how often the store was emptied; in between, what was there at a frame's end never
  // changes.
  std::uint64_t generation() const { return generation_; }

 private:
  static constexpr std::size_t kMostKept = std::size_t{16} << 20;
  std::vector<std::uint8_t> bytes_;
  std::uint64_t generation_ = 0;
};

}  // namespace lantern::render
