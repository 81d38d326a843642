#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <thread>

#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/frame_folder.hpp"
#include "app/manifest.hpp"
#include "app/progress.hpp"
#include "app/selection.hpp"
#include "app/terminal.hpp"
#include "app/warned.hpp"
#include "atlas/atlas.hpp"
#include "base/file.hpp"
#include "base/json_writer.hpp"
#include "base/memory.hpp"
#include "base/stop.hpp"
#include "draw/in_sight.hpp"
#include "draw/page.hpp"
#include "embedded/version.hpp"
#include "render/pipeline.hpp"
#include "render/svg.hpp"
#include "scenario/director.hpp"
#include "scenario/warnings.hpp"

namespace lantern {
namespace {

namespace fs = std::filesystem;

// 160 pixels to the inch, so that a frame of 1600 pixels is 10 inches wide in a document.
constexpr int kPixelsPerMetre = 6299;

// What the command line asks for, read once.
struct RenderJob {
  const RenderOptions& options;
  int width = 0;
  int height = 0;
  Theme theme;
  PngEffort effort = PngEffort::fast;
  Backend backend = Backend::automatic;
  int threads = 1;

  bool svg() const { return options.format == "svg"; }
  bool to_stdout() const { return options.output == "-"; }
};

RenderJob job_of(const RenderOptions& o) {
  RenderJob job{o,        0, 0, *theme_named(o.theme), PngEffort::fast, *backend_named(o.backend),
                o.threads};
  std::tie(job.width, job.height) = parse_size(o.size, Renderer::kMostPixels);
  if (o.png == "small") job.effort = PngEffort::small;
  if (job.threads == 0)
    job.threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  return job;
}

Pace pace_of(const RenderJob& job, const Scenario& scenario) {
  if (job.options.pace.empty()) return scenario.pace;
  return job.options.pace == "event" ? Pace::event : Pace::step;
}

std::vector<PngText> texts_of(const Frame& frame) {
  return {{"Title", frame.title},
          {"Software", fmt::format("Lantern {}", kVersion)},
          {"Scenario", frame.scenario},
          {"Frame", fmt::format("{}", frame.index)},
          {"Seed", fmt::format("{}", frame.seed)}};
}

Manifest manifest_of(const RenderJob& job, const Scenario& scenario, Pace pace) {
  Manifest m;
  m.scenario = scenario.name;
  m.title = scenario.title;
  m.seed = scenario.seed;
  m.pace = pace == Pace::event ? "event" : "step";
  m.size = fmt::format("{}x{}", job.width, job.height);
  m.theme = job.options.theme;
  m.format = job.options.format;
  m.png = job.options.png;
  m.transparent = job.options.transparent;
  m.scenario_hash = scenario.text_hash;
  return m;
}

// The facts of a frame are the same whatever is drawn of it.
std::string facts_of(const Frame& frame, const MadeFrom& from) {
  return sealed(FileKind::json, to_json(frame), {from.facts, from.facts});
}

std::string svg_of(const RenderJob& job, const DrawList& list, int width, int height,
                   bool transparent, const MadeFrom& from) {
  return sealed(FileKind::svg, to_svg(list, job.theme, transparent, width, height), from);
}

std::string png_of(const RenderJob& job, const DrawList& list, int width, int height,
                   bool transparent, int pixels_per_metre, const Frame& frame, const MadeFrom& from,
                   Work& work) {
  Renderer renderer(Context::create(job.backend), width, height);
  ++work.graphics_contexts;
  Image image;
  renderer.draw(list, job.theme, transparent, image);
  ++work.frames_drawn;
  ++work.frames_encoded;
  return sealed(FileKind::png, encode_png(image, job.effort, texts_of(frame), pixels_per_metre),
                from);
}

// --- one frame to standard output ---

DirectorReport draw_to_stdout(const RenderJob& job, const Scenario& scenario, Pace pace,
                              Selection& selection, RunWatch& watch, Work& work) {
  const Manifest manifest = manifest_of(job, scenario, pace);
  std::size_t chosen = 0;
  std::string bytes;
  const auto draw = [&](const Frame& frame) {
    if (!selection.takes(frame) || ++chosen > 1) return true;
    const DrawList list = draw_frame(frame, page_for(job.width, job.height), work);
    const MadeFrom from = manifest.frame_from(frame.index);
    const bool transparent = job.options.transparent;
    bytes = job.svg() ? svg_of(job, list, job.width, job.height, transparent, from)
                      : png_of(job, list, job.width, job.height, transparent, kPixelsPerMetre,
                               frame, from, work);
    return true;
  };
  Progress progress(scenario.name, extent_of(scenario, pace), work, memory_budget());
  const DirectorReport report = direct(scenario, pace, work, draw, &watch);
  selection.require_some();
  if (chosen != 1)
    throw UsageError(fmt::format(
        "-o - writes one frame, but {} are chosen; pick one with --frames or --at", chosen));
  write_stdout(bytes);
  return report;
}

// --- a folder of frames ---

// Where each texture lies in the image of the finished atlas.
std::string atlas_facts(const RenderJob& job, const Frame& frame, const DrawList& list) {
  JsonWriter json;
  json.begin_object().line().member("format", "lantern.atlas/1");
  json.line().member("image", frame.scenario + "_atlas." + job.options.format);
  json.line().key("size").begin_array();
  json.value(static_cast<int>(list.page.x)).value(static_cast<int>(list.page.y)).end_array();
  json.line().key("textures").begin_array();
  for (const FrameTexture& t : frame.textures) {
    if (!t.packed) continue;
    json.line().begin_object().member("name", t.name).member("x", t.x).member("y", t.y);
    json.member("width", t.width).member("height", t.height).end_object();
  }
  json.line().end_array().line().key("refused").begin_array();
  for (const FrameTexture& t : frame.textures)
    if (t.refused) json.value(t.name);
  json.end_array().line().end_object();
  return json.text() + "\n";
}

// Renders the chosen frames of one scenario into DIR/<scenario>/, in one run of the scenario: each
// is drawn when it comes by, unless its picture stands there already.
class FolderRun {
 public:
  FolderRun(const RenderJob& job, const Scenario& scenario, Pace pace, Selection& selection,
            Work& work)
      : job_(job),
        scenario_(scenario),
        pace_(pace),
        selection_(selection),
        manifest_(manifest_of(job, scenario, pace)),
        path_(fs::path(job.options.output) / scenario.name),
        work_(work) {}

