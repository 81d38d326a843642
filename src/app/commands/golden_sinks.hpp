// The frames of a run beside golden ones: compared with them, or becoming them. Both draw as
// `lantern render` does, in one pass, and keep no picture longer than it is needed.
//
// DIR/<scenario>/golden.txt lists the frames with the hashes of their pixels; beside it stand
// <scenario>_0000.png and .json, as render writes them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "app/folders/frame_folder.hpp"
#include "app/folders/golden_list.hpp"
#include "app/folders/kept_files.hpp"
#include "app/output/sinks.hpp"
#include "base/file.hpp"
#include "embedded/version.hpp"
#include "language/scenario.hpp"
#include "publish/golden_report.hpp"
#include "render/compare.hpp"
#include "render/png.hpp"
#include "render/renderer.hpp"

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
  GoldenList::MadeWith made_with() const {
    const Manifest m = job.manifest(scenario, pace);
    return {std::string(kVersion), m.size, m.theme, std::string(word_for(m.pace, kPaces)),
            fmt::format("lantern.frame/{}", kFactsVersion)};
  }
};

// Draws the chosen frames.
class GoldenSink : public StagedSink {
 protected:
  explicit GoldenSink(const Goldens& goldens) : goldens_(goldens), folder_(goldens.folder) {}

  // `facts` without a seal.
  virtual void take(const Frame& frame, const Image& image, const std::string& facts) = 0;

  // Throws BackendError, and UsageError for a picture that is too large.
  void draw(const Frame& frame, const Staging& staging) final {
    ++count_;
    if (!goldens_.selection.takes(frame)) return;
    const RenderJob& job = goldens_.job;
    const DrawList list = job.page_of(frame, staging, goldens_.work);
    if (!renderer_)
      renderer_ = job.make_renderer(job.picture.width, job.picture.height, goldens_.work);
    renderer_->draw(list, job.picture.theme, false, image_);
    ++goldens_.work.frames_drawn;
    take(frame, image_, to_json(frame));
  }

  std::string file(std::uint32_t frame, FileKind kind) const {
    return frame_file(goldens_.name, frame, kind);
  }
  // The pictures and facts of frames that stand in the folder, by name, with their frame's index.
  std::map<std::string, std::uint32_t> standing() const {
    std::map<std::string, std::uint32_t> files;
    for (const std::string& name : folder_ ? folder_->names() : std::vector<std::string>())
      if (const auto index = frame_of(name, goldens_.name.text())) files.emplace(name, *index);
    return files;
  }
  // Is it as Lantern made it?
  bool is_ours(const std::string& file) const {
    const auto bytes = read(file);
    return bytes && is_as_made(file, *bytes);
  }
  // Nothing if it is not there. Throws IoError if it cannot be read.
  std::optional<std::string> read(const std::string& file) const {
    constexpr std::size_t kMostBytes = std::size_t{1} << 30;
    return folder_ ? folder_->read(file, kMostBytes) : std::nullopt;
  }

  static bool same_facts(std::string_view golden, std::string_view facts) {
    return before_seal(FileKind::json, golden) == before_seal(FileKind::json, facts);
  }

  const Goldens& goldens_;
  std::optional<Folder> folder_;  // goldens_.folder, or as it was made since
  std::uint32_t count_ = 0;       // frames of the run so far, chosen or not

 private:
  std::unique_ptr<Renderer> renderer_;  // made when there is something to draw
  Image image_;
};

// What differs goes into the suite.
class GoldenComparison : public GoldenSink {
 public:
  // Pictures are kept for as many frames as `shown` says, which is counted down.
  GoldenComparison(const Goldens& goldens, const Allowance& allowance, GoldenSuite& suite,
                   std::size_t& shown)
      : GoldenSink(goldens), allowance_(allowance), suite_(suite), shown_(shown) {}

 private:
  void take(const Frame& frame, const Image& image, const std::string& facts) override {
    GoldenCase& one = suite_.cases.emplace_back();
    one.frame = frame.index;
    one.event = frame.event;
    const auto golden = goldens_.list.frames.find(frame.index);
    if (golden == goldens_.list.frames.end()) {
      one.findings.emplace_back("there is no golden frame of it");
      return show(one, nullptr, image);
    }
    compare_facts_of(one, facts);
    compare_picture_of(one, golden->second, image);
  }

  // Facts of another format differ all over, which is said once.
  void compare_facts_of(GoldenCase& one, const std::string& facts) const {
    if (goldens_.list.made_with.facts != goldens_.made_with().facts) return;
    const std::string name = file(one.frame, FileKind::json);
    const auto golden = read(name);
    if (!golden) {
      one.findings.push_back(name + " is missing");
    } else if (!same_facts(*golden, facts)) {
      const auto compared = compare_facts(*golden, facts);
      if (!compared)
        one.findings.push_back(name + " is damaged");
      else if (compared->total > 0)
        one.findings.push_back(finding(one.facts = *compared));
    }
  }

