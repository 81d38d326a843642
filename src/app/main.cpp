// The command line of Lantern: words to options, errors to exit codes.
#include <functional>
#include <new>
#include <sstream>
#include <string>

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

namespace lantern {
namespace {

using Run = std::function<int()>;

// An empty word is most often a shell variable that was never set.
const CLI::Validator kNotEmpty(
    [](const std::string& word) { return word.empty() ? "must not be empty" : std::string(); }, "");

void add_json(CLI::App& command, bool& json) {
  command.add_flag("--json", json, "print JSON instead of a table");
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

void add_render(CLI::App& app, RenderOptions& o, Run& run) {
  CLI::App* c = app.add_subcommand("render", "Draw a scenario's frames to PNG or SVG files");
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
  c->add_option("--format", o.format, "file format")
      ->check(CLI::IsMember({"png", "svg"}))
      ->capture_default_str();
  c->add_option("--theme", o.theme, "colours")
      ->check(CLI::IsMember({"light", "dark", "print"}))
      ->capture_default_str();
  c->add_option("--pace", o.pace, "one frame per step, or one for each thing the algorithm does")
      ->check(CLI::IsMember({"step", "event"}));
  c->add_option("--png", o.png, "fast to write, or small")
      ->check(CLI::IsMember({"fast", "small"}))
      ->capture_default_str();
  c->add_option("--backend", o.backend, "off-screen OpenGL")
      ->check(CLI::IsMember({"auto", "osmesa", "egl"}))
      ->capture_default_str();
  c->add_flag("--transparent", o.transparent, "draw no background");
  c->add_flag("--strict", o.strict, "turn warnings into errors (exit code 3)");
  c->add_option("-j,--threads", o.threads, "encoding threads; the default is one per core")
      ->check(CLI::Range(1, 256))
      ->type_name("N");
  add_memory(*c);
  add_json(*c, o.json);
  c->callback([&] { run = [&] { return render_command(o); }; });
}

void add_check(CLI::App& app, CheckOptions& o, Run& run) {
  CLI::App* c = app.add_subcommand("check", "Run scenarios without drawing, verify expectations");
  c->add_option("FILE", o.files, "scenario files")->required();
  c->add_option("--pace", o.pace, "as for render")->check(CLI::IsMember({"step", "event"}));
  add_memory(*c);
  c->add_flag("--strict", o.strict, "turn warnings into errors (exit code 3)");
  add_json(*c, o.json);
  c->callback([&] { run = [&] { return check_command(o); }; });
}

void add_list(CLI::App& app, ListOptions& o, Run& run) {
  CLI::App* c = app.add_subcommand("list", "List the scenarios in a folder");
  c->add_option("DIR", o.folders, "folders; the default is scenarios");
  add_json(*c, o.json);
  c->callback([&] { run = [&] { return list_command(o); }; });
}

void add_explain(CLI::App& app, ExplainOptions& o, Run& run) {
  CLI::App* c = app.add_subcommand("explain",
                                   "Run a scenario without pixels, tell what each stage did");
  c->add_option("FILE", o.file, "scenario file")->required();
  add_memory(*c);
  add_json(*c, o.json);
  c->callback([&] { run = [&] { return explain_command(o); }; });
}

void add_doctor(CLI::App& app, DoctorOptions& o, Run& run) {
  CLI::App* c = app.add_subcommand("doctor", "Graphics backends found, and what to install");
  add_json(*c, o.json);
  c->callback([&] { run = [&] { return doctor_command(o); }; });
}

void add_compare(CLI::App& app, CompareOptions& o, Run& run) {
  CLI::App* c = app.add_subcommand("compare", "Compare two PNG images, or two folders of them");
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
  c->callback([&] { run = [&] { return compare_command(o); }; });
}

void add_measure(CLI::App& app, MeasureOptions& o, Run& run) {
  CLI::App* c = app.add_subcommand(
      "measure", "Error against run time: problems with known answers, method by method");
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
  c->add_option("--theme", o.theme, "colours of the plots")
      ->check(CLI::IsMember({"light", "dark", "print"}))
      ->capture_default_str();
  c->add_option("--backend", o.backend, "off-screen OpenGL, for the PNG files")
      ->check(CLI::IsMember({"auto", "osmesa", "egl"}))
      ->capture_default_str();
  c->add_flag("--list", o.list, "name the problems, measure nothing");
  add_memory(*c);
  add_json(*c, o.json);
  c->callback([&] { run = [&] { return measure_command(o); }; });
}

void add_bench(CLI::App& app, BenchOptions& o, Run& run) {
  CLI::App* c = app.add_subcommand("bench", "Measure speed against named peers");
  c->require_subcommand(1);
  CLI::App* frames = c->add_subcommand("frames", "Frames per second written to disk, beside cairo");
  frames->add_option("FILE", o.scenario, "scenario file")->capture_default_str();
  frames->add_option("--rounds", o.rounds, "repeats; the median counts")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  add_memory(*frames);
  add_json(*frames, o.json);
  frames->callback([&] { run = [&] { return bench_frames_command(o); }; });
}

void add_stress(CLI::App& app, StressOptions& o, Run& run) {
  CLI::App* c = app.add_subcommand(
      "stress", "Check extreme input, stiff springs and the limits of stability");
  c->add_option("CASE", o.cases, "names of cases; the default is all that are not slow");
  c->add_option("-o,--output", o.output,
                "folder for stress.csv, stress.json, stability_map.png and .svg")
      ->check(kNotEmpty)
      ->type_name("DIR");
  c->add_option("--theme", o.theme, "colours of the stability map")
      ->check(CLI::IsMember({"light", "dark", "print"}))
      ->capture_default_str();
  c->add_option("--backend", o.backend, "off-screen OpenGL")
      ->check(CLI::IsMember({"auto", "osmesa", "egl"}))
      ->capture_default_str();
  c->add_flag("--list", o.list, "list the cases and exit");
  c->add_flag("--full", o.full, "run the slow cases, too");
  add_memory(*c);
  add_json(*c, o.json);
  c->callback([&] { run = [&] { return stress_command(o); }; });
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
  print("reference", "Print the scenario language's reference page (Markdown)", reference_page);
  print("schema", "Print the scenario language's JSON Schema", json_schema);
}

// A misspelt subcommand gets the nearest one.
std::string usage_hint(int argc, char** argv) {
  static constexpr std::string_view kCommands[] = {"render", "check",     "list",    "explain",
                                                   "doctor", "compare",   "measure", "stress",
                                                   "bench",  "reference", "schema"};
  if (argc < 2 || argv[1][0] == '-') return "see 'lantern --help'";
  const std::string_view word = argv[1];
  for (const std::string_view command : kCommands)
    if (word == command) return "see 'lantern " + std::string(command) + " --help'";
  const std::string hint = suggestion(word, kCommands);
  return "there is no command '" + std::string(word) + "'; " + hint;
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
  RenderOptions render;
  CheckOptions check;
  ListOptions list;
  ExplainOptions explain;
  DoctorOptions doctor;
  CompareOptions compare;
  MeasureOptions measure;
  BenchOptions bench;
  StressOptions stress;
  Run run;
  add_render(app, render, run);
  add_check(app, check, run);
  add_list(app, list, run);
  add_explain(app, explain, run);
  add_doctor(app, doctor, run);
  add_compare(app, compare, run);
  add_measure(app, measure, run);
  add_bench(app, bench, run);
  add_stress(app, stress, run);
  add_texts(app, run);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() != 0)
      throw UsageError(std::string(e.what()) + "; " + usage_hint(argc, argv));
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
}  // namespace lantern

int main(int argc, char** argv) {
  lantern::hold_standard_streams();
  lantern::catch_interrupts();
  return lantern::run_and_report([&] { return lantern::run_words(argc, argv); });
}
