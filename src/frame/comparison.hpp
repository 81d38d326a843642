// What kinds of structures do for the same bodies, world by world: a table, a row a world.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/box.hpp"
#include "spatial/broad_phase_config.hpp"

namespace lantern::frame {

struct FrameComparison {
  static constexpr std::string_view kName = "comparison";
  // Of one kind for one world.
  struct Cell {
    StructureKind kind = StructureKind::none;
    StructureWork work;

    static decltype(auto) fields(const auto& r, auto&& v) { return v("kind", r.kind).flat(r.work); }
  };
  // A body, for a small picture of the world.
  struct Mark {
    Box<3> box;
    int color = 1;
    bool is_static = false;
  };
  struct Row {
    std::string name;
    std::string answer;  // counts filled in
    std::uint64_t bodies = 0;
    std::uint64_t testable = 0;  // pairs of them that brute force tests
    std::vector<Mark> marks;     // before the step
    std::vector<Cell> cells;

    const Cell* cell(StructureKind kind) const {
      const auto found = std::ranges::find(cells, kind, &Cell::kind);
      return found == cells.end() ? nullptr : &*found;
    }
    // Comparisons of the kind that needs fewest in a step. There is one cell at least.
    std::uint64_t least() const {
      return std::ranges::min_element(cells, {}, [](const Cell& c) { return c.work.step(); })
          ->work.step();
    }

    static decltype(auto) fields(const auto& r, auto&& v) {
      return v("row", r.name)("answer", r.answer)("bodies", r.bodies)("testable_pairs", r.testable)(
                 "kinds", r.cells)
          .drawn(r.marks);
    }
  };

  std::vector<StructureKind> kinds;    // the columns, of the whole script
  std::vector<std::string> all_names;  // of the rows, of the whole script
  std::vector<Row> rows;               // so far

  static decltype(auto) fields(const auto& r, auto&& v) {
    return v.when(!r.rows.empty(), "comparison", r.rows).drawn(r.kinds, r.all_names);
  }
};

}  // namespace lantern::frame
