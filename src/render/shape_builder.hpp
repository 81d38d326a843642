// From a DrawList to quads in pixels. Knows pixels, but no GL: all of it can be tested
// without a context.
#pragma once

#include "draw/draw_list.hpp"
#include "draw/theme.hpp"
#include "geometry/ray.hpp"
#include "render/canvas.hpp"
#include "render/instances.hpp"
#include "render/masks.hpp"

namespace lantern::render {

class ShapeBuilder {
 public:
  // For images of this size.
  ShapeBuilder(int width, int height) : width_(width), height_(height) {}

  // Replaces what the last call built.
  void build(const DrawList& list, const Theme& theme) {
    check_draw_list(list);
    canvas_ = Canvas(list.page, width_, height_);
    theme_ = theme.with(list.paints);
    quads_.clear();
    if (masks_.start_frame()) {
      text_.forget();
      polygons_.forget();
    }
    for (std::size_t i = 0; i < list.shapes.size(); ++i) {
      tint_ = list.tints.empty() ? nullptr : &list.tints[i];
      std::visit([&](const auto& s) { add(s); }, list.shapes[i]);
    }
  }

  const std::vector<Quad>& quads() const { return quads_; }  // in painting order
  const MaskStore& masks() const { return masks_; }

 private:
  void add(const RectShape& shape) {
    const Border border = border_of(shape);
    const Box<2>& box = border.box;
    if (box.hi.x < box.lo.x || box.hi.y < box.lo.y) return;
    FramedBox framed{box.center(), {1, 0}, box.size() * 0.5, 0, 0.5 * border.width};
    framed.radius =
        std::clamp(shape.radius * canvas_.scale, 0.0, std::min(framed.half.x, framed.half.y));
    const Paint fill = fill_of(shape.fill), line = line_of(shape.stroke);
    if (border.width == 0 || !is_dashed(shape.stroke, line))
      return add_upright(framed, paint(fill, line));

    FramedBox ground = framed;
    ground.half_line = 0;
    if (shape.snapped) {  // an odd line's centre lies between two pixels, where no ground may end
      const Vec<2> lo(rounded(box.lo.x), rounded(box.lo.y)),
          hi(rounded(box.hi.x), rounded(box.hi.y));
      ground.center = (lo + hi) * 0.5;
      ground.half = (hi - lo) * 0.5;
    }
    add_upright(ground, paint(fill));
    Stroke stroke = shape.stroke;
    stroke.width = border.width / canvas_.scale;
    add_dashes(outline_of(box, framed.radius), true, stroke, line);
  }

  void add(const LineShape& shape) {
    const Paint line = line_of(shape.stroke);
    if (line[3] == 0) return;
    if (shape.snapped && !is_dashed(shape.stroke, line) &&
        (shape.from.x == shape.to.x || shape.from.y == shape.to.y))
      return add_snapped_line(shape, line);
    const Vec<2> from = canvas_.pixel(shape.from), to = canvas_.pixel(shape.to);
    if (is_dashed(shape.stroke, line)) return add_dashes({from, to}, false, shape.stroke, line);
    add_line(from, to, shape.stroke.width * canvas_.scale, true, line);
  }

  void add(const PolygonShape& shape) {
    std::vector<Vec<2>> points;
    for (const Vec<2>& p : shape.points) points.push_back(canvas_.pixel(p));
    const Paint stroke = line_of(shape.stroke);
    const bool dashed = is_dashed(shape.stroke, stroke);
    const Instance fill = paint(fill_of(shape.fill));
    const Instance line = paint(dashed ? Paint{} : stroke);
    const double half_line = line.fill[3] == 0 ? 0 : 0.5 * shape.stroke.width * canvas_.scale;
    const std::vector<PolygonTile>& tiles = polygons_.tiles(points, half_line, canvas_);
    for (const PolygonTile& tile : tiles) {
      if (fill.fill[3] == 0) break;
      if (tile.fill != 0)
        add_mask(fill, tile.fill, tile.rect);
      else
        add_inside(fill, tile.rect);
    }
    for (const PolygonTile& tile : tiles)
      if (tile.stroke != 0) add_mask(line, tile.stroke, tile.rect);
    if (dashed) add_dashes(points, true, shape.stroke, stroke);
  }

  void add(const TextShape& shape) {
    const double pixels = shape.size * canvas_.scale;
    if (shape.text.empty() || pixels <= 0) return;
    const double width = shape.align == 0 ? 0 : text_width(shape.text, shape.size, shape.weight);
    const Vec<2> at = canvas_.pixel({shape.at.x - shape.align * width, shape.at.y});
    TextKey key{shape.text, shape.weight, pixels, 0, 0};
    if (const Paint halo = tinted(theme_, shape.halo, tint_, &Tint::line); halo[3] != 0) {
      key.halo = 3 * canvas_.scale;
      add_text(key, at, halo);
      key.halo = 0;
    }
    add_text(key, at, fill_of(shape.role));
  }

