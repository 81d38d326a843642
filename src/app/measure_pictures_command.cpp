#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/progress.hpp"
#include "app/report_folder.hpp"
#include "app/terminal.hpp"
#include "base/file.hpp"
#include "draw/page.hpp"
#include "embedded/version.hpp"
#include "report/antialiasing.hpp"
#include "report/measure_plots.hpp"
#include "scenario/director.hpp"

namespace lantern {
namespace {

// Upright lines and text, slanted edges, and a solid world.
constexpr const char* kDefaults[] = {"scenarios/ghost_quadtree.toml", "scenarios/obb_to_aabb.toml",
                                     "scenarios/octree_split.toml"};

// The frame with the most shapes; of equals the last.
PictureScene scene_of(const std::string& file, const PictureConfig& config) {
  const Scenario scenario = load_scenario(file);
  PictureScene scene{scenario.name, {}};
  Work work;
  direct(scenario, Pace::step, work, [&](const Frame& frame) {
    DrawList list = draw_frame(frame, page_for(config.width, config.height), work);
    if (list.shapes.size() >= scene.list.shapes.size()) scene.list = std::move(list);
    return true;
  });
  return scene;
}

}  // namespace

int measure_pictures_command(const MeasurePicturesOptions& options) {
  ReportFolder folder(options.output, "pictures");
  PictureConfig config;
  config.theme = *theme_named("light");
  if (options.full) {
    config.timing = {15, 0.05};
  } else {
    config.width = 640;
    config.height = 360;
  }
  std::vector<std::string> files = options.files;
  if (files.empty()) files.assign(std::begin(kDefaults), std::end(kDefaults));
  std::vector<PictureScene> scenes;
  for (const std::string& file : files) scenes.push_back(scene_of(file, config));
  say(fmt::format("{} pictures of {} x {}, each against one of 16 x 16 times as many pixels",
                  scenes.size(), config.width, config.height));
  PictureReport report;
  {
    Progress progress("measure pictures", kPictureRows * scenes.size(), "rows");
    std::uint64_t done = 0;
    report = measure_pictures(scenes, config, [&] { progress.done(++done); });
  }
  const std::string table = to_table(report), json = to_json(report);
  folder.write("pictures.txt", table);
  folder.write("pictures.csv", to_csv(report));
  folder.write("pictures.json", json);
  const std::string circumstances = circumstances_text(here(kVersion, kSourceHash));
  std::vector<ReportPage> pages;
  for (const std::string& scene : report.scenes)
    pages.push_back({"pictures_" + scene, draw_picture_page(report, scene, circumstances)});
  folder.draw(pages, options.theme);
  folder.finish();
  options.json ? write_stdout(json) : print(table);
  return kGood;
}

}  // namespace lantern
