// Golden frames: DIR/<scenario>/golden.txt lists them with the hashes of their pixels, a line a
// frame, so that a version control system shows and merges what changed; beside it stand
// <scenario>_0000.png and .json, as render writes them. The frames of a run are compared with them,
// or become them. Both draw as `lantern render` does, in one pass, and keep no picture longer than
// it is needed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/output/render_job.hpp"
#include "app/run_scenario.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "language/scenario.hpp"
#include "publish/golden_report.hpp"
#include "render/compare.hpp"

namespace lantern::app {

struct GoldenList {
  // Words as on the command line. Goldens can only be compared with frames that are made so.
  struct MadeWith {
    std::string version, size, theme, pace, facts;
    bool operator==(const MadeWith&) const = default;
  };
  struct Entry {
    std::string pixels;  // pixel_hash() of its picture
    std::string event;   // to name the frame if a run has none such any more
    bool operator==(const Entry&) const = default;
  };
  MadeWith made_with;
  std::map<std::uint32_t, Entry> frames;
  bool operator==(const GoldenList&) const = default;
};

inline constexpr const char* kGoldenList = "golden.txt";

// It is Lantern's, but cannot be read to its end: a conflict of a merge, or half of it.
class DamagedGoldens : public IoError {
 public:
  using IoError::IoError;
};

std::string to_text(const GoldenList& list);

// That of the folder; nothing if there is none. Throws DamagedGoldens; IoError if it cannot be
// read, is no golden.txt of Lantern's, or is that of a later Lantern.
std::optional<GoldenList> read_golden_list(const Folder& folder);

// What the goldens of one scenario are. The references must outlive the sink.
struct Goldens {
  const RenderJob& job;
  const Scenario& scenario;
  Pace pace;
  Selection& selection;
  Work& work;
  ScenarioName name;
  fs::path output;               // DIR
  std::optional<Folder> folder;  // DIR/<scenario>, if it is there
  GoldenList list;               // that stands there; without frames if none does

  // What this run's frames are made with.
  GoldenList::MadeWith made_with() const;
};

// What differs goes into the suite. Pictures are kept for as many frames as `shown` says, which is
// counted down. All must outlive the sink.
std::unique_ptr<FrameSink> make_golden_comparison(const Goldens& goldens,
                                                  const Allowance& allowance, GoldenSuite& suite,
                                                  std::size_t& shown);

// Names of files.
struct GoldenChanges {
  std::vector<std::string> written, removed, strange;
};
// What has changed is written, and what is gone is removed, unless somebody else made it.
std::unique_ptr<FrameSink> make_golden_update(const Goldens& goldens, GoldenChanges& changes);

}  // namespace lantern::app
