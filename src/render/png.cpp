#include "render/png.hpp"

#include <algorithm>
#include <cstring>
#include <memory>
#include <new>

#include <fmt/format.h>
#include <libdeflate.h>

#include "base/check.hpp"
#include "base/stop.hpp"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-function"
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_NO_STDIO
#define STBI_NO_LINEAR
#define STBI_NO_HDR
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace lantern::render {
namespace {

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

constexpr std::string_view kSignature("\x89PNG\r\n\x1a\n", 8);

std::uint32_t big_endian(const char* at) {
  std::uint32_t value = 0;
  for (int i = 0; i < 4; ++i) value = value << 8 | static_cast<std::uint8_t>(at[i]);
  return value;
}

// stb checks no CRC and reads past missing chunks, so a damaged file could pass for a whole one.
// True if the signature is there, all chunks are whole, their CRCs right, and IEND is the end.
bool chunks_are_whole(std::string_view bytes) {
  if (!bytes.starts_with(kSignature)) return false;
  bytes.remove_prefix(kSignature.size());
  while (bytes.size() >= 12) {
    const std::size_t length = big_endian(bytes.data());
    if (length > bytes.size() - 12) return false;
    const std::string_view checked = bytes.substr(4, 4 + length);
    if (libdeflate_crc32(0, checked.data(), checked.size()) != big_endian(&bytes[8 + length]))
      return false;
    bytes.remove_prefix(12 + length);
    if (checked.starts_with("IEND")) return bytes.empty();
  }
  return false;
}

constexpr std::size_t kKey = 16;  // hexadecimal digits

// What ends a file without a seal, and is its end with a seal, too.
std::string_view ending(FileKind kind) {
  constexpr std::string_view kEndings[] = {kPngEnd, "", "\n}\n"};
  return kEndings[static_cast<int>(kind)];
}

// What the seal of a kind begins with.
constexpr std::string_view kSvgSeal = "<!-- Lantern made this from ";
constexpr std::string_view kJsonSeal = ",\n\"made_from\": \"";

// The seal of what stands before it.
std::string seal(FileKind kind, std::string_view before, const MadeFrom& from) {
  std::uint32_t crc = libdeflate_crc32(0, before.data(), before.size());
  for (const std::string& key : {from.facts, from.picture})
    crc = libdeflate_crc32(crc, key.data(), key.size());
  const std::string keys = from.facts + "-" + from.picture;
  if (kind == FileKind::png)
    return png_text({"Made from", fmt::format("{}, checksum {:08x}", keys, crc)});
  if (kind == FileKind::svg) return fmt::format("{}{}, checksum {:08x} -->\n", kSvgSeal, keys, crc);
  return fmt::format("{}{}\",\n\"checksum\": \"{:08x}\"", kJsonSeal, keys, crc);
}

}  // namespace

std::string deflated(std::string_view bytes, int level) {
  const std::unique_ptr<libdeflate_compressor, void (*)(libdeflate_compressor*)> compressor(
      libdeflate_alloc_compressor(level), libdeflate_free_compressor);
  if (!compressor) throw std::bad_alloc();
  std::string out(libdeflate_zlib_compress_bound(compressor.get(), bytes.size()), '\0');
  out.resize(libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(), out.data(),
                                      out.size()));
  return out;
}

std::string png_text(const PngText& text) {
  LANTERN_CHECK(text.key.size() - 1, <, 79u);
  std::string chunk;
  std::string value = text.value;
  std::ranges::replace(value, '\0', ' ');
  const bool ascii = std::ranges::all_of(value, [](char c) { return c > 0; });
  if (ascii)
    put_chunk(chunk, "tEXt", text.key + '\0' + value);
  else  // not compressed, in no language, its key not translated
    put_chunk(chunk, "iTXt", text.key + std::string(5, '\0') + value);
  return chunk;
}

void take_band(const Image& image, int row, Band& to) {
  const int above = row > 0 ? 1 : 0;
  to.width = image.width;
  to.rows = std::min(kBandRows, image.height - row);
  to.has_above = above > 0;
  const auto width = static_cast<std::size_t>(image.width);
  to.pixels.resize(width * static_cast<std::size_t>(to.rows + above));
  std::memcpy(to.pixels.data(), &image.rgba[4 * width * static_cast<std::size_t>(row - above)],
              4 * to.pixels.size());
  std::uint32_t all = ~0u;
  for (std::size_t i = above * width; i < to.pixels.size(); ++i) all &= to.pixels[i];
  to.is_opaque = all >> 24 == 255;
}

