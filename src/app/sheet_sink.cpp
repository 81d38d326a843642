#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "app/file_sink.hpp"
#include "app/forecast.hpp"
#include "app/named_files.hpp"
#include "app/terminal.hpp"
#include "base/error.hpp"
#include "draw/page.hpp"
#include "embedded/version.hpp"
#include "publish/pdf.hpp"
#include "publish/sheet.hpp"
#include "render/renderer.hpp"

namespace lantern::app {
namespace {

namespace fs = std::filesystem;

constexpr double kMillimetres = 25.4;  // in an inch
constexpr double kPoints = 72;

publish::SheetGrid grid_of(const std::string& words) {
  if (const auto grid = publish::sheet_grid(words)) return *grid;
  throw UsageError(fmt::format(
      "--sheet {}: write how many pictures across and down a page, each from 1 to {}: 3x2", words,
      publish::SheetGrid::kMost));
}

publish::SheetLayout layout_of(const Vec<2>& paper, const publish::SheetGrid& grid) try {
  return {paper, grid};
} catch (const Refused& no_room) {  // by the command line, not by the scenario
  throw UsageError(fmt::format("--sheet: {}; choose another --size", no_room.what()));
}

// A4 across, unless a size is asked for; in millimetres.
Vec<2> paper_of(const RenderJob& job) {
  if (job.options.size.empty()) return {297, 210};
  return Vec<2>(job.picture.width, job.picture.height) * (kMillimetres / job.options.dpi);
}

// Counts the frames that are chosen, and draws none: only a run can tell how many pages there are.
class CountingSink : public FrameSink {
 public:
  explicit CountingSink(Selection& selection) : selection_(selection) {}
  void frame(const Frame& frame) override { chosen_ += selection_.takes(frame); }
  void finish(const DirectorReport&) override { selection_.require_some(); }
  std::uint64_t chosen() const { return chosen_; }

 private:
  Selection& selection_;
  std::uint64_t chosen_ = 0;
};

std::uint64_t pages_of(const Sequence& sequence, const publish::SheetGrid& grid) {
  const RenderOptions& options = sequence.job.options;
  Selection selection(options.frames, options.at,
                      extent_of(sequence.scenario, sequence.pace).frames);
  CountingSink sink(selection);
  run_scenario(sequence.scenario, sequence.pace, sink, sequence.work, selection.most());
  return (sink.chosen() + grid.pictures() - 1) / grid.pictures();
}

// Makes pages: PNG or PDF.
class SheetSink : public FileSink {
 public:
  explicit SheetSink(const Sequence& sequence)
      : sequence_(sequence),
        grid_(grid_of(sequence.job.options.sheet)),
        paper_(paper_of(sequence.job)),
        layout_(layout_of(paper_, grid_)),
        files_(sequence) {
    refuse_in_betweens(sequence);
    if (sequence.to.is_by("step"))
      throw UsageError(
          fmt::format("-o {}: steps share the pages of a sheet; write {{frame}}, which "
                      "is the first one of each page",
                      sequence.job.options.output));
    if (sequence.to.ending() == "pdf")
      begin_document();
    else
      begin_pictures();
    pages_ = pages_of(sequence, grid_);
    if (renderer_ && pages_ > 1 && !sequence.to.is_by("frame"))
      throw UsageError(fmt::format(
          "-o {}: a PNG is one page, and these are {}; write {{frame}} in its name, make it a "
          ".pdf, or choose fewer frames (--frames, --at)",
          sequence.job.options.output, pages_));
  }
  Made made() const override { return files_.made(); }

 protected:
  void draw(const Frame& frame, const Staging& staging) override {
    if (!sequence_.selection.takes(frame)) return;
    if (waiting_.empty()) {
      first_ = {sequence_.scenario.name, frame.step, frame.index};
      title_ = sequence_.job.display_of(frame).title ? frame.title : "";
    }
    waiting_.push_back(picture_of(frame, staging));
    if (waiting_.size() == grid_.pictures()) add_page();
  }
  void close(const DirectorReport&) override {
    sequence_.selection.require_some();
    if (!waiting_.empty()) add_page();
    if (document_ && document_->pages() > 0) write_document();
    files_.settle();
  }

