#include <algorithm>
#include <tuple>

#include <fmt/format.h>

#include "app/commands/command.hpp"
#include "app/folders/kept_files.hpp"
#include "app/output/sinks.hpp"
#include "app/progress.hpp"
#include "app/terminal.hpp"
#include "base/file.hpp"
#include "base/json_writer.hpp"
#include "base/number.hpp"
#include "base/stop.hpp"
#include "publish/lesson.hpp"

namespace lantern::app {
namespace {

// `render` has one more.
Options watch_options(RenderOptions& o) {
  return {
      {"FILE", &o.files, kFilesHelp, {.required = true}},
      {"-o,--output", &o.output,
       "a folder, for DIR/<scenario>/<scenario>_0000.png ...; or a file, whose ending says "
       "what it becomes: .png .svg pictures, .mp4 .webm .gif .apng .webp a film, .pdf a "
       "document, .html a lesson page; {scenario}, {step} and {frame} in its name make "
       "several, of a film with {step} a clip a step; - writes one picture to standard output",
       OptionTraits{.value = "PATH"}},
      {"--sheet", &o.sheet,
       "so many pictures across and down a page, with -o x.pdf or x.png: one a step, but with "
       "--frames, --at or --pace event each frame; where letters would be too small, fewer",
       OptionTraits{.value = "CxR"}},
      {"--frames", &o.frames, "only these frames: 7, 3-9, 3- or -9", {.value = "A-B"}},
      {"--at", &o.at,
       "only the frames of this step or event (its name, split, store, ...; as one picture the "
       "step's last), or the first frame at or after this time in seconds",
       OptionTraits{.value = "EVENT|TIME"}},
      {"--size", &o.size, "pixels; the default is 1600x900, of a sheet its --paper",
       OptionTraits{.value = "WxH"}},
      {"--paper", &o.paper, "of a sheet, upright or lying as its pictures get larger",
       OptionTraits{.words = {"a4", "letter"}, .without = "--size"}},
      {"--letters", &o.letters,
       "the smallest letters on paper; the default is 6pt on a sheet, 8pt of a figure",
       OptionTraits{.value = "LENGTH"}},
      {"--width", &o.width,
       "of a figure on paper, 8cm: pictures are laid out anew for it, with letters of 8 pt, as "
       "high as their panels want, and cut to what is drawn; into .pdf, .svg or .png",
       OptionTraits{.value = "LENGTH", .without = "--size,--sheet"}},
      {"--panel", &o.panel, "of a figure this panel alone: world, tree, chart, ...",
       OptionTraits{.value = "NAME", .without = "--size,--sheet"}},
      {"--dpi", &o.dpi,
       "pixels to the inch: how large a PDF's page is, and a PNG on paper; the default of a figure "
       "is 300",
       OptionTraits{.value = "N", .least = 72, .most = 1200, .given = &o.dpi_given}},
      {"--format", &o.format, "file format in a folder",
       OptionTraits{.words = {"png", "svg"}, .given = &o.format_given}},
      {"--text", &o.text, "an SVG's letters: outlines, or text in the reader's Inter",
       OptionTraits{.words = {"outlines", "text"}}},
      {"--tween", &o.tween,
       "in-betweens after each frame but the last: <scenario>_0007_03.png is the third "
       "from frame 7 on; a film shows so many in the same time, and cuts at 0",
       OptionTraits{.value = "N", .most = 0x1p53}},
      {"--fps", &o.fps,
       "as many in-betweens as a film of so many pictures a second has while something changes: "
       "half a second each, or the world's own time; of a film, its rate: 30, 25 for a .gif",
       OptionTraits{.value = "F", .least = 1, .most = 240}},
      {"--hold", &o.hold,
       "how long a film stands still where nothing moves, seconds; the default is as long "
       "as it takes to read the caption",
       OptionTraits{.value = "S", .most = 3600}},
      {"--length", &o.length,
       "how long a film is, seconds: its stills stand as much longer or shorter",
       OptionTraits{.value = "S", .least = 0.1, .most = 36000, .without = "--hold"}},
      {"--title", &o.title,
       "of the page that lists the lessons of a folder; the default is its own",
       OptionTraits{.value = "WORDS"}},
      {"--theme", &o.theme, "colours", {.words = kThemes}},
      pace_option(o.pace, "one frame per step, or one for each thing the algorithm does"),
      {"--png", &o.png, "fast to write, or small",
       OptionTraits{.words = {"fast", "small"}, .given = &o.png_given}},
      backend_option(o.backend),
      {"--transparent", &o.transparent, "draw no background: paper stays white"},
      {"--no-title", &o.no_title, "leave out the line above"},
      {"--no-caption", &o.no_caption, "leave out the caption below"},
      {"--no-counters", &o.no_counters, "leave out the numbers beside the caption"},
      {"--legend", &o.legend, "say what the marks on each frame mean"},
      {"--live", &o.live,
       "a lesson page carries the engine: drag what it shows, change its text; --frames and --at "
       "choose what is recorded, the engine shows the whole scenario"},
      engine_option(o.engine),
      {"--strict", &o.strict, "turn warnings into errors (exit code 3)"},
      {"-j,--threads", &o.threads, "encoding threads; the default is one per core",
       OptionTraits{.value = "N", .least = 1, .most = 256}},
      language_option(),
      words_option(),
      memory_option(),
      json_option(o.json)};
}

Options render_options(RenderOptions& o) {
  Options options = watch_options(o);
  options.insert(options.end() - 2,
                 {"--shard", &o.shard,
                  "only the I-th of N parts, into DIR/shard-I-of-N; 'lantern merge' makes one of "
                  "them",
                  OptionTraits{.value = "I/N"}});
  return options;
}

// All scenarios that can be read; what is wrong with the others is said at once.
std::vector<Scenario> load_all(const std::vector<std::string>& files, int& code) {
  std::vector<Scenario> scenarios;
  std::set<std::string> names;
  for (const std::string& file : files) {
    auto scenario = load_or_complain(file, code);
    if (!scenario) continue;
    const Scenario& s = scenarios.emplace_back(std::move(*scenario));
    if (!names.insert(s.name).second)
      throw UsageError(
          "two of the files are scenarios named '{}'; they would overwrite each other's frames",
          s.name);
  }
  return scenarios;
}

// What came of the frames of one scenario, for a program and for a person.
void tell_of(const FolderMade& made, const Scenario& scenario, const DirectorReport& report,
             JsonWriter& json) {
  const std::string folder = made.path.string();
  json.line().object("scenario", scenario.name, "folder", folder, "drawn", made.drawn, "kept",
                     made.kept, "in_betweens", made.in_betweens, "expectations",
                     report.expectations, "unmet", report.unmet.count());
  say(fmt::format("{}: {}{} in {}{}", scenario.name, counted(made.drawn + made.kept, "frame"),
                  made.in_betweens > 0 ? " and " + counted(made.in_betweens, "in-between") : "",
                  folder, made.kept ? fmt::format(", {} of them there already", made.kept) : ""));
}

// The same of files that the user named.
void tell_of(const FileSink::Made& made, const Scenario& scenario, const DirectorReport& report,
             JsonWriter& json) {
  json.line().begin_object().member("scenario", scenario.name).key("files").begin_array();
  for (const auto& file : made.files) json.value(file.string());
  json.end_array().members("frames", made.frames, "expectations", report.expectations, "unmet",
                           report.unmet.count());
  if (made.seconds) json.members("seconds", *made.seconds, "fps", made.rate);
  json.end_object();
  const std::string where =
      made.files.size() == 1 ? made.files.front().string()
                             : fmt::format("{} files, {} to {}", made.files.size(),
                                           made.files.front().string(), made.files.back().string());
  const std::string length =
      made.seconds ? fmt::format(", {:.1f} s at {:.4g} pictures a second", *made.seconds, made.rate)
                   : "";
  say(fmt::format("{}: {} in {}{}", scenario.name, counted(made.frames, "frame"), where, length));
}

// In which lessons follow each other: as they were named; but in the order of the lecture, if they
// were named by the alphabet, as a * of the shell does it.
struct Course {
  std::vector<const Scenario*> lessons;
  bool is_asked = false;  // it is another order than that of the lecture

