// Panels: what a page is made of. All that the language knows of one is an entry of one list; what
// a run gathers for it is one of another (run/panel.hpp), and how it is drawn one of a third
// (draw/panel.hpp).
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lantern::language {

struct Draft;

// A panel by its place in the list.
enum class Panel : std::uint8_t {};

struct PanelKind {
  std::string_view name = {};   // as in `panels`
  std::string_view needs = {};  // said where it is not possible: "it needs a [chart]"
  bool (*possible)(const Draft& draft) = [](const Draft&) { return true; };
  // Of a scenario that wishes for none, which has it if this holds: its place from the left.
  int place = 0;
  bool (*by_itself)(const Draft& draft) = nullptr;
  bool of_all_sides = false;           // one for all of them, below their own
  std::string (*example)() = nullptr;  // a scenario that has it, but for `panels`; null: the usual
};

std::span<const PanelKind> panel_kinds();
const PanelKind& kind_of(Panel panel);

// A panel of Lantern, which must be there.
Panel panel_named(std::string_view name);

bool is(Panel panel, std::string_view name);
// Is it one of these?
bool shows(const std::vector<Panel>& panels, std::string_view name);

// Those that can have something to show in any of these. They must be known before the first frame
// is drawn, so they follow from what the files declare.
std::vector<Panel> derived_panels(std::span<const Draft* const> drafts);

// One more, of the program's own. To be called before any scenario is read. Throws Refused if its
// name is taken, or is not of a–z, 0–9 and _.
void add_panel(PanelKind kind);

std::vector<std::string_view> names(Panel);

}  // namespace lantern::language
