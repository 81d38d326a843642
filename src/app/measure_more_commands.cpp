// What is measured beside the problems: antialiasing, and the settings of trees.
#include <fmt/format.h>

#include "app/answer.hpp"
#include "app/commands.hpp"
#include "app/progress.hpp"
#include "app/report_folder.hpp"
#include "app/scenario_folder.hpp"
#include "app/terminal.hpp"
#include "base/counted.hpp"
#include "draw/page.hpp"
#include "embedded/version.hpp"
#include "measure/broad_phase_cost.hpp"
#include "report/antialiasing.hpp"
#include "report/measure_plots.hpp"
#include "report/pages.hpp"
#include "scenario/director.hpp"

namespace lantern::app {
namespace {

// Upright lines and text, slanted edges, and a solid world.
constexpr const char* kDefaults[] = {"ghost_quadtree", "obb_to_aabb", "octree_split"};

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

constexpr std::size_t kBodies = 2000;
constexpr std::uint64_t kSeed = 1;

std::vector<BoxScene> scenes_of(const MeasureMoreOptions& options) {
  if (options.files.empty()) return seeded_box_scenes(kBodies, kSeed);
  std::vector<BoxScene> scenes;
  for (const std::string& file : options.files) scenes.push_back(box_scene_of(load_scenario(file)));
  return scenes;
}

std::vector<ReportPage> pages_of(const std::vector<BroadPhaseCost>& rows,
                                 const std::vector<BoxScene>& scenes) {
  std::vector<ReportPage> pages;
  for (const BoxScene& scene : scenes)
    for (const StructureKind kind : kStructureKinds)
      if (const BroadPhaseCost* best = cheapest(rows, scene.name, kind, CostBy::work);
          best != nullptr && best->has_settings())
        pages.push_back({fmt::format("broad_phase_{}_{}", scene.name, to_string(kind)),
                         draw_broad_phase_page(rows, scene, kind)});
  return pages;
}

}  // namespace

int measure_pictures_command(const MeasureMoreOptions& options) {
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
  if (files.empty())
    for (const char* name : kDefaults) files.push_back(scenario_file(name));
  std::vector<PictureScene> scenes;
  for (const std::string& file : files) scenes.push_back(scene_of(file, config));
  say(fmt::format("{} of {} x {}, each against one of 16 x 16 times as many pixels",
                  counted(scenes.size(), "picture"), config.width, config.height));
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
  options.json ? answer(json) : print(table);
  return kGood;
}

int measure_broad_phase_command(const MeasureMoreOptions& options) {
  ReportFolder folder(options.output, "broad_phase");
  const std::vector<BoxScene> scenes = scenes_of(options);
  BroadPhaseCostConfig config;
  if (options.full) config.timing = {15, 0.05};
  std::vector<BroadPhaseCost> rows;
  std::size_t all = 0, done = 0;
  for (const BoxScene& scene : scenes) all += broad_phase_rows(scene, config);
  std::uint64_t wrong = 0;
  {
    Progress progress("measure broad_phase", all, "rows");
    for (const BoxScene& scene : scenes) {
      const std::vector<BroadPhaseCost> more =
          measure_broad_phases(scene, config, [&] { progress.done(++done); });
      for (const BroadPhaseCost& row : more) wrong += row.counts.missed + row.counts.invented;
      rows.insert(rows.end(), more.begin(), more.end());
    }
  }
  const std::string table = to_table(rows, scenes), json = to_json(rows, scenes);
  folder.write("broad_phase.txt", table);
  folder.write("broad_phase.csv", to_csv(rows));
  folder.write("broad_phase.json", json);
  if (folder.wanted()) folder.draw(pages_of(rows, scenes), options.theme);
  folder.finish();
  options.json ? answer(json) : print(table);
  if (wrong == 0) return kGood;
  complain(fmt::format("{} missed or invented; see the column 'wrong'",
                       wrong == 1 ? "1 pair is" : fmt::format("{} pairs are", wrong)));
  return kFailed;
}

}  // namespace lantern::app