  // A box in its own frame, with an axis of unit length.
  struct FramedBox {
    Vec<2> center{0.0}, axis{1.0, 0.0}, half{0.0};
    double radius = 0, half_line = 0;
  };
  struct Border {
    Box<2> box;
    double width = 0;  // pixels
  };

  // Where a rect's outline runs, and how wide it is: 0 without one.
  Border border_of(const RectShape& shape) const {
    Border border{canvas_.pixels(shape.box), 0};
    const bool has_line = line_of(shape.stroke)[3] != 0;
    if (has_line) border.width = shape.stroke.width * canvas_.scale;
    if (!shape.snapped) return border;
    Box<2>& box = border.box;
    if (has_line) border.width = snapped_width(border.width);
    for (int i = 0; i < 2; ++i) {
      box.lo[i] = has_line ? snapped(box.lo[i], border.width) : rounded(box.lo[i]);
      box.hi[i] = has_line ? snapped(box.hi[i], border.width) : rounded(box.hi[i]);
      if (!has_line && shape.box.hi[i] > shape.box.lo[i])
        box.hi[i] = std::max(box.hi[i], box.lo[i] + 1);
    }
    return border;
  }

  void add_upright(const FramedBox& box, const Instance& paint) {
    if (paint.fill[3] == 0 && paint.stroke[3] == 0) return;
    Instance instance = paint;
    instance.frame = floats(box.center.x, box.center.y, 1, 0);
    instance.box = floats(box.half.x, box.half.y, box.radius, box.half_line);
    // Round corners fade out half a pixel beyond the edge, sharp ones with the last pixel touched.
    const double fade = box.radius > 0 ? 0.5 : 0;
    const PixelRect outer =
        canvas_.around(Box<2>::around(box.center, box.half + Vec<2>(box.half_line + fade)));
    // Within a round corner of radius r the square inset by (1 - sqrt(1/2)) r is filled.
    const double inset = box.half_line + (box.radius > 0 ? 0.3 * box.radius + 1 : 0);
    const Vec<2> lo = box.center - box.half + Vec<2>(inset),
                 hi = box.center + box.half - Vec<2>(inset);
    const PixelRect inner =
        canvas_.around({{std::ceil(lo.x), std::ceil(lo.y)}, {std::floor(hi.x), std::floor(hi.y)}});
    if (inner.area() < kLargeArea) return add_quad(Program::box, instance, outer);
    if (paint.fill[3] != 0) add_inside(paint, inner);
    add_quad(Program::box, instance, {outer.x0, outer.y0, outer.x1, inner.y0});
    add_quad(Program::box, instance, {outer.x0, inner.y0, inner.x0, inner.y1});
    add_quad(Program::box, instance, {inner.x1, inner.y0, outer.x1, inner.y1});
    add_quad(Program::box, instance, {outer.x0, inner.y1, outer.x1, outer.y1});
  }

  void add_turned(const FramedBox& box, const Instance& paint) {
    const Vec<2> reach = box.half + Vec<2>(box.half_line + 1.5);
    const Vec<2> across(-box.axis.y, box.axis.x);
    const Vec<2> extent = glm::abs(box.axis) * reach.x + glm::abs(across) * reach.y;
    const PixelRect bounds = canvas_.around(Box<2>::around(box.center, extent));
    if (bounds.empty()) return;
    const Vec<2> corner = box.center - box.axis * reach.x - across * reach.y;
    Instance instance = paint;
    instance.quad = floats(corner.x, corner.y, 2 * reach.x, 2 * reach.y);
    instance.frame = floats(box.center.x, box.center.y, box.axis.x, box.axis.y);
    instance.box = floats(box.half.x, box.half.y, box.radius, box.half_line);
    quads_.push_back({Program::box, instance, bounds, true});
  }

  void add_quad(Program program, Instance instance, const PixelRect& rect) {
    if (rect.empty()) return;
    instance.quad = floats(rect.x0, rect.y0, rect.x1 - rect.x0, rect.y1 - rect.y0);
    quads_.push_back({program, instance, rect});
  }

