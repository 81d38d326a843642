#include "draw/tree_layout.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "draw/font.hpp"
#include "draw/panels.hpp"
#include "draw/tidy_tree.hpp"

namespace lantern::draw {
namespace {

// Trees of a few levels may be drawn larger than others.
constexpr double kScales[] = {1.8, 1.65, 1.5, 1.35, 1.2, 1.1, 1.0, 0.88, 0.76, 0.66, 0.57, 0.5};
constexpr double kLargest = 1.2;
constexpr std::uint32_t kFewRows = 3;
constexpr double kSmallest = 0.4;     // for a path that must stay open
constexpr double kComfortable = 0.6;  // while a condensed tree is opened
constexpr std::size_t kMostBranches = 300;
constexpr double kUnderLeaf = 28;    // for the label under the last row
constexpr double kBetweenRows = 34;  // at least; a leaf's label and an edge's elbow fit in
constexpr double kElbow = 8.5;       // over a box, clear of the card behind a pile
constexpr double kLeastFan = 34;     // height in which slanting edges are still told apart
constexpr double kLeastHeight = 28;  // of a box
constexpr std::uint32_t kLeastRows = 4;

double width_of(const Branch& branch, const Frame& frame, const TreeScale& scale,
                const TreeWords& words) {
  const BranchText content = text_of(branch, frame, scale, words);
  if (branch.kind == Branch::Kind::levels)  // the text stands beside a line
    return 2 * (text_width(content.text, scale.text, Weight::regular) + 16);
  const auto icons = static_cast<double>(content.icons);
  double width = icons > 0 ? icons * (scale.icon + 5) - 5 : 0;
  if (!content.text.empty())
    width += text_width(content.text, scale.text, Weight::semibold) + (icons > 0 ? 6 : 0);
  return std::max(scale.box_width, width + 0.42 * scale.icon + 6);
}

std::uint32_t row_count(const std::vector<Branch>& branches) {
  return branches.empty() ? 0 : std::ranges::max(branches, {}, &Branch::row).row + 1;
}

// That a panel of this height has room for; on a very low one rows stand closer.
std::uint32_t most_rows(double height) {
  const double rows = (height - kUnderLeaf + kBetweenRows) / (kLeastHeight + kBetweenRows);
  return static_cast<std::uint32_t>(std::clamp(rows, double(kLeastRows), 1000.0));
}

double full_height(double s) { return 50 * s; }

struct Spread {
  std::vector<double> x, widths;
  double width = 0;
};

Spread spread(const std::vector<Branch>& branches, const Frame& frame, const TreeScale& scale,
              const TreeWords& words) {
  Spread s;
  std::vector<TidyNode> nodes;
  for (const Branch& branch : branches) {
    nodes.push_back({branch.parent, width_of(branch, frame, scale, words)});
    s.widths.push_back(nodes.back().width);
  }
  s.x = tidy_tree(nodes, scale.gap);
  for (std::size_t i = 0; i < s.x.size(); ++i)
    s.width = std::max(s.width, s.x[i] + s.widths[i] / 2);
  return s;
}

bool fits(const std::vector<Branch>& branches, const Frame& frame, const Box<2>& panel, double s,
          const TreeWords& words = {}) {
  const Vec<2> room = panel.size();
  const std::uint32_t rows = row_count(branches);
  if (branches.size() > kMostBranches || rows > most_rows(room.y)) return false;
  const TreeScale scale(s, rows, room.y);
  if (s > kLargest) {
    const double airy = (2 * rows - 1) * full_height(s) + scale.under;
    if (rows > kFewRows || airy > room.y) return false;
  }
  return spread(branches, frame, scale, words).width <= room.x;
}

// As many words as there is room for without drawing anything smaller.
TreeWords best_words(const std::vector<Branch>& branches, const Frame& frame, const Box<2>& panel,
                     double s) {
  for (const TreeWords words : {TreeWords{true, true}, {false, true}, {true, false}})
    if (fits(branches, frame, panel, s, words)) return words;
  return {};
}

// The largest scale at which they fit; 0 if none.
double best_scale(const std::vector<Branch>& branches, const Frame& frame, const Box<2>& panel) {
  for (const double s : kScales)
    if (fits(branches, frame, panel, s)) return s;
  return fits(branches, frame, panel, kSmallest) ? kSmallest : 0;
}

// Condensed until it fits: the path that must stay open may be drawn small, the rest is opened only
// as far as it stays comfortable; on a narrow panel levels are left out one after another.
std::vector<Branch> condensed(const TreeFold& fold, const Frame& frame, const Box<2>& panel) {
  std::vector<Branch> branches;
  for (std::uint32_t rows = most_rows(panel.size().y); rows >= kLeastRows; --rows) {
    bool path_alone = true;
    branches = fold.condensed(rows, [&](const std::vector<Branch>& tried) {
      const double s = path_alone ? kSmallest : kComfortable;
      path_alone = false;
      return fits(tried, frame, panel, s);
    });
    if (fits(branches, frame, panel, kSmallest)) break;
  }
  return branches;
}

void place(const Frame& frame, const Box<2>& panel, double s, TreeLayout& layout) {
  const std::uint32_t rows = row_count(layout.branches);
  layout.scale = TreeScale(s, rows, panel.size().y);
  layout.words = best_words(layout.branches, frame, panel, s);
  const Spread sideways = spread(layout.branches, frame, layout.scale, layout.words);
  const double around = layout.scale.box_height + layout.scale.under;
  const double most = 165 * std::max(rows <= kFewRows ? 1.2 : 1.0, s / kLargest);
  const double pitch = rows < 2 ? 0 : std::min(most, (panel.size().y - around) / (rows - 1));
  const double spare = panel.size().y - (rows - 1) * pitch - around;
  const double left = panel.center().x - sideways.width / 2;
  // A larger tree from the top, so that the root stays in its place while it grows.
  const double top = panel.lo.y + (rows <= kFewRows ? std::max(spare / 2, 0.0)
                                                    : std::clamp(spare * 0.42, 0.0, 44.0));
  for (std::size_t i = 0; i < layout.branches.size(); ++i) {
    const Vec<2> center{left + sideways.x[i],
                        top + layout.branches[i].row * pitch + layout.scale.box_height / 2};
    layout.boxes.push_back(
        Box<2>::around(center, Vec<2>(sideways.widths[i], layout.scale.box_height) * 0.5));
  }
  std::vector<bool> labelled(rows);
  for (const Branch& branch : layout.branches)
    if (has_label_below(branch, frame)) labelled[branch.row] = true;
  for (const Branch& branch : layout.branches)
    if (branch.row > 0 && labelled[branch.row - 1]) layout.labels_between = true;
}

}  // namespace

TreeScale::TreeScale(double s, std::uint32_t rows, double height)
    : box_width(std::max(kLeastNode, 84 * s)),
      box_height(std::clamp((height - kUnderLeaf - kBetweenRows * (rows - 1)) / rows, kLeastHeight,
                            std::max(kLeastHeight, full_height(s)))),
      gap(std::max(9.0, 34 * s)),
      icon(std::min(std::max(18.0, 31 * s), box_height - 8)),
      radius(std::max(6.0, 9 * s)),
      text(std::clamp(20 * s, kLeastLabel + 0.4, 30.0)),
      label(std::clamp(text, 17.5, std::clamp(18.5 * s / kLargest, 18.5, 24.0))),
      under(label + kUnderLeaf - 18.5) {}

std::string short_label(const std::string& label) {
  const std::size_t dot = label.rfind('.');
  return dot == std::string::npos ? std::string() : "…" + label.substr(dot + 1);
}

bool is_long_way(const std::string& label) {
  return std::count(label.begin(), label.end(), '.') > 2;
}

bool has_label_below(const Branch& branch, const Frame& frame) {
  const FrameNode& node = frame.nodes[branch.node];
  if (branch.kind == Branch::Kind::folded) return true;
  if (branch.kind != Branch::Kind::node || !node.leaf) return false;
  return !node.label.empty() || branch.copies > 1 || node.over_capacity;
}

std::vector<Vec<2>> TreeLayout::edge(std::size_t branch) const {
  const Box<2>& above = boxes[branches[branch].parent];
  const Vec<2> from{above.center().x, above.hi.y};
  const Vec<2> to{boxes[branch].center().x, boxes[branch].lo.y};
  if (!labels_between) return {from, to};
  const double fan = from.y + scale.under;
  if (to.y - fan >= kLeastFan) return {from, {from.x, fan}, to};
  const double elbow = to.y - kElbow;
  return {from, {from.x, elbow}, {to.x, elbow}, to};
}

double TreeLayout::label_room(std::size_t branch, const Frame& frame, const Box<2>& panel) const {
  constexpr double kBesideEdge = 8, kBesideLabel = 4;
  const double center = boxes[branch].center().x;
  double room = std::min(center - panel.lo.x, panel.hi.x - center);
  std::vector<bool> open(branches.size());
  for (const Branch& other : branches)
    if (other.parent != kNone) open[other.parent] = true;
  for (std::size_t i = 0; i < branches.size(); ++i) {
    if (i == branch || branches[i].row != branches[branch].row) continue;
    const double away = std::abs(boxes[i].center().x - center);
    if (open[i])
      room = std::min(room, away - kBesideEdge);
    else if (has_label_below(branches[i], frame))
      room = std::min(room, away / 2 - kBesideLabel);
  }
  return 2 * room;
}

BranchText text_of(const Branch& branch, const Frame& frame, const TreeScale& scale,
                   const TreeWords& words) {
  const FrameNode& node = frame.nodes[branch.node];
  const char* each = branch.each && words.each ? " each" : "";
  using Kind = Branch::Kind;
  if (branch.kind == Kind::empties) return {fmt::format("×{}{}", branch.count, each), 0};
  if (branch.kind == Kind::folded)
    return {fmt::format("+{}{}", branch.count, words.nodes ? " nodes" : ""), 0};
  if (branch.kind == Kind::levels) return {fmt::format("{} levels", branch.count), 0};
  if (!node.leaf) {
    if (branch.copies > 1) return {fmt::format("×{}{}", branch.copies, each), 0};
    if (!frame.textures.empty()) return {};  // an atlas's inner node shows its cut
    const bool named = node.plane && !node.plane_name.empty();
    const TextStyle style{scale.text, Weight::semibold, Role::ink};
    const std::string_view text = named ? node.plane_name : node.label;
    const double width = std::max(1.3 * scale.box_width, named ? 150.0 : 62.0);
    const std::string brief = short_label(node.label);
    const bool use_brief =
        !named && !brief.empty() && (is_long_way(node.label) || text_width(text, style) > width);
    return {shortened(use_brief ? brief : text, width, style), 0};
  }
  if (!frame.textures.empty() && node.bodies.empty() && node.label.empty()) {
    const double width = text_width("free", scale.text, Weight::regular);
    return {width + 8 <= scale.box_width ? "free" : "", 0};
  }
  const std::size_t most = 4, bodies = node.bodies.size();
  if (bodies <= most) return {"", bodies};
  return {fmt::format("+{}", bodies - (most - 1)), most - 1};
}

TreeLayout lay_out_tree(const Frame& frame, const Box<2>& panel) {
  TreeLayout layout;
  const TreeFold fold(frame);
  if (frame.nodes.empty()) return layout;
  double s = 0;
  if (frame.nodes.size() <= kMostBranches) {
    layout.branches = fold.whole();
    s = best_scale(layout.branches, frame, panel);
  }
  if (s == 0) {
    layout.branches = condensed(fold, frame, panel);
    s = best_scale(layout.branches, frame, panel);
  }
  place(frame, panel, s > 0 ? s : kSmallest, layout);
  return layout;
}

}  // namespace lantern::draw
