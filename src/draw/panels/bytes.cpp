// What a node takes in memory, with its box derived on the way down and with it stored: two bars on
// one scale, a cell for each byte.
#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "draw/number_text.hpp"
#include "draw/panel.hpp"
#include "draw/pen.hpp"

namespace lantern::draw {
namespace {

constexpr double kBytesText = 24;
constexpr double kBytesBar = 34;
constexpr double kBytesRow = 50;

const TextStyle kBytesStyle{kBytesText, Weight::regular, Role::ink};
const TextStyle kBytesStrong{kBytesText, Weight::semibold, Role::ink};

struct BytesBar {
  const char* name = "";
  double bytes = 0;  // of all nodes
  double boxes = 0;  // of these, for stored boxes
};

class BytesView {
 public:
  BytesView(double nodes, const Box<2>& panel, DrawList& list, Labels& labels)
      : nodes_(nodes), panel_(panel), list_(list), labels_(labels) {}

  void draw(double derived, double stored) {
    const BytesBar bars[] = {{"box derived", derived, 0}, {"box stored", stored, stored - derived}};
    // A node has at most so many bytes: the scale stays while the tree grows.
    constexpr double kScale = 32;
    const double scale = kScale * std::max(2.0, std::ceil(stored / nodes_ / kScale));
    for (const BytesBar& bar : bars) {
      names_ = std::max(names_, text_width(bar.name, kBytesStyle) + 14);
      numbers_ = std::max(numbers_, text_width(numbers(bar), kBytesStrong) + 30);
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
    return fmt::format("{} bytes a node, {} in all", number_text(bar.bytes / nodes_, 1),
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
      const TextStyle style{kBytesText, Weight::regular, Role::lit_ink};
      if (text_width("its box", style) < box.size().x - 8)
        labels_.try_add("its box", {centred(box.center(), style)}, style, panel_);
    }
    // Every fourth byte: one number of single length.
    for (double at = 4; at < own - 0.5; at += 4)
      list_.crisp_line({x + at * byte_, middle - kBytesBar / 2},
                       {x + at * byte_, middle - kBytesBar / 2 + 8}, {Role::cell_line_0, 1.2});
    labels_.add(bar.name, centred({x - 14, middle}, kBytesStyle, 1), kBytesStyle, panel_);
    labels_.add(numbers(bar), centred({x + all * byte_ + 14, middle}, kBytesStrong, 0),
                kBytesStrong, panel_);
  }

  double nodes_;
  Box<2> panel_;
  DrawList& list_;
  Labels& labels_;
  double names_ = 0, numbers_ = 0;  // widths
  double byte_ = 0;                 // of a byte
};

void draw_bytes(const Frame& frame, const Staging&, const Box<2>& panel, DrawList& list,
                Labels& labels) {
  const auto nodes = frame.count("nodes"), bytes = frame.count("node_bytes");
  const auto stored = frame.count("node_bytes_with_bounds");
  const Box<2> place = shrunk(panel, 3);
  if (!nodes || !bytes || !stored || *nodes <= 0 || place.size().y < 2 * kBytesRow - 1) return;
  BytesView(static_cast<double>(*nodes), place, list, labels)
      .draw(static_cast<double>(*bytes), static_cast<double>(*stored));
}

}  // namespace

// The bytes of a node whose box is derived and of one that stores it, on one scale.
PanelView bytes_panel() {
  return {.name = "bytes",
          .draw = draw_bytes,
          .strip = [](const Frame&, const Vec<2>&) { return 2 * kBytesRow + 8; },
          .weight = 0.28};
}

}  // namespace lantern::draw
