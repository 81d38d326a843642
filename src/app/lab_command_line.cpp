#include "app/commands.hpp"

namespace lantern::app {
namespace {

Option peers_option(bool& peers, const char* help) { return {"!--no-peers", &peers, help}; }

Option longest_option(std::optional<double>& longest, const char* help) {
  return {"--longest", &longest, help, {.value = "S", .above_0 = true}};
}

Option rounds_option(int& rounds, const char* help, double most) {
  return {"--rounds", &rounds, help, {.least = 1, .most = most}};
}

Option folder_option(std::string& folder, const char* help) {
  return {"-o,--output", &folder, help, {.value = "DIR"}};
}

Option only_option(std::vector<std::string>& only, const char* help) {
  return {"--only", &only, help, {.value = "NAME", .one_each = true}};
}

Options measure_options(MeasureOptions& o) {
  return {
      {"PROBLEM", &o.problems,
       "problems or families by name, or scenario files; the default is all problems; "
       "'broad_phase' measures the trees' settings"},
      folder_option(o.output, "folder for tables, plots and the overview page"),
      {"--method",
       &o.methods,
       "only these: velocity_verlet, soft:16, impulse:100, ...",
       {.value = "NAME", .one_each = true}},
      {"--step", &o.steps, "only these time steps, seconds", {.value = "H", .one_each = true}},
      {"--quick", &o.quick, "about a minute: plain problems, few repeats"},
      {"--full", &o.full, "every run, however long it takes", {.without = "--quick"}},
      longest_option(o.longest, "leave out runs that would take more seconds than this"),
      peers_option(o.peers, "without other engines"),
      {"--theme", &o.theme, "colours of the plots", {.words = kThemes}},
      backend_option(o.backend, "off-screen OpenGL, for the PNG files"),
      {"--list", &o.list, "name the problems, measure nothing"},
      {"--from",
       &o.from,
       "measure nothing: report.html of these folders or measure.json files, one a "
       "machine, side by side",
       {.value = "PATH"}},
      memory_option(),
      json_option(o.json),
  };
}

Options bench_step_options(BenchStepOptions& o) {
  return {
      {"--pile",
       &o.piles,
       "boxes2d:N, balls2d:N, boxes3d:N, balls3d:N; the default is some of 500 and 2,000",
       {.value = "PILE", .one_each = true}},
      {"--seconds",
       &o.seconds,
       "of the fall; the default is 4, with --full 10",
       {.value = "S", .least = 1, .most = 3600}},
      longest_option(o.longest,
                     "a solver ends early at a pile that takes it more seconds than this; the "
                     "default is 20, with --full 600"),
      only_option(o.only, "only these: soft:8, impulse:100, Box2D, ..."),
      {"--broad-phase",
       &o.broad_phase,
       "ours: sort_and_sweep, quadtree, octree, ...",
       {.value = "KIND"}},
      folder_option(o.output, "folder for bench_step.html, bench_step.csv and bench_step.json"),
      {"--full", &o.full, "500, 2,000 and 5,000 boxes and balls in 2D and 3D: hours"},
      peers_option(o.peers, "without other engines"),
      memory_option(),
      json_option(o.json),
  };
}

Options bench_pairs_options(BenchPairsOptions& o) {
  return {
      {"--workload",
       &o.workloads,
       "only these: uniform, clustered, mixed, thin, coincident, brownian, free_fall, gravity, "
       "town, or what is asked: rays, first_hits, boxes, balls; uniform_2d is only "
       "one of two dimensions",
       {.value = "NAME", .one_each = true}},
      {"--bodies",
       &o.bodies,
       "how many boxes; the default is each workload's own numbers",
       {.value = "N", .least = 2, .most = 20000000, .one_each = true}},
      {"--boxes",
       &o.boxes,
       "boxes of your own instead: CSV, a line a box (lo_x,lo_y,hi_x,hi_y or named "
       "columns), or .aabbs of Broadmark",
       {.value = "FILE", .without = "--workload"}},
      only_option(o.only, "only these: quadtree, sort_and_sweep, CGAL, ..."),
      rounds_option(o.rounds, "turns of each contestant; medians count", 10000),
      {"--seconds",
       &o.seconds,
       "that a contestant is timed at a world, but three rounds at least; the default is "
       "0.1, with --full 4",
       {.value = "S", .above_0 = true}},
      longest_option(o.longest,
                     "leave out who needs more seconds a step than this; the default is 0.4, "
                     "with --full 10"),
      seed_option(o.seed, "of the boxes"),
      folder_option(o.output, "folder for bench_pairs.html, bench_pairs.csv and bench_pairs.json"),
      {"--full", &o.full, "up to a million boxes: the better part of an hour"},
      peers_option(o.peers, "without other libraries"),
      memory_option(),
      json_option(o.json),
  };
}

Options bench_atlas_options(BenchAtlasOptions& o) {
  return {
      {"--set",
       &o.sets,
       "only these: square, powers, tall, glyphs",
       {.value = "NAME", .one_each = true}},
      {"--count",
       &o.counts,
       "textures of each set; the default is 500 and 5000",
       {.value = "N", .least = 1, .most = 1000000, .one_each = true}},
      {"--sizes",
       &o.sizes,
       "textures of your own instead: CSV, a line WIDTH,HEIGHT each",
       {.value = "FILE", .without = "--set,--count"}},
      {"--size",
       &o.atlas,
       "into an atlas of this size; the default is the smallest square",
       {.value = "WxH"}},
      only_option(o.only, "only these: first_fit, best_texture, stb_rect_pack, ..."),
      rounds_option(o.rounds, "turns of each contestant; medians count", 10000),
      seed_option(o.seed, "of the sets"),
      folder_option(o.output, "folder for bench_atlas.html, bench_atlas.csv and bench_atlas.json"),
      peers_option(o.peers, "without other packers"),
      memory_option(),
      json_option(o.json),
  };
}

Options bench_frames_options(BenchOptions& o) {
  return {
      {"FILE", &o.scenarios, "scenario files; the default is six of Lantern's in which much moves"},
      rounds_option(o.rounds, "repeats; the median counts", 1000),
      {"--frames",
       &o.frames,
       "of a sequence, at most; those that differ count",
       {.least = 2, .most = 10000}},
      folder_option(o.output,
                    "folder for bench_frames.html, bench_frames.csv and bench_frames.json"),
      memory_option(),
      json_option(o.json),
  };
}

Options stress_options(StressOptions& o) {
  return {
      {"CASE", &o.cases, "names of cases; the default is all that are not slow"},
      folder_option(o.output, "folder for stress.csv, stress.json, stability_map.png and .svg"),
      {"--theme", &o.theme, "colours of the stability map", {.words = kThemes}},
      backend_option(o.backend),
      {"--list", &o.list, "list the cases and exit"},
      {"--full", &o.full, "run the slow cases, too"},
      memory_option(),
      json_option(o.json),
  };
}

}  // namespace

std::vector<Command> lab_commands() {
  return {
      command("measure", "Error against run time: problems with known answers, method by method",
              measure_command, measure_options),
      {"bench",
       "Measure speed against named peers",
       nullptr,
       {command("frames", "Frames per second written to disk, beside cairo", bench_frames_command,
                bench_frames_options),
        command("pairs",
                "All pairs of moving boxes, and what rays, boxes and balls meet, beside other "
                "libraries",
                bench_pairs_command, bench_pairs_options),
        command("atlas", "How full texture atlases become, and how soon, beside stb",
                bench_atlas_command, bench_atlas_options),
        command("step", "Milliseconds and penetration of piles of bodies, beside engines",
                bench_step_command, bench_step_options)}},
      command("stress", "Check extreme input, stiff springs and the limits of stability",
              stress_command, stress_options),
  };
}

}  // namespace lantern::app
