// What frames hold for panels, and how it gets there. When there can be a panel is in
// language/display.hpp, how it is drawn in draw/panel.hpp.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "frame/frame.hpp"

namespace lantern::language {
struct CountDoc;
}
namespace lantern::run {
struct Stage;  // what a step changes (run/stage.hpp)
}

namespace lantern::frame {

struct PanelRun {
  // What a frame may hold for it: "nodes".
  struct Content {
    std::string_view what;
    bool (*is_on)(const Frame& frame);
  };

  std::string_view stage = {};  // as it is tallied; empty: "tree panel", by its name
  std::vector<Content> shows = {};
  // Adds the panel's part to a frame that has all else. Null: whoever runs the step has done it.
  void (*gather)(const run::Stage& stage, Frame& frame) = nullptr;
  std::span<const language::CountDoc> counts = {};  // that it adds to frames, if any
};

// Of what is in one of a frame's parts.
template <class P>
bool has_part(const Frame& frame) {
  return frame.find<P>() != nullptr;
}
template <class P, auto member>
bool lists(const Frame& frame) {
  return !(frame.get<P>().*member).empty();
}

const PanelRun& run_of(Panel panel);
// One more. Throws Refused as language::add_panel does.
void add_panel(PanelKind kind, PanelRun run);

}  // namespace lantern::frame
