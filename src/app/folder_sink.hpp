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
#include "app/shard.hpp"
#include "app/staged_sink.hpp"

namespace lantern::app {

// Of the files that stood in the folder under names of ours, but not as Lantern made them: which
// are left, and which are replaced, since they are among the files written.
void tell_of_strange(const std::string& scenario, const FrameFolder& folder,
                     const std::set<std::string>& written);

// Each chosen frame is drawn when its group is whole, unless its picture stands there already; of a
// part only that part's, and the atlas with the last frame. The disk is left as it was until the
// first one. All that is given to it must outlive this.
class FolderSink : public StagedSink {
 public:
  FolderSink(const RenderJob& job, const Scenario& scenario, Pace pace, Selection& selection,
             Work& work, const Part& part = {});

  std::size_t drawn() const { return drawn_; }
  std::size_t kept() const { return kept_; }
  std::uint64_t chosen() const { return chosen_; }          // of the whole run, whoever draws them
  std::size_t in_betweens() const { return in_betweens_; }  // there now
  const std::filesystem::path& path() const { return path_; }
  bool has_atlas() const { return has_atlas_; }  // it stands there, whole

 protected:
  // Throws IoError, BackendError, and UsageError for a picture that is too large.
  void draw(const Frame& frame, const Staging& staging) override;
  // Throws UsageError if no frame was chosen.
  void close(const DirectorReport& report) override;

 private:
  void open_folder(const Frame& frame);
  void take(const Frame& frame, const Staging& staging);
  void take_facts(const Frame& frame);
  void take_picture(const Frame& frame);
  void take_in_betweens();
  void write_picture(const std::string& file, const DrawList& list, const Frame& frame,
                     const MadeFrom& from);
  void write_counted(const std::string& file, const std::string& bytes);
  Pipeline& pipeline();
  void list_frames();
  void list_frame(std::uint32_t index);
  bool wants_atlas() const;
  void write_atlas(const Frame& frame);
  void write_manifest();

  const RenderJob& job_;
  const Scenario& scenario_;
  Selection& selection_;
  Manifest manifest_;
  std::filesystem::path path_;
  Work& work_;
  Part part_;
  std::optional<FrameFolder> folder_;
  std::unique_ptr<Pipeline> pipeline_;
  std::vector<ListedFrame> all_;   // of the run so far
  std::set<std::uint32_t> taken_;  // of these, chosen, and of the part
  std::set<std::string> written_;  // names of files
  std::uint64_t chosen_ = 0;       // of the whole run
  std::size_t drawn_ = 0, kept_ = 0, in_betweens_ = 0;
  bool has_atlas_ = false;
  FrameWalk walk_;
  bool is_here_ = false;       // where it stands is of the part
  std::optional<Frame> last_;  // of an atlas
};

}  // namespace lantern::app
