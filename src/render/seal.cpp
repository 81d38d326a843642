#include "render/seal.hpp"

#include <fmt/format.h>
#include <libdeflate.h>

#include "base/check.hpp"
#include "render/png_parts.hpp"

namespace lantern {
namespace {

constexpr std::size_t kKey = 16;  // hexadecimal digits

// What ends a file without a seal, and is its end with a seal, too.
std::string_view ending(FileKind kind) {
  switch (kind) {
    case FileKind::png:
      return kPngEnd;
    case FileKind::svg:
      return "";
    case FileKind::json:
      return "\n}\n";
  }
  return "";
}

// The seal of what stands before it.
std::string seal(FileKind kind, std::string_view before, const MadeFrom& from) {
  std::uint32_t crc = libdeflate_crc32(0, before.data(), before.size());
  for (const std::string& key : {from.facts, from.picture})
    crc = libdeflate_crc32(crc, key.data(), key.size());
  const std::string sum = fmt::format("{:08x}", crc);
  switch (kind) {
    case FileKind::png:
      return png_text(
          {"Made from", fmt::format("{}-{}, checksum {}", from.facts, from.picture, sum)});
    case FileKind::svg:
      return fmt::format("<!-- Lantern made this from {}-{}, checksum {} -->\n", from.facts,
                         from.picture, sum);
    case FileKind::json:
      return fmt::format(",\n\"made_from\": \"{}-{}\",\n\"checksum\": \"{}\"", from.facts,
                         from.picture, sum);
  }
  return {};
}

// Where the keys begin in a seal, and how long it is: the same in all seals of a kind.
struct SealShape {
  std::size_t keys = 0;
  std::size_t size = 0;
};
SealShape shape_of(FileKind kind) {
  const MadeFrom model{std::string(kKey, 'f'), std::string(kKey, 'p')};
  const std::string text = seal(kind, "", model);
  return {text.find(model.facts + "-" + model.picture), text.size()};
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
  const SealShape shape = shape_of(kind);
  const std::string_view end = ending(kind);
  if (bytes.size() < shape.size + end.size() || !bytes.ends_with(end)) return std::nullopt;
  bytes.remove_suffix(end.size());
  const std::string_view before = bytes.substr(0, bytes.size() - shape.size);
  const std::string_view written = bytes.substr(before.size());
  const MadeFrom from{std::string(written.substr(shape.keys, kKey)),
                      std::string(written.substr(shape.keys + kKey + 1, kKey))};
  if (seal(kind, before, from) != written) return std::nullopt;
  return from;
}

}  // namespace lantern
