#include "draw/count_words.hpp"

#include <algorithm>

#include "draw/panels.hpp"

namespace lantern::draw {
namespace {

// Those whose words do not follow from the name.
constexpr struct {
  std::string_view name, one, many;
} kWords[] = {
    {"bodies", "body", "bodies"},
    {"leaves", "leaf", "leaves"},
    {"entries", "entry", "entries"},
    {"depth", "level deep", "levels deep"},
    {"most_in_leaf", "in the fullest leaf", "in the fullest leaf"},
    {"all_pairs", "pair in all", "pairs in all"},
    {"testable_pairs", "by brute force", "by brute force"},
    {"pair_tests", "pair met", "pairs met"},
    {"overlaps", "overlap of boxes", "overlaps of boxes"},
    {"pairs_tested", "pair tested", "pairs tested"},
    {"contact_points", "contact point", "contact points"},
    {"impact_looks", "look for the impact", "looks for the impact"},
    {"impacts_located", "impact located", "impacts located"},
    {"reinserted", "body inserted again", "bodies inserted again"},
    {"refitted", "box made anew", "boxes made anew"},
    {"crushes", "crush", "crushes"},
    {"begins", "contact begun", "contacts begun"},
    {"ends", "contact ended", "contacts ended"},
    {"begins_in_all", "begin", "begins"},
    {"touches_in_all", "touch", "touches"},
    {"collisions_alive", "collision alive", "collisions alive"},
    {"asleep", "asleep", "asleep"},
    {"awake", "awake", "awake"},
    {"islands_asleep", "island asleep", "islands asleep"},
    {"stale", "out of its cell", "out of their cells"},
    {"static_builds", "static build", "static builds"},
    {"dynamic_builds", "dynamic build", "dynamic builds"},
    {"nodes_asleep", "node asleep", "nodes asleep"},
    {"leaves_asleep", "leaf asleep", "leaves asleep"},
    {"branches_asleep", "branch asleep", "branches asleep"},
    {"nodes_reused", "node reused", "nodes reused"},
    {"node_bytes", "byte of nodes", "bytes of nodes"},
    {"node_bytes_with_bounds", "byte with bounds", "bytes with bounds"},
    {"nodes_visited", "node visited", "nodes visited"},
    {"nodes_skipped", "node left out", "nodes left out"},
    {"objects_tested", "body tested", "bodies tested"},
    {"shapes_tested", "pair tested", "pairs tested"},
    {"narrow_work", "length measured", "lengths measured"},
    {"touching", "pair touches", "pairs touch"},
    {"axes_tested", "axis tested", "axes tested"},
    {"gjk_steps", "search", "searches"},
    {"plane_score", "score", "score"},
    {"first_wall_score", "the first wall's score", "the first wall's score"},
    {"sector", "sector", "sector"},
    {"planes_tested", "line asked", "lines asked"},
    {"lines_tried", "line tried", "lines tried"},
    {"bodies_here", "in this sector", "in this sector"},
    {"portals_tested", "portal tested", "portals tested"},
    {"sector_pairs", "pair of sectors", "pairs of sectors"},
    {"visible_pairs", "pair sees each other", "pairs see each other"},
    {"sectors_seen", "sector seen", "sectors seen"},
    {"bodies_seen", "body seen", "bodies seen"},
    {"tests_so_far", "test so far", "tests so far"},
    {"refused", "refused", "refused"},
    {"used_area", "pixel used", "pixels used"},
    {"free_area", "pixel free", "pixels free"},
    {"atlas_area", "pixel in all", "pixels in all"},
    {"free_leaves", "free leaf", "free leaves"},
    {"leaf_tests", "leaf looked at", "leaves looked at"},
    {"room", "has room", "has room"},
    {"compared_bodies", "body compared", "bodies compared"},
    {"compared_pairs", "by brute force", "by brute force"},
    {"compared_overlaps", "overlap of boxes", "overlaps of boxes"},
    {"least_work", "comparison a step", "comparisons a step"},
};

}  // namespace

std::string count_words(std::string_view name, bool one) {
  if (const auto* row = std::ranges::find_if(kWords, [&](const auto& r) { return r.name == name; });
      row != std::end(kWords))
    return std::string(one ? row->one : row->many);
  std::string words = chart_words(std::string(name));
  if (one && words.ends_with('s')) words.pop_back();
  return words;
}

}  // namespace lantern::draw
