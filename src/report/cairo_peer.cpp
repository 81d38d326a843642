#include "report/cairo_peer.hpp"

#include <fmt/format.h>

#include "base/error.hpp"

namespace lantern::report {

CairoPeer::CairoPeer(int width, int height) : width_(width), height_(height) {
  constexpr int kRgb24 = 1;
  surface_ = cairo().image_surface_create(kRgb24, width, height);
  cairo().require(cairo().surface_status(surface_));
  context_ = cairo().create(surface_);
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

void CairoPeer::draw(const DrawList& list, const Theme& theme) {
  painter_->draw(list, theme, true, Canvas(list.page, width_, height_));
}

}  // namespace lantern::report
