// What of a picture must be drawn anew when the next one is drawn over it. Of two frames that
// follow each other most is the same, and a quad costs what its pixels cost.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "render/instances.hpp"

namespace lantern::render {

// Knows of each tile of the image which quads were painted there and in which order: where that is
// the same, the pixels are. It keeps a hash of 64 bits of them, not the quads.
class Damage {
 public:
  // In pixels. Smaller ones leave out more of what is the same, but there are more to know.
  static constexpr int kTileWidth = 32, kTileHeight = 16;

  Damage(int width, int height);

  // Where a picture of these quads differs from that of the last call: rectangles that do not
  // overlap. `ground` stands for all else that pixels depend on. All of the image at first, after
  // forget(), with another ground, and if so much differs that drawing all costs no more.
  const std::vector<PixelRect>& find(std::span<const Quad> quads, std::uint64_t ground);

  // The picture of the last call was not finished.
  void forget() { is_known_ = false; }

  bool is_all() const;  // what find() gave last is the whole image

 private:
  void mark(const Quad& quad);
  void gather();

  int width_, height_;
  int columns_ = (width_ + kTileWidth - 1) / kTileWidth;
  int rows_ = (height_ + kTileHeight - 1) / kTileHeight;
  bool is_known_ = false;
  std::uint64_t ground_ = 0;
  std::vector<std::uint64_t> tiles_, before_;
  std::vector<PixelRect> found_;
};

// Adds what of a quad lies in `rect`. A turned one is cut into level pieces: what these hold beside
// it has no coverage.
void add_clipped(const Quad& quad, const PixelRect& rect, BatchList& to);

// The last quad that covers all of `rect`, so that nothing painted before it is seen there.
std::optional<std::size_t> covering(std::span<const Quad> quads, const PixelRect& rect);

}  // namespace lantern::render