  void add_line(const Vec<2>& from, const Vec<2>& to, double width, bool round, const Paint& line) {
    const Box<2> near{Vec<2>(-2 - width),
                      Vec<2>(canvas_.width, canvas_.height) + Vec<2>(2 + width)};
    const auto seen = span_in(Ray<2>{from, to - from, 1}, near);
    if (!seen) return;
    // What was cut off lies outside the image, so that round ends there are never seen.
    const Vec<2> a = from + (to - from) * seen->from, b = from + (to - from) * seen->to;
    const double length = glm::length(b - a);
    FramedBox box;
    box.center = (a + b) * 0.5;
    if (length > 0) box.axis = (b - a) / length;
    box.half = {0.5 * length + (round ? 0.5 * width : 0.0), 0.5 * width};
    box.radius = round ? 0.5 * width : 0;
    const Instance colors = paint(line);
    if (box.axis.x * box.axis.y != 0) return add_turned(box, colors);
    if (box.axis.y != 0) box.half = {box.half.y, box.half.x};
    box.axis = {1, 0};
    add_upright(box, colors);
  }

  void add_dashes(const std::vector<Vec<2>>& outline, bool closed, const Stroke& stroke,
                  const Paint& line) {
    const double width = stroke.width * canvas_.scale;
    for (const DashPiece& piece :
         cut_dashes(outline, closed, stroke.dash * canvas_.scale, width, image()))
      add_line(piece.from, piece.to, width, false, line);
  }

  // The origin lies on a whole pixel vertically, on one of kGlyphPlaces parts of it horizontally.
  void add_text(const TextKey& key, const Vec<2>& at, const Paint& letters) {
    if (letters[3] == 0) return;
    const auto x = static_cast<int>(rounded(kGlyphPlaces * at.x));
    TextKey placed = key;
    placed.place = x & (kGlyphPlaces - 1);
    const Mask& mask = text_.mask(placed);
    const int left = (x >> kGlyphBits) + mask.left,
              top = static_cast<int>(rounded(at.y)) + mask.top;
    add_mask(paint(letters), mask.offset, {left, top, left + mask.width, top + mask.height});
  }

  // Whole pixels of one colour.
  void add_inside(const Instance& paint, const PixelRect& rect) {
    Instance instance = paint;
    instance.box = floats(kEverywhere, kEverywhere, 0, 0);
    instance.stroke = {};
    add_quad(opaque(paint) ? Program::solid : Program::box, instance, rect);
  }

  // A mask's pixels, row by row in `rect`, of which the image may show only a part.
  void add_mask(const Instance& paint, std::int32_t mask, const PixelRect& rect) {
    const int width = rect.x1 - rect.x0;
    Instance instance = paint;
    instance.box = floats(kEverywhere, kEverywhere, 0, 0);
    instance.data = {mask - rect.y0 * width - rect.x0, 1, width, 0};
    add_quad(opaque(paint) ? Program::mask : Program::box, instance,
             {std::max(rect.x0, 0), std::max(rect.y0, 0), std::min(rect.x1, canvas_.width),
              std::min(rect.y1, canvas_.height)});
  }

  void add_snapped_line(const LineShape& shape, const Paint& line) {
    const Box<2> box = canvas_.snapped_line(shape);
    add_upright({box.center(), {1, 0}, box.size() * 0.5}, paint(line));
  }

  // A dash of less than a pixel is grey at best: such a line is drawn unbroken.
  bool is_dashed(const Stroke& stroke, const Paint& line) const {
    return stroke.dash * canvas_.scale >= 1 && line[3] != 0;
  }

  Paint fill_of(Role role) const { return tinted(theme_, role, tint_, &Tint::fill); }
  Paint line_of(const Stroke& stroke) const {
    return stroke.width > 0 ? tinted(theme_, stroke.role, tint_, &Tint::line) : Paint{};
  }
  static Instance paint(const Paint& fill, const Paint& line = {}) {
    return {.fill = fill, .stroke = line};
  }
  // Only the box program mixes colours with what is under them.
  static bool opaque(const Instance& paint) { return paint.fill[3] == 255; }
  Box<2> image() const { return {Vec<2>(0.0), Vec<2>(canvas_.width, canvas_.height)}; }

  // A box larger than this is cut into its inside, which is one colour, and four strips of border.
  static constexpr std::int64_t kLargeArea = 48 * 48;  // pixels

  static constexpr double kEverywhere = 1e6;  // half size of a box that covers every pixel

  static std::array<float, 4> floats(double a, double b, double c, double d) {
    return {static_cast<float>(a), static_cast<float>(b), static_cast<float>(c),
            static_cast<float>(d)};
  }

  int width_, height_;
  Canvas canvas_;
  Theme theme_{};
  const Tint* tint_ = nullptr;  // of the shape that is being added; none: as it says itself
  std::vector<Quad> quads_;
  MaskStore masks_;
  TextMasks text_{masks_};
  PolygonMasks polygons_{masks_};
};

}  // namespace lantern::render