  // Throws UsageError, and leaves the disk as it was, if no frame is chosen.
  DirectorReport run(RunWatch& watch) {
    RunExtent extent = extent_of(scenario_, pace_);
    extent.chosen = selection_.most();
    Progress progress(scenario_.name, extent, work_, memory_budget());
    const DirectorReport report = direct(
        scenario_, pace_, work_,
        [&](const Frame& frame) {
          stop_if_asked();
          all_.push_back({frame.step, frame.event, frame.time, frame.caption, frame.hash});
          if (selection_.takes(frame)) take(frame);
          if (scenario_.atlas) last_ = frame;
          progress.done(all_.size());
          return true;
        },
        &watch);
    selection_.require_some();
    if (pipeline_) pipeline_->finish();
    list_frames();
    if (last_ && manifest_.frames.size() == all_.size()) write_atlas(*last_);
    tell_of_strange_files();
    manifest_.finished = true;
    manifest_.expectations = report.expectations;
    manifest_.unmet = report.unmet.size();
    write_manifest();
    make_durable(path_);  // before anybody is told that it is finished
    return report;
  }

  std::size_t drawn() const { return drawn_; }
  std::size_t kept() const { return kept_; }
  const fs::path& path() const { return path_; }

 private:
  // Only when there is a frame for it.
  void open_folder() {
    folder_.emplace(path_, manifest_, selection_.takes_all());
    if (!folder_->removed().empty())
      say(fmt::format("{}: removed what an earlier run has left: {}", scenario_.name,
                      some_of(folder_->removed())));
    write_manifest();
  }

