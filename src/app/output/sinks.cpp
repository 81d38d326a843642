#include "app/output/sinks.hpp"

#include <set>

#include <fmt/format.h>

#include "app/folders/kept_files.hpp"
#include "app/terminal.hpp"
#include "atlas/atlas.hpp"
#include "base/json_writer.hpp"
#include "base/stop.hpp"
#include "draw/page.hpp"
#include "render/pipeline.hpp"

namespace lantern::app {

void StagedSink::frame(const Frame& frame) {
  constexpr std::size_t kMostFrames = 1000, kMostBytes = std::size_t{64} << 20;
  const std::size_t bytes = estimated_bytes(frame);
  if (!waiting_.empty() && (waiting_.size() >= kMostFrames || bytes_ + bytes > kMostBytes))
    flush(&frame);
  waiting_.push_back(frame);
  ++undrawn_;
  bytes_ += bytes;
}

void StagedSink::finish(const DirectorReport& report) {
  flush(nullptr);
  close(report);
}

void StagedSink::flush(const Frame* next) {
  draw::AxisRanges axes;
  for (const Frame& frame : waiting_) axes.see(frame);
  for (std::span<const Frame> rest = waiting_; !rest.empty();) {
    const std::span<const Frame> group = Staging::first_group(rest);
    const Staging staging(group, axes);
    for (const Frame& frame : group) {
      stop_if_asked();
      const Frame* after = &frame == &waiting_.back() ? next : &frame + 1;
      ends_step_ = after == nullptr || after->step != frame.step;
      draw(frame, staging);
      --undrawn_;
    }
    rest = rest.subspan(group.size());
  }
  waiting_.clear();
  bytes_ = 0;
}

FilePlace make_place(const fs::path& file, const fs::path& users) {
  require_free(file);
  Folder folder = users == "." ? Folder("") : Folder::made(users);  // names without ./
  for (const fs::path& part : folder_of(file).lexically_relative(users).lexically_normal()) {
    if (part == "..") throw UsageError("-o {}: it leads out again by ..", file.string());
    if (!part.empty() && part != ".") folder = folder.inside(part.string());
  }
  return {folder, file.filename().string()};
}

void Sequence::refuse(const std::string& why) const {
  throw UsageError("-o {}: {}", job.options.output, why);
}

bool Sequence::is_by_step() const {
  return to.kind() == OutputKind::sheet && selection.takes_all() && job.options.pace != "event";
}

void FileSink::draw(const Frame& frame, const Staging& staging) {
  if (of_.takes(frame, ends_step(), of_.selection)) take(frame, staging);
}

void look_at_chosen(const Sequence& sequence,
                    const std::function<void(const Frame&, const Staging&)>& look) {
  using Look = std::function<void(const Frame&, const Staging&)>;
  class Looking : public StagedSink {
   public:
    Looking(const Sequence& of, const Look& look)
        : of_(of), selection_(of.selection), look_(look) {}

   private:
    void draw(const Frame& frame, const Staging& staging) override {
      if (of_.takes(frame, ends_step(), selection_)) look_(frame, staging);
    }
    void close(const DirectorReport&) override { selection_.require_some(); }

    const Sequence& of_;
    Selection selection_;  // as it is before the run
    const Look& look_;
  } sink(sequence, look);
  run_scenario(sequence.scenario, sequence.pace, sink, sequence.work, sequence.selection.most());
}

void FileSink::close(const DirectorReport&) {
  of_.selection.require_some();
  end();
  std::set<fs::path> folders;
  if (!of_.paper)  // which is not there yet
    for (const fs::path& file : made_.files) folders.insert(folder_of(file));
  for (const fs::path& folder : folders) Folder(folder).settle();
}

FilePlace FileSink::place_of(const fs::path& file) const {
  return make_place(file, of_.to.users_folder());
}

void FileSink::write(const fs::path& file, std::string_view bytes, std::uint64_t frames) {
  write_file(place_of(file), bytes);
  of_.work.bytes_written += bytes.size();
  of_.work.frames_written += frames;
  made_.frames += frames;
  made_.files.push_back(file);
}

namespace {

// A file a frame, of the same bytes as in a folder. Where frames may share a name, since {frame} is
// not in it, nothing is written until it is known that none do.
class PictureSink : public FileSink {
 public:
  explicit PictureSink(const Sequence& sequence)
      : FileSink(sequence), from_(sequence.job.manifest(sequence.scenario, sequence.pace)) {}

 protected:
  void take(const Frame& frame, const Staging& staging) override {
    const fs::path file = of_.file_of(frame);
    if (waiting_.contains(file) && frame.step_name != of_.job.options.at)
      of_.refuse(
          "several frames are chosen; write {frame} in the name, or choose one with --frames or "
          "--at");
    const DrawList list = of_.job.page_of(frame, staging, of_.work);
    const MadeFrom from = from_.frame_from(frame.index);
    if (of_.to.is_by("frame") && of_.job.format == FileKind::png) {
      if (!pipeline_) pipeline_ = of_.job.make_pipeline(of_.work);
      pipeline_->submit(list, texts_of(frame, of_.job.options), place_of(file), from);
      ++made_.frames;
      made_.files.push_back(file);
      return;
    }
    std::string bytes = picture_of(of_.job, of_.job.picture, frame, list, from, of_.work);
    if (of_.to.is_by("frame"))
      write(file, bytes, 1);
    else
      waiting_[file] = std::move(bytes);
  }

