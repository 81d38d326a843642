// From a DrawList to batches of quads in pixels. Knows pixels, but no GL: all of it can be tested
// without a context.
#pragma once

#include <vector>

#include "draw/draw_list.hpp"
#include "draw/theme.hpp"
#include "render/canvas.hpp"
#include "render/instances.hpp"
#include "render/mask_store.hpp"
#include "render/polygon_masks.hpp"
#include "render/text_masks.hpp"

namespace lantern {

class ShapeBuilder {
 public:
  // For images of this size.
  ShapeBuilder(int width, int height) : width_(width), height_(height) {}

  // Replaces what the last call built.
  void build(const DrawList& list, const Theme& theme);

  const BatchList& batches() const { return batches_; }
  const MaskStore& masks() const { return masks_; }

 private:
  void add(const RectShape& shape);
  void add(const LineShape& shape);
  void add(const PolygonShape& shape);
  void add(const TextShape& shape);

  // A box in its own frame, with an axis of unit length.
  struct FramedBox {
    Vec<2> center{0.0}, axis{1.0, 0.0}, half{0.0};
    double radius = 0, half_line = 0;
  };
  struct Border {
    Box<2> box;
    double width = 0;  // pixels
  };
  Border border_of(const RectShape& shape) const;
  void add_upright(const FramedBox& box, const Instance& paint);
  void add_turned(const FramedBox& box, const Instance& paint);
  void add_quad(Program program, Instance instance, const PixelRect& rect);
  void add_line(const Vec<2>& from, const Vec<2>& to, double width, bool round, Role role);
  void add_dashes(const std::vector<Vec<2>>& outline, bool closed, const Stroke& stroke);
  void add_text(const TextKey& key, const Vec<2>& at, Role role);
  void add_inside(const Instance& paint, const PixelRect& rect);
  void add_mask(const Instance& paint, std::int32_t mask, const PixelRect& rect);
  void add_snapped_line(const LineShape& shape);
  bool is_dashed(const Stroke& stroke) const;
  Instance paint(Role fill, Role stroke) const;
  Box<2> image() const { return {Vec<2>(0.0), Vec<2>(canvas_.width, canvas_.height)}; }

  int width_, height_;
  Canvas canvas_;
  const Theme* theme_ = nullptr;
  BatchList batches_;
  MaskStore masks_;
  TextMasks text_{masks_};
  PolygonMasks polygons_{masks_};
};

}  // namespace lantern
