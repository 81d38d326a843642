// The command line of Lantern: words to options, errors to exit codes.
#include <algorithm>
#include <functional>
#include <memory>
#include <new>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/interrupts.hpp"
#include "app/terminal.hpp"
#include "base/file.hpp"
#include "base/memory.hpp"
#include "base/stop.hpp"
#include "base/suggest.hpp"
#include "embedded/version.hpp"
#include "scenario/reference.hpp"

namespace lantern::app {
namespace {

using Run = std::function<int()>;

// An empty word is most often a shell variable that was never set.
const CLI::Validator kNotEmpty(
    [](const std::string& word) { return word.empty() ? "must not be empty" : std::string(); }, "");

const std::vector<std::string> kThemes = {"light", "dark", "print"};
const std::vector<std::string> kBackends = {"auto", "osmesa", "egl"};

void add_json(CLI::App& command, bool& json) {
  command.add_flag("--json", json, "print JSON instead of a table");
}

// One of some words.
void add_choice(CLI::App& command, const char* name, std::string& word, const char* help,
                const std::vector<std::string>& words) {
  command.add_option(name, word, help)->check(CLI::IsMember(words))->capture_default_str();
}

// Before a command, and after one that runs a scenario.
void add_memory(CLI::App& command) {
  command
      .add_option_function<std::string>(
          "--memory",
          [](const std::string& words) {
            const auto bytes = memory_size(words);
            if (!bytes)
              throw CLI::ValidationError(
                  fmt::format("--memory: '{}' is no size from {} on; write 800M or 4G", words,
                              memory_text(kLeastBudget)));
            set_memory_budget(*bytes);
          },
          "memory to take at most, such as 800M or 4G; the default is half of the machine's")
      ->type_name("SIZE");
}

// A command and its options, which live as long as it can be run.
template <class Options>
std::pair<CLI::App*, Options&> command(CLI::App& app, Run& run, const char* name, const char* help,
                                       int (*start)(const Options&)) {
  const auto options = std::make_shared<Options>();
  CLI::App* c = app.add_subcommand(name, help);
  c->callback([&run, options, start] { run = [options, start] { return start(*options); }; });
  return {c, *options};
}

void add_render(CLI::App& app, Run& run) {
  const auto [c, o] =
      command(app, run, "render", "Draw a scenario's frames to PNG or SVG files", render_command);
  c->add_option("FILE", o.files, "scenario files")->required();
  c->add_option("-o,--output", o.output,
                "folder for DIR/<scenario>/<scenario>_0000.png ...; - writes one frame to standard "
                "output")
      ->check(kNotEmpty)
      ->type_name("DIR")
      ->capture_default_str();
  c->add_option("--frames", o.frames, "only these frames: 7, 3-9, 3- or -9")
      ->check(kNotEmpty)
      ->type_name("A-B");
  c->add_option("--at", o.at,
                "only the frames of this event (a step's name, split, store, ...), or the first "
                "frame at or after this time in seconds")
      ->check(kNotEmpty)
      ->type_name("EVENT|TIME");
  c->add_option("--size", o.size, "pixels")->type_name("WxH")->capture_default_str();
  add_choice(*c, "--format", o.format, "file format", {"png", "svg"});
  CLI::Option* tween = c->add_option("--tween", o.tween,
                                     "in-betweens after each frame but the last: "
                                     "<scenario>_0007_03.png is the third from frame 7 on");
  tween->check(CLI::NonNegativeNumber)->type_name("N");
  c->add_option("--fps", o.fps,
                "as many in-betweens as a film of so many pictures a second has while something "
                "changes: half a second each, or the world's own time")
      ->check(CLI::Range(1.0, 240.0))
      ->excludes(tween)
      ->type_name("F");
  add_choice(*c, "--theme", o.theme, "colours", kThemes);
  c->add_option("--pace", o.pace, "one frame per step, or one for each thing the algorithm does")
      ->check(CLI::IsMember({"step", "event"}));
  add_choice(*c, "--png", o.png, "fast to write, or small", {"fast", "small"});
  add_choice(*c, "--facts", o.facts, "version of lantern.frame; 1 only until the next release",
             {"1", "2"});
  add_choice(*c, "--backend", o.backend, "off-screen OpenGL", kBackends);
  c->add_flag("--transparent", o.transparent, "draw no background");
  c->add_flag("--no-title", o.no_title, "leave out the line above");
  c->add_flag("--no-caption", o.no_caption, "leave out the caption below");
  c->add_flag("--no-counters", o.no_counters, "leave out the numbers beside the caption");
  c->add_flag("--legend", o.legend, "say what the marks on each frame mean");
  c->add_flag("--strict", o.strict, "turn warnings into errors (exit code 3)");
  c->add_option("-j,--threads", o.threads, "encoding threads; the default is one per core")
      ->check(CLI::Range(1, 256))
      ->type_name("N");
  add_memory(*c);
  add_json(*c, o.json);
}

void add_check(CLI::App& app, Run& run) {
  const auto [c, o] = command(app, run, "check",
                              "Run scenarios without drawing, verify expectations", check_command);
  c->add_option("FILE", o.files, "scenario files")->required();
  c->add_option("--pace", o.pace, "as for render")->check(CLI::IsMember({"step", "event"}));
  add_memory(*c);
  c->add_flag("--strict", o.strict, "turn warnings into errors (exit code 3)");
  add_json(*c, o.json);
}

void add_list(CLI::App& app, Run& run) {
  const auto [c, o] = command(
      app, run, "list", "List the scenarios in a folder in the order of a lecture", list_command);
  c->add_option("DIR", o.folders, "folders; the default is scenarios");
  add_json(*c, o.json);
}

void add_explain(CLI::App& app, Run& run) {
  const auto [c, o] =
      command(app, run, "explain", "Run a scenario without pixels, tell what each stage did",
              explain_command);
  c->add_option("FILE", o.file, "scenario file")->required();
  add_memory(*c);
  add_json(*c, o.json);
}

void add_doctor(CLI::App& app, Run& run) {
  const auto [c, o] =
      command(app, run, "doctor", "Graphics backends found, and what to install", doctor_command);
  add_json(*c, o.json);
}

void add_compare(CLI::App& app, Run& run) {
  const auto [c, o] = command(app, run, "compare", "Compare two PNG images, or two folders of them",
                              compare_command);
  c->add_option("EXPECTED", o.expected, "image or folder")->required();
  c->add_option("ACTUAL", o.actual, "image or folder")->required();
  c->add_option("-o,--output", o.output,
                "where the difference picture goes (a folder when folders are compared)")
      ->type_name("PATH");
  c->add_option("--tolerance", o.tolerance, "by how many levels a channel may differ")
      ->check(CLI::Range(0, 255))
      ->capture_default_str();
  c->add_option("--fraction", o.fraction, "fraction of the pixels that may differ")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  add_json(*c, o.json);
}

void add_measure(CLI::App& app, Run& run) {
  const auto [c, o] = command(
      app, run, "measure", "Error against run time: problems with known answers, method by method",
      measure_command);
  c->add_option("PROBLEM", o.problems,
                "problems or families by name, or scenario files; the default is all problems; "
                "'pictures' measures antialiasing, 'broad_phase' the trees' settings");
  c->add_option("-o,--output", o.output, "folder for tables, plots and the overview page")
      ->check(kNotEmpty)
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
      ->type_name("S");
  c->add_flag("!--no-peers", o.peers, "without other engines");
  add_choice(*c, "--theme", o.theme, "colours of the plots", kThemes);
  add_choice(*c, "--backend", o.backend, "off-screen OpenGL, for the PNG files", kBackends);
  c->add_flag("--list", o.list, "name the problems, measure nothing");
  c->add_option("--from", o.from,
                "measure nothing: report.html of these folders or measure.json files, one a "
                "machine, side by side")
      ->allow_extra_args(false)
      ->type_name("PATH");
  add_memory(*c);
  add_json(*c, o.json);
}

void add_bench_step(CLI::App& bench, Run& run) {
  const auto [c, o] =
      command(bench, run, "step", "Milliseconds and penetration of piles of bodies, beside engines",
              bench_step_command);
  c->add_option("--pile", o.piles,
                "boxes2d:N, balls2d:N, boxes3d:N, balls3d:N; the default is some of 500 and 2,000")
      ->allow_extra_args(false)
      ->type_name("PILE");
  c->add_option("--seconds", o.seconds, "of the fall; the default is 4, with --full 10")
      ->check(CLI::Range(1.0, 3600.0))
      ->type_name("S");
  c->add_option("--longest", o.longest,
                "a solver ends early at a pile that takes it more seconds than this; the default "
                "is 20, with --full 600")
      ->check(CLI::PositiveNumber)
      ->type_name("S");
  c->add_option("--only", o.only, "only these: soft:8, impulse:100, Box2D, ...")
      ->allow_extra_args(false)
      ->type_name("NAME");
  c->add_option("--broad-phase", o.broad_phase, "ours: sort_and_sweep, quadtree, octree, ...")
      ->type_name("KIND")
      ->capture_default_str();
  c->add_option("-o,--output", o.output, "folder for bench_step.csv and bench_step.json")
      ->check(kNotEmpty)
      ->type_name("DIR");
  c->add_flag("--full", o.full, "500, 2,000 and 5,000 boxes and balls in 2D and 3D: hours");
  c->add_flag("!--no-peers", o.peers, "without other engines");
  add_memory(*c);
  add_json(*c, o.json);
}

void add_bench(CLI::App& app, Run& run) {
  CLI::App* c = app.add_subcommand("bench", "Measure speed against named peers");
  c->require_subcommand(1);
  const auto [frames, o] = command(
      *c, run, "frames", "Frames per second written to disk, beside cairo", bench_frames_command);
  frames->add_option("FILE", o.scenario, "scenario file")->capture_default_str();
  frames->add_option("--rounds", o.rounds, "repeats; the median counts")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  add_memory(*frames);
  add_json(*frames, o.json);
  add_bench_step(*c, run);
}

void add_stress(CLI::App& app, Run& run) {
  const auto [c, o] =
      command(app, run, "stress", "Check extreme input, stiff springs and the limits of stability",
              stress_command);
  c->add_option("CASE", o.cases, "names of cases; the default is all that are not slow");
  c->add_option("-o,--output", o.output,
                "folder for stress.csv, stress.json, stability_map.png and .svg")
      ->check(kNotEmpty)
      ->type_name("DIR");
  add_choice(*c, "--theme", o.theme, "colours of the stability map", kThemes);
  add_choice(*c, "--backend", o.backend, "off-screen OpenGL", kBackends);
  c->add_flag("--list", o.list, "list the cases and exit");
  c->add_flag("--full", o.full, "run the slow cases, too");
  add_memory(*c);
  add_json(*c, o.json);
}

void add_texts(CLI::App& app, Run& run) {
  const auto print = [&app, &run](const char* name, const char* help, std::string (*text)()) {
    app.add_subcommand(name, help)->callback([&run, text] {
      run = [text] {
        write_stdout(text());
        return int{kGood};
      };
    });
  };
  const auto [c, o] =
      command(app, run, "reference", "Print the scenario language's reference page (Markdown)",
              reference_command);
  c->add_option("--pictures", o.pictures, "draw the page's pictures into this folder instead")
      ->check(kNotEmpty)
      ->type_name("DIR");
  add_choice(*c, "--backend", o.backend, "off-screen OpenGL", kBackends);
  print("schema", "Print the scenario language's JSON Schema", json_schema);
}

// A misspelt command gets the nearest one.
std::string usage_hint(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return "see 'lantern --help'";
  const std::string word = argv[1];
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands(nullptr)) names.push_back(command->get_name());
  if (std::find(names.begin(), names.end(), word) != names.end())
    return "see 'lantern " + word + " --help'";
  const std::vector<std::string_view> known(names.begin(), names.end());
  return "there is no command '" + word + "'; " + suggestion(word, known);
}

// Made before it is needed, when there may be no room for it.
std::string out_of_memory = "lantern: error: out of memory\n";

// What a run throws is told, and becomes its exit code.
int run_and_report(const Run& run) noexcept {
  try {
    return run();
  } catch (const UsageError& e) {
    complain(e.what());
    return kUsage;
  } catch (const ScenarioError& e) {
    complain(e);
    return kBadScenario;
  } catch (const BackendError& e) {
    complain(e);
    return kNoBackend;
  } catch (const ReaderGone&) {
    return kFailed;
  } catch (const Stopped&) {
    say("interrupted");
    return kInterrupted;
  } catch (const std::bad_alloc&) {
    write_stderr(out_of_memory);  // and needs none
    return kFailed;
  } catch (const std::exception& e) {
    complain(e.what());
    return kFailed;
  } catch (...) {
    complain("something that is no std::exception was thrown");
    return kFailed;
  }
}

// Reads the command line and runs what it asks for.
int run_words(int argc, char** argv) {
  CLI::App app{"Lantern renders lecture scenarios about spatial partitioning as pictures."};
  app.require_subcommand(1);
  app.set_version_flag("--version", std::string(kVersion));
  app.footer(
      "Exit codes: 0 good, 1 failed, 2 usage, 3 scenario error, 4 no graphics backend, "
      "130 interrupted.\nStart with: lantern render scenarios/ghost_quadtree.toml");
  add_memory(app);
  Run run;
  add_render(app, run);
  add_check(app, run);
  add_list(app, run);
  add_explain(app, run);
  add_doctor(app, run);
  add_compare(app, run);
  add_measure(app, run);
  add_bench(app, run);
  add_stress(app, run);
  add_texts(app, run);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() != 0)
      throw UsageError(std::string(e.what()) + "; " + usage_hint(app, argc, argv));
    std::ostringstream text;  // --help, --version
    app.exit(e, text, text);
    print(text.str());
    return kGood;
  }
  enforce_memory_budget();
  out_of_memory = fmt::format("lantern: error: out of memory: the budget is {}; --memory sets it\n",
                              memory_text(memory_budget()));
  return run();
}

}  // namespace
}  // namespace lantern::app

int main(int argc, char** argv) {
  lantern::hold_standard_streams();
  lantern::keep_freed_memory();
  lantern::app::catch_interrupts();
  return lantern::app::run_and_report([&] { return lantern::app::run_words(argc, argv); });
}
