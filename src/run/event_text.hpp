// What an algorithm's event is called, and how it is said in words.
#pragma once

#include "atlas/atlas.hpp"
#include "frame/parts/asked.hpp"
#include "frame/parts/motion.hpp"
#include "language/specs.hpp"
#include "spatial/structure.hpp"

namespace lantern::run {

// With a capital at its beginning, if that is an ASCII letter; other scripts stay as they are.
std::string capitalised(std::string text);

// "test", "hand_down", ...: names for --at.
std::string_view event_name(Event::Kind kind);
std::string_view event_name(AtlasEvent::Kind kind);

// One sentence with the real numbers: "Node 1 holds 3, but its limit is 2, so it must split." The
// node of a structure that is no tree is not named.
std::string event_text(const Event& event, const StructureSpec& structure, const std::string& node,
                       const std::string& body);
std::string event_text(const AtlasEvent& event, const std::string& node, const std::string& texture,
                       int width, int height);

// Of a walk through a structure: `event` is "visit", "skip", "hit" or "miss".
std::string query_text(std::string_view event, const std::string& node, const std::string& body);

// Of the newest axis of a separation; `a` and `b` are its bodies' names.
std::string axis_text(const FrameSeparation& separation, const std::string& a,
                      const std::string& b);
// Of the newest search for a support point, before and after it has entered the simplex.
std::string search_text(const FrameSearch& search, const std::string& a, const std::string& b);

// Of a screen that is drawn: `bound` is what was bound before, empty if nothing was; `bindings` are
// all up to this one. Then of the draw itself.
std::string bind_text(const std::string& image, const std::string& bound, std::uint64_t bindings);
std::string draw_text(const std::string& texture, bool from_atlas);

// Of a look for the moment of an impact.
std::string look_text(const FrameLook& look);

// Of a world step shown phase by phase: "broad_phase", "narrow_phase" or "solve".
std::string phase_text(std::string_view phase, const Frame& frame);

}  // namespace lantern::run
