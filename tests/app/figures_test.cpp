// Figures: documents, contact sheets, SVG for papers and pages; dots to the inch; letters that the
// type lacks.
#include <algorithm>
#include <set>
#include <string>
#include <tuple>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/process.hpp"
#include "base/child.hpp"

namespace lantern::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

Outcome render(const std::string& words, const std::string& before = "") {
  return shell(before + "lantern render " + kGhosts + " " + words);
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++found;
  return found;
}

std::size_t number_of_files(const fs::path& folder) {
  return static_cast<std::size_t>(
      std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

void expect_refused(const std::string& words, const std::string& says) {
  const fs::path out = fresh_folder("refused-figure");
  const Outcome o = shell("cd " + out.string() + "; lantern render " + kGhosts + " " + words);
  EXPECT_EQ(o.code, 2) << words << o.err;
  EXPECT_NE(o.err.find(says), std::string::npos) << words << ": " << o.err;
  EXPECT_EQ(number_of_files(out), 0u) << words;
}

// --- documents ---

TEST(Document, HasAPageAFrameAndTheWordsOfEach) {
  const fs::path out = fresh_folder("document");
  const fs::path file = out / "new" / "fig.pdf";
  const Outcome o = render("--json -o " + file.string());
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_NE(o.err.find("8 frames in " + file.string()), std::string::npos) << o.err;
  const json said = json::parse(o.out);
  EXPECT_EQ(said["scenarios"][0]["frames"], 8);
  EXPECT_EQ(said["scenarios"][0]["files"], json::array({file.string()}));
  EXPECT_EQ(said["work"]["graphics_contexts"], 0) << "no OpenGL is needed";
  EXPECT_EQ(number_of_files(out / "new"), 1u);
  const std::string pdf = read_text(file);
  EXPECT_EQ(count(pdf, "/MediaBox [ 0 0 720 405 ]"), 8u) << "10 inches wide";
  EXPECT_EQ(count(pdf, "/Creator (Lantern "), 1u);
  ASSERT_EQ(render("-o " + (out / "again.pdf").string()).code, 0);
  EXPECT_EQ(read_text(out / "again.pdf"), pdf);
  if (!find_program("pdftotext")) GTEST_SKIP() << "no poppler-utils";
  const std::string text = shell("pdftotext -f 3 -l 3 " + file.string() + " -").out;
  for (const char* words : {"Ghosts fill a quadtree", "blue", "root"})
    EXPECT_NE(text.find(words), std::string::npos) << words << " in:\n" << text;
}

TEST(Document, OfOneStepIsSmall) {
  const fs::path file = fresh_folder("small-document") / "fig.pdf";
  ASSERT_EQ(render("--at four -o " + file.string()).code, 0);
  EXPECT_LT(fs::file_size(file), 60'000u);
}

TEST(Document, DotsToTheInchSayHowLargeThePageIs) {
  const fs::path file = fresh_folder("dots-document") / "fig.pdf";
  ASSERT_EQ(render("--frames 0 --size 800x450 --dpi 200 -o " + file.string()).code, 0);
  EXPECT_EQ(count(read_text(file), "/MediaBox [ 0 0 288 162 ]"), 1u);
}

TEST(Document, APlaceholderMakesAFileAFrame) {
  const fs::path out = fresh_folder("documents");
  const Outcome o = render("--frames 2-3 -o " + (out / "{scenario}_{frame}.pdf").string());
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(number_of_files(out), 2u);
  for (const char* number : {"0002", "0003"})
    EXPECT_EQ(
        count(read_text(out / ("ghost_quadtree_" + std::string(number) + ".pdf")), "/MediaBox"), 1u)
        << number;
}

TEST(Document, SwitchesAndThemesChangeIt) {
  const fs::path out = fresh_folder("document-switches");
  std::set<std::string> all;
  for (const char* words : {"", "--no-title", "--no-caption", "--no-counters", "--legend",
                            "--theme dark", "--theme print", "--transparent"}) {
    const Outcome o =
        render("--frames 2 -o " + (out / "a.pdf").string() + " " + std::string(words));
    ASSERT_EQ(o.code, 0) << words << o.err;
    EXPECT_TRUE(all.insert(read_text(out / "a.pdf")).second) << words << " changes nothing";
  }
}

TEST(Document, DoesNotMove) {
  expect_refused("--tween 3 -o fig.pdf", "does not move");
  expect_refused("--fps 25 --sheet 3x2 -o fig.pdf", "does not move");
  expect_refused("--dpi 20 -o fig.pdf", "--dpi");
}

// A library that cannot be loaded passes for one that is not there.
TEST(Document, AMissingLibraryIsToldBeforeTheRunAndTheOlderFileStays) {
  for (const char* library : {"libcairo.so.2", "libfreetype.so.6"}) {
    const fs::path out = fresh_folder("no-cairo");
    fs::create_directory(out / "lib");
    write_text(out / "lib" / library, "no library");
    write_text(out / "old.pdf", "old");
    const std::string fake = "export LD_LIBRARY_PATH=" + (out / "lib").string() + "; ";
    for (const std::string name : {"old.pdf", "new/fig.pdf"})
      for (const std::string sheet : {"", " --sheet 2x2"}) {
        const Outcome o = render("-o " + (out / name).string() + sheet, fake);
        EXPECT_EQ(o.code, 4) << library << o.err;
        EXPECT_NE(o.err.find("install the packages libcairo2 and libfreetype6"), std::string::npos)
            << o.err;
      }
    EXPECT_EQ(read_text(out / "old.pdf"), "old");
    EXPECT_EQ(number_of_files(out), 2u);
  }
}

TEST(Document, AFailingWriteIsToldAndTheOlderFileStays) {
  const fs::path out = fresh_folder("full-document");
  write_text(out / "fig.pdf", "old");
  for (const std::string sheet : {"", " --sheet 2x2"}) {
    const Outcome o = render("-o " + (out / "fig.pdf").string() + sheet, "ulimit -f 8; ");
    EXPECT_EQ(o.code, 1) << o.err;
    EXPECT_NE(o.err.find("cannot write '" + (out / "fig.pdf").string()), std::string::npos)
        << o.err;
    EXPECT_EQ(read_text(out / "fig.pdf"), "old");
    EXPECT_EQ(number_of_files(out), 1u) << "something half written is left";
  }
  EXPECT_EQ(render("-o " + (out / "fig.pdf" / "a.pdf").string()).code, 1);
}

// --- contact sheets ---

TEST(Sheet, OfAPdfHasAsManyPagesAsNeeded) {
  const fs::path file = fresh_folder("sheet") / "sheet.pdf";
  const Outcome o = render("--sheet 3x2 -o " + file.string());
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_NE(o.err.find("8 frames in"), std::string::npos) << o.err;
  const std::string pdf = read_text(file);
  EXPECT_EQ(count(pdf, "/MediaBox"), 2u);
  EXPECT_EQ(count(pdf, "/MediaBox [ 0 0 841.889764 595.275591 ]"), 2u) << "A4 across";
  if (!find_program("pdftotext")) GTEST_SKIP() << "no poppler-utils";
  const std::string text = shell("pdftotext " + file.string() + " -").out;
  for (const char* words : {"Ghosts fill a quadtree", "page 1 of 2", "page 2 of 2"})
    EXPECT_NE(text.find(words), std::string::npos) << words;
  EXPECT_EQ(count(text, "Ghosts fill a quadtree"), 2u) << "once a page, not over each picture";
}

// A run has many frames; its last one is on paper.
TEST(Sheet, HasAPictureAStepUnlessOthersAreAskedFor) {
  const fs::path out = fresh_folder("sheet-steps");
  const auto frames = [&](const std::string& words) {
    const Outcome o = shell("lantern render " + scenario("broad_then_narrow") +
                            " --json --sheet 2x2 -o " + (out / "a.pdf").string() + " " + words);
    EXPECT_EQ(o.code, 0) << o.err;
    return int{json::parse(o.out)["scenarios"][0]["frames"]};
  };
  const int steps = static_cast<int>(json::parse(
      shell("lantern list --json " + scenario("broad_then_narrow")).out)["scenarios"][0]["steps"]);
  EXPECT_EQ(frames(""), steps);
  EXPECT_EQ(frames("--pace step"), steps);
  EXPECT_GT(frames("--frames 0-"), steps);
  EXPECT_GT(frames("--pace event"), steps);
}

TEST(Sheet, OfSeveralScenariosIsOneDocumentWithAHeadingEach) {
  const fs::path file = fresh_folder("handout") / "new" / "handout.pdf";
  const std::string both = kGhosts + " " + scenario("broad_then_narrow");
  for (const std::string sheet : {"--sheet 2x3", ""}) {
    const Outcome o = shell("lantern render " + both + " --json -o " + file.string() + " " + sheet);
    ASSERT_EQ(o.code, 0) << o.err;
    EXPECT_EQ(json::parse(o.out)["scenarios"][1]["files"], json::array({file.string()}));
    EXPECT_EQ(number_of_files(file.parent_path()), 1u);
    const std::string pdf = read_text(file);
    EXPECT_NE(pdf.find("(Ghosts fill a quadtree, Broad phase, then narrow phase)"), pdf.npos);
    if (sheet.empty()) continue;
    EXPECT_EQ(count(pdf, "/MediaBox [ 0 0 595.275591 841.889764 ]"), 3u) << "A4 upright";
    EXPECT_EQ(count(pdf, "/Title (Ghosts fill a quadtree)"), 1u) << "an entry of the contents";
    if (!find_program("pdftotext")) continue;
    const std::string text = shell("pdftotext " + file.string() + " -").out;
    for (const char* words :
         {"Ghosts fill a quadtree", "Broad phase, then narrow phase", "page 1 of 1"})
      EXPECT_NE(text.find(words), std::string::npos) << words;
  }
  // One that fails leaves the older file.
  const fs::path bad = file.parent_path() / "bad.toml";
  write_text(bad, "title = 1\n");
  const std::string before = read_text(file);
  EXPECT_EQ(shell("lantern render " + kGhosts + " " + bad.string() + " -o " + file.string()).code,
            3);
  EXPECT_EQ(read_text(file), before);
}

TEST(Sheet, HasFewerPicturesWhereLettersWouldBeTooSmall) {
  const fs::path file = fresh_folder("sheet-letters") / "a.pdf";
  const Outcome o = render("--sheet 5x5 -o " + file.string());
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_NE(o.err.find("5x5 pictures a page have no room with letters of 6 pt: 2x3 it is"),
            std::string::npos)
      << o.err;
  EXPECT_EQ(count(read_text(file), "/MediaBox"), 2u);
  const Outcome large = render("--sheet 2x2 --letters 10pt --paper letter -o " + file.string());
  EXPECT_NE(large.err.find("letters of 10 pt"), std::string::npos) << large.err;
  EXPECT_EQ(count(read_text(file), "/MediaBox [ 0 0 612"), 4u) << "two pictures on upright letter";
  for (const char* words : {"8", "cm", "8 pt", "-1pt", "0pt", "nanpt", "1e9cm"})
    expect_refused("--sheet 2x2 -o a.pdf --letters '" + std::string(words) + "'", "--letters");
  expect_refused("--sheet 2x2 -o a.pdf --paper a4 --size 100x100", "--size");
}

TEST(Sheet, OfPngIsAPageAFile) {
  const fs::path out = fresh_folder("png-sheet");
  const std::string small = "--sheet 2x2 --size 600x420 --dpi 72 ";
  ASSERT_EQ(render(small + "--frames 4-7 -o " + (out / "one.png").string()).code, 0);
  EXPECT_EQ(read_text(out / "one.png").substr(16, 8), std::string("\0\0\x02\x58\0\0\x01\xa4", 8));
  ASSERT_EQ(render(small + "-o " + (out / "p_{frame}.png").string()).code, 0);
  EXPECT_TRUE(fs::exists(out / "p_0000.png"));
  EXPECT_TRUE(fs::exists(out / "p_0004.png")) << "named after its first frame";
  EXPECT_EQ(number_of_files(out), 3u);
}

TEST(Sheet, IsRefusedWhereItCannotBe) {
  for (const char* words : {"3", "0x2", "100x100", "3x2x1", "3*2"})
    expect_refused("--sheet " + std::string(words) + " -o a.pdf", "3x2");
  expect_refused("--sheet 3x2 -o a.png", "write {frame} in its name");
  expect_refused("--sheet 3x2 -o a_{step}.pdf", "{frame}");
  expect_refused("--sheet 3x2 -o a.svg", ".pdf or a .png");
  expect_refused("--sheet 3x2 --dpi 1200 -o a_{frame}.png", "--dpi");
  expect_refused("--sheet 3x2 --size 8000x16 -o a.pdf", "no room");
  expect_refused("--sheet 3x2 --at nothing -o a.pdf", "nothing");
}

TEST(Sheet, SaysOnlyWhatIsWanted) {
  if (!find_program("pdftotext")) GTEST_SKIP() << "no poppler-utils";
  const fs::path file = fresh_folder("bare-sheet") / "a.pdf";
  const auto text = [&](const std::string& words) {
    EXPECT_EQ(render("--sheet 1x1 --frames 7 -o " + file.string() + " " + words).code, 0);
    return shell("pdftotext " + file.string() + " - | tr '\\n' ' '").out;
  };
  const json facts = [] {
    const fs::path out = fresh_folder("sheet-facts");
    EXPECT_EQ(render("--size 160x90 --frames 7 -o " + out.string()).code, 0);
    return json::parse(read_text(out / "ghost_quadtree" / "ghost_quadtree_0007.json"));
  }();
  const std::string caption = std::string(facts["caption"]).substr(0, 12);
  EXPECT_NE(text("").find(caption), std::string::npos);
  EXPECT_EQ(text("--no-caption").find(caption), std::string::npos);
  EXPECT_EQ(text("--no-title").find("Ghosts fill a quadtree"), std::string::npos);
}

// --- SVG and PNG ---

TEST(Figures, SvgsOfAFolderShareNoId) {
  const fs::path out = fresh_folder("svg-ids");
  ASSERT_EQ(render("--format svg --frames 4-5 -o " + out.string()).code, 0);
  const auto ids = [&](const char* number) {
    const std::string svg =
        read_text(out / "ghost_quadtree" / ("ghost_quadtree_" + std::string(number) + ".svg"));
    EXPECT_NE(svg.find(">Ghosts fill a quadtree</title>"), std::string::npos);
    EXPECT_NE(svg.find("</desc>"), std::string::npos);
    std::set<std::string> found;
    for (std::size_t at = svg.find(" id=\""); at != svg.npos; at = svg.find(" id=\"", at + 1))
      found.insert(svg.substr(at + 5, svg.find('"', at + 5) - at - 5));
    return found;
  };
  const std::set<std::string> a = ids("0004"), b = ids("0005");
  EXPECT_GT(a.size(), 20u);
  for (const std::string& id : a) EXPECT_FALSE(b.contains(id)) << id;
}

TEST(Figures, AResumedRunDrawsAnewWhatIsAskedForOtherwise) {
  const fs::path out = fresh_folder("resumed-figures");
  const auto run = [&](const std::string& words) {
    const Outcome o = render("--size 160x90 --frames 3-4 --json -o " + out.string() + " " + words);
    EXPECT_EQ(o.code, 0) << o.err;
    return int{json::parse(o.out)["scenarios"][0]["drawn"]};
  };
  EXPECT_EQ(run(""), 2);
  EXPECT_EQ(run("--dpi 300"), 2);
  EXPECT_EQ(run("--dpi 300"), 0);
  EXPECT_EQ(run("--dpi 300 --text text"), 0) << "no matter for a PNG";
  const std::string png = read_text(out / "ghost_quadtree" / "ghost_quadtree_0003.png");
  EXPECT_NE(png.find(std::string("pHYs\0\0\x2e\x23\0\0\x2e\x23\1", 13)), std::string::npos)
      << "11811 pixels a metre";
  EXPECT_EQ(run("--format svg"), 2);
  EXPECT_EQ(run("--format svg --text text"), 2);
  EXPECT_EQ(run("--format svg --text text --dpi 300"), 0) << "no matter for an SVG";
  EXPECT_NE(read_text(out / "ghost_quadtree" / "ghost_quadtree_0003.svg").find("<text "),
            std::string::npos);
}

// --- laid out for paper ---

double number_after(const std::string& text, const std::string& words) {
  const std::size_t at = text.find(words);
  return at == text.npos ? -1 : std::stod(text.substr(at + words.size()));
}

// The smallest letters of an SVG, in points on paper.
double least_letters(const std::string& svg) {
  double least = 1e9;
  for (std::size_t at = svg.find("font-size=\""); at != svg.npos;
       at = svg.find("font-size=\"", at + 1))
    least = std::min(least, std::stod(svg.substr(at + 11)));
  return least * number_after(svg, " width=\"") / number_after(svg, "viewBox=\"0 0 ");
}

TEST(Figures, AreLaidOutForTheirWidthAndTheirLetters) {
  const fs::path out = fresh_folder("figures-width");
  double before = 1e9;
  for (const auto& [words, width, letters] :
       {std::tuple{"--width 8cm", 226.772, 8.0},
        std::tuple{"--width 80mm --letters 6pt", 226.772, 6.0},
        std::tuple{"--width 5in --letters 10pt --no-caption", 360.0, 10.0}}) {
    const fs::path file = out / "a.svg";
    const Outcome o = render("--frames 5 --text text -o " + file.string() + " " + words);
    ASSERT_EQ(o.code, 0) << o.err;
    const std::string svg = read_text(file);
    EXPECT_NEAR(number_after(svg, " width=\""), width, 0.01);
    EXPECT_NE(svg.find("pt\" height="), svg.npos);
    EXPECT_GE(least_letters(svg), letters - 1e-3) << words;
    EXPECT_LT(least_letters(svg), 1.2 * letters) << words;
    EXPECT_NE(svg.find("candidate pair"), svg.npos) << "its description";
    EXPECT_NE(number_after(svg, "viewBox=\"0 0 "), before) << "laid out anew";
    before = number_after(svg, "viewBox=\"0 0 ");
  }
}

TEST(Figures, AreOfOneSizeAndAlikeInAllFormats) {
  const fs::path out = fresh_folder("figures-formats");
  ASSERT_EQ(render("--width 8cm -o '" + (out / "{frame}.svg").string() + "'").code, 0);
  std::set<double> heights;
  for (const auto& one : fs::directory_iterator(out))
    heights.insert(number_after(read_text(one.path()), "pt\" height=\""));
  EXPECT_EQ(heights.size(), 1u) << "as LaTeX's animate wants them";
  ASSERT_EQ(render("--width 8cm -o " + (out / "a.pdf").string()).code, 0);
  const std::string pdf = read_text(out / "a.pdf");
  EXPECT_NEAR(number_after(pdf, "/MediaBox [ 0 0 "), 226.772, 0.01);
  ASSERT_EQ(render("--width 8cm --frames 5 -o " + (out / "a.png").string()).code, 0);
  const std::string png = read_text(out / "a.png");
  EXPECT_EQ(png.substr(16, 4), std::string("\0\0\x03\xb1", 4)) << "8 cm of 300 dots an inch";
  EXPECT_NE(png.find("Description"), png.npos);
  const Outcome one = render("--width 8cm --frames 5 -o " + (out / "one.pdf").string());
  EXPECT_NE(read_text(out / "one.pdf").find("0028003100200063"), std::string::npos)
      << "its subject, which says (1 candidate pair ...";
}

TEST(Figures, OfOnePanelShowItAlone) {
  const fs::path out = fresh_folder("figures-panel");
  std::set<std::string> all;
  for (const char* panel : {"world", "tree"}) {
    const fs::path file = out / (std::string(panel) + ".svg");
    const Outcome o = render("--frames 5 --text text --width 6cm --panel " + std::string(panel) +
                             " -o " + file.string());
    ASSERT_EQ(o.code, 0) << o.err;
    const std::string svg = read_text(file);
    EXPECT_EQ(count(svg, ">entries</text>") > 0, std::string(panel) == "tree");
    EXPECT_EQ(count(svg, ">Ghosts fill a quadtree</text>"), 0u);
    EXPECT_EQ(count(svg, ">Ghosts fill a quadtree</title>"), 1u);
    EXPECT_TRUE(all.insert(svg).second);
  }
  expect_refused("--panel tre -o a.svg", "did you mean 'tree'?");
  expect_refused("--panel chart --frames 5 -o a.svg", "it has: tree, world");
  expect_refused("--width 8cm --letters 40pt --frames 5 -o a.svg", "leave no room");
  expect_refused("--width 8cm", "figures (--width, --letters, --panel) are");
  expect_refused("--width 8cm --size 80x80 -o a.svg", "--size");
  expect_refused("--width 8 --frames 5 -o a.svg", "8cm");
}

// --- letters ---

TEST(Letters, ThatTheTypeLacksAreToldWhereTheyStand) {
  const fs::path out = fresh_folder("letters");
  const fs::path file = out / "letters.toml";
  const std::string rest =
      "[world]\nsize = [1, 1]\n[[body]]\nname = \"a\"\nradius = 0.1\nposition = [0.5, 0.5]\n"
      "[[step]]\ndo = \"insert\"\nbodies = [\"a\"]\ncaption = \"Привет, κόσμε: 日本 😀\"\n";
  write_text(file, "title = \"t\" # 日\n# 日\n" + rest);
  const Outcome o = shell("lantern check " + file.string());
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(count(o.err, "warning:"), 1u) << o.err;
  EXPECT_NE(o.err.find("no '日', '本', '😀'"), std::string::npos) << o.err;
  EXPECT_EQ(shell("lantern check --strict " + file.string()).code, 3);
  write_text(file, "title = \"one: אב\"\n" + rest.substr(0, rest.find("caption")));
  const Outcome title =
      shell("lantern render --size 160x90 " + file.string() + " -o " + (out / "pictures").string());
  EXPECT_EQ(title.code, 0);
  EXPECT_NE(title.err.find("letters.toml:1:15: warning: "), std::string::npos) << title.err;
}

}  // namespace
}  // namespace lantern::app
