// A file that says itself what it was made from, and that it is as it was written. So a picture of
// an earlier run is kept exactly when it is the one that is wanted now, whatever else is in its
// folder, and a file that somebody has changed since is not taken for Lantern's.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace lantern::render {

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
