// The pool of a tree's nodes: slots that change their owner from tree to tree, and are not given
// back in between.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "draw/body_shapes.hpp"
#include "draw/number_text.hpp"
#include "draw/panel.hpp"
#include "draw/panels.hpp"

namespace lantern::draw {
namespace {

constexpr double kPoolText = 24;
constexpr double kPoolHeading = 42;
constexpr double kPoolSlot = 46;  // height
constexpr double kPoolRow = 54;   // from row to row
constexpr int kMostPoolRows = 3;
constexpr double kPoolSlots[] = {96, 84, 72, 60, 50, 42, 34, 28, 22, 16, 12, 8};  // widths
constexpr std::uint32_t kMostPoolSlots = 2000;                                    // that are drawn

const TextStyle kPoolStyle{kPoolText, Weight::regular, Role::ink};

struct PoolGrid {
  double slot = kPoolSlots[0];
  std::uint32_t columns = 1, rows = 1;
};

// The widest slots at which all have room in a few rows, one row if it can be.
PoolGrid pool_grid(std::uint32_t slots, double width, int most_rows) {
  PoolGrid grid;
  const std::uint32_t all = std::clamp(slots, 1u, kMostPoolSlots);
  for (int rows = 1; rows <= most_rows; ++rows)
    for (const double slot : kPoolSlots) {
      grid.slot = slot;
      grid.columns = static_cast<std::uint32_t>(std::max(1.0, width / slot));
      grid.rows = (all + grid.columns - 1) / grid.columns;
      const bool last = rows == most_rows && slot == kPoolSlots[std::size(kPoolSlots) - 1];
      const bool legible = slot >= 60 || rows == most_rows;
      if (last || (legible && grid.rows <= static_cast<std::uint32_t>(rows))) {
        grid.columns = std::min(grid.columns, all);
        return grid;
      }
    }
  return grid;
}

class PoolView : PanelPicture {
 public:
  explicit PoolView(const PanelPicture& on) : PanelPicture(on) {
    const double room = panel_.size().y - kPoolHeading;
    const int rows = std::clamp(static_cast<int>((room + 8) / kPoolRow), 1, kMostPoolRows);
    grid_ = pool_grid(frame_.get<FrameStructure>().pool_size, panel_.size().x, rows);
    shown_ = std::min({frame_.get<FrameStructure>().pool_size, kMostPoolSlots,
                       grid_.columns * static_cast<std::uint32_t>(rows)});
  }

  void draw() {
    std::vector<const FrameNode*> owners(shown_);
    for (const FrameNode& node : frame_.nodes)
      if (node.pool_slot < shown_) owners[node.pool_slot] = &node;
    for (std::uint32_t slot = 0; slot < shown_; ++slot) draw_slot(slot, owners[slot]);
    draw_heading();
  }

 private:
  Box<2> place(std::uint32_t slot) const {
    const Vec<2> lo = panel_.lo + Vec<2>((slot % grid_.columns) * grid_.slot,
                                         kPoolHeading + (slot / grid_.columns) * kPoolRow);
    return {lo, lo + Vec<2>(grid_.slot, kPoolSlot)};
  }

  void draw_slot(std::uint32_t slot, const FrameNode* owner) {
    const DrawList::Scope scope(list_, fmt::format("pool/{}", slot));
    const Box<2> box = place(slot);
    if (!owner) return list_.crisp_rect(box, Role::free_space, {Role::cell_line_3, 1.4, 4});
    const bool lit = owner->mark == Mark::lit;
    list_.crisp_rect(box, ground_of(owner->mark),
                     lit ? Stroke{Role::lit, 2.8} : Stroke{Role::cell_line_1, 1.6});
    if (owner->reused) draw_reused(box);
    for (const std::string& text : {owner->label, brief(owner->label)})
      if (!text.empty() && text_width(text, kPoolStyle) <= box.size().x - 8) {
        labels_.add(text, centred({box.center().x, box.center().y + 3}, kPoolStyle), kPoolStyle,
                    panel_);
        return;
      }
  }

  // A band along the upper edge: this place was another node's before.
  void draw_reused(const Box<2>& box) {
    const double inset = std::min(3.0, 0.1 * box.size().x);
    list_.rect({box.lo + inset, {box.hi.x - inset, box.lo.y + 9}}, Role::frustum);
  }

  static std::string brief(const std::string& label) {
    const std::size_t dot = label.rfind('.');
    return dot == std::string::npos ? "" : "…" + label.substr(dot + 1);
  }

  void draw_heading() {
    std::uint64_t used = 0, reused = 0;
    for (const FrameNode& node : frame_.nodes) {
      used += node.pool_slot != kNone;
      reused += node.pool_slot != kNone && node.reused;
    }
    const TextStyle strong{kPoolText, Weight::semibold, Role::ink};
    const double y = panel_.lo.y + 0.8 * kPoolText;
    double x = panel_.lo.x;
    const auto write = [&](const std::string& words, const TextStyle& style) {
      const std::string text = shortened(words, panel_.hi.x - x, style);
      if (!text.empty()) labels_.add(text, {{x, y}, 0}, style, panel_);
      x += text_width(text, style) + 30;
    };
    const auto number = [](std::uint64_t n) { return number_text(static_cast<double>(n)); };
    write(fmt::format("{} of {} node slots in use", number(used),
                      number(frame_.get<FrameStructure>().pool_size)),
          strong);
    if (x + 60 < panel_.hi.x) {
      draw_reused({{x, y - 17}, {x + 26, y + 1}});
      x += 34;
      write(fmt::format("{} reused", number(reused)), kPoolStyle);
    }
    if (const auto calls = frame_.count("allocations"); calls && x + 60 < panel_.hi.x)
      write(fmt::format("{} allocation{}", number(static_cast<std::uint64_t>(*calls)),
                        *calls == 1 ? "" : "s"),
            kPoolStyle);
    if (shown_ < frame_.get<FrameStructure>().pool_size && x + 60 < panel_.hi.x)
      write(fmt::format("the first {} are drawn", number(shown_)), kPoolStyle);
  }

  PoolGrid grid_;
  std::uint32_t shown_ = 0;  // slots
};

void draw_pool(const Frame& frame, const Staging& staging, const Box<2>& panel, DrawList& list,
               Labels& labels) {
  const Box<2> place = shrunk(panel, 3);
  if (place.size().x < 60 || place.size().y < kPoolHeading + kPoolSlot) return;
  list.referents.insert({"nodes_reused", "allocations"});
  if (is_in_pieces(frame)) return draw_node_pieces(frame, place, list, labels);
  PoolView({frame, staging, place, list, labels}).draw();
}

double pool_height(const Frame& frame, double width) {
  if (is_in_pieces(frame)) return kPoolHeading + kMostPoolRows * kPoolRow + 2;
  const PoolGrid grid = pool_grid(frame.get<FrameStructure>().pool_size, width - 6, kMostPoolRows);
  return kPoolHeading + std::min<double>(grid.rows, kMostPoolRows) * kPoolRow + 2;
}

double pool_strip(const Frame& frame, const Vec<2>& area) {
  return std::min(pool_height(frame, area.x), 0.46 * area.y);
}

}  // namespace

// Strips, which lie under the other panels, as wide as they are together.
// The pool of a tree's nodes: each slot names the node that owns it, a band marks one that was
// another's before; slots that are free again are dashed. It wants this height at a width.
PanelView pool_panel() {
  return {.name = "pool", .draw = draw_pool, .strip = pool_strip, .weight = 0.4};
}

}  // namespace lantern::draw
