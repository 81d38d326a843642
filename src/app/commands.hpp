// The subcommands: what each is told, and its exit code. Reading the command line is in main.cpp.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace lantern::app {

// What a run of the program ends with.
enum ExitCode {
  kGood = 0,
  kFailed = 1,  // an expectation, a comparison, a file; silently, if nobody reads the output
  kUsage = 2,
  kBadScenario = 3,
  kNoBackend = 4,
  kInterrupted = 130,
};

struct RenderOptions {
  std::vector<std::string> files;
  std::string output = "output";  // folder or file, see Destination; "-" is standard output
  std::string sheet;              // "3x2": frames across and down a page; empty for none
  std::string frames;             // "7", "3-9", "3-", "-9"; empty for all
  std::string at;                 // an event or a time in seconds; empty for all
  std::string size;               // pixels; empty for 1600x900, and for a sheet A4 across
  int dpi = 160;                  // pixels to the inch, where a picture meets paper
  std::string format = "png";     // png, svg
  std::string text = "outlines";  // of SVG: outlines, text
  std::string theme = "light";
  std::string pace;              // step, event; empty for the scenario's own
  std::string png = "fast";      // fast, small
  std::string facts = "2";       // lantern.frame/2, or /1 until the next release
  std::string backend = "auto";  // auto, osmesa, egl
  bool transparent = false;
  bool no_title = false, no_caption = false, no_counters = false;  // not drawn
  bool legend = false;                                             // drawn in any case
  bool strict = false;                                             // warnings are errors
  int threads = 0;                                                 // that encode; 0 for one a core
  std::optional<std::uint64_t> tween = std::nullopt;  // in-betweens before each frame but the first
  std::optional<double> fps = std::nullopt;           // or as many as a change of half a second has
  bool reloading = false;  // a page loads itself again when it was made again (app/reload.hpp)
  std::string shard = "";  // "2/4": the second of four parts; empty for all
  std::optional<double> hold = std::nullopt;     // seconds of each still of a film
  bool format_given = false, png_given = false;  // on the command line
  bool json = false;
};
int render_command(const RenderOptions& options);
// Renders, and again what was saved since, until Ctrl-C: exit code 130.
int watch_command(const RenderOptions& options);

// Parts that --shard has made.
struct MergeOptions {
  std::string output;                // folder of the whole
  std::vector<std::string> folders;  // that shards wrote into; empty: the same
  bool json = false;
};
int merge_command(const MergeOptions& options);

struct CheckOptions {
  std::vector<std::string> files;
  std::string pace;
  bool strict = false;  // a warning is an error
  bool json = false;
};
int check_command(const CheckOptions& options);

struct ListOptions {
  std::vector<std::string> folders;
  bool course = false;
  bool json = false;
};
int list_command(const ListOptions& options);

struct ExplainOptions {
  std::string file;
  bool json = false;
};
int explain_command(const ExplainOptions& options);

struct ReferenceOptions {
  std::string pictures;  // folder; empty: the page is printed
  std::string backend = "auto";
  bool json = false;
};
int reference_command(const ReferenceOptions& options);

struct DoctorOptions {
  bool json = false;
};
int doctor_command(const DoctorOptions& options);

struct StructureListOptions {
  bool json = false;
};
int structure_list_command(const StructureListOptions& options);

struct StructureCheckOptions {
  std::vector<std::string> names;  // empty for all
  std::uint64_t worlds = 500;
  std::uint64_t seed = 1;
  std::string output = "output";  // folder of the scenario that shows a fault; empty for none
  bool json = false;
};
int structure_check_command(const StructureCheckOptions& options);

struct StructureBenchOptions {
  std::vector<std::string> names;     // empty for all
  std::vector<std::uint64_t> bodies;  // empty for the usual numbers
  std::uint64_t seed = 1;
  int rounds = 9;
  std::string output;  // folder; empty for none
  bool json = false;
};
int structure_bench_command(const StructureBenchOptions& options);

struct CompareOptions {
  std::string expected;
  std::string actual;
  std::string output;  // where the difference picture goes; empty for nowhere
  int tolerance = 0;
  double fraction = 0;  // of the pixels that may differ
  bool json = false;
};
int compare_command(const CompareOptions& options);

