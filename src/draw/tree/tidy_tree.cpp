#include <algorithm>

#include "base/stop.hpp"
#include "draw/tree/tree_layout.hpp"

namespace lantern::draw {
namespace {

using Index = std::uint32_t;
constexpr Index kNobody = 0xffffffff;

// The names are those of the paper: a node's place is the sum of `prelim` and the `mod` of all its
// ancestors; `thread` leads on along the contour of a subtree that ends; `shift` and `change`
// spread a move over the subtrees in between.
struct PlacedNode {
  std::vector<Index> children;
  Index number = 0;  // among its siblings
  Index thread = kNobody;
  Index ancestor = kNobody;
  double prelim = 0, mod = 0, shift = 0, change = 0;
};

class Tidy {
 public:
  Tidy(std::span<const TidyNode> nodes, double gap) : in_(nodes), gap_(gap), at_(nodes.size()) {
    for (Index v = 0; v < nodes.size(); ++v) {
      at_[v].ancestor = v;
      if (v == 0) continue;
      auto& siblings = at_[nodes[v].parent].children;
      at_[v].number = static_cast<Index>(siblings.size());
      siblings.push_back(v);
    }
  }

  std::vector<double> run() {
    std::vector<double> x(in_.size());
    if (in_.empty()) return x;
    first_walk(0, kNobody);
    std::vector<double> mods(in_.size());
    double left = 0;
    for (Index v = 0; v < in_.size(); ++v) {
      if (v > 0) mods[v] = mods[in_[v].parent] + at_[in_[v].parent].mod;
      x[v] = at_[v].prelim + mods[v];
      const double edge = x[v] - in_[v].width / 2;
      left = v == 0 ? edge : std::min(left, edge);
    }
    for (double& place : x) place -= left;
    return x;
  }

 private:
  double distance(Index left, Index right) const {
    return (in_[left].width + in_[right].width) / 2 + gap_;
  }
  Index next_left(Index v) const {
    return at_[v].children.empty() ? at_[v].thread : at_[v].children.front();
  }
  Index next_right(Index v) const {
    return at_[v].children.empty() ? at_[v].thread : at_[v].children.back();
  }

  void first_walk(Index v, Index left_sibling) {
    stop_if_asked();
    Index default_ancestor = at_[v].children.empty() ? kNobody : at_[v].children.front();
    Index last = kNobody;
    for (const Index child : at_[v].children) {
      first_walk(child, last);
      default_ancestor = apportion(child, last, default_ancestor);
      last = child;
    }
    execute_shifts(v);
    PlacedNode& p = at_[v];
    const double beside =
        left_sibling == kNobody ? 0 : at_[left_sibling].prelim + distance(left_sibling, v);
    p.prelim = beside;
    if (p.children.empty()) return;
    const double middle = (at_[p.children.front()].prelim + at_[p.children.back()].prelim) / 2;
    if (left_sibling == kNobody)
      p.prelim = middle;
    else
      p.mod = beside - middle;
  }

  // Moves the subtree of v right until it clears those of its left siblings, following the facing
  // contours down together. i: inside, o: outside; p (plus): of v, m (minus): of the left ones.
  Index apportion(Index v, Index left_sibling, Index default_ancestor) {
    if (left_sibling == kNobody) return default_ancestor;
    Index ip = v, op = v, im = left_sibling;
    Index om = at_[in_[v].parent].children.front();
    double sip = at_[ip].mod, sop = at_[op].mod, sim = at_[im].mod, som = at_[om].mod;
    while (next_right(im) != kNobody && next_left(ip) != kNobody) {
      im = next_right(im);
      ip = next_left(ip);
      om = next_left(om);
      op = next_right(op);
      at_[op].ancestor = v;
      const double push = (at_[im].prelim + sim) - (at_[ip].prelim + sip) + distance(im, ip);
      if (push > 0) {
        const Index a = at_[im].ancestor;
        const bool is_sibling = in_[a].parent == in_[v].parent && a != 0;
        move_subtree(is_sibling ? a : default_ancestor, v, push);
        sip += push;
        sop += push;
      }
      sim += at_[im].mod;
      sip += at_[ip].mod;
      som += at_[om].mod;
      sop += at_[op].mod;
    }
    if (next_right(im) != kNobody && next_right(op) == kNobody) {
      at_[op].thread = next_right(im);
      at_[op].mod += sim - sop;
    }
    if (next_left(ip) != kNobody && next_left(om) == kNobody) {
      at_[om].thread = next_left(ip);
      at_[om].mod += sip - som;
      default_ancestor = v;
    }
    return default_ancestor;
  }

  void move_subtree(Index from, Index v, double push) {
    const double between = at_[v].number - at_[from].number;
    at_[v].change -= push / between;
    at_[v].shift += push;
    at_[from].change += push / between;
    at_[v].prelim += push;
    at_[v].mod += push;
  }

  void execute_shifts(Index v) {
    double shift = 0, change = 0;
    for (auto child = at_[v].children.rbegin(); child != at_[v].children.rend(); ++child) {
      PlacedNode& c = at_[*child];
      c.prelim += shift;
      c.mod += shift;
      change += c.change;
      shift += c.shift + change;
    }
  }

  std::span<const TidyNode> in_;
  double gap_;
  std::vector<PlacedNode> at_;
};

}  // namespace

std::vector<double> tidy_tree(std::span<const TidyNode> nodes, double gap) {
  return Tidy(nodes, gap).run();
}

}  // namespace lantern::draw
