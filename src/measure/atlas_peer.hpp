// What Lantern asks of another packer of textures. A peer is a module of its own
// (src/peers/atlas_*), loaded only when it is measured: it is built with nothing of Lantern but
// headers.
#pragma once

#include <functional>
#include <string>

#include "atlas/packer.hpp"
#include "rooms.hpp"

namespace lantern::measure {

// One way to pack one set of textures.
class TexturePacker {
 public:
  virtual ~TexturePacker() = default;
  // All it does for one atlas is timed, from the textures' sizes to where they lie.
  virtual bool pack(int width, int height) = 0;  // is each of them packed?
  // Of the last call, for each texture; nothing for one that has no place.
  virtual std::vector<std::optional<TexturePlace>> places() const = 0;
  virtual std::uint64_t leaf_tests() const { return 0; }  // so far, where they are counted
  virtual std::uint64_t bytes() const = 0;                // that it holds, beside the sizes given
};

struct AtlasPeer {
  std::string name, version;  // "stb_rect_pack, bottom left", "1.01"
  std::string how;            // a sentence: what of it is run, and how
  std::function<std::unique_ptr<TexturePacker>(std::span<const TextureSize>)> start;
};

// The one function of a module: adds its peers. By the name "lantern_atlas_peers", C linkage.
using AtlasPeersOfModule = void (*)(std::vector<AtlasPeer>&);

}  // namespace lantern::measure
