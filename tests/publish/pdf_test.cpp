// Documents: the same bytes twice, the picture of the other renderer, and words that are found.
#include "publish/paper.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <new>
#include <string>

#include <gtest/gtest.h>

#include "base/child.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "draw/labels.hpp"
#include "fresh_folder.hpp"
#include "render/cairo_painter.hpp"
#include "render/png.hpp"
#include "render/renderer.hpp"
#include "render/sample_scene.hpp"

namespace lantern::publish {
namespace {

const Theme kLight = *theme_named("light");

std::string document(int pages) {
  PdfDocument pdf({"Trees and more", "a test", "Lantern test"});
  for (int i = 0; i < pages; ++i) {
    pdf.add_page(sample_scene(i), kLight, true, {720, 405}, std::to_string(i));
    pdf.add_entry("step " + std::to_string(i));
  }
  return pdf.finish();
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++found;
  return found;
}

// What a program of poppler's prints of the document.
std::string read_by(const std::string& program, const std::string& pdf, const std::string& words) {
  const auto file = fresh_folder("pdf-" + program) / "a.pdf";
  write_file(file, pdf);
  const std::string line = program + " " + file.string() + " " + words;
  std::string text;
  if (FILE* pipe = ::popen(line.c_str(), "r")) {
    for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) text += static_cast<char>(c);
    EXPECT_EQ(::pclose(pipe), 0) << line;
  }
  return text;
}

TEST(Pdf, HasThePagesThatWereAddedAndNoClock) {
  const std::string pdf = document(3);
  EXPECT_TRUE(pdf.starts_with("%PDF-1."));
  EXPECT_EQ(count(pdf, "/MediaBox [ 0 0 720 405 ]"), 3u);
  EXPECT_EQ(count(pdf, "CreationDate"), 0u);
  EXPECT_EQ(count(pdf, "(Trees and more)"), 1u);
  EXPECT_EQ(count(pdf, "(Lantern test)"), 1u);
  EXPECT_EQ(document(3), pdf) << "the same pages, other bytes";
}

TEST(Pdf, CairoWithoutMemoryIsAProgramWithoutMemory) {
  EXPECT_THROW(render::cairo().require(1), std::bad_alloc);
  EXPECT_THROW(render::cairo().require(2), BackendError);
}

TEST(Pdf, EmbedsBothWeightsOnceForAllPages) {
  EXPECT_EQ(count(document(1), "/FontFile3"), 2u);
  EXPECT_EQ(count(document(4), "/FontFile3"), 2u);
  EXPECT_LT(document(4).size(), 3 * document(1).size());
}

TEST(Pdf, WordsAreFound) {
  if (!find_program("pdftotext")) GTEST_SKIP() << "no poppler-utils";
  DrawList list;
  list.shapes.emplace_back(text("AVATAR To. Töpfe × 12", 100, 100, 30));
  list.shapes.emplace_back(
      text("below a halo", 800, 300, 24, Role::ink, 0.5, Weight::semibold, Role::lit_fill));
  list.shapes.emplace_back(text("no ﬁnal \xff", 100, 400, 24));
  PdfDocument pdf({"T", "", "L"});
  pdf.add_page(list, kLight, false, {720, 405});
  const std::string read = read_by("pdftotext", pdf.finish(), "-");
  for (const char* words : {"AVATAR To. Töpfe × 12", "below a halo"})
    EXPECT_EQ(count(read, words), 1u) << words << " in:\n" << read;
}

// The page, drawn by poppler, beside Lantern's own picture. Edges differ by their antialiasing.
// Each digit of a counter has a cell of its own on the page.
TEST(Pdf, NumbersAreFound) {
  if (!find_program("pdftotext")) GTEST_SKIP() << "no poppler-utils";
  DrawList list;
  Labels(list).add_number(21144, {800, 400}, {30, Weight::regular, Role::ink},
                          {{0, 0}, {900, 500}});
  PdfDocument pdf({"", "", ""});
  pdf.add_page(list, kLight, true, {720, 405}, "1");
  const std::string read = read_by("pdftotext", pdf.finish(), "-");
  EXPECT_NE(read.find("21144"), read.npos) << read;
}

TEST(Pdf, LooksAsThePictureDoes) {
  if (!find_program("pdftoppm")) GTEST_SKIP() << "no poppler-utils";
  constexpr int kWidth = 640, kHeight = 360;
  PdfDocument pdf({"T", "", "L"});
  pdf.add_page(sample_scene(), kLight, true, {kWidth, kHeight});
  const auto seen = decode_png(read_by("pdftoppm", pdf.finish(), "-r 72 -png -singlefile"));
  ASSERT_TRUE(seen);
  ASSERT_EQ(seen->width, kWidth);
  ASSERT_EQ(seen->height, kHeight);
  Image own;
  Renderer(Context::create(Backend::automatic), kWidth, kHeight)
      .draw(sample_scene(), kLight, false, own);
  double sum = 0;
  std::size_t far = 0;
  for (std::size_t i = 0; i < own.rgba.size(); ++i) {
    const int apart = std::abs(own.rgba[i] - seen->rgba[i]);
    sum += apart;
    far += apart > 100;
  }
  EXPECT_LT(sum / static_cast<double>(own.rgba.size()), 2.5);
  EXPECT_LT(far, own.rgba.size() / 100);
}

TEST(Pdf, RefusesWhatIsNotFinite) {
  DrawList list;
  list.shapes.emplace_back(rect(0, 0, std::numeric_limits<double>::infinity(), 1, Role::ink));
  PdfDocument pdf({"T", "", "L"});
  EXPECT_THROW(pdf.add_page(list, kLight, true, {720, 405}), Refused);
}

TEST(Pdf, TransparentPagesHaveNoGround) {
  const auto ground = [](bool paper) {
    PdfDocument pdf({"T", "", "L"});
    pdf.add_page(DrawList(), *theme_named("dark"), paper, {720, 405});
    return pdf.finish().size();
  };
  EXPECT_LT(ground(false), ground(true));
}

}  // namespace
}  // namespace lantern::publish
