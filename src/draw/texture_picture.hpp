// What is seen on a texture: wherever it is drawn, it looks like this.
#pragma once

#include "draw/pattern.hpp"
#include "frame/parts/atlas.hpp"

namespace lantern::draw {

// Fills `rect` with the texture's picture or pattern; `scale` and `most_parts` are a pattern's
// (pattern.hpp). With no parts at all only its ground is painted. Nothing leaves the rectangle.
void draw_texture(const FrameTexture& texture, const Box<2>& rect, double scale, int most_parts,
                  DrawList& list, bool turned);

}  // namespace lantern::draw
