// What is seen on a texture: wherever it is drawn, it looks like this. Patterns are two tones of
// one hue, so that textures differ without colour too.
#pragma once

#include <cstdint>

#include "draw/draw_list.hpp"
#include "frame/frame.hpp"
#include "frame/parts/atlas.hpp"

namespace lantern::draw {

inline constexpr int kPatterns = 8;
inline constexpr int kMostPatternParts = 27;  // of one rectangle, on its ground

// Fills `rect` with the pattern of texture `id` in body colour `color`, turned by 90 degrees if it
// is. Nothing leaves the rectangle. `scale` is the size of the pattern's parts, 1 being some 12
// units; parts are made larger where there would be more than `most_parts` of them, 0 to
// kMostPatternParts.
void draw_pattern(std::uint32_t id, int color, const Box<2>& rect, double scale, int most_parts,
                  DrawList& list, bool turned = false);

// Fills `rect` with the texture's picture or pattern; `scale` and `most_parts` are a pattern's.
// With no parts at all only its ground is painted. Nothing leaves the rectangle.
void draw_texture(const FrameTexture& texture, const Box<2>& rect, double scale, int most_parts,
                  DrawList& list, bool turned);

}  // namespace lantern::draw
