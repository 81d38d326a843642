#include "render/cairo_painter.hpp"

#include <new>
#include <variant>

#include <fmt/format.h>

#include "base/child.hpp"
#include "base/error.hpp"
#include "base/printable.hpp"
#include "base/stop.hpp"

namespace lantern::render {
namespace {

// The functions of a library one by one; the first that is missing is told.
class Functions {
 public:
  Functions(const char* name, const char* file) : name_(name), library_({file}) {
    if (!library_.loaded()) refuse(library_.problem());
  }
  void take(auto& function, const char* name) const {
    if (!library_.find(function, name)) refuse(fmt::format("{} has no {}", library_.name(), name));
  }

 private:
  // Cairo needs FreeType for its own sake, too: both are named, whichever is broken.
  [[noreturn]] void refuse(const std::string& why) const {
    throw BackendError("no {}: {}; install the packages libcairo2 and libfreetype6", name_, why);
  }
  const char* name_;
  Library library_;
};

Cairo loaded_cairo() {
  const Functions library("cairo", "libcairo.so.2");
  Cairo functions;
#define LANTERN_CAIRO_LOAD(result, name, parameters) library.take(functions.name, "cairo_" #name);
  LANTERN_CAIRO_FUNCTIONS(LANTERN_CAIRO_LOAD)
#undef LANTERN_CAIRO_LOAD
  return functions;
}

// One a weight. They stay until the program ends: cairo may keep what it has made of a face longer
// than anybody here can tell.
std::array<void*, kWeights.size()> loaded_faces() {
  const Functions library("FreeType", "libfreetype.so.6");
  int (*start)(void** library) = nullptr;
  int (*open)(void* library, const void* bytes, long size, long index, void** face) = nullptr;
  library.take(start, "FT_Init_FreeType");
  library.take(open, "FT_New_Memory_Face");
  void* free_type = nullptr;
  if (const int error = start(&free_type); error != 0)
    throw BackendError("FreeType cannot start: error {}", error);
  std::array<void*, kWeights.size()> faces{};
  for (const Weight weight : kWeights) {
    constexpr int kNoHinting = 2;  // FT_LOAD_NO_HINTING
    const std::string_view bytes = font_file(weight);
    void* face = nullptr;
    if (const int error = open(free_type, bytes.data(), static_cast<long>(bytes.size()), 0, &face);
        error != 0)
      throw BackendError("FreeType cannot read the bundled type: error {}", error);
    void*& made = faces[static_cast<std::size_t>(weight)];
    made = cairo().ft_font_face_create_for_ft_face(face, kNoHinting);
    cairo().require(cairo().font_face_status(made));
  }
  return faces;
}

constexpr int kButtCap = 0, kRoundCap = 1, kSquareCap = 2, kMiterJoin = 0, kRoundJoin = 1;
constexpr double kQuarterTurn = 1.5707963267948966;

// Letters are as wide as they are drawn, not as a screen would have them.
void turn_hinting_off(const Cairo& cairo, void* context) {
  constexpr int kNoHints = 1, kNoHintedMetrics = 1;
  void* options = cairo.font_options_create();
  cairo.font_options_set_hint_style(options, kNoHints);
  cairo.font_options_set_hint_metrics(options, kNoHintedMetrics);
  cairo.set_font_options(context, options);
  cairo.font_options_destroy(options);
}

// How many shapes from this one on are the digits of one number, the last digit first, each in a
// cell of its own.
std::size_t digits_from(const DrawList& list, std::size_t first) {
  const TextShape* before = nullptr;
  std::size_t i = first;
  for (; i < list.shapes.size(); ++i) {
    const auto* s = std::get_if<TextShape>(&list.shapes[i]);
    if (!s || s->text.size() != 1 || s->text[0] < '0' || s->text[0] > '9') break;
    const bool goes_on =
        !before || (s->at.y == before->at.y && s->size == before->size && s->role == before->role &&
                    s->at.x < before->at.x && before->at.x - s->at.x < s->size);
    if (!goes_on) break;
    before = s;
  }
  return i - first;
}

}  // namespace

void Cairo::require(int code) const {
  constexpr int kNoMemory = 1;  // CAIRO_STATUS_NO_MEMORY
  if (code == kNoMemory) throw std::bad_alloc();
  if (code != 0) throw BackendError("cairo: {}", status_to_string(code));
}

const Cairo& cairo() {
  static const Cairo functions = loaded_cairo();
  return functions;
}

void* cairo_face(Weight weight) {
  static const std::array<void*, kWeights.size()> faces = (cairo(), loaded_faces());
  return faces[static_cast<std::size_t>(weight)];
}

CairoPainter::CairoPainter(void* context, For what)
    : cairo_(cairo()), context_(context), for_(what) {
  if (for_ == For::pixels) return;
  cairo_face(Weight::regular);
  turn_hinting_off(cairo_, context_);
}

void CairoPainter::draw(const DrawList& list, const Theme& theme, bool paper,
                        const Canvas& canvas) {
  check_draw_list(list);
  canvas_ = canvas;
  theme_ = theme.with(list.paints);
  tint_ = nullptr;
  if (paper) {
    set_color(tinted(theme, Role::paper, nullptr, &Tint::fill));
    cairo_.paint(context_);
  }
  for (std::size_t i = 0; i < list.shapes.size(); ++i) {
    stop_if_asked();
    tint_ = list.tints.empty() ? nullptr : &list.tints[i];
    const std::size_t digits = for_ == For::vectors ? digits_from(list, i) : 0;
    if (digits > 1) {
      std::vector<const TextShape*> number;
      for (std::size_t k = digits; k-- > 0;)
        number.push_back(&std::get<TextShape>(list.shapes[i + k]));
      add_letters(number);
      i += digits - 1;
      continue;
    }
    std::visit([&](const auto& s) { add(s); }, list.shapes[i]);
  }
}

void CairoPainter::set_color(const Paint& c) {
  cairo_.set_source_rgba(context_, c[0] / 255.0, c[1] / 255.0, c[2] / 255.0, c[3] / 255.0);
}

// Fills and outlines the current path, and ends it.
void CairoPainter::fill_and_stroke(Role fill, const Stroke& stroke, double line_width) {
  if (const Paint ground = tinted(theme_, fill, tint_, &Tint::fill); ground[3] != 0) {
    set_color(ground);
    cairo_.fill_preserve(context_);
  }
  const Paint line = tinted(theme_, stroke.role, tint_, &Tint::line);
  if (line[3] != 0 && line_width > 0) {
    set_color(line);
    cairo_.set_line_width(context_, line_width);
    const double dash = stroke.dash * canvas_.scale;
    cairo_.set_dash(context_, &dash, dash > 0 ? 1 : 0, 0);
    cairo_.stroke_preserve(context_);
  }
  cairo_.new_path(context_);
}

void CairoPainter::outline(const Box<2>& box, double radius) {
  if (radius <= 0) {  // from the upper right corner, where Lantern's dashes begin, too
    cairo_.move_to(context_, box.hi.x, box.lo.y);
    cairo_.line_to(context_, box.hi.x, box.hi.y);
    cairo_.line_to(context_, box.lo.x, box.hi.y);
    cairo_.line_to(context_, box.lo.x, box.lo.y);
    cairo_.close_path(context_);
    return;
  }
  const Vec<2> lo = box.lo + Vec<2>(radius), hi = box.hi - Vec<2>(radius);
  cairo_.arc(context_, hi.x, lo.y, radius, -kQuarterTurn, 0);
  cairo_.arc(context_, hi.x, hi.y, radius, 0, kQuarterTurn);
  cairo_.arc(context_, lo.x, hi.y, radius, kQuarterTurn, 2 * kQuarterTurn);
  cairo_.arc(context_, lo.x, lo.y, radius, 2 * kQuarterTurn, 3 * kQuarterTurn);
  cairo_.close_path(context_);
}

void CairoPainter::add(const RectShape& shape) {
  Box<2> box = canvas_.pixels(shape.box);
  if (box.size().x < 0 || box.size().y < 0) return;
  double width = shape.stroke.width * canvas_.scale;
  if (shape.snapped && for_ == For::pixels) {
    const bool has_line = shape.stroke.role != Role::none && width > 0;
    width = has_line ? snapped_width(width) : 0;
    for (int i = 0; i < 2; ++i) {
      box.lo[i] = has_line ? snapped(box.lo[i], width) : rounded(box.lo[i]);
      box.hi[i] = has_line ? snapped(box.hi[i], width) : rounded(box.hi[i]);
    }
  }
  cairo_.set_line_cap(context_, kButtCap);
  cairo_.set_line_join(context_, kMiterJoin);
  outline(box, std::min(shape.radius * canvas_.scale, 0.5 * std::min(box.size().x, box.size().y)));
  fill_and_stroke(shape.fill, shape.stroke, width);
}

void CairoPainter::add(const LineShape& shape) {
  Vec<2> from = canvas_.pixel(shape.from), to = canvas_.pixel(shape.to);
  double width = shape.stroke.width * canvas_.scale;
  const bool on_pixels = shape.snapped && for_ == For::pixels;
  if (on_pixels) {
    width = snapped_width(width);
    for (Vec<2>* end : {&from, &to}) *end = {snapped(end->x, width), snapped(end->y, width)};
  }
  cairo_.set_line_cap(context_, shape.stroke.dash > 0 || on_pixels ? kButtCap
                                : shape.snapped                    ? kSquareCap
                                                                   : kRoundCap);
  cairo_.move_to(context_, from.x, from.y);
  cairo_.line_to(context_, to.x, to.y);
  fill_and_stroke(Role::none, shape.stroke, width);
}

void CairoPainter::add(const PolygonShape& shape) {
  if (shape.points.empty()) return;
  for (const Vec<2>& corner : shape.points) {
    const Vec<2> p = canvas_.pixel(corner);
    cairo_.line_to(context_, p.x, p.y);
  }
  cairo_.close_path(context_);
  cairo_.set_line_cap(context_, kButtCap);
  cairo_.set_line_join(context_, kRoundJoin);
  fill_and_stroke(shape.fill, shape.stroke, shape.stroke.width * canvas_.scale);
}

void CairoPainter::add(const TextShape& shape) {
  if (shape.size <= 0 || shape.text.empty()) return;
  if (for_ == For::vectors) return add_letters({&shape});
  Vec<2> at = beginning_of(shape);
  at.y = rounded(at.y);
  add_outlines(shape, at);
  stroke_halo(tinted(theme_, shape.halo, tint_, &Tint::line));
  set_color(tinted(theme_, shape.role, tint_, &Tint::fill));
  cairo_.fill(context_);
}

// Round the letters of the current path, which stays.
void CairoPainter::stroke_halo(const Paint& halo) {
  constexpr double kHalo = 6;  // 3 units on either side
  if (halo[3] == 0) return;
  const double none = 0;
  set_color(halo);
  cairo_.set_dash(context_, &none, 0, 0);
  cairo_.set_line_join(context_, kRoundJoin);
  cairo_.set_line_width(context_, kHalo * canvas_.scale);
  cairo_.stroke_preserve(context_);
}

Vec<2> CairoPainter::beginning_of(const TextShape& shape) const {
  const double width = text_width(shape.text, shape.size, shape.weight);
  return canvas_.pixel({shape.at.x - shape.align * width, shape.at.y});
}

// Letters with what they mean, so that they can be searched and copied; their halo is outlines. All
// parts have one style. Several are one word, whatever stands between them.
void CairoPainter::add_letters(const std::vector<const TextShape*>& parts) {
  const TextShape& shape = *parts.front();
  const double em = shape.size * canvas_.scale;
  std::string text;
  std::vector<CairoGlyph> glyphs;
  std::vector<CairoCluster> clusters;
  for (const TextShape* part : parts) {
    const Vec<2> at = beginning_of(*part);
    for (const PlacedGlyph& placed : shape_text(part->text, em, shape.weight)) {
      const std::size_t before = text.size();
      append_utf8(text, placed.letter);
      glyphs.push_back({static_cast<unsigned long>(placed.glyph), at.x + placed.x, at.y});
      clusters.push_back({static_cast<int>(text.size() - before), 1});
    }
  }
  if (parts.size() > 1)
    clusters = {{static_cast<int>(text.size()), static_cast<int>(glyphs.size())}};
  const int count = static_cast<int>(glyphs.size());
  cairo_.set_font_face(context_, cairo_face(shape.weight));
  cairo_.set_font_size(context_, em);
  if (const Paint halo = tinted(theme_, shape.halo, tint_, &Tint::line); halo[3] != 0) {
    cairo_.glyph_path(context_, glyphs.data(), count);
    stroke_halo(halo);
    cairo_.new_path(context_);
  }
  const Paint ink = tinted(theme_, shape.role, tint_, &Tint::fill);
  if (ink[3] == 0) return;
  set_color(ink);
  cairo_.show_text_glyphs(context_, text.c_str(), static_cast<int>(text.size()), glyphs.data(),
                          count, clusters.data(), static_cast<int>(clusters.size()), 0);
}

// Adds the letters' outlines to the current path.
void CairoPainter::add_outlines(const TextShape& shape, const Vec<2>& at) {
  const double em = shape.size * canvas_.scale;
  for (const PlacedGlyph& placed : shape_text(shape.text, em, shape.weight)) {
    const Vec<2> origin(at.x + placed.x, at.y);
    Vec<2> pen = origin;
    for (const PathStep& step : glyph(placed.glyph, shape.weight)) {
      Vec<2> p[3];
      for (std::size_t i = 0; i < step.points.size(); ++i) p[i] = origin + em * step.points[i];
      if (step.letter == 'M') cairo_.move_to(context_, p[0].x, p[0].y);
      if (step.letter == 'L') cairo_.line_to(context_, p[0].x, p[0].y);
      if (step.letter == 'Z') cairo_.close_path(context_);
      if (step.letter == 'C')
        cairo_.curve_to(context_, p[0].x, p[0].y, p[1].x, p[1].y, p[2].x, p[2].y);
      if (step.letter == 'Q') {  // as the cubic curve that it is
        const Vec<2> a = (pen + 2.0 * p[0]) / 3.0, b = (p[1] + 2.0 * p[0]) / 3.0;
        cairo_.curve_to(context_, a.x, a.y, b.x, b.y, p[1].x, p[1].y);
      }
      if (!step.points.empty()) pen = p[step.points.size() - 1];
    }
  }
}

const std::vector<PathStep>& CairoPainter::glyph(int index, Weight weight) {
  const auto [it, fresh] = glyphs_.try_emplace({index, weight});
  if (fresh) it->second = glyph_path(index, weight);
  return it->second;
}

}  // namespace lantern::render
