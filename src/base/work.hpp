// What a run really did, stage by stage. A stage that a scene does not need leaves its counter at
// zero: the promise "leave out what is not needed", in numbers.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <string_view>
#include <utility>

namespace lantern {

struct Work {
  std::atomic<std::uint64_t> worlds_created{0};
  std::atomic<std::uint64_t> world_steps{0};
  std::atomic<std::uint64_t> structures_created{0};
  std::atomic<std::uint64_t> structure_builds{0};  // of what may move, or of all bodies
  std::atomic<std::uint64_t> static_builds{0};     // of the one apart, for what never moves
  std::atomic<std::uint64_t> pair_searches{0};     // for frames, beside those of the world
  std::atomic<std::uint64_t> pairs_found{0};       // by them
  std::atomic<std::uint64_t> queries{0};
  std::atomic<std::uint64_t> atlases_created{0};
  std::atomic<std::uint64_t> world_layouts{0};
  std::atomic<std::uint64_t> tree_layouts{0};
  std::atomic<std::uint64_t> graphics_contexts{0};
  std::atomic<std::uint64_t> frames_drawn{0};
  std::atomic<std::uint64_t> frames_encoded{0};
  std::atomic<std::uint64_t> in_betweens{0};  // drawn or not: of two frames, by draw/tween.hpp

  // Of all that, what was really done: not listed, since it depends on which frame came before.
  std::atomic<std::uint64_t> pixels_drawn{0};
  std::atomic<std::uint64_t> bands_packed{0};  // of rows of a picture
  std::atomic<std::uint64_t> bands_kept{0};    // as they were packed for the picture before

  // Beside the run, of which nothing of them is: to find out what would be quicker (app/trial.hpp).
  std::atomic<std::uint64_t> trial_worlds{0};

  // How much of it stands on the disk, for whoever tells of a long run; not listed, since it
  // depends on what was there before.
  std::atomic<std::uint64_t> frames_written{0};
  std::atomic<std::uint64_t> bytes_written{0};

  // Name and count of each stage, in the order of a run.
  std::array<std::pair<std::string_view, std::uint64_t>, 15> listed() const {
    return {{{"worlds_created", worlds_created},
             {"world_steps", world_steps},
             {"structures_created", structures_created},
             {"structure_builds", structure_builds},
             {"static_builds", static_builds},
             {"pair_searches", pair_searches},
             {"pairs_found", pairs_found},
             {"queries", queries},
             {"atlases_created", atlases_created},
             {"world_layouts", world_layouts},
             {"tree_layouts", tree_layouts},
             {"graphics_contexts", graphics_contexts},
             {"frames_drawn", frames_drawn},
             {"frames_encoded", frames_encoded},
             {"in_betweens", in_betweens}}};
  }
};

}  // namespace lantern
