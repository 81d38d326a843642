// Which branches of a tree are shown when it is too large for its panel. Folding goes before
// layout, so that the cost is linear in the nodes and the layout only ever sees what fits on a
// panel.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "scenario/frame.hpp"

namespace lantern {

// One mark of the diagram.
struct Branch {
  enum class Kind {
    node,     // a node as it is
    empties,  // `count` empty leaves of one parent
    folded,   // a node, and `count` more that are not shown
    levels,   // `count` levels of the lit path that are not shown
  };
  Kind kind = Kind::node;
  std::uint32_t node = 0;        // index in the frame's nodes; the first of those it stands for
  std::uint32_t parent = kNone;  // index among the branches
  std::uint32_t row = 0;
  std::uint32_t count = 0;
  std::uint32_t copies = 1;  // equal subtrees of one parent that this one stands for; 0 when it
                             // stands for unlike ones
  Mark mark = Mark::quiet;   // the strongest of all that it stands for
  bool each = false;         // stands below equal subtrees, so that its count is for each of them
};

class TreeFold {
 public:
  // The frame must outlive this.
  explicit TreeFold(const Frame& frame);

  // Every node, parents before children, children in order.
  std::vector<Branch> whole() const;
  std::uint32_t rows() const { return rows_; }

  // At most `rows` (4 or more) rows. Empty leaves and equal subtrees of one parent become one
  // branch; the path to the deepest lit leaf is open; of the rest as much is opened, level by level
  // and what is lit first, as `fits` allows.
  using Fits = std::function<bool(const std::vector<Branch>&)>;
  std::vector<Branch> condensed(std::uint32_t rows, const Fits& fits) const;

 private:
  struct Opening;
  std::vector<std::uint32_t> spine() const;
  Branch branch_for(std::uint32_t node, std::uint32_t copies, const Opening& opening) const;
  std::vector<Branch> build(const Opening& opening) const;
  void add_children(std::uint32_t at, const Opening& opening, std::vector<Branch>& list) const;
  void open_rows(Opening& opening, std::vector<Branch>& list, const Fits& fits) const;

  const std::vector<FrameNode>& nodes_;
  std::uint32_t rows_ = 0;
  std::vector<std::vector<std::uint32_t>> children_;
  std::vector<std::uint32_t> size_;   // nodes of each subtree
  std::vector<Mark> mark_;            // the strongest of each subtree
  std::vector<std::uint64_t> shape_;  // equal for subtrees that look alike
};

}  // namespace lantern
