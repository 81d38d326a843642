// What single panels show: charts, comparisons, the lecture's code, what it remembers of
// collisions.
#pragma once

#include "frame/frame.hpp"
#include "language/code_text.hpp"
#include "spatial/broad_phase.hpp"

namespace lantern::frame {

// A line of a chart: what one count was against another, step by step.
struct FrameSeries {
  std::string name;            // of the count or measure, or of the body it is of
  std::vector<Vec<2>> points;  // in the order of the steps
  int color = 0;               // of the body; 0: whichever is next
  std::string label = {};      // that the scenario gives it, or empty

  static auto fields(auto& r, auto&& v) { return v.drawn(r.name, r.points, r.color, r.label); }
};

// How often each structure, or each step, counted something, as bars.
struct FrameBar {
  std::string label;
  double value = 0;
  int group = 0;  // bars of one group stand together
  int line = 0;   // which of the chart's quantities, or sides: those of one look alike
  std::vector<double> pieces = {};  // whose sum it is, from zero on; none: it is of one piece
};

struct FrameChart {
  static constexpr std::string_view kName = "chart";
  std::string x_name;  // of the count along x; empty for bars
  std::string y_name;
  bool logarithmic = false;       // both axes, but for time
  bool over_time = false;         // x is seconds
  std::optional<double> seconds;  // over time: how far the x axis goes; none: as far as the lines
  std::optional<double> least;    // of the y axis; lines leave the picture beyond it
  std::optional<double> most;
  std::string x_unit;  // "J"; empty for what is counted
  std::string y_unit;
  std::vector<FrameSeries> series;
  std::vector<FrameBar> bars;
  std::vector<std::string> pieces;  // what those of a bar are called
  int part = 0;  // of bars that begin anew with each: how many parts before had some

  static auto fields(auto& r, auto&& v) {
    return v.drawn(r.x_name, r.y_name, r.logarithmic, r.over_time, r.seconds, r.least, r.most,
                   r.x_unit, r.y_unit, r.series, r.bars, r.pieces, r.part);
  }
};

// One count over the world's time so far, for the thin strip under what moves.
struct FrameTrace {
  static constexpr std::string_view kName = "trace";
  std::string name;               // of the count
  std::vector<Vec<2>> points;     // seconds since the part began, and the count
  std::optional<double> seconds;  // of the part; none: the script does not say

  static auto fields(auto& r, auto&& v) { return v.drawn(r.name, r.points, r.seconds); }
};

// A function of the lecture's own source, and which of its lines the frame is about.
using FrameCode = CodeText;

// What the world remembered, step after step, of one pair that touches or has just touched.
struct FrameCollision {
  struct Moment {
    std::uint64_t step = 0;  // of the world, from 1
    int frames_left = 0;     // after it: steps without touch before the end is told; -1: told in it
    bool touches = false;    // in it
    bool begins = false;     // its begin was told in it

    static auto fields(auto& r, auto&& v) {
      return v("step", r.step)("frames_left", r.frames_left)("touches", r.touches)("begins",
                                                                                   r.begins);
    }
  };
  Pair pair;
  std::vector<Moment> moments;  // in order

  static auto fields(auto& r, auto&& v) { return v("pair", r.pair)("moments", r.moments); }
};

// All of them since a part of the script began.
struct FrameCollisions {
  static constexpr std::string_view kName = "collisions";
  std::vector<FrameCollision> rows;    // by their first begin
  int remembered = 0;                  // what framesLeft begins with
  std::uint64_t first = 0;             // world steps before the part
  std::uint64_t now = 0;               // world steps so far
  std::optional<std::uint64_t> steps;  // of the part; none: the script does not say

  static auto fields(auto& r, auto&& v) {
    return v("collisions", r.rows).drawn(r.remembered, r.first, r.now, r.steps);
  }
};

// What kinds of structures do for the same bodies, world by world: a table, a row a world.
struct FrameComparison {
  static constexpr std::string_view kName = "comparison";
  static constexpr std::uint64_t kNoWork = ~std::uint64_t{0};
  // Of one kind for one world.
  struct Cell {
    StructureKind kind = StructureKind::none;
    StructureWork work;
    int micros = 0;  // a step, as the script says; 0: it does not

    static decltype(auto) fields(const auto& r, auto&& v) {
      return v("kind", r.kind).flat(r.work).when(r.micros > 0, "microseconds", r.micros);
    }
  };
  // A body, for a small picture of the world.
  struct Mark {
    Box<3> box;
    int color = 1;
    bool is_static = false;
  };
  struct Row {
    std::string name;
    std::string answer;   // counts filled in
    std::string machine;  // that took the times; empty if there are none
    std::uint64_t bodies = 0;
    std::uint64_t testable = 0;  // pairs of them that brute force tests
    std::vector<Mark> marks;     // before the step
    std::vector<Cell> cells;

    const Cell* cell(StructureKind kind) const {
      const auto found = std::ranges::find(cells, kind, &Cell::kind);
      return found == cells.end() ? nullptr : &*found;
    }
    // Comparisons of the kind that needs fewest in a step, or another amount of the kind that has
    // the least; of the lecture's own alone, which may be none.
    std::uint64_t least(
        bool of_lecture = false, std::uint64_t (*amount)(const Cell&) = [](const Cell& cell) {
          return cell.work.step();
        }) const {
      std::uint64_t least = kNoWork;
      for (const Cell& cell : cells)
        if (!of_lecture || traits_of(cell.kind).is_of_lecture)
          least = std::min(least, amount(cell));
      return least;
    }

    static auto fields(auto& r, auto&& v) {
      return v("row", r.name)("answer", r.answer)("bodies", r.bodies)("testable_pairs", r.testable)(
                 "kinds", r.cells)
          .when(!r.machine.empty(), "machine", r.machine)
          .drawn(r.marks);
    }
  };

  std::vector<Row> rows;  // so far

  static decltype(auto) fields(const auto& r, auto&& v) { return v("comparison", r.rows); }
};

}  // namespace lantern::frame