  // The list and the golden picture must tell of the same pixels: people look at the picture.
  void compare_picture_of(GoldenCase& one, const GoldenList::Entry& golden, const Image& image) {
    const std::string name = file(one.frame, FileKind::png);
    const bool same = pixel_hash(image) == golden.pixels;
    const auto bytes = read(name);
    const auto expected = bytes ? decode_png(*bytes) : std::nullopt;
    if (!expected) {
      one.findings.push_back(fmt::format("{}{} is {}", same ? "" : "its pixels differ, and ", name,
                                         bytes ? "damaged" : "missing"));
      if (!same) show(one, nullptr, image);
      return;
    }
    if (pixel_hash(*expected) != golden.pixels) {
      one.findings.push_back(
          fmt::format("{} is not the picture that {} tells of", name, kGoldenList));
      return show(one, &*expected, image);
    }
    if (same) return;
    const Comparison compared = compare(*expected, image, allowance_.tolerance);
    if (passes(compared, *expected, allowance_)) return;
    one.findings.push_back(finding(compared));
    show(one, &*expected, image);
  }

  // Keeps the pictures for the report; there may be no golden one.
  void show(GoldenCase& one, const Image* golden, const Image& actual) {
    const auto packed = [](const Image& image) {
      return encode_png(image, PngEffort::small, {}, 0);
    };
    one.picture_differs = true;
    if (shown_ == 0) return;
    --shown_;
    one.actual = packed(actual);
    if (!golden) return;
    one.expected = packed(*golden);
    one.difference = packed(marked_picture(*golden, actual, allowance_.tolerance));
  }

  void close(const DirectorReport&) override {
    goldens_.selection.require_some();
    if (!goldens_.selection.takes_all()) return;
    const auto& frames = goldens_.list.frames;
    for (auto gone = frames.lower_bound(count_); gone != frames.end(); ++gone) {
      GoldenCase& one = suite_.cases.emplace_back();
      one.frame = gone->first;
      one.event = gone->second.event;
      one.findings.emplace_back("is expected, but the run has no such frame");
    }
    for (const auto& [name, frame] : standing())
      if (!frames.contains(frame) && is_ours(name))
        suite_.findings.push_back(
            fmt::format("{} is of no golden frame; --update removes it", name));
  }

  Allowance allowance_;
  GoldenSuite& suite_;
  std::size_t& shown_;
};

// What has changed is written, and what is gone is removed, unless somebody else made it.
class GoldenUpdate : public GoldenSink {
 public:
  explicit GoldenUpdate(const Goldens& goldens) : GoldenSink(goldens) {}

  // Names of files.
  struct Changes {
    std::vector<std::string> written, removed, strange;
  };
  const Changes& changes() const { return changes_; }

 private:
  // Throws IoError, and leaves what stood there or the new file.
  void take(const Frame& frame, const Image& image, const std::string& facts) override {
    if (!lock_) {
      folder_ = Folder::made(goldens_.output).inside(goldens_.name.text());
      require_kept_for(KeptFor::goldens, *folder_);
      lock_.emplace(*folder_);
      folder_->remove_leftovers();
    }
    const auto& as = goldens_.job.picture;
    const MadeFrom from =
        goldens_.job.manifest(goldens_.scenario, goldens_.pace).frame_from(frame.index);
    const std::string png = file(frame.index, FileKind::png),
                      json = file(frame.index, FileKind::json);
    const auto picture = read(png);
    if (!picture || decode_png(*picture) != image)
      write(png, sealed(FileKind::png,
                        encode_png(image, as.effort, texts_of(frame), as.pixels_per_metre), from));
    const auto golden = read(json);
    if (!golden || !same_facts(*golden, facts))
      write(json, sealed(FileKind::json, facts, {from.facts, from.facts}));
    taken_[frame.index] = {pixel_hash(image), frame.event};
  }

  void write(const std::string& file, const std::string& bytes) {
    write_file({*folder_, file}, bytes);
    goldens_.work.bytes_written += bytes.size();
    changes_.written.push_back(file);
  }

  // golden.txt is written last.
  void close(const DirectorReport&) override {
    goldens_.selection.require_some();
    GoldenList list{goldens_.made_with(), goldens_.list.frames};
    for (auto& [index, entry] : taken_) list.frames.insert_or_assign(index, std::move(entry));
    list.frames.erase(list.frames.lower_bound(count_), list.frames.end());
    // Of whatever run, finished or not.
    for (const auto& [name, frame] : standing()) {
      if (frame < count_) continue;
      if (!is_ours(name))
        changes_.strange.push_back(name);
      else if (folder_->remove(name))
        changes_.removed.push_back(name);
    }
    // Another version that draws the same is no change.
    GoldenList before = goldens_.list;
    if (changes_.written.empty() && changes_.removed.empty())
      before.made_with.version = list.made_with.version;
    if (list != before) write(kGoldenList, to_text(list));
  }

  std::optional<FolderLock> lock_;  // from the first frame on
  std::map<std::uint32_t, GoldenList::Entry> taken_;
  Changes changes_;
};

}  // namespace lantern::app
