// A file tells what it was made from, and whether it is as it was written.
#include <gtest/gtest.h>

#include "render/png.hpp"

namespace lantern::render {
namespace {

const MadeFrom kFrom{"0123456789abcdef", "fedcba9876543210"};

std::string unsealed(FileKind kind) {
  if (kind == FileKind::json) return "{\n\"format\": \"lantern.frame/2\",\n\"frame\": 7\n}\n";
  if (kind == FileKind::svg) return "<svg xmlns=\"http://www.w3.org/2000/svg\">\n</svg>\n";
  Image image{3, 2, {}};
  for (std::uint8_t i = 0; i < 24; ++i) image.rgba.push_back(i);
  return encode_png(image, PngEffort::fast, {{"Title", "seal"}}, 0);
}

class Seal : public testing::TestWithParam<FileKind> {};

TEST_P(Seal, GivesBackWhatTheFileWasMadeFrom) {
  const std::string bytes = sealed(GetParam(), unsealed(GetParam()), kFrom);
  EXPECT_EQ(made_from(GetParam(), bytes), kFrom);
  if (GetParam() == FileKind::png) {
    EXPECT_TRUE(decode_png(bytes)) << "it is still a whole PNG";
  }
}

TEST_P(Seal, AFileWithoutOneHasNone) {
  EXPECT_FALSE(made_from(GetParam(), unsealed(GetParam())));
  EXPECT_FALSE(made_from(GetParam(), ""));
}

TEST_P(Seal, EveryChangedByteAndEveryCutIsSeen) {
  const std::string bytes = sealed(GetParam(), unsealed(GetParam()), kFrom);
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::string changed = bytes;
    changed[i] = static_cast<char>(changed[i] ^ 1);
    EXPECT_FALSE(made_from(GetParam(), changed)) << "byte " << i;
    EXPECT_FALSE(made_from(GetParam(), std::string_view(bytes).substr(0, i))) << i << " bytes";
  }
  EXPECT_FALSE(made_from(GetParam(), bytes + "\n"));
}

INSTANTIATE_TEST_SUITE_P(Kinds, Seal,
                         testing::Values(FileKind::png, FileKind::svg, FileKind::json));

}  // namespace
}  // namespace lantern::render
