#include "render/png.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <memory>

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

// stb's compression hook: a zlib stream in memory from malloc, or null.
unsigned char* deflate(unsigned char* data, int size, int* out_size, int) {
  thread_local const Compressor compressor(libdeflate_alloc_compressor(kLevel));
  if (!compressor) return nullptr;
  const auto bytes = static_cast<std::size_t>(size);
  const std::size_t room = libdeflate_zlib_compress_bound(compressor.get(), bytes);
  auto* out = static_cast<unsigned char*>(std::malloc(room));
  if (!out) return nullptr;
  *out_size = static_cast<int>(libdeflate_zlib_compress(compressor.get(), data, bytes, out, room));
  return out;
}

}  // namespace
}  // namespace lantern

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#define STBIW_ZLIB_COMPRESS lantern::deflate
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

namespace lantern {
namespace {

constexpr std::size_t kSignatureBytes = 8, kHeaderChunk = 12 + 13;

// Set once, before any thread encodes. Up turns a row equal to the one above into zeros.
[[maybe_unused]] const int filter_is_up = stbi_write_force_png_filter = 2;

bool is_opaque(const Image& image) {
  std::uint8_t all = 255;
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) all &= image.rgba[i];
  return all == 255;
}

std::vector<std::uint8_t> without_alpha(const Image& image) {
  const std::size_t pixels = image.rgba.size() / 4;
  std::vector<std::uint8_t> rgb(3 * pixels);
  for (std::size_t i = 0; i < pixels; ++i)
    for (std::size_t c = 0; c < 3; ++c) rgb[3 * i + c] = image.rgba[4 * i + c];
  return rgb;
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

// By stb_image_write, with libdeflate in place of its own compressor.
PngBody compress_small(const Image& image) {
  stop_if_asked();
  const bool opaque = is_opaque(image);
  const std::vector<std::uint8_t> rgb = opaque ? without_alpha(image) : std::vector<std::uint8_t>();
  int size = 0;
  const std::unique_ptr<unsigned char, void (*)(void*)> png(
      stbi_write_png_to_mem(opaque ? rgb.data() : image.rgba.data(), 0, image.width, image.height,
                            opaque ? 3 : 4, &size),
      std::free);
  if (!png) throw std::bad_alloc();
  const std::string_view bytes(reinterpret_cast<const char*>(png.get()),
                               static_cast<std::size_t>(size));
  PngBody body;
  body.header = bytes.substr(0, kSignatureBytes + kHeaderChunk);
  body.pixels =
      bytes.substr(body.header.size(), bytes.size() - body.header.size() - kPngEnd.size());
  return body;
}

PngBody compress_fast(const Image& image) {
  std::optional<std::string> pixels = run_deflate(image, 3);
  const bool opaque = pixels.has_value();
  if (!opaque) pixels = run_deflate(image, 4);
  std::string header;
  put32(header, static_cast<std::uint32_t>(image.width));
  put32(header, static_cast<std::uint32_t>(image.height));
  header += {8, opaque ? '\2' : '\6', 0, 0, 0};  // bits a channel; RGB or RGBA
  PngBody body;
  body.header = "\x89PNG\r\n\x1a\n";
  put_chunk(body.header, "IHDR", header);
  put_chunk(body.pixels, "IDAT", *pixels);
  return body;
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
