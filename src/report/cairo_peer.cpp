#include "report/cairo_peer.hpp"

#include <cstddef>
#include <cstdint>
#include <cstring>

#include <fmt/format.h>

#include "base/error.hpp"

namespace lantern::report {

CairoPeer::CairoPeer(int width, int height, CairoAntialias antialias)
    : width_(width), height_(height) {
  constexpr int kRgb24 = 1;
  surface_ = cairo().image_surface_create(kRgb24, width, height);
  cairo().require(cairo().surface_status(surface_));
  context_ = cairo().create(surface_);
  cairo().set_antialias(context_, static_cast<int>(antialias));
  painter_.emplace(context_, CairoPainter::For::pixels);
}

CairoPeer::~CairoPeer() {
  if (context_) cairo().destroy(context_);
  cairo().surface_destroy(surface_);
}

std::string CairoPeer::version() const { return cairo().version_string(); }

void CairoPeer::write_png(const std::filesystem::path& path) {
  const int status = cairo().surface_write_to_png(surface_, path.c_str());
  if (status != 0)
    throw IoError(
        fmt::format("cannot write '{}': {}", path.string(), cairo().status_to_string(status)));
}

void CairoPeer::read(Image& image) {
  cairo().surface_flush(surface_);
  image.width = width_;
  image.height = height_;
  image.rgba.resize(std::size_t{4} * image.width * image.height);
  const unsigned char* row = cairo().image_surface_get_data(surface_);
  const int stride = cairo().image_surface_get_stride(surface_);
  std::uint8_t* to = image.rgba.data();
  for (int y = 0; y < image.height; ++y, row += stride)
    for (int x = 0; x < image.width; ++x, to += 4) {
      std::uint32_t pixel = 0;  // 0x00rrggbb, in the machine's order of bytes
      std::memcpy(&pixel, row + std::ptrdiff_t{4} * x, sizeof pixel);
      to[0] = static_cast<std::uint8_t>(pixel >> 16);
      to[1] = static_cast<std::uint8_t>(pixel >> 8);
      to[2] = static_cast<std::uint8_t>(pixel);
      to[3] = 255;
    }
}

void CairoPeer::draw(const DrawList& list, const Theme& theme) {
  painter_->draw(list, theme, true, Canvas(list.page, width_, height_));
}

}  // namespace lantern::report
