// What a frame counts, and what else a caption may quote.
#include "scenario/language.hpp"

namespace lantern {
namespace {

constexpr CountDoc kCounts[] = {
    {"bodies", "Bodies in the world.", true, false, false},
    {"nodes", "Nodes of the tree.", true, true, true},
    {"leaves", "Nodes without children.", true, true, true},
    {"depth", "Depth of the deepest node; the root has depth 0.", true, true, true},
    {"entries", "Bodies stored in leaves, each once a leaf.", true, false, true},
    {"most_in_leaf", "Bodies in the fullest leaf.", true, false, true},
    {"pairs", "Unique candidate pairs: bodies that share a leaf.", true, false, true},
    {"pair_tests", "Pairs met, leaf by leaf, before duplicates fell out.", true, false, true},
    {"all_pairs", "What brute force would test: n(n−1)/2 pairs of n bodies.", true, false, false},
    {"overlaps", "Candidate pairs whose boxes overlap.", true, false, true},
    {"contacts", "Pairs that really touch; 0 as long as there is no narrow phase.", true, false,
     true},
    {"box_tests", "Tests of a body against a node or plane since the tree was built.", true, false,
     true},
    {"splits", "Leaves that split since the tree was built.", true, false, true},
    {"nodes_reused", "Nodes that took an old node's place instead of new memory.", true, false,
     true},
    {"allocations", "Calls for memory since the structure was made.", true, false, true},
    {"textures", "Textures packed.", false, true, false},
    {"refused", "Textures that fit nowhere.", false, true, false},
    {"used_area", "Pixels under textures.", false, true, false},
    {"free_area", "Pixels left free.", false, true, false},
    {"atlas_area", "Pixels of the atlas.", false, true, false},
    {"free_leaves", "Leaves without a texture.", false, true, false},
    {"leaf_tests", "Leaves looked at, by packing and by questions for room.", false, true, false},
    {"room", "1 if the last `ask_room` found room, 0 if not.", false, true, false},
};

constexpr CountDoc kTexts[] = {
    {"texture", "The texture that the frame is about.", false, true, false},
    {"refused_names", "Names of the textures that were refused, or \"none\".", false, true, false},
    {"time", "Seconds of world time, with two decimals.", true, false, false},
};

}  // namespace

std::span<const CountDoc> known_counts() { return kCounts; }
std::span<const CountDoc> known_texts() { return kTexts; }

}  // namespace lantern
