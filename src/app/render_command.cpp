#include <algorithm>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/destination.hpp"
#include "app/file_sink.hpp"
#include "app/folder_sink.hpp"
#include "app/forecast.hpp"
#include "app/render_job.hpp"
#include "app/run_scenario.hpp"
#include "app/selection.hpp"
#include "app/staged_sink.hpp"
#include "app/terminal.hpp"
#include "base/file.hpp"
#include "base/json_writer.hpp"
#include "base/stop.hpp"
#include "draw/page.hpp"
#include "publish/lesson_index.hpp"

namespace lantern::app {
namespace {

// The picture of the one chosen frame to standard output.
class StdoutSink : public StagedSink {
 public:
  StdoutSink(const RenderJob& job, const Manifest& manifest, Selection& selection, Work& work)
      : job_(job), manifest_(manifest), selection_(selection), work_(work) {}

 protected:
  void draw(const Frame& frame, const Staging& staging) override {
    if (!selection_.takes(frame) || ++chosen_ > 1) return;
    const Pipeline::Config& as = job_.picture;
    const DrawList list = job_.page_of(frame, staging, work_);
    bytes_ = picture_of(job_, as, frame, list, manifest_.frame_from(frame.index), work_);
  }
  void close(const DirectorReport&) override {
    selection_.require_some();
    if (chosen_ != 1)
      throw UsageError(fmt::format(
          "-o - writes one frame, but {} are chosen; pick one with --frames or --at", chosen_));
    write_stdout(bytes_);
  }

 private:
  const RenderJob& job_;
  Manifest manifest_;
  Selection& selection_;
  Work& work_;
  std::size_t chosen_ = 0;
  std::string bytes_;
};

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
          fmt::format("two of the files are scenarios named '{}'; they would "
                      "overwrite each other's frames",
                      s.name));
  }
  return scenarios;
}

// What came of the frames of one scenario, for a program and for a person.
void tell_of(const FolderSink& sink, const Scenario& scenario, const DirectorReport& report,
             JsonWriter& json) {
  json.line().begin_object().members("scenario", scenario.name, "folder", sink.path().string(),
                                     "drawn", sink.drawn(), "kept", sink.kept(), "in_betweens",
                                     sink.in_betweens(), "expectations", report.expectations,
                                     "unmet", report.unmet.size());
  json.end_object();
  const std::string between =
      sink.in_betweens() > 0 ? fmt::format(" and {} in-betweens", sink.in_betweens()) : "";
  say(fmt::format("{}: {} frames{} in {}{}", scenario.name, sink.drawn() + sink.kept(), between,
                  sink.path().string(),
                  sink.kept() ? fmt::format(", {} of them there already", sink.kept()) : ""));
}

std::unique_ptr<FileSink> make_file_sink(const Sequence& sequence) {
  switch (sequence.to.kind()) {
    case OutputKind::picture:
      return make_picture_sink(sequence);
    case OutputKind::film:
      return make_film_sink(sequence);
    case OutputKind::document:
      return make_document_sink(sequence);
    case OutputKind::sheet:
      return make_sheet_sink(sequence);
    case OutputKind::page:
      return make_page_sink(sequence);
    case OutputKind::folder:
    case OutputKind::standard_output:
      break;
  }
  throw UsageError(fmt::format("-o {}: no file", sequence.to.ending()));
}

// The same of files that the user named.
void tell_of(const FileSink::Made& made, const Scenario& scenario, const DirectorReport& report,
             JsonWriter& json) {
  json.line().begin_object().member("scenario", scenario.name).key("files").begin_array();
  for (const auto& file : made.files) json.value(file.string());
  json.end_array().members("frames", made.frames, "expectations", report.expectations, "unmet",
                           report.unmet.size());
  json.end_object();
  const std::string where =
      made.files.size() == 1 ? made.files.front().string()
                             : fmt::format("{} files, {} to {}", made.files.size(),
                                           made.files.front().string(), made.files.back().string());
  say(fmt::format("{}: {} frames in {}", scenario.name, made.frames, where));
}

// Of the lesson pages that stand in one folder, a file a scenario, a page that lists them.
void list_lessons(const Destination& to) {
  const auto folder = to.file({"a"}).parent_path();
  if (to.kind() != OutputKind::page || !to.is_by("scenario") ||
      folder != to.file({"b"}).parent_path())
    return;
  const auto index = folder / "index.html";
  const bool written = publish::write_lesson_index(folder.empty() ? "." : folder);
  say(written ? fmt::format("all lessons there are listed in {}", index.string())
              : fmt::format("{} is not of this kind and was left alone", index.string()));
}

// Draws one scenario; the exit code that it deserves.
int render_one(const RenderJob& job, const Destination& to, const Scenario& scenario, Work& work,
               JsonWriter& json) {
  const RenderOptions& options = job.options;
  const Pace pace = pace_of(options.pace, scenario);
  Selection selection(options.frames, options.at, extent_of(scenario, pace).frames);
  if (to.kind() == OutputKind::standard_output) {
    StdoutSink sink(job, job.manifest(scenario, pace), selection, work);
    return tell(run_scenario(scenario, pace, sink, work), options.strict);
  }
  if (to.kind() != OutputKind::folder) {
    const auto sink = make_file_sink({job, to, scenario, pace, selection, work});
    const RunResult result = run_scenario(scenario, pace, *sink, work, selection.most());
    const int code = tell(result, options.strict);
    tell_of(sink->made(), scenario, result.report, json);
    return code;
  }
  const auto most = selection.most() ? selection.most() : extent_of(scenario, pace).frames;
  job.in_betweens.require_few(most);
  FolderSink sink(job, scenario, pace, selection, work);
  const RunResult result =
      run_scenario(scenario, pace, sink, work, selection.most(), job.in_betweens.most());
  const int code = tell(result, options.strict);
  tell_of(sink, scenario, result.report, json);
  return code;
}

}  // namespace

int render_command(const RenderOptions& options) {
  const RenderJob job(options);
  const Destination to(options.output, !options.sheet.empty());
  const bool to_stdout = to.kind() == OutputKind::standard_output;
  if (to_stdout && options.files.size() != 1)
    throw UsageError("-o - writes one frame of one scenario");
  if (to_stdout && (options.tween || options.fps))
    throw UsageError("-o - writes one frame; in-betweens (--tween, --fps) need a folder");
  if (to.kind() != OutputKind::folder && options.files.size() > 1 && !to.is_by("scenario"))
    throw UsageError(fmt::format("-o {}: a file for each of {} scenarios; write {{scenario}} in it",
                                 options.output, options.files.size()));
  int code = kGood;
  const std::vector<Scenario> scenarios = load_all(options.files, code);
  Work work;
  JsonWriter json;
  json.begin_object().key("scenarios").begin_array();
  for (const Scenario& scenario : scenarios) {
    try {
      code = std::max(code, render_one(job, to, scenario, work, json));
    } catch (const ScenarioError& e) {
      complain(e);
      code = std::max<int>(code, kBadScenario);
    } catch (const Stopped&) {
      say("interrupted; the same command goes on where this one stopped");
      return kInterrupted;
    }
  }
  list_lessons(to);
  json.line().end_array().line().key("work");
  write(json, work);
  json.line().end_object();
  if (options.json && !to_stdout) write_stdout(json.text() + "\n");
  return code;
}

}  // namespace lantern::app
