// What an atlas, and a screen that is drawn from it, add to a frame.
#pragma once

#include "frame/frame.hpp"

namespace lantern::frame {

struct FrameTexture {
  std::uint32_t id = 0;
  std::string name;
  int color = 1;
  Picture picture = Picture::pattern;
  int width = 0;
  int height = 0;
  bool packed = false;
  bool refused = false;
  bool later = false;   // it waits nowhere before it is packed or refused
  bool turned = false;  // by 90 degrees: width and height are exchanged
  int x = 0;            // of a packed one, upper left corner
  int y = 0;

  bool has_come() const { return packed || refused || !later; }

  static auto fields(auto& r, auto&& v) {
    return v("id", r.id)("name", r.name)("size", r.width, r.height)
        .or_null(r.packed, "position", r.x, r.y)("refused", r.refused)
        .drawn(r.color, r.picture, r.packed, r.later, r.turned);
  }
};

// Of an atlas.
struct FrameTextures {
  static constexpr std::string_view kName = "textures";
  std::vector<FrameTexture> textures;
  Vec<2> asked{0.0};  // what the step wants a room for; 0: nothing

  static auto fields(auto& r, auto&& v) {
    return v.when(!r.textures.empty(), "textures", r.textures).drawn(r.asked);
  }
  void add_state(Hash& hash) const;
};

// A screen that is drawn from textures, and each way in which it has been drawn so far.
struct FrameElement {
  std::uint32_t texture = 0;  // of frame.textures
  int x = 0;                  // of the screen, upper left corner
  int y = 0;
  int width = 0;
  int height = 0;
  bool drawn = true;  // by the way that is under way; before the first one all are shown
  bool lit = false;   // the frame is about it

  static auto fields(auto& r, auto&& v) {
    return v("texture", r.texture)("position", r.x, r.y)("drawn", r.drawn)
        .drawn(r.width, r.height, r.lit);
  }
};

struct FrameDraw {
  std::uint32_t element = 0;
  bool binds = false;  // another image had to be bound before it
  bool done = false;   // else it is bound and not yet drawn

  static auto fields(auto& r, auto&& v) {
    return v("element", r.element)("binds", r.binds)("done", r.done);
  }
};

struct FrameWay {
  bool from_atlas = false;
  bool by_texture = false;  // sorted so; else in the order of the list
  std::vector<FrameDraw> draws;
  std::uint64_t bindings = 0;

  static auto fields(auto& r, auto&& v) {
    return v.words("from", r.from_atlas, "textures", "atlas")
        .words("order", r.by_texture, "as_listed", "by_texture")("bindings", r.bindings)("draws",
                                                                                         r.draws);
  }
};

struct FrameScreen {
  static constexpr std::string_view kName = "screen";
  static constexpr bool kIsObject = true;
  int width = 0;
  int height = 0;
  std::uint32_t planned = 0;           // ways, in the whole script
  std::vector<FrameElement> elements;  // from the back to the front
  std::vector<FrameWay> ways;          // the last may be under way
  std::uint32_t bound = kNone;         // a texture, while it is drawn from
  bool atlas_bound = false;            // or the atlas

  static auto fields(auto& r, auto&& v) {
    return v("size", r.width, r.height)("elements", r.elements)("ways", r.ways)
        .drawn(r.planned, r.bound, r.atlas_bound);
  }
};

}  // namespace lantern::frame
