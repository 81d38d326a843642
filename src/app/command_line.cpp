#include "app/command_line.hpp"

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "app/commands.hpp"
#include "app/option_words.hpp"
#include "base/file.hpp"
#include "embedded/version.hpp"
#include "rooms.hpp"
#include "scenario/reference.hpp"

namespace lantern::app {
namespace {

void add_render(CLI::App& app, Run& run) {
  const auto [c, o] =
      command(app, run, "render",
              "Draw a scenario's frames: pictures, films, documents, lesson pages", render_command);
  c->add_option("FILE", o.files, "scenario files")->required();
  c->add_option(
       "-o,--output", o.output,
       "a folder, for DIR/<scenario>/<scenario>_0000.png ...; or a file, whose ending says "
       "what it becomes: .png .svg pictures, .mp4 .webm .gif .apng .webp a film, .pdf a "
       "document, .html a lesson page; {scenario}, {step} and {frame} in its name make "
       "several, of a film with {step} a clip a step; - writes one picture to standard output")
      ->check(kNotEmpty)
      ->type_name("PATH")
      ->capture_default_str();
  c->add_option("--sheet", o.sheet, "so many frames across and down a page, with -o x.pdf or x.png")
      ->check(kNotEmpty)
      ->type_name("CxR");
  c->add_option("--frames", o.frames, "only these frames: 7, 3-9, 3- or -9")
      ->check(kNotEmpty)
      ->type_name("A-B");
  c->add_option("--at", o.at,
                "only the frames of this event (a step's name, split, store, ...), or the first "
                "frame at or after this time in seconds")
      ->check(kNotEmpty)
      ->type_name("EVENT|TIME");
  c->add_option("--size", o.size, "pixels")->type_name("WxH")->capture_default_str();
  add_choice(*c, "--format", o.format, "file format in a folder", {"png", "svg"})
      .each([&format = o.format_given](const std::string&) { format = true; });
  c->add_option("--tween", o.tween,
                "in-betweens after each frame but the last: <scenario>_0007_03.png is the third "
                "from frame 7 on; a film shows so many in the same time, and cuts at 0")
      ->check(CLI::NonNegativeNumber)
      ->type_name("N");
  c->add_option("--fps", o.fps,
                "as many in-betweens as a film of so many pictures a second has while something "
                "changes: half a second each, or the world's own time; of a film, its rate: 30, "
                "25 for a .gif")
      ->check(CLI::Range(1.0, 240.0))
      ->type_name("F");
  c->add_option("--hold", o.hold,
                "how long a film stands still where nothing moves, seconds; the default is as long "
                "as it takes to read the caption")
      ->check(CLI::Range(0.0, 3600.0))
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

}  // namespace

void add_commands(CLI::App& app, Run& run) {
  app.description("Lantern renders lecture scenarios about spatial partitioning as pictures.");
  app.require_subcommand(1);
  app.set_version_flag("--version", std::string(kVersion));
  app.footer(
      "Exit codes: 0 good, 1 failed, 2 usage, 3 scenario error, 4 no graphics backend, "
      "130 interrupted.\nStart with: lantern render scenarios/ghost_quadtree.toml");
  add_memory(app);
  add_render(app, run);
  add_check(app, run);
  add_list(app, run);
  add_explain(app, run);
  add_doctor(app, run);
  add_compare(app, run);
  add_lab_commands(app, run);
  add_texts(app, run);
}

}  // namespace lantern::app
