// The same draw lists through cairo and its own PNG writer: what Lantern's speed is measured
// against.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "draw/draw_list.hpp"
#include "draw/theme.hpp"
#include "render/cairo_painter.hpp"

namespace lantern::report {

// Needs libcairo.so.2, which is loaded when asked for. Geometry, colours and text are Lantern's
// own, the text as outlines.
class CairoPeer {
 public:
  // Throws BackendError, naming the package to install, if there is no cairo.
  CairoPeer(int width, int height);
  ~CairoPeer();
  CairoPeer(const CairoPeer&) = delete;
  CairoPeer& operator=(const CairoPeer&) = delete;

  std::string version() const;
  void draw(const DrawList& list, const Theme& theme);
  // By cairo_surface_write_to_png. Throws IoError.
  void write_png(const std::filesystem::path& path);

 private:
  int width_, height_;
  void* surface_ = nullptr;
  void* context_ = nullptr;
  std::optional<CairoPainter> painter_;
};

}  // namespace lantern::report
