#include "spatial/own_inspection.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "base/stop.hpp"
#include "spatial/sort_and_sweep.hpp"

namespace lantern::spatial {
namespace {

std::string text_of(const Box<2>& box) {
  return fmt::format("[{:.6g}, {:.6g}] to [{:.6g}, {:.6g}]", box.lo.x, box.lo.y, box.hi.x,
                     box.hi.y);
}

bool lies_within(const Box<2>& box, const Box<2>& outer) {
  return contains(outer, box.lo) && contains(outer, box.hi);
}

// What of the box is left away from its borders, by more than what rounding may do; not valid if
// that is nothing.
Box<2> core_of(const Box<2>& box, double slack) { return grown(box, -slack); }

}  // namespace

void OwnInspection::inspect() {
  inspect_cells();
  inspect_lists();
  for (BodyId body = 0; body < boxes_.size(); ++body)
    if (is_listed_where_it_reaches(body)) require_covered(body);
  inspect_pairs();
}

void OwnInspection::inspect_cells() {
  const auto& nodes = view_.nodes_;
  const Box<2> root = grown(nodes[0].box, view_.slack_);
  if (!lies_within(rules_.bounds, root))
    view_.note({fmt::format("{{n}} goes from {}, but the world from {}; it must hold the world",
                            text_of(nodes[0].box), text_of(rules_.bounds)),
                {},
                0});
  for (std::uint32_t i = 0; i < nodes.size(); ++i) {
    const OwnView::Node& node = nodes[i];
    if (node.parent != kNone && !lies_within(node.box, grown(nodes[node.parent].box, view_.slack_)))
      view_.note({fmt::format("{{n}} goes from {}, which is not within its parent, from {}",
                              text_of(node.box), text_of(nodes[node.parent].box)),
                  {},
                  i});
    if (!node.leaf) inspect_siblings(i);
    if (!node.leaf && node.end == i + 1)
      view_.note({"{n} is told as an inner node, but no child of it follows", {}, i});
  }
}

void OwnInspection::inspect_siblings(std::uint32_t parent) {
  const auto& nodes = view_.nodes_;
  for (std::uint32_t a = parent + 1; a < nodes[parent].end; a = nodes[a].end)
    for (std::uint32_t b = nodes[a].end; b < nodes[parent].end; b = nodes[b].end)
      if (is_valid(core_of(common_part(nodes[a].box, nodes[b].box), view_.slack_)))
        return view_.note(
            {fmt::format("{{n}} overlaps its sibling {}: it goes from {}, the other "
                         "from {}; children must not overlap",
                         view_.way_to(a), text_of(nodes[b].box), text_of(nodes[a].box)),
             {},
             b});
}

// Whom leaves list: only who reaches them.
void OwnInspection::inspect_lists() {
  const auto& nodes = view_.nodes_;
  for (std::uint32_t i = 0; i < nodes.size(); ++i)
    for (const BodyId body : view_.bodies(nodes[i])) {
      leaves_[body].push_back(i);
      if (!overlap(boxes_[body], grown(nodes[i].box, view_.slack_)))
        view_.note({fmt::format("{{n}}, from {}, lists {{0}}, which does not reach it: its box "
                                "goes from {}",
                                text_of(nodes[i].box), text_of(boxes_[body])),
                    {body},
                    i});
    }
}

// Each leaf that it reaches by more than a border must list it; of those that it only touches,
// any one will do.
bool OwnInspection::is_listed_where_it_reaches(BodyId body) {
  stop_if_asked();
  const auto& nodes = view_.nodes_;
  if (leaves_[body].empty()) {
    view_.note({fmt::format("no leaf lists {{0}}, whose box goes from {}", text_of(boxes_[body])),
                {body}});
    return false;
  }
  for (std::uint32_t i = 0; i < nodes.size();) {
    if (!overlap(boxes_[body], nodes[i].box)) {
      i = nodes[i].end;
      continue;
    }
    const Box<2> core = core_of(nodes[i].box, view_.slack_);
    if (nodes[i].leaf && is_valid(core) && overlap(core, boxes_[body]) &&
        !std::ranges::binary_search(leaves_[body], i)) {
      view_.note({fmt::format("{{n}}, from {}, does not list {{0}}, which reaches it: its box goes "
                              "from {}; listed in {}",
                              text_of(nodes[i].box), text_of(boxes_[body]), leaves_of(body)),
                  {body},
                  i});
      return false;
    }
    ++i;
  }
  return true;
}

// Leaves that list it must cover it, or a part of it lies nowhere: where a child was not made. What
// is as thin as rounding is measured along its length only.
void OwnInspection::require_covered(BodyId body) {
  constexpr double kThin = 1000, kMissing = 1e-3;
  const Box<2>& box = boxes_[body];
  double whole = 1, covered = 0;
  for (int i = 0; i < 2; ++i)
    if (box.size()[i] > kThin * view_.slack_) whole *= box.size()[i];
  for (const std::uint32_t leaf : leaves_[body]) {
    const Box<2> part = common_part(box, grown(view_.nodes_[leaf].box, view_.slack_));
    double size = is_valid(part) ? 1 : 0;
    for (int i = 0; i < 2; ++i)
      if (box.size()[i] > kThin * view_.slack_) size *= part.size()[i];
    covered += size;
  }
  if (covered < whole * (1 - kMissing))
    view_.note({fmt::format("a part of {{0}} lies in no leaf: its box goes from {}, and it is "
                            "listed in {}, which do not cover it",
                            text_of(box), leaves_of(body)),
                {body}});
}

// What it is all for: the first that is missed is told even if there is much else to tell.
void OwnInspection::inspect_pairs() {
  SortAndSweep<2> sweep;
  bool told = false;
  for (BodyId body = 0; body < boxes_.size(); ++body) sweep.insert({body, boxes_[body]});
  sweep.sweep([&](BodyId a, BodyId b) {
    if (told || share_a_leaf(a, b)) return;
    told = true;
    if (a > b) std::swap(a, b);
    view_.faults_.push_back(
        {fmt::format("{{0}} and {{1}} overlap, but share no leaf: {{0}} is listed in {}, {{1}} in "
                     "{}; their pair is missed",
                     leaves_of(a), leaves_of(b)),
         {a, b}});
  });
}

bool OwnInspection::share_a_leaf(BodyId a, BodyId b) const {
  auto i = leaves_[a].begin(), j = leaves_[b].begin();
  while (i != leaves_[a].end() && j != leaves_[b].end()) {
    if (*i == *j) return true;
    ++(*i < *j ? i : j);
  }
  return false;
}

std::string OwnInspection::leaves_of(BodyId body) const {
  constexpr std::size_t kMost = 4;
  std::string text;
  for (std::size_t i = 0; i < std::min(leaves_[body].size(), kMost); ++i)
    text += (i > 0 ? ", " : "") + view_.way_to(leaves_[body][i]);
  if (leaves_[body].size() > kMost)
    text += fmt::format(" and {} more", leaves_[body].size() - kMost);
  return text.empty() ? "no leaf" : text;
}

}  // namespace lantern::spatial
