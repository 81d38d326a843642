#include "draw/panel.hpp"

#include <algorithm>
#include <vector>

#include "base/check.hpp"

namespace lantern::draw {

PanelView world_panel(), tree_panel(), atlas_panel(), chart_panel(), memory_panel(), ledger_panel(),
    pool_panel(), bytes_panel(), sparkline_panel(), difference_panel(), axes_panel(),
    comparison_panel(), islands_panel(), code_panel(), collisions_panel(), matrix_panel(),
    screen_panel();

namespace {

std::vector<PanelView>& views() {
  static std::vector<PanelView> all = {
      world_panel(),  tree_panel(),       atlas_panel(),   chart_panel(),     memory_panel(),
      ledger_panel(), pool_panel(),       bytes_panel(),   sparkline_panel(), difference_panel(),
      axes_panel(),   comparison_panel(), islands_panel(), code_panel(),      collisions_panel(),
      matrix_panel(), screen_panel()};
  return all;
}

}  // namespace

const PanelView& view_of(Panel panel) {
  const auto found = std::ranges::find(views(), kind_of(panel).name, &PanelView::name);
  LANTERN_CHECK(found != views().end(), ==, true);
  return *found;
}

void add_panel(PanelView view) { views().push_back(view); }

}  // namespace lantern::draw
