// The pixels of a PNG packed in bands of rows, each by itself, so that of pictures that follow each
// other only the bands that differ are packed again. The bytes of a band depend on its rows and the
// one above them, on nothing else, and a picture's are those of its bands, whichever was packed
// when.
//
// Drawings are flat: most rows equal the row above, most others differ from it in a few places. So
// rows are compared as a whole, and only where they differ a repetition is looked for, pixel by
// pixel: of the last pixel, and, by a table of places, of a pair of pixels or a single one. A
// general deflate hashes each byte: libdeflate takes four times as long for files a tenth smaller.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lantern::render {

// Rows of a picture without gaps between them, 4 bytes a pixel as in an Image.
struct Band {
  int width = 0;
  int rows = 0;  // that are packed
  // The row above stands before them; of a picture's first band there is none.
  bool has_above = false;
  bool is_opaque = true;  // all of the rows packed
  std::vector<std::uint32_t> pixels;
};

inline constexpr int kBandRows = 32;

// A band as a part of a zlib stream: blocks of deflate that end with a whole byte.
struct PackedBand {
  std::string blocks;
  std::uint32_t adler =
      1;  // Adler-32 of the bytes packed: for each row 0, the filter "None", pixels
  std::uint64_t bytes = 0;  // that were packed
};

// `channels` is 3 (without alpha) or 4.
PackedBand pack(const Band& band, int channels);

// A zlib stream of bands, from the uppermost down.
class BandStream {
 public:
  void add(const PackedBand& band);
  std::string finish();

 private:
  std::string bytes_{"\x78\x01", 2};  // zlib, fastest
  std::uint32_t adler_ = 1;
};

// Adler-32 of bytes and `length` more behind them.
std::uint32_t joined_adler(std::uint32_t first, std::uint32_t second, std::uint64_t length);

}  // namespace lantern::render
