// The measure of antialiasing against areas computed by hand, and against itself.
#include "report/antialiasing.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "base/random.hpp"
#include "base/stop.hpp"
#include "draw/layout_check.hpp"
#include "draw/page.hpp"
#include "render/renderer.hpp"
#include "report/settled.hpp"
#include "scenario/director.hpp"

namespace lantern::report {
namespace {

constexpr int kWidth = 48, kHeight = 32;

// Paper is white, ink black: a level tells an area.
Theme plain_theme() {
  Theme theme{"plain", {}};
  theme.colors.fill({128, 128, 128});
  theme.colors[static_cast<std::size_t>(Role::paper)] = {255, 255, 255};
  theme.colors[static_cast<std::size_t>(Role::ink)] = {0, 0, 0};
  return theme;
}

DrawList page_of(std::vector<DrawShape> shapes) {
  DrawList list;
  list.page = {kWidth, kHeight};
  list.shapes = std::move(shapes);
  return list;
}

ReferencePicture reference_of(const DrawList& list) {
  return reference_picture(list, plain_theme(), kWidth, kHeight, Backend::automatic);
}

Image drawn(const DrawList& list, int width, int height) {
  Renderer renderer(Context::create(Backend::automatic), width, height);
  Image image;
  renderer.draw(list, plain_theme(), false, image);
  return image;
}

// What of the polygon lies where n . p <= offset (Sutherland and Hodgman 1974).
std::vector<Vec<2>> cut(const std::vector<Vec<2>>& polygon, const Vec<2>& n, double offset) {
  std::vector<Vec<2>> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec<2>&a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double ha = glm::dot(n, a) - offset, hb = glm::dot(n, b) - offset;
    if (ha <= 0) kept.push_back(a);
    if ((ha < 0 && hb > 0) || (ha > 0 && hb < 0)) kept.push_back(a + (b - a) * (ha / (ha - hb)));
  }
  return kept;
}

double area_of(const std::vector<Vec<2>>& polygon) {
  double area = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec<2>&a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    area += 0.5 * (a.x * b.y - a.y * b.x);
  }
  return std::abs(area);
}

struct HalfPlane {
  Vec<2> normal;
  double offset;

  double share(int x, int y) const {
    const double l = x, t = y;
    return area_of(cut({{l, t}, {l + 1, t}, {l + 1, t + 1}, {l, t + 1}}, normal, offset));
  }
  DrawList list() const {
    const std::vector<Vec<2>> wide = {{-90, -90}, {140, -90}, {140, 120}, {-90, 120}};
    return page_of({PolygonShape{cut(wide, normal, offset), Role::ink, {}}});
  }
};

HalfPlane random_half_plane(Random& random) {
  const double angle = random.between(0, 6.283185307179586);
  const Vec<2> normal(std::cos(angle), std::sin(angle));
  const Vec<2> through(random.between(14, 34), random.between(10, 22));
  return {normal, glm::dot(normal, through)};
}

TEST(Antialiasing, TheReferenceOfAHalfPlaneIsItsExactArea) {
  Random random(1);
  for (int round = 0; round < 8; ++round) {
    const HalfPlane plane = random_half_plane(random);
    const ReferencePicture reference = reference_of(plane.list());
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const std::size_t i = static_cast<std::size_t>(y) * kWidth + x;
        const double share = plane.share(x, y);
        ASSERT_NEAR(1 - reference.rgb[3 * i] / 255, share, 1.0 / 256) << "round " << round;
        const bool crossed = share > 0.01 && share < 0.99;
        if (crossed) {
          ASSERT_EQ(reference.edge[i], 1) << "an edge goes unseen";
        }
        if (share == 0 || share == 1) {
          ASSERT_TRUE(reference.edge[i] == 0 || std::abs(share - 0.5) < 0.5 + 1e-12);
        }
      }
  }
}

// A line is drawn as a turned box, by distances, which errs; at 16 times the size it must not.
TEST(Antialiasing, TheReferenceOfASlantedLineIsItsExactArea) {
  Random random(2);
  for (int round = 0; round < 8; ++round) {
    const HalfPlane plane = random_half_plane(random);
    const Vec<2> along(-plane.normal.y, plane.normal.x);
    const Vec<2> middle = plane.normal * plane.offset;
    const double width = random.between(0.4, 5);
    const ReferencePicture reference = reference_of(page_of(
        {LineShape{middle - along * 200.0, middle + along * 200.0, {Role::ink, width, 0}, false}}));
    const HalfPlane upper{plane.normal, plane.offset + 0.5 * width},
        lower{plane.normal, plane.offset - 0.5 * width};
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const std::size_t i = static_cast<std::size_t>(y) * kWidth + x;
        ASSERT_NEAR(1 - reference.rgb[3 * i] / 255, upper.share(x, y) - lower.share(x, y),
                    1.0 / 128)
            << "round " << round << ", a line " << width << " pixels wide";
      }
  }
}

