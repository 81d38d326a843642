// What a structure of a user's own (own_structure.hpp) says of itself, taken down in one visit and
// looked at. From then on only this is read, so that whatever it says, nothing of ours loops or
// reads what is not there.
//
// What cannot be read as a tree is thrown: a box that is not finite, a depth that does not follow,
// a child of a leaf, more nodes than can be meant, an exception of its own. What can be read, but
// is not so, is noted, so that it can still be drawn: each of `faults()` names the node by its way
// from the root and says what was expected.
#pragma once

#include <cstdint>
#include <exception>
#include <new>
#include <span>
#include <string>
#include <vector>

#include "base/attempt.hpp"
#include "spatial/own_structure.hpp"

namespace lantern::spatial {

// What is known of the tree without asking it.
struct OwnRules : StructureConfig<2> {
  std::string name;  // of its kind
};

class OwnView {
 public:
  struct Node {
    Box<2> box;
    std::uint32_t parent = kNone;
    std::uint32_t slot = 0;  // quarters of their parent as the lecture counts them; others as told
    std::uint32_t depth = 0;
    std::uint32_t end = 0;  // behind all that lies below it
    bool leaf = true;
    std::uint32_t first = 0;  // of its bodies
    std::uint32_t count = 0;
    NodeHandle handle = 0;         // that of the node in its place before, if there was one
    std::uint32_t before = kNone;  // its place in the view before
  };

  // A root that holds nothing.
  explicit OwnView(const Box<2>& bounds) : nodes_{{.box = bounds, .end = 1}} {}
  // Of the tree, into which these boxes were inserted, each under its place in the list. Throws
  // StructureFault.
  OwnView(const OwnTree& tree, const OwnRules& rules, std::span<const Box<2>> boxes,
          const OwnView& before);

  const std::vector<Node>& nodes() const { return nodes_; }  // parents before children
  std::span<const BodyId> bodies(const Node& node) const {   // ascending
    return std::span(bodies_).subspan(node.first, node.count);
  }
  // f(child) for each child of the node, in their order.
  template <class F>
  void each_child(std::uint32_t node, F&& f) const {
    for (std::uint32_t c = node + 1; c < nodes_[node].end; c = nodes_[c].end) f(c);
  }
  const std::vector<OwnFault>& faults() const { return faults_; }  // the first few
  // By how much edges may miss each other: some trees round more than ours.
  double slack() const { return slack_; }
  Counters counters() const;

  // What the last insertion must have done, by comparison with the view before: which nodes are
  // new, which became inner nodes, where the body lies. In what order, it does not say: parents
  // come before children.
  std::vector<Event> events_since(const OwnView& before, BodyId body, const OwnRules& rules) const;

 private:
  class Reader;
  class Inspection;
  std::string place_of(std::uint32_t node) const;
  void note(std::string text, std::uint32_t node, std::vector<BodyId> bodies = {});
  void keep_handles(const OwnView& before);

  std::vector<Node> nodes_;
  std::vector<BodyId> bodies_;
  std::vector<OwnFault> faults_;
  std::vector<std::uint32_t> fault_nodes_;  // what {n} stands for in each
  double slack_ = 0;
};

// Runs code that is not ours, a call about a body; `failed(words)` is told of what it throws.
template <class F, class Failed>
void run_own(const char* call, BodyId body, F&& f, Failed&& failed) {
  std::string words = "something that is no std::exception";
  try {
    const AttemptedCall tried(call, body);
    return f();
  } catch (const std::bad_alloc&) {
    words = "std::bad_alloc: it asked for more memory than there was";
  } catch (const std::exception& e) {
    words = e.what();
  } catch (...) {
  }
  failed(words);
}

// The box, grown on all sides.
inline Box<2> grown(const Box<2>& box, double by) { return {box.lo - by, box.hi + by}; }

}  // namespace lantern::spatial
