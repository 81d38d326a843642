#include "render/instances.hpp"

#include <algorithm>

namespace lantern {

void BatchList::start(int width, int height) {
  width_ = width;
  height_ = height;
  used_ = 0;
}

BatchList::Cells BatchList::cells_of(const PixelRect& bounds) const {
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

void BatchList::add(Program program, const Instance& instance, const PixelRect& bounds) {
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
    touched_[used_] = {};
    ++used_;
  }
  batches_[home].instances.push_back(instance);
  for (std::size_t y = 0; y < cells.size(); ++y) touched_[home][y] |= cells[y];
}

}  // namespace lantern
