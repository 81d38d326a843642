#include "atlas/binder.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "base/check.hpp"

namespace lantern::atlas {
namespace {

// Do they share a pixel?
bool share_pixels(const Rect& a, const Rect& b) {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

std::vector<std::size_t> layers_of(const std::vector<ScreenElement>& elements) {
  std::vector<std::size_t> layers(elements.size());
  for (std::size_t i = 0; i < elements.size(); ++i)
    for (std::size_t under = 0; under < i; ++under)
      if (share_pixels(elements[i].place, elements[under].place))
        layers[i] = std::max(layers[i], layers[under] + 1);
  return layers;
}

}  // namespace

std::vector<std::size_t> sorted_by_image(const std::vector<ScreenElement>& elements) {
  const std::vector<std::size_t> layers = layers_of(elements);
  std::vector<std::size_t> order(elements.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {},
                           [&](std::size_t i) { return std::pair(layers[i], elements[i].image); });
  return order;
}

bool Binder::bind(std::uint32_t image) {
  if (bound_ == image) return false;
  bound_ = image;
  ++bindings_;
  return true;
}

void Binder::draw() {
  LANTERN_CHECK(bound_.has_value(), ==, true);
  ++draws_;
}

}  // namespace lantern::atlas
