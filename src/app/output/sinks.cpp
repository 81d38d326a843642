#include "app/output/sinks.hpp"

#include <set>

#include <fmt/format.h>

#include "app/folders/kept_files.hpp"
#include "app/terminal.hpp"
#include "base/stop.hpp"
#include "draw/axis_ranges.hpp"
#include "render/pipeline.hpp"

namespace lantern::app {

void StagedSink::frame(const Frame& frame) {
  constexpr std::size_t kMostFrames = 1000, kMostBytes = std::size_t{64} << 20;
  const std::size_t bytes = estimated_bytes(frame);
  if (!waiting_.empty() && (waiting_.size() >= kMostFrames || bytes_ + bytes > kMostBytes)) flush();
  waiting_.push_back(frame);
  ++undrawn_;
  bytes_ += bytes;
}

void StagedSink::finish(const DirectorReport& report) {
  flush();
  close(report);
}

void StagedSink::flush() {
  draw::AxisRanges axes;
  for (const Frame& frame : waiting_) axes.see(frame);
  std::size_t first = 0;
  for (std::size_t next = 1; next <= waiting_.size(); ++next) {
    if (next < waiting_.size() && Staging::is_one_group(waiting_[next - 1], waiting_[next]))
      continue;
    const std::span<const Frame> group = std::span(waiting_).subspan(first, next - first);
    const Staging staging(group, axes);
    for (const Frame& frame : group) {
      stop_if_asked();
      draw(frame, staging);
      --undrawn_;
    }
    first = next;
  }
  waiting_.clear();
  bytes_ = 0;
}

namespace fs = std::filesystem;

FilePlace make_place(const fs::path& file, const fs::path& users) {
  require_free(file);
  Folder folder = users == "." ? Folder("") : Folder::made(users);  // names without ./
  for (const fs::path& part : folder_of(file).lexically_relative(users).lexically_normal()) {
    if (part == "..")
      throw UsageError(fmt::format("-o {}: it leads out again by ..", file.string()));
    if (!part.empty() && part != ".") folder = folder.inside(part.string());
  }
  return {folder, file.filename().string()};
}

void Sequence::refuse(const std::string& why) const {
  throw UsageError(fmt::format("-o {}: {}", job.options.output, why));
}

void FileSink::draw(const Frame& frame, const Staging& staging) {
  if (of_.selection.takes(frame)) take(frame, staging);
}

void FileSink::close(const DirectorReport&) {
  of_.selection.require_some();
  end();
  std::set<fs::path> folders;
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
    const std::filesystem::path file = of_.file_of(frame);
    if (waiting_.contains(file))
      of_.refuse(
          "several frames are chosen; write {frame} in the name, or choose one with --frames or "
          "--at");
    const DrawList list = of_.job.page_of(frame, staging, of_.work);
    const MadeFrom from = from_.frame_from(frame.index);
    if (of_.to.is_by("frame") && of_.job.format == FileKind::png) {
      if (!pipeline_) pipeline_ = of_.job.make_pipeline(of_.work);
      pipeline_->submit(list, texts_of(frame), place_of(file), from);
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
  std::map<std::filesystem::path, std::string> waiting_;  // whole files
};

// The picture of the one chosen frame.
class StdoutSink : public FileSink {
 public:
  explicit StdoutSink(const Sequence& sequence) : FileSink(sequence) {}

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

}  // namespace

std::unique_ptr<FileSink> make_file_sink(const Sequence& sequence) {
  switch (sequence.to.kind()) {
    case OutputKind::standard_output:
      return std::make_unique<StdoutSink>(sequence);
    case OutputKind::picture:
      return std::make_unique<PictureSink>(sequence);
    case OutputKind::film:
      return make_film_sink(sequence);
    case OutputKind::document:
      return make_document_sink(sequence);
    case OutputKind::sheet:
      return make_sheet_sink(sequence);
    case OutputKind::page:
      return make_page_sink(sequence);
    case OutputKind::folder:
      break;
  }
  sequence.refuse("no file");
}

}  // namespace lantern::app