  void take(const Frame& frame) {
    if (!folder_) open_folder();
    const std::uint32_t index = frame.index;
    taken_.insert(index);
    const MadeFrom from = manifest_.frame_from(index);
    if (!folder_->stands(index, "json"))
      write_counted(folder_->file(index, "json"), facts_of(frame, from));
    if (folder_->stands(index, job_.options.format)) {
      ++kept_;
      return;
    }
    const DrawList list = draw_frame(frame, page_for(job_.width, job_.height), work_);
    const fs::path file = folder_->file(index, job_.options.format);
    if (job_.svg()) {
      write_counted(file,
                    svg_of(job_, list, job_.width, job_.height, job_.options.transparent, from));
      ++work_.frames_written;
    } else {
      pipeline().submit(list, texts_of(frame), file, from);
      written_.insert(file.filename().string());
    }
    ++drawn_;
  }

  void write_counted(const fs::path& file, const std::string& bytes) {
    write_file(file, bytes);
    written_.insert(file.filename().string());
    work_.bytes_written += bytes.size();
  }

  void tell_of_strange_files() const {
    std::vector<std::string> left, replaced;
    for (const std::string& name : folder_->strange())
      (written_.contains(name) ? replaced : left).push_back(name);
    if (!left.empty())
      say(fmt::format("{}: left alone, since it is not as Lantern made it: {}", scenario_.name,
                      some_of(left)));
    if (!replaced.empty())
      say(fmt::format("{}: replaced, though it was not as Lantern made it: {}", scenario_.name,
                      some_of(replaced)));
  }

  // Made when there is something to draw.
  Pipeline& pipeline() {
    if (pipeline_) return *pipeline_;
    Pipeline::Config config;
    config.width = job_.width;
    config.height = job_.height;
    config.theme = job_.theme;
    config.transparent = job_.options.transparent;
    config.effort = job_.effort;
    config.pixels_per_metre = kPixelsPerMetre;
    config.threads = job_.threads;
    try {
      pipeline_ = std::make_unique<Pipeline>(Context::create(job_.backend), config, work_);
    } catch (const Refused& too_large) {  // by the command line, not by the scenario
      throw UsageError(too_large.what());
    }
    return *pipeline_;
  }

  // Those of this run, and those of earlier ranges that still stand.
  void list_frames() {
    for (std::uint32_t i = 0; i < all_.size(); ++i)
      if (taken_.contains(i) ||
          (folder_->stands(i, job_.options.format) && folder_->stands(i, "json")))
        manifest_.frames.emplace(i, std::move(all_[i]));
  }

  // Transparent, in its own size, as soon as all frames are there.
  void write_atlas(const Frame& frame) {
    const DrawList list = draw_atlas_image(frame);
    const int width = static_cast<int>(list.page.x), height = static_cast<int>(list.page.y);
    const MadeFrom from = manifest_.atlas_from();
    const std::string& format = job_.options.format;
    if (!folder_->atlas_stands(format))
      write_counted(folder_->atlas(format),
                    job_.svg() ? svg_of(job_, list, width, height, true, from)
                               : png_of(job_, list, width, height, true, 0, frame, from, work_));
    if (!folder_->atlas_stands("json"))
      write_counted(folder_->atlas("json"),
                    sealed(FileKind::json, atlas_facts(job_, frame, list), from));
  }

  void write_manifest() { write_file(path_ / "manifest.json", to_json(manifest_)); }

  // "a.png, b.png and 17 more"
  static std::string some_of(const std::vector<std::string>& names) {
    constexpr std::size_t kMost = 5;
    std::string text;
    for (std::size_t i = 0; i < std::min(names.size(), kMost); ++i)
      text += (i > 0 ? ", " : "") + names[i];
    if (names.size() > kMost) text += fmt::format(" and {} more", names.size() - kMost);
    return text;
  }

