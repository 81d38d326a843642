// Draws the sample reports for the eye: set LANTERN_PICTURES to a folder that is there.
#include <cstdlib>
#include <memory>

#include <gtest/gtest.h>

#include "base/file.hpp"
#include "render/png.hpp"
#include "render/renderer.hpp"
#include "render/svg.hpp"
#include "report/pages.hpp"
#include "report/problem_rows.hpp"
#include "report/sample_rows.hpp"

namespace lantern::report {
namespace {

void write(const std::string& name, const DrawList& list, double scale) {
  const char* folder = std::getenv("LANTERN_PICTURES");
  const std::string path = std::string(folder ? folder : ".") + "/" + name;
  const int width = static_cast<int>(list.page.x * scale);
  const int height = static_cast<int>(list.page.y * scale);
  Renderer renderer(Context::create(Backend::automatic), width, height);
  Image image;
  for (const Theme& theme : themes()) {
    renderer.draw(list, theme, false, image);
    write_file(path + "_" + std::string(theme.name) + ".png",
               encode_png(image, PngEffort::fast, {}, 0));
  }
  write_file(path + ".svg", to_svg(list, themes()[0], false, width, height));
}

TEST(Pictures, DISABLED_OfTheSampleRows) {
  const char* file = std::getenv("LANTERN_MEASUREMENT");
  const Measurement m =
      file ? read_measurement(read_file(file, 1u << 28)).value() : samples::measurement();
  for (const ProblemRows& problem : by_problem(m.rows))
    write("page_" + problem.problem, draw_problem(problem, m), 1);
  write("overview", draw_overview(m, samples::bars()), 1);
  if (!file) write("overview_many", draw_overview(samples::measurement(36), samples::bars()), 1);
  std::puts(to_table(m).c_str());
}

}  // namespace
}  // namespace lantern::report
