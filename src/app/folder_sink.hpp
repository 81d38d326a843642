// Frames into DIR/<scenario>/: a picture and facts each, a manifest, and the finished atlas.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/frame_folder.hpp"
#include "app/frame_walk.hpp"
#include "app/render_job.hpp"
#include "app/run_scenario.hpp"
#include "app/selection.hpp"
#include "app/staged_sink.hpp"

namespace lantern::app {

// Each chosen frame is drawn when its group is whole, unless its picture stands there already. The
// disk is left as it was until the first one. All that is given to it must outlive this.
class FolderSink : public StagedSink {
 public:
  FolderSink(const RenderJob& job, const Scenario& scenario, Pace pace, Selection& selection,
             Work& work);

  std::size_t drawn() const { return drawn_; }
  std::size_t kept() const { return kept_; }
  std::size_t in_betweens() const { return in_betweens_; }  // there now
  const std::filesystem::path& path() const { return path_; }

 protected:
  // Throws IoError, BackendError, and UsageError for a picture that is too large.
  void draw(const Frame& frame, const Staging& staging) override;
  // Throws UsageError if no frame was chosen.
  void close(const DirectorReport& report) override;

 private:
  void open_folder();
  void take(const Frame& frame, const Staging& staging);
  void take_in_betweens();
  void write_picture(const std::filesystem::path& file, const DrawList& list, const Frame& frame,
                     const MadeFrom& from);
  void write_counted(const std::filesystem::path& file, const std::string& bytes);
  void tell_of_strange_files() const;
  Pipeline& pipeline();
  void list_frames();
  void list_frame(std::uint32_t index);
  void write_atlas(const Frame& frame);
  void write_manifest();

  const RenderJob& job_;
  const Scenario& scenario_;
  Selection& selection_;
  Manifest manifest_;
  std::filesystem::path path_;
  Work& work_;
  std::optional<FrameFolder> folder_;
  std::unique_ptr<Pipeline> pipeline_;
  std::vector<ListedFrame> all_;   // of the run so far
  std::set<std::uint32_t> taken_;  // of these, chosen
  std::set<std::string> written_;  // names of files
  std::size_t drawn_ = 0, kept_ = 0, in_betweens_ = 0;
  FrameWalk walk_;
  std::optional<Frame> last_;  // of an atlas
};

}  // namespace lantern::app
