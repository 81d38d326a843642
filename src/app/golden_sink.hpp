// The frames of a run beside golden ones: compared with them, or becoming them. Both draw as
// `lantern render` does, in one pass, and keep no picture longer than it is needed.
//
// DIR/<scenario>/golden.txt lists the frames with the hashes of their pixels; beside it stand
// <scenario>_0000.png and .json, as render writes them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/frame_folder.hpp"
#include "app/golden_list.hpp"
#include "app/render_job.hpp"
#include "app/run_scenario.hpp"
#include "app/selection.hpp"
#include "app/staged_sink.hpp"
#include "base/file.hpp"
#include "base/folder_lock.hpp"
#include "publish/golden_report.hpp"
#include "render/compare.hpp"
#include "render/renderer.hpp"
#include "scenario/scenario_name.hpp"

namespace lantern::app {

// What the goldens of one scenario are. The references must outlive the sink.
struct Goldens {
  const RenderJob& job;
  const Scenario& scenario;
  Pace pace;
  Selection& selection;
  Work& work;
  ScenarioName name;
  std::filesystem::path output;  // DIR
  std::optional<Folder> folder;  // DIR/<scenario>, if it is there
  GoldenList list;               // that stands there; without frames if none does

  // What this run's frames are made with.
  GoldenList::MadeWith made_with() const;
};

// Draws the chosen frames.
class GoldenSink : public StagedSink {
 protected:
  explicit GoldenSink(const Goldens& goldens) : goldens_(goldens), folder_(goldens.folder) {}

  // `facts` without a seal.
  virtual void take(const Frame& frame, const Image& image, const std::string& facts) = 0;

  // Throws BackendError, and UsageError for a picture that is too large.
  void draw(const Frame& frame, const Staging& staging) final;
  std::string file(std::uint32_t frame, FileKind kind) const;
  // The pictures and facts of frames that stand in the folder, by name, with their frame's index.
  std::map<std::string, std::uint32_t> frame_files() const;
  // Nothing if it is not there. Throws IoError if it cannot be read.
  std::optional<std::string> read(const std::string& file) const;

  const Goldens& goldens_;
  std::optional<Folder> folder_;  // goldens_.folder, or as it was made since
  std::uint32_t count_ = 0;       // frames of the run so far, chosen or not

 private:
  std::optional<Renderer> renderer_;  // made when there is something to draw
  Image image_;
};

// What differs goes into the suite.
class GoldenComparison : public GoldenSink {
 public:
  // Pictures are kept for as many frames as `shown` says, which is counted down.
  GoldenComparison(const Goldens& goldens, const Allowance& allowance, GoldenSuite& suite,
                   std::size_t& shown);

 protected:
  void take(const Frame& frame, const Image& image, const std::string& facts) override;
  void close(const DirectorReport& report) override;

 private:
  void compare_facts_of(GoldenCase& one, const std::string& facts) const;
  void compare_picture_of(GoldenCase& one, const GoldenList::Entry& golden, const Image& image);
  // Keeps the pictures for the report; there may be no golden one.
  void show(GoldenCase& one, const Image* golden, const Image& actual);

  Allowance allowance_;
  GoldenSuite& suite_;
  std::size_t& shown_;
};

// What has changed is written, and what is gone is removed, unless somebody else made it.
class GoldenUpdate : public GoldenSink {
 public:
  explicit GoldenUpdate(const Goldens& goldens) : GoldenSink(goldens) {}

  // Names of files.
  const std::vector<std::string>& written() const { return written_; }
  const std::vector<std::string>& removed() const { return removed_; }
  const std::vector<std::string>& strange() const { return strange_; }

 protected:
  // Throws IoError, and leaves what stood there or the new file.
  void take(const Frame& frame, const Image& image, const std::string& facts) override;
  // golden.txt is written last.
  void close(const DirectorReport& report) override;

 private:
  void write(const std::string& file, const std::string& bytes);
  void remove_gone();

  std::optional<FolderLock> lock_;  // from the first frame on
  std::map<std::uint32_t, GoldenList::Entry> taken_;
  std::vector<std::string> written_, removed_, strange_;
};

}  // namespace lantern::app