TEST(Antialiasing, AnUprightEdgeOnAPixelBorderIsNoEdge) {
  const ReferencePicture reference =
      reference_of(page_of({RectShape{{{8, 8}, {24, 20}}, 0, Role::ink, {}, false}}));
  EXPECT_EQ(std::count(reference.edge.begin(), reference.edge.end(), 1), 0);
  EXPECT_EQ(reference.rgb[3 * (10 * kWidth + 10)], 0);
  EXPECT_EQ(reference.rgb[3 * (30 * kWidth + 10)], 255);
}

TEST(Antialiasing, OneSampleIsWorseThanCoverageOnSlantedEdges) {
  Random random(3);
  for (int round = 0; round < 8; ++round) {
    const DrawList list = random_half_plane(random).list();
    const ReferencePicture reference = reference_of(list);
    const PictureError coverage = error_of(drawn(list, kWidth, kHeight), reference);
    const PictureError one = error_of(reference.sampled[0], reference);
    const PictureError four = error_of(reference.sampled[1], reference);
    EXPECT_GT(one.rms, 10 * coverage.rms) << "round " << round;
    EXPECT_GT(one.rms, four.rms) << "more samples must be better";
    EXPECT_GT(four.rms, error_of(reference.sampled[2], reference).rms);
    EXPECT_LE(coverage.worst, 1.5) << "a polygon's coverage is exact but for rounding";
    EXPECT_EQ(coverage.strays, 0u);
  }
}

TEST(Antialiasing, ErrorsAreThoseOfAHandMadePicture) {
  ReferencePicture reference;
  reference.width = 3;
  reference.height = 1;
  reference.rgb = {10, 20, 30, 100, 100.5f, 100, 0, 0, 0};
  reference.edge = {1, 1, 0};
  const Image image{3, 1, {10, 24, 29, 255, 100, 100, 97, 255, 0, 7, 0, 255}};
  const PictureError error = error_of(image, reference);
  EXPECT_EQ(error.edge_pixels, 2u);
  EXPECT_DOUBLE_EQ(error.mean, 3.5) << "worst channels 4 and 3";
  EXPECT_DOUBLE_EQ(error.rms, std::sqrt(12.5));
  EXPECT_EQ(error.worst, 7) << "pixels without an edge count here";
  EXPECT_EQ(error.strays, 1u);
}

TEST(Antialiasing, TheBoxFilterIsTheRoundedMean) {
  const Image large{4, 2, {0, 10, 255, 255, 1, 10, 255, 255, 8, 0, 0, 255, 8, 0, 0, 255,
                           2, 10, 255, 255, 3, 10, 254, 255, 8, 0, 0, 255, 9, 0, 1, 255}};
  Image small;
  box_filter(large, 2, small);
  EXPECT_EQ(small, (Image{2, 1, {2, 10, 255, 255, 8, 0, 0, 255}}));
}

// The settled list is the same picture at its own size: nothing is moved but what snapping moves.
TEST(Antialiasing, ASettledListIsTheSamePicture) {
  for (const char* name : {"ghost_quadtree", "obb_to_aabb", "octree_split"}) {
    const Scenario scenario =
        load_scenario(std::string(LANTERN_ROOT "/scenarios/") + name + ".toml");
    DrawList list;
    Work work;
    direct(scenario, Pace::step, work, [&](const Frame& frame) {
      list = draw_frame(frame, page_for(640, 360), work);
      return true;
    });
    const Image wanted = drawn(list, 640, 360), got = drawn(settled(list, 640, 360), 640, 360);
    std::size_t off = 0;
    for (std::size_t i = 0; i < wanted.rgba.size(); ++i)
      off += std::abs(wanted.rgba[i] - got.rgba[i]) > 1 ? 1 : 0;
    EXPECT_EQ(off, 0u) << name << ": what is measured is not what is drawn";
  }
}

TEST(Antialiasing, IdenticalInputGivesIdenticalErrors) {
  Random random(4);
  const std::vector<PictureScene> scenes = {{"half", random_half_plane(random).list()}};
  PictureConfig config;
  config.width = kWidth;
  config.height = kHeight;
  config.theme = plain_theme();
  config.timing.repeats = 0;
  const auto measure_it = [&] { return measure_pictures(scenes, config, [] {}); };
  const PictureReport first = measure_it(), second = measure_it();
  ASSERT_GE(first.rows.size(), 7u) << "three of coverage, three of samples, the polygon alone";
  ASSERT_EQ(first.rows.size(), second.rows.size());
  for (std::size_t i = 0; i < first.rows.size(); ++i) {
    EXPECT_EQ(first.rows[i].error, second.rows[i].error) << first.rows[i].choice;
    EXPECT_EQ(first.rows[i].timing.repeats, 0);
  }
  // All that there is is a polygon: alone it is the picture.
  const auto polygon = std::ranges::find(first.rows, "polygons", &PictureRow::part);
  ASSERT_NE(polygon, first.rows.end());
  EXPECT_EQ(polygon->error, first.rows[0].error);
  const std::string csv = to_csv(first);
  EXPECT_EQ(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')),
            first.rows.size() + 1);
  EXPECT_NE(to_json(first).find("\"lantern.measure.pictures/1\""), std::string::npos);
  EXPECT_NE(to_table(first).find("samples 8"), std::string::npos);
  int rows = 0;
  const auto told = [&] {
    if (++rows == 2) ask_to_stop();
  };
  EXPECT_THROW(measure_pictures(scenes, config, told), Stopped);
  forget_stop();
  EXPECT_EQ(rows, 2) << "the wish to stop was not heard";
}

