#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "app/output/sinks.hpp"
#include "app/progress.hpp"
#include "app/terminal.hpp"
#include "base/memory.hpp"
#include "base/words.hpp"
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

// Pages of a document of its own, or of the one that all scenarios share.
class PaperSink : public FileSink {
 public:
  explicit PaperSink(const Sequence& sequence) : FileSink(sequence) {
    refuse_in_betweens(sequence);
  }

 protected:
  std::optional<publish::PdfDocument>& pdf() { return of_.paper ? of_.paper->pdf : own_; }

  void begin_document() {
    publish::PdfWords words = words_of(of_.scenario);
    entry_.reset();
    if (!of_.paper || !of_.paper->pdf) {
      pdf().emplace(words);
    } else {
      const publish::PdfWords& before = of_.paper->words;
      words.title = before.title + ", " + words.title;
      words.subject = before.subject + "; " + words.subject;
      pdf()->say(words);
    }
    if (of_.paper) of_.paper->words = std::move(words);
  }

  // Of the page that was added last. The scenario's own, if it shares its document.
  void add_entry(const std::string& words) {
    if (of_.paper && !entry_) entry_ = pdf()->add_entry(of_.scenario.title);
    if (!words.empty()) pdf()->add_entry(words, entry_.value_or(0));
  }

  void write_document(const fs::path& file, std::uint64_t frames) {
    if (!of_.paper) return write(file, pdf()->finish(), frames);
    of_.paper->place.emplace(place_of(file));
    made_.frames += frames;
    made_.files = {file};
  }

 private:
  std::optional<publish::PdfDocument> own_;
  std::optional<int> entry_;
};

// A page a frame. Frames whose name is the same stand in one document: all of them, those of a
// step, or each alone.
class DocumentSink : public PaperSink {
 public:
  explicit DocumentSink(const Sequence& sequence) : PaperSink(sequence) {
    begin();  // what is missing for it is told before the run
  }

 protected:
  void take(const Frame& frame, const Staging& staging) override {
    const fs::path file = of_.file_of(frame);
    if (pages_ > 0 && file != file_) {
      end();
      begin();
    }
    file_ = file;
    const RenderJob& job = of_.job;
    pdf()->add_page(job.page_of(frame, staging, of_.work), job.picture.theme,
                    !job.picture.transparent, job.points(), fmt::format("{}", frame.index));
    if (pages_++ == 0) first_ = description_of(frame);
    if (step_ != frame.step) add_entry(fmt::format("{}: {}", frame.step + 1, frame.caption));
    step_ = frame.step;
    ++of_.work.frames_drawn;
    // A document is in memory until it is whole.
    as_asked([&] {
      require_memory(2 * pdf()->bytes(), fmt::format("documents of {} pages", pdf()->pages()),
                     "choose some (--frames, --at), or write {frame} in the name: a file a frame");
    });
  }
  // A figure says what there is to see.
  void end() override {
    publish::PdfWords words = words_of(of_.scenario);
    if (pages_ == 1 && !of_.paper && !first_.empty()) {
      words.subject += ": " + first_;
      pdf()->say(words);
    }
    write_document(file_, pages_);
  }

 private:
  void begin() {
    begin_document();
    step_.reset();
    pages_ = 0;
  }

  fs::path file_;
  std::string first_;                  // what is told of the first page
  std::uint64_t pages_ = 0;            // of this scenario
  std::optional<std::uint32_t> step_;  // of the page before
};

constexpr double kMillimetres = 25.4;  // in an inch
constexpr double kPoints = 72;

// The sheet that is asked for, and those with fewer pictures, the most first and of as many the
// largest; each upright or lying, unless it has a size. Only those with room for a picture, if any
// has.
std::vector<publish::SheetLayout> layouts_of(const RenderJob& job) {
  const RenderOptions& o = job.options;
  const auto asked = publish::sheet_grid(o.sheet);
  if (!asked)
    throw UsageError(
        "--sheet {}: write how many pictures across and down a page, each from 1 to {}: 3x2",
        o.sheet, publish::SheetGrid::kMost);
  std::vector<Vec<2>> papers = {{297, 210}, {210, 297}};
  if (o.paper == "letter") papers = {{279.4, 215.9}, {215.9, 279.4}};
  if (!o.size.empty())
    papers = {Vec<2>(job.picture.width, job.picture.height) * (kMillimetres / o.dpi)};
  std::vector<publish::SheetLayout> all;
  for (const Vec<2>& paper : papers)
    for (int columns = asked->columns; columns > 0; --columns)
      for (int rows = asked->rows; rows > 0; --rows)
        as_asked(
            [&] {
              all.emplace_back(paper, publish::SheetGrid{columns, rows}, job.letters);
            },
            "--sheet: ", "; choose another --size");
  std::ranges::sort(all, [](const auto& a, const auto& b) {
    return std::tuple(!a.is_roomy(), b.grid().pictures(), b.area()) <
           std::tuple(!b.is_roomy(), a.grid().pictures(), a.area());
  });
  const auto rough = std::ranges::find_if_not(all, &publish::SheetLayout::is_roomy);
  if (rough != all.begin())
    all.erase(rough, all.end());
  else
    all.erase(all.begin(), all.end() - std::ssize(papers));
  return all;
}

