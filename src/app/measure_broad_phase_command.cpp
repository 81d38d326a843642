// `measure broad_phase`: the settings of trees.
#include <fmt/format.h>

#include "app/answer.hpp"
#include "app/commands.hpp"
#include "app/progress.hpp"
#include "app/report_folder.hpp"
#include "app/scenario_folder.hpp"
#include "app/terminal.hpp"
#include "measure/broad_phase_cost.hpp"
#include "report/pages.hpp"

namespace lantern::app {
namespace {

constexpr std::size_t kBodies = 2000;
constexpr std::uint64_t kSeed = 1;

std::vector<BoxScene> scenes_of(const MeasureBroadPhaseOptions& options) {
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

int measure_broad_phase_command(const MeasureBroadPhaseOptions& options) {
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