TEST(Antialiasing, APlotHasAPointForEachTimedRow) {
  PictureReport report;
  report.scenes = {"s"};
  Timing timing{5, 0.002, 0.002, 0.002, 0.002};
  report.rows.push_back({"s", "coverage", "1 x 1", "", {10, 0.5, 0.7, 3, 0}, timing, ""});
  timing.median = 0.02;
  report.rows.push_back({"s", "coverage", "4 x 4", "", {10, 0.3, 0.4, 2, 0}, timing, ""});
  timing.median = 0.03;
  report.rows.push_back({"s", "cairo", "default", "1.16", {10, 0.5, 0.8, 3, 0}, timing, ""});
  report.rows.push_back({"s", "samples", "1", "", {10, 30, 40, 120, 0}, {}, ""});
  report.rows.push_back({"s", "coverage", "1 x 1", "", {10, 0.5, 0.7, 3, 0}, {}, "texts"});
  const Plot plot = picture_plot(report, "s");
  ASSERT_EQ(plot.series.size(), 2u);
  EXPECT_EQ(plot.series[0].points.size(), 2u);
  EXPECT_TRUE(plot.series[1].is_peer);
  EXPECT_EQ(plot.guides.size(), 1u) << "samples are not timed: they are levels to compare with";
  EXPECT_EQ(plot.front, (std::vector<Vec<2>>{{2, 0.7}, {20, 0.4}})) << "cairo is behind both";
  EXPECT_EQ(picture_plot(report, "other").series.size(), 0u);
}

PictureRow timed_way(const char* family, const char* choice, double rms, double milliseconds,
                     double spread) {
  const Timing timing{5, 1e-3 * milliseconds, 1e-3 * (milliseconds - spread),
                      1e-3 * (milliseconds - spread / 2), 1e-3 * (milliseconds + spread / 2)};
  return {"s", family, choice, "", {10, 0.5, rms, 3, 0}, timing, ""};
}

TEST(Antialiasing, TheSentenceNamesTheCheapestWay) {
  PictureReport report;
  report.scenes = {"s"};
  EXPECT_EQ(cheapest_picture(report, "s"), "No way of drawing was timed.");
  report.rows = {
      timed_way("coverage", "1 x 1", 7.35, 2, 0.1), timed_way("coverage", "4 x 4", 1.73, 30, 0.1),
      timed_way("cairo", "none", 43.9, 0.8, 0.1), timed_way("cairo", "best", 3.6, 3.5, 0.1)};
  EXPECT_EQ(cheapest_picture(report, "s"),
            "The cheapest way under 10 levels RMS is coverage 1 × 1: 2 ms a frame, off by 7.35 "
            "levels; cairo none is farther off.");
  report.rows[3] = timed_way("cairo", "best", 3.6, 2.05, 0.1);
  EXPECT_EQ(cheapest_picture(report, "s"),
            "The cheapest ways under 10 levels RMS are coverage 1 × 1 with 2 ms a frame and 7.35 "
            "levels and cairo best with 2.05 ms a frame and 3.6 levels, which cost the same within "
            "the spread; cairo none is farther off.")
      << "0.05 ms apart, where repeats are 0.1 ms apart, is no win";
  report.rows.resize(3);
  report.rows.erase(report.rows.begin(), report.rows.begin() + 2);
  EXPECT_EQ(cheapest_picture(report, "s"),
            "The cheapest way under 50 levels RMS is cairo none: 0.8 ms a frame, off by 43.9 "
            "levels.");
}

TEST(Antialiasing, ThePageSaysItsSentence) {
  PictureReport report;
  report.scenes = {"s"};
  report.rows = {timed_way("coverage", "1 x 1", 7.35, 2, 0.1),
                 timed_way("coverage", "4 x 4", 1.73, 30, 0.1),
                 timed_way("cairo", "none", 43.9, 0.8, 0.1)};
  const DrawList list = draw_picture_page(report, "s", "made here");
  EXPECT_TRUE(says_part(list, "The cheapest way under 10 levels RMS is coverage 1 × 1"));
  EXPECT_TRUE(says_part(list, "made here"));
  expect_laid_out(list, {{0, 0}, list.page}, kLeastDeskLabel, "a page of pictures");
}

TEST(Antialiasing, SizesThatCannotBeSupersampledAreRefused) {
  PictureConfig config;
  config.width = 4000;
  EXPECT_THROW(measure_pictures({}, config, [] {}), Refused);
}

}  // namespace
}  // namespace lantern::report
