// What the frames of a sequence share on the page: collected over all of them before the first is
// drawn, so that what has not changed does not move.
#pragma once

#include <algorithm>
#include <any>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "draw/axis.hpp"
#include "draw/keys.hpp"
#include "frame/frame.hpp"
#include "frame/parts/panels.hpp"
#include "geometry/box.hpp"

namespace lantern::draw {

// way_of() each node: the same way on the next frame is the same node.
std::vector<std::string> ways_of(const std::vector<FrameNode>& nodes);

// One tree of a group: every node that any of the frames has, parents before children, children in
// order of their slots. `node` is a node as one of the frames shows it; `shown` are the forms of it
// that need different room, such as a leaf of one body and a leaf of four.
struct UnionNode {
  FrameNode node;  // its parent and id are of the union; a leaf if it is one on every frame
  std::string way;
  std::vector<FrameNode> shown;
};
struct UnionTree {
  bool of_static = false;
  bool complete = true;  // false: there were too many nodes to keep them all
  std::vector<UnionNode> nodes;
  std::map<std::string, std::uint32_t, std::less<>> index;  // by way

  std::uint32_t leaves() const;
  std::uint32_t rows() const;
  // Nothing for a node beyond those kept.
  const UnionNode* find(std::string_view way) const;
};

// What the axes of a sequence must hold, so that none of them changes from frame to frame: of all
// frames that it was shown. Nothing is known of what none of them has.
class AxisRanges {
 public:
  using Ends = std::optional<std::pair<double, double>>;

  void see(const frame::Frame& frame);
  Ends chart() const { return ends_of(chart_); }      // of charts' values
  Ends chart_x() const { return ends_of(chart_x_); }  // of what they are drawn against
  double trace() const { return trace_; }             // the most of a sparkline
  // All that come to be in the chart, or in this part of one that begins anew with each.
  const std::vector<frame::FrameBar>& bars(int part) const;
  // What is to come has no names: other bars may come than those that were seen.
  void forget_names();
  // That a part's sparkline goes on for.
  std::optional<double> seconds_of(const std::string& part) const;

 private:
  static Ends ends_of(const PlotRange& range) {
    return range.empty() ? Ends() : std::pair(range.least, range.most);
  }

  PlotRange chart_, chart_x_;
  std::map<int, std::vector<frame::FrameBar>> bars_;  // by part
  double trace_ = 0;
  std::map<std::string, double> seconds_;  // by part
};

class Staging {
 public:
  // A group of frames, in order. They must outlive this. `axes` are of all frames that share them.
  explicit Staging(std::span<const Frame> frames, const AxisRanges& axes = {})
      : Staging(each_of(frames), axes) {}
  explicit Staging(const Frame& frame) : Staging(std::vector{&frame}, {}) {}
  Staging(std::vector<const Frame*> frames, const AxisRanges& axes);

  // Belongs `next` to the group of `before`? It does while panels, structure and world stay; a new
  // part begins a group if its settings are others, or packs an atlas on.
  static bool is_one_group(const Frame& before, const Frame& next);
  // The group that the first of them begins.
  static std::span<const Frame> first_group(std::span<const Frame> frames);

  const std::vector<const Frame*>& frames() const { return frames_; }
  // At most so many of them, here and there.
  std::vector<const Frame*> some_frames(std::size_t most) const;

  // What the frames of one side share, by its name: with all sides of the same trees, so that
  // their trees can be compared node by node. Of a side that no frame has, this.
  const Staging& of_side(std::string_view side) const;
  // The one of the sides that has the most leaves: the page is arranged for it.
  const Staging& largest_side() const;

  // Of the structure: the tree of what moves, the one of what never does; those that there are.
  const std::vector<UnionTree>& trees() const { return trees_; }
  // Leaves that the trees come to have together, and the most that they have on one frame.
  std::uint32_t leaves() const;
  std::size_t most_leaves() const { return most_leaves_; }

  // Is this frame the first with its settings?
  bool tells_settings(const Frame& frame) const { return settings_told_.contains(frame.index); }

  const AxisRanges& axes() const { return axes_; }

  // Does the foot of some frame have this count?
  bool is_headed(std::string_view count) const {
    return std::ranges::any_of(frames_, [&](const Frame* frame) {
      return std::ranges::find(frame->headline, count) != frame->headline.end();
    });
  }

  // The largest that this count gets; 0 if no frame has it.
  std::int64_t most(const std::string& count) const;

  // What `make` gives, made once for all frames: `what` says what it is, `place` where. The same
  // words and place must always stand for the same.
  template <class T>
  const T& once(const std::string& what, const Box<2>& place,
                const std::function<T()>& make) const {
    const Place key{what, place.lo.x, place.lo.y, place.hi.x, place.hi.y};
    auto found = made_.find(key);
    if (found == made_.end()) found = made_.emplace(key, make()).first;
    return std::any_cast<const T&>(found->second);
  }

 private:
  static std::vector<const Frame*> each_of(std::span<const Frame> frames);
  void add_nodes(const Frame& frame);

  using Place = std::tuple<std::string, double, double, double, double>;

  std::vector<const Frame*> frames_;
  AxisRanges axes_;
  std::map<std::string, std::string, std::less<>> structure_of_;  // by side
  std::map<std::string, Staging, std::less<>> sides_;             // by structure
  std::vector<UnionTree> trees_;
  std::size_t most_leaves_ = 0;
  std::set<std::uint32_t> settings_told_;
  std::map<std::string, std::int64_t> most_;
  mutable std::map<Place, std::any> made_;
};

}  // namespace lantern::draw
