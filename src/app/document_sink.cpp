#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "app/file_sink.hpp"
#include "app/named_files.hpp"
#include "app/terminal.hpp"
#include "base/error.hpp"
#include "base/memory.hpp"
#include "embedded/version.hpp"
#include "publish/pdf.hpp"

namespace lantern::app {
namespace {

namespace fs = std::filesystem;

// A page a frame. Frames whose name is the same stand in one document: all of them, those of a
// step, or each alone.
class DocumentSink : public FileSink {
 public:
  explicit DocumentSink(const Sequence& sequence) : sequence_(sequence), files_(sequence) {
    refuse_in_betweens(sequence);
    begin();  // what is missing for it is told before the run
  }
  Made made() const override { return files_.made(); }

 protected:
  void draw(const Frame& frame, const Staging& staging) override {
    if (!sequence_.selection.takes(frame)) return;
    const fs::path file = sequence_.to.file({sequence_.scenario.name, frame.step, frame.index});
    if (document_->pages() > 0 && file != file_) {
      write_document();
      begin();
    }
    file_ = file;
    const RenderJob& job = sequence_.job;
    document_->add_page(job.page_of(frame, staging, sequence_.work), job.picture.theme,
                        !job.picture.transparent, job.points(), fmt::format("{}", frame.index));
    if (step_ != frame.step) document_->add_entry(entry_of(frame));
    step_ = frame.step;
    ++sequence_.work.frames_drawn;
    require_room();
  }
  void close(const DirectorReport&) override {
    sequence_.selection.require_some();
    write_document();
    files_.settle();
  }

 private:
  void begin() {
    const Scenario& scenario = sequence_.scenario;
    document_.emplace(publish::PdfWords{
        scenario.title, fmt::format("scenario {}, seed {}", scenario.name, scenario.seed),
        fmt::format("Lantern {}", kVersion)});
    step_.reset();
  }
  void write_document() {
    const auto pages = static_cast<std::uint64_t>(document_->pages());
    files_.write(file_, document_->finish(), pages);
  }
  // A document is in memory until it is whole.
  void require_room() const try {
    require_memory(2 * document_->bytes(), fmt::format("documents of {} pages", document_->pages()),
                   "choose some (--frames, --at), or write {frame} in the name: a file a frame");
  } catch (const Refused& too_large) {  // by the command line, not by the scenario
    throw UsageError(too_large.what());
  }
  static std::string entry_of(const Frame& frame) {
    return fmt::format("{}: {}", frame.step + 1, frame.caption);
  }

  const Sequence sequence_;
  NamedFiles files_;
  fs::path file_;
  std::optional<publish::PdfDocument> document_;
  std::optional<std::uint32_t> step_;  // of the page before
};

}  // namespace

std::unique_ptr<FileSink> make_document_sink(const Sequence& sequence) {
  return std::make_unique<DocumentSink>(sequence);
}

}  // namespace lantern::app
