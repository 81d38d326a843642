#include "render/damage.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

namespace lantern::render {
namespace {

constexpr std::uint64_t kOdd = 0x9e3779b97f4a7c15u;  // 2^64 / golden ratio

// Each bit of both changes about half of the bits given.
std::uint64_t stirred(std::uint64_t hash, std::uint64_t value) {
  hash = (hash ^ value) * kOdd;
  return hash ^ hash >> 29;
}

std::uint64_t hash_of(const Quad& quad) {
  const auto words = std::bit_cast<std::array<std::uint64_t, sizeof(Instance) / 8>>(quad.instance);
  auto hash = static_cast<std::uint64_t>(quad.program) + 1;
  for (const std::uint64_t word : words) hash = stirred(hash, word);
  return stirred(hash, quad.turned);
}

// May a turned quad touch pixels of `cell`? By the axes along it and across it.
bool meets(const Instance& turned, const PixelRect& cell) {
  const float along_x = turned.frame[2], along_y = turned.frame[3];
  const float width = 0.5f * static_cast<float>(cell.x1 - cell.x0);
  const float height = 0.5f * static_cast<float>(cell.y1 - cell.y0);
  const float dx = static_cast<float>(cell.x0) + width - turned.frame[0];
  const float dy = static_cast<float>(cell.y0) + height - turned.frame[1];
  const float x = std::abs(along_x), y = std::abs(along_y);
  return std::abs(dx * along_x + dy * along_y) <= 0.5f * turned.quad[2] + x * width + y * height &&
         std::abs(dy * along_x - dx * along_y) <= 0.5f * turned.quad[3] + y * width + x * height;
}

void add_level(const Quad& quad, const PixelRect& rect, BatchList& to) {
  Instance instance = quad.instance;
  instance.quad = {static_cast<float>(rect.x0), static_cast<float>(rect.y0),
                   static_cast<float>(rect.x1 - rect.x0), static_cast<float>(rect.y1 - rect.y0)};
  instance.data[3] = 1;  // level, whatever its axis
  to.add(quad.program, instance, rect);
}

}  // namespace

Damage::Damage(int width, int height)
    : width_(width), height_(height), tiles_(static_cast<std::size_t>(columns_) * rows_) {}

bool Damage::is_all() const {
  return found_.size() == 1 && found_[0] == PixelRect{0, 0, width_, height_};
}

void Damage::mark(const Quad& quad) {
  const std::uint64_t hash = hash_of(quad);
  const PixelRect& b = quad.bounds;
  for (int y = b.y0 / kTileHeight; y <= (b.y1 - 1) / kTileHeight; ++y)
    for (int x = b.x0 / kTileWidth; x <= (b.x1 - 1) / kTileWidth; ++x) {
      const PixelRect tile{x * kTileWidth, y * kTileHeight, (x + 1) * kTileWidth,
                           (y + 1) * kTileHeight};
      if (quad.turned && !meets(quad.instance, tile)) continue;
      std::uint64_t& known = tiles_[static_cast<std::size_t>(y) * columns_ + x];
      known = stirred(known, hash);
    }
}

// Tiles that differ beside each other are one rectangle, and so are equal ones below each other.
void Damage::gather() {
  found_.clear();
  std::vector<std::size_t> above, here;  // rectangles of a row of tiles
  for (int y = 0; y < rows_; ++y) {
    here.clear();
    const std::size_t row = static_cast<std::size_t>(y) * columns_;
    const auto differs = [&](int x) {
      const std::size_t i = row + static_cast<std::size_t>(x);
      return tiles_[i] != before_[i];
    };
    for (int x = 0; x < columns_; ++x) {
      if (!differs(x)) continue;
      const int first = x;
      while (x < columns_ && differs(x)) ++x;
      const PixelRect rect{first * kTileWidth, y * kTileHeight, std::min(x * kTileWidth, width_),
                           std::min((y + 1) * kTileHeight, height_)};
      const auto same = std::ranges::find_if(
          above, [&](std::size_t i) { return found_[i].x0 == rect.x0 && found_[i].x1 == rect.x1; });
      if (same != above.end()) {
        found_[*same].y1 = rect.y1;
        here.push_back(*same);
      } else {
        here.push_back(found_.size());
        found_.push_back(rect);
      }
    }
    std::swap(above, here);
  }
}

const std::vector<PixelRect>& Damage::find(std::span<const Quad> quads, std::uint64_t ground) {
  std::swap(tiles_, before_);
  tiles_.assign(before_.size(), 0);
  for (const Quad& quad : quads) mark(quad);
  const bool known = std::exchange(is_known_, true) && std::exchange(ground_, ground) == ground;
  ground_ = ground;
  std::int64_t pixels = std::int64_t{width_} * height_;
  if (known) {
    gather();
    pixels = 0;
    for (const PixelRect& rect : found_) pixels += rect.area();
  }
  constexpr double kNearlyAll = 0.8;
  if (static_cast<double>(pixels) >= kNearlyAll * width_ * height_)
    found_.assign(1, {0, 0, width_, height_});
  return found_;
}

std::optional<std::size_t> covering(std::span<const Quad> quads, const PixelRect& rect) {
  for (std::size_t i = quads.size(); i-- > 0;)
    if (quads[i].program == Program::solid && common(quads[i].bounds, rect) == rect) return i;
  return std::nullopt;
}

void add_clipped(const Quad& quad, const PixelRect& rect, BatchList& to) {
  const PixelRect part = common(quad.bounds, rect);
  if (part.empty()) return;
  if (!quad.turned) return add_level(quad, part, to);
  constexpr int kPiece = 32;  // pixels a side
  for (int y = part.y0; y < part.y1; y += kPiece)
    for (int x = part.x0; x < part.x1;) {
      PixelRect piece{x, y, x, std::min(y + kPiece, part.y1)};
      const auto goes_on = [&] {
        const int end = std::min(piece.x1 + kPiece, part.x1);
        return piece.x1 < part.x1 && meets(quad.instance, {piece.x1, y, end, piece.y1});
      };
      while (goes_on()) piece.x1 = std::min(piece.x1 + kPiece, part.x1);
      if (!piece.empty()) add_level(quad, piece, to);
      x = piece.empty() ? x + kPiece : piece.x1;
    }
}

}  // namespace lantern::render
