// The two halves of encoding a PNG: the pixels, which are costly, and the file around them, which
// is cheap. Equal frames share the first half.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "render/png.hpp"

namespace lantern {

struct PngBody {
  std::string header;  // signature and IHDR
  std::string pixels;  // IDAT
};

PngBody compress(const Image& image, PngEffort effort);

// A chunk of one text.
std::string png_text(const PngText& text);

// The last chunk of every PNG.
inline constexpr std::string_view kPngEnd("\0\0\0\0IEND\xae\x42\x60\x82", 12);

std::string assemble(const PngBody& body, const std::vector<PngText>& texts, int pixels_per_metre);

}  // namespace lantern
