#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "app/output/sinks.hpp"
#include "app/progress.hpp"
#include "app/terminal.hpp"
#include "base/memory.hpp"
#include "draw/page.hpp"
#include "embedded/version.hpp"
#include "publish/paper.hpp"
#include "render/renderer.hpp"

namespace lantern::app {

namespace {

// What is printed does not move.
void refuse_in_betweens(const Sequence& sequence) {
  if (sequence.job.in_betweens.wanted())
    sequence.refuse("a page does not move; in-betweens (--tween, --fps) need a folder or a film");
}

publish::PdfWords words_of(const Scenario& scenario) {
  return {scenario.title, fmt::format("scenario {}, seed {}", scenario.name, scenario.seed),
          fmt::format("Lantern {}", kVersion)};
}

// A page a frame. Frames whose name is the same stand in one document: all of them, those of a
// step, or each alone.
class DocumentSink : public FileSink {
 public:
  explicit DocumentSink(const Sequence& sequence) : FileSink(sequence) {
    refuse_in_betweens(sequence);
    begin();  // what is missing for it is told before the run
  }

 protected:
  void take(const Frame& frame, const Staging& staging) override {
    const fs::path file = of_.file_of(frame);
    if (document_->pages() > 0 && file != file_) {
      end();
      begin();
    }
    file_ = file;
    const RenderJob& job = of_.job;
    document_->add_page(job.page_of(frame, staging, of_.work), job.picture.theme,
                        !job.picture.transparent, job.points(), fmt::format("{}", frame.index));
    if (step_ != frame.step)
      document_->add_entry(fmt::format("{}: {}", frame.step + 1, frame.caption));
    step_ = frame.step;
    ++of_.work.frames_drawn;
    // A document is in memory until it is whole.
    as_asked([&] {
      require_memory(2 * document_->bytes(),
                     fmt::format("documents of {} pages", document_->pages()),
                     "choose some (--frames, --at), or write {frame} in the name: a file a frame");
    });
  }
  void end() override {
    const auto pages = static_cast<std::uint64_t>(document_->pages());
    write(file_, document_->finish(), pages);
  }

 private:
  void begin() {
    document_.emplace(words_of(of_.scenario));
    step_.reset();
  }

  fs::path file_;
  std::optional<publish::PdfDocument> document_;
  std::optional<std::uint32_t> step_;  // of the page before
};

constexpr double kMillimetres = 25.4;  // in an inch
constexpr double kPoints = 72;

publish::SheetGrid grid_of(const std::string& words) {
  if (const auto grid = publish::sheet_grid(words)) return *grid;
  throw UsageError(
      "--sheet {}: write how many pictures across and down a page, each from 1 to {}: 3x2", words,
      publish::SheetGrid::kMost);
}

// A4 across, unless a size is asked for; in millimetres.
Vec<2> paper_of(const RenderJob& job) {
  if (job.options.size.empty()) return {297, 210};
  return Vec<2>(job.picture.width, job.picture.height) * (kMillimetres / job.options.dpi);
}

// Draws none of the frames: only a run can tell how many pages there are.
std::uint64_t pages_of(const Sequence& sequence, const publish::SheetGrid& grid) {
  struct CountingSink : FrameSink {
    explicit CountingSink(const Selection& of) : selection(of) {}
    void frame(const Frame& frame) override { chosen += selection.takes(frame); }
    void finish(const DirectorReport&) override { selection.require_some(); }
    Selection selection;
    std::uint64_t chosen = 0;
  } sink(sequence.selection);  // as it is before the run
  run_scenario(sequence.scenario, sequence.pace, sink, sequence.work, sink.selection.most());
  return (sink.chosen + grid.pictures() - 1) / grid.pictures();
}

// Makes pages: PNG or PDF.
class SheetSink : public FileSink {
 public:
  explicit SheetSink(const Sequence& sequence) : FileSink(sequence) {
    refuse_in_betweens(sequence);
    if (sequence.to.is_by("step"))
      sequence.refuse(
          "steps share the pages of a sheet; write {frame}, which is the first one of each page");
    if (sequence.to.ending() == "pdf")
      document_.emplace(words_of(sequence.scenario));
    else
      begin_pictures();
    pages_ = pages_of(sequence, grid_);
    if (renderer_ && pages_ > 1 && !sequence.to.is_by("frame"))
      sequence.refuse(fmt::format(
          "a PNG is one page, and these are {}; write {{frame}} in its name, make it a .pdf, or "
          "choose fewer frames (--frames, --at)",
          pages_));
  }

