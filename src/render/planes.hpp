// Pictures as encoders of films take them: brightness and colour apart.
#pragma once

#include <cstdint>
#include <vector>

#include "render/image.hpp"
#include "render/instances.hpp"

namespace lantern::render {

// Bytes of a picture's planes Y, Cb and Cr, one after the other, their rows without gaps; a sample
// of colour stands for two columns and two rows, of an odd side's last for one.
std::size_t planes_bytes(int width, int height);

// Takes the pixels of `rect` over into `planes`, of planes_bytes(): Y'CbCr of ITU-R BT.709-6,
// items 3.2 to 3.4, in eight bits (Y 16 ... 235, colours 16 ... 240), each the nearest one but for
// an error of the weights below 0.02. A sample of colour lies on the left one of its columns and
// between its rows, as players of H.264 and VP9 expect it, and is the mean of what is around it by
// the weights 1 2 1 in each row. Alpha is left out.
void put_planes(const Image& image, const PixelRect& rect, std::vector<std::uint8_t>& planes);

}  // namespace lantern::render
