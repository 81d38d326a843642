// What a node takes in memory, with its box derived on the way down and with it stored: two bars on
// one scale, a cell for each byte.
#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "base/words.hpp"
#include "draw/number_text.hpp"
#include "draw/panel.hpp"
#include "language/panel_rules.hpp"

namespace lantern::draw {
namespace {

constexpr double kBytesBar = 34;
constexpr double kBytesRow = 50;

struct BytesBar {
  std::string name = {};
  double bytes = 0;  // of all nodes
  double boxes = 0;  // of these, for stored boxes
};

class BytesView : PanelPicture {
 public:
  explicit BytesView(const PanelPicture& on) : PanelPicture(on) {}

  void draw() {
    const auto nodes = frame_.count("nodes"), bytes = frame_.count("node_bytes");
    const auto with_boxes = frame_.count("node_bytes_with_bounds");
    if (!nodes || !bytes || !with_boxes || *nodes <= 0) return;
    nodes_ = static_cast<double>(*nodes);
    const auto derived = static_cast<double>(*bytes), stored = static_cast<double>(*with_boxes);
    const BytesBar bars[] = {{word("box derived"), derived, 0},
                             {word("box stored"), stored, stored - derived}};
    // A node has at most so many bytes: the scale stays while the tree grows.
    constexpr double kScale = 32;
    const double scale = kScale * std::max(2.0, std::ceil(stored / nodes_ / kScale));
    for (const BytesBar& bar : bars) {
      names_ = std::max(names_, text_width(bar.name, kPlain) + 14);
      numbers_ = std::max(numbers_, text_width(numbers(bar), kStrong) + 30);
    }
    byte_ = (panel_.size().x - names_ - numbers_) / scale;
    if (byte_ < 1) return;
    double y = panel_.lo.y;
    for (const BytesBar& bar : bars) {
      draw_bar(bar, y);
      y += kBytesRow;
    }
  }

 private:
  std::string numbers(const BytesBar& bar) const {
    return say("{} bytes a node, {} in all", number_text(bar.bytes / nodes_, 1),
               number_text(bar.bytes));
  }

  void draw_bar(const BytesBar& bar, double y) {
    const double x = panel_.lo.x + names_, middle = y + kBytesRow / 2;
    const auto part = [&](double from, double to) {
      return Box<2>{{x + from * byte_, middle - kBytesBar / 2},
                    {x + to * byte_, middle + kBytesBar / 2}};
    };
    const double all = bar.bytes / nodes_, own = (bar.bytes - bar.boxes) / nodes_;
    list_.rect(part(0, own), Role::static_body, {Role::cell_line_0, 1.6});
    if (bar.boxes > 0) {
      const Box<2> box = part(own, all);
      list_.rect(box, Role::lit_fill, {Role::lit, 2.2});
      const TextStyle style{kLabel, Weight::regular, Role::lit_ink};
      const std::string its_box = word("its box");
      if (text_width(its_box, style) < box.size().x - 8)
        try_write(its_box, {centred(box.center(), style)}, style);
    }
    // Every fourth byte: one number of single length.
    for (double at = 4; at < own - 0.5; at += 4)
      list_.crisp_line({x + at * byte_, middle - kBytesBar / 2},
                       {x + at * byte_, middle - kBytesBar / 2 + 8}, {Role::cell_line_0, 1.2});
    write(bar.name, centred({x - 14, middle}, kPlain, 1));
    write(numbers(bar), centred({x + all * byte_ + 14, middle}, kStrong, 0), kStrong);
  }

  double nodes_ = 0;
  double names_ = 0, numbers_ = 0;  // widths
  double byte_ = 0;                 // of a byte
};

}  // namespace

PanelEntry bytes_panel() {
  return {{.name = "bytes",
           .words = "as a strip, the `bytes` of a node with and without its box",
           .needs = "it needs a quadtree or an octree, whose nodes have their bytes counted",
           .possible = language::has_array},
          {.shows = {{"bytes of nodes",
                      [](const Frame& f) { return f.count("node_bytes").value_or(0) > 0; }}}},
          {.draw = draw_as<BytesView>,
           .strip = [](const Frame&, const Vec<2>&) { return 2 * kBytesRow + 8; },
           .weight = 0.28,
           .inset = 3,
           .smallest = {-1e300, 2 * kBytesRow - 1}}};
}

}  // namespace lantern::draw