 private:
  void begin_document() {
    const Scenario& scenario = sequence_.scenario;
    document_.emplace(publish::PdfWords{
        scenario.title, fmt::format("scenario {}, seed {}", scenario.name, scenario.seed),
        fmt::format("Lantern {}", kVersion)});
    in_document_ = 0;
  }
  void begin_pictures() {
    const Vec<2> pixels = paper_ * (sequence_.job.options.dpi / kMillimetres);
    width_ = static_cast<int>(std::lround(pixels.x));
    height_ = static_cast<int>(std::lround(pixels.y));
    if (std::max(width_, height_) > Renderer::kMostPixels)
      throw UsageError(
          fmt::format("a sheet of {} x {} pixels is more than {}; ask for fewer dots "
                      "(--dpi), or make it a .pdf",
                      width_, height_, Renderer::kMostPixels));
    renderer_.emplace(Context::create(sequence_.job.backend), width_, height_);
    ++sequence_.work.graphics_contexts;
  }
  // The panels alone: what is said of them stands on the sheet.
  publish::SheetPicture picture_of(const Frame& frame, const Staging& staging) const {
    const Display display = sequence_.job.display_of(frame);
    Frame bare = frame;
    bare.display = display;
    bare.display.title = bare.display.caption = bare.display.counters = false;
    std::string caption;
    if (display.caption)
      caption = frame.part.empty() ? frame.caption : frame.part + ": " + frame.caption;
    if (const auto counters = counter_texts(frame); display.counters && !counters.empty())
      caption += fmt::format("{}({})", caption.empty() ? "" : " ", fmt::join(counters, ", "));
    return {draw_frame(bare, staging, layout_.picture(), sequence_.work),
            fmt::format("{}", frame.index + 1), std::move(caption)};
  }
  void add_page() {
    const std::string number = fmt::format("page {} of {}", ++page_, pages_);
    const DrawList list = layout_.page(waiting_, {title_, number});
    const std::uint64_t frames = waiting_.size();
    waiting_.clear();
    sequence_.work.frames_drawn += frames;
    const auto& picture = sequence_.job.picture;
    if (renderer_) {
      renderer_->draw(list, picture.theme, picture.transparent, image_);
      ++sequence_.work.frames_encoded;
      files_.write(sequence_.to.file(first_),
                   encode_png(image_, picture.effort, texts(number), picture.pixels_per_metre),
                   frames);
      return;
    }
    document_->add_page(list, picture.theme, !picture.transparent,
                        paper_ * (kPoints / kMillimetres));
    in_document_ += frames;
    if (file_.empty()) file_ = sequence_.to.file(first_);
    if (!sequence_.to.is_by("frame")) return;
    write_document();
    begin_document();
  }
  void write_document() {
    files_.write(file_, document_->finish(), in_document_);
    file_.clear();
  }
  std::vector<PngText> texts(const std::string& number) const {
    return {{"Title", title_.empty() ? sequence_.scenario.title : title_},
            {"Software", fmt::format("Lantern {}", kVersion)},
            {"Scenario", sequence_.scenario.name},
            {"Sheet", number}};
  }

  const Sequence sequence_;
  publish::SheetGrid grid_;
  Vec<2> paper_;  // millimetres
  publish::SheetLayout layout_;
  NamedFiles files_;
  std::optional<publish::PdfDocument> document_;  // one of these two
  std::optional<Renderer> renderer_;
  Image image_;
  int width_ = 0, height_ = 0;  // pixels
  std::uint64_t pages_ = 0, page_ = 0, in_document_ = 0;
  // Of the page that is being filled.
  std::vector<publish::SheetPicture> waiting_;
  NameParts first_;
  std::string title_;
  fs::path file_;  // of the document
};

}  // namespace

std::unique_ptr<FileSink> make_sheet_sink(const Sequence& sequence) {
  return std::make_unique<SheetSink>(sequence);
}

}  // namespace lantern::app
