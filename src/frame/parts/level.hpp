// A level's walls, its openings, and who sees whom.
#pragma once

#include "frame/frame.hpp"

namespace lantern::frame {

// A piece of a level's wall.
struct FrameWall {
  Vec<2> from{0.0};
  Vec<2> to{0.0};
  std::uint32_t wall = 0;      // of the scenario's walls
  std::uint32_t node = kNone;  // of frame.nodes: where it lies, once it does
  Mark mark = Mark::quiet;

  static auto fields(auto& r, auto&& v) {
    return v("wall", r.wall)("from", r.from)("to", r.to)
        .when(r.node != kNone, "node", r.node)
        .drawn(r.mark);
  }
};

// An opening between two of a level's sectors, and a line of sight between two that see each other.
struct FramePortal {
  Vec<2> from{0.0};
  Vec<2> to{0.0};
  std::uint32_t a = 0;  // the sectors' nodes, of frame.nodes
  std::uint32_t b = 0;

  static auto fields(auto& r, auto&& v) { return v("from", r.from)("to", r.to)("nodes", r.a, r.b); }
};
using FrameSight = FramePortal;

struct FrameLevel {
  static constexpr std::string_view kName = "level";
  std::vector<FrameWall> walls;
  std::optional<Vec<2>> eye;          // from where it is looked at
  std::vector<FramePortal> portals;   // once a step asked who sees whom
  std::vector<FrameSight> sights;     // of the sector whose view has just been found
  std::uint32_t front = 0, back = 0;  // pieces in front of the line just taken, and behind it

  static auto fields(auto& r, auto&& v) {
    return v.when(!r.walls.empty(), "walls", r.walls)
        .when(!r.portals.empty(), "portals", r.portals)
        .when(!r.sights.empty(), "sights", r.sights)
        .drawn(r.eye, r.front, r.back);
  }
};

// Who sees whom of a level's sectors.
struct FrameMatrix {
  static constexpr std::string_view kName = "matrix";
  std::vector<std::string>
      rows;                   // a letter for each sector: '1' is seen, '0' is not, '.' not known
  std::uint32_t lit = kNone;  // the row that is asked for, or has just been found

  static decltype(auto) fields(const auto& r, auto&& v) { return v("matrix", r.rows).drawn(r.lit); }
};

}  // namespace lantern::frame
