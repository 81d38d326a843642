#include "render/png.hpp"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <new>
#include <vector>

#include <libdeflate.h>

#include "base/check.hpp"
#include "base/stop.hpp"
#include "render/png_parts.hpp"
#include "render/run_deflate.hpp"

namespace lantern {
namespace {

constexpr int kLevel = 7;  // of libdeflate's 12

struct FreeCompressor {
  void operator()(libdeflate_compressor* c) const { libdeflate_free_compressor(c); }
};
using Compressor = std::unique_ptr<libdeflate_compressor, FreeCompressor>;

// A zlib stream of these bytes, as small as is not slow.
std::string deflated(std::string_view bytes) {
  thread_local const Compressor compressor(libdeflate_alloc_compressor(kLevel));
  if (!compressor) throw std::bad_alloc();
  std::string out(libdeflate_zlib_compress_bound(compressor.get(), bytes.size()), '\0');
  out.resize(libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(), out.data(),
                                      out.size()));
  return out;
}

bool is_opaque(const Image& image) {
  std::uint8_t all = 255;
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) all &= image.rgba[i];
  return all == 255;
}

// The rows after the filter "Up": each byte less the one above it, so that a row equal to the one
// above is zeros. Three or four channels are kept.
std::string filtered(const Image& image, std::size_t channels) {
  const std::size_t stride = std::size_t{4} * image.width;
  const std::vector<std::uint8_t> zeros(stride);  // above the first row
  std::string rows(image.height * (1 + channels * image.width), '\0');
  char* to = rows.data();
  for (std::size_t y = 0; y < static_cast<std::size_t>(image.height); ++y) {
    const std::uint8_t* row = image.rgba.data() + y * stride;
    const std::uint8_t* above = y > 0 ? row - stride : zeros.data();
    *to++ = 2;
    for (std::size_t x = 0; x < stride; x += 4)
      for (std::size_t i = x; i < x + channels; ++i) *to++ = static_cast<char>(row[i] - above[i]);
  }
  return rows;
}

void put32(std::string& to, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) to += static_cast<char>(value >> shift & 255);
}

void put_chunk(std::string& to, std::string_view type, std::string_view data) {
  put32(to, static_cast<std::uint32_t>(data.size()));
  const std::size_t checked = to.size();
  to += type;
  to += data;
  put32(to, libdeflate_crc32(0, to.data() + checked, to.size() - checked));
}

}  // namespace

std::string png_text(const PngText& text) {
  LANTERN_CHECK(text.key.size() - 1, <, 79u);
  std::string chunk;
  std::string value = text.value;
  std::replace(value.begin(), value.end(), '\0', ' ');
  const bool ascii = std::all_of(value.begin(), value.end(), [](char c) { return c > 0; });
  if (ascii)
    put_chunk(chunk, "tEXt", text.key + '\0' + value);
  else  // not compressed, in no language, its key not translated
    put_chunk(chunk, "iTXt", text.key + std::string(5, '\0') + value);
  return chunk;
}

namespace {

PngBody body_of(const Image& image, bool opaque, std::string_view pixels) {
  std::string header;
  put32(header, static_cast<std::uint32_t>(image.width));
  put32(header, static_cast<std::uint32_t>(image.height));
  header += {8, opaque ? '\2' : '\6', 0, 0, 0};  // bits a channel; RGB or RGBA
  PngBody body{"\x89PNG\r\n\x1a\n", {}};
  put_chunk(body.header, "IHDR", header);
  put_chunk(body.pixels, "IDAT", pixels);
  return body;
}

PngBody compress_small(const Image& image) {
  stop_if_asked();
  const bool opaque = is_opaque(image);
  return body_of(image, opaque, deflated(filtered(image, opaque ? 3 : 4)));
}

PngBody compress_fast(const Image& image) {
  const std::optional<std::string> opaque = run_deflate(image, 3);
  return body_of(image, opaque.has_value(), opaque ? *opaque : *run_deflate(image, 4));
}

}  // namespace

PngBody compress(const Image& image, PngEffort effort) {
  LANTERN_CHECK(image.rgba.size(), ==, std::size_t{4} * image.width * image.height);
  LANTERN_CHECK(image.rgba.empty(), ==, false);
  return effort == PngEffort::fast ? compress_fast(image) : compress_small(image);
}

std::string assemble(const PngBody& body, const std::vector<PngText>& texts, int pixels_per_metre) {
  std::string png = body.header;
  if (pixels_per_metre > 0) {
    std::string data;
    put32(data, static_cast<std::uint32_t>(pixels_per_metre));
    put32(data, static_cast<std::uint32_t>(pixels_per_metre));
    data += '\1';  // the unit is the metre
    put_chunk(png, "pHYs", data);
  }
  for (const PngText& text : texts) png += png_text(text);
  png += body.pixels;
  return png += kPngEnd;
}

std::string encode_png(const Image& image, PngEffort effort, const std::vector<PngText>& texts,
                       int pixels_per_metre) {
  return assemble(compress(image, effort), texts, pixels_per_metre);
}

}  // namespace lantern
