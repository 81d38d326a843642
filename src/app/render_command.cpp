#include <algorithm>
#include <filesystem>
#include <memory>
#include <set>
#include <thread>

#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/manifest.hpp"
#include "app/selection.hpp"
#include "app/terminal.hpp"
#include "atlas/atlas.hpp"
#include "base/file.hpp"
#include "base/json_writer.hpp"
#include "draw/page.hpp"
#include "embedded/version.hpp"
#include "render/pipeline.hpp"
#include "render/svg.hpp"
#include "scenario/director.hpp"

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

// The run without pixels: which frames there are, and whether the expectations hold.
struct Rehearsal {
  std::vector<PlannedFrame> plan;
  DirectorReport report;
};

Rehearsal rehearse(const Scenario& scenario, Pace pace) {
  Rehearsal r;
  Work unseen;  // the same work again: counted once, in the run that draws
  r.report = direct(scenario, pace, unseen, [&](const Frame& f) {
    r.plan.push_back({f.index, f.step, f.event, f.time, f.caption, f.hash});
    return !interrupted();
  });
  return r;
}

std::vector<PngText> texts_of(const Frame& frame) {
  return {{"Title", frame.title},
          {"Software", fmt::format("Lantern {}", kVersion)},
          {"Scenario", frame.scenario},
          {"Frame", fmt::format("{}", frame.index)},
          {"Seed", fmt::format("{}", frame.seed)}};
}

// --- one frame to standard output ---

void draw_to_stdout(const RenderJob& job, const Scenario& scenario, Pace pace, std::uint32_t index,
                    Work& work) {
  std::string bytes;
  direct(scenario, pace, work, [&](const Frame& frame) {
    if (frame.index != index) return true;
    const DrawList list = draw_frame(frame, page_for(job.width, job.height), work);
    if (job.svg()) {
      bytes = to_svg(list, job.theme, job.options.transparent, job.width, job.height);
    } else {
      Renderer renderer(Context::create(job.backend), job.width, job.height);
      ++work.graphics_contexts;
      Image image;
      renderer.draw(list, job.theme, job.options.transparent, image);
      bytes = encode_png(image, job.effort, texts_of(frame), kPixelsPerMetre);
      ++work.frames_drawn;
      ++work.frames_encoded;
    }
    return false;
  });
  write_stdout(bytes);
}

// --- a folder of frames ---

// The finished atlas as an image of its own, and where each texture lies in it.
void write_atlas(const RenderJob& job, const Frame& frame, const fs::path& folder, Work& work) {
  const fs::path stem = folder / (frame.scenario + "_atlas");
  const DrawList list = draw_atlas_image(frame);
  const int width = static_cast<int>(list.page.x);
  const int height = static_cast<int>(list.page.y);
  if (job.svg()) {
    write_file(stem.string() + ".svg", to_svg(list, job.theme, true, width, height));
  } else {
    Renderer renderer(Context::create(job.backend), width, height);
    ++work.graphics_contexts;
    Image image;
    renderer.draw(list, job.theme, true, image);
    write_file(stem.string() + ".png", encode_png(image, job.effort, texts_of(frame), 0));
  }
  JsonWriter json;
  json.begin_object().line().member("format", "lantern.atlas/1");
  json.line().member("image", frame.scenario + "_atlas." + job.options.format);
  json.line().key("size").begin_array().value(width).value(height).end_array();
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
  write_file(stem.string() + ".json", json.text() + "\n");
}

// Renders the chosen frames of one scenario into DIR/<scenario>/.
class FolderRun {
 public:
  FolderRun(const RenderJob& job, const Scenario& scenario, const Rehearsal& rehearsal, Work& work)
      : job_(job),
        scenario_(scenario),
        pace_(pace_of(job, scenario)),
        plan_(rehearsal.plan),
        chosen_(select_frames(plan_, job.options.frames, job.options.at)),
        folder_(fs::path(job.options.output) / scenario.name),
        work_(work) {
    manifest_.scenario = scenario.name;
    manifest_.title = scenario.title;
    manifest_.seed = scenario.seed;
    manifest_.pace = pace_ == Pace::event ? "event" : "step";
    manifest_.size = fmt::format("{}x{}", job.width, job.height);
    manifest_.theme = job.options.theme;
    manifest_.format = job.options.format;
    manifest_.png = job.options.png;
    manifest_.transparent = job.options.transparent;
    manifest_.scenario_hash = fmt::format("{:016x}", scenario.text_hash);
    manifest_.expectations = rehearsal.report.expectations;
    manifest_.unmet = rehearsal.report.unmet.size();
  }

  // True when every chosen frame is there; false when interrupted.
  bool run() {
    make_folder(folder_);
    remove_leftovers(folder_);
    take_over_old_frames();
    write_file(folder_ / "manifest.json", to_json(manifest_));
    if (!to_draw_.empty()) draw();
    if (interrupted()) return false;
    for (const std::uint32_t index : to_draw_) manifest_.frames[index] = plan_[index];
    manifest_.finished = true;
    write_file(folder_ / "manifest.json", to_json(manifest_));
    remove_stale_frames();
    return true;
  }

