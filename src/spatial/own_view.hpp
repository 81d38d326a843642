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
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "spatial/own_structure.hpp"

namespace lantern::spatial {

struct OwnFault {
  std::string text;                 // "{n} does not list {0}, …"
  std::vector<BodyId> bodies = {};  // whom {0} and {1} stand for
  std::uint32_t node = kNone;       // what {n} stands for, in the view; filled in when it is told
};

// With the bodies called so. "{n}" must be filled in already.
std::string text_of(const OwnFault& fault, const std::function<std::string(BodyId)>& name_of);

// A structure that cannot be used any further.
class StructureFault : public std::runtime_error {
 public:
  explicit StructureFault(OwnFault fault);
  const OwnFault& fault() const { return fault_; }

 private:
  OwnFault fault_;
};

// What is known of the tree without asking it.
struct OwnRules {
  std::string name;  // of its kind
  Box<2> bounds;
  std::uint32_t capacity = 0;
  std::uint32_t max_depth = 0;
  std::uint64_t most_entries = 0;  // and nodes
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
  static constexpr std::uint32_t kMostChildren = 4096;

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
  const std::vector<OwnFault>& faults() const { return faults_; }  // the first few
  static constexpr std::size_t kMostFaults = 3;
  // By how much edges may miss each other: some trees round more than ours.
  double slack() const { return slack_; }
  std::string way_to(std::uint32_t node) const;  // "root", "1.3"
  Counters counters() const;

  // What the last insertion must have done, by comparison with the view before: which nodes are
  // new, which became inner nodes, where the body lies. In what order, it does not say: parents
  // come before children.
  std::vector<Event> events_since(const OwnView& before, BodyId body, const OwnRules& rules) const;

 private:
  friend class OwnCollector;
  friend class OwnInspection;
  void keep_handles(const OwnView& before);
  void note(OwnFault fault);

  std::vector<Node> nodes_;
  std::vector<BodyId> bodies_;
  std::vector<OwnFault> faults_;
  double slack_ = 0;
};

// The box, grown on all sides.
inline Box<2> grown(const Box<2>& box, double by) { return {box.lo - by, box.hi + by}; }

}  // namespace lantern::spatial
