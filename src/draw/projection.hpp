// From points of a world to units of the page.
//
// A 3D world is drawn as plain shapes in painter's order, like a 2D one, and not with a depth
// buffer: so a frame is the same list of shapes for pixels and for SVG, lines stay crisp at every
// size, and the picture does not depend on how a graphics driver rounds depths.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "draw/pen.hpp"
#include "frame/frame.hpp"
#include "geometry/flat.hpp"

namespace lantern::draw {

using Outline = std::vector<Vec<2>>;  // on the page

// The smallest convex polygon around the points.
Outline hull_of(Outline points);

// Two convex outlines share some area; lines of two points may be among them.
bool cover_each_other(const Outline& a, const Outline& b);

// The part of a convex polygon in space where normal . x >= offset.
std::vector<Vec<3>> clipped(const std::vector<Vec<3>>& polygon, const Vec<3>& normal,
                            double offset);

// A unit vector at right angles to a unit vector.
inline Vec<3> across(const Vec<3>& n) {
  return glm::normalize(glm::cross(n, std::abs(n.y) < 0.9 ? Vec<3>(0, 1, 0) : Vec<3>(1, 0, 0)));
}

// The corners of a box: bit 0, 1, 2 of the index says high on x, y, z.
std::vector<Vec<3>> corners_of(const Box<3>& box);

// What marks need to know of the way to the page, the same for 2D and 3D worlds.
class Projection {
 public:
  virtual ~Projection() = default;

  // Nothing for a point that cannot be seen.
  virtual std::optional<Vec<2>> seen(const Vec<3>& p) const = 0;
  // Page units of a world unit there.
  virtual double scale_at(const Vec<3>& p) const = 0;
  // A direction as it is seen, along the page's axes and in world units.
  virtual Vec<2> turned(const Vec<3>& direction) const = 0;
  // The world's measure, and the length of the longest velocity arrows, in world units.
  double size() const { return size_; }
  double longest_arrow() const { return longest_arrow_; }

  const Box<2>& panel() const { return panel_; }
  // The part of the panel that the world takes.
  const Box<2>& picture() const { return picture_; }

 protected:
  explicit Projection(const Box<2>& panel) : panel_(panel), picture_(panel) {}
  Box<2> panel_, picture_;
  double size_ = 1, longest_arrow_ = 1;
};

// One scale for both axes, y turned over, the bounds, or a part of them in their proportions,
// centred in the panel. All is seen: what lies out of the part is beside the picture.
class View2D : public Projection {
 public:
  View2D(const Box<2>& bounds, const Box<2>& panel, const std::optional<Box<2>>& part = {});

  double scale() const { return scale_; }
  Vec<2> to_page(const Vec<2>& p) const { return origin_ + Vec<2>(p.x, -p.y) * scale_; }
  Vec<2> to_page(const Vec<3>& p) const { return to_page(flat(p)); }
  Box<2> to_page(const Box<3>& box) const { return to_page(flat(box)); }
  Box<2> to_page(const Box<2>& box) const {
    return {in_reach(to_page(Vec<2>(box.lo.x, box.hi.y))),
            in_reach(to_page(Vec<2>(box.hi.x, box.lo.y)))};
  }
  // The cells that hold a half-space reach to the end of the numbers, far beyond what a renderer
  // takes: what lies out of all sight ends nearer.
  static Vec<2> in_reach(const Vec<2>& p) { return glm::clamp(p, -4e5, 4e5); }

  std::optional<Vec<2>> seen(const Vec<3>& p) const override { return to_page(p); }
  double scale_at(const Vec<3>&) const override { return scale_; }
  Vec<2> turned(const Vec<3>& direction) const override { return {direction.x, -direction.y}; }

 private:
  Vec<2> origin_{0.0};
  double scale_ = 1;
};

// A perspective camera, y up. Nothing nearer to the eye than a small part of the world is shown, so
// that every shape stays finite wherever the eye is.
//
// When the eye sees the whole world from outside, the picture is moved and scaled so that the
// bounds fill the panel, whatever the angle of view; an angle so narrow that the bounds would
// clearly leave the panel is a wish to see a part, and is kept. From inside the angle is kept, too.
class View3D : public Projection {
 public:
  // Without a camera, or with one that is not finite or looks nowhere: from the front, above, and
  // to the right.
  View3D(const Box<3>& bounds, const std::optional<Camera>& camera, const Box<2>& panel);

  const Vec<3>& eye() const { return eye_; }
  const Vec<3>& right() const { return right_; }  // unit, level, of the page
  const Vec<3>& up() const { return up_; }        // unit, of the page
  const Vec<3>& light() const { return light_; }  // unit, towards it: over the viewer's shoulder
  const Box<3>& bounds() const { return bounds_; }

  // Of a point in the bounds: 0 at their nearest corner, 1 at their farthest.
  double farness(const Vec<3>& p) const;

  // Along the line of sight.
  double depth(const Vec<3>& p) const { return glm::dot(p - eye_, forward_); }
  bool in_front(const Vec<3>& p) const { return depth(p) >= near_; }
  // So far away that it is no pixel, or not a number.
  bool lost(const Vec<3>& p) const;

  // A point nearer than what is shown lands where it would at that distance.
  Vec<2> to_page(const Vec<3>& p) const;
  double scale_at(const Vec<3>& p) const override { return scale_ / std::max(depth(p), near_); }
  std::optional<Vec<2>> seen(const Vec<3>& p) const override;
  Vec<2> turned(const Vec<3>& direction) const override {
    return {glm::dot(direction, right_), -glm::dot(direction, up_)};
  }

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
  void fit(const Camera& camera, bool chosen);

  Box<3> bounds_;
  Vec<3> eye_{0.0}, right_{1, 0, 0}, up_{0, 1, 0}, forward_{0, 0, -1}, light_{0, 1, 0};
  double near_ = 1e-3;
  double scale_ = 1;  // page units of a world unit at depth 1
  Vec<2> origin_{0.0};
};

}  // namespace lantern::draw
