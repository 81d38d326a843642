// The parts of <cairo.h>, <cairo-pdf.h>, <cairo-ft.h> and <ft2build.h> that are used. The libraries
// are loaded when they are first asked for: no picture of Lantern's own needs them.
#pragma once

#include <map>

#include "draw/draw_list.hpp"
#include "draw/font.hpp"
#include "draw/theme.hpp"
#include "render/canvas.hpp"

namespace lantern::render {

// As <cairo.h> lays them out.
struct CairoGlyph {
  unsigned long index = 0;
  double x = 0, y = 0;
};
struct CairoCluster {
  int bytes = 0, glyphs = 0;
};
using CairoWrite = int (*)(void* closure, const unsigned char* bytes, unsigned int length);

// Result, name without "cairo_", parameters. Surfaces, contexts, faces and options are opaque,
// statuses are 0 when good.
#define LANTERN_CAIRO_FUNCTIONS(X)                                                               \
  X(const char*, version_string, ())                                                             \
  X(const char*, status_to_string, (int))                                                        \
  X(void*, image_surface_create, (int format, int width, int height))                            \
  X(void*, pdf_surface_create_for_stream, (CairoWrite, void* closure, double w, double h))       \
  X(void, pdf_surface_set_size, (void*, double width, double height))                            \
  X(void, pdf_surface_set_metadata, (void*, int what, const char* utf8))                         \
  X(void, pdf_surface_set_page_label, (void*, const char* utf8))                                 \
  X(int, pdf_surface_add_outline, (void*, int parent, const char*, const char* link, int flags)) \
  X(int, surface_status, (void*))                                                                \
  X(void, surface_finish, (void*))                                                               \
  X(int, surface_write_to_png, (void*, const char* path))                                        \
  X(void, surface_destroy, (void*))                                                              \
  X(void*, create, (void* surface))                                                              \
  X(int, status, (void*))                                                                        \
  X(void, destroy, (void*))                                                                      \
  X(void, show_page, (void*))                                                                    \
  X(void, set_source_rgba, (void*, double, double, double, double))                              \
  X(void, set_line_width, (void*, double))                                                       \
  X(void, set_line_cap, (void*, int))                                                            \
  X(void, set_line_join, (void*, int))                                                           \
  X(void, set_dash, (void*, const double*, int, double))                                         \
  X(void, new_path, (void*))                                                                     \
  X(void, move_to, (void*, double, double))                                                      \
  X(void, line_to, (void*, double, double))                                                      \
  X(void, curve_to, (void*, double, double, double, double, double, double))                     \
  X(void, arc, (void*, double x, double y, double radius, double, double))                       \
  X(void, close_path, (void*))                                                                   \
  X(void, fill, (void*))                                                                         \
  X(void, fill_preserve, (void*))                                                                \
  X(void, stroke, (void*))                                                                       \
  X(void, stroke_preserve, (void*))                                                              \
  X(void, paint, (void*))                                                                        \
  X(void*, font_options_create, ())                                                              \
  X(void, font_options_set_hint_style, (void*, int))                                             \
  X(void, font_options_set_hint_metrics, (void*, int))                                           \
  X(void, font_options_destroy, (void*))                                                         \
  X(void, set_font_options, (void*, const void*))                                                \
  X(void, set_font_face, (void*, void* face))                                                    \
  X(void, set_font_size, (void*, double))                                                        \
  X(void, glyph_path, (void*, const CairoGlyph*, int))                                           \
  X(void, show_text_glyphs,                                                                      \
    (void*, const char* utf8, int bytes, const CairoGlyph*, int, const CairoCluster*, int, int)) \
  X(int, font_face_status, (void*))                                                              \
  X(void*, ft_font_face_create_for_ft_face, (void* face, int load_flags))

struct Cairo {
#define LANTERN_CAIRO_MEMBER(result, name, parameters) result(*name) parameters = nullptr;
  LANTERN_CAIRO_FUNCTIONS(LANTERN_CAIRO_MEMBER)
#undef LANTERN_CAIRO_MEMBER

  // Throws BackendError with cairo's words unless the status is good, and std::bad_alloc where
  // cairo has found no memory.
  void require(int code) const;
};

// Throws BackendError, naming the package to install, if there is no cairo or an older one.
const Cairo& cairo();

// The bundled type as a face of cairo's, so that a document holds letters and not outlines; made
// once. Throws BackendError, naming the packages, if cairo or FreeType are missing.
void* cairo_face(Weight weight);

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

  const std::vector<PathStep>& glyph(int index, Weight weight);

  const Cairo& cairo_;
  void* context_;
  For for_;
  Canvas canvas_;
  Theme theme_{};
  const Tint* tint_ = nullptr;  // of the shape that is being drawn
  std::map<std::pair<int, Weight>, std::vector<PathStep>> glyphs_;  // outlines
};

}  // namespace lantern::render
