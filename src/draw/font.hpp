// The bundled type, embedded in the binary: Inter in two weights, and Inconsolata for code.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "draw/draw_list.hpp"

namespace lantern::draw {

// Whence letters come that the bundled type lacks: the bytes of an OpenType file, or none. It is
// asked once, when the first such letter is set. Before that, and without it, they are boxes.
void set_more_letters(std::string (*file)());

// Width of a line of text, page units, at an em of `size`; kerning included.
double text_width(std::string_view text, double size, Weight weight);

// The OpenType file of a weight, for those who embed it.
std::string_view font_file(Weight weight);

// Height of a capital letter, as a part of the em.
double cap_height(Weight weight);

// Can the letter be shown? Another one is drawn as a box, in every picture alike.
// Takes no more of the typeface than the list of its letters.
bool has_glyph(char32_t letter);

// How many weights were measured and kerned: each once, when a text is first set in it.
std::uint64_t faces_made();

struct PlacedGlyph {
  int glyph = 0;        // index in the font
  double x = 0;         // of its origin from the left end of the line, page units
  char32_t letter = 0;  // that it shows
};

// The glyphs of one line of UTF-8, kerned. Bytes that are no UTF-8 become U+FFFD.
std::vector<PlacedGlyph> shape_text(std::string_view text, double size, Weight weight);

// Coverage of one glyph, 0 ... 255, rasterised at an em of `pixels`, its origin shifted right by
// `shift` pixels (0 <= shift < 1). (left, top) is the bitmap's corner from the origin, y down.
struct GlyphBitmap {
  int left = 0, top = 0, width = 0, height = 0;
  std::vector<std::uint8_t> coverage;
};
GlyphBitmap rasterise_glyph(int glyph, Weight weight, double pixels, double shift);

// A glyph's outline in units of one em, y down, by the letters of an SVG path: M and L have a
// point, Q two, C three, Z none. Empty for a space.
struct PathStep {
  char letter = 'Z';
  std::vector<Vec<2>> points = {};
};
std::vector<PathStep> glyph_path(int glyph, Weight weight);

}  // namespace lantern::draw