  void end() override {
    if (pipeline_) pipeline_->finish();
    for (const auto& [file, bytes] : waiting_) write(file, bytes, 1);
  }

 private:
  const Manifest from_;
  std::unique_ptr<Pipeline> pipeline_;
  std::map<fs::path, std::string> waiting_;  // whole files
};

// The picture of the one chosen frame.
class StdoutSink : public FileSink {
 public:
  using FileSink::FileSink;

 protected:
  void take(const Frame& frame, const Staging& staging) override {
    last_ = frame.index;
    if (++made_.frames > 1) return;
    first_ = frame.index;
    const DrawList list = of_.job.page_of(frame, staging, of_.work);
    const Manifest manifest = of_.job.manifest(of_.scenario, of_.pace);
    bytes_ = picture_of(of_.job, of_.job.picture, frame, list, manifest.frame_from(frame.index),
                        of_.work);
  }

  void end() override {
    if (made_.frames != 1)
      of_.refuse(
          fmt::format("writes one frame, but {} are chosen, from {} to {}; --frames {} is the last "
                      "of them",
                      made_.frames, first_, last_, last_));
    write_stdout(bytes_);
  }

 private:
  std::uint32_t first_ = 0, last_ = 0;  // index of a chosen frame
  std::string bytes_;
};

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
  json.line().member("size", std::vector{int(list.page.x), int(list.page.y)});
  json.line().key("textures").begin_array();
  for (const FrameTexture& t : frame.get<FrameTextures>().textures) {
    if (!t.packed) continue;
    json.line().begin_object().members("name", t.name, "x", t.x, "y", t.y, "width", t.width,
                                       "height", t.height);
    if (t.turned) json.member("turned", true);
    json.end_object();
  }
  std::vector<std::string> refused;
  for (const FrameTexture& t : frame.get<FrameTextures>().textures)
    if (t.refused) refused.push_back(t.name);
  json.line().end_array().line().member("refused", refused).line().end_object();
  return json.text() + "\n";
}

class FolderSink : public StagedSink {
 public:
  FolderSink(const Sequence& sequence, const Part& part, FolderMade& made)
      : made_(made), of_(sequence), part_(part) {
    made_.path = fs::path(job_.options.output) / of_.scenario.name;
  }

 private:
  void draw(const Frame& frame, const Staging& staging) override {
    all_.push_back({frame.step, frame.event, frame.time, frame.caption, frame.hash});
    if (of_.selection.takes(frame)) take(frame, staging);
    // Of sides each has an atlas of its own, and none is the scenario's.
    if (of_.scenario.atlas && of_.scenario.sides.empty() && frame.step + 1 == frame.steps)
      last_ = frame;
  }

  void close(const DirectorReport& report) override {
    of_.selection.require_some();
    if (pipeline_) pipeline_->finish();
    pipeline_.reset();                        // before its graphics make way for those of an atlas
    if (!folder_ && !part_.is_all()) return;  // none of the frames is of this part
    list_frames();
    if (wants_atlas()) write_atlas(*last_);
    folder_->tell_of_strange(written_);
    manifest_.finished = true;
    manifest_.expectations = report.expectations;
    manifest_.unmet = report.unmet.count();
    write_manifest();
    folder_->folder().settle();  // before anybody is told that it is finished
  }

  // Only when there is a frame for it. What cannot draw it removes nothing.
  void open_folder(const Frame& frame) {
    folder_.emplace(output_folder(job_.options), manifest_, of_.selection.takes_all());
    if (job_.format == FileKind::png && !folder_->stands(frame.index, job_.format)) pipeline();
    folder_->remove_old();
    write_manifest();
  }

  void take(const Frame& frame, const Staging& staging) {
    const bool was_here = std::exchange(is_here_, part_.has(made_.chosen++));
    if (is_here_) take_facts(frame);
    walk_.go_on(frame, staging);
    // The way from a frame to the next belongs to the first of them.
    if (was_here && walk_.goes_on() && job_.in_betweens.wanted()) take_in_betweens();
    if (is_here_) take_picture(frame);
  }

  void take_facts(const Frame& frame) {
    if (!folder_) open_folder(frame);
    taken_.insert(frame.index);
    if (!folder_->stands(frame.index, FileKind::json))
      write_counted(frame_file(manifest_.scenario, frame.index, FileKind::json),
                    facts_of(manifest_, frame));
  }

  void take_picture(const Frame& frame) {
    if (folder_->stands(frame.index, manifest_.format)) {
      ++made_.kept;
      return;
    }
    write_picture(frame_file(manifest_.scenario, frame.index, manifest_.format), walk_.page(),
                  frame, manifest_.frame_from(frame.index));
    ++made_.drawn;
  }