 protected:
  void take(const Frame& frame, const Staging& staging) override {
    if (waiting_.empty()) {
      first_ = of_.file_of(frame);
      title_ = of_.job.display_of(frame).title ? frame.title : "";
    }
    waiting_.push_back(bare_picture(frame, staging));
    if (waiting_.size() == grid_.pictures()) add_page();
  }
  void end() override {
    if (!waiting_.empty()) add_page();
    if (document_ && document_->pages() > 0) write_document();
  }

 private:
  void begin_pictures() {
    const Vec<2> pixels = paper_ * (of_.job.options.dpi / kMillimetres);
    const int width = static_cast<int>(std::lround(pixels.x));
    const int height = static_cast<int>(std::lround(pixels.y));
    if (std::max(width, height) > render::kMostSide)
      throw UsageError(
          "a sheet of {} x {} pixels is more than {}; ask for fewer dots "
          "(--dpi), or make it a .pdf",
          width, height, render::kMostSide);
    renderer_ = &of_.job.renderer(width, height, of_.work);
  }
  // The panels alone: what is said of them stands on the sheet.
  publish::SheetPicture bare_picture(const Frame& frame, const Staging& staging) const {
    const Display display = of_.job.display_of(frame);
    Frame bare = frame;
    bare.display = display;
    bare.display.title = bare.display.caption = bare.display.counters = false;
    std::string caption;
    if (display.caption)
      caption = frame.part.empty() ? frame.caption : frame.part + ": " + frame.caption;
    if (const auto counters = counter_texts(frame); display.counters && !counters.empty())
      caption += fmt::format("{}({})", caption.empty() ? "" : " ", fmt::join(counters, ", "));
    return {draw_frame(bare, staging, layout_.picture(), of_.work),
            fmt::format("{}", frame.index + 1), std::move(caption)};
  }
  void add_page() {
    const std::string number = fmt::format("page {} of {}", ++page_, pages_);
    const DrawList list = layout_.page(waiting_, {title_, number});
    const std::uint64_t frames = waiting_.size();
    waiting_.clear();
    of_.work.frames_drawn += frames;
    const auto& picture = of_.job.picture;
    if (renderer_) {
      renderer_->draw(list, picture.theme, picture.transparent, image_);
      ++of_.work.frames_encoded;
      write(first_, encode_png(image_, picture.effort, texts(number), picture.pixels_per_metre),
            frames);
      return;
    }
    document_->add_page(list, picture.theme, !picture.transparent,
                        paper_ * (kPoints / kMillimetres));
    in_document_ += frames;
    if (file_.empty()) file_ = first_;
    if (!of_.to.is_by("frame")) return;
    write_document();
    document_.emplace(words_of(of_.scenario));
    in_document_ = 0;
  }
  void write_document() {
    write(file_, document_->finish(), in_document_);
    file_.clear();
  }
  std::vector<PngText> texts(const std::string& number) const {
    return {{"Title", title_.empty() ? of_.scenario.title : title_},
            {"Software", fmt::format("Lantern {}", kVersion)},
            {"Scenario", of_.scenario.name},
            {"Sheet", number}};
  }

  publish::SheetGrid grid_ = grid_of(of_.job.options.sheet);
  Vec<2> paper_ = paper_of(of_.job);  // millimetres
  publish::SheetLayout layout_ = as_asked([&] { return publish::SheetLayout(paper_, grid_); },
                                          "--sheet: ", "; choose another --size");
  std::optional<publish::PdfDocument> document_;  // one of these two
  Renderer* renderer_ = nullptr;
  Image image_;
  std::uint64_t pages_ = 0, page_ = 0, in_document_ = 0;
  // Of the page that is being filled.
  std::vector<publish::SheetPicture> waiting_;
  fs::path first_;  // file of its first frame
  std::string title_;
  fs::path file_;  // of the document
};

}  // namespace

std::unique_ptr<FileSink> make_document_sink(const Sequence& sequence) {
  return std::make_unique<DocumentSink>(sequence);
}

std::unique_ptr<FileSink> make_sheet_sink(const Sequence& sequence) {
  return std::make_unique<SheetSink>(sequence);
}

}  // namespace lantern::app
