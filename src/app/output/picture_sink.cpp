#include <map>
#include <string>

#include <fmt/format.h>

#include "app/output/sinks.hpp"
#include "app/terminal.hpp"
#include "base/file.hpp"
#include "render/pipeline.hpp"

namespace lantern::app {
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

std::unique_ptr<FileSink> make_picture_sink(const Sequence& sequence) {
  return std::make_unique<PictureSink>(sequence);
}

std::unique_ptr<FileSink> make_stdout_sink(const Sequence& sequence) {
  return std::make_unique<StdoutSink>(sequence);
}

}  // namespace lantern::app