std::string small_stream(std::span<const Band* const> bands, int channels) {
  stop_if_asked();
  std::string rows;
  for (const Band* band : bands) {
    const auto width = static_cast<std::size_t>(band->width);
    const std::uint32_t* pixel = band->pixels.data() + (band->has_above ? width : 0);
    const std::size_t at = rows.size(), stride = 1 + static_cast<std::size_t>(channels) * width;
    rows.resize(at + stride * static_cast<std::size_t>(band->rows));
    char* to = rows.data() + at;
    for (int y = 0; y < band->rows; ++y) {
      *to++ = 0;  // the filter "None": with it files are a sixth smaller than with "Up"
      for (std::size_t x = 0; x < width; ++x, ++pixel, to += channels)
        std::memcpy(to, pixel, static_cast<std::size_t>(channels));
    }
  }
  constexpr int kLevel = 6;  // of 12: 7 takes a quarter longer for files 1 % smaller
  return deflated(rows, kLevel);
}

PngBody png_body(int width, int height, int channels, const std::string& stream) {
  std::string header;
  put32(header, static_cast<std::uint32_t>(width));
  put32(header, static_cast<std::uint32_t>(height));
  header += {8, channels == 3 ? '\2' : '\6', 0, 0, 0};  // bits a channel; RGB or RGBA
  PngBody body{std::string(kSignature), {}};
  put_chunk(body.header, "IHDR", header);
  put_chunk(body.pixels, "IDAT", stream);
  return body;
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
  LANTERN_CHECK(image.rgba.size(), ==, std::size_t{4} * image.width * image.height);
  LANTERN_CHECK(image.rgba.empty(), ==, false);
  std::vector<Band> bands;  // from the uppermost down
  for (int row = 0; row < image.height; row += kBandRows)
    take_band(image, row, bands.emplace_back());
  const int channels = std::ranges::all_of(bands, &Band::is_opaque) ? 3 : 4;
  std::string stream;
  if (effort == PngEffort::fast) {
    BandStream joined;
    for (const Band& band : bands) joined.add(pack(band, channels));
    stream = joined.finish();
  } else {
    std::vector<const Band*> all;
    for (const Band& band : bands) all.push_back(&band);
    stream = small_stream(all, channels);
  }
  return assemble(png_body(image.width, image.height, channels, stream), texts, pixels_per_metre);
}

std::optional<Image> decode_png(std::string_view bytes, std::size_t most_pixels) {
  if (bytes.size() > INT32_MAX || !chunks_are_whole(bytes)) return std::nullopt;
  const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
  const int size = static_cast<int>(bytes.size());
  int width = 0, height = 0, channels = 0;
  if (!stbi_info_from_memory(data, size, &width, &height, &channels) || width < 1 || height < 1 ||
      static_cast<std::size_t>(width) > most_pixels / static_cast<std::size_t>(height))
    return std::nullopt;
  const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
      stbi_load_from_memory(data, size, &width, &height, &channels, 4), stbi_image_free);
  if (!pixels) return std::nullopt;
  Image image{width, height, {}};
  image.rgba.assign(pixels.get(), pixels.get() + std::size_t{4} * width * height);
  return image;
}

std::string sealed(FileKind kind, std::string bytes, const MadeFrom& from) {
  LANTERN_CHECK(from.facts.size(), ==, kKey);
  LANTERN_CHECK(from.picture.size(), ==, kKey);
  const std::string_view end = ending(kind);
  LANTERN_CHECK(bytes.ends_with(end), ==, true);
  bytes.resize(bytes.size() - end.size());
  bytes += seal(kind, bytes, from);
  return bytes += end;
}

std::optional<MadeFrom> made_from(FileKind kind, std::string_view bytes) {
  // In all seals of a kind the keys begin at the same place, and all are as long.
  const MadeFrom model{std::string(kKey, 'f'), std::string(kKey, 'p')};
  const std::string any = seal(kind, "", model);
  const std::size_t keys = any.find(model.facts + "-" + model.picture);
  const std::string_view end = ending(kind);
  if (bytes.size() < any.size() + end.size() || !bytes.ends_with(end)) return std::nullopt;
  bytes.remove_suffix(end.size());
  const std::string_view before = bytes.substr(0, bytes.size() - any.size());
  const std::string_view written = bytes.substr(before.size());
  const MadeFrom from{std::string(written.substr(keys, kKey)),
                      std::string(written.substr(keys + kKey + 1, kKey))};
  if (seal(kind, before, from) != written) return std::nullopt;
  return from;
}

std::string_view before_seal(FileKind kind, std::string_view bytes) {
  if (kind == FileKind::png) return bytes;
  const std::size_t at = bytes.rfind(kind == FileKind::svg ? kSvgSeal : kJsonSeal);
  if (at != bytes.npos) return bytes.substr(0, at);
  const std::string_view end = ending(kind);
  return bytes.substr(0, bytes.size() - (bytes.ends_with(end) ? end.size() : 0));
}

}  // namespace lantern::render
