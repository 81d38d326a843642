// What a run knows of panels: what frames hold for them, and how it gets there. When there can be
// one is in language/panel.cpp, how it is drawn in draw/panel.hpp.
#pragma once

#include "frame/frame.hpp"
#include "language/specs.hpp"

namespace lantern::run {

struct Stage;

struct PanelRun {
  // What a frame may hold for it: "nodes".
  struct Content {
    std::string_view what;
    bool (*is_on)(const Frame& frame);
  };

  std::string_view name = {};   // as in `panels`; of a program's own, that of its kind
  std::string_view stage = {};  // as it is tallied; empty: "tree panel", by its name
  std::vector<Content> shows = {};
  // Adds the panel's part to a frame that has all else. Null: whoever runs the step has done it.
  void (*gather)(const Stage& stage, Frame& frame) = nullptr;
};

const PanelRun& run_of(Panel panel);

// One more, of the program's own: its two entries. To be called before any scenario is read. Throws
// Refused as language::add_panel does.
void add_panel(const PanelKind& kind, PanelRun run);

}  // namespace lantern::run
