// How panels are drawn, and what room they want. What else is known of them is in
// language/panel.cpp and run/panel.hpp. Each panel is a file that gives one entry of the list
// in panel.cpp.
#pragma once

#include <string_view>

#include "draw/labels.hpp"
#include "draw/staging.hpp"
#include "frame/frame.hpp"

namespace lantern::draw {

struct PanelView {
  std::string_view name = {};  // as in `panels`; of a program's own, that of its kind
  // Fills the box and nothing outside of it.
  void (*draw)(const Frame& frame, const Staging& staging, const Box<2>& box, DrawList& list,
               Labels& labels) = nullptr;
  // Beside others: the width that it would take at this height if it could choose. Null: what is
  // left.
  double (*width)(const Frame& frame, double height) = nullptr;
  // Of a strip, which lies under the others as wide as they are together: the height that it wants
  // in an area. Null: no strip.
  double (*strip)(const Frame& frame, const Vec<2>& area) = nullptr;
  // How large its picture gets in a box: the side of a square as large. Two panels that say it
  // share an area so that both are large. Null: it takes what it gets.
  double (*size)(const Frame& frame, const Staging& staging, const Box<2>& box) = nullptr;
  double weight = 1;   // of its height, where panels stand one above the other
  double least = 260;  // that height, where another one wants more of it
  double enough = 0;   // such a one: as much, if the others keep `least`; flatter it shows little
};

const PanelView& view_of(Panel panel);

// What the views of panels are: a frame, and where it is drawn.
class PanelPicture {
 public:
  PanelPicture(const Frame& frame, const Staging& staging, const Box<2>& panel, DrawList& list,
               Labels& labels)
      : frame_(frame), staging_(staging), panel_(panel), list_(list), labels_(labels) {}

 protected:
  const Frame& frame_;
  const Staging& staging_;
  Box<2> panel_;
  DrawList& list_;
  Labels& labels_;
};

// One more, of a program's own.
void add_panel(PanelView view);

}  // namespace lantern::draw
