#include "render/png.hpp"

#include <map>
#include <numeric>
#include <thread>

#include <gtest/gtest.h>
#include <libdeflate.h>

#include "base/random.hpp"
#include "render/deflate.hpp"
#include "render/sample_scene.hpp"
#include "render/support.hpp"

namespace lantern::render {
namespace {

enum class Look { flat, drawing, noise, gradient };

Image made_image(int width, int height, Look look, bool opaque, std::uint64_t seed) {
  Random random(seed);
  Image image{width, height, {}};
  image.rgba.resize(std::size_t{4} * width * height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      std::uint8_t* p = &image.rgba[4 * (static_cast<std::size_t>(y) * width + x)];
      for (int c = 0; c < 4; ++c) {
        std::uint64_t value = 200;
        if (look == Look::noise) value = random.bits();
        if (look == Look::gradient) value = static_cast<std::uint64_t>(x + y * c);
        if (look == Look::drawing) value = (x / 9 + y / 5) % 4 == 0 ? 30 * c : 250;
        p[c] = static_cast<std::uint8_t>(value);
      }
      if (opaque) p[3] = 255;
    }
  return image;
}

struct Chunk {
  std::string type, data;
};

// Reads the file as the specification tells, checking lengths and CRCs.
std::vector<Chunk> chunks_of(const std::string& png) {
  std::vector<Chunk> chunks;
  EXPECT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1a\n");
  const auto word = [&](std::size_t i) {
    std::uint32_t v = 0;
    for (std::size_t k = 0; k < 4; ++k) v = v << 8 | static_cast<std::uint8_t>(png[i + k]);
    return v;
  };
  for (std::size_t i = 8; i + 12 <= png.size();) {
    const std::size_t length = word(i);
    chunks.push_back({png.substr(i + 4, 4), png.substr(i + 8, length)});
    EXPECT_EQ(word(i + 8 + length), libdeflate_crc32(0, &png[i + 4], length + 4))
        << "CRC of " << chunks.back().type;
    i += 12 + length;
    if (chunks.back().type == "IEND") {
      EXPECT_EQ(i, png.size());
    }
  }
  return chunks;
}

TEST(Png, RoundTrip) {
  const std::pair<int, int> sizes[] = {{1, 1}, {1, 40}, {40, 1}, {87, 3}, {172, 5}, {259, 61}};
  for (const PngEffort effort : {PngEffort::fast, PngEffort::small})
    for (const Look look : {Look::flat, Look::drawing, Look::noise, Look::gradient})
      for (const bool opaque : {true, false})
        for (const auto& [width, height] : sizes) {
          const Image image = made_image(width, height, look, opaque, 7);
          const auto back = decode_png(encode_png(image, effort, {}, 0));
          ASSERT_TRUE(back) << width << " x " << height;
          ASSERT_EQ(*back, image) << width << " x " << height << " look " << int(look);
        }
}

TEST(Png, RoundTripOfManyBlocks) {
  // Noise of more tokens than one deflate block takes.
  for (const bool opaque : {true, false}) {
    const Image image = made_image(701, 503, Look::noise, opaque, 8);
    EXPECT_EQ(decode_png(encode_png(image, PngEffort::fast, {}, 0)), image);
  }
}

TEST(Png, OneTransparentPixelAnywhereKeepsAlpha) {
  for (const std::size_t pixel : {0u, 55u, 50u * 30u - 1u}) {
    Image image = made_image(50, 30, Look::flat, true, 1);
    image.rgba[4 * pixel + 3] = 254;
    EXPECT_EQ(decode_png(encode_png(image, PngEffort::fast, {}, 0)), image) << pixel;
    EXPECT_EQ(decode_png(encode_png(image, PngEffort::small, {}, 0)), image) << pixel;
  }
}

TEST(Png, ChunksAreInOrderAndCarryWhatWasAsked) {
  const Image image = made_image(50, 30, Look::drawing, true, 1);
  for (const PngEffort effort : {PngEffort::fast, PngEffort::small}) {
    const auto chunks = chunks_of(encode_png(image, effort,
                                             {{"Frame", "12"},
                                              {"Title",
                                               "Gr\xc3\xbc\xc3\x9f"
                                               "e"},
                                              {"A", {"b\0c", 3}}},
                                             6299));
    std::string order;
    for (const Chunk& c : chunks) order += c.type + ' ';
    EXPECT_EQ(order, "IHDR pHYs tEXt iTXt tEXt IDAT IEND ");
    EXPECT_EQ(chunks[0].data[9], 2) << "opaque pixels need no alpha: RGB";
    EXPECT_EQ(chunks[1].data, std::string("\0\0\x18\x9b\0\0\x18\x9b\1", 9));
    EXPECT_EQ(chunks[2].data, std::string("Frame\0"
                                          "12",
                                          8));
    EXPECT_EQ(chunks[3].data, std::string("Title\0\0\0\0\0Gr\xc3\xbc\xc3\x9f"
                                          "e",
                                          17));
    EXPECT_EQ(chunks[4].data, std::string("A\0b c", 5)) << "a NUL would end the text";
  }
}

TEST(Png, WithoutResolutionThereIsNoPhys) {
  for (const Chunk& c :
       chunks_of(encode_png(made_image(5, 5, Look::flat, false, 1), PngEffort::fast, {}, 0)))
    EXPECT_NE(c.type, "pHYs");
}

TEST(Png, BothEffortsAtOnceInManyThreads) {
  const Image image = drawn(sample_scene(), 640, 360, false, *theme_named("light"));
  const std::string fast = encode_png(image, PngEffort::fast, {}, 0);
  const std::string small = encode_png(image, PngEffort::small, {}, 0);
  EXPECT_LT(small.size(), fast.size());
  std::vector<int> wrong(4);
  {
    std::vector<std::jthread> threads;
    for (int t = 0; t < 4; ++t)
      threads.emplace_back([&, t] {
        for (int i = 0; i < 10; ++i) {
          const bool is_fast = (i + t) % 2 == 0;
          const std::string png =
              encode_png(image, is_fast ? PngEffort::fast : PngEffort::small, {}, 0);
          wrong[static_cast<std::size_t>(t)] += png != (is_fast ? fast : small);
        }
      });
  }
  EXPECT_EQ(std::accumulate(wrong.begin(), wrong.end(), 0), 0);
}

TEST(Png, DecodeRefusesWhatIsTooLarge) {
  const std::string png =
      encode_png(made_image(20, 10, Look::flat, true, 1), PngEffort::fast, {}, 0);
  EXPECT_TRUE(decode_png(png, 200));
  EXPECT_FALSE(decode_png(png, 199));
}

TEST(Png, DamagedFilesAreRefused) {
  Random random(9);
  const Image image = made_image(60, 40, Look::drawing, true, 2);
  const std::string good = encode_png(image, PngEffort::fast, {{"Frame", "1"}}, 100);
  EXPECT_FALSE(decode_png(""));
  EXPECT_FALSE(decode_png("not a picture"));
  for (std::size_t length = 0; length < good.size(); ++length)
    ASSERT_FALSE(decode_png(good.substr(0, length))) << "cut off after " << length;
  EXPECT_FALSE(decode_png(good + "x")) << "something after the end";
  for (int i = 0; i < 2000; ++i) {
    std::string bad = good;
    const auto where = static_cast<std::size_t>(random.whole(0, std::int64_t(bad.size()) - 1));
    bad[where] = static_cast<char>(bad[where] ^ random.whole(1, 255));
    ASSERT_FALSE(decode_png(bad)) << "byte " << where;
  }
}

// Damage that its maker has signed with right CRCs must neither crash nor hang the decoder.
TEST(Png, SignedDamageDoesNotCrash) {
  Random random(10);
  const std::string good =
      encode_png(made_image(60, 40, Look::noise, false, 3), PngEffort::small, {}, 0);
  for (int i = 0; i < 3000; ++i) {
    std::string bad = good;
    for (std::int64_t k = random.whole(1, 4); k > 0; --k)
      bad[static_cast<std::size_t>(random.whole(8, std::int64_t(bad.size()) - 1))] =
          static_cast<char>(random.bits());
    for (std::size_t at = 8; at + 12 <= bad.size();) {
      std::uint32_t length = 0;
      for (std::size_t k = 0; k < 4; ++k)
        length = length << 8 | static_cast<std::uint8_t>(bad[at + k]);
      if (length > bad.size() - at - 12) break;
      const std::uint32_t crc = libdeflate_crc32(0, &bad[at + 4], length + 4);
      for (std::size_t k = 0; k < 4; ++k)
        bad[at + 8 + length + k] = static_cast<char>(crc >> (24 - 8 * k));
      at += 12 + length;
    }
    const auto image = decode_png(bad, 10000);
    if (image) {
      ASSERT_EQ(image->rgba.size(), std::size_t{4} * image->width * image->height);
    }
  }
}

// The bytes of a PNG's rows, each with the filter "None" before it.
std::string rows_of(const Image& image, std::size_t channels) {
  std::string rows;
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
    if (i / 4 % static_cast<std::size_t>(image.width) == 0) rows += '\0';
    rows.append(reinterpret_cast<const char*>(&image.rgba[i]), channels);
  }
  return rows;
}

TEST(BandDeflate, IsTheRowsForAnotherInflate) {
  // Wide rows lie further apart than deflate looks back.
  for (const auto& [width, height] : {std::pair(333, 77), std::pair(8192, 40)})
    for (const Look look : {Look::drawing, Look::gradient})
      for (const int channels : {3, 4}) {
        const Image image = made_image(width, height, look, channels == 3, 4);
        BandStream joined;
        Band band;
        for (int row = 0; row < height; row += kBandRows) {
          take_band(image, row, band);
          joined.add(pack(band, channels));
        }
        const std::string stream = joined.finish();
        const std::string expected = rows_of(image, static_cast<std::size_t>(channels));
        std::string actual(expected.size(), '\0');
        libdeflate_decompressor* d = libdeflate_alloc_decompressor();
        std::size_t size = 0;
        EXPECT_EQ(libdeflate_zlib_decompress(d, stream.data(), stream.size(), actual.data(),
                                             actual.size(), &size),
                  LIBDEFLATE_SUCCESS);  // which says that Adler-32 is right, too
        libdeflate_free_decompressor(d);
        EXPECT_EQ(size, expected.size());
        EXPECT_TRUE(actual == expected) << width << " x " << height;
      }
}

TEST(BandDeflate, ABandDependsOnItsRowsAndTheOneAbove) {
  const Image image = made_image(200, 96, Look::drawing, true, 5);
  const auto packed = [](const Image& of) {
    Band band;
    take_band(of, kBandRows, band);
    return pack(band, 3).blocks;
  };
  const std::string expected = packed(image);
  for (const int row : {0, 30, 31, 32, 63, 64, 95}) {
    Image other = image;
    other.rgba[4 * (static_cast<std::size_t>(row) * 200 + 100)] ^= 255;
    EXPECT_EQ(packed(other) == expected, row < 31 || row > 63) << row;
  }
}

TEST(BandDeflate, ChecksumsAreJoined) {
  const std::string bytes = rows_of(made_image(50, 40, Look::noise, true, 6), 3);
  for (const std::size_t first : {std::size_t{0}, std::size_t{1}, bytes.size() / 2, bytes.size()})
    EXPECT_EQ(joined_adler(libdeflate_adler32(1, bytes.data(), first),
                           libdeflate_adler32(1, bytes.data() + first, bytes.size() - first),
                           bytes.size() - first),
              libdeflate_adler32(1, bytes.data(), bytes.size()));
}

TEST(Huffman, LengthsAreLimitedAndFillTheCode) {
  Random random(11);
  for (int i = 0; i < 200; ++i) {
    std::vector<std::uint32_t> counts(286);
    std::uint32_t a = 1, b = 1;
    for (std::uint32_t& count : counts) {
      if (i % 2 == 0) {
        // Fibonacci numbers make the deepest tree.
        count = a;
        a = std::exchange(b, std::min(a + b, 1u << 28));
      } else if (random.unit() < 0.3) {
        count = static_cast<std::uint32_t>(random.whole(1, 1000000));
      }
    }
    const auto lengths = code_lengths(counts, 15);
    double kraft = 0;
    for (std::size_t s = 0; s < counts.size(); ++s) {
      EXPECT_LE(lengths[s], 15);
      EXPECT_EQ(lengths[s] > 0, counts[s] > 0);
      if (lengths[s] > 0) kraft += std::ldexp(1.0, -lengths[s]);
    }
    EXPECT_EQ(kraft, 1.0) << "decoders refuse a code with holes or overlaps";
  }
}

TEST(Huffman, OneSymbolAloneStillHasACode) {
  const std::vector<std::uint32_t> counts{0, 0, 5, 0};
  const auto lengths = code_lengths(counts, 7);
  EXPECT_EQ(lengths[2], 1);
  EXPECT_EQ(std::accumulate(lengths.begin(), lengths.end(), 0), 2);
}

}  // namespace
}  // namespace lantern::render
