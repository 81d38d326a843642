#include "app/golden_sink.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "app/kept_files.hpp"
#include "app/terminal.hpp"
#include "base/file.hpp"
#include "embedded/version.hpp"
#include "render/compare_facts.hpp"
#include "render/png.hpp"
#include "render/seal.hpp"

namespace lantern::app {
namespace {

std::string packed(const Image& image) { return encode_png(image, PngEffort::small, {}, 0); }

bool same_facts(std::string_view golden, std::string_view facts) {
  return before_seal(FileKind::json, golden) == before_seal(FileKind::json, facts);
}

}  // namespace

GoldenList::MadeWith Goldens::made_with() const {
  const Manifest m = job.manifest(scenario, pace);
  return {std::string(kVersion), m.size, m.theme, std::string(word_for(m.pace, kPaces)),
          fmt::format("lantern.frame/{}", kFactsVersion)};
}

void GoldenSink::draw(const Frame& frame, const Staging& staging) {
  ++count_;
  if (!goldens_.selection.takes(frame)) return;
  const RenderJob& job = goldens_.job;
  const DrawList list = job.page_of(frame, staging, goldens_.work);
  if (!renderer_) try {
      renderer_.emplace(Context::create(job.backend), job.picture.width, job.picture.height);
      ++goldens_.work.graphics_contexts;
    } catch (const Refused& too_large) {  // by the command line, not by the scenario
      throw UsageError(too_large.what());
    }
  renderer_->draw(list, job.picture.theme, false, image_);
  ++goldens_.work.frames_drawn;
  take(frame, image_, to_json(frame));
}

std::string GoldenSink::file(std::uint32_t frame, FileKind kind) const {
  return frame_file(goldens_.name, frame, kind);
}

std::map<std::string, std::uint32_t> GoldenSink::frame_files() const {
  std::map<std::string, std::uint32_t> files;
  for (const std::string& name : folder_ ? folder_->names() : std::vector<std::string>())
    if (const auto index = frame_of(name, goldens_.name.text())) files.emplace(name, *index);
  return files;
}

std::optional<std::string> GoldenSink::read(const std::string& file) const {
  constexpr std::size_t kMostBytes = std::size_t{1} << 30;
  return folder_ ? folder_->read(file, kMostBytes) : std::nullopt;
}

GoldenComparison::GoldenComparison(const Goldens& goldens, const Allowance& allowance,
                                   GoldenSuite& suite, std::size_t& shown)
    : GoldenSink(goldens), allowance_(allowance), suite_(suite), shown_(shown) {}

void GoldenComparison::take(const Frame& frame, const Image& image, const std::string& facts) {
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
void GoldenComparison::compare_facts_of(GoldenCase& one, const std::string& facts) const {
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
void GoldenComparison::compare_picture_of(GoldenCase& one, const GoldenList::Entry& golden,
                                          const Image& image) {
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

void GoldenComparison::show(GoldenCase& one, const Image* golden, const Image& actual) {
  one.picture_differs = true;
  if (shown_ == 0) return;
  --shown_;
  one.actual = packed(actual);
  if (!golden) return;
  one.expected = packed(*golden);
  one.difference = packed(marked_picture(*golden, actual, allowance_.tolerance));
}

void GoldenComparison::close(const DirectorReport&) {
  goldens_.selection.require_some();
  for (const auto& [index, golden] : goldens_.list.frames)
    if (index >= count_ && goldens_.selection.takes_all()) {
      GoldenCase& one = suite_.cases.emplace_back();
      one.frame = index;
      one.event = golden.event;
      one.findings.emplace_back("is expected, but the run has no such frame");
    }
  if (!goldens_.selection.takes_all()) return;
  for (const auto& [name, index] : frame_files())
    if (const auto bytes = read(name);
        !goldens_.list.frames.contains(index) && bytes && is_as_made(name, *bytes))
      suite_.findings.push_back(fmt::format("{} is of no golden frame; --update removes it", name));
}

void GoldenUpdate::take(const Frame& frame, const Image& image, const std::string& facts) {
  if (!lock_) {
    folder_ = Folder::made(goldens_.output).inside(goldens_.name.text());
    require_kept_for(KeptFor::goldens, *folder_);
    lock_.emplace(*folder_);
    folder_->remove_leftovers();
  }
  const RenderJob& job = goldens_.job;
  const MadeFrom from = job.manifest(goldens_.scenario, goldens_.pace).frame_from(frame.index);
  const std::string png = file(frame.index, FileKind::png),
                    json = file(frame.index, FileKind::json);
  const auto picture = read(png);
  if (!picture || decode_png(*picture) != image)
    write(png, sealed(FileKind::png,
                      encode_png(image, job.picture.effort, texts_of(frame),
                                 job.picture.pixels_per_metre),
                      from));
  const auto golden = read(json);
  if (!golden || !same_facts(*golden, facts))
    write(json, sealed(FileKind::json, facts, {from.facts, from.facts}));
  taken_[frame.index] = {pixel_hash(image), frame.event};
}

void GoldenUpdate::write(const std::string& file, const std::string& bytes) {
  write_file({*folder_, file}, bytes);
  goldens_.work.bytes_written += bytes.size();
  written_.push_back(file);
}

void GoldenUpdate::close(const DirectorReport&) {
  goldens_.selection.require_some();
  GoldenList list{goldens_.made_with(), goldens_.list.frames};
  for (auto& [index, entry] : taken_) list.frames.insert_or_assign(index, std::move(entry));
  list.frames.erase(list.frames.lower_bound(count_), list.frames.end());
  remove_gone();
  // Another version that draws the same is no change.
  GoldenList before = goldens_.list;
  if (written_.empty() && removed_.empty()) before.made_with.version = list.made_with.version;
  if (list != before) write(kGoldenList, to_text(list));
}

// Of whatever run, finished or not.
void GoldenUpdate::remove_gone() {
  for (const auto& [name, index] : frame_files()) {
    if (index < count_) continue;
    const auto bytes = read(name);
    if (!bytes || !is_as_made(name, *bytes))
      strange_.push_back(name);
    else if (folder_->remove(name))
      removed_.push_back(name);
  }
}

}  // namespace lantern::app
