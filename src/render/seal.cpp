#include "render/seal.hpp"

#include <fmt/format.h>
#include <libdeflate.h>

#include "base/check.hpp"
#include "render/png.hpp"

namespace lantern::render {
namespace {

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
