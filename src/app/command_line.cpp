#include "app/command_line.hpp"

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/option_words.hpp"
#include "app/terminal.hpp"
#include "base/file.hpp"
#include "embedded/output_schema.hpp"
#include "embedded/version.hpp"
#include "rooms.hpp"
#include "scenario/reference.hpp"

namespace lantern::app {
namespace {

constexpr const char* kFilesHelp =
    "scenario files, folders of them (by 'lecture', then by name), or - for standard input";

// Of `render` and of `watch`.
void add_drawing(CLI::App* c, RenderOptions& o) {
  c->add_option("FILE", o.files, kFilesHelp)->required();
  c->add_option(
       "-o,--output", o.output,
       "a folder, for DIR/<scenario>/<scenario>_0000.png ...; or a file, whose ending says "
       "what it becomes: .png .svg pictures, .mp4 .webm .gif .apng .webp a film, .pdf a "
       "document, .html a lesson page; {scenario}, {step} and {frame} in its name make "
       "several, of a film with {step} a clip a step; - writes one picture to standard output")
      ->type_name("PATH")
      ->capture_default_str();
  c->add_option("--sheet", o.sheet, "so many frames across and down a page, with -o x.pdf or x.png")
      ->type_name("CxR");
  c->add_option("--frames", o.frames, "only these frames: 7, 3-9, 3- or -9")->type_name("A-B");
  c->add_option("--at", o.at,
                "only the frames of this event (a step's name, split, store, ...), or the first "
                "frame at or after this time in seconds")
      ->type_name("EVENT|TIME");
  c->add_option("--size", o.size, "pixels; the default is 1600x900, of a sheet A4 across")
      ->type_name("WxH");
  c->add_option("--dpi", o.dpi, "pixels to the inch: how large a PDF's page is, and a PNG on paper")
      ->check(CLI::Range(72, 1200))
      ->type_name("N")
      ->capture_default_str();
  add_choice(*c, "--format", o.format, "file format in a folder", {"png", "svg"})
      .each([&format = o.format_given](const std::string&) { format = true; });
  add_choice(*c, "--text", o.text, "an SVG's letters: outlines, or text in the reader's Inter",
             {"outlines", "text"});
  c->add_option("--tween", o.tween,
                "in-betweens after each frame but the last: <scenario>_0007_03.png is the third "
                "from frame 7 on; a film shows so many in the same time, and cuts at 0")
      ->check(CLI::Range(std::uint64_t{0}, std::uint64_t{1} << 53))
      ->type_name("N");
  c->add_option("--fps", o.fps,
                "as many in-betweens as a film of so many pictures a second has while something "
                "changes: half a second each, or the world's own time; of a film, its rate: 30, "
                "25 for a .gif")
      ->check(CLI::Range(1.0, 240.0))
      ->check(kFinite)
      ->type_name("F");
  c->add_option("--hold", o.hold,
                "how long a film stands still where nothing moves, seconds; the default is as long "
                "as it takes to read the caption")
      ->check(CLI::Range(0.0, 3600.0))
      ->check(kFinite)
      ->type_name("S");
  add_choice(*c, "--theme", o.theme, "colours", kThemes);
  c->add_option("--pace", o.pace, "one frame per step, or one for each thing the algorithm does")
      ->check(CLI::IsMember({"step", "event"}));
  add_choice(*c, "--png", o.png, "fast to write, or small", {"fast", "small"})
      .each([&png = o.png_given](const std::string&) { png = true; });
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
}

void render_options(CLI::App* c, RenderOptions& o) {
  add_drawing(c, o);
  add_shard(*c, o.shard);
  add_memory(*c);
  add_json(*c, o.json);
}

void watch_options(CLI::App* c, RenderOptions& o) {
  add_drawing(c, o);
  add_memory(*c);
  add_json(*c, o.json);
}

void merge_options(CLI::App* c, MergeOptions& o) {
  c->add_option("OUT", o.output, "folder of the whole")->required();
  c->add_option("IN", o.folders, "folders that shards wrote into with -o; the default is OUT");
  add_json(*c, o.json);
}

void check_options(CLI::App* c, CheckOptions& o) {
  c->add_option("FILE", o.files, kFilesHelp)->required();
  c->add_option("--pace", o.pace, "as for render")->check(CLI::IsMember({"step", "event"}));
  add_memory(*c);
  c->add_flag("--strict", o.strict, "turn warnings into errors (exit code 3)");
  add_json(*c, o.json);
}

void list_options(CLI::App* c, ListOptions& o) {
  c->add_option("DIR", o.folders, "folders or files; the default is scenarios");
  add_json(*c, o.json);
  c->add_flag("--course", o.course,
              "run them, and print the course as Markdown: ideas, what comes before, questions "
              "with their answers")
      ->excludes("--json");
}

void explain_options(CLI::App* c, ExplainOptions& o) {
  c->add_option("FILE", o.file, "scenario file; - is standard input")->required();
  add_memory(*c);
  add_json(*c, o.json);
}

void doctor_options(CLI::App* c, DoctorOptions& o) { add_json(*c, o.json); }

void add_allowance(CLI::App& c, int& tolerance, double& fraction) {
  c.add_option("--tolerance", tolerance, "by how many levels a channel may differ")
      ->check(CLI::Range(0, 255))
      ->capture_default_str();
  c.add_option("--fraction", fraction, "fraction of the pixels that may differ")
      ->check(CLI::Range(0.0, 1.0))
      ->check(kFinite)
      ->capture_default_str();
}

void structure_list_options(CLI::App* c, StructureListOptions& o) { add_json(*c, o.json); }

void structure_check_options(CLI::App* c, StructureCheckOptions& o) {
  c->add_option("NAME", o.names, "structures; the default is all of them");
  c->add_option("--worlds", o.worlds, "how many worlds")
      ->check(CLI::Range(1, 10'000'000))
      ->type_name("N")
      ->capture_default_str();
  add_seed(*c, o.seed, "of the random worlds");
  c->add_option("-o,--output", o.output, "folder for NAME_fails.toml")
      ->type_name("DIR")
      ->capture_default_str();
  add_json(*c, o.json);
}

void structure_bench_options(CLI::App* c, StructureBenchOptions& o) {
  c->add_option("NAME", o.names, "structures; the default is all of them");
  c->add_option("--bodies", o.bodies, "how many bodies; the default is 100, 400 and 1600")
      ->allow_extra_args(false)
      ->check(CLI::Range(2, 1'000'000))
      ->type_name("N");
  add_seed(*c, o.seed, "of the random worlds");
  c->add_option("--rounds", o.rounds, "repeats; the median counts")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  c->add_option("-o,--output", o.output, "folder for bench_structure.csv and .json")
      ->type_name("DIR");
  add_memory(*c);
  add_json(*c, o.json);
}

void add_structure(CLI::App* c, Run& run) {
  c->require_subcommand(1);
  add_command(*c, run, "list", "List the structures that this program knows",
              structure_list_command, structure_list_options);
  add_command(*c, run, "check",
              "Hold structures against brute force on random worlds; the smallest world on which "
              "one fails is told and written as a scenario",
              structure_check_command, structure_check_options);
  add_command(*c, run, "bench", "Time structures beside each other and brute force, in turns",
              structure_bench_command, structure_bench_options);
}

void compare_options(CLI::App* c, CompareOptions& o) {
  c->add_option("EXPECTED", o.expected, "picture, facts or folder")->required();
  c->add_option("ACTUAL", o.actual, "picture, facts or folder")->required();
  c->add_option("-o,--output", o.output,
                "where the difference picture goes (a folder when folders are compared)")
      ->type_name("PATH");
  add_allowance(*c, o.tolerance, o.fraction);
  add_json(*c, o.json);
}

void golden_options(CLI::App* c, GoldenOptions& o) {
  c->add_option("FILE", o.files, "scenario files")->required();
  CLI::Option* update =
      c->add_flag("--update", o.update, "make today's frames the golden ones: writes what changed");
  c->add_option("--dir", o.folder, "the golden frames are in DIR/<scenario>")
      ->type_name("DIR")
      ->capture_default_str();
  c->add_option("--report", o.report,
                "page of what differs, with pictures side by side: a file, or a folder for "
                "golden.html; without it output/golden.html, made only if something differs")
      ->excludes(update)
      ->type_name("PATH");
  c->add_option("--junit", o.junit, "findings as JUnit's XML, for whatever builds and tests")
      ->excludes(update)
      ->type_name("FILE");
  add_allowance(*c, o.tolerance, o.fraction);
  c->add_option("--size", o.size, "pixels")->type_name("WxH")->capture_default_str();
  add_choice(*c, "--theme", o.theme, "colours", kThemes);
  c->add_option("--pace", o.pace, "as for render")->check(CLI::IsMember({"step", "event"}));
  c->add_option("--frames", o.frames, "as for render")->type_name("A-B");
  c->add_option("--at", o.at, "as for render")->type_name("EVENT|TIME");
  add_choice(*c, "--backend", o.backend, "off-screen OpenGL", kBackends);
  add_memory(*c);
  add_json(*c, o.json);
}

// `help bench step` prints what `bench step --help` does.
void print_help(CLI::App& app, const std::vector<std::string>& words) {
  CLI::App* command = &app;
  std::string before;  // the words before the command's own name
  for (const std::string& word : words) {
    const auto next = complete_commands(*command, word);
    if (next.empty()) throw UsageError(no_command(*command, word));
    before += (before.empty() ? "" : " ") + command->get_name();
    command = next.front();
  }
  const std::string name = (before.empty() ? "" : before + " ") + command->get_name();
  print(command->get_formatter()->make_help(command, name, CLI::AppFormatMode::Normal));
}

void help_options(CLI::App* c, CLI::App& app, Run& run) {
  const auto words = std::make_shared<std::vector<std::string>>();
  c->add_option("COMMAND", *words, "its name, such as: bench step; without one, all commands");
  c->callback([&app, &run, words] {
    run = [&app, words] {
      print_help(app, *words);
      return int{kGood};
    };
  });
}

void reference_options(CLI::App* c, ReferenceOptions& o) {
  c->add_option("--pictures", o.pictures, "draw the page's pictures into this folder instead")
      ->type_name("DIR");
  add_choice(*c, "--backend", o.backend, "off-screen OpenGL", kBackends);
  add_json(*c, o.json);
}

void schema_options(CLI::App* c, Run& run) {
  const auto of = std::make_shared<std::string>("scenario");
  add_choice(*c, "--of", *of, "scenario files, or what commands print with --json",
             {"scenario", "output"});
  c->callback([&run, of] {
    run = [of] {
      write_stdout(*of == "output" ? std::string(output::output_schema_json) : json_schema());
      return int{kGood};
    };
  });
}

}  // namespace

std::span<const ExitMeaning> exit_codes() {
  static constexpr ExitMeaning kCodes[] = {
      {kGood, "good"},
      {kFailed, "failed"},
      {kUsage, "usage"},
      {kBadScenario, "scenario error"},
      {kNoBackend, "no graphics backend"},
      {kInterrupted, "interrupted"},
  };
  return kCodes;
}

void add_commands(CLI::App& app, Run& run) {
  app.description("Lantern renders lecture scenarios about spatial partitioning as pictures.");
  app.require_subcommand(1);
  app.set_version_flag("--version", std::string(kVersion));
  std::vector<std::string> codes;
  for (const ExitMeaning& exit : exit_codes())
    codes.push_back(fmt::format("{} {}", exit.code, exit.means));
  app.footer(fmt::format("Exit codes: {}.\nStart with: lantern render ghost_quadtree",
                         fmt::join(codes, ", ")));
  add_memory(app);
  add_manners(app);
  add_command(app, run, "render",
              "Draw a scenario's frames: pictures, films, documents, lesson pages", render_command,
              render_options);
  add_command(app, run, "watch", "Render scenarios again whenever they are saved", watch_command,
              watch_options);
  add_command(app, run, "merge", "Make one folder of the parts that --shard has made",
              merge_command, merge_options);
  add_command(app, run, "check", "Run scenarios without drawing, verify expectations",
              check_command, check_options);
  add_command(app, run, "list", "List the scenarios in a folder in the order of a lecture",
              list_command, list_options);
  add_command(app, run, "explain", "Run a scenario without pixels, tell what each stage did",
              explain_command, explain_options);
  add_command(app, run, "doctor", "Graphics backends found, and what to install", doctor_command,
              doctor_options);
  add_command(app, run, "golden",
              "Compare scenarios' pictures and facts with golden ones, or update those",
              golden_command, golden_options);
  add_command(app, run, "compare", "Compare two PNG, SVG or JSON files, or two folders of them",
              compare_command, compare_options);
  add_command(app, "structure", "The spatial structures, and those of your own: list, check, bench",
              [&run](CLI::App* c) { add_structure(c, run); });
  add_lab_commands(app, run);
  add_command(app, run, "reference", "Print the scenario language's reference page (Markdown)",
              reference_command, reference_options);
  add_command(app, "schema", "Print a JSON Schema",
              [&run](CLI::App* c) { schema_options(c, run); });
  add_manual_commands(app, run);
  add_command(app, "help", "Print the help of a command, as its --help does",
              [&app, &run](CLI::App* c) { help_options(c, app, run); });
}

}  // namespace lantern::app
