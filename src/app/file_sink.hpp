// Frames into files that the user names: films, documents, sheets, lesson pages, single pictures.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "app/destination.hpp"
#include "app/render_job.hpp"
#include "app/run_scenario.hpp"
#include "app/selection.hpp"
#include "app/staged_sink.hpp"

namespace lantern::app {

// What a sink is made for. All of it must outlive the sink.
struct Sequence {
  const RenderJob& job;
  const Destination& to;
  const Scenario& scenario;
  Pace pace;
  Selection& selection;
  Work& work;
};

// A file has its name only when it is whole: when a run fails or is interrupted, what stood there
// before still does. Each kind throws UsageError for what it cannot do, before the run if it can be
// known then.
class FileSink : public StagedSink {
 public:
  struct Made {
    std::uint64_t frames = 0;                      // in the files
    std::vector<std::filesystem::path> files;      // whole, in order
    std::optional<double> seconds = std::nullopt;  // that films take in all,
    double rate = 0;                               // at so many pictures a second
  };
  // After finish().
  virtual Made made() const = 0;
};

std::unique_ptr<FileSink> make_picture_sink(const Sequence& sequence);
std::unique_ptr<FileSink> make_film_sink(const Sequence& sequence);
std::unique_ptr<FileSink> make_document_sink(const Sequence& sequence);
std::unique_ptr<FileSink> make_sheet_sink(const Sequence& sequence);
std::unique_ptr<FileSink> make_page_sink(const Sequence& sequence);

}  // namespace lantern::app
