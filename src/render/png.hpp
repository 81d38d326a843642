// PNG files: written with band_deflate or libdeflate, read through stb_image.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "render/deflate.hpp"
#include "render/image.hpp"

namespace lantern::render {

enum class PngEffort { fast, small };

struct PngText {
  std::string key;  // 1 to 79 letters
  std::string value;
};

// RGB if every pixel is opaque, else RGBA; with pHYs (pixels a metre, 0 leaves it out) and one tEXt
// chunk for each text. The same image and texts give the same bytes.
std::string encode_png(const Image& image, PngEffort effort, const std::vector<PngText>& texts,
                       int pixels_per_metre);

// Nothing if these bytes are no PNG, are damaged, or are larger than `most_pixels`.
std::optional<Image> decode_png(std::string_view bytes, std::size_t most_pixels = 1u << 28);

// A zlib stream (RFC 1950) of these bytes, as libdeflate packs it; level 12 of 12 is the smallest.
std::string deflated(std::string_view bytes, int level);

// The two halves of encoding: the pixels, which are costly, and the file around them, which is
// cheap. Equal frames share the first half.
struct PngBody {
  std::string header;  // signature and IHDR
  std::string pixels;  // IDAT
};

PngBody compress(const Image& image, PngEffort effort);

// The rows of an image from `row` on, at most kBandRows, and the one above them. `to` is
// overwritten, its memory reused.
void take_band(const Image& image, int row, Band& to);

// A picture of these bands, from the uppermost down, as libdeflate packs it; `channels` is 3
// (without alpha) or 4.
std::string small_stream(std::span<const Band* const> bands, int channels);

// Around a zlib stream of `height` rows, each with the byte 0 before its pixels.
PngBody png_body(int width, int height, int channels, const std::string& stream);

// A chunk of one text.
std::string png_text(const PngText& text);

// The last chunk of every PNG.
inline constexpr std::string_view kPngEnd("\0\0\0\0IEND\xae\x42\x60\x82", 12);

std::string assemble(const PngBody& body, const std::vector<PngText>& texts, int pixels_per_metre);

}  // namespace lantern::render
