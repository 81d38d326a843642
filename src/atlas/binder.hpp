// What a screen costs that is drawn from textures: each draw needs its image bound, and binding
// another one is what takes time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "atlas/rect.hpp"

namespace lantern::atlas {

// A rectangle of a screen, in its pixels, that shows an image.
struct ScreenElement {
  std::uint32_t image = 0;
  Rect place;
};

// Indices of the elements, sorted by image as far as that shows: an element's layer is one above
// the highest of those earlier ones that it covers a part of, and each layer is sorted by itself,
// equal images in their order. What lies over another element is still drawn after it.
std::vector<std::size_t> sorted_by_image(const std::vector<ScreenElement>& elements);

// One unit that holds one image, none at first.
class Binder {
 public:
  // Before a draw from this image; true if another one, or none, was bound.
  bool bind(std::uint32_t image);
  // One draw from the image that is bound; there must be one.
  void draw();

  std::uint64_t bindings() const { return bindings_; }
  std::uint64_t draws() const { return draws_; }
  std::optional<std::uint32_t> bound() const { return bound_; }

 private:
  std::optional<std::uint32_t> bound_;
  std::uint64_t bindings_ = 0;
  std::uint64_t draws_ = 0;
};

}  // namespace lantern::atlas
