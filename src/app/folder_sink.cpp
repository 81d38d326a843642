#include "app/folder_sink.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "app/shard_render.hpp"
#include "app/terminal.hpp"
#include "atlas/atlas.hpp"
#include "base/file.hpp"
#include "base/json_writer.hpp"
#include "draw/page.hpp"

namespace lantern::app {
namespace {

namespace fs = std::filesystem;

// The facts of a frame are the same whatever is drawn of it.
std::string facts_of(const Manifest& manifest, const Frame& frame) {
  const MadeFrom from = manifest.frame_from(frame.index);
  return sealed(FileKind::json, to_json(frame), {from.facts, from.facts});
}

// Where each texture lies in the image of the finished atlas.
std::string atlas_facts(const Manifest& manifest, const Frame& frame, const DrawList& list) {
  JsonWriter json;
  json.begin_object().line().member("format", "lantern.atlas/1");
  json.line().member("image", atlas_file(manifest.scenario, manifest.format));
  json.line().key("size").begin_array();
  json.value(static_cast<int>(list.page.x)).value(static_cast<int>(list.page.y)).end_array();
  json.line().key("textures").begin_array();
  for (const FrameTexture& t : frame.get<FrameTextures>().textures) {
    if (!t.packed) continue;
    json.line().begin_object().members("name", t.name, "x", t.x, "y", t.y, "width", t.width,
                                       "height", t.height);
    if (t.turned) json.member("turned", true);
    json.end_object();
  }
  json.line().end_array().line().key("refused").begin_array();
  for (const FrameTexture& t : frame.get<FrameTextures>().textures)
    if (t.refused) json.value(t.name);
  json.end_array().line().end_object();
  return json.text() + "\n";
}

}  // namespace

void tell_of_strange(const std::string& scenario, const FrameFolder& folder,
                     const std::set<std::string>& written) {
  std::vector<std::string> left, replaced;
  for (const std::string& name : folder.strange())
    (written.contains(name) ? replaced : left).push_back(name);
  if (!left.empty())
    warn(about_files(scenario, "left alone, since it is not as Lantern made it", left));
  if (!replaced.empty())
    warn(about_files(scenario, "replaced, though it was not as Lantern made it", replaced));
}

FolderSink::FolderSink(const RenderJob& job, const Scenario& scenario, Pace pace,
                       Selection& selection, Work& work, const Part& part)
    : job_(job),
      scenario_(scenario),
      selection_(selection),
      manifest_(job.manifest(scenario, pace)),
      path_(fs::path(job.options.output) / scenario.name),
      work_(work),
      part_(part),
      walk_(job, work) {}

void FolderSink::draw(const Frame& frame, const Staging& staging) {
  all_.push_back({frame.step, frame.event, frame.time, frame.caption, frame.hash});
  if (selection_.takes(frame)) take(frame, staging);
  // Of sides each has an atlas of its own, and none is the scenario's.
  if (scenario_.atlas && scenario_.sides.empty() && frame.step + 1 == frame.steps) last_ = frame;
}

void FolderSink::close(const DirectorReport& report) {
  selection_.require_some();
  if (pipeline_) pipeline_->finish();
  if (!folder_ && !part_.is_all()) return;  // none of the frames is of this part
  list_frames();
  if (wants_atlas()) write_atlas(*last_);
  tell_of_strange(scenario_.name, *folder_, written_);
  manifest_.finished = true;
  manifest_.expectations = report.expectations;
  manifest_.unmet = report.unmet.count();
  write_manifest();
  folder_->folder().settle();  // before anybody is told that it is finished
}

// Only when there is a frame for it. What cannot draw it removes nothing.
void FolderSink::open_folder(const Frame& frame) {
  folder_.emplace(output_folder(job_.options), manifest_, selection_.takes_all());
  if (job_.format == FileKind::png && !folder_->stands(frame.index, job_.format)) pipeline();
  folder_->remove_old();
  write_manifest();
}

void FolderSink::take(const Frame& frame, const Staging& staging) {
  const bool was_here = std::exchange(is_here_, part_.has(chosen_++));
  if (is_here_) take_facts(frame);
  walk_.go_on(frame, staging);
  // The way from a frame to the next belongs to the first of them.
  if (was_here && walk_.goes_on() && job_.in_betweens.wanted()) take_in_betweens();
  if (is_here_) take_picture(frame);
}

void FolderSink::take_facts(const Frame& frame) {
  if (!folder_) open_folder(frame);
  taken_.insert(frame.index);
  if (!folder_->stands(frame.index, FileKind::json))
    write_counted(frame_file(manifest_.scenario, frame.index, FileKind::json),
                  facts_of(manifest_, frame));
}

void FolderSink::take_picture(const Frame& frame) {
  if (folder_->stands(frame.index, manifest_.format)) {
    ++kept_;
    return;
  }
  write_picture(frame_file(manifest_.scenario, frame.index, manifest_.format), walk_.page(), frame,
                manifest_.frame_from(frame.index));
  ++drawn_;
}

// From the frame before to this one.
void FolderSink::take_in_betweens() {
  const Frame &before = *walk_.before(), &here = walk_.here();
  const std::uint32_t index = before.index;
  const std::uint64_t count = job_.in_betweens.between(before, here);
  all_[index].in_betweens = count;
  in_betweens_ += count;
  if (all_.size() + in_betweens_ > InBetweens::kMostPictures)
    throw UsageError(fmt::format("{}: more than {} pictures; ask for fewer in-betweens",
                                 scenario_.name, InBetweens::kMostPictures));
  for (std::uint64_t k = 1; k <= count; ++k) {
    if (folder_->in_between_stands(index, k)) continue;
    const double t = static_cast<double>(k) / static_cast<double>(count + 1);
    write_picture(in_between_file(manifest_, index, k), walk_.in_between(t), here,
                  manifest_.in_between_from(index, k));
  }
}

void FolderSink::write_picture(const std::string& file, const DrawList& list, const Frame& frame,
                               const MadeFrom& from) {
  if (job_.format == FileKind::svg) {
    write_counted(file, picture_of(job_, job_.picture, frame, list, from, work_));
    ++work_.frames_written;
  } else {
    pipeline().submit(list, texts_of(frame), {folder_->folder(), file}, from);
    written_.insert(file);
  }
}

void FolderSink::write_counted(const std::string& file, const std::string& bytes) {
  write_file({folder_->folder(), file}, bytes);
  written_.insert(file);
  work_.bytes_written += bytes.size();
}

// Made when there is something to draw.
Pipeline& FolderSink::pipeline() {
  if (!pipeline_) try {
      pipeline_ = std::make_unique<Pipeline>(Context::create(job_.backend), job_.picture, work_);
    } catch (const Refused& too_large) {  // by the command line, not by the scenario
      throw UsageError(too_large.what());
    }
  return *pipeline_;
}

// Those of this run, and those of earlier ranges that still stand. A part is what it is, whatever
// stands beside it.
void FolderSink::list_frames() {
  const auto still_stands = [&](std::uint32_t i) {
    return part_.is_all() && folder_->stands(i, manifest_.format) &&
           folder_->stands(i, FileKind::json);
  };
  for (std::uint32_t i = 0; i < all_.size(); ++i)
    if (taken_.contains(i) || still_stands(i)) list_frame(i);
}

void FolderSink::list_frame(std::uint32_t index) {
  ListedFrame& listed = manifest_.frames.emplace(index, std::move(all_[index])).first->second;
  if (job_.in_betweens.wanted() && listed.in_betweens == 0 && part_.is_all())
    listed.in_betweens = folder_->in_betweens_standing(index);
}

// Of a run in parts, with the last frame of all.
bool FolderSink::wants_atlas() const {
  if (!last_) return false;
  if (part_.is_all()) return manifest_.frames.size() == all_.size();
  return chosen_ == all_.size() && taken_.contains(last_->index);
}

// Transparent, in its own size, as soon as all frames are there.
void FolderSink::write_atlas(const Frame& frame) {
  const DrawList list = draw_atlas_image(frame);
  Pipeline::Config as = job_.picture;
  as.width = static_cast<int>(list.page.x);
  as.height = static_cast<int>(list.page.y);
  as.transparent = true;
  as.pixels_per_metre = 0;
  const MadeFrom from = manifest_.atlas_from();
  if (!folder_->atlas_stands(manifest_.format))
    write_counted(atlas_file(manifest_.scenario, manifest_.format),
                  picture_of(job_, as, frame, list, from, work_));
  if (!folder_->atlas_stands(FileKind::json))
    write_counted(atlas_file(manifest_.scenario, FileKind::json),
                  sealed(FileKind::json, atlas_facts(manifest_, frame, list), from));
  has_atlas_ = true;
}

void FolderSink::write_manifest() {
  write_file({folder_->folder(), kManifest}, to_json(manifest_));
  written_.insert(kManifest);
}

}  // namespace lantern::app
