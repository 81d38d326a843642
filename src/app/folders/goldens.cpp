#include "app/folders/goldens.hpp"

#include <algorithm>
#include <sstream>

#include <fmt/format.h>

#include "app/folders/frame_folder.hpp"
#include "app/folders/kept_files.hpp"
#include "app/output/sinks.hpp"
#include "base/number.hpp"
#include "base/printable.hpp"
#include "draw/theme.hpp"
#include "embedded/version.hpp"
#include "render/renderer.hpp"

namespace lantern::app {

namespace {

constexpr std::string_view kGoldenFormat = "lantern.golden_frames/";
constexpr std::string_view kGoldenVersion = "1";

using Member = std::pair<std::string_view, std::string GoldenList::MadeWith::*>;
constexpr std::array<Member, 5> kMembers = {{{"version", &GoldenList::MadeWith::version},
                                             {"size", &GoldenList::MadeWith::size},
                                             {"theme", &GoldenList::MadeWith::theme},
                                             {"pace", &GoldenList::MadeWith::pace},
                                             {"facts", &GoldenList::MadeWith::facts}}};

bool is_hash(std::string_view word) {
  return word.size() == 16 && word.find_first_not_of("0123456789abcdef") == word.npos;
}

// The word that a line begins with, which loses it and the space behind it.
std::string_view taken_word(std::string_view& line) {
  const std::string_view word = line.substr(0, line.find(' '));
  line.remove_prefix(std::min(word.size() + 1, line.size()));
  return word;
}

// "7 1f0c6e2a... split": the frame, its pixels, and what is left of the line.
bool read_frame(std::string_view line, GoldenList& list) {
  const auto index = number_in<std::uint32_t>(taken_word(line));
  const std::string hash(taken_word(line));
  return index && is_hash(hash) &&
         list.frames.emplace(*index, GoldenList::Entry{hash, std::string(line)}).second;
}

// They are told as words to type.
bool is_right(const GoldenList::MadeWith& m) {
  const auto is_of = [](std::string_view text, std::string_view letters) {
    return text.size() <= 32 && text.find_first_not_of(letters) == text.npos;
  };
  return is_of(m.version, "0123456789.") && is_of(m.size, "0123456789x") &&
         (m.theme.empty() || theme_named(m.theme)) &&
         (m.pace.empty() || m.pace == word_for(Pace::step, kPaces) ||
          m.pace == word_for(Pace::event, kPaces)) &&
         is_of(m.facts, "lantern.frame/0123456789");
}

bool read_line(std::string_view line, GoldenList& list) {
  if (line.find(' ') == line.npos) return false;
  const std::string_view key = taken_word(line);
  if (key == "frame") return read_frame(line, list);
  for (const auto& [name, member] : kMembers)
    if (key == name && (list.made_with.*member).empty()) {
      list.made_with.*member = line;
      return is_right(list.made_with);
    }
  return false;
}

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
    job.renderer(job.picture.width, job.picture.height, goldens_.work)
        .draw(list, job.picture.theme, false, image_);
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
  Image image_;
};

class GoldenComparison : public GoldenSink {
 public:
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

class GoldenUpdate : public GoldenSink {
 public:
  GoldenUpdate(const Goldens& goldens, GoldenChanges& changes)
      : GoldenSink(goldens), changes_(changes) {}

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
  GoldenChanges& changes_;
};

}  // namespace

std::string to_text(const GoldenList& list) {
  std::string text = fmt::format("{}{}\n", kGoldenFormat, kGoldenVersion);
  for (const auto& [name, member] : kMembers)
    text += fmt::format("{} {}\n", name, list.made_with.*member);
  for (const auto& [index, entry] : list.frames)
    text += fmt::format("frame {} {} {}\n", index, entry.pixels, printable(entry.event));
  return text;
}

std::optional<GoldenList> read_golden_list(const Folder& folder) {
  constexpr std::size_t kMostBytes = std::size_t{1} << 28;
  const auto text = folder.read(kGoldenList, kMostBytes);
  if (!text) return std::nullopt;
  const std::string file = folder.path(kGoldenList).string();
  const auto damaged = [&](const std::string& how) {
    return DamagedGoldens(fmt::format("'{}' is damaged{}; --update makes it anew", file, how));
  };
  std::istringstream lines(*text);
  GoldenList list;
  std::string line, all;
  for (std::size_t number = 1; std::getline(lines, line); ++number) {
    if (line.ends_with('\r')) line.pop_back();  // as some version control systems give it
    all += line + "\n";
    if (number == 1) {
      if (!line.starts_with(kGoldenFormat))
        throw IoError("'{}' is not Lantern's: move it, or give --dir another folder", file);
      if (line.substr(kGoldenFormat.size()) != kGoldenVersion)
        throw IoError("'{}' is of a later Lantern: {}", file, line);
    } else if (!read_line(line, list)) {
      throw damaged(fmt::format(" in line {}", number));
    }
  }
  for (const auto& [name, member] : kMembers)
    if ((list.made_with.*member).empty()) throw damaged(fmt::format(": no {}", name));
  try {
    require_as_written(all, to_text(list));
  } catch (const RefusedFile& why) {
    throw damaged(fmt::format(": {}", why.what()));
  }
  return list;
}

GoldenList::MadeWith Goldens::made_with() const {
  const Manifest m = job.manifest(scenario, pace);
  return {std::string(kVersion), m.size, m.theme, std::string(word_for(m.pace, kPaces)),
          fmt::format("lantern.frame/{}", kFactsVersion)};
}

std::unique_ptr<FrameSink> make_golden_comparison(const Goldens& goldens,
                                                  const Allowance& allowance, GoldenSuite& suite,
                                                  std::size_t& shown) {
  return std::make_unique<GoldenComparison>(goldens, allowance, suite, shown);
}

std::unique_ptr<FrameSink> make_golden_update(const Goldens& goldens, GoldenChanges& changes) {
  return std::make_unique<GoldenUpdate>(goldens, changes);
}

}  // namespace lantern::app
