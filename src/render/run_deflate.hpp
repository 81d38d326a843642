// A zlib stream (RFC 1950, 1951) of drawings, written fast. Drawings are flat: most rows equal the
// row above, most others differ from it in a few places. With the PNG filter "Up" what is equal
// becomes zeros, and the only repetition looked for is that of the last pixel. So equal rows cost
// one comparison, where a general deflate hashes each of their bytes.
//
// Why not a library: a frame of 1080p with 100 shapes took stb's own deflate 142 ms, libdeflate 16
// ms (files of 14 to 20 KB) and ISA-L, which is one more package, 1.0 to 1.5 ms (50 to 80 KB). This
// does as ISA-L does: with all of drawing and writing it came to 158 to 225 frames a second, its
// files 1.5 times as large as those of libdeflate (`lantern bench frames`).
#pragma once

#include <optional>
#include <string>

#include "render/image.hpp"

namespace lantern {

// The pixels of a PNG as its IDAT chunk holds them; `channels` is 3 (without alpha) or 4. Nothing
// if there are 3 and a pixel is not opaque.
std::optional<std::string> run_deflate(const Image& image, int channels);

}  // namespace lantern
