// The camera of a solid world: from points in space to the page.
//
// A solid world is drawn as flat shapes in painter's order, like a flat one, and not with a depth
// buffer: so a frame is the same list of shapes for pixels and for SVG, lines stay crisp at every
// size, and the picture does not hang on how a graphics driver rounds depths.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "draw/metrics.hpp"
#include "scenario/frame.hpp"

namespace lantern {

using Outline = std::vector<Vec<2>>;  // on the page

// The smallest convex polygon around the points.
Outline hull_of(Outline points);

// Two convex outlines share some area; lines of two points may be among them.
bool cover_each_other(const Outline& a, const Outline& b);

Box<2> box_of(const Outline& points);

// The part of a convex polygon in space where normal . x >= offset.
std::vector<Vec<3>> clipped(const std::vector<Vec<3>>& polygon, const Vec<3>& normal,
                            double offset);

// The corners of a box: bit 0, 1, 2 of the index says high on x, y, z.
std::vector<Vec<3>> corners_of(const Box<3>& box);

// A perspective camera, y up. Nothing nearer to the eye than a small part of the world is shown, so
// that every shape stays finite wherever the eye is.
//
// When the eye sees the whole world from outside, the picture is moved and scaled so that the
// bounds fill the panel, whatever the angle of view; an angle so narrow that the bounds would
// clearly leave the panel is a wish to see a part, and is kept. From inside the angle is kept, too.
class SolidView {
 public:
  // Without a camera, or with one that is not finite or looks nowhere: from the front, above, and
  // to the right.
  SolidView(const Box<3>& bounds, const std::optional<Camera>& camera, const Box<2>& panel);

  const Vec<3>& eye() const { return eye_; }
  const Vec<3>& right() const { return right_; }
  const Vec<3>& up() const { return up_; }
  const Vec<3>& light() const { return light_; }  // unit, towards it: over the viewer's shoulder
  const Box<2>& panel() const { return panel_; }
  const Box<3>& bounds() const { return bounds_; }
  double size() const { return size_; }  // of the world's diagonal

  // Along the line of sight.
  double depth(const Vec<3>& p) const { return glm::dot(p - eye_, forward_); }
  bool in_front(const Vec<3>& p) const { return depth(p) >= near_; }
  // So far away that it is no pixel, or not a number.
  bool lost(const Vec<3>& p) const;

  // A point nearer than what is shown lands where it would at that distance.
  Vec<2> to_page(const Vec<3>& p) const;
  // Page units of a world unit there.
  double scale_at(const Vec<3>& p) const { return scale_ / std::max(depth(p), near_); }

  // What is in front of the eye, uncut by the panel; empty if nothing is.
  Outline polygon(const std::vector<Vec<3>>& corners) const;
  // The same, cut by the panel.
  std::optional<std::pair<Vec<2>, Vec<2>>> segment(const Vec<3>& a, const Vec<3>& b) const;
  // The line of a segment before the panel cuts it.
  std::optional<std::pair<Vec<3>, Vec<3>>> in_sight(const Vec<3>& a, const Vec<3>& b) const;

  // The part of a ball whose normals are near to the unit vector `axis`, as the eye sees it: all
  // for the least cosine -1, otherwise at least 0. Where the axis points away from the eye, the
  // hollow of a crescent is filled. Empty when the eye is in the ball.
  Outline ball_cap(const Vec<3>& center, double radius, const Vec<3>& axis,
                   double least_cosine) const;

 private:
  void aim(const Camera& camera);
  void fit(double field_of_view, bool chosen);

  Box<3> bounds_;
  Box<2> panel_;
  Vec<3> eye_{0.0}, right_{1, 0, 0}, up_{0, 1, 0}, forward_{0, 0, -1}, light_{0, 1, 0};
  double size_ = 1;
  double near_ = 1e-3;
  double scale_ = 1;  // page units of a world unit at depth 1
  Vec<2> origin_{0.0};
};

}  // namespace lantern
