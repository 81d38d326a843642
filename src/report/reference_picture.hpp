// The picture that antialiasing tries to be: every pixel the mean of 16 x 16 smaller ones.
#pragma once

#include <cstdint>
#include <vector>

#include "draw/draw_list.hpp"
#include "draw/theme.hpp"
#include "render/context.hpp"
#include "render/image.hpp"

namespace lantern::report {

// Sub-pixels along a pixel's side.
inline constexpr int kReferenceTimes = 16;

// The sub-pixels that 1, 4 and 8 samples a pixel take: the middle, and the standard places of
// multisampling (Direct3D 11.3 specification, 19.2), as whole 16ths from the upper left corner.
inline constexpr int kSampleCounts[] = {1, 4, 8};

struct ReferencePicture {
  int width = 0, height = 0;
  std::vector<float> rgb;          // levels 0 ... 255, not rounded; three a pixel
  std::vector<std::uint8_t> edge;  // 1 for pixels whose sub-pixels are not all the same
  // What samples without any coverage would give, one picture for each of kSampleCounts. A
  // sub-pixel stands for a sample, so places are good to a 32nd of a pixel.
  std::vector<Image> sampled;
};

// `list` must be settled for this size. It is drawn by Lantern itself, sixteen times as large and
// in tiles: a sub-pixel on an edge is again antialiased by coverage, whose errors are then a 16th
// as wide and even out over 16 sub-pixels. Levels are averaged as they are stored, which is how
// every method blends, too; light would be averaged otherwise (gamma), and that is not
// measured.
ReferencePicture reference_picture(const DrawList& list, const Theme& theme, int width, int height,
                                   Backend backend);

// Of an image `times` as large the means of times x times pixels, rounded; opaque. `small` is
// overwritten, its memory reused.
void box_filter(const Image& large, int times, Image& small);

// In levels of 255; a pixel's error is that of its worst channel.
struct PictureError {
  std::uint64_t edge_pixels = 0;
  double mean = 0;           // over the pixels that an edge touches
  double rms = 0;            // over the same
  double worst = 0;          // over all pixels
  std::uint64_t strays = 0;  // pixels without an edge that are off by more than one level
  bool operator==(const PictureError&) const = default;
};
PictureError error_of(const Image& image, const ReferencePicture& reference);

}  // namespace lantern::report