struct GoldenOptions {
  std::vector<std::string> files;
  std::string folder = "golden";  // the golden frames are in folder/<scenario>
  bool update = false;            // today's frames become the golden ones
  std::string report;             // an HTML file, or a folder for golden.html; empty: the usual one
  std::string junit;              // an XML file; empty for none
  int tolerance = 0;
  double fraction = 0;  // of the pixels that may differ
  std::string size = "640x360";
  std::string theme = "light";
  std::string pace;        // step, event; empty for the scenario's own
  std::string frames, at;  // as for render
  std::string backend = "auto";
  bool json = false;
};
int golden_command(const GoldenOptions& options);

struct MeasureOptions {
  std::vector<std::string> problems;  // names, families or files; empty for all
  std::string output = "output/measure";
  std::vector<std::string> methods;  // empty for those of each problem
  std::vector<double> steps;         // seconds; empty for those of each problem
  std::vector<std::string> from;     // earlier measurements: only their page is made
  bool quick = false;
  bool full = false;
  std::optional<double> longest;  // processor seconds of one run; longer ones are left out
  bool peers = true;
  std::string theme = "light";
  std::string backend = "auto";
  bool list = false;
  bool json = false;
};
int measure_command(const MeasureOptions& options);

struct BenchOptions {
  std::vector<std::string> scenarios;  // files; empty for some of those that come with Lantern
  int rounds = 5;
  int frames = 40;     // of a sequence, at most
  std::string output;  // folder; empty for none
  bool json = false;
};
int bench_frames_command(const BenchOptions& options);

struct BenchStepOptions {
  std::vector<std::string> piles;  // "boxes2d:2000"; empty for the usual ones
  std::optional<double> seconds;   // of the fall
  std::optional<double> longest;   // seconds of computing for a solver at a pile
  std::vector<std::string> only;   // solvers; empty for all
  std::string broad_phase = "sort_and_sweep";
  std::string output;  // folder; empty for none
  bool full = false;   // all piles, for as long as it takes
  bool peers = true;
  bool json = false;
};
int bench_step_command(const BenchStepOptions& options);

struct BenchAtlasOptions {
  std::vector<std::string> sets;      // names; empty for all
  std::vector<std::uint64_t> counts;  // textures; empty for the usual numbers
  std::string sizes;                  // a file of one's own textures instead of sets
  std::string atlas;                  // "1024x1024"; empty for the smallest square
  std::vector<std::string> only;      // contestants; empty for all
  int rounds = 15;
  std::uint64_t seed = 1;
  std::string output;  // folder; empty for none
  bool peers = true;
  bool json = false;
};
int bench_atlas_command(const BenchAtlasOptions& options);

struct BenchPairsOptions {
  std::vector<std::string> workloads;  // names; empty for all
  std::vector<std::uint64_t> bodies;   // empty for those of each workload
  std::vector<std::string> only;       // contestants; empty for all
  std::string boxes;                   // a file of one's own, instead of workloads
  std::uint64_t seed = 1;
  int rounds = 9;
  std::optional<double> seconds;  // of each contestant's rounds
  std::optional<double> longest;  // seconds of a step
  std::string output;             // folder; empty for none
  bool full = false;
  bool peers = true;
  bool json = false;
};
int bench_pairs_command(const BenchPairsOptions& options);

struct StressOptions {
  std::vector<std::string> cases;  // names; empty for all that are not slow
  std::string output;              // folder; empty for none
  std::string theme = "light";
  std::string backend = "auto";  // auto, osmesa, egl
  bool list = false;
  bool full = false;  // the slow ones, too
  bool json = false;
};
int stress_command(const StressOptions& options);

struct MeasureBroadPhaseOptions {
  std::vector<std::string> files;  // scenarios; empty for worlds of its own
  std::string output;              // folder of table, CSV, JSON and plots; empty: only the table
  std::string theme = "light";     // of the plots
  bool full = false;               // more and longer repeats
  bool json = false;
};
// Pairs missed, work and time of the broad phases over capacity and depth limit.
int measure_broad_phase_command(const MeasureBroadPhaseOptions& options);

}  // namespace lantern::app
