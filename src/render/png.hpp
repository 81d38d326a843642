// PNG files: written with our own deflate or libdeflate, read through stb_image; and the seal of a
// file, PNG or not.
#pragma once

#include <optional>

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

// A file that says itself what it was made from, and that it is as it was written. So a picture of
// an earlier run is kept exactly when it is the one that is wanted now, whatever else is in its
// folder, and a file that somebody has changed since is not taken for Lantern's.
enum class FileKind { png, svg, json };

// What a file was made from: two keys of 16 hexadecimal digits each. Files with the same `facts`
// tell of the same frame; with the same `picture`, too, they have the same bytes.
struct MadeFrom {
  std::string facts;
  std::string picture;
  bool operator==(const MadeFrom&) const = default;
};

// The whole file `bytes` with its seal: a text chunk before a PNG's end, a comment behind an SVG,
// the last members of a JSON object that ends with "\n}\n". The checksum is a CRC-32 of all bytes
// before the seal and of the keys.
std::string sealed(FileKind kind, std::string bytes, const MadeFrom& from);

// Nothing if there is no seal, or if a single bit is not as it was written.
std::optional<MadeFrom> made_from(FileKind kind, std::string_view bytes);

// What the file itself says: an SVG or JSON up to its seal, be that right or broken; all of one
// without a seal, but for the end that a JSON object has, and all of a PNG.
std::string_view before_seal(FileKind kind, std::string_view bytes);

}  // namespace lantern::render
