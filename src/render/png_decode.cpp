#include <cstdint>
#include <cstring>
#include <memory>

#include <libdeflate.h>

#include "render/png.hpp"

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

namespace lantern {
namespace {

std::uint32_t big_endian(const char* at) {
  std::uint32_t value = 0;
  for (int i = 0; i < 4; ++i) value = value << 8 | static_cast<std::uint8_t>(at[i]);
  return value;
}

// stb checks no CRC and reads past missing chunks, so a damaged file could pass for a whole one.
// True if the signature is there, all chunks are whole, their CRCs right, and IEND is the end.
bool chunks_are_whole(std::string_view bytes) {
  constexpr std::string_view kSignature("\x89PNG\r\n\x1a\n", 8);
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

}  // namespace

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

}  // namespace lantern
