// The same draw lists through cairo and its own PNG writer: what Lantern's speed is measured
// against.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "draw/draw_list.hpp"
#include "draw/theme.hpp"
#include "render/canvas.hpp"
#include "render/image.hpp"

namespace lantern::report {

struct CairoFunctions;

// Its own choices of antialiasing, as <cairo.h> numbers them.
enum class CairoAntialias { standard = 0, none = 1, fast = 4, best = 6 };

// Needs libcairo.so.2, which is loaded when asked for. Geometry, colours and text are Lantern's
// own, the text as outlines.
class CairoPeer {
 public:
  // Throws BackendError, naming the package to install, if there is no cairo.
  CairoPeer(int width, int height, CairoAntialias antialias = CairoAntialias::standard);
  ~CairoPeer();

  std::string version() const;
  void draw(const DrawList& list, const Theme& theme);
  // The picture as pixels; `image` is overwritten, its memory reused.
  void read(Image& image);
  // By cairo_surface_write_to_png. Throws IoError.
  void write_png(const std::filesystem::path& path);

 private:
  void add(const RectShape& shape);
  void add(const LineShape& shape);
  void add(const PolygonShape& shape);
  void add(const TextShape& shape);
  void outline(const Box<2>& box, double radius);
  void paint(Role fill, const Stroke& stroke, double line_width);
  void set_color(Role role);
  void letters(const TextShape& shape, const Vec<2>& at);

  // An outline's commands, parsed once a glyph: a letter and up to three points each.
  struct PathStep {
    char letter = 'Z';
    Vec<2> points[3] = {};
  };
  const std::vector<PathStep>& glyph(int index, Weight weight);

  std::unique_ptr<CairoFunctions> cairo_;
  void* surface_ = nullptr;
  void* context_ = nullptr;
  Canvas canvas_;
  const Theme* theme_ = nullptr;
  std::map<std::pair<int, Weight>, std::vector<PathStep>> glyphs_;
};

}  // namespace lantern::report
