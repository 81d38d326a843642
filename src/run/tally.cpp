#include "run/tally.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "frame/panel.hpp"
#include "frame/parts/motion.hpp"
#include "frame/parts/panels.hpp"
#include "physics/methods.hpp"

namespace lantern::run {
namespace {

Amount amount(std::uint64_t n, std::string name, std::string many = {}) {
  if (many.empty()) many = name + "s";
  return {n, std::move(name), std::move(many)};
}

std::uint64_t count_of(const Frame& frame, std::string_view name) {
  return static_cast<std::uint64_t>(frame.count(name).value_or(0));
}

std::uint64_t points_of(const FrameChart& chart) {
  std::uint64_t points = chart.bars.size();
  for (const FrameSeries& series : chart.series) points += series.points.size();
  return points;
}

}  // namespace

bool StageTally::used() const {
  return std::ranges::any_of(amounts, [](const Amount& a) { return a.n > 0; });
}

void Tally::Seen::add(const Frame& frame) {
  bodies += frame.bodies.size();
  for (const FrameBody& body : frame.bodies) asleep += body.asleep;
  for (const FrameLink& link : frame.get<FrameLinks>().links)
    ++(link.kind == FrameLink::Kind::spring ? springs : joints);
  textures += count_of(frame, "textures");
  walls += count_of(frame, "walls");
  sectors += count_of(frame, "sectors");
}

// A step always ends with a frame, and never builds two kinds: what was built since the frame
// before is of this frame's kind.
void Tally::see(const Frame& frame) {
  seconds_ = std::max(seconds_, frame.time);
  solid_ += frame.dimension == 3;
  Seen seen;
  seen.points = points_of(frame.get<FrameChart>());
  if (frame.sides.empty()) seen.add(frame);
  for (const Frame& side : frame.sides) seen.add(side);
  for (const auto n : {&Seen::bodies, &Seen::asleep, &Seen::springs, &Seen::joints, &Seen::textures,
                       &Seen::walls, &Seen::sectors, &Seen::points})
    most_.*n = std::max(most_.*n, seen.*n);
  for (std::size_t i = 0; i < panel_kinds().size(); ++i)
    for (const PanelRun::Content& content : run_of(Panel(i)).shows)
      with_[{i, content.what}] +=
          content.is_on(frame) || std::ranges::any_of(frame.sides, content.is_on);
  count_builds(frame);
}

// Of sides of several kinds it is not known which built.
void Tally::count_builds(const Frame& frame) {
  const Frame& first = frame.sides.empty() ? frame : frame.sides[0];
  const bool one_kind = std::ranges::all_of(
      frame.sides, [&](const Frame& side) { return side.structure == first.structure; });
  const std::uint64_t builds = work_.structure_builds;
  const bool named = first.structure != StructureKind::none;
  if (builds > builds_before_ && one_kind)
    builds_[named ? first.structure : StructureKind::brute_force] += builds - builds_before_;
  else
    builds_of_several_ += builds - builds_before_;
  builds_before_ = builds;
}

std::vector<StageTally> Tally::stages(const DirectorReport& report) const {
  Stages all;
  list_motion(report.world, all);
  list_structures(report.world, all);
  list_contacts(report.world, all);
  list_others(report, all);
  list_pictures(all);
  return all;
}

void Tally::list_motion(const WorldWork& world, Stages& all) const {
  const char* still = work_.world_steps == 0 ? "no world step was made" : "";
  all.push_back({"world",
                 {amount(most_.bodies, "body", "bodies"), amount(work_.worlds_created, "world")},
                 scenario_.bodies.empty() ? "the scenario has no bodies" : ""});
  all.push_back({"motion",
                 {amount(work_.world_steps, "step")},
                 !*still        ? fmt::format("{:.6g} s passed", seconds_)
                 : seconds_ > 0 ? "there is no body to move"
                                : "no time passed"});
  all.push_back({"rotation", {amount(world.rotations_integrated, "rotation")}, still});
  all.push_back({"forces", {amount(world.force_evaluations, "evaluation")}, still});
  all.push_back({"springs and joints",
                 {amount(most_.springs, "spring"), amount(most_.joints, "joint")},
                 scenario_.links.empty() ? "nothing is tied to anything" : ""});
}

void Tally::list_structures(const WorldWork& world, Stages& all) const {
  std::vector<Amount> builds;
  for (const auto& [kind, n] : builds_)
    builds.push_back(amount(n, fmt::format("{} build", to_string(kind))));
  if (builds_of_several_ > 0) builds.push_back(amount(builds_of_several_, "build"));
  if (builds.empty()) builds.push_back(amount(work_.structure_builds, "build"));
  const std::string& why = scenario_.structure.why;
  all.push_back({"structure", std::move(builds),
                 work_.structures_created == 0 ? "the scenario names none"
                 : why.empty()                 ? ""
                                               : fmt::format("chosen for its bodies: {}", why)});
  all.push_back({"static structure",
                 {amount(work_.static_builds, "build")},
                 work_.static_builds == 0 ? "nothing is stored apart" : ""});
  all.push_back({"broad phase",
                 {amount(world.broad_phases, "search in steps", "searches in steps"),
                  amount(world.candidate_pairs, "pair handed on", "pairs handed on"),
                  amount(work_.pair_searches, "search for frames", "searches for frames"),
                  amount(work_.pairs_found, "pair listed", "pairs listed")},
                 ""});
}

void Tally::list_contacts(const WorldWork& world, Stages& all) const {
  std::string methods;  // that the file names, in its order
  ContactMethod last = ContactMethod::none;
  const auto add = [&](ContactMethod method) {
    if (method == std::exchange(last, method)) return;
    methods +=
        fmt::format("{}{}", methods.empty() ? "the file names " : ", then ", to_string(method));
  };
  add(scenario_.world.contacts);
  for (const Step& step : scenario_.steps)
    if (const auto* solve_by = std::get_if<SolveBy>(&step.verb)) add(solve_by->contacts);
  const char* off = methods.empty() && !scenario_.bodies.empty() ? "contacts are off" : "";
  all.push_back({"narrow phase",
                 {amount(world.narrow_pairs, "pair"), amount(world.narrow_tests, "test")},
                 off});
  all.push_back({"contact solver",
                 {amount(world.islands_solved, "island"),
                  amount(world.constraint_rows - world.direct_rows, "row swept", "rows swept"),
                  amount(world.direct_solves, "direct solve"),
                  amount(world.direct_rows, "row solved at once", "rows solved at once"),
                  amount(world.sub_steps, "sub-step"),
                  amount(world.errors_missed, "wanted error missed", "wanted errors missed")},
                 world.islands_solved > 0 ? methods : off});
  all.push_back({"friction", {amount(world.friction_rows, "row")}, off});
  all.push_back({"sleeping",
                 {amount(most_.asleep, "body at most", "bodies at most"),
                  amount(world.rest_checks, "check for rest", "checks for rest")},
                 scenario_.world.may_sleep ? "" : "no body falls asleep by itself"});
}

void Tally::list_others(const DirectorReport& report, Stages& all) const {
  all.push_back({"queries",
                 {amount(work_.queries, "ray, cull or query", "rays, culls or queries")},
                 work_.queries == 0 ? "no step asks" : ""});
  all.push_back({"level",
                 {amount(most_.walls, "wall"), amount(most_.sectors, "sector")},
                 !scenario_.level   ? "the scenario has none"
                 : most_.walls == 0 ? "no step compiles it"
                                    : ""});
  all.push_back({"atlas",
                 {amount(work_.atlases_created, "atlas", "atlases"),
                  amount(most_.textures, "texture packed", "textures packed")},
                 scenario_.atlas ? "" : "the scenario has none"});
  all.push_back({"expectations",
                 {amount(report.expectations, "check")},
                 report.unmet.empty() ? "" : fmt::format("{} do not hold", report.unmet.count())});
  all.push_back({"chart",
                 {amount(most_.points, "point or bar", "points or bars")},
                 scenario_.chart ? "" : "the scenario has none"});
}

void Tally::list_pictures(Stages& all) const {
  for (std::size_t i = 0; i < panel_kinds().size(); ++i) {
    const PanelRun& panel = run_of(Panel(i));
    const std::string_view name = kind_of(Panel(i)).name;
    const bool drawn = shows(scenario_.panels, name);
    StageTally& tally = all.emplace_back();
    tally.stage = panel.stage.empty() ? fmt::format("{} panel", name) : std::string(panel.stage);
    tally.note = drawn ? "" : "none of the scenario's panels";
    for (const PanelRun::Content& content : panel.shows) {
      const auto with = with_.find({i, content.what});
      tally.amounts.push_back(amount(drawn && with != with_.end() ? with->second : 0,
                                     fmt::format("frame with {}", content.what),
                                     fmt::format("frames with {}", content.what)));
    }
  }
  all.push_back({"3D camera", {amount(solid_, "3D frame")}, solid_ == 0 ? "the world is 2D" : ""});
  all.push_back({"OpenGL",
                 {amount(work_.graphics_contexts, "context")},
                 "nothing is drawn here; of all output only PNG files need it"});
}

}  // namespace lantern::run