  // From the frame before to this one.
  void take_in_betweens() {
    const Frame &before = *walk_.before(), &here = walk_.here();
    const std::uint32_t index = before.index;
    const std::uint64_t count = job_.in_betweens.between(before, here);
    all_[index].in_betweens = count;
    made_.in_betweens += count;
    if (all_.size() + made_.in_betweens > InBetweens::kMostPictures)
      throw UsageError("{}: more than {} pictures; ask for fewer in-betweens", of_.scenario.name,
                       InBetweens::kMostPictures);
    for (std::uint64_t k = 1; k <= count; ++k) {
      const std::string file = in_between_file(manifest_, index, k);
      if (folder_->stands(file)) continue;
      const double t = static_cast<double>(k) / static_cast<double>(count + 1);
      write_picture(file, walk_.in_between(t), here, manifest_.in_between_from(index, k));
    }
  }

  void write_picture(const std::string& file, const DrawList& list, const Frame& frame,
                     const MadeFrom& from) {
    if (job_.format == FileKind::svg) {
      write_counted(file, picture_of(job_, job_.picture, frame, list, from, of_.work));
      ++of_.work.frames_written;
    } else {
      pipeline().submit(list, texts_of(frame, job_.options), {folder_->folder(), file}, from);
      written_.insert(file);
    }
  }

  void write_counted(const std::string& file, const std::string& bytes) {
    write_file({folder_->folder(), file}, bytes);
    written_.insert(file);
    of_.work.bytes_written += bytes.size();
  }

  // Made when there is something to draw.
  Pipeline& pipeline() {
    if (!pipeline_) pipeline_ = job_.make_pipeline(of_.work);
    return *pipeline_;
  }

  // Those of this run, and those of earlier ranges that still stand. A part is what it is, whatever
  // stands beside it.
  void list_frames() {
    for (std::uint32_t i = 0; i < all_.size(); ++i) {
      const bool still_stands = part_.is_all() && folder_->stands(i, manifest_.format) &&
                                folder_->stands(i, FileKind::json);
      if (!taken_.contains(i) && !still_stands) continue;
      ListedFrame& listed = manifest_.frames.emplace(i, std::move(all_[i])).first->second;
      if (job_.in_betweens.wanted() && listed.in_betweens == 0 && part_.is_all())
        listed.in_betweens = folder_->in_betweens_standing(i);
    }
  }

  // As soon as all frames are there; of a run in parts, with the last frame of all.
  bool wants_atlas() const {
    if (!last_) return false;
    if (part_.is_all()) return manifest_.frames.size() == all_.size();
    return made_.chosen == all_.size() && taken_.contains(last_->index);
  }

  // Transparent, in its own size.
  void write_atlas(const Frame& frame) {
    const DrawList list = draw_atlas_image(frame);
    Pipeline::Config as = job_.picture;
    as.width = static_cast<int>(list.page.x);
    as.height = static_cast<int>(list.page.y);
    as.transparent = true;
    as.pixels_per_metre = 0;
    const MadeFrom from = manifest_.atlas_from();
    const std::string picture = atlas_file(manifest_.scenario, manifest_.format),
                      facts = atlas_file(manifest_.scenario, FileKind::json);
    if (!folder_->stands(picture))
      write_counted(picture, picture_of(job_, as, frame, list, from, of_.work));
    if (!folder_->stands(facts))
      write_counted(facts, sealed(FileKind::json, atlas_facts(manifest_, frame, list), from));
    made_.has_atlas = true;
  }

  void write_manifest() {
    write_file({folder_->folder(), kManifest}, to_json(manifest_));
    written_.insert(kManifest);
  }

  FolderMade& made_;
  const Sequence of_;
  const RenderJob& job_ = of_.job;
  Manifest manifest_ = job_.manifest(of_.scenario, of_.pace);
  Part part_;
  std::optional<FrameFolder> folder_;
  std::unique_ptr<Pipeline> pipeline_;
  std::vector<ListedFrame> all_;   // of the run so far
  std::set<std::uint32_t> taken_;  // of these, chosen, and of the part
  std::set<std::string> written_;  // names of files
  FrameWalk walk_{job_, of_.work};
  bool is_here_ = false;       // where it stands is of the part
  std::optional<Frame> last_;  // of an atlas
};

}  // namespace

std::unique_ptr<FileSink> make_file_sink(const Sequence& sequence) {
  const OutputKind kind = sequence.to.kind();
  if (kind == OutputKind::standard_output) return std::make_unique<StdoutSink>(sequence);
  if (kind == OutputKind::picture) return std::make_unique<PictureSink>(sequence);
  if (kind == OutputKind::film) return make_film_sink(sequence);
  if (kind == OutputKind::document) return make_document_sink(sequence);
  if (kind == OutputKind::sheet) return make_sheet_sink(sequence);
  if (kind == OutputKind::page) return make_page_sink(sequence);
  sequence.refuse("no file");
}

std::unique_ptr<StagedSink> make_folder_sink(const Sequence& sequence, const Part& part,
                                             FolderMade& made) {
  return std::make_unique<FolderSink>(sequence, part, made);
}

}  // namespace lantern::app
