// What is lit on a frame: its cause, and no more.
#pragma once

#include <cstdint>
#include <set>
#include <vector>

#include "frame/frame.hpp"

namespace lantern::run {

// Why there is a frame.
struct Cause {
  const VerbTraits& verb;
  const std::set<BodyId>& focus;  // the bodies that the step is about
  bool midst = false;             // in the midst of the algorithm; else what it has led to
};

// A step lights the bodies that it is about, the leaves that hold them and, as passed, the way to
// them. When it is about many, or about all that can move, only nodes and pairs are lit that are
// new. The first frame of a run lights nothing: all of it is new.
class Lighting {
 public:
  // Nodes that are marked already were watched at work and stay as they are.
  void light(const Cause& cause, Frame& frame) const;

  // The next frame's news are what this one does not have.
  void remember(const Frame& frame, bool midst);

 private:
  void light_nodes(const Cause& cause, bool few, Frame& frame) const;
  void light_pairs(bool few, Frame& frame) const;
  void light_edges(Frame& frame) const;

  std::vector<Pair> pairs_;            // of the last frame, ascending
  std::vector<Pair> edges_;            // the same
  std::vector<std::uint64_t> places_;  // of nodes, of the last frame that was not in the midst
};

}  // namespace lantern::run
