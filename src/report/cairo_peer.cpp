#include "report/cairo_peer.hpp"

#include <charconv>
#include <cstdint>
#include <cstring>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/library.hpp"
#include "draw/font.hpp"

namespace lantern::report {

// Result, name without "cairo_", parameters: the part of <cairo.h> that is used. Surfaces and
// contexts are opaque, statuses are 0 when good.
#define LANTERN_CAIRO_FUNCTIONS(X)                                           \
  X(const char*, version_string, ())                                         \
  X(void*, image_surface_create, (int format, int width, int height))        \
  X(int, surface_status, (void*))                                            \
  X(void, surface_flush, (void*))                                            \
  X(unsigned char*, image_surface_get_data, (void*))                         \
  X(int, image_surface_get_stride, (void*))                                  \
  X(int, surface_write_to_png, (void*, const char* path))                    \
  X(const char*, status_to_string, (int))                                    \
  X(void, surface_destroy, (void*))                                          \
  X(void*, create, (void* surface))                                          \
  X(void, destroy, (void*))                                                  \
  X(void, set_antialias, (void*, int))                                       \
  X(void, set_source_rgb, (void*, double, double, double))                   \
  X(void, set_line_width, (void*, double))                                   \
  X(void, set_line_cap, (void*, int))                                        \
  X(void, set_line_join, (void*, int))                                       \
  X(void, set_dash, (void*, const double*, int, double))                     \
  X(void, new_path, (void*))                                                 \
  X(void, move_to, (void*, double, double))                                  \
  X(void, line_to, (void*, double, double))                                  \
  X(void, curve_to, (void*, double, double, double, double, double, double)) \
  X(void, arc, (void*, double x, double y, double radius, double, double))   \
  X(void, close_path, (void*))                                               \
  X(void, fill, (void*))                                                     \
  X(void, fill_preserve, (void*))                                            \
  X(void, stroke, (void*))                                                   \
  X(void, stroke_preserve, (void*))                                          \
  X(void, paint, (void*))

struct CairoFunctions {
#define LANTERN_CAIRO_MEMBER(result, name, parameters) result(*name) parameters = nullptr;
  LANTERN_CAIRO_FUNCTIONS(LANTERN_CAIRO_MEMBER)
#undef LANTERN_CAIRO_MEMBER

