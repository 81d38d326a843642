#include <string>

#include <CLI/CLI.hpp>

#include "app/command_line.hpp"
#include "app/commands.hpp"
#include "app/option_words.hpp"

namespace lantern::app {
namespace {

void measure_options(CLI::App* c, MeasureOptions& o) {
  c->add_option("PROBLEM", o.problems,
                "problems or families by name, or scenario files; the default is all problems; "
                "'broad_phase' measures the trees' settings");
  c->add_option("-o,--output", o.output, "folder for tables, plots and the overview page")
      ->type_name("DIR")
      ->capture_default_str();
  c->add_option("--method", o.methods, "only these: velocity_verlet, soft:16, impulse:100, ...")
      ->allow_extra_args(false)
      ->type_name("NAME");
  c->add_option("--step", o.steps, "only these time steps, seconds")
      ->allow_extra_args(false)
      ->type_name("H");
  CLI::Option* quick =
      c->add_flag("--quick", o.quick, "about a minute: plain problems, few repeats");
  c->add_flag("--full", o.full, "every run, however long it takes")->excludes(quick);
  c->add_option("--longest", o.longest, "leave out runs that would take more seconds than this")
      ->check(CLI::PositiveNumber)
      ->check(kFinite)
      ->type_name("S");
  c->add_flag("!--no-peers", o.peers, "without other engines");
  add_choice(*c, "--theme", o.theme, "colours of the plots", kThemes);
  add_choice(*c, "--backend", o.backend, "off-screen OpenGL, for the PNG files", kBackends);
  c->add_flag("--list", o.list, "name the problems, measure nothing");
  c->add_option("--from", o.from,
                "measure nothing: report.html of these folders or measure.json files, one a "
                "machine, side by side")
      ->type_name("PATH");
  add_memory(*c);
  add_json(*c, o.json);
}

void bench_step_options(CLI::App* c, BenchStepOptions& o) {
  c->add_option("--pile", o.piles,
                "boxes2d:N, balls2d:N, boxes3d:N, balls3d:N; the default is some of 500 and 2,000")
      ->allow_extra_args(false)
      ->type_name("PILE");
  c->add_option("--seconds", o.seconds, "of the fall; the default is 4, with --full 10")
      ->check(CLI::Range(1.0, 3600.0))
      ->check(kFinite)
      ->type_name("S");
  c->add_option("--longest", o.longest,
                "a solver ends early at a pile that takes it more seconds than this; the default "
                "is 20, with --full 600")
      ->check(CLI::PositiveNumber)
      ->check(kFinite)
      ->type_name("S");
  c->add_option("--only", o.only, "only these: soft:8, impulse:100, Box2D, ...")
      ->allow_extra_args(false)
      ->type_name("NAME");
  c->add_option("--broad-phase", o.broad_phase, "ours: sort_and_sweep, quadtree, octree, ...")
      ->type_name("KIND")
      ->capture_default_str();
  c->add_option("-o,--output", o.output,
                "folder for bench_step.html, bench_step.csv and bench_step.json")
      ->type_name("DIR");
  c->add_flag("--full", o.full, "500, 2,000 and 5,000 boxes and balls in 2D and 3D: hours");
  c->add_flag("!--no-peers", o.peers, "without other engines");
  add_memory(*c);
  add_json(*c, o.json);
}

void bench_pairs_options(CLI::App* c, BenchPairsOptions& o) {
  CLI::Option* workload =
      c->add_option(
           "--workload", o.workloads,
           "only these: uniform, clustered, mixed, thin, coincident, brownian, free_fall, gravity, "
           "town, or what is asked: rays, first_hits, boxes, balls; uniform_2d is only "
           "one of two dimensions")
          ->allow_extra_args(false)
          ->type_name("NAME");
  c->add_option("--bodies", o.bodies, "how many boxes; the default is each workload's own numbers")
      ->check(CLI::Range(std::uint64_t{2}, std::uint64_t{20000000}))
      ->allow_extra_args(false)
      ->type_name("N");
  c->add_option("--boxes", o.boxes,
                "boxes of your own instead: CSV, a line a box (lo_x,lo_y,hi_x,hi_y or named "
                "columns), or .aabbs of Broadmark")
      ->excludes(workload)
      ->type_name("FILE");
  c->add_option("--only", o.only, "only these: quadtree, sort_and_sweep, CGAL, ...")
      ->allow_extra_args(false)
      ->type_name("NAME");
  c->add_option("--rounds", o.rounds, "turns of each contestant; medians count")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  c->add_option("--seconds", o.seconds,
                "that a contestant is timed at a world, but three rounds at least; the default is "
                "0.1, with --full 4")
      ->check(CLI::PositiveNumber)
      ->check(kFinite)
      ->type_name("S");
  c->add_option("--longest", o.longest,
                "leave out who needs more seconds a step than this; the default is 0.4, with "
                "--full 10")
      ->check(CLI::PositiveNumber)
      ->check(kFinite)
      ->type_name("S");
  add_seed(*c, o.seed, "of the boxes");
  c->add_option("-o,--output", o.output,
                "folder for bench_pairs.html, bench_pairs.csv and bench_pairs.json")
      ->type_name("DIR");
  c->add_flag("--full", o.full, "up to a million boxes: the better part of an hour");
  c->add_flag("!--no-peers", o.peers, "without other libraries");
  add_memory(*c);
  add_json(*c, o.json);
}

void bench_atlas_options(CLI::App* c, BenchAtlasOptions& o) {
  CLI::Option* set = c->add_option("--set", o.sets, "only these: square, powers, tall, glyphs")
                         ->allow_extra_args(false)
                         ->type_name("NAME");
  CLI::Option* count =
      c->add_option("--count", o.counts, "textures of each set; the default is 500 and 5000")
          ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1000000}))
          ->allow_extra_args(false)
          ->type_name("N");
  c->add_option("--sizes", o.sizes, "textures of your own instead: CSV, a line WIDTH,HEIGHT each")
      ->excludes(set)
      ->excludes(count)
      ->type_name("FILE");
  c->add_option("--size", o.atlas, "into an atlas of this size; the default is the smallest square")
      ->type_name("WxH");
  c->add_option("--only", o.only, "only these: first_fit, best_texture, stb_rect_pack, ...")
      ->allow_extra_args(false)
      ->type_name("NAME");
  c->add_option("--rounds", o.rounds, "turns of each contestant; medians count")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  add_seed(*c, o.seed, "of the sets");
  c->add_option("-o,--output", o.output,
                "folder for bench_atlas.html, bench_atlas.csv and bench_atlas.json")
      ->type_name("DIR");
  c->add_flag("!--no-peers", o.peers, "without other packers");
  add_memory(*c);
  add_json(*c, o.json);
}