// The panels alone: what is said of them stands on the sheet.
DrawList bare_picture(const Sequence& of, const Frame& frame, const Staging& staging,
                      const publish::SheetLayout& layout) {
  Frame bare = frame;
  bare.display = of.job.display_of(frame);
  bare.display.title = bare.display.caption = bare.display.counters = false;
  return draw_frame(bare, staging, layout.picture(), of.work);
}

// Makes pages: PNG or PDF.
class SheetSink : public PaperSink {
 public:
  explicit SheetSink(const Sequence& sequence) : PaperSink(sequence) {
    if (sequence.to.is_by("step"))
      sequence.refuse(
          "steps share the pages of a sheet; write {frame}, which is the first one of each page");
    const std::vector<publish::SheetLayout> layouts = layouts_of(sequence.job);
    is_pdf_ = sequence.to.ending() == "pdf";
    if (is_pdf_)
      begin_document();
    else
      begin_pictures(layouts.front().paper());
    auto layout = layouts.begin();  // on which all panels have room
    std::uint64_t frames = 0;
    look_at_chosen(of_, [&](const Frame& frame, const Staging& staging) {
      ++frames;
      while (layout + 1 != layouts.end() && bare_picture(of_, frame, staging, *layout).left_out)
        ++layout;
    });
    layout_ = *layout;
    pages_ = (frames + layout->grid().pictures() - 1) / layout->grid().pictures();
    const auto& [columns, rows] = layout_->grid();
    if (const auto grid = fmt::format("{}x{}", columns, rows); grid != sequence.job.options.sheet)
      say(fmt::format("{}: {} pictures a page have no room with letters of {:.3g} pt: {} it is",
                      sequence.scenario.name, sequence.job.options.sheet, sequence.job.letters,
                      grid));
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
    waiting_.push_back({bare_picture(of_, frame, staging, *layout_),
                        fmt::format("{}", (of_.is_by_step() ? frame.step : frame.index) + 1),
                        description_of(frame, of_.job.display_of(frame))});
    if (waiting_.size() == layout_->grid().pictures()) add_page();
  }
  void end() override {
    if (!waiting_.empty()) add_page();
    if (is_pdf_ && in_document_ > 0) write_pages();
  }

 private:
  void begin_pictures(const Vec<2>& paper) {
    const Vec<2> pixels = paper * (of_.job.options.dpi / kMillimetres);
    const int width = static_cast<int>(std::lround(pixels.x));
    const int height = static_cast<int>(std::lround(pixels.y));
    if (std::max(width, height) > render::kMostSide)
      throw UsageError(
          "a sheet of {} x {} pixels is more than {}; ask for fewer dots "
          "(--dpi), or make it a .pdf",
          width, height, render::kMostSide);
    renderer_ = &of_.job.renderer(width, height, of_.work);
  }
  void add_page() {
    const std::string number = lantern::say("page {} of {}", ++page_, pages_);
    const DrawList list = layout_->page(waiting_, {title_, number});
    const std::uint64_t frames = waiting_.size();
    of_.work.frames_drawn += frames;
    const auto& picture = of_.job.picture;
    if (renderer_) {
      renderer_->draw(list, picture.theme, picture.transparent, image_);
      ++of_.work.frames_encoded;
      write(first_, encode_png(image_, picture.effort, texts(number), picture.pixels_per_metre),
            frames);
      return waiting_.clear();
    }
    waiting_.clear();
    pdf()->add_page(list, picture.theme, !picture.transparent,
                    layout_->paper() * (kPoints / kMillimetres));
    add_entry("");
    in_document_ += frames;
    if (file_.empty()) file_ = first_;
    if (!of_.to.is_by("frame")) return;
    write_pages();
    begin_document();
  }
  void write_pages() {
    write_document(file_, std::exchange(in_document_, 0));
    file_.clear();
  }
  std::vector<PngText> texts(const std::string& number) const {
    std::string told;
    for (const publish::SheetPicture& one : waiting_)
      told += fmt::format("{}{}: {}", told.empty() ? "" : "\n", one.number, one.caption);
    return {{"Title", title_.empty() ? of_.scenario.title : title_},
            {"Description", told},
            {"Software", fmt::format("Lantern {}", kVersion)},
            {"Scenario", of_.scenario.name},
            {"Sheet", number}};
  }

  std::optional<publish::SheetLayout> layout_;
  bool is_pdf_ = false;
  Renderer* renderer_ = nullptr;  // of a PNG
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
