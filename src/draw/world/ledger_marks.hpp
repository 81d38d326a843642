// The marks of the pair ledger, and its picture when there are too many bodies for a cell a pair.
#pragma once

#include <cstddef>

#include "draw/labels.hpp"
#include "frame/frame.hpp"
#include "frame/pair_state.hpp"

namespace lantern::draw {

// With more bodies than this pairs have no cells of their own.
inline constexpr std::size_t kMostLedgerBodies = 40;

// What says in a cell how far a pair came. States differ in shape, so that they can be told apart
// in grey and in any size; one that is new is lit.
void draw_pair_mark(frame::PairState state, bool is_new, const Box<2>& cell, DrawList& list);

// All pairs in bins of bodies that follow each other: a square on each, the larger the greater
// the share of its pairs that the broad phase handed on, and a scale beside it.
void draw_pair_density(const Frame& frame, const Box<2>& place, DrawList& list, Labels& labels);

}  // namespace lantern::draw
