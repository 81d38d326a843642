// What moves and holds bodies: looks at an impact, springs and joints, forces, islands.
#pragma once

#include "frame/frame.hpp"

namespace lantern::frame {

// A look at two bodies within a world step, to find out when they meet. Times are shares of the
// step.
struct FrameLook {
  Pair pair;
  FramePlace a, b;              // where they are then
  Vec<3> on_a{0.0}, on_b{0.0};  // where their surfaces are nearest to each other
  double time = 0;
  double gap = 0;         // between them; below 0 they overlap
  double free_until = 0;  // for so long they surely do not touch; `time` if that is not known
  bool meets = false;     // this is the moment
  int number = 1;         // of the looks at this pair, from 1: not all of them are told

  static auto fields(auto& r, auto&& v) {
    return v("pair", r.pair)("a", r.a)("b", r.b)("time", r.time)("gap", r.gap)(
               "free_until", r.free_until)("meets", r.meets)
        .drawn(r.on_a, r.on_b, r.number);
  }
};

// For the moment of an impact, so far; the last is this frame's.
struct FrameLooks {
  static constexpr std::string_view kName = "looks";
  std::vector<FrameLook> looks;

  static decltype(auto) fields(const auto& r, auto&& v) { return v("looks", r.looks); }
};

// A spring, a distance joint or a pin, between two points.
struct FrameLink {
  enum class Kind { spring, distance, pin };
  friend std::string_view to_string(Kind kind) {
    static constexpr std::string_view kWords[] = {"spring", "distance", "pin"};
    return kWords[static_cast<int>(kind)];
  }
  Kind kind = Kind::spring;
  Vec<3> from{0.0};
  Vec<3> to{0.0};
  double strain = 0;  // (length - rest) / rest; 0 for a pin

  static auto fields(auto& r, auto&& v) {
    return v("kind", r.kind)("from", r.from)("to", r.to)("strain", r.strain);
  }
};

struct FrameLinks {
  static constexpr std::string_view kName = "links";
  std::vector<FrameLink> links;

  static decltype(auto) fields(const auto& r, auto&& v) { return v("links", r.links); }
};

// A force that acts on a body now: a script's, or the pull of a spring.
struct FrameForce {
  BodyId body = 0;
  Vec<3> at{0.0};     // in the world
  Vec<3> force{0.0};  // N
  bool of_spring = false;

  static auto fields(auto& r, auto&& v) {
    return v("body", r.body)("at", r.at)("force", r.force)("of_spring", r.of_spring);
  }
};

// If the scenario shows them.
struct FrameForces {
  static constexpr std::string_view kName = "forces";
  std::vector<FrameForce> forces;

  static decltype(auto) fields(const auto& r, auto&& v) { return v("forces", r.forces); }
};

// Bodies that hang together, as the last step of the world found, and so are moved together and
// sleep and wake together.
struct FrameIsland {
  std::uint32_t number = 0;  // from 1; an island keeps it while the body of its lowest id is in it
  std::vector<BodyId> bodies;  // ascending
  bool asleep = false;

  static auto fields(auto& r, auto&& v) {
    return v("number", r.number)("bodies", r.bodies)("asleep", r.asleep);
  }
};

// What holds two bodies together, or keeps them apart: that they touch, or a spring or joint.
struct FrameEdge {
  Pair pair;
  bool tied = false;  // by a spring or joint
  bool lit = false;   // new since the frame before
};

// If they have a panel.
struct FrameIslands {
  static constexpr std::string_view kName = "islands";
  std::vector<FrameIsland> islands;  // in order of their numbers
  std::vector<FrameEdge> edges;      // in order of ids

  static auto fields(auto& r, auto&& v) {
    return v.when(!r.islands.empty(), "islands", r.islands).drawn(r.edges);
  }
};

}  // namespace lantern::frame
