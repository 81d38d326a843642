// What the GPU draws: quads, each with the data of one shape, in batches of one program each.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "draw/theme.hpp"

namespace lantern {

// A rectangle of whole pixels, hi excluded.
struct PixelRect {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  bool empty() const { return x0 >= x1 || y0 >= y1; }
  std::int64_t area() const { return empty() ? 0 : std::int64_t(x1 - x0) * (y1 - y0); }
};

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

struct Batch {
  Program program = Program::solid;
  std::vector<Instance> instances;
};

// Painted opaquely, or not at all.
inline std::array<std::uint8_t, 4> paint_of(const Theme& theme, Role role) {
  if (role == Role::none) return {};
  const Color& c = theme[role];
  return {c.r, c.g, c.b, 255};
}

// Collects instances in painting order. To change the program costs the GPU's driver far more than
// to draw one more quad, so a quad joins an earlier batch of its own program whenever nothing that
// it overlaps was painted in between.
class BatchList {
 public:
  void start(int width, int height);
  // `bounds` holds every pixel that the instance may touch.
  void add(Program program, const Instance& instance, const PixelRect& bounds);

  const std::vector<Batch>& batches() const { return batches_; }
  std::size_t size() const { return used_; }  // batches in use; the rest is kept for its memory

 private:
  // The image in 64 x 32 cells: which of them a batch touches, a bit a cell.
  using Cells = std::array<std::uint64_t, 32>;
  Cells cells_of(const PixelRect& bounds) const;

  int width_ = 1, height_ = 1;
  std::vector<Batch> batches_;
  std::vector<Cells> touched_;
  std::size_t used_ = 0;
};

}  // namespace lantern