  std::size_t drawn() const { return to_draw_.size(); }
  std::size_t kept() const { return chosen_.size() - to_draw_.size(); }
  const fs::path& folder() const { return folder_; }

 private:
  fs::path file(std::uint32_t index, const std::string& ending) const {
    return folder_ / frame_file(scenario_.name, index, ending);
  }

  bool stands(std::uint32_t index) const {
    std::error_code error;
    return fs::is_regular_file(file(index, job_.options.format), error) &&
           fs::is_regular_file(file(index, "json"), error);
  }

  // Frames of the same pictures stay listed; those of a run that was cut off are not drawn again.
  void take_over_old_frames() {
    old_ = read_manifest(folder_ / "manifest.json");
    const bool same = old_ && old_->key == manifest_.key();
    if (same)
      for (const std::uint32_t index : old_->frames)
        if (index < plan_.size() && stands(index)) manifest_.frames[index] = plan_[index];
    for (const std::uint32_t index : chosen_)
      if (same && !old_->finished && stands(index))
        manifest_.frames[index] = plan_[index];
      else
        to_draw_.push_back(index);
  }

  void draw() {
    Progress progress(scenario_.name, to_draw_.size());
    std::unique_ptr<Pipeline> pipeline;
    std::uint64_t count = 0;
    if (!job_.svg()) {
      Pipeline::Config config;
      config.width = job_.width;
      config.height = job_.height;
      config.theme = job_.theme;
      config.transparent = job_.options.transparent;
      config.effort = job_.effort;
      config.pixels_per_metre = kPixelsPerMetre;
      config.threads = job_.threads;
      pipeline = std::make_unique<Pipeline>(Context::create(job_.backend), config, work_);
    }
    auto next = to_draw_.begin();
    direct(scenario_, pace_, work_, [&](const Frame& frame) {
      if (interrupted()) return false;
      if (frame.index == *next) {
        const DrawList list = draw_frame(frame, page_for(job_.width, job_.height), work_);
        write_file(file(frame.index, "json"), to_json(frame));
        if (pipeline)
          pipeline->submit(list, texts_of(frame), file(frame.index, "png"));
        else
          write_file(file(frame.index, "svg"),
                     to_svg(list, job_.theme, job_.options.transparent, job_.width, job_.height));
        progress.done(++count);
        ++next;
      }
      const bool last = frame.index + 1 == plan_.size();
      if (last && scenario_.atlas && chosen_.size() == plan_.size())
        write_atlas(job_, frame, folder_, work_);
      return next != to_draw_.end();
    });
    if (pipeline) pipeline->finish();
  }

  // After a whole run nothing of an older one stands among the new frames: none that the scenario
  // no longer has, and no picture in the other format of what is no longer so.
  void remove_stale_frames() const {
    if (!old_ || old_->frames.empty() || chosen_.size() != plan_.size()) return;
    const std::string other = job_.svg() ? "png" : "svg";
    std::error_code error;
    for (std::uint32_t index = 0; index <= old_->frames.back(); ++index) {
      if (index >= plan_.size())
        for (const char* ending : {"png", "svg", "json"}) fs::remove(file(index, ending), error);
      else if (old_->facts_key != manifest_.facts_key())
        fs::remove(file(index, other), error);
    }
  }

  const RenderJob& job_;
  const Scenario& scenario_;
  Pace pace_;
  const std::vector<PlannedFrame>& plan_;
  std::vector<std::uint32_t> chosen_;
  std::vector<std::uint32_t> to_draw_;
  std::optional<OldManifest> old_;  // of the run before
  fs::path folder_;
  Manifest manifest_;
  Work& work_;
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
  const Rehearsal rehearsal = rehearse(scenario, pace);
  if (interrupted()) return kInterrupted;
  if (!rehearsal.report.unmet.empty()) complain(ScenarioError(rehearsal.report.unmet));
  const int code = rehearsal.report.unmet.empty() ? kGood : kFailed;
  if (job.to_stdout()) {
    const auto chosen = select_frames(rehearsal.plan, job.options.frames, job.options.at);
    if (chosen.size() != 1)
      throw UsageError(
          fmt::format("-o - writes one frame, but {} are chosen; pick one with "
                      "--frames or --at",
                      chosen.size()));
    draw_to_stdout(job, scenario, pace, chosen[0], work);
    return code;
  }
  FolderRun run(job, scenario, rehearsal, work);
  if (!run.run()) return kInterrupted;
  json.line().begin_object().member("scenario", scenario.name);
  json.member("folder", run.folder().string()).member("drawn", run.drawn());
  json.member("kept", run.kept()).member("expectations", rehearsal.report.expectations);
  json.member("unmet", rehearsal.report.unmet.size()).end_object();
  say(fmt::format("{}: {} frames in {}{}", scenario.name, run.drawn() + run.kept(),
                  run.folder().string(),
                  run.kept() ? fmt::format(", {} of them there already", run.kept()) : ""));
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
    }
    if (interrupted()) {
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