  const Scenario* after(const Scenario& one) const {
    const auto place = std::ranges::find(lessons, &one);
    return place == lessons.end() || place + 1 == lessons.end() ? nullptr : place[1];
  }
};

Course course_of(const std::vector<Scenario>& scenarios) {
  Course course;
  for (const Scenario& one : scenarios) course.lessons.push_back(&one);
  auto taught = course.lessons;
  std::ranges::sort(taught, {}, [](const Scenario* one) {
    return std::tuple(!one->lecture, one->lecture, one->name);
  });
  course.is_asked =
      taught != course.lessons && !std::ranges::is_sorted(scenarios, {}, &Scenario::name);
  if (!course.is_asked) course.lessons = std::move(taught);
  return course;
}

// Of the lesson pages that stand in one folder, a file a scenario, a page that lists them.
void list_lessons(const Destination& to, const Course& course, const std::string& title) {
  if (to.kind() != OutputKind::page || !to.is_a_folder_of_scenarios()) return;
  const auto folder = to.file({}).parent_path();
  const auto index = folder / "index.html";
  std::vector<std::string> order;
  if (course.is_asked)
    for (const Scenario* one : course.lessons)
      order.push_back(to.file({one->name}).filename().string());
  const bool written = publish::write_lesson_index(Folder(folder), order, title);
  say(written ? fmt::format("all lessons there are listed in {}", index.string())
              : fmt::format("{} is not of this kind and was left alone", index.string()));
}

// When all scenarios are in it.
void write_shared(PaperForAll& paper, Work& work) {
  const std::string bytes = paper.pdf->finish();
  write_file(*paper.place, bytes);
  paper.place->folder.settle();
  work.bytes_written += bytes.size();
}

// Draws scenario `index`, or the shard's part of it; the exit code that it deserves.
int render_one(const RenderJob& its, const Destination& to, const Scenario& scenario, Work& work,
               JsonWriter& json, RenderShard& shard, std::size_t index, PaperForAll* paper,
               const Scenario* next) {
  const RenderOptions& options = its.options;
  const bool is_sheet = to.kind() == OutputKind::sheet;
  const Pace pace = is_sheet && options.pace.empty() ? Pace::step : pace_of(options.pace, scenario);
  const bool many = to.kind() == OutputKind::folder || to.is_by("frame") ||
                    to.kind() == OutputKind::film || to.kind() == OutputKind::page;
  Selection selection(options.frames, options.at, extent_of(scenario, pace).frames, many);
  std::optional<RenderJob> figure;  // each scenario's are of their own size
  if (options.is_figure()) {
    figure.emplace(options);
    lay_out_figure({*figure, to, scenario, pace, selection, work}, *figure);
  }
  const RenderJob& job = figure ? *figure : its;
  const Sequence sequence{job, to, scenario, pace, selection, work, paper, next};
  if (to.kind() != OutputKind::folder) {
    const auto sink = make_file_sink(sequence);
    const RunResult result = run_scenario(scenario, pace, *sink, work, selection.most());
    const int code = tell(result, options.strict);
    if (to.is_file()) tell_of(sink->made(), scenario, result.report, json);
    return code;
  }
  const auto most = selection.most() ? selection.most() : extent_of(scenario, pace).frames;
  job.in_betweens.require_few(most);
  const Part& part = shard.part(index);
  if (part.is_none()) return kGood;
  FolderMade made;
  const auto sink = make_folder_sink(sequence, part, made);
  const auto of_part = part.is_all() || !most ? selection.most() : std::optional(part.count(*most));
  const RunResult result =
      run_scenario(scenario, pace, *sink, work, of_part, job.in_betweens.most());
  shard.drawn(index, made.drawn + made.kept, made.chosen, made.has_atlas);
  const int code = tell(result, options.strict);
  tell_of(made, scenario, result.report, json);
  return code;
}

// Throws UsageError if what else the command line asks for does not go with where it shall go.
void require_fit(const RenderOptions& options, const Destination& to, std::size_t files) {
  const OutputKind kind = to.kind();
  const bool is_folder = kind == OutputKind::folder, is_film = kind == OutputKind::film;
  const bool is_stdout = kind == OutputKind::standard_output;
  const auto refuse = [&](const std::string& why) {
    throw UsageError("-o {}: {}", options.output, why);
  };
  if (is_stdout && files != 1) refuse("writes one frame of one scenario");
  if (is_stdout && options.json)
    refuse(
        "writes a picture to standard output, where --json writes, too; name a file after -o, or "
        "leave out --json");
  if (!is_folder && files > 1 && !to.is_by("scenario") && !to.is_one_document())
    refuse(fmt::format("a file for each of {} scenarios; write {{scenario}} in it", files));
  if (is_folder && options.tween && options.fps)
    refuse("--tween and --fps both say how many in-betweens; give one of them");
  if ((is_stdout || kind == OutputKind::picture) && (options.tween || options.fps))
    refuse("in-betweens (--tween, --fps) need a folder or a film");
  if (options.live && kind != OutputKind::page)
    refuse("only a lesson page is live (--live), such as lesson.html");
  if (!options.engine.empty() && !options.live) refuse("no page is live; leave out --engine");
  if (options.is_figure() && kind != OutputKind::document && kind != OutputKind::picture &&
      !is_stdout)
    refuse("figures (--width, --letters, --panel) are .pdf, .svg or .png");
  if ((options.hold || options.length) && !is_film)
    refuse("only a film is held or has a length (--hold, --length), such as talk.mp4");
  if (!options.title.empty() && !(kind == OutputKind::page && to.is_a_folder_of_scenarios()))
    refuse("only a list of lessons has a title (--title): 'lessons/{scenario}.html'");
  if (is_folder || is_stdout) return;
  if (options.format_given && options.format != to.ending())
    refuse(fmt::format("the ending says what it becomes; leave out --format {}", options.format));
  if (options.png_given && to.ending() != "png")
    refuse(fmt::format("no PNG; leave out --png {}", options.png));
}

}  // namespace

int draw_scenarios(const RenderOptions& asked) {
  RenderOptions options = options_of_shard(asked);
  const Destination to(options.output, !options.sheet.empty());
  const std::vector<std::string> files = input_files(options.files);
  require_fit(options, to, files.size());
  if (to.kind() == OutputKind::picture) options.format = to.ending();
  const RenderJob job(options);
  int code = kGood;
  const std::vector<Scenario> scenarios = load_all(files, code);
  // Of names that only the run can tell, each is looked at before its file is written.
  if (to.is_file() && !to.is_by("step") && !to.is_by("frame"))
    for (const Scenario& scenario : scenarios) require_free(to.file({scenario.name}));
  Work work;
  JsonWriter json = answer_of("render");
  json.line().key("scenarios").begin_array();
  RenderShard shard(job, scenarios);
  const Course course = course_of(scenarios);
  PaperForAll paper;
  PaperForAll* const shared = files.size() > 1 && to.is_one_document() ? &paper : nullptr;
  bool whole = scenarios.size() == files.size();
  for (std::size_t i = 0; i < scenarios.size(); ++i) {
    try {
      code = std::max(
          code, render_one(job, to, scenarios[i], work, json, shard, i, shared,
                           to.is_a_folder_of_scenarios() ? course.after(scenarios[i]) : nullptr));
    } catch (const ScenarioError& e) {
      complain(e);
      code = std::max(code, exit_code_of(e));
      whole = false;
    } catch (const Stopped&) {
      complain(to.kind() == OutputKind::folder
                   ? "interrupted; the same command goes on where this one stopped"
                   : "interrupted");
      return kInterrupted;
    }
  }
  if (whole) shard.finish();
  if (whole && shared) write_shared(paper, work);
  list_lessons(to, course, options.title);
  json.line().end_array().line().key("work");
  write(json, work);
  json.line().end_object();
  if (options.json) answer(json.text());
  return code;
}

std::vector<Command> drawing_commands() {
  return {command("render", "Draw a scenario's frames: pictures, films, documents, lesson pages",
                  draw_scenarios, render_options),
          command("watch", "Render scenarios again whenever they are saved", watch_scenarios,
                  watch_options)};
}

}  // namespace lantern::app
