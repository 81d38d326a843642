#include <map>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "app/file_sink.hpp"
#include "app/named_files.hpp"
#include "app/terminal.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "render/pipeline.hpp"

namespace lantern::app {
namespace {

namespace fs = std::filesystem;

// A file a frame, of the same bytes as in a folder. Where frames may share a name, since {frame} is
// not in it, nothing is written until it is known that none do.
class PictureSink : public FileSink {
 public:
  explicit PictureSink(const Sequence& s)
      : job_(s.job),
        to_(s.to),
        scenario_(s.scenario),
        selection_(s.selection),
        work_(s.work),
        from_(s.job.manifest(s.scenario, s.pace)) {}

  Made made() const override { return made_; }

 protected:
  void draw(const Frame& frame, const Staging& staging) override {
    if (!selection_.takes(frame)) return;
    const fs::path file = to_.file({scenario_.name, frame.step, frame.index});
    if (waiting_.contains(file))
      throw UsageError(
          fmt::format("-o {}: several frames are chosen; write {{frame}} in the name, or choose "
                      "one with --frames or --at",
                      job_.options.output));
    const DrawList list = job_.page_of(frame, staging, work_);
    const MadeFrom from = from_.frame_from(frame.index);
    ++made_.frames;
    made_.files.push_back(file);
    if (!to_.is_by("frame")) {
      waiting_[file] = picture_of(job_, job_.picture, frame, list, from, work_);
      return;
    }
    const FilePlace place = make_place(file, to_.users_folder());
    if (job_.format == FileKind::svg)
      write(place, picture_of(job_, job_.picture, frame, list, from, work_));
    else
      pipeline().submit(list, texts_of(frame), place, from);
  }

  void close(const DirectorReport&) override {
    selection_.require_some();
    if (pipeline_) pipeline_->finish();
    for (const auto& [file, bytes] : waiting_) write(make_place(file, to_.users_folder()), bytes);
    Folder(folder_of(made_.files.back())).settle();
  }

 private:
  void write(const FilePlace& place, const std::string& bytes) {
    write_file(place, bytes);
    ++work_.frames_written;
    work_.bytes_written += bytes.size();
  }

  Pipeline& pipeline() {
    if (!pipeline_) try {
        pipeline_ = std::make_unique<Pipeline>(Context::create(job_.backend), job_.picture, work_);
      } catch (const Refused& too_large) {  // by the command line, not by the scenario
        throw UsageError(too_large.what());
      }
    return *pipeline_;
  }

  const RenderJob& job_;
  const Destination& to_;
  const Scenario& scenario_;
  Selection& selection_;
  Work& work_;
  const Manifest from_;
  std::unique_ptr<Pipeline> pipeline_;
  std::map<fs::path, std::string> waiting_;  // whole files
  Made made_;
};

}  // namespace

std::unique_ptr<FileSink> make_picture_sink(const Sequence& sequence) {
  return std::make_unique<PictureSink>(sequence);
}

}  // namespace lantern::app