  const RenderJob& job_;
  const Scenario& scenario_;
  Pace pace_;
  Selection& selection_;
  Manifest manifest_;
  fs::path path_;
  Work& work_;
  std::optional<FrameFolder> folder_;
  std::unique_ptr<Pipeline> pipeline_;
  std::vector<ListedFrame> all_;   // of the run so far
  std::set<std::uint32_t> taken_;  // of these, chosen
  std::set<std::string> written_;  // names of files
  std::size_t drawn_ = 0, kept_ = 0;
  std::optional<Frame> last_;  // of an atlas
};

// --- the command ---

// All scenarios that can be read; what is wrong with the others is said at once.
std::vector<Scenario> load_all(const std::vector<std::string>& files, int& code) {
  std::vector<Scenario> scenarios;
  std::set<std::string> names;
  for (const std::string& file : files) {
    try {
      scenarios.push_back(load_scenario(file));
    } catch (const ScenarioError& e) {
      complain(e);
      code = std::max<int>(code, kBadScenario);
      continue;
    } catch (const IoError& e) {
      complain(e.what());
      code = std::max<int>(code, kFailed);
      continue;
    }
    const Scenario& s = scenarios.back();
    if (!names.insert(s.name).second)
      throw UsageError(
          fmt::format("two of the files are scenarios named '{}'; they would "
                      "overwrite each other's frames",
                      s.name));
  }
  return scenarios;
}

// Draws one scenario; the exit code that it deserves.
int render_one(const RenderJob& job, const Scenario& scenario, Work& work, JsonWriter& json) {
  const Pace pace = pace_of(job, scenario);
  Selection selection(job.options.frames, job.options.at, extent_of(scenario, pace).frames);
  std::optional<FolderRun> run;
  if (!job.to_stdout()) run.emplace(job, scenario, pace, selection, work);
  RunWatch watch(scenario, shows_a_body);
  const DirectorReport report =
      run ? run->run(watch) : draw_to_stdout(job, scenario, pace, selection, watch, work);
  complain(report.unmet);
  const int code = std::max<int>(report.unmet.empty() ? kGood : kFailed,
                                 tell_warnings(watch.warnings(), job.options.strict));
  if (!run) return code;
  json.line().begin_object().member("scenario", scenario.name);
  json.member("folder", run->path().string()).member("drawn", run->drawn());
  json.member("kept", run->kept()).member("expectations", report.expectations);
  json.member("unmet", report.unmet.size()).end_object();
  say(fmt::format("{}: {} frames in {}{}", scenario.name, run->drawn() + run->kept(),
                  run->path().string(),
                  run->kept() ? fmt::format(", {} of them there already", run->kept()) : ""));
  return code;
}

}  // namespace

int render_command(const RenderOptions& options) {
  const RenderJob job = job_of(options);
  if (job.to_stdout() && options.files.size() != 1)
    throw UsageError("-o - writes one frame of one scenario");
  int code = kGood;
  const std::vector<Scenario> scenarios = load_all(options.files, code);
  Work work;
  JsonWriter json;
  json.begin_object().key("scenarios").begin_array();
  for (const Scenario& scenario : scenarios) {
    try {
      code = std::max(code, render_one(job, scenario, work, json));
    } catch (const ScenarioError& e) {
      complain(e);
      code = std::max<int>(code, kBadScenario);
    } catch (const Stopped&) {
      say("interrupted; the same command goes on where this one stopped");
      return kInterrupted;
    }
  }
  json.line().end_array().line().key("work").begin_object();
  for (const auto& [stage, count] : work.listed()) json.member(stage, count);
  json.end_object().line().end_object();
  if (options.json && !job.to_stdout()) write_stdout(json.text() + "\n");
  return code;
}

}  // namespace lantern