  CairoFunctions() {
    const Library library({"libcairo.so.2"});
    bool all = library.loaded();
#define LANTERN_CAIRO_LOAD(result, name, parameters) \
  all = all && library.find(name, "cairo_" #name);
    LANTERN_CAIRO_FUNCTIONS(LANTERN_CAIRO_LOAD)
#undef LANTERN_CAIRO_LOAD
    if (!all)
      throw BackendError(
          fmt::format("no cairo: {}; install the package libcairo2", library.problem()));
  }
};

namespace {

constexpr int kRgb24 = 1, kButtCap = 0, kRoundCap = 1, kMiterJoin = 0, kRoundJoin = 1;
constexpr double kQuarter = 1.5707963267948966;

}  // namespace

CairoPeer::CairoPeer(int width, int height, CairoAntialias antialias)
    : cairo_(std::make_unique<CairoFunctions>()) {
  canvas_.width = width;
  canvas_.height = height;
  surface_ = cairo_->image_surface_create(kRgb24, width, height);
  if (const int status = cairo_->surface_status(surface_); status != 0)
    throw BackendError(fmt::format("cairo: {}", cairo_->status_to_string(status)));
  context_ = cairo_->create(surface_);
  cairo_->set_antialias(context_, static_cast<int>(antialias));
}

CairoPeer::~CairoPeer() {
  if (context_) cairo_->destroy(context_);
  cairo_->surface_destroy(surface_);
}

std::string CairoPeer::version() const { return cairo_->version_string(); }

void CairoPeer::write_png(const std::filesystem::path& path) {
  const int status = cairo_->surface_write_to_png(surface_, path.c_str());
  if (status != 0)
    throw IoError(
        fmt::format("cannot write '{}': {}", path.string(), cairo_->status_to_string(status)));
}

void CairoPeer::read(Image& image) {
  cairo_->surface_flush(surface_);
  image.width = canvas_.width;
  image.height = canvas_.height;
  image.rgba.resize(std::size_t{4} * image.width * image.height);
  const unsigned char* row = cairo_->image_surface_get_data(surface_);
  const int stride = cairo_->image_surface_get_stride(surface_);
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
  canvas_ = Canvas(list.page, canvas_.width, canvas_.height);
  theme_ = &theme;
  set_color(Role::paper);
  cairo_->paint(context_);
  for (const DrawShape& shape : list.shapes) std::visit([&](const auto& s) { add(s); }, shape);
}

void CairoPeer::set_color(Role role) {
  const Color& c = (*theme_)[role];
  cairo_->set_source_rgb(context_, c.r / 255.0, c.g / 255.0, c.b / 255.0);
}

// Fills and outlines the current path, and ends it.
void CairoPeer::paint(Role fill, const Stroke& stroke, double line_width) {
  if (fill != Role::none) {
    set_color(fill);
    cairo_->fill_preserve(context_);
  }
  if (stroke.role != Role::none && line_width > 0) {
    set_color(stroke.role);
    cairo_->set_line_width(context_, line_width);
    const double dash = stroke.dash * canvas_.scale;
    cairo_->set_dash(context_, &dash, dash > 0 ? 1 : 0, 0);
    cairo_->stroke_preserve(context_);
  }
  cairo_->new_path(context_);
}

void CairoPeer::outline(const Box<2>& box, double radius) {
  if (radius <= 0) {  // from the upper right corner, where Lantern's dashes begin, too
    cairo_->move_to(context_, box.hi.x, box.lo.y);
    cairo_->line_to(context_, box.hi.x, box.hi.y);
    cairo_->line_to(context_, box.lo.x, box.hi.y);
    cairo_->line_to(context_, box.lo.x, box.lo.y);
    cairo_->close_path(context_);
    return;
  }
  const Vec<2> lo = box.lo + Vec<2>(radius), hi = box.hi - Vec<2>(radius);
  cairo_->arc(context_, hi.x, lo.y, radius, -kQuarter, 0);
  cairo_->arc(context_, hi.x, hi.y, radius, 0, kQuarter);
  cairo_->arc(context_, lo.x, hi.y, radius, kQuarter, 2 * kQuarter);
  cairo_->arc(context_, lo.x, lo.y, radius, 2 * kQuarter, 3 * kQuarter);
  cairo_->close_path(context_);
}

void CairoPeer::add(const RectShape& shape) {
  Box<2> box = canvas_.pixels(shape.box);
  double width = shape.stroke.width * canvas_.scale;
  if (shape.snapped) {
    const bool has_line = shape.stroke.role != Role::none && width > 0;
    width = has_line ? snapped_width(width) : 0;
    for (int i = 0; i < 2; ++i) {
      box.lo[i] = has_line ? snapped(box.lo[i], width) : rounded(box.lo[i]);
      box.hi[i] = has_line ? snapped(box.hi[i], width) : rounded(box.hi[i]);
    }
  }
  cairo_->set_line_cap(context_, kButtCap);
  cairo_->set_line_join(context_, kMiterJoin);
  outline(box, std::min(shape.radius * canvas_.scale, 0.5 * std::min(box.size().x, box.size().y)));
  paint(shape.fill, shape.stroke, width);
}

void CairoPeer::add(const LineShape& shape) {
  Vec<2> from = canvas_.pixel(shape.from), to = canvas_.pixel(shape.to);
  double width = shape.stroke.width * canvas_.scale;
  if (shape.snapped) {
    width = snapped_width(width);
    for (Vec<2>* end : {&from, &to}) *end = {snapped(end->x, width), snapped(end->y, width)};
  }
  cairo_->set_line_cap(context_, shape.stroke.dash > 0 || shape.snapped ? kButtCap : kRoundCap);
  cairo_->move_to(context_, from.x, from.y);
  cairo_->line_to(context_, to.x, to.y);
  paint(Role::none, shape.stroke, width);
}

void CairoPeer::add(const PolygonShape& shape) {
  for (const Vec<2>& corner : shape.points) {
    const Vec<2> p = canvas_.pixel(corner);
    cairo_->line_to(context_, p.x, p.y);
  }
  cairo_->close_path(context_);
  cairo_->set_line_cap(context_, kButtCap);
  cairo_->set_line_join(context_, kRoundJoin);
  paint(shape.fill, shape.stroke, shape.stroke.width * canvas_.scale);
}

void CairoPeer::add(const TextShape& shape) {
  const double width = text_width(shape.text, shape.size, shape.weight);
  Vec<2> at = canvas_.pixel({shape.at.x - shape.align * width, shape.at.y});
  at.y = rounded(at.y);
  letters(shape, at);
  if (shape.halo != Role::none) {
    const double none = 0;
    set_color(shape.halo);
    cairo_->set_dash(context_, &none, 0, 0);
    cairo_->set_line_join(context_, kRoundJoin);
    cairo_->set_line_width(context_, 6 * canvas_.scale);
    cairo_->stroke_preserve(context_);
  }
  set_color(shape.role);
  cairo_->fill(context_);
}

// Adds the letters' outlines to the current path.
void CairoPeer::letters(const TextShape& shape, const Vec<2>& at) {
  const double em = shape.size * canvas_.scale;
  for (const PlacedGlyph& placed : shape_text(shape.text, em, shape.weight)) {
    const Vec<2> origin(at.x + placed.x, at.y);
    Vec<2> pen = origin;
    for (const PathStep& step : glyph(placed.glyph, shape.weight)) {
      const Vec<2> a = origin + em * step.points[0], b = origin + em * step.points[1],
                   c = origin + em * step.points[2];
      if (step.letter == 'M') cairo_->move_to(context_, a.x, a.y);
      if (step.letter == 'L') cairo_->line_to(context_, a.x, a.y);
      if (step.letter == 'Z') cairo_->close_path(context_);
      if (step.letter == 'C') cairo_->curve_to(context_, a.x, a.y, b.x, b.y, c.x, c.y);
      if (step.letter == 'Q') {  // as the cubic curve that it is
        const Vec<2> p = (pen + 2.0 * a) / 3.0, q = (b + 2.0 * a) / 3.0;
        cairo_->curve_to(context_, p.x, p.y, q.x, q.y, b.x, b.y);
      }
      pen = step.letter == 'C' ? c : step.letter == 'Q' ? b : a;
    }
  }
}

const std::vector<CairoPeer::PathStep>& CairoPeer::glyph(int index, Weight weight) {
  const auto [it, fresh] = glyphs_.try_emplace({index, weight});
  if (!fresh) return it->second;
  const std::string path = glyph_path(index, weight);
  const char* const last = path.data() + path.size();
  for (const char* at = path.data(); at != last;) {
    PathStep step{*at++};
    const int points = step.letter == 'Z' ? 0 : step.letter == 'C' ? 3 : step.letter == 'Q' ? 2 : 1;
    for (int i = 0; i < 2 * points; ++i) {
      at = std::from_chars(at, last, step.points[i / 2][i % 2]).ptr;
      while (at != last && *at == ' ') ++at;
    }
    it->second.push_back(step);
  }
  return it->second;
}

}  // namespace lantern::report
