// PNG files: written with run_deflate or libdeflate, read through stb_image.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "render/image.hpp"

namespace lantern {

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

}  // namespace lantern
