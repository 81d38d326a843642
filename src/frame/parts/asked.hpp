// What was asked of the structure or of the narrow phase, and what was found.
#pragma once

#include "frame/frame.hpp"
#include "physics/gjk.hpp"

namespace lantern::frame {

struct FrameRay {
  Vec<3> from{0.0};
  Vec<3> to{0.0};  // where it ends: its length, or the nearest hit
  struct Hit {
    BodyId body = 0;
    Vec<3> position{0.0};

    static auto fields(auto& r, auto&& v) { return v("body", r.body)("position", r.position); }
  };
  std::vector<Hit> hits;  // in order along the ray

  static auto fields(auto& r, auto&& v) { return v("from", r.from)("to", r.to)("hits", r.hits); }
};

// A view that bodies are culled against. In a flat world a wedge: `corners` goes round it. In a
// solid one a frustum: four corners of the near plane, then four of the far plane, each going
// round.
struct FrameView {
  Vec<3> eye{0.0};
  std::vector<Vec<3>> corners;

  static auto fields(auto& r, auto&& v) { return v("eye", r.eye)("corners", r.corners); }
};

// A region that was asked for what it overlaps.
struct FrameQuery {
  Box<3> box;
  double radius = 0;  // above 0: a disc or ball about the box's centre

  static auto fields(auto& r, auto&& v) { return v("box", r.box)("radius", r.radius); }
};

// What a ray, view or region was, and what it found.
struct FrameFinding {
  static constexpr std::string_view kName = "finding";
  std::vector<FrameRay> rays;
  std::vector<FrameView> views;
  std::vector<FrameQuery> queries;
  std::vector<BodyId> hits;  // of a ray in order along it

  static auto fields(auto& r, auto&& v) {
    return v.when(!r.rays.empty(), "rays", r.rays)
        .when(!r.views.empty(), "views", r.views)
        .when(!r.queries.empty(), "queries", r.queries)
        .drawn(r.hits);
  }
};

// An axis along which two bodies were measured: how far their shadows on it are apart.
struct FrameAxis {
  Vec<2> direction{0.0};              // unit, from the first body to the second
  double separation = 0;              // of the shadows; below 0 they overlap
  std::optional<BodyId> across = {};  // a face of this body; none: between closest points
  std::vector<Vec<2>> face = {};      // its ends
  // The points whose shadows end the bodies' shadows: the first body's least and most along the
  // axis, then the second's.
  std::array<Vec<2>, 4> ends{};

  static auto fields(auto& r, auto&& v) {
    return v("direction", r.direction)("separation", r.separation)("across", r.across)
        .drawn(r.face, r.ends);
  }
};

// Two bodies measured along one axis after another, until one parts them or there is none left.
struct FrameSeparation {
  static constexpr std::string_view kName = "separation";
  BodyId a = 0;
  BodyId b = 0;
  std::vector<FrameAxis> axes;  // those so far, in their order
  // Which of them answers: it parts the bodies, or they overlap least along it. None yet: unknown.
  std::optional<std::size_t> answer;

  double gap() const;      // along the answer, or else the newest axis; 0 if they overlap
  double overlap() const;  // the least so far; 0 if they are apart

  static auto fields(auto& r, auto&& v) {
    return v("axes", r.axes)("answer", r.answer).drawn(r.a, r.b);
  }
};

// The shapes of many pairs, each pair tested once.
struct ShapeTests {
  std::vector<Pair> tested;  // in order of ids
  std::uint64_t work = 0;    // lengths measured
  std::vector<FrameContact> touching;
};

// GJK: support point by support point to the distance of two bodies.
struct FrameSearch {
  static constexpr std::string_view kName = "search";
  BodyId a = 0;
  BodyId b = 0;
  std::vector<GjkStep> steps = {};  // those so far
  bool taken = true;                // the last one's point has entered the simplex
  std::optional<GjkAnswer> answer = {};

  static auto fields(auto& r, auto&& v) {
    return v("searches", r.steps).drawn(r.a, r.b, r.taken, r.answer);
  }
};

// All points of the first body less all points of the second.
struct FrameDifference {
  static constexpr std::string_view kName = "difference";
  BodyId a = 0;
  BodyId b = 0;
  std::vector<Vec<2>> corners;  // convex, counter-clockwise
  double radius = 0;            // round them, of round shapes

  static auto fields(auto& r, auto&& v) {
    return v("difference", r.corners)("radius", r.radius).drawn(r.a, r.b);
  }
};

}  // namespace lantern::frame
