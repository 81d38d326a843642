// Draw lists upon a surface of cairo's, whatever it is of.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "draw/draw_list.hpp"
#include "draw/theme.hpp"
#include "render/cairo.hpp"
#include "render/canvas.hpp"
#include "render/tinted.hpp"

namespace lantern::render {

class CairoPainter {
 public:
  // Pixels: crisp lines lie on whole ones, and letters are outlines, as in Lantern's own pictures.
  // Vectors: nothing is rounded, and letters stay letters, each where it stands in a picture; this
  // needs FreeType.
  enum class For { pixels, vectors };

  // `context` is a cairo_t of the surface, which must outlive this. Throws BackendError, naming the
  // packages to install, if there is no cairo, or for vectors no FreeType.
  CairoPainter(void* context, For what);

  // The page in the middle of the canvas, over what is there. Without `paper` its ground is left
  // as it is. Throws Refused as check_draw_list() does, and Stopped.
  void draw(const DrawList& list, const Theme& theme, bool paper, const Canvas& canvas);

 private:
  void add(const RectShape& shape);
  void add(const LineShape& shape);
  void add(const PolygonShape& shape);
  void add(const TextShape& shape);
  void outline(const Box<2>& box, double radius);
  void fill_and_stroke(Role fill, const Stroke& stroke, double line_width);
  void set_color(const Paint& paint);
  void add_outlines(const TextShape& shape, const Vec<2>& at);
  void add_letters(const std::vector<const TextShape*>& parts);
  Vec<2> beginning_of(const TextShape& shape) const;
  void stroke_halo(const Paint& halo);

  // An outline's commands, parsed once a glyph: a letter and up to three points each.
  struct PathStep {
    char letter = 'Z';
    Vec<2> points[3] = {};
  };
  const std::vector<PathStep>& glyph(int index, Weight weight);

  const Cairo& cairo_;
  void* context_;
  For for_;
  Canvas canvas_;
  const Theme* theme_ = nullptr;
  const Tint* tint_ = nullptr;  // of the shape that is being drawn
  std::map<std::pair<int, Weight>, std::vector<PathStep>> glyphs_;
};

}  // namespace lantern::render