void bench_frames_options(CLI::App* c, BenchOptions& o) {
  c->add_option("FILE", o.scenarios,
                "scenario files; the default is six of Lantern's in which much moves");
  c->add_option("--rounds", o.rounds, "repeats; the median counts")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  c->add_option("--frames", o.frames, "of a sequence, at most; those that differ count")
      ->check(CLI::Range(2, 10000))
      ->capture_default_str();
  c->add_option("-o,--output", o.output,
                "folder for bench_frames.html, bench_frames.csv and bench_frames.json")
      ->type_name("DIR");
  add_memory(*c);
  add_json(*c, o.json);
}

void add_bench(CLI::App* c, Run& run) {
  c->require_subcommand(1);
  add_command(*c, run, "frames", "Frames per second written to disk, beside cairo",
              bench_frames_command, bench_frames_options);
  add_command(*c, run, "pairs",
              "All pairs of moving boxes, and what rays, boxes and balls meet, beside other "
              "libraries",
              bench_pairs_command, bench_pairs_options);
  add_command(*c, run, "atlas", "How full texture atlases become, and how soon, beside stb",
              bench_atlas_command, bench_atlas_options);
  add_command(*c, run, "step", "Milliseconds and penetration of piles of bodies, beside engines",
              bench_step_command, bench_step_options);
}

void stress_options(CLI::App* c, StressOptions& o) {
  c->add_option("CASE", o.cases, "names of cases; the default is all that are not slow");
  c->add_option("-o,--output", o.output,
                "folder for stress.csv, stress.json, stability_map.png and .svg")
      ->type_name("DIR");
  add_choice(*c, "--theme", o.theme, "colours of the stability map", kThemes);
  add_choice(*c, "--backend", o.backend, "off-screen OpenGL", kBackends);
  c->add_flag("--list", o.list, "list the cases and exit");
  c->add_flag("--full", o.full, "run the slow cases, too");
  add_memory(*c);
  add_json(*c, o.json);
}

}  // namespace

void add_lab_commands(CLI::App& app, Run& run) {
  add_command(app, run, "measure",
              "Error against run time: problems with known answers, method by method",
              measure_command, measure_options);
  add_command(app, "bench", "Measure speed against named peers",
              [&run](CLI::App* c) { add_bench(c, run); });
  add_command(app, run, "stress", "Check extreme input, stiff springs and the limits of stability",
              stress_command, stress_options);
}

}  // namespace lantern::app
